//! Likenesses that physics knows beforehand, whatever the evidence says of them.

use std::ops::Range;

use helixlock_plant::prediction::gain;
use helixlock_plant::units::Unit;
use helixlock_plant::{CATALOGUE, Entry, Role, Search, Term};

use crate::model::{Component, Problem, State, pattern};
use crate::noise::{Block, Whitener, about_means};
use crate::numerics::least_squares::dot;
use crate::numerics::{count, least_squares, mean, middle, resolves, spread};
use crate::policy::evidence::{
    HIGH_HARMONIC_PRICE, OF_THE_FILE_PRICE, OTHER_TARGETS, SHAPE, WAVE, WAVES_IN_TIME,
};
use crate::policy::extent::{FEWEST_TARGETS, MOST_OF_A_TURN, ROWS_A_COLUMN, RUN_IN};
use crate::policy::reading::REVERSAL_REACH;

/// True for a high harmonic, such as one of the machine's screw, of which the lower ones are not in
/// the model; a shaft that the machine file lists runs out once a turn.
#[must_use]
pub(crate) fn high_harmonic_alone(component: &Component, others: &[Component]) -> bool {
    let term = &component.term;
    let Some(high) = term.nature().high_harmonic.filter(|_| term.instead_of.is_none()) else {
        return false;
    };
    term.nonlinear().first().is_some_and(|harmonic| high <= *harmonic)
        && !others.iter().any(|other| {
            other.term.kind() == term.kind() && other.term.nonlinear() != term.nonlinear()
        })
}

/// Evidence an effect has to pay for being unlikely beforehand.
#[must_use]
pub(crate) fn price(component: &Component, others: &[Component]) -> f64 {
    match component.term.instead_of {
        Some(_) => OF_THE_FILE_PRICE,
        None if high_harmonic_alone(component, others) => HIGH_HARMONIC_PRICE,
        None => 0.0,
    }
}

/// True when a rival is no match for an effect by physics alone: the harmonic of the screw that a
/// listed shaft happens to coincide with.
#[must_use]
pub(crate) fn far_fetched(rival: &Component, own: &Component, others: &[Component]) -> bool {
    own.term.is_of_a_gear() && high_harmonic_alone(rival, others)
}

/// Effects that look like one of a model by physics, though none was fitted to the data.
#[must_use]
pub(crate) fn by_physics(problem: &Problem, state: &State, index: usize) -> Vec<String> {
    let component = &state.components[index];
    let mut alike = Vec::new();
    if is_slope(problem, state, index) {
        alike.extend(slopes_like(problem, component));
    }
    if slips_at_reversal(problem, component) {
        let cards = CATALOGUE.iter().filter(|card| card.nature.at_reversal);
        alike.extend(cards.map(|card| card.kind.to_owned()));
    }
    alike
}

/// True when the fitted pattern is a straight line over the spindle's turns, so that it has no
/// shape.
///
/// Known physics and whole numbers are exempt: their size is evidence of its own.
pub(super) fn is_slope(problem: &Problem, state: &State, index: usize) -> bool {
    let component = &state.components[index];
    let sized = component.term.parameters.iter().any(|w| matches!(w.role, Role::Known { .. }));
    if sized || !component.term.needs().is_empty() || component.term.nature().is_setting() {
        return false;
    }
    let whitener = Whitener::new(&problem.layout, &state.fit.noises);
    let shape = pattern(problem, state, index, &whitener);
    let line = problem.column(component.term.entry, &problem.record.spindle_rad);
    let line = whitener.whiten(line);
    let fit = least_squares::fit(&[&line], &shape);
    fit.residual_square < SHAPE * dot(&shape, &shape)
}

/// Effects of the card's list that are straight in travel and that these sensors see alike.
fn slopes_like(problem: &Problem, component: &Component) -> Vec<String> {
    let cards = Term::card(component.term.kind()).map_or(&[][..], |card| card.confused_with);
    cards
        .iter()
        .filter_map(|kind| Term::card(kind))
        .filter(|card| problem.model.lacks(card.parts).is_none())
        .filter(|card| seen_alike(problem, component.term.entry, card.entry))
        .map(|card| card.kind.to_owned())
        .collect()
}

