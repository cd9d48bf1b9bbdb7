//! How far passes lie apart as a whole, which no model is asked for.
//!
//! Each pass has a zero of its own, so that a drift from run to run is no effect; but a table that is
//! measured again and again at the same places has one zero, and its repeatability is made of just that.

use helixlock_plant::prediction::Sensor;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::samples::Measurement;
use crate::numerics::{count, mean, spread};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::FEWEST_ZEROS;
use crate::policy::reading::ONE_PLACE;

/// Place, direction and value of a reading.
type Reading = (f64, f64, f64);

impl Measurement {
    /// The same with a note where passes over the same places clearly lie apart.
    pub(super) fn with_zeros_told(mut self) -> Self {
        let zeros = self.readings().and_then(|passes| zeros_apart(&passes));
        if let Some(zeros) = zeros {
            let (apart, unit) = (spread(&zeros), self.unit());
            let drift = zeros[zeros.len() - 1] - zeros[0];
            self.notes.push(format!(
                "at the same places the passes lie up to {apart:.3} {unit} apart, the last {drift:.3} \
                 from the first: each has its own zero, which is taken off"
            ));
        }
        self
    }

    /// Readings of each pass by place, where all have the same places each way.
    fn readings(&self) -> Option<Vec<Vec<Reading>>> {
        let values = self.observations.get(&Sensor::Recorder)?;
        let mut passes = vec![Vec::new(); self.pass_names.len()];
        for row in (0..self.len()).filter(|&row| values[row].is_finite()) {
            let reading = (self.angle_rev[row], self.direction[row].signum(), values[row]);
            passes[self.pass[row]].push(reading);
        }
        for pass in &mut passes {
            pass.sort_by(|a: &Reading, b| a.1.total_cmp(&b.1).then(a.0.total_cmp(&b.0)));
        }
        let apart = ONE_PLACE * spread(&self.angle_rev);
        let is_one = |(a, b): (&Reading, &Reading)| (a.0 - b.0).abs() <= apart && 0.0 < a.1 * b.1;
        let is_alike = |pass: &Vec<Reading>| {
            pass.len() == passes[0].len() && pass.iter().zip(&passes[0]).all(is_one)
        };
        passes.iter().all(is_alike).then_some(passes)
    }
}

/// Zeros of passes over the same places, where they differ by more than single readings scatter, and beyond chance.
fn zeros_apart(passes: &[Vec<Reading>]) -> Option<Vec<f64>> {
    let rows = passes.first()?.len();
    if passes.len() < FEWEST_ZEROS || rows < 2 {
        return None;
    }
    let of = |pass: &Vec<Reading>| mean(&pass.iter().map(|one| one.2).collect::<Vec<_>>());
    let zeros: Vec<f64> = passes.iter().map(of).collect();
    let middle = mean(&zeros);
    let left = |row: usize| {
        let usual = mean(&passes.iter().map(|pass| pass[row].2).collect::<Vec<_>>());
        let of_row = passes.iter().zip(&zeros);
        of_row.map(|(pass, zero)| (pass[row].2 - usual - zero + middle).powi(2)).sum::<f64>()
    };
    let between = count(passes.len() - 1);
    let within = between * count(rows - 1);
    let scatter = (0..rows).map(left).sum::<f64>() / within;
    let of_zeros = zeros.iter().map(|zero| (zero - middle).powi(2)).sum::<f64>() / between;
    let law = FisherSnedecor::new(between, within).ok()?;
    let is_clear = 0.0 < scatter && scatter < of_zeros;
    (is_clear && law.sf(count(rows) * of_zeros / scatter) < SIGNIFICANCE).then_some(zeros)
}

#[cfg(test)]
mod tests {
    use helixlock_traces::{Column, Table};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::measurement::Nominal;

    /// Notes of five runs there and back past five targets, each so much higher than the last.
    fn notes(drift_um: f64, step_mm: f64) -> Vec<String> {
        let mut chance = ChaCha8Rng::seed_from_u64(1);
        let rows: Vec<[f64; 4]> = (0..50_u32)
            .map(|visit| {
                let (run, nth) = (f64::from(visit / 10), f64::from(visit % 10));
                let (target, way) = if nth < 5.0 { (nth, 1.0) } else { (9.0 - nth, -1.0) };
                let noise: f64 = StandardNormal.sample(&mut chance);
                let error_um = 20.0 * libm::sin(3.0 * target) + 5.0 * way + drift_um * run + noise;
                [run, 10.0 * target + step_mm * run, way, error_um]
            })
            .collect();
        let column = |(place, name): (usize, &str)| Column {
            name: name.into(),
            values: rows.iter().map(|row| row[place]).collect(),
        };
        let names = ["pass", "position_mm", "direction", "error_um"];
        let table = Table::new(names.into_iter().enumerate().map(column).collect());
        let nominal = Nominal {
            lead_mm: 10.0,
            speed_rpm: 30.0,
            step_um: 0.0,
            rotary: false,
            drive: false,
            closed: false,
        };
        Measurement::from_table(&table, &nominal).expect("a measurement").notes
    }

    #[test]
    fn a_drift_between_runs_is_told_though_it_is_taken_off() {
        let is_told = |notes: &[String]| notes.iter().any(|note| note.contains("its own zero"));
        let told = notes(5.0, 0.0);
        assert!(is_told(&told), "{told:?}");
        assert!(told.iter().any(|note| note.contains("the last 20.")), "{told:?}");
        assert!(!is_told(&notes(0.0, 0.0)), "none");
        assert!(!is_told(&notes(0.3, 0.0)), "no more than single readings scatter");
        assert!(!is_told(&notes(5.0, 1.0)), "other places");
    }
}
