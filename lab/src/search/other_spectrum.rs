//! What an effect's gain is worth when the noise has a spectrum that no white and slow parts make.
//!
//! The mean of the last twelve readings, each of them logged, has lobes and zeros: where it is louder than the fitted
//! noise, a line stands out, and a bump as wide as the mean does. What is left once an effect is taken off, and
//! whitened, tells how far its next value can be foreseen by the last ones; beside that it is white, whatever its
//! spectrum was, and so is what the effect's own curve has to be held against.

use super::uneven::Taken;
use crate::model::Problem;
use crate::noise::Prediction;
use crate::numerics::count;
use crate::numerics::least_squares::dot;
use crate::policy::chance::LOUDEST_LOBE;

/// By what the gain of an effect exceeds the one it has beside the last values; 1 where these tell nothing.
pub(super) fn inflation(problem: &Problem, taken: &Taken) -> f64 {
    let Taken { curve, left } = taken;
    let mut gains = Gains::default();
    for sensor in 0..problem.sensors.len() {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let (curves, lefts): (Vec<&[f64]>, Vec<&[f64]>) =
            blocks.map(|block| (&curve[block.rows.clone()], &left[block.rows.clone()])).unzip();
        gains.add(&curves, &lefts);
    }
    gains.ratio()
}

/// What a whitened curve gains in rows that have enough rows before them, and beside what those tell: times what was
/// measured, and times itself.
#[derive(Default)]
struct Gains {
    white: f64,
    along: f64,
    size: f64,
}

impl Gains {
    /// Adds the passes of one sensor.
    fn add(&mut self, curves: &[&[f64]], lefts: &[&[f64]]) {
        let prediction = Prediction::of(lefts);
        let white = variance(lefts);
        let beside = |passes: &[&[f64]]| -> Vec<Vec<f64>> {
            passes.iter().map(|pass| prediction.beside(pass)).collect()
        };
        let (shown, rest) = (beside(curves), beside(lefts));
        let noise = variance(&rest);
        for ((curve, shown), left) in curves.iter().zip(&shown).zip(&rest) {
            let told = prediction.told(curve);
            self.white += dot(told, told) / white;
            self.size += dot(shown, shown) / noise;
            self.along += (dot(shown, shown) + dot(shown, left)) / noise;
        }
    }

    fn ratio(&self) -> f64 {
        let beside = self.along * self.along.max(0.0) / self.size.max(f64::MIN_POSITIVE);
        (self.white / beside.max(f64::MIN_POSITIVE)).clamp(1.0, LOUDEST_LOBE)
    }
}

/// Mean square.
fn variance<P: AsRef<[f64]>>(passes: &[P]) -> f64 {
    let all = || passes.iter().map(AsRef::as_ref);
    let rows: usize = all().map(<[f64]>::len).sum();
    let square: f64 = all().map(|pass| dot(pass, pass)).sum();
    (square / count(rows.max(1))).max(f64::MIN_POSITIVE)
}
