//! A model and its noise held fixed while many candidates are tried on what it leaves.

use std::borrow::Cow;

use super::columns::Columns;
use super::problem::Problem;
use crate::noise::{Noise, Whitener};
use crate::numerics::least_squares::{LinearFit, dot};
use crate::numerics::{count, drawn_sizes_gain_with, least_squares};
use crate::policy::chance::MORE_THAN_NOISE;

/// Whitened residual of a model, free of everything the model's columns can explain.
#[derive(Debug)]
pub(crate) struct Stage<'a> {
    /// The rows.
    pub(crate) problem: &'a Problem,
    /// Noise while this stage lasts.
    pub(crate) noises: Vec<Noise>,
    /// Its whitening.
    pub(crate) whitener: Whitener,
    /// Orthonormal whitened columns of the model.
    basis: Vec<Vec<f64>>,
    /// Whitened residual of the model, with the rows of its priors.
    pub(crate) target: Vec<f64>,
    /// Its square.
    square: f64,
}

/// What a candidate takes away under the stage's noise.
#[derive(Debug, Clone)]
pub(crate) struct Gain {
    /// Whitened square taken away: twice the log likelihood ratio.
    pub(crate) gain: f64,
    /// The fit of the candidate's columns, the model's free to give way.
    pub(crate) fit: LinearFit,
}

impl<'a> Stage<'a> {
    /// Sets the stage for a model's columns and a noise.
    #[must_use]
    pub(crate) fn new(problem: &'a Problem, model: &Columns, noises: &[Noise]) -> Self {
        let whitener = Whitener::new(&problem.layout, noises);
        let basis = orthonormal(model.whitened(&whitener));
        let mut target = model.target(&whitener, &problem.residual());
        project(&basis, &mut target);
        let square = dot(&target, &target);
        Self { problem, noises: noises.to_vec(), whitener, basis, target, square }
    }

    /// Gain of a candidate's columns.
    #[must_use]
    pub(crate) fn gain(&self, columns: &Columns) -> Gain {
        self.gain_of(columns, self.whitener.whiten_all(&columns.views()))
    }

    /// Orthonormal whitened vectors of a candidate's columns, or of its fixed part if it has none,
    /// free of what the model can explain.
    #[must_use]
    pub(crate) fn span(&self, columns: &Columns) -> Vec<Vec<f64>> {
        let fixed = columns.fixed.iter().filter(|_| columns.raw.is_empty());
        let views: Vec<&[f64]> =
            columns.views().into_iter().chain(fixed.map(|fixed| fixed.as_slice())).collect();
        orthonormal(self.beside_model(self.whitener.whiten_all(&views)))
    }

    /// Log likelihood of the model with columns whose coefficients are drawn from one normal law
    /// about zero, integrated out; the law's size is the likeliest.
    #[must_use]
    pub(crate) fn with_sizes_of(&self, columns: &Columns) -> f64 {
        self.with_sizes_of_and(columns, &Columns::default())
    }

    /// The same with columns of free sizes as well.
    #[must_use]
    pub(crate) fn with_sizes_of_and(&self, columns: &Columns, free: &Columns) -> f64 {
        let white =
            |columns: &Columns| self.beside_model(self.whitener.whiten_all(&columns.views()));
        let gain = drawn_sizes_gain_with(&white(columns), &self.target, &white(free));
        -0.5 * (self.square - gain + self.whitener.log_determinant())
    }

    /// True when what a fit leaves is no more than the stage's noise: only then are its standard
    /// errors a measure.
    #[must_use]
    pub(crate) fn is_noise(&self, fit: &LinearFit) -> bool {
        fit.residual_square < MORE_THAN_NOISE * count(self.problem.samples.len())
    }

    /// Gains of several candidates, each by itself; their columns are whitened together.
    #[must_use]
    pub(crate) fn gains(&self, candidates: &[&Columns]) -> Vec<Gain> {
        let views: Vec<&[f64]> = candidates.iter().flat_map(|columns| columns.views()).collect();
        let mut white = self.whitener.whiten_all(&views).into_iter();
        let mut own = |columns: &&Columns| white.by_ref().take(columns.raw.len()).collect();
        candidates.iter().map(|columns| self.gain_of(columns, own(columns))).collect()
    }

    /// Whitened columns as long as the target, free of what the model can explain.
    fn beside_model(&self, mut white: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        for column in &mut white {
            column.resize(self.target.len(), 0.0);
            let before = dot(column, column);
            project(&self.basis, column);
            if dot(column, column) <= ROUNDING * before {
                column.fill(0.0);
            }
        }
        white
    }

    fn gain_of(&self, columns: &Columns, white: Vec<Vec<f64>>) -> Gain {
        let mut white = self.beside_model(white);
        columns.hold_to_priors(&mut white);
        let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
        let fit = least_squares::fit(&views, &self.target_for(columns));
        Gain { gain: self.square - fit.residual_square, fit }
    }

    /// The target without a candidate's fixed part, with the rows of its priors.
    fn target_for(&self, columns: &Columns) -> Cow<'_, [f64]> {
        if columns.fixed.is_none() && columns.priors.iter().all(Option::is_none) {
            return Cow::Borrowed(&self.target);
        }
        let mut target = self.target.clone();
        if let Some(fixed) = &columns.fixed {
            let mut white = self.whitener.whiten(fixed.to_vec());
            white.resize(target.len(), 0.0);
            project(&self.basis, &mut white);
            target.iter_mut().zip(&white).for_each(|(value, part)| *value -= part);
        }
        let priors = columns.priors.iter().flatten();
        target.extend(priors.map(|(mean, deviation)| mean / deviation));
        Cow::Owned(target)
    }
}

/// Share of a column's square that is rounding when others have been taken out of it.
const ROUNDING: f64 = 1e-12;

/// Orthonormal vectors that span the columns (modified Gram–Schmidt, done twice).
fn orthonormal(columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let before = dot(&column, &column);
        project(&basis, &mut column);
        project(&basis, &mut column);
        let after = dot(&column, &column);
        if ROUNDING * before < after {
            let scale = 1.0 / after.sqrt();
            for value in &mut column {
                *value *= scale;
            }
            basis.push(column);
        }
    }
    basis
}

/// Takes out of a column what the basis explains.
fn project(basis: &[Vec<f64>], column: &mut [f64]) {
    for direction in basis {
        let along = dot(direction, column);
        column.iter_mut().zip(direction).for_each(|(value, part)| *value -= along * part);
    }
}
