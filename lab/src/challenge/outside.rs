//! Shapes that no effect of the catalogue makes.

use std::f64::consts::TAU;

use helixlock_plant::Record;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::numerics::spread;

/// A shape of table motion, of size about 1, with its name.
pub(super) fn shape(record: &Record, chance: &mut ChaCha8Rng) -> (&'static str, Vec<f64>) {
    let length = spread(&record.position_mm).max(1e-9);
    let place = chance.random_range(0.3..0.7);
    let phase = chance.random_range(0.0..TAU);
    let period = chance.random_range(0.05..0.09);
    let share: Vec<f64> = record.position_mm.iter().map(|x| x / length).collect();
    let turns: Vec<f64> = record.turns().collect();
    let over = |shape: &dyn Fn(f64) -> f64| share.iter().map(|&x| shape(x)).collect();
    match chance.random_range(0..5) {
        0 => ("a step at one place", over(&|x| f64::from(u8::from(place < x)))),
        1 => (
            "a wave whose length changes",
            over(&|x| libm::sin(TAU * (3.0 * x + 6.0 * x * x) + phase)),
        ),
        2 => (
            "a sawtooth along the travel",
            over(&|x| 2.0 * (x / period - (x / period).floor()) - 1.0),
        ),
        3 => ("a kink at one place", over(&|x| -4.0 * (x - place).abs())),
        _ => {
            let order = chance.random_range(1.2..1.8);
            (
                "an order no shaft has",
                turns.iter().map(|t| libm::sin(TAU * order * t + phase)).collect(),
            )
        }
    }
}
