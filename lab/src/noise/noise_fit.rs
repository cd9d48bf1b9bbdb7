//! Finds the noise of a residual by restricted maximum likelihood, and which samples are outliers.
//!
//! Restricted: the offsets of the passes are projected out and counted, so that short passes do
//! not make the noise look smaller than it is (Patterson and Thompson 1971).

use nalgebra::SVector;

use super::kernel::{Noise, SlowPart};
use super::layout::{Block, Layout};
use super::sweep::squares_and_log_determinants;
use crate::numerics::quasi_newton::{Descent, minimise};
use crate::numerics::{count, deviation, in_parallel, middle, one_in};
use crate::policy::extent::{IN_COMPANY, LOUDNESS_ROWS};
use crate::policy::reading::{
    BEYOND_ARE_OUTLIERS, BEYOND_DEVIATIONS, FAR_OUT, MOST_LOUD, NO_LAW, OUTLIER_DEVIATIONS,
    OUTLIER_NEIGHBOURS,
};

/// A fitted noise model with its log likelihood.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NoiseFit {
    /// The noise in the unit of the residual squared.
    pub(crate) noise: Noise,
    /// Restricted log likelihood, without the constant `−n/2·log 2π`.
    pub(crate) log_likelihood: f64,
}

/// Longest correlation tried, against the longest block: beyond it a random walk looks alike.
pub(super) const LONGEST_AGAINST_BLOCK: f64 = 3.0;

/// Logarithm of the shortest length tried, in sample intervals: anything shorter is white.
const SHORTEST: f64 = -1.0;

/// Least distance of the logarithms of two lengths that a search begins with: nearer ones are as
/// good as one, and a length at its bound has nothing beyond it.
const ROOM: f64 = 0.5;

/// Fits the noise of one sensor to its residual.
///
/// `warm` is the noise of a similar residual: its parts are only adjusted. Without it, a slow part
/// is always looked for: noise that is called white because its slow part is faint makes every slow
/// curve look better than it is. A second one must pay for its two parameters by the Bayesian
/// information criterion, and is looked for where the first one does. `layout` holds rows of this
/// sensor only (as sensor 0).
#[must_use]
pub(crate) fn fit_noise(layout: &Layout, residual: &[f64], warm: Option<&Noise>) -> NoiseFit {
    if let Some(warm) = warm.filter(|warm| !warm.slow.is_empty()) {
        return adjusted(layout, residual, warm);
    }
    let white = profile(layout, residual, &Noise::white());
    let price = price_of_a_part(layout);
    let span = longest_block(layout).max(2.0);
    let one = one_part(layout, residual, span);
    if one.log_likelihood <= white.log_likelihood + price {
        return best_of([white, one].into_iter());
    }
    let two = two_parts(layout, residual, &one.noise, span);
    if one.log_likelihood + price < two.log_likelihood { two } else { one }
}

/// True where a noise is likelier than white noise by the price of a slow part: a few samples of white noise
/// draw a slow one as well by chance.
#[must_use]
pub(crate) fn is_surely_slow(layout: &Layout, residual: &[f64], noise: &Noise) -> bool {
    let [white, slow] = [&Noise::white(), noise].map(|shape| profile(layout, residual, shape));
    white.log_likelihood + price_of_a_part(layout) < slow.log_likelihood
}

/// A shape of noise at the scale that makes a residual of one sensor likeliest.
#[must_use]
pub(crate) fn scaled_to(layout: &Layout, residual: &[f64], shape: &Noise) -> Noise {
    profile(layout, residual, shape).noise
}

/// What two parameters must add to the log likelihood, by the Bayesian information criterion.
fn price_of_a_part(layout: &Layout) -> f64 {
    libm::log(count(layout.len()).max(2.0))
}

fn adjusted(layout: &Layout, residual: &[f64], warm: &Noise) -> NoiseFit {
    let of = |part: &SlowPart| {
        [libm::log((part.variance / warm.white).max(1e-6)), libm::log(part.length)]
    };
    let span = longest_block(layout).max(2.0);
    match warm.slow.as_slice() {
        [one] => searched(layout, residual, of(one), span),
        [one, two, ..] => searched(layout, residual, joined(of(one), of(two)), span),
        [] => profile(layout, residual, &Noise::white()),
    }
}

fn one_part(layout: &Layout, residual: &[f64], span: f64) -> NoiseFit {
    let starts = [[0.0, libm::log(3.0)], [0.0, libm::log((0.2 * span).max(4.0))]];
    best_searched(layout, residual, &starts, span)
}

fn two_parts(layout: &Layout, residual: &[f64], one: &Noise, span: f64) -> NoiseFit {
    let part = one.slow.first().copied().unwrap_or(SlowPart { variance: 1.0, length: 3.0 });
    let known = [libm::log((part.variance / one.white).max(1e-6)), libm::log(part.length)];
    let longer = [known[0] - 1.0, (known[1] + 2.5).min(libm::log(span))];
    let shorter = [known[0] - 1.0, (known[1] - 2.0).max(SHORTEST)];
    let longer = (known[1] + ROOM < longer[1]).then_some(longer);
    let shorter = (shorter[1] < known[1] - ROOM).then_some(shorter);
    let starts: Vec<[f64; 4]> =
        longer.into_iter().chain(shorter).map(|other| joined(known, other)).collect();
    best_searched(layout, residual, &starts, span)
}

