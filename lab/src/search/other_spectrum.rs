//! What an effect's gain is worth when the noise has a spectrum that no white and slow parts make.
//!
//! The mean of the last twelve readings, each of them logged, has lobes and zeros: where it is louder than the fitted
//! noise, a line stands out, and a bump as wide as the mean does. What is left once an effect is taken off, and
//! whitened, tells how far its next value can be foreseen by the last ones; beside that it is white, whatever its
//! spectrum was, and so is what the effect's own curve has to be held against.

use super::uneven::taken;
use crate::model::{Columns, Fit, Problem, State};
use crate::noise::{Block, Prediction};
use crate::numerics::count;
use crate::numerics::least_squares::dot;
use crate::policy::chance::LOUDEST_LOBE;

/// By what the gain of an effect exceeds the one it has beside the last values; 1 where these tell nothing.
pub(super) fn inflation(problem: &Problem, now: &State, columns: &Columns, fit: &Fit) -> f64 {
    let [curve, left] = taken(problem, now, columns, fit);
    let mut gain = 0.0;
    let mut beside = Beside::default();
    for sensor in 0..problem.sensors.len() {
        let blocks = || problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let of = |values| -> Vec<&[f64]> { blocks().map(|block| rows_of(values, block)).collect() };
        let (curves, lefts) = (of(&curve), of(&left));
        gain += square(&curves) / variance(&lefts);
        beside.add(&curves, &lefts);
    }
    let then = beside.along * beside.along.max(0.0) / beside.size.max(f64::MIN_POSITIVE);
    (gain / then.max(f64::MIN_POSITIVE)).clamp(1.0, LOUDEST_LOBE)
}

fn rows_of<'a>(values: &'a [f64], block: &Block) -> &'a [f64] {
    &values[block.rows.clone()]
}

/// A curve beside what the last values tell, over the variance of the noise there: times what was measured, and times
/// itself.
#[derive(Default)]
struct Beside {
    along: f64,
    size: f64,
}

impl Beside {
    /// Adds the passes of one sensor.
    fn add(&mut self, curves: &[&[f64]], lefts: &[&[f64]]) {
        let prediction = Prediction::of(lefts);
        let [curves, lefts] = [curves, lefts]
            .map(|passes| passes.iter().map(|pass| prediction.beside(pass)).collect::<Vec<_>>());
        let noise = variance(&lefts);
        for (curve, left) in curves.iter().zip(&lefts) {
            self.size += dot(curve, curve) / noise;
            self.along += (dot(curve, curve) + dot(curve, left)) / noise;
        }
    }
}

fn square<P: AsRef<[f64]>>(passes: &[P]) -> f64 {
    passes.iter().map(|pass| dot(pass.as_ref(), pass.as_ref())).sum()
}

/// Mean square.
fn variance<P: AsRef<[f64]>>(passes: &[P]) -> f64 {
    let rows: usize = passes.iter().map(|pass| pass.as_ref().len()).sum();
    (square(passes) / count(rows.max(1))).max(f64::MIN_POSITIVE)
}
