//! Waves whose frequency changes evenly, over the travel or over time.
//!
//! A band as wide as they fill is what slow noise has too, and is fitted as such. Along a coordinate that is bent,
//! `v = u + κ·(u² − u)` of the part `u` that has gone by, they are a line: so they are looked for as lines are, at
//! every bend.

use super::probes::{Structure, probe};
use super::waves::{Cyclic, cyclic};
use crate::model::{Columns, Fit, Problem};
use crate::numerics::{count, evenly, spread};
use crate::policy::extent::{BENDS, NO_LINE, SETTLED_BENDS, STEEPEST_BEND, WAVES_OF_A_BEND};
use crate::spectrum::{LineSearch, Point, wave};

/// The clearest ones of every sensor.
pub(super) fn chirps(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let sensors = 0..problem.sensors.len();
    let mut axes = cyclic(problem);
    axes.retain(|axis| 0.0 < spread(&axis.values));
    let all = sensors.flat_map(|sensor| axes.iter().map(move |axis| (sensor, axis)));
    all.filter_map(|(sensor, axis)| Search { problem, model, fit, sensor, axis }.clearest())
        .collect()
}

struct Search<'a> {
    problem: &'a Problem,
    model: &'a Columns,
    fit: &'a Fit,
    sensor: usize,
    axis: &'a Cyclic,
}

impl Search<'_> {
    /// The scan puts bends in order; what is told is what the noise, fitted anew, leaves to them.
    fn clearest(&self) -> Option<Structure> {
        let bends = evenly(-STEEPEST_BEND, STEEPEST_BEND, BENDS);
        let along: Vec<_> =
            bends.iter().map(|bend| (self.bent(*bend), self.resolved(*bend))).collect();
        let (problem, fit, sensor) = (self.problem, self.fit, self.sensor);
        let (coordinate, highest) = (&self.axis.values, self.axis.highest);
        let search = LineSearch { problem, fit, sensor, coordinate, highest };
        let peaks = bends.into_iter().zip(search.highest_peaks(&along));
        let mut scanned: Vec<(f64, Point)> =
            peaks.filter_map(|(bend, peak)| Some((bend, peak?))).collect();
        scanned.sort_by(|a, b| b.1.gain.total_cmp(&a.1.gain));
        let likeliest = scanned.iter().take(SETTLED_BENDS);
        let told = likeliest.map(|(bend, point)| self.told(*bend, point.frequency));
        told.min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }

    /// Waves that are no line and that the samples resolve where they are swiftest.
    fn resolved(&self, bend: f64) -> [f64; 2] {
        let swiftest = self.axis.highest * spread(&self.axis.values) / (1.0 + bend.abs());
        let (fewest, most) = (*WAVES_OF_A_BEND.start(), *WAVES_OF_A_BEND.end());
        [fewest.max(NO_LINE / bend.abs()), swiftest.min(most)]
    }

    /// From 0 to 1.
    fn bent(&self, bend: f64) -> Vec<f64> {
        let values = &self.axis.values;
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let range = spread(values);
        let gone_by = values.iter().map(|value| (value - low) / range);
        gone_by.map(|u| u + bend * (u * u - u)).collect()
    }

    fn told(&self, bend: f64, waves: f64) -> Structure {
        let columns = wave(self.problem, self.sensor, &self.bent(bend), waves).raw;
        let (rms_um, chance) = probe(self.problem, self.model, self.fit, &columns);
        let looks = count(BENDS) * 2.0 * WAVES_OF_A_BEND.end();
        let shape = "waves whose frequency changes evenly";
        let told =
            Structure::without_place(self.axis.along, shape, rms_um, (looks * chance).min(1.0));
        told.drawn_by(columns)
    }
}
