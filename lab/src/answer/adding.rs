//! One effect chosen by the user, fitted together with those the machine file has.

use helixlock_plant::{EffectError, Formula, Term};

use super::diagnosis::{FittedEffect, effects};
use crate::hypotheses::{Trial, as_it_stands, candidate, however_begun, try_candidate};
use crate::model::{
    Columns, Component, Problem, Stage, State, holdout_rms, noises_of, plain_noises,
};
use crate::noise::{Noise, rms};
use crate::numerics::count;
use crate::policy::extent::SEARCHED_ROWS;

/// What a chosen effect does to the error.
#[derive(Debug, Clone)]
pub struct Added {
    /// Effects with their fitted parameters: those refitted first, the new one last.
    pub effects: Vec<FittedEffect>,
    /// Root mean square before and after, µm (arcsec), on the data seen.
    pub rms_um: [f64; 2],
    /// The same on held-out data.
    pub holdout_rms_um: [f64; 2],
    /// Evidence for the effect: twice the log likelihood ratio.
    pub gain: f64,
    /// The same less what its free numbers cost: below 0, noise would give as much.
    pub evidence: f64,
}

/// Fits an effect to a problem, its nonlinear parameters found anew, all coefficients jointly.
///
/// `beside` are effects whose coefficients give way too; the problem's machine must lack them.
/// `None` when the effect has no influence on these data at all.
///
/// # Errors
///
/// [`EffectError`] when a column of data or a section of the machine file is missing, or the effect
/// has a value somewhere that no machine could follow.
pub fn add(problem: &Problem, beside: &[Term], term: &Term) -> Result<Option<Added>, EffectError> {
    problem.design(term)?;
    // Nonlinear values of the catalogue are looked for: what a term begins with is no value.
    if is_own(term) || term.nonlinear().is_empty() {
        problem.must_be_in_reach(term)?;
    }
    let before = State::bare(problem);
    let others: Vec<Component> = beside.iter().cloned().map(Component::new).collect();
    let columns = Columns::of(problem, &others)?;
    let base = State::of(problem, others.clone(), &before.fit.noises).unwrap_or(before);
    let term = &begun(problem, &others, term);
    // Slow noise may follow the effect wherever it lies, and plain noise be taken for it.
    let noises = [plain_noises(problem, &base.fit.left), base.fit.noises.clone()];
    let tried =
        |noises: &[Noise]| joined(problem, &others, found(problem, &columns, noises, term)?);
    let once = noises.iter().filter_map(|noises| tried(noises)).reduce(likelier);
    // The noise that is left tells better where the nonlinear parameters lie.
    let again = once.as_ref().and_then(|once| tried(&once.fit.noises));
    let state = once.into_iter().chain(again).reduce(likelier);
    let numbers = count(term.parameters.len()) * problem.price_of_a_number();
    let starts = |state: &State| state.components.last().map(|one| one.price_of_starts(problem));
    let starts = state.as_ref().and_then(starts).unwrap_or_default();
    let free = numbers + starts;
    Ok(state.map(|state| Added {
        effects: effects(problem, &state),
        rms_um: [rms(&problem.layout, &base.fit.left), rms(&problem.layout, &state.fit.left)],
        holdout_rms_um: [
            holdout_rms(problem, &base.columns, &base.fit.noises),
            holdout_rms(problem, &state.columns, &state.fit.noises),
        ],
        gain: 2.0 * (state.fit.log_likelihood - base.fit.log_likelihood),
        evidence: 2.0 * (state.fit.log_likelihood - base.fit.log_likelihood) - free,
    }))
}

/// A formula of the user's with its nonlinear numbers where they do best on means of neighbouring
/// samples, however far from where they were said to be.
fn begun(problem: &Problem, others: &[Component], term: &Term) -> Term {
    if !is_own(term) || term.nonlinear().is_empty() {
        return term.clone();
    }
    let small = problem.thinned(SEARCHED_ROWS);
    let small = small.as_ref().unwrap_or(problem);
    let best = Columns::of(small, others).ok().and_then(|columns| {
        // Slow noise would follow whatever the formula does not.
        let stage = Stage::new(small, &columns, &vec![Noise::white(); small.sensors.len()]);
        let candidate = candidate(&stage, term.clone())?;
        try_candidate(&stage, &candidate)
    });
    best.map_or_else(|| term.clone(), |trial| trial.component.term)
}

fn likelier(a: State, b: State) -> State {
    if a.fit.log_likelihood < b.fit.log_likelihood { b } else { a }
}

fn is_own(term: &Term) -> bool {
    matches!(term.formula, Formula::Custom(_))
}

fn found(problem: &Problem, columns: &Columns, noises: &[Noise], term: &Term) -> Option<Component> {
    let stage = Stage::new(problem, columns, noises);
    let term = term.clone();
    let resting = if is_own(&term) { as_it_stands(term) } else { candidate(&stage, term)? };
    let trials = however_begun(&stage, resting).filter_map(|one| try_candidate(&stage, &one));
    let worth = |trial: &Trial| trial.gain - trial.component.price(problem);
    trials.max_by(|a, b| worth(a).total_cmp(&worth(b))).map(|trial| trial.component)
}

fn joined(problem: &Problem, others: &[Component], component: Component) -> Option<State> {
    let mut all = others.to_vec();
    all.push(component);
    let noises = vec![Noise::white(); problem.sensors.len()];
    let rough = State::of(problem, all.clone(), &noises)?;
    let noises = noises_of(problem, &rough.fit.left);
    State::of(problem, all, &noises)
}
