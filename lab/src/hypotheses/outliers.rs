//! Whether bad readings come by chance.
//!
//! An outlier weighs as little in a fit as it stands far out, so that whatever makes a few samples
//! stand out is the better hidden the larger it is: a scratch of the grating, a burst of swing, a bump of
//! two samples. Bad readings of an instrument come at any moment and at any place. Those that come
//! together, at one angle of a turn, or where another pass has one, have a cause, and so have more of them than
//! noise of any law has.

use std::ops::Range;

use statrs::distribution::{Binomial, DiscreteCDF, Poisson};

use super::drawn::surest;
use super::excursions::are_readings;
use crate::model::{Fit, Problem};
use crate::noise::{departures, is_far};
use crate::numerics::{chi_squared_tail, count, deviation, fourier, median, middle, spread};
use crate::policy::chance::{FEWEST_OUTLIERS, SIGNIFICANCE};
use crate::policy::extent::IN_COMPANY;
use crate::policy::reading::{FAR_IN_TAILS, FAR_OUT};

/// What outliers have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Company {
    /// They follow each other.
    Rows,
    /// They stand at one angle of a turn of whatever turns at this order of the spindle.
    Angle(f64),
    /// They come again and again, whichever way the axis goes.
    Intervals,
    /// They stand where another pass has one.
    Place,
    /// They are more than any noise has.
    Number,
}

/// Outliers of a cause.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outliers {
    pub(super) company: Company,
    /// Root mean square of them over the whole record, µm (arcsec).
    pub(super) rms_um: f64,
    /// Chance of as much company.
    pub(super) p_value: f64,
}

/// The clearest company of the outliers of a fit; `None` where there are too few.
#[must_use]
pub(super) fn outliers(problem: &Problem, fit: &Fit) -> Option<Outliers> {
    let passes = passes(problem, fit);
    if passes.iter().map(|pass| pass.far.len()).sum::<usize>() < FEWEST_OUTLIERS {
        return None;
    }
    let turns: Vec<f64> = problem.record.turns().collect();
    let at = |row: usize| turns[problem.samples[row]];
    let far: Vec<f64> = passes.iter().flat_map(|pass| pass.events().map(at)).collect();
    let all: Vec<f64> = passes.iter().flat_map(|pass| pass.rows.clone().map(at)).collect();
    let (order, at_one_angle) = at_one_angle(&far, &all, problem.highest_order());
    let all = [
        (Company::Rows, in_rows(&passes)),
        (Company::Angle(order), at_one_angle),
        (Company::Intervals, at_intervals(&passes)),
        (Company::Place, at_places(problem, &passes)),
    ];
    let with_company = surest(&all)?;
    // Where they have a place that says more than how many they are.
    let (company, p_value) = if with_company.1 < SIGNIFICANCE {
        with_company
    } else {
        surest(&[with_company, (Company::Number, so_many(&passes, &fit.left))])?
    };
    let square: f64 = passes.iter().map(|pass| pass.square).sum();
    Some(Outliers { company, rms_um: (square / count(problem.samples.len())).sqrt(), p_value })
}

/// A pass of one sensor.
struct Pass {
    rows: Range<usize>,
    sensor: usize,
    /// Rows that stand far out.
    far: Vec<usize>,
    /// Sum of the squares of how far they do, µm² (arcsec²).
    square: f64,
}

/// Passes that were read row by row.
fn passes(problem: &Problem, fit: &Fit) -> Vec<Pass> {
    let finest = |sensor: usize| problem.least_variance[sensor].sqrt();
    let blocks = problem.layout.blocks.iter();
    let read =
        blocks.filter(|block| are_readings(&fit.left[block.rows.clone()], finest(block.sensor)));
    read.map(|block| Pass::of(block.rows.clone(), block.sensor, &fit.left, finest(block.sensor)))
        .collect()
}

impl Pass {
    fn of(rows: Range<usize>, sensor: usize, left: &[f64], finest: f64) -> Self {
        let departures = departures(&left[rows.clone()]);
        let sizes: Vec<f64> = departures.iter().map(|value| value.abs()).collect();
        let usual = deviation(&mut sizes.clone()).max(finest);
        let far: Vec<usize> = (0..sizes.len()).filter(|&row| is_far(&sizes, row, usual)).collect();
        let square = far.iter().map(|&row| sizes[row] * sizes[row]).sum();
        let far = far.into_iter().map(|row| rows.start + row).collect();
        Self { rows, sensor, far, square }
    }

    /// First rows of what stands far out in one go: rows that follow each other tell of one event.
    fn events(&self) -> impl Iterator<Item = usize> {
        let before = std::iter::once(None).chain(self.far.iter().map(|row| Some(*row)));
        let follows = |row: usize, before: Option<usize>| {
            before.is_some_and(|before| row - before <= IN_COMPANY)
        };
        let all = self.far.iter().copied().zip(before);
        all.filter(move |(row, before)| !follows(*row, *before)).map(|(row, _)| row)
    }

    /// Share of its rows that stand far out.
    fn share(&self) -> f64 {
        count(self.far.len()) / count(self.rows.len().max(1))
    }
}

