//! The equations of the combined readings, for any smoothness of the bar.

use super::super::readings::Combined;
use crate::banded::{Banded, Factor};
use crate::number::number;

/// `z = A·h + noise`, h at every place that a probe touches.
///
/// Where the noise of a sample is in part its neighbour's, that part of the neighbour's equation is
/// taken off each, so that what is left is new at every sample (Cochrane and Orcutt, Journal of the
/// American Statistical Association 44, 1949, 32).
pub(super) struct System<'a> {
    pub(super) z_um: &'a [f64],
    pub(super) combined: &'a Combined,
    /// Coefficients of each sample's equation, by place; their noise is new at each.
    equations: Vec<Vec<(usize, f64)>>,
}

/// The equations with one smoothness weight: `AᵀA + λ·DᵀD`, factored.
pub(super) struct Smooth {
    factor: Factor,
    /// Cost of this smoothness, without the misses: `ln det(AᵀA + λ·DᵀD) − (n − 2)·ln λ`.
    pub(super) cost: f64,
}

impl<'a> System<'a> {
    /// The equations of these readings.
    pub(super) fn new(z_um: &'a [f64], combined: &'a Combined) -> Self {
        let (spacing, r) = (combined.spacing, combined.spacing.ratio());
        let equation = |sample: usize| {
            let here = sample + spacing.total();
            [(here, 1.0), (here - spacing.first, -(1.0 + r)), (sample, r)]
        };
        let correlation = combined.correlation;
        let part = 1.0 / (1.0 - correlation * correlation).sqrt();
        let equations = (0..z_um.len()).map(|sample| match sample.checked_sub(1) {
            Some(last) if correlation != 0.0 => {
                let own = equation(sample).map(|(place, c)| (place, c * part));
                let taken = equation(last).map(|(place, c)| (place, -c * part * correlation));
                [own, taken].concat()
            }
            _ => equation(sample).into(),
        });
        Self { z_um, combined, equations: equations.collect() }
    }

    /// Places that a probe touches.
    pub(super) fn places(&self) -> usize {
        self.z_um.len() + self.combined.spacing.total()
    }

    /// Places the first probe touches lie behind those only the others do.
    pub(super) fn before(&self) -> usize {
        self.combined.spacing.total()
    }

    /// Variance of a mean `z` by the scatter of the runs, µm².
    pub(super) fn variance_of_mean_um2(&self) -> Option<f64> {
        self.combined.variance_of_mean_um2().filter(|variance_um2| 0.0 < *variance_um2)
    }

    /// What the probes see of a form: `A·h`.
    pub(super) fn seen(&self, places_um: &[f64]) -> Vec<f64> {
        let value = |row: &Vec<(usize, f64)>| row.iter().map(|(p, c)| c * places_um[*p]).sum();
        self.equations.iter().map(value).collect()
    }

    /// Mean square of a wave that is not told from the largest that noise alone makes at any of the
    /// frequencies that places tell apart: `a²·g²·n/(4·σ²) = ln(places)`, g the mean gain of the probes.
    pub(super) fn lost_in_noise(&self, noise_um2: f64) -> f64 {
        let r = self.combined.spacing.ratio();
        let gain = 1.0 + (1.0 + r) * (1.0 + r) + r * r;
        2.0 * libm::log(number(self.places())) * noise_um2 / (number(self.z_um.len()) * gain)
    }

    /// The equations with a smoothness weight; `None` when they cannot be solved.
    pub(super) fn smooth(&self, smoothness: f64) -> Option<Smooth> {
        let places = self.places();
        // An equation that has its neighbour's noise taken off reaches a place farther.
        let farther = usize::from(self.combined.correlation != 0.0);
        let mut matrix = Banded::zeros(places - 2, self.combined.spacing.total().max(2) + farther);
        for equation in &self.equations {
            matrix.add_outer(&free(equation, places), 1.0);
        }
        for middle in 1..places - 1 {
            matrix.add_outer(&free(&second_difference(middle), places), smoothness);
        }
        let factor = matrix.factor()?;
        let cost = factor.log_determinant() - number(places - 2) * libm::log(smoothness);
        Some(Smooth { factor, cost })
    }
}

impl Smooth {
    /// The smooth form that fits what is seen: `(AᵀA + λ·DᵀD)⁻¹·Aᵀ·seen`.
    pub(super) fn form(&self, system: &System<'_>, seen: &[f64]) -> Vec<f64> {
        let places = system.places();
        let mut right = vec![0.0; places];
        for (equation, seen) in system.equations.iter().zip(seen) {
            for (place, value) in equation {
                right[*place] += value * seen;
            }
        }
        padded(self.factor.solve(&right[1..places - 1]))
    }

    /// What a smooth form leaves of what is seen; its product with `seen` are the squares with
    /// those of the bends, `‖seen − A·h‖² + λ·‖D²·h‖²`.
    pub(super) fn left(&self, system: &System<'_>, seen: &[f64]) -> Vec<f64> {
        let fitted = system.seen(&self.form(system, seen));
        seen.iter().zip(fitted).map(|(seen, fitted)| seen - fitted).collect()
    }

    /// Column of the inverse: how the form answers to a unit at one place.
    pub(super) fn column(&self, system: &System<'_>, place: usize) -> Vec<f64> {
        let mut unit = vec![0.0; system.places() - 2];
        if let Some(element) = place.checked_sub(1).and_then(|free| unit.get_mut(free)) {
            *element = 1.0;
        }
        padded(self.factor.solve(&unit))
    }
}

fn padded(solved: Vec<f64>) -> Vec<f64> {
    std::iter::once(0.0).chain(solved).chain(std::iter::once(0.0)).collect()
}

fn second_difference(middle: usize) -> [(usize, f64); 3] {
    [(middle - 1, 1.0), (middle, -2.0), (middle + 1, 1.0)]
}

/// A row without the two places held at zero, numbered from the first free one.
fn free(row: &[(usize, f64)], places: usize) -> Vec<(usize, f64)> {
    let is_free = |place: usize| 0 < place && place < places - 1;
    row.iter().filter(|(place, _)| is_free(*place)).map(|(place, c)| (place - 1, *c)).collect()
}