/// The likeliest noise of those that searches from some starts end at.
fn best_searched<const D: usize>(
    layout: &Layout,
    residual: &[f64],
    starts: &[[f64; D]],
    span: f64,
) -> NoiseFit {
    let searched = in_parallel(starts, |start| searched(layout, residual, *start, span));
    best_of(searched.into_iter())
}

fn joined(one: [f64; 2], two: [f64; 2]) -> [f64; 4] {
    [one[0], one[1], two[0], two[1]]
}

fn best_of(fits: impl Iterator<Item = NoiseFit>) -> NoiseFit {
    fits.reduce(|a, b| if a.log_likelihood < b.log_likelihood { b } else { a })
        .unwrap_or(NoiseFit { noise: Noise::white(), log_likelihood: f64::NEG_INFINITY })
}

/// How far a parameter may go at once, and what the likelihood may still gain at the end.
pub(super) const DESCENT: Descent = Descent { iterations: 24, longest: 1.5, tolerance: 0.02 };

fn searched<const D: usize>(
    layout: &Layout,
    residual: &[f64],
    start: [f64; D],
    span: f64,
) -> NoiseFit {
    let losses = |points: &[SVector<f64, D>]| {
        let shapes: Vec<Noise> =
            points.iter().map(|point| shaped(point.as_slice(), span)).collect();
        profiles(layout, residual, &shapes).into_iter().map(|fit| -fit.log_likelihood).collect()
    };
    let point = minimise(losses, SVector::from(start), DESCENT);
    profile(layout, residual, &shaped(point.as_slice(), span))
}

/// Variance of a slow part against the white one, by its logarithm.
pub(super) fn variance(logarithm: f64) -> f64 {
    libm::exp(logarithm.clamp(-12.0, 14.0))
}

/// Noise of white variance 1 from log variances and log lengths, kept within sensible bounds.
fn shaped(point: &[f64], span: f64) -> Noise {
    let slow = point.chunks_exact(2).map(|pair| SlowPart {
        variance: variance(pair[0]),
        length: libm::exp(pair[1].clamp(SHORTEST, libm::log(LONGEST_AGAINST_BLOCK * span))),
    });
    Noise { white: 1.0, slow: slow.collect() }
}

/// The likelihood of noise shapes with equally many parts, their scales at their best values.
fn profiles(layout: &Layout, residual: &[f64], shapes: &[Noise]) -> Vec<NoiseFit> {
    let swept = squares_and_log_determinants(layout, shapes, residual);
    let with_shape = swept.into_iter().zip(shapes);
    with_shape
        .map(|((square, log_determinant), shape)| {
            let log_likelihood = scaled_likelihood(layout, square, log_determinant);
            NoiseFit { noise: shape.scaled(likeliest_scale(layout, square)), log_likelihood }
        })
        .collect()
}

/// Rows that tell of a noise, those gone for the zeros of the passes.
fn freedom(layout: &Layout) -> f64 {
    count(layout.len().saturating_sub(layout.blocks.len())).max(1.0)
}

/// Scale of a noise whose shape whitens a residual to a square.
fn likeliest_scale(layout: &Layout, square: f64) -> f64 {
    (square / freedom(layout)).max(f64::MIN_POSITIVE)
}

/// Restricted log likelihood at that scale.
pub(super) fn scaled_likelihood(layout: &Layout, square: f64, log_determinant: f64) -> f64 {
    let scale = likeliest_scale(layout, square);
    -0.5 * (freedom(layout) * (libm::log(scale) + 1.0) + log_determinant)
}

/// The same of a shape of noise for a residual.
pub(super) fn log_likelihood_of(layout: &Layout, residual: &[f64], shape: &Noise) -> f64 {
    profile(layout, residual, shape).log_likelihood
}

fn profile(layout: &Layout, residual: &[f64], shape: &Noise) -> NoiseFit {
    best_of(profiles(layout, residual, std::slice::from_ref(shape)).into_iter())
}

/// Clock from the first to the last row of the longest block, in sample intervals.
pub(super) fn longest_block(layout: &Layout) -> f64 {
    let length = |block: &Block| layout.clock[block.rows.end - 1] - layout.clock[block.rows.start];
    layout.blocks.iter().filter(|block| !block.rows.is_empty()).map(length).fold(0.0, f64::max)
}

