//! Measurements made in memory: three passes along a machine that has no error of its own.

use std::path::Path;

use helixlock_lab::Problem;
use helixlock_plant::Model;
use helixlock_traces::{Column, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const SAMPLES: u16 = 450;
/// Samples of a pass of which slow shapes are as clear at their size.
const FEW: u16 = 150;

/// The wavelength is the one the dividers stand for, so the model predicts nothing.
pub(crate) const MACHINE: &str = r#"
[workpiece]
lead = "6 mm"
[spindle]
speed = "6 rpm"
[lead_screw]
lead = "12 mm"
[[gear]]
name = "change gear"
order = 2.3
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
pub(crate) struct Passes {
    columns: Vec<Column>,
}

impl Passes {
    pub(crate) fn new(
        error_um: &dyn Fn(f64, f64, f64) -> f64,
        noise: &mut dyn FnMut() -> f64,
    ) -> Self {
        Self::every(898.0 / f64::from(SAMPLES - 1), SAMPLES, error_um, noise)
    }

    /// The same with a sample every 6 mm, for what is slow: it takes a third of the time.
    pub(crate) fn few(
        error_um: &dyn Fn(f64, f64, f64) -> f64,
        noise: &mut dyn FnMut() -> f64,
    ) -> Self {
        Self::every(898.0 / f64::from(FEW - 1), FEW, error_um, noise)
    }

    fn every(
        step_mm: f64,
        samples: u16,
        error_um: &dyn Fn(f64, f64, f64) -> f64,
        noise: &mut dyn FnMut() -> f64,
    ) -> Self {
        let mut columns: Vec<Column> =
            ["pass", "time_s", "position_mm", "direction", "speed_rpm", "error_um"]
                .map(|name| Column { name: name.into(), values: Vec::new() })
                .into();
        let mut start_s = 0.0;
        for (pass, direction, rpm) in [(1.0, 1.0, 6.0), (2.0, -1.0, 6.0), (3.0, 1.0, 9.0)] {
            for row in 0..samples {
                let travelled_mm = step_mm * f64::from(row);
                let position_mm = if direction > 0.0 { travelled_mm } else { 898.0 - travelled_mm };
                let time_s = start_s + travelled_mm / (rpm / 10.0);
                let error = error_um(time_s, position_mm, direction) + noise();
                let row = [pass, time_s, position_mm, direction, rpm, error];
                columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
            }
            start_s += 2000.0;
        }
        Self { columns }
    }

    /// Rows of pass, time in s, travel in mm, direction and error in µm, at one speed.
    pub(crate) fn of_rows(rows: impl Iterator<Item = [f64; 5]>) -> Self {
        let mut columns: Vec<Column> = ["pass", "time_s", "position_mm", "direction", "error_um"]
            .map(|name| Column { name: name.into(), values: Vec::new() })
            .into();
        for row in rows {
            columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
        }
        Self { columns }
    }

    /// With one more column, of what something shows at every time.
    pub(crate) fn logging(mut self, name: &str, of_time_s: &dyn Fn(f64) -> f64) -> Self {
        let times = self.columns.iter().find(|column| column.name == "time_s");
        let values = times.into_iter().flat_map(|times| &times.values).map(|&t| of_time_s(t));
        let values = values.collect();
        self.columns.push(Column { name: name.into(), values });
        self
    }

    pub(crate) fn problem(self) -> Problem {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        super::diagnosed::problem(&machine, &Table::new(self.columns))
    }
}

/// Noise that forgets over `length` samples, of 0.1 µm, with as much white noise.
pub(crate) fn noise(seed: u64, length: f64) -> impl FnMut() -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let kept = libm::exp(-1.0 / length);
    let mut slow = 0.0;
    move || {
        let mut normal = || -> f64 { StandardNormal.sample(&mut chance) };
        slow = kept * slow + (1.0 - kept * kept).sqrt() * normal();
        0.1 * (slow + normal())
    }
}

/// White noise of some standard deviation.
pub(crate) fn white(seed: u64, deviation: f64) -> impl FnMut() -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    move || {
        let normal: f64 = StandardNormal.sample(&mut chance);
        deviation * normal
    }
}
