//! A model and its noise held fixed while many candidates are tried on what it leaves.

use crate::fit::Columns;
use crate::least_squares::{self, LinearFit, dot};
use crate::noise::{Noise, Whitener};
use crate::problem::Problem;

/// Whitened residual of a model, free of everything the model's columns can explain.
#[derive(Debug)]
pub struct Stage<'a> {
    /// The rows.
    pub problem: &'a Problem,
    /// Noise while this stage lasts.
    pub noises: Vec<Noise>,
    /// Its whitening.
    pub whitener: Whitener,
    /// Orthonormal whitened columns of the model.
    basis: Vec<Vec<f64>>,
    /// Whitened residual of the model, with the rows of its priors.
    pub target: Vec<f64>,
}

/// What a candidate takes away under the stage's noise.
#[derive(Debug, Clone)]
pub struct Gain {
    /// Whitened square taken away: twice the log likelihood ratio.
    pub gain: f64,
    /// The fit of the candidate's columns, the model's free to give way.
    pub fit: LinearFit,
}

impl<'a> Stage<'a> {
    /// Sets the stage for a model's columns and a noise.
    #[must_use]
    pub fn new(problem: &'a Problem, model: &Columns, noises: &[Noise]) -> Self {
        let whitener = Whitener::new(&problem.layout, noises);
        let basis = orthonormal(model.whitened(&whitener));
        let mut target = model.target(&whitener, &problem.residual());
        project(&basis, &mut target);
        Self { problem, noises: noises.to_vec(), whitener, basis, target }
    }

    /// Whitened columns of a candidate, free of what the model explains.
    #[must_use]
    pub fn cleared(&self, columns: &Columns) -> Vec<Vec<f64>> {
        let rows = self.problem.rows.len();
        let mut white = columns.whitened(&self.whitener);
        for column in &mut white {
            let priors = column.split_off(rows);
            column.resize(self.target.len(), 0.0);
            project(&self.basis, column);
            column.extend(priors);
        }
        white
    }

    /// Gain of a candidate's columns.
    #[must_use]
    pub fn gain(&self, columns: &Columns) -> Gain {
        let white = self.cleared(columns);
        let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
        let fit = least_squares::fit(&views, &self.target_for(columns));
        Gain { gain: dot(&self.target, &self.target) - fit.residual_square, fit }
    }

    /// The target without a candidate's fixed part, with the rows of its priors.
    #[must_use]
    pub fn target_for(&self, columns: &Columns) -> Vec<f64> {
        let mut target = self.target.clone();
        if let Some(fixed) = &columns.fixed {
            let mut white = self.whitener.whiten(fixed);
            white.resize(target.len(), 0.0);
            project(&self.basis, &mut white);
            target.iter_mut().zip(&white).for_each(|(value, part)| *value -= part);
        }
        let priors = columns.priors.iter().flatten();
        target.extend(priors.map(|(mean, deviation)| mean / deviation));
        target
    }
}

/// Orthonormal vectors that span the columns (modified Gram–Schmidt, done twice).
fn orthonormal(columns: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for mut column in columns {
        let before = dot(&column, &column);
        project(&basis, &mut column);
        project(&basis, &mut column);
        let after = dot(&column, &column);
        if 1e-12 * before < after {
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