/// Variance factors that take outliers back to size: 1 within three robust deviations.
///
/// A sample is judged against the median of itself and its neighbours, so a slow effect or a step,
/// which neighbours share, is never an outlier (Hampel's identifier). Where most samples are that
/// median themselves, as on a smooth curve or a staircase, those that are not tell how far noise takes
/// one; rows that are not `telling` are not asked. No deviation is taken to be less than `least_variance`
/// says of its sensor. Where four fifths of the samples say far more than half of them, as no law of noise
/// does, those are believed: half may lie where a wave turns slowly.
///
/// A wild reading weighs the less beside an outlier the farther it lies, and none in the end, as in the
/// third part of Hampel's law (Hampel 1974, *The influence curve and its role in robust estimation*, JASA
/// 69:383): at three deviations it would still have nine of twice the log likelihood to give to whatever
/// meets that one row.
#[must_use]
pub(crate) fn outlier_inflation(
    layout: &Layout,
    residual: &[f64],
    telling: &[bool],
    least_variance: &[f64],
) -> Vec<f64> {
    let mut inflation = vec![1.0; residual.len()];
    for (sensor, least) in least_variance.iter().enumerate() {
        let blocks = || layout.blocks.iter().filter(|block| block.sensor == sensor);
        let departures = blocks().flat_map(|block| departures(&residual[block.rows.clone()]));
        let sizes: Vec<f64> = departures.map(f64::abs).collect();
        let telling = blocks().flat_map(|block| &telling[block.rows.clone()]);
        let tells = sizes.iter().zip(telling).filter(|(_, telling)| **telling);
        let told = told(tells.map(|(size, _)| *size).collect());
        if 0.0 < told {
            let usual = told.max(least.sqrt());
            let mut before = 0;
            for rows in blocks().map(|block| block.rows.clone()) {
                let own = &sizes[before..before + rows.len()];
                before += rows.len();
                for (row, (size, wild)) in rows.zip(own.iter().zip(wild(own, usual))) {
                    let beyond = if wild { size / (FAR_OUT * usual) } else { 1.0 };
                    let size = size / (OUTLIER_DEVIATIONS * usual) * beyond;
                    inflation[row] = (size * size).max(1.0);
                }
            }
        }
    }
    inflation
}

/// The deviation that sizes of departures tell, or more where four fifths of them say far more than half.
fn told(mut sizes: Vec<f64>) -> f64 {
    let told = usual(&mut sizes);
    if told <= 0.0 {
        return told;
    }
    let most = one_in(&mut sizes, BEYOND_ARE_OUTLIERS) / BEYOND_DEVIATIONS;
    if NO_LAW * told < most { most } else { told }
}

/// The deviation that most sizes of departures tell; where most are none, those that are some.
fn usual(sizes: &mut Vec<f64>) -> f64 {
    if deviation(sizes) <= 0.0 {
        sizes.retain(|size| 0.0 < *size);
    }
    deviation(sizes)
}

/// Values of a pass, none farther from its neighbours than so many of their usual distances, and wild ones where
/// their neighbours are: cut off, each would still be a blow.
#[must_use]
pub(crate) fn without_outliers(values: &[f64], deviations: f64) -> Vec<f64> {
    let departures = departures(values);
    let sizes: Vec<f64> = departures.iter().map(|off| off.abs()).collect();
    let usual = usual(&mut sizes.clone());
    let (most, wild) = (deviations * usual, wild(&sizes, usual));
    let left = |off: f64, wild| if wild { 0.0 } else { off.clamp(-most, most) };
    let kept = values.iter().zip(departures).zip(wild);
    kept.map(|((value, off), wild)| value - off + left(off, wild)).collect()
}

/// Which values of a pass are wild by the sizes of their [`departures`]: far out, and without another such within a
/// few rows. What stands in several rows has a cause, be it a knock.
fn wild(sizes: &[f64], usual: f64) -> Vec<bool> {
    let far: Vec<bool> = (0..sizes.len()).map(|row| is_far(sizes, row, usual)).collect();
    let alone = |row: usize| {
        let near = row.saturating_sub(IN_COMPANY)..(row + IN_COMPANY + 1).min(far.len());
        far[near].iter().filter(|far| **far).count() == 1
    };
    (0..far.len()).map(|row| far[row] && alone(row)).collect()
}

/// Far beyond what is usual in the pass, and in the neighbourhood where that is louder.
#[must_use]
pub(crate) fn is_far(sizes: &[f64], row: usize, usual: f64) -> bool {
    if sizes[row] <= FAR_OUT * usual {
        return false;
    }
    let near = row.saturating_sub(LOUDNESS_ROWS)..(row + LOUDNESS_ROWS + 1).min(sizes.len());
    let here = deviation(&mut sizes[near].to_vec()).clamp(usual, MOST_LOUD * usual);
    FAR_OUT * here < sizes[row]
}

/// What each value of a pass differs by from the median of itself and its neighbours.
#[must_use]
pub(crate) fn departures(values: &[f64]) -> Vec<f64> {
    let mut near = Vec::new();
    let of = |(row, value): (usize, &f64)| {
        let to = (row + OUTLIER_NEIGHBOURS + 1).min(values.len());
        near.clear();
        near.extend_from_slice(&values[row.saturating_sub(OUTLIER_NEIGHBOURS)..to]);
        value - middle(&mut near)
    };
    values.iter().enumerate().map(of).collect()
}
