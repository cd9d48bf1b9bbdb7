//! How far a problem may be thinned without losing what it shows.

use super::lines::gear_orders;
use super::order_spectrum::{Scan, chance};
use crate::model::Problem;
use crate::noise::{Block, Noise, SlowPart, Whitener};
use crate::numerics::{count, deviation, mean, spread, usual_rate};
use crate::policy::chance::FAST_LINE;
use crate::policy::extent::{
    FAST_LINE_ROWS, FAST_LINES, FAST_SAMPLES, PICKED, SAMPLES_A_PERIOD, SLOWEST_WAVES,
};

impl Problem {
    /// The problem on about `most` rows; `None` when it is small enough.
    ///
    /// Means of neighbours, where the fastest line there is allows it; else single samples, one
    /// of each group at a place by a fixed seed, so that what neighbours do not resolve stays
    /// apart from its aliases.
    #[must_use]
    pub(crate) fn thinned(&self, most: usize) -> Option<Self> {
        let together = self.samples.len().div_ceil(most.max(1));
        if together < 2 {
            return None;
        }
        let fastest = self.fastest_line().map_or(0.0, |order| order * SAMPLES_A_PERIOD);
        let turns: Vec<f64> = self.record.turns().collect();
        let allowed = usual_rate(&turns) / fastest.max(f64::MIN_POSITIVE);
        let groups = if count(together) <= allowed {
            self.measurement.groups(together)
        } else {
            let every = self.samples.len().div_ceil(PICKED * most);
            if every < 2 {
                return None;
            }
            self.measurement.picks(every)
        };
        let mut small = self.averaged(groups).ok()?;
        small.extra.clone_from(&self.extra);
        Some(small)
    }

    /// Order of the fastest clear line of any sensor.
    fn fastest_line(&self) -> Option<f64> {
        let sensors = 0..self.sensors.len();
        sensors.filter_map(|sensor| self.fastest_line_of(sensor)).max_by(f64::total_cmp)
    }

    fn fastest_line_of(&self, sensor: usize) -> Option<f64> {
        let of_sensor = |block: &Block| block.sensor == sensor;
        let blocks = self.layout.blocks.iter().filter(|block| of_sensor(block)).count();
        let (mut layout, rows) = self.layout.begun(FAST_LINE_ROWS / blocks.max(1), of_sensor);
        layout.blocks.iter_mut().for_each(|block| block.sensor = 0);
        let left = rows.iter().map(|&row| self.observed[row] - self.predicted[row]);
        let left: Vec<f64> = left.collect();
        let rad = |row: &usize| self.record.spindle_rad[self.samples[*row]];
        let turns: Vec<f64> = rows.iter().map(|row| rad(row) / std::f64::consts::TAU).collect();
        let noises = [fast_noise(&left)];
        let whitener = Whitener::new(&layout, &noises);
        let white = whitener.whiten(left);
        let scan = Scan {
            layout: &layout,
            noises: &noises,
            turns: &turns,
            unit: &vec![1.0; turns.len()],
            whitener: &whitener,
            lowest: SLOWEST_WAVES / spread(&turns).max(f64::MIN_POSITIVE),
            highest: self.highest_order(),
        };
        let orders = gear_orders(&self.model);
        let looks = count(orders.len());
        let clear = |order: &f64| {
            let line = scan.line(&white, *order);
            chance(line.gain, count(white.len()), looks) < FAST_LINE
        };
        let found = scan.lines(&white, FAST_LINE, FAST_LINES);
        let named = orders.into_iter().filter(clear);
        found.iter().map(|line| line.frequency).chain(named).max_by(f64::total_cmp)
    }
}

/// Noise that counts everything slower than a few samples as noise, so that only fast lines show.
fn fast_noise(left: &[f64]) -> Noise {
    let mut steps: Vec<f64> = left.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let deviation = deviation(&mut steps).max(f64::MIN_POSITIVE.sqrt());
    let white = 0.5 * deviation * deviation;
    let mean = mean(left);
    let power = left.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
    let variance = power / count(left.len().max(1));
    Noise { white, slow: vec![SlowPart { variance, length: FAST_SAMPLES }] }
}
