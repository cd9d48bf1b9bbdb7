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
use rand_distr::{Distribution, StandardNormal};

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
