//! What is left beside noise is seen, and noise is not taken for anything.

use std::path::Path;

use helixlock_lab::compare::compare;
use helixlock_lab::diagnosis::{Verdict, diagnose};
use helixlock_lab::measurement::{Measurement, Nominal};
use helixlock_lab::problem::Problem;
use helixlock_plant::Machine;
use helixlock_traces::{Column, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StudentT};

const SAMPLES: u16 = 600;

/// The wavelength is the one the dividers stand for, so the model predicts nothing.
const MACHINE: &str = r#"
[workpiece]
lead = "6 mm"
[spindle]
speed = "6 rpm"
[lead_screw]
lead = "12 mm"
[grating]
lines = 13906
[laser]
wavelength = "0.6328203653099381 um"
[dividers]
a = 110
b = 150
[drive]
step = "0.0125 um"
frequency = "160 Hz"
"#;

/// Three passes of 900 mm, the second backwards, at 6, 6 and 9 turns a minute.
struct Passes {
    columns: Vec<Column>,
}

impl Passes {
    fn new(error_um: &dyn Fn(f64, f64, f64) -> f64, noise: &mut dyn FnMut() -> f64) -> Self {
        let mut columns: Vec<Column> =
            ["pass", "time_s", "position_mm", "direction", "speed_rpm", "error_um"]
                .map(|name| Column { name: name.into(), values: Vec::new() })
                .into();
        let mut start_s = 0.0;
        for (pass, direction, rpm) in [(1.0, 1.0, 6.0), (2.0, -1.0, 6.0), (3.0, 1.0, 9.0)] {
            for row in 0..SAMPLES {
                let travelled_mm = 1.5 * f64::from(row);
                let position_mm = if direction > 0.0 { travelled_mm } else { 898.5 - travelled_mm };
                let time_s = start_s + travelled_mm / (rpm / 10.0);
                let error = error_um(time_s, position_mm, direction) + noise();
                let row = [pass, time_s, position_mm, direction, rpm, error];
                columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
            }
            start_s += 2000.0;
        }
        Self { columns }
    }

    fn problem(self) -> Problem {
        let machine = Machine::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        let table = Table::new(self.columns);
        let measurement = Measurement::from_table(&table, &Nominal::from(&machine));
        Problem::new(&machine, &measurement.expect("a measurement")).expect("no effects")
    }
}

/// Noise that forgets over `length` samples, of 0.1 µm, with as much white noise.
fn noise(seed: u64, length: f64) -> impl FnMut() -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let kept = libm::exp(-1.0 / length);
    let mut slow = 0.0;
    move || {
        let mut normal = || -> f64 { StandardNormal.sample(&mut chance) };
        slow = kept * slow + (1.0 - kept * kept).sqrt() * normal();
        0.1 * (slow + normal())
    }
}

#[test]
fn noise_at_two_speeds_and_in_two_directions_is_noise() {
    for (seed, length) in [(1, 0.1), (2, 5.0), (3, 50.0), (4, 0.1), (5, 10.0)] {
        let compared = compare(&Passes::new(&|_, _, _| 0.0, &mut noise(seed, length)).problem());
        let clearest = &compared.along[0];
        assert!(compared.noise_only, "{length}: {} {}", clearest.along, clearest.p_value);
    }
}

/// It turns its sign with the direction and fades: no two passes show the same.
#[test]
fn a_smooth_error_of_each_pass_s_own_is_not_noise() {
    let turning = |time_s: f64, position_mm: f64, direction: f64| {
        let wave = libm::cos(position_mm / 450.0 * std::f64::consts::TAU);
        1.5 * direction * (1.0 - time_s / 4000.0) * wave
    };
    let diagnosis = diagnose(&Passes::new(&turning, &mut noise(7, 5.0)).problem());
    assert_eq!(diagnosis.verdict, Verdict::Unexplained);
}

/// A kink, and a step at one place of every pass: a cubic with a bump follows the one, a slip in
/// each pass the other, both to within the noise.
#[test]
fn plain_shapes_are_not_named_after_effects_that_imitate_them() {
    let kink = |x: f64| 0.004 * (x - 410.0).max(0.0);
    let step = |x: f64| if x < 450.25 { 0.0 } else { 1.3 };
    let shapes: [(&str, &dyn Fn(f64) -> f64); 2] = [("kink", &kink), ("step", &step)];
    for (name, shape) in shapes {
        let passes = Passes::new(&|_, x, _| shape(x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.problem());
        assert_eq!(diagnosis.verdict, Verdict::Unexplained, "{name}");
        let shapes: Vec<&str> = diagnosis.residual.iter().map(|s| s.shape.as_str()).collect();
        assert!(shapes.iter().any(|shape| shape.starts_with(name)), "{name}: {shapes:?}");
    }
}

/// Slow noise of 0.1 µm with heavy tails (Student's law of three degrees of freedom).
fn heavy_noise(seed: u64, kept: f64) -> impl FnMut() -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let law = StudentT::new(3.0).expect("three degrees of freedom");
    let mut slow = 0.0;
    move || {
        slow = kept * slow + (1.0 - kept * kept).sqrt() * law.sample(&mut chance) / f64::sqrt(3.0);
        0.1 * slow
    }
}

/// A heavy sample of slow noise looks like a slip for a while; in Gaussian noise, what these
/// records hold would be beyond doubt.
#[test]
fn heavy_tails_of_slow_noise_are_no_slips() {
    for seed in [4, 9, 25, 34, 37] {
        let passes = Passes::new(&|_, _, _| 0.0, &mut heavy_noise(seed, 0.98));
        let found = diagnose(&passes.problem());
        let last = &found.rounds[found.rounds.len() - 1];
        let named: Vec<&str> = last.effects.iter().map(|effect| effect.name.as_str()).collect();
        assert!(named.is_empty(), "seed {seed}: {named:?}");
    }
}

/// One fringe lost between two samples, in noise that swings as far and forgets over 50 samples:
/// a few samples beside its place, nothing of it is to be seen.
#[test]
fn a_slip_in_slow_noise_is_found_at_its_sample() {
    let fringe_um = 0.316_410_182_654_969;
    for lost_at in [211.0, 301.0, 401.0, 650.0, 2601.0] {
        let slipped = |t: f64, _: f64, _: f64| if t < lost_at { 0.0 } else { fringe_um };
        let mut chance = ChaCha8Rng::seed_from_u64(3);
        let mut slow = 0.0;
        let mut noise = || {
            let fresh: f64 = StandardNormal.sample(&mut chance);
            slow = 0.98 * slow + 0.04 * fresh;
            slow
        };
        let diagnosis = diagnose(&Passes::new(&slipped, &mut noise).problem());
        let slip = &diagnosis.rounds[diagnosis.rounds.len() - 1].effects;
        let names: Vec<&str> = slip.iter().map(|effect| effect.name.as_str()).collect();
        assert_eq!(names, ["fringe-slip"], "at {lost_at} s");
        let value = |key: &str| slip[0].parameters.iter().find(|p| p.key == key).unwrap().value;
        assert!((value("count").abs() - 1.0).abs() < 0.01);
        assert!((value("time_s") - lost_at).abs() < 2.5, "{} for {lost_at} s", value("time_s"));
    }
}
