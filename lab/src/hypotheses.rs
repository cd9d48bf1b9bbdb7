//! What could be in a residual: effects and where to look for them, wrong settings, shapes without
//! a name, and structure that is nobody's; each tried, with its chance in noise.

mod agreement;
mod alternating;
mod bursts;
mod calibration;
mod candidates;
mod chirps;
mod common_curve;
mod corrections;
mod drawn;
mod excursions;
mod flaws;
mod grid;
mod jumps;
mod levels;
mod likelihood;
mod local;
mod lost_signs;
#[cfg(test)]
mod made_noise;
mod nonlinearity;
mod odd_pass;
mod outliers;
mod probes;
mod repeatability;
mod setting_trial;
mod settings;
mod slow_noise;
mod spoilt_pass;
mod swings;
mod tails;
mod time_reversal;
mod trial;
mod uneven_slowness;
mod unfolding;
mod waves;
mod waves_of_passes;

pub(crate) use agreement::{Disagreement, disagreements};
pub(crate) use calibration::chance as chance_in_noise;
pub(crate) use candidates::{
    Candidate, as_it_stands, candidate, candidates, candidates_like, however_begun, of_known_size,
    turn_scan, whole,
};
pub(crate) use flaws::{above_flaws, above_hunting, least_above_hunting};
pub(crate) use likelihood::Likelihood;
pub use probes::Structure;
pub(crate) use probes::{
    all_structures, at_targets, between_ways, is_left, matters, no_larger_than, structures,
    waves_left,
};
pub(crate) use setting_trial::setting_trials;
pub(crate) use slow_noise::{
    no_all_clear, samples_a_pass, slow_cause, slow_or_smooth, taken_for_noise,
};
pub(crate) use tails::chance_with_tails;
pub(crate) use trial::{Trial, gain_at, try_candidate};
