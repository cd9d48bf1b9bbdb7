//! A scale like the one of document 3, to reproduce its figure and see what limits it.

use std::f64::consts::TAU;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::apply::Spread;
use super::detector::Detector;
use super::table::{Direction, ErrorSample};
use crate::number::number;

/// Errors of a machine scale. The document gives ±5.5 µm before, ±1.0 µm after and 0.1 µm of
/// scatter; how the ±5.5 µm divide is not in it and assumed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelledScale {
    /// Length, mm.
    pub length_mm: f64,
    /// Amplitude of the slow error over the scale, µm.
    pub long_wave_um: f64,
    /// Period of the slow error, mm.
    pub long_wave_mm: f64,
    /// Amplitude of the interpolation error, µm; its period is the pitch.
    pub interpolation_um: f64,
    /// Phase of the interpolation error where a table of 1 mm samples it, rad. At 0 every sample
    /// falls on its zero crossings.
    pub interpolation_phase_rad: f64,
    /// Error forward less error backward, µm.
    pub reversal_um: f64,
    /// Scatter of one sample, standard deviation, µm.
    pub scatter_um: f64,
    /// Seed of the scatter.
    pub seed: u64,
}

/// What is left after compensation when one cause is taken away.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// What was taken away; `nothing` for the whole.
    pub without: &'static str,
    /// Errors that are left.
    pub left: Spread,
}

impl ModelledScale {
    /// Error at a place without scatter, µm.
    #[must_use]
    pub fn error_um(&self, position_mm: f64, direction: Direction, pitch_mm: f64) -> f64 {
        let slow = self.long_wave_um * libm::sin(TAU * position_mm / self.long_wave_mm);
        let fine_phase = TAU * position_mm / pitch_mm + self.interpolation_phase_rad;
        let side = match direction {
            Direction::Forward => 0.5,
            Direction::Backward => -0.5,
        };
        slow + self.interpolation_um * libm::sin(fine_phase) + side * self.reversal_um
    }

    /// Samples every `step_mm`, both ways, as the detector sees them; `run` varies the scatter.
    #[must_use]
    pub fn samples(&self, step_mm: f64, detector: &Detector, run: u64) -> Vec<ErrorSample> {
        let mut chance = ChaCha8Rng::seed_from_u64(self.seed);
        chance.set_stream(run);
        let steps = (self.length_mm / step_mm + 1e-9).floor();
        let places = (0..).map(number).take_while(move |index| *index <= steps);
        let places: Vec<f64> = places.map(|index| index * step_mm).collect();
        let mut samples = Vec::with_capacity(2 * places.len());
        for direction in [Direction::Forward, Direction::Backward] {
            for &position_mm in &places {
                let scatter: f64 = StandardNormal.sample(&mut chance);
                let true_um = self.error_um(position_mm, direction, detector.pitch_mm);
                let seen = detector.code(true_um + scatter * self.scatter_um);
                let error_um = detector.difference_um(seen);
                samples.push(ErrorSample { position_mm, error_um, direction });
            }
        }
        samples
    }
}

/// Where a budget looks, and what it takes away.
#[derive(Clone, Copy)]
struct Chain {
    /// Distance of the table's places, mm.
    table_step_mm: f64,
    /// Weight of the table's least bit, µm; zero for a table without bits.
    lsb_um: f64,
    /// Step of the corrector, µm; zero for none.
    corrector_um: f64,
}

/// Finds the errors left between the places of a table too, and again with each cause taken away.
///
/// The table comes from one run of the scale; the errors are those of another run, sampled 20
/// times denser than the table, both ways. `corrector_um` is one step of the corrector.
#[must_use]
pub fn residual_budget(
    scale: &ModelledScale,
    detector: &Detector,
    table_step_mm: f64,
    corrector_um: f64,
) -> Vec<Residual> {
    let whole = Chain { table_step_mm, lsb_um: detector.lsb_um, corrector_um };
    let quiet = ModelledScale { scatter_um: 0.0, ..*scale };
    let even = ModelledScale { interpolation_um: 0.0, ..*scale };
    let cases = [
        ("nothing", *scale, whole),
        ("scatter", quiet, whole),
        ("8-bit steps", *scale, Chain { lsb_um: 0.0, ..whole }),
        ("corrector steps", *scale, Chain { corrector_um: 0.0, ..whole }),
        ("interpolation error of the scale", even, whole),
        (
            "table step (ten times denser)",
            *scale,
            Chain { table_step_mm: table_step_mm / 10.0, ..whole },
        ),
    ];
    let pitch_mm = detector.pitch_mm;
    let residual = |(without, scale, chain): (_, ModelledScale, Chain)| {
        let left = Spread::of(&left_um(&scale, pitch_mm, chain, table_step_mm / 20.0));
        Residual { without, left }
    };
    cases.into_iter().map(residual).collect()
}

