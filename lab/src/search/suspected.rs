//! Mistakes of input against the effects that were found: what a shifted zero explains with one number,
//! waves explain with two for each.

use super::court::{Court, groups};
use super::polish::polished;
use super::rivals::Rivals;
use crate::doubts::{Doubt, Suspect};
use crate::model::{Problem, State};
use crate::policy::evidence::MARGIN;

/// What mistakes have to say against a model.
#[derive(Debug, Default)]
pub(crate) struct Suspected {
    /// The mistake that is farthest ahead of the effects in whose place it stands.
    pub(crate) doubt: Option<Doubt>,
    /// What explains as much as an effect, by its place in the model.
    pub(crate) witnesses: Vec<(usize, String)>,
}

/// Holds mistakes against the effects of a model, each in the place of one, of several and of all.
#[must_use]
pub(crate) fn suspected(
    problem: &Problem,
    state: &State,
    found: &[Rivals],
    suspects: &[Suspect],
) -> Suspected {
    let court = Court::new(problem, state, found, &[], (0, 0.0));
    let mut said = Suspected::default();
    for suspect in suspects {
        let Some((ahead, group)) = best_group(&court, suspect) else { continue };
        let farthest = said.doubt.as_ref().map_or(MARGIN, |doubt| doubt.evidence);
        if farthest < ahead {
            said.doubt = Some(Doubt { evidence: ahead, ..suspect.doubt.clone() });
        } else if -MARGIN < ahead {
            let says = || suspect.doubt.says.clone();
            said.witnesses.extend(group.into_iter().map(|index| (index, says())));
        }
    }
    said
}

/// By how much a mistake is at best ahead of some effects, and of which.
fn best_group(court: &Court<'_>, suspect: &Suspect) -> Option<(f64, Vec<usize>)> {
    let (problem, state) = (court.problem, court.state);
    let predicted = problem.predicted.iter().zip(&suspect.change).map(|(said, by)| said + by);
    let mended = Problem {
        predicted: predicted.collect::<Vec<f64>>().into(),
        layout: problem.layout.clone(),
        free: problem.free.clone(),
        ..suspect.mended.clone()
    };
    if !mended.has_rows_of(problem) {
        return None;
    }
    let of = |group: Vec<usize>| {
        let fewer = State::settled(&mended, state.without(&group), &state.fit.noises)?;
        let fewer = polished(&mended, fewer);
        Some((court.ahead(&group, &fewer.fit) - suspect.price, group))
    };
    let all = groups(state.components.len()).into_iter().filter(|group| !group.is_empty());
    all.filter_map(of).max_by(|a, b| a.0.total_cmp(&b.0))
}