/// Chance that so many of all rows are bad, in noise of the longest tails: far from their neighbours, and
/// from the middle of their pass as others are not, for readings that are smoothed lie near each other.
fn so_many(passes: &[Pass], left: &[f64]) -> f64 {
    let off = |pass: &Pass| {
        let middle = middle(&mut left[pass.rows.clone()].to_vec());
        pass.rows.clone().map(|row| (left[row] - middle).abs()).collect::<Vec<f64>>()
    };
    let off: Vec<Vec<f64>> = passes.iter().map(off).collect();
    let usual = deviation(&mut off.concat());
    let both = passes.iter().zip(&off).map(|(pass, off)| {
        let is_off = |row: &&usize| FAR_OUT * usual < off[**row - pass.rows.start];
        pass.far.iter().filter(is_off).count()
    });
    let (far, rows) = (both.sum(), off.iter().map(Vec::len).sum::<usize>());
    Binomial::new(FAR_IN_TAILS, rows as u64).map_or(1.0, |law| at_least(&law, far))
}

/// Chance that so many follow another within a few rows: gaps between chance events are geometric.
fn in_rows(passes: &[Pass]) -> f64 {
    let followers = passes.iter().map(|pass| {
        let close = pass.far.windows(2).filter(|two| two[1] - two[0] <= IN_COMPANY).count();
        let gaps = pass.far.len().saturating_sub(1);
        let company = 1.0 - libm::pow(1.0 - pass.share(), count(IN_COMPANY));
        (close, count(gaps) * company, gaps)
    });
    let (close, expected, gaps) =
        followers.fold((0, 0.0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1, sum.2 + one.2));
    let law = Binomial::new((expected / count(gaps.max(1))).min(1.0), gaps as u64);
    law.map_or(1.0, |law| at_least(&law, close))
}

/// Chance of so many or more.
fn at_least(law: &impl DiscreteCDF<u64, f64>, number: usize) -> f64 {
    number.checked_sub(1).map_or(1.0, |less| law.sf(less as u64))
}

/// The order at which some turns point one way most clearly, and the chance that any does, against all
/// turns: each of these takes its share off. Rayleigh's test, at every order that samples resolve, of the order
/// alone and with its first harmonics (Z²ₙ of Buccheri et al. 1983, *Search for pulsed γ-ray emission*, Astronomy
/// and Astrophysics 128:245): what stands in a hundredth of a turn has many.
fn at_one_angle(far: &[f64], all: &[f64], highest: f64) -> (f64, f64) {
    let step = 1.0 / (ORDERS_A_WAVE * spread(all).max(f64::MIN_POSITIVE));
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most a few 10⁴"
    )]
    let points = (highest / step).clamp(1.0, MOST_ORDERS) as usize;
    let turns = [far, all].concat();
    let share = count(far.len()) / count(all.len());
    let weights = [vec![1.0; far.len()], vec![-share; all.len()]].concat();
    let sizes = fourier::sizes(&turns, &weights, step, points);
    let power = |place: usize| sizes[place] * sizes[place] / count(far.len());
    let looks = count(points * TOGETHER.len());
    let clearest = |harmonics: u8| {
        let together = |place: usize| {
            (1..=harmonics).map(|harmonic| power(usize::from(harmonic) * place)).sum::<f64>()
        };
        let places = 1..points.div_ceil(usize::from(harmonics));
        let sums = places.map(|place| (step * count(place), together(place)));
        let (order, sum) = sums.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let chance = chi_squared_tail(2.0 * sum, 2.0 * f64::from(harmonics));
        Some((order, (looks * chance).min(1.0)))
    };
    let found: Vec<(f64, f64)> = TOGETHER.into_iter().filter_map(clearest).collect();
    // An order by itself, if that says it, is a harmonic of many.
    let alone = found.iter().copied().find(|(_, chance)| *chance < SIGNIFICANCE);
    let best = alone.or_else(|| found.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)));
    best.unwrap_or((0.0, 1.0))
}

/// Chance that events come as evenly, counted in readings.
fn at_intervals(passes: &[Pass]) -> f64 {
    let events: Vec<f64> = passes.iter().flat_map(Pass::events).map(count).collect();
    let all: Vec<f64> = passes.iter().flat_map(|pass| pass.rows.clone()).map(count).collect();
    at_one_angle(&events, &all, HIGHEST_A_READING).1
}

/// Most waves a reading that readings tell from fewer.
const HIGHEST_A_READING: f64 = 0.5;

/// Harmonics that are asked together, the order itself among them.
const TOGETHER: [u8; 3] = [1, 3, 8];

/// Orders looked at for every one that a record tells from the next: of the eighth harmonic two.
const ORDERS_A_WAVE: f64 = 16.0;

/// Most orders looked at.
const MOST_ORDERS: f64 = 262_144.0;