/// Errors left at every `check_mm`, forward and backward.
fn left_um(scale: &ModelledScale, pitch_mm: f64, chain: Chain, check_mm: f64) -> Vec<f64> {
    let mut chance = ChaCha8Rng::seed_from_u64(scale.seed);
    let mut left_um = Vec::new();
    for direction in [Direction::Forward, Direction::Backward] {
        let mut seen = |position_mm: f64| {
            let scatter: f64 = StandardNormal.sample(&mut chance);
            scale.error_um(position_mm, direction, pitch_mm) + scatter * scale.scatter_um
        };
        let steps = (scale.length_mm / chain.table_step_mm + 1e-9).floor();
        let table = (0..).map(number).take_while(|index| *index <= steps);
        let table: Vec<f64> =
            table.map(|index| rounded(seen(index * chain.table_step_mm), chain.lsb_um)).collect();
        let checks = (scale.length_mm / check_mm + 1e-9).floor();
        for index in (0..).map(number).take_while(|index| *index <= checks) {
            let position_mm = index * check_mm;
            let place = nearest(position_mm / chain.table_step_mm, table.len());
            left_um.push(seen(position_mm) - rounded(table[place], chain.corrector_um));
        }
    }
    left_um
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place of the table")]
fn nearest(index: f64, places: usize) -> usize {
    (index.round().max(0.0) as usize).min(places - 1)
}

fn rounded(value_um: f64, unit_um: f64) -> f64 {
    if 0.0 < unit_um { (value_um / unit_um).round() * unit_um } else { value_um }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::{LookUp, Scheme, TableRule, apply, build_table};

    /// A scale as poor as the document's, whose interpolation error the 1 mm table cannot see.
    fn scale() -> ModelledScale {
        ModelledScale {
            length_mm: 250.0,
            long_wave_um: 4.7,
            long_wave_mm: 400.0,
            interpolation_um: 0.55,
            interpolation_phase_rad: 0.0,
            reversal_um: 0.4,
            scatter_um: 0.1,
            seed: 3,
        }
    }

    const DETECTOR: Detector = Detector { pitch_mm: 2.0, lsb_um: 0.1 };

    #[test]
    fn before_and_after_are_those_of_the_document() {
        let before = Spread::of(
            &scale().samples(0.05, &DETECTOR, 0).iter().map(|s| s.error_um).collect::<Vec<_>>(),
        );
        let budget = residual_budget(&scale(), &DETECTOR, 1.0, 0.1);
        assert!((before.largest_um - 5.5).abs() < 0.4, "{before:?}");
        assert!((budget[0].left.largest_um - 1.0).abs() < 0.15, "{budget:?}");
        let best = budget[1..].iter().min_by(|a, b| a.left.rms_um.total_cmp(&b.left.rms_um));
        assert_eq!(best.map(|r| r.without), Some("interpolation error of the scale"), "{budget:?}");
    }

    /// Second implementation of the same chain: bytes in a table, looked up and applied.
    #[test]
    fn the_budget_agrees_with_the_real_table() {
        let samples = scale().samples(1.0, &DETECTOR, 1);
        let rule = TableRule { step_mm: 1.0, lsb_um: 0.1, joints: None };
        let table = build_table(&samples, &rule).unwrap();
        let fine = Detector { lsb_um: 0.001, ..DETECTOR };
        let check: Vec<ErrorSample> = scale()
            .samples(0.05, &Detector { lsb_um: 0.1, ..fine }, 2)
            .into_iter()
            .map(|sample| ErrorSample {
                error_um: scale().error_um(sample.position_mm, sample.direction, 2.0),
                ..sample
            })
            .collect();
        let left = apply(&table, &check, Scheme::Step { step_um: 0.1 }, LookUp::Nearest);
        let left = Spread::of(&left.iter().map(|one| one.left_um).collect::<Vec<_>>());
        let budget = residual_budget(&scale(), &DETECTOR, 1.0, 0.1);
        // The budget's check run scatters too: 0.1 µm more, in squares.
        let expected = (left.rms_um * left.rms_um + 0.01).sqrt();
        assert!((budget[0].left.rms_um - expected).abs() < 0.03, "{expected} {budget:?}");
    }

    #[test]
    fn a_phase_of_a_quarter_period_is_seen_by_the_table_and_overcorrected() {
        let seen = ModelledScale { interpolation_phase_rad: TAU / 4.0, ..scale() };
        let (hidden, seen) = (
            residual_budget(&scale(), &DETECTOR, 1.0, 0.1),
            residual_budget(&seen, &DETECTOR, 1.0, 0.1),
        );
        // Sampled at its tops, the error is taken off at the tops only: it is aliased, not gone.
        assert!(0.7 * hidden[0].left.rms_um < seen[0].left.rms_um, "{hidden:?} {seen:?}");
    }
}
