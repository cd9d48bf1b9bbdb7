//! Columns of one least-squares fit, with what is known of their coefficients beforehand.

use helixlock_plant::Column;

use crate::noise::Whitener;
use crate::numerics::{in_parallel, least_squares};

/// Columns of all components, stacked for one least-squares fit.
#[derive(Debug, Clone, Default)]
pub(crate) struct Columns {
    /// Row by row.
    pub(crate) raw: Vec<Column>,
    /// Prior mean and standard deviation, where physics fixes a coefficient.
    pub(crate) priors: Vec<Option<(f64, f64)>>,
    /// What to take off the target first.
    pub(crate) fixed: Option<Column>,
}

/// Columns whitened at once, so that two threads share what a fit has.
const TOGETHER: usize = 8;

impl Columns {
    /// Free columns that belong to no effect.
    #[must_use]
    pub(crate) fn free(raw: impl IntoIterator<Item: Into<Column>>) -> Self {
        let raw: Vec<Column> = raw.into_iter().map(Into::into).collect();
        Self { priors: vec![None; raw.len()], raw, fixed: None }
    }

    /// These columns followed by others.
    #[must_use]
    pub(crate) fn and(&self, more: &Self) -> Self {
        let mut both = self.clone();
        both.raw.extend(more.raw.iter().cloned());
        both.priors.extend(more.priors.iter().copied());
        both.take_off(more.fixed.clone());
        both
    }

    pub(crate) fn take_off(&mut self, fixed: Option<Column>) {
        match (&mut self.fixed, fixed) {
            (Some(sum), Some(more)) => sum.iter_mut().zip(&more).for_each(|(a, b)| *a += b),
            (slot @ None, more) => *slot = more,
            (Some(_), None) => {}
        }
    }

    /// Whitened with one more row a prior, so that plain least squares obeys it.
    #[must_use]
    pub(crate) fn whitened(&self, whitener: &Whitener) -> Vec<Vec<f64>> {
        let together = |part: &[&[f64]]| whitener.whiten_all(part);
        let white = in_parallel(self.views().chunks(TOGETHER), together);
        let mut white: Vec<Vec<f64>> = white.into_iter().flatten().collect();
        self.hold_to_priors(&mut white);
        white
    }

    /// The columns as slices.
    #[must_use]
    pub(crate) fn views(&self) -> Vec<&[f64]> {
        self.raw.iter().map(|column| column.as_slice()).collect()
    }

    /// Lengthens whitened columns by one row a prior.
    pub(crate) fn hold_to_priors(&self, white: &mut [Vec<f64>]) {
        for (index, prior) in self.priors.iter().enumerate() {
            let Some((_, deviation)) = prior else { continue };
            for (other, column) in white.iter_mut().enumerate() {
                column.push(if other == index { 1.0 / deviation } else { 0.0 });
            }
        }
    }

    /// The whitened target with the rows of the priors.
    #[must_use]
    pub(crate) fn target(&self, whitener: &Whitener, residual: &[f64]) -> Vec<f64> {
        let mut left = residual.to_vec();
        if let Some(fixed) = &self.fixed {
            left.iter_mut().zip(fixed.iter()).for_each(|(left, fixed)| *left -= fixed);
        }
        let mut white = whitener.whiten(left);
        white.extend(self.priors.iter().flatten().map(|(mean, deviation)| mean / deviation));
        white
    }

    /// What is left of a residual when the columns weigh so much.
    #[must_use]
    pub(crate) fn left(&self, residual: &[f64], coefficients: &[f64]) -> Vec<f64> {
        let left = least_squares::left(&self.views(), residual, coefficients);
        match &self.fixed {
            Some(fixed) => least_squares::left(&[fixed], &left, &[1.0]),
            None => left,
        }
    }
}
