//! One pass that is bent as no other is.
//!
//! Noise that is fitted to all passes is as slow and as large as the bent one needs. So passes are
//! held against each other: of each a smooth curve is taken, against what that curve leaves of its
//! own rows, and the largest against the mean of the others, under the noise of those. Noise of any
//! slowness bends all passes alike, and a louder pass is louder beside its curve too.

use helixlock_plant::Column;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::probes::chebyshev;
use crate::model::{Fit, Problem};
use crate::noise::{Block, Layout, Noise, Whitener, fit_noise};
use crate::numerics::least_squares::{self, dot};
use crate::numerics::{count, spread};
use crate::policy::extent::{BENDS_OF_A_PASS, ROWS_BESIDE_A_BEND};

/// A pass unlike the others.
#[derive(Debug)]
pub(super) struct OddPass {
    /// Root mean square of its curve over all rows, µm (arcsec).
    pub(super) rms_um: f64,
    /// Chance that any pass is as much unlike the others.
    pub(super) chance: f64,
    /// What draws its curve.
    pub(super) columns: Vec<Column>,
}

/// The rows of a sensor, with their places and what a fit leaves of them, for curves of an order.
struct Passes {
    order: usize,
    layout: Layout,
    places: Vec<f64>,
    left: Vec<f64>,
}

/// The pass that is least like the others of its sensor; `None` where passes are too few, or too
/// short for a curve.
#[must_use]
pub(super) fn odd_pass(problem: &Problem, fit: &Fit) -> Option<OddPass> {
    let of_sensor = |(sensor, order)| {
        let (layout, rows) = problem.layout.of_sensor(sensor);
        let samples = problem.samples[rows.clone()].iter();
        let places = samples.map(|&sample| problem.record.spindle_rad[sample]).collect();
        let passes = Passes { order, layout, places, left: fit.left[rows.clone()].to_vec() };
        let (odd, chance) = passes.oddest()?;
        let chance = (count(BENDS_OF_A_PASS.len()) * chance).min(1.0);
        let number = problem.samples.len();
        let whole = |part: Vec<f64>| {
            let mut column = vec![0.0; number];
            column[rows.start + odd.rows.start..rows.start + odd.rows.end].copy_from_slice(&part);
            Column::from(column)
        };
        let (square, curve) = passes.curve(odd)?;
        let columns = curve.into_iter().map(whole).collect();
        Some(OddPass { rms_um: (square / count(number)).sqrt(), chance, columns })
    };
    let sensors = 0..problem.sensors.len();
    let asked = sensors.flat_map(|sensor| BENDS_OF_A_PASS.map(|order| (sensor, order)));
    asked.filter_map(of_sensor).min_by(|a, b| a.chance.total_cmp(&b.chance))
}

/// What the curve of a pass takes away, whitened, and what it leaves.
#[derive(Debug, Clone, Copy)]
struct Bend {
    square: f64,
    rest: f64,
    /// Degrees of freedom of what it leaves.
    freedom: f64,
}

impl Passes {
    /// The pass that is least like the others, and the chance that any is as unlike.
    fn oddest(&self) -> Option<(&Block, f64)> {
        let (loudest, _) = self.most_bent(&Noise::white())?;
        let others = |block: &Block| block.pass != self.layout.blocks[loudest].pass;
        let (layout, rows) = self.layout.begun(usize::MAX, others);
        let left: Vec<f64> = rows.iter().map(|&row| self.left[row]).collect();
        let noise = fit_noise(&layout, &left, None).noise;
        let (most, mut bends) = self.most_bent(&noise)?;
        let odd = bends.swap_remove(most);
        (most == loudest).then_some((&self.layout.blocks[most], self.chance(odd, &bends)?))
    }

    /// The bends of all passes under some noise; first the place of the largest against its rest.
    fn most_bent(&self, noise: &Noise) -> Option<(usize, Vec<Bend>)> {
        let blocks = self.layout.blocks.iter();
        let bends: Option<Vec<Bend>> = blocks.map(|block| self.bend(block, noise)).collect();
        let bends = bends?;
        let ratio = |at: usize| bends[at].square / bends[at].rest;
        let most = (0..bends.len()).max_by(|&a, &b| ratio(a).total_cmp(&ratio(b)))?;
        Some((most, bends))
    }