/// Chance that so many stand where the pass before has one.
fn at_places(problem: &Problem, passes: &[Pass]) -> f64 {
    let place = |row: usize| problem.record.position_mm[problem.samples[row]];
    let (mut met, mut expected) = (0, 0.0);
    for two in passes.windows(2).filter(|two| two[0].sensor == two[1].sensor) {
        let steps = two[0].rows.clone().zip(two[0].rows.clone().skip(1));
        let mut steps: Vec<f64> = steps.map(|(a, b)| (place(b) - place(a)).abs()).collect();
        let near = median(&mut steps);
        for at in two[1].far.iter().map(|row| place(*row)) {
            let is_near = |row: &usize| (place(*row) - at).abs() <= near;
            met += usize::from(two[0].far.iter().any(is_near));
            let rows = two[0].rows.clone().filter(is_near).count();
            expected += 1.0 - libm::pow(1.0 - two[0].share(), count(rows));
        }
    }
    Poisson::new(expected).map_or(1.0, |law| at_least(&law, met))
}

#[cfg(test)]
mod tests {
    use super::super::made_noise::normal;
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StudentT};

    /// Rows of a pass.
    const ROWS: usize = 400;

    fn record(seed: u64, mut noise: impl FnMut(&mut ChaCha8Rng, usize) -> f64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..2 * ROWS).map(|row| noise(&mut random, row)).collect()
    }

    fn two(left: &[f64]) -> Vec<Pass> {
        [0..ROWS, ROWS..2 * ROWS].map(|rows| Pass::of(rows, 0, left, 0.01)).into()
    }

    /// Two passes with some noise.
    fn passes(seed: u64, noise: impl Fn(&mut ChaCha8Rng, usize) -> f64) -> Vec<Pass> {
        two(&record(seed, noise))
    }

    /// Of 300 records hardly more fall below a chance than should.
    fn come_alone(what: &str, noise: impl Fn(&mut ChaCha8Rng, usize) -> f64) {
        let chances: Vec<f64> = (0..300).map(|seed| in_rows(&passes(seed, &noise))).collect();
        for (limit, most) in [(0.01, 10), (1e-3, 4), (1e-5, 0)] {
            let below = chances.iter().filter(|chance| **chance < limit).count();
            assert!(below <= most, "{what}: {below} of 300 below {limit}");
        }
    }

    #[test]
    fn bad_readings_come_alone() {
        let knock =
            |random: &mut ChaCha8Rng| if random.random::<f64>() < 0.03 { 40.0 } else { 0.0 };
        come_alone("knocks", |random, _| knock(random) + normal(random));
        come_alone("tails", |random, _| StudentT::new(2.0).unwrap().sample(random));
        let louder = |row: usize| if (200..300).contains(&row) { 4.0 } else { 1.0 };
        come_alone("louder in places", |random, row| louder(row) * normal(random));
    }

    #[test]
    fn noise_has_few_of_them_and_lost_signs_many() {
        let chance = |left: Vec<f64>| so_many(&two(&left), &left);
        let rarely = |what: &str, chances: Vec<f64>| {
            let below = chances.iter().filter(|chance| **chance < 1e-3).count();
            assert!(below <= 3, "{what}: {below}");
        };
        let tails = |random: &mut ChaCha8Rng, _| StudentT::new(2.0).unwrap().sample(random);
        rarely("tails", (0..300).map(|seed| chance(record(seed, tails))).collect());
        let smoothed = |seed| {
            let mut last = [0.0; 5];
            chance(record(seed, |random, row| {
                last[row % 5] = normal(random);
                last.iter().sum()
            }))
        };
        rarely("smoothed", (0..300).map(smoothed).collect());
        let lost = |random: &mut ChaCha8Rng, row: usize| {
            let sign = if random.random::<f64>() < 0.15 { 1.0 } else { 0.0 };
            sign * 20.0 * libm::sin(count(row) / 30.0) + normal(random)
        };
        assert!((0..10).all(|seed| chance(record(seed, lost)) < 1e-9));
    }

    #[test]
    fn a_burst_comes_together() {
        let burst = |row: usize| if (200..220).contains(&(row % ROWS)) { 40.0 } else { 1.0 };
        for seed in 0..6 {
            let chance = in_rows(&passes(seed, |random, row| burst(row) * normal(random)));
            assert!(chance < 1e-6, "{seed}: {chance}");
        }
    }

    /// Order 1.3 of 60 turns.
    #[test]
    fn one_angle_is_told_from_many_and_from_the_only_one() {
        let places: Vec<f64> = (0..250_u32).map(|row| 0.237 * f64::from(row)).collect();
        let notch = |turn: &&f64| (1.3 * **turn).fract() < 0.12;
        let alike: Vec<f64> = places.iter().filter(notch).copied().collect();
        let (order, chance) = at_one_angle(&alike, &places, 2.0);
        assert!(chance < 1e-6 && (order - 1.3).abs() < 0.01, "{order}: {chance}");
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for _ in 0..100 {
            let some: Vec<f64> =
                places.iter().filter(|_| random.random::<f64>() < 0.12).copied().collect();
            assert!(1e-4 < at_one_angle(&some, &places, 2.0).1);
        }
        let turns: Vec<f64> = (0..250_u32).map(f64::from).collect();
        assert!(0.1 < at_one_angle(&turns[..20], &turns[..20], 0.0).1);
    }
}
