//! How far a problem may be thinned without losing what it shows.

use crate::candidates::highest_order;
use crate::count;
use crate::measurement::spread;
use crate::noise::{Noise, Whitener};
use crate::order_spectrum::Scan;
use crate::problem::Problem;

/// Mean samples a period of the fastest line that must be kept.
const SAMPLES_A_PERIOD: f64 = 6.0;

/// Chance below which a fast line forbids thinning.
const SIGNIFICANCE: f64 = 1e-6;

impl Problem {
    /// The problem on means of neighbouring samples, at most about `most` rows; `None` when it is
    /// small enough or when lines are too fast for that.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Option<Self> {
        let mut together = self.rows.len().div_ceil(most.max(1));
        if let Some(order) = self.fastest_line().filter(|_| 1 < together) {
            let samples_a_period =
                2.0 * highest_order(&self.record.turns().collect::<Vec<_>>()) / order;
            while 1 < together && samples_a_period < SAMPLES_A_PERIOD * count(together) {
                together -= 1;
            }
        }
        if together < 2 {
            return None;
        }
        let measurement = self.measurement.averaged(together);
        let mut small = Self::new(&self.machine, &measurement).ok()?;
        small.extra.clone_from(&self.extra);
        Some(small)
    }

    /// Order of the fastest clear line of any sensor, as white noise shows it.
    fn fastest_line(&self) -> Option<f64> {
        let residual = self.residual();
        (0..self.sensors.len())
            .filter_map(|sensor| {
                let (layout, rows) = self.of_sensor(sensor);
                let left: Vec<f64> = rows.iter().map(|&row| residual[row]).collect();
                let turns: Vec<f64> = rows
                    .iter()
                    .map(|&row| {
                        self.record.spindle_rad[self.rows[row].sample] / std::f64::consts::TAU
                    })
                    .collect();
                let highest = highest_order(&turns);
                // Differences of neighbours leave only what is fast.
                let fast: Vec<f64> = left
                    .windows(2)
                    .map(|pair| pair[1] - pair[0])
                    .chain(std::iter::once(0.0))
                    .collect();
                let variance = fast.iter().map(|v| v * v).sum::<f64>() / count(fast.len().max(1));
                let noises = [Noise::white().scaled(variance.max(f64::MIN_POSITIVE))];
                let whitener = Whitener::new(&layout, &noises);
                let white = whitener.whiten(&fast);
                let scan = Scan {
                    layout: &layout,
                    noises: &noises,
                    turns: &turns,
                    whitener: &whitener,
                    lowest: 1.5 / spread(&turns).max(f64::MIN_POSITIVE),
                    highest,
                };
                scan.lines(&white, SIGNIFICANCE, 3)
                    .iter()
                    .map(|line| line.frequency)
                    .max_by(f64::total_cmp)
            })
            .max_by(f64::total_cmp)
    }
}