    fn bend(&self, block: &Block, noise: &Noise) -> Option<Bend> {
        let curve = self.shape(block)?;
        let layout = self.layout.stretch(block);
        let whitener = Whitener::new(&layout, std::slice::from_ref(noise));
        let left = whitener.whiten(self.left[block.rows.clone()].to_vec());
        let white = whitener.whiten_all(&curve.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
        let rest = least_squares::fit(&views, &left).residual_square;
        let freedom = count(left.len() - 1 - self.order);
        (0.0 < rest).then(|| Bend { square: dot(&left, &left) - rest, rest, freedom })
    }

    /// Polynomials over the places of a pass; `None` where it has too few rows, or stands.
    fn shape(&self, block: &Block) -> Option<Vec<Vec<f64>>> {
        let places = &self.places[block.rows.clone()];
        let enough = self.order + ROWS_BESIDE_A_BEND < places.len();
        (enough && 0.0 < spread(places)).then(|| chebyshev(places, self.order))
    }

    /// Square of the curve of a pass about its mean, µm², and the curve's polynomials.
    fn curve(&self, block: &Block) -> Option<(f64, Vec<Vec<f64>>)> {
        let shape = self.shape(block)?;
        let level = vec![1.0; block.rows.len()];
        let left = &self.left[block.rows.clone()];
        let views: Vec<&[f64]> = std::iter::once(&level).chain(&shape).map(Vec::as_slice).collect();
        let square = |views: &[&[f64]]| least_squares::fit(views, left).residual_square;
        Some(((square(&views[..1]) - square(&views)).max(0.0), shape))
    }

    /// Chance that the most bent of some passes is as far above the mean of the others, by Fisher's law.
    ///
    /// Each is held against the noise of its rows; where the others are louder than the pass itself, against
    /// theirs. The relative variances of that noise and of the mean add up to the law's.
    fn chance(&self, odd: Bend, others: &[Bend]) -> Option<f64> {
        let sum = |of: fn(&Bend) -> f64| others.iter().map(of).sum::<f64>();
        let (square, rest, freedom) =
            (sum(|one| one.square), sum(|one| one.rest), sum(|one| one.freedom));
        let (own, theirs) = (odd.rest / odd.freedom, rest / freedom);
        let (noise, of_noise) = if own < theirs { (theirs, freedom) } else { (own, odd.freedom) };
        let width = count(self.order);
        let ratio = odd.square / noise / (square / count(others.len()) / theirs);
        let freedom = 1.0 / (1.0 / (width * count(others.len())) + 1.0 / of_noise);
        let law = FisherSnedecor::new(width, freedom).ok()?;
        ratio.is_finite().then(|| (count(others.len() + 1) * law.sf(ratio)).min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal, StudentT};

    /// Chance of the oddest of five passes of 22 rows, by curves of an order, the first with something
    /// more; 1 where none is.
    fn chance_of(
        order: usize,
        mut noise: impl FnMut(bool) -> f64,
        more: impl Fn(f64) -> f64,
    ) -> f64 {
        let places: Vec<f64> = (0..22).map(count).collect();
        let mut left = Vec::new();
        for pass in 0..5 {
            let shown = |place: &f64| if pass == 0 { more(*place) } else { 0.0 };
            left.extend(places.iter().map(|place| noise(*place == 0.0) + shown(place)));
        }
        let block = |pass| Block { sensor: 0, pass, rows: 22 * pass..22 * (pass + 1), loudness: 0 };
        let layout = Layout {
            blocks: (0..5).map(block).collect(),
            clock: (0..110).map(count).collect(),
            inflation: vec![1.0; 110].into(),
        };
        let passes = Passes { order, layout, places: places.repeat(5), left };
        passes.oddest().map_or(1.0, |(_, chance)| chance)
    }

    /// Of 400 records of five passes no more fall below a chance than it says, to three deviations.
    fn is_calibrated(what: &str, mut noise: impl FnMut(&mut ChaCha8Rng, bool) -> f64) {
        for order in BENDS_OF_A_PASS {
            let mut random = ChaCha8Rng::seed_from_u64(1);
            let mut drawn = |_| chance_of(order, |first| noise(&mut random, first), |_| 0.0);
            let chances: Vec<f64> = (0..400).map(&mut drawn).collect();
            for limit in [0.1, 0.01, 1e-3] {
                let below = chances.iter().filter(|chance| **chance < limit).count();
                let most = 400.0 * limit + 3.0 * f64::sqrt(400.0 * limit) + 1.0;
                assert!(count(below) <= most, "{what}, {order}: {below} of 400 below {limit}");
            }
        }
    }

    #[test]
    fn noise_of_any_slowness_bends_all_passes_alike() {
        is_calibrated("white", |random, _| StandardNormal.sample(random));
        is_calibrated("tails", |random, _| StudentT::new(3.0).unwrap().sample(random));
        let mut level = 0.0;
        is_calibrated("a random walk", |random, first| {
            let step: f64 = StandardNormal.sample(random);
            level = if first { step } else { level + step };
            level
        });
        let mut loud = 1.0;
        is_calibrated("louder passes", |random, first| {
            let value: f64 = StandardNormal.sample(random);
            loud = if first { 1.0 + 2.0 * value.abs() } else { loud };
            loud * value
        });
    }

    #[test]
    fn a_run_that_was_cold_is_told() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let bow = |x: f64| 20.0 * libm::sin(x * std::f64::consts::PI / 21.0);
        let chance = chance_of(BENDS_OF_A_PASS[0], |_| StandardNormal.sample(&mut random), bow);
        assert!(chance < 1e-6, "{chance}");
    }

    /// A wave and a bit, even about the middle: no S is in it.
    #[test]
    fn a_run_that_swung_is_told_by_a_curve_that_swings() {
        let swing = |x: f64| 10.0 * libm::cos(2.3 * std::f64::consts::PI * (x / 21.0 - 0.5));
        let [stiff, supple] = BENDS_OF_A_PASS.map(|order| {
            let mut random = ChaCha8Rng::seed_from_u64(3);
            chance_of(order, |_| StandardNormal.sample(&mut random), swing)
        });
        assert!(supple < 1e-6 && 1e-3 < stiff, "{supple} {stiff}");
    }
}