/// True when no sensor tells two entries apart: their gains differ by one factor.
fn seen_alike(problem: &Problem, a: Entry, b: Entry) -> bool {
    let gains = |entry| {
        let of = |&sensor| gain(&problem.model, entry, sensor);
        problem.sensors.iter().map(of).collect::<Vec<f64>>()
    };
    let (a, b) = (gains(a), gains(b));
    let (size, along) = (dot(&a, &a) * dot(&b, &b), dot(&a, &b));
    0.0 < size && (1.0 - 1e-9) * size < along * along
}

/// True for a slip where the table turns back, or within the turn of spindle and screw behind, over
/// which play is taken up.
fn slips_at_reversal(problem: &Problem, component: &Component) -> bool {
    let Some(at) = component.term.parameters.iter().position(|w| w.search == Search::Time) else {
        return false;
    };
    let (time, record) = (component.term.values[at], &problem.record);
    let near = record.time_s.partition_point(|t| *t < time);
    let turn_mm = problem.model.workpiece.lead.mm();
    let turn_mm = problem.model.lead_screw.map_or(turn_mm, |lead| turn_mm.max(lead.mm()));
    let way_mm = record.since_reversal_mm.get(near).copied().unwrap_or(f64::INFINITY);
    if !problem.model.rotary && way_mm < turn_mm {
        return true;
    }
    let window = near.saturating_sub(REVERSAL_REACH)..(near + REVERSAL_REACH).min(record.len());
    let passes = record.pass[window.clone()].windows(2).all(|p| p[0] == p[1]);
    passes && 0.0 < spread(&record.direction[window])
}

/// True unless a play is so wide that none of the motor's moves gets through it: a loop that made
/// them has seen what they do.
#[must_use]
pub(crate) fn lets_motion_through(problem: &Problem, component: &Component) -> bool {
    let steps = problem.measurement.covariates.get("steps");
    let (true, Some(steps)) = (component.term.nature().play, steps) else {
        return true;
    };
    let moved_um = spread(steps) * problem.model.drive.step_um;
    component.term.nonlinear().iter().all(|width_um| *width_um < moved_um)
}

/// True unless a wave shows so small a part of itself each time the table moves one way that it is
/// a piece of a parabola there: that is any drift, or what differs from one way to the next.
///
/// Of a wave faster than the samples it is what they show that counts.
#[must_use]
pub(crate) fn turns_enough(problem: &Problem, component: &Component, used: &[f64]) -> bool {
    if component.term.parameters.iter().all(|what| what.role != Role::Amplitude) {
        return true;
    }
    let Some(shown) = component.shown_um(problem, used) else { return false };
    let shape = about_means(&problem.layout, &shown);
    let beyond = |rows: Range<usize>| beyond_a_parabola(problem, &shape[rows.clone()], rows);
    let left: f64 = legs(problem).into_iter().map(beyond).sum();
    WAVE * dot(&shape, &shape) < left
}

/// True unless an effect of one moment has so few rows of its pass before or behind it that they
/// tell how a pass begins or ends, and no level that it came from or went to; unless it tilts other
/// passes, too, before or behind it.
#[must_use]
pub(crate) fn has_both_sides(problem: &Problem, component: &Component, used: &[f64]) -> bool {
    let term = &component.term;
    let moments = term.nonlinear_indices();
    let mut moments = moments.iter().filter(|&&i| term.parameters[i].search == Search::Time);
    moments.all(|&index| {
        let at_s = term.values[index];
        RUN_IN <= smaller_share(problem, at_s) || parts_passes(problem, component, used, at_s)
    })
}

/// True when passes lie before and behind a moment, but for the rows that they run in or out by, and its effect shows
/// in others than the one that it is in.
fn parts_passes(problem: &Problem, component: &Component, used: &[f64], at_s: f64) -> bool {
    let Some(shown) = component.shown_um(problem, used) else { return false };
    let shape = about_means(&problem.layout, &shown);
    let passes: Vec<(Range<usize>, f64)> = shares_before(problem, at_s).collect();
    let others = passes.iter().filter(|(_, before)| [0.0, 1.0].contains(before));
    let elsewhere: f64 =
        others.map(|(rows, _)| dot(&shape[rows.clone()], &shape[rows.clone()])).sum();
    passes.iter().any(|(_, before)| *before < RUN_IN)
        && passes.iter().any(|(_, before)| 1.0 - RUN_IN < *before)
        && WAVE * dot(&shape, &shape) < elsewhere
}

