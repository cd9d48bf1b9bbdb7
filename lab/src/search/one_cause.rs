//! One cause in the place of two effects.
//!
//! What moves the table shows on the recorder as it does on the thread, of the other sign. Where the catalogue has no
//! such effect, as of a bearing that runs out once a turn, a wave of the grating and one of the workpiece draw it
//! between them. So the curve of each of two effects is put where the sensors show it otherwise than either of them.

use helixlock_plant::Entry;

use super::court::{Court, Winner};
use super::rivals::Rivals;
use crate::hypotheses::Structure;
use crate::model::{Columns, Problem, State};
use crate::numerics::count;
use crate::policy::evidence::MARGIN;

/// The one cause that is farthest ahead of two effects.
#[must_use]
pub(crate) fn one_cause(problem: &Problem, state: &State, found: &[Rivals]) -> Option<Winner> {
    if problem.sensors.len() == 1 {
        return None;
    }
    let court = Court::new(problem, state, found, &[], (0, 0.0));
    let term = |index: usize| &state.components[index].term;
    // Numbers of the file are where they are.
    let is_own =
        |index: &usize| term(*index).nature().is_setting() || term(*index).instead_of.is_some();
    let free: Vec<usize> = (0..state.components.len()).filter(|index| !is_own(index)).collect();
    let all = free.iter().flat_map(|&one| free.iter().map(move |&other| [one, other]));
    let pairs = all.filter(|[one, other]| one < other && term(*one).entry != term(*other).entry);
    let won = pairs.filter_map(|pair| of_both(&court, pair));
    won.max_by(|a, b| a.ahead.total_cmp(&b.ahead))
}

/// The curve of one of two effects, where it is more likely to go in alone than both are where they do.
fn of_both(court: &Court<'_>, pair: [usize; 2]) -> Option<Winner> {
    let (problem, components) = (court.problem, &court.state.components);
    let base = court.without(&pair)?;
    let taken = pair.map(|index| components[index].term.entry);
    let entries = problem.distinct_entries().into_iter().filter(|entry| !taken.contains(entry));
    let places: Vec<(usize, Entry)> =
        entries.flat_map(|entry| pair.map(|index| (index, entry))).collect();
    let ahead = |&(index, entry): &(usize, Entry)| {
        let mut one = components[index].clone();
        one.term.entry = entry;
        let columns = Columns::of(problem, &[one]).ok()?;
        let fit = court.settled(&base.and(&columns));
        let price = court.prices[index].whole() + 2.0 * libm::log(count(places.len()));
        Some((index, entry, court.ahead(&pair, &fit) - price))
    };
    let all = places.iter().filter_map(ahead);
    let (index, entry, ahead) = all.max_by(|a, b| a.2.total_cmp(&b.2))?;
    if ahead <= MARGIN {
        return None;
    }
    let [one, other] = pair.map(|index| components[index].term.name.as_str());
    let curve = &components[index].term.name;
    let shape = format!("one cause with the curve of {curve}, better than {one} and {other}");
    let chance = libm::exp(-0.5 * ahead).min(1.0);
    let shown = Structure::without_place(entry.word(), &shape, court.shown_um(&pair), chance);
    Some(Winner { shown, beaten: pair.to_vec(), ahead })
}
