//! Which whole number a wave has, where other ones draw the same curve.

use helixlock_plant::Search;

use crate::hypotheses::whole;
use crate::model::{Problem, State, pattern};
use crate::noise::Whitener;
use crate::numerics::{least_squares, usual_rate};
use crate::policy::evidence::SAME_CURVE;
use crate::policy::extent::WINDOW_FROM;

/// True when one of an effect's nonlinear values is a whole number, and with another one in its range it would draw the
/// same curve at all samples: of 24 even places round a turn eleven waves are thirteen.
#[must_use]
pub(super) fn one_of_several(problem: &Problem, state: &State, index: usize, place: usize) -> bool {
    let component = &state.components[index];
    let parameter = &component.term.parameters[component.term.nonlinear_indices()[place]];
    if parameter.search != Search::Whole {
        return false;
    }
    let whitener = Whitener::new(&problem.layout, &state.fit.noises);
    let own = pattern(problem, state, index, &whitener);
    let size: f64 = own.iter().map(|value| value * value).sum();
    let draws_it = |value: f64| {
        let Ok((design, _)) = component.with_value(place, value).design(problem) else {
            return false;
        };
        let columns: Vec<&[f64]> = design.columns.iter().map(|column| column.as_slice()).collect();
        let columns = whitener.whiten_all(&columns);
        let views: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        least_squares::fit(&views, &own).residual_square < SAME_CURVE * size
    };
    let found = component.term.nonlinear()[place];
    let turns: Vec<f64> = problem.record.turns().collect();
    let rate = usual_rate(&turns);
    let waves = |value| component.with_value(place, value).waves_a_turn(problem);
    // Places tell two waves apart that are fewer together than they are.
    let may_be_one = |value: &f64| WINDOW_FROM * rate < waves(found) + waves(*value);
    let others = whole(*parameter.range.start(), *parameter.range.end());
    let others = others.into_iter().filter(|value| 0.5 < (value - found).abs());
    others.filter(may_be_one).any(draws_it)
}
