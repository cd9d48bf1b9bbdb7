//! A model with its joint fit.

use super::columns::Columns;
use super::component::Component;
use super::fit::{Fit, noises_of, settle};
use super::problem::Problem;
use crate::noise::{Noise, Whitener};

/// A model found so far, with its fit.
#[derive(Debug, Clone)]
pub(crate) struct State {
    /// Effects in the order they were added.
    pub(crate) components: Vec<Component>,
    /// Their stacked columns.
    pub(crate) columns: Columns,
    /// The joint fit.
    pub(crate) fit: Fit,
}

impl State {
    /// A fit of some components; `None` when one of them cannot be worked out.
    #[must_use]
    pub(crate) fn of(
        problem: &Problem,
        components: Vec<Component>,
        noises: &[Noise],
    ) -> Option<Self> {
        let columns = Columns::of_model(problem, &components).ok()?;
        let fit = settle(problem, &columns, noises);
        Some(Self { components, columns, fit })
    }

    /// The same with the noise looked for from the start as well, whichever is likelier.
    ///
    /// A noise that was only adjusted may be one that suited the model before; against it, the
    /// next effect would look better than it is.
    #[must_use]
    pub(crate) fn settled(
        problem: &Problem,
        components: Vec<Component>,
        noises: &[Noise],
    ) -> Option<Self> {
        let near = Self::of(problem, components, noises)?;
        let anew = settle(problem, &near.columns, &noises_of(problem, &near.fit.left));
        let likelier = near.fit.log_likelihood < anew.log_likelihood;
        Some(if likelier { Self { fit: anew, ..near } } else { near })
    }

    /// It without some of its effects, its noise settled anew.
    #[must_use]
    pub(crate) fn settled_without(&self, problem: &Problem, group: &[usize]) -> Option<Self> {
        Self::settled(problem, self.without(group), &self.fit.noises)
    }

    /// The effects and one more.
    #[must_use]
    pub(crate) fn with(&self, one: &Component) -> Vec<Component> {
        self.components.iter().chain([one]).cloned().collect()
    }

    /// The effects that are in no group.
    #[must_use]
    pub(crate) fn without(&self, group: &[usize]) -> Vec<Component> {
        let all = self.components.iter().enumerate();
        let kept = all.filter(|(index, _)| !group.contains(index));
        kept.map(|(_, component)| component.clone()).collect()
    }

    /// The same effects fitted to other rows of the same measurement.
    ///
    /// The noise begins with what they leave there as they are: begun with what there is without
    /// them, a slow noise may take their place.
    #[must_use]
    pub(crate) fn on(&self, problem: &Problem) -> Option<Self> {
        let columns = Columns::of_model(problem, &self.components).ok()?;
        let left = columns.left(&problem.residual(), &self.fit.linear.coefficients);
        Self::of(problem, self.components.clone(), &noises_of(problem, &left))
    }

    /// The model with nothing added; its noise explains all there is.
    #[must_use]
    pub(crate) fn bare(problem: &Problem) -> Self {
        let columns = problem.free.clone();
        let noises = noises_of(problem, &problem.residual());
        let near = settle(problem, &columns, &noises);
        let fit = if columns.raw.is_empty() {
            near
        } else {
            settle(problem, &columns, &noises_of(problem, &near.left))
        };
        Self { components: Vec::new(), columns, fit }
    }

    /// Coefficients of one component's columns in use, and where they stand in the fit.
    #[must_use]
    pub(crate) fn coefficients(&self, index: usize) -> (&[f64], usize) {
        let from: usize = self.components[..index].iter().map(Component::width).sum();
        (&self.fit.linear.coefficients[from..from + self.components[index].width()], from)
    }
}

/// Whitened pattern of a component at its fitted size, offsets taken out, and what passes began with.
#[must_use]
pub(crate) fn pattern(
    problem: &Problem,
    state: &State,
    index: usize,
    whitener: &Whitener,
) -> Vec<f64> {
    let (coefficients, from) = state.coefficients(index);
    let own = coefficients.len() - state.components[index].starts();
    let mut sum = vec![0.0; problem.samples.len()];
    for (column, weight) in state.columns.raw[from..].iter().zip(&coefficients[..own]) {
        sum.iter_mut().zip(column).for_each(|(value, part)| *value += weight * part);
    }
    whitener.whiten(sum)
}
