//! Mathematics that knows nothing of machines: series of numbers in, numbers out.
//!
//! Least squares, two minimisers, Fourier sums at uneven places and what those places resolve,
//! the plain figures of a series, values to be tried, and the price of looking at many places.

mod axes;
mod chi_squared;
pub(crate) mod fourier;
mod golden_section;
pub(crate) mod least_squares;
mod looks;
mod parallel;
pub(crate) mod quasi_newton;
mod random_effects;
mod sampling;
pub(crate) mod simplex;
mod summary;

pub(crate) use axes::{by_factors, evenly, product};
pub(crate) use chi_squared::chi_squared_tail;
pub(crate) use golden_section::golden_maximum;
pub(crate) use looks::Looks;
pub(crate) use parallel::in_parallel;
pub(crate) use random_effects::{drawn_sizes_gain, drawn_sizes_gain_with};
pub(crate) use sampling::{
    highest_frequency, may_resolve, nearly_even_rate, resolves, turns_of_the_way, usual_rate,
    waves_drawn,
};
pub(crate) use summary::{
    count, deviation, longest, mean, median, middle, middle_nearest_zero, one_in, rms_about_means,
    spread, weighted_median,
};
