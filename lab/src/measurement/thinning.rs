//! Means of neighbouring samples, for searches that need not see every one.

use std::collections::BTreeMap;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Measurement;

impl Measurement {
    /// Means of `together` neighbours each, never across passes or reversals.
    #[must_use]
    pub fn averaged(&self, together: usize) -> Self {
        let groups = self.groups(together.max(1));
        let mean = |values: &[f64]| -> Vec<f64> {
            groups
                .iter()
                .map(|rows| values[rows.clone()].iter().sum::<f64>() / crate::count(rows.len()))
                .collect()
        };
        let observations: BTreeMap<_, _> = self
            .observations
            .iter()
            .map(|(sensor, values)| {
                (*sensor, groups.iter().map(|g| present(&values[g.clone()])).collect())
            })
            .collect();
        Self {
            time_s: mean(&self.time_s),
            position_mm: mean(&self.position_mm),
            angle_rev: mean(&self.angle_rev),
            speed_rpm: mean(&self.speed_rpm),
            direction: mean(&self.direction),
            pass: groups.iter().map(|rows| self.pass[rows.start]).collect(),
            observations,
            covariates: self.covariates.iter().map(|(n, v)| (n.clone(), mean(v))).collect(),
            ..self.clone()
        }
    }

    /// One sample of each group of `every` neighbours, drawn by a fixed seed.
    #[must_use]
    pub fn picked(&self, every: usize) -> Self {
        let mut chance = ChaCha8Rng::seed_from_u64(0);
        let rows: Vec<usize> =
            self.groups(every.max(1)).into_iter().map(|group| chance.random_range(group)).collect();
        let pick = |values: &[f64]| rows.iter().map(|&row| values[row]).collect::<Vec<f64>>();
        Self {
            time_s: pick(&self.time_s),
            position_mm: pick(&self.position_mm),
            angle_rev: pick(&self.angle_rev),
            speed_rpm: pick(&self.speed_rpm),
            direction: pick(&self.direction),
            pass: rows.iter().map(|&row| self.pass[row]).collect(),
            observations: self.observations.iter().map(|(s, v)| (*s, pick(v))).collect(),
            covariates: self.covariates.iter().map(|(n, v)| (n.clone(), pick(v))).collect(),
            ..self.clone()
        }
    }

    fn groups(&self, together: usize) -> Vec<std::ops::Range<usize>> {
        let mut groups: Vec<std::ops::Range<usize>> = Vec::new();
        for row in 0..self.len() {
            let joins = groups.last().is_some_and(|rows| {
                rows.len() < together
                    && self.pass[rows.start] == self.pass[row]
                    && self.direction[rows.start].to_bits() == self.direction[row].to_bits()
            });
            match groups.last_mut().filter(|_| joins) {
                Some(rows) => rows.end = row + 1,
                None => groups.push(row..row + 1),
            }
        }
        groups
    }
}

/// Mean of the cells that are there; NaN of none.
fn present(values: &[f64]) -> f64 {
    let there: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    if there.is_empty() { f64::NAN } else { there.iter().sum::<f64>() / crate::count(there.len()) }
}
