//! Means of neighbouring samples, for searches that need not see every one.

use std::collections::BTreeMap;
use std::ops::Range;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Measurement;
use crate::numerics::{count, mean};
use crate::policy::reading::AROUND_REVERSALS;

/// Mean of each group of values.
#[must_use]
pub(crate) fn means(values: &[f64], groups: &[Range<usize>]) -> Vec<f64> {
    groups.iter().map(|rows| mean(&values[rows.clone()])).collect()
}

impl Measurement {
    /// Means of groups of neighbours.
    #[must_use]
    pub(crate) fn averaged(&self, groups: &[Range<usize>]) -> Self {
        let mut samples = self.samples.clone();
        samples.columns_mut().for_each(|values| *values = means(values, groups).into());
        samples.pass = groups.iter().map(|rows| self.pass[rows.start]).collect();
        let observations: BTreeMap<_, _> = self
            .observations
            .iter()
            .map(|(sensor, values)| {
                (*sensor, groups.iter().map(|g| present(&values[g.clone()])).collect())
            })
            .collect();
        Self {
            samples,
            observations,
            deviations: self.deviations.as_deref().map(|told| {
                let of = |rows: &Range<usize>| {
                    let known = told[rows.clone()].iter().filter(|sd| sd.is_finite());
                    let squares: f64 = known.clone().map(|sd| sd * sd).sum();
                    squares.sqrt() / count(known.count())
                };
                groups.iter().map(of).collect()
            }),
            ..self.clone()
        }
    }

    /// One sample of each group of `every` neighbours, drawn by a fixed seed, as a group of one.
    #[must_use]
    pub(crate) fn picks(&self, every: usize) -> Vec<Range<usize>> {
        let mut chance = ChaCha8Rng::seed_from_u64(0);
        let drawn = self.groups(every).into_iter().map(|group| chance.random_range(group));
        drawn.map(|row| row..row + 1).collect()
    }

    /// Groups of `together` neighbours, never across passes or reversals.
    #[must_use]
    pub(crate) fn groups(&self, together: usize) -> Vec<Range<usize>> {
        let single = self.near_reversals(together);
        let mut groups: Vec<Range<usize>> = Vec::new();
        for row in 0..self.len() {
            let joins = groups.last().is_some_and(|rows| {
                rows.len() < together
                    && !single[row]
                    && !single[rows.start]
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

    /// Marks the samples around reversals inside a pass, unless they are a large part of all.
    fn near_reversals(&self, together: usize) -> Vec<bool> {
        let mut near = vec![false; self.len()];
        for row in 1..self.len() {
            let turns = self.direction[row].to_bits() != self.direction[row - 1].to_bits();
            if turns && self.pass[row] == self.pass[row - 1] {
                let to = (row + AROUND_REVERSALS).min(near.len());
                near[row.saturating_sub(AROUND_REVERSALS)..to].fill(true);
            }
        }
        let few = near.iter().filter(|near| **near).count() * together < self.len();
        if few { near } else { vec![false; self.len()] }
    }
}

/// Mean of the cells that are there; NaN of none.
fn present(values: &[f64]) -> f64 {
    let there: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    if there.is_empty() { f64::NAN } else { mean(&there) }
}