/// Share of a pass on the smaller side of a moment in it; 0 of a moment between two passes.
fn smaller_share(problem: &Problem, at_s: f64) -> f64 {
    let shares = shares_before(problem, at_s).map(|(_, before)| before.min(1.0 - before));
    shares.fold(0.0, f64::max)
}

/// Rows of each pass, and the share of them before a moment.
fn shares_before(problem: &Problem, at_s: f64) -> impl Iterator<Item = (Range<usize>, f64)> + '_ {
    let time = |row: usize| problem.record.time_s[problem.samples[row]];
    problem.layout.blocks.iter().map(move |block| {
        let rows = block.rows.clone();
        let before = rows.clone().filter(|&row| time(row) < at_s).count();
        (rows, count(before) / count(block.rows.len().max(1)))
    })
}

/// Rows of each sensor from one turn of the table, or pass, to the next.
fn legs(problem: &Problem) -> Vec<Range<usize>> {
    let direction = |row: usize| problem.record.direction[problem.samples[row]];
    let blocks = problem.layout.blocks.iter();
    let of_block = |block: &Block| {
        let mut legs: Vec<Range<usize>> = Vec::new();
        for row in block.rows.clone() {
            match legs.last_mut() {
                Some(leg) if same(direction(leg.start), direction(row)) => leg.end = row + 1,
                _ => legs.push(row..row + 1),
            }
        }
        legs
    };
    blocks.flat_map(of_block).collect()
}

/// True for one direction.
fn same(one: f64, other: f64) -> bool {
    0.0 < one * other
}

/// Square of what a parabola over the travel and the time leaves of some rows' values; of rows so
/// few that it would follow anything, all of it.
fn beyond_a_parabola(problem: &Problem, values: &[f64], rows: Range<usize>) -> f64 {
    if values.len() < 2 * ROWS_A_COLUMN {
        return dot(values, values);
    }
    let samples = &problem.samples[rows];
    let (angle, time) = (&problem.record.spindle_rad, &problem.record.time_s);
    let axes = [angle, time].map(|axis| {
        let values: Vec<f64> = samples.iter().map(|&sample| axis[sample]).collect();
        let mean = mean(&values);
        values.into_iter().map(|value| value - mean).collect::<Vec<f64>>()
    });
    let squares = axes.each_ref().map(|axis| axis.iter().map(|v| v * v).collect::<Vec<f64>>());
    let level = vec![1.0; values.len()];
    let columns = [&level, &axes[0], &axes[1], &squares[0], &squares[1]];
    let views: Vec<&[f64]> = columns.map(Vec::as_slice).to_vec();
    least_squares::fit(&views, values).residual_square
}

/// True unless a frequency in time was found where no clock tells of it: times that were not measured, or less
/// than three waves in all passes that one clock went through, without their pauses, or in every pass by itself.
#[must_use]
pub(crate) fn by_the_clock(problem: &Problem, component: &Component) -> bool {
    let term = &component.term;
    let places = term.nonlinear_indices();
    let Some(&hertz) = places.iter().find(|&&index| term.parameters[index].is_frequency()) else {
        return true;
    };
    let record = &problem.record;
    let seconds = record.passes().into_iter().map(|rows| spread(&record.time_s[rows]));
    let all_s: f64 = if problem.measurement.tells_pauses() {
        seconds.sum()
    } else {
        seconds.fold(0.0, f64::max)
    };
    problem.measurement.timed && WAVES_IN_TIME <= all_s * term.values[hertz]
}

/// True unless an effect runs by the clock where nobody measured it and the axis stands at targets, or between
/// passes: the time that follows from the travel is none then. What happens at a moment, or is forgotten within a
/// pass, knows nothing of the pauses between them, nor does what drifts evenly by a clock that begins anew with each.
#[must_use]
pub(crate) fn has_its_time(problem: &Problem, component: &Component) -> bool {
    let measurement = &problem.measurement;
    let units = || component.term.parameters.iter().map(|what| &what.unit);
    let by_time = units().any(Unit::is_of_time);
    let stands = !measurement.timed && problem.places().is_some();
    let is_even = measurement.timed && units().all(|one| !one.is_of_time() || one.is_of_drift());
    let goes_on = component.goes_on_with_time() && !is_even;
    !(by_time && stands || goes_on && !measurement.tells_pauses())
}

/// True unless all samples lie at a few places that do not tell a wave over the travel from a longer
/// one, as even ones with less than two in a wave: what it shows there is each target's own.
#[must_use]
pub(crate) fn resolved(problem: &Problem, component: &Component) -> bool {
    if component.term.parameters.iter().all(|what| what.role != Role::Amplitude) {
        return true;
    }
    let Some(turns) = problem.places() else { return true };
    resolves(&turns, component.waves_a_turn(problem))
}

/// True where all samples lie at a few places, and an effect is at one of them what it is at no other:
/// every curve that is narrow enough passes there.
#[must_use]
pub(crate) fn at_one_target(problem: &Problem, component: &Component, used: &[f64]) -> bool {
    let Some(targets) = problem.places().filter(|all| FEWEST_TARGETS <= all.len()) else {
        return false;
    };
    let Some(shown) = component.shown_um(problem, used) else { return false };
    let visited = problem.visited(&targets);
    let mut of_targets = vec![Vec::new(); targets.len()];
    for (value, &sample) in shown.iter().zip(&problem.samples) {
        of_targets[visited[sample]].push(*value);
    }
    let about = |part: &[f64], level: f64| -> f64 {
        part.iter().map(|value| (value - level) * (value - level)).sum()
    };
    let usual = middle(&mut shown.clone());
    let far = |at: &usize| (mean(&of_targets[*at]) - usual).abs();
    let Some(at) = (0..of_targets.len()).max_by(|a, b| far(a).total_cmp(&far(b))) else {
        return false;
    };
    let own = of_targets.swap_remove(at);
    let others = of_targets.concat();
    let (here, level) = (mean(&own), mean(&others));
    let elsewhere = about(&own, here) + about(&others, level);
    elsewhere < OTHER_TARGETS * count(own.len()) * (here - level) * (here - level)
}

/// True unless an effect is one of whole waves a turn of a part of which the record has not nearly a
/// whole turn, or of a mesh of which it has not nearly a whole wave: waves of any length follow it there.
#[must_use]
pub(crate) fn turns_once(problem: &Problem, component: &Component) -> bool {
    let term = &component.term;
    let listed = term.parameters.iter().position(|what| what.search == Search::Whole);
    let listed = listed.map(|place| term.values[place]);
    let once = term.is_of_a_gear().then_some(1.0);
    let Some(harmonic) = listed.or(term.nature().every_turn).or(once) else { return true };
    let mut turns: Vec<f64> = problem.record.turns().collect();
    turns.sort_by(f64::total_cmp);
    turns.dedup();
    // Places at even steps all around end a step short of the turn.
    let step = spread(&turns) / count(turns.len().max(2) - 1);
    let part_turns = component.waves_a_turn(problem) / harmonic * (spread(&turns) + step);
    MOST_OF_A_TURN < part_turns
}

/// True when a bump lies inside the travel with both its flanks: half a bump is any curve.
#[must_use]
pub(crate) fn shows_both_flanks(problem: &Problem, component: &Component) -> bool {
    let of = |search, unit: &str| {
        let matches =
            |w: &helixlock_plant::Parameter| w.search == search && w.unit.suffix() == unit;
        component.term.parameters.iter().position(matches).map(|i| component.term.values[i])
    };
    let (Some(place), Some(width)) = (of(Search::Position, "mm"), of(Search::Logarithmic, "mm"))
    else {
        return true;
    };
    let travel = &problem.record.position_mm;
    let low = travel.iter().copied().fold(f64::INFINITY, f64::min);
    low + width <= place && place <= low + spread(travel) - width
}
