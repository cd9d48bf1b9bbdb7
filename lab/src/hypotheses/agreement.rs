//! Whether an effect that was found is the same in every pass, each way and at every reversal, and a wave in time in
//! every part of the record.

use std::ops::Range;

use helixlock_plant::{Column, Search};

use super::probes::{ROUNDING, Structure, asked, is_large, varies_inside_a_pass};
use crate::model::{Columns, Component, Problem, State, plain_noises, settle};
use crate::noise::{Block, rms};
use crate::numerics::{chi_squared_tail, count, mean, spread};
use crate::policy::chance::DISAGREES;
use crate::policy::evidence::WAVES_IN_TIME;
use crate::policy::extent::{COLUMNS_OF_PASSES, PARTS_OF_A_RECORD};

/// Shares of what follows a jump within which it may die away to a third.
const FADES: [f64; 5] = [0.02, 0.05, 0.12, 0.3, 0.7];

/// What an effect may differ between: a part of the record for each row.
struct Parts {
    along: &'static str,
    differs: &'static str,
    of_rows: Vec<usize>,
}

/// An effect that is not the same all through a record.
pub(crate) struct Disagreement {
    /// Its place in the model.
    pub(crate) index: usize,
    /// How it differs, with the chance of that.
    pub(crate) differs: Structure,
    /// True for what it cannot be then: a wave in time that is not steady, a jump that does not stay.
    pub(crate) is_denied: bool,
}

/// Effects of which some passes show another size or phase than others, one way than the other, one reversal than
/// another, or of a wave in time one part of the record, and jumps that do not stay.
///
/// Of such an effect the one value that all were given is that of none: a worm's wave after the telescope has been
/// turned over, a drift that has changed its way, a wheel that bears on one flank only, a relay that keeps no time.
#[must_use]
pub(crate) fn disagreements(problem: &Problem, state: &State) -> Vec<Disagreement> {
    let all = [passes(problem), ways(problem), stretches(problem)];
    let looks = count((all.len() + 1) * state.components.len());
    let of = |index: usize| {
        let is_of_the_clock = hertz(&state.components[index]).is_some();
        let parts = if is_of_the_clock { &all[..] } else { &all[..2] };
        let near = beating_slowly(problem, state, index);
        let fewer = (!near.is_empty()).then(|| without(problem, state, &near)).flatten();
        let model = fewer.as_ref().unwrap_or(state);
        let place = index - near.iter().filter(|other| **other < index).count();
        let differ = parts.iter().filter_map(|one| differing(problem, model, place, (one, looks)));
        let fading = moment_s(&state.components[index])
            .and_then(|at_s| fading(problem, state, (index, at_s), looks));
        let is_denied = is_of_the_clock || fading.is_some();
        let turning = at_reversals(problem, state, index, looks);
        let differs =
            differ.chain(fading).chain(turning).min_by(|a, b| a.p_value.total_cmp(&b.p_value))?;
        Some(Disagreement { index, differs, is_denied })
    };
    (0..state.components.len()).filter_map(of).collect()
}

/// The frequency of a wave in time.
fn hertz(component: &Component) -> Option<f64> {
    component.term.frequency_hz().filter(|_| component.term.is_wave())
}

/// Other waves in time whose beat with one hardly comes round: together they are one wave of changing size or phase,
/// and each by itself is asked whether it is that wave.
fn beating_slowly(problem: &Problem, state: &State, index: usize) -> Vec<usize> {
    let Some(own) = hertz(&state.components[index]) else { return Vec::new() };
    let range_s = spread(&problem.record.time_s);
    let is_near = |other: &usize| {
        *other != index
            && hertz(&state.components[*other])
                .is_some_and(|hertz| (hertz - own).abs() * range_s < WAVES_IN_TIME)
    };
    (0..state.components.len()).filter(is_near).collect()
}

fn without(problem: &Problem, state: &State, others: &[usize]) -> Option<State> {
    State::of(problem, state.without(others), &state.fit.noises)
}

/// When a whole number of something jumps, of an effect that does.
fn moment_s(component: &Component) -> Option<f64> {
    let term = &component.term;
    let at = term.parameters.iter().position(|what| what.search == Search::Time)?;
    let counts = (0..term.parameters.len()).any(|parameter| component.is_counted(parameter));
    counts.then_some(term.values[at])
}

/// A jump that dies away behind its moment, in the place of one that stays.
///
/// A noise that was fitted to a jump that stays has taken the rest for slow: each is held under the noise of
/// either.
fn fading(
    problem: &Problem,
    state: &State,
    (index, at_s): (usize, f64),
    looks: f64,
) -> Option<Structure> {
    let (used, from) = state.coefficients(index);
    let own = &state.columns.raw[from..from + used.len()];
    let time_s = &problem.record.time_s;
    let range_s = time_s.iter().fold(0.0_f64, |most, time| most.max(time - at_s));
    let fewer = Columns::of_model(problem, &state.without(&[index])).ok()?;
    let dying = |share: f64| {
        let left = |&sample: &usize| libm::exp((at_s - time_s[sample]) / (share * range_s));
        let fading = |column: &Column| -> Column {
            column
                .iter()
                .zip(&problem.samples)
                .map(|(value, sample)| value * left(sample))
                .collect()
        };
        let columns = fewer.and(&Columns::free(own.iter().map(fading)));
        settle(problem, &columns, &plain_noises(problem, &state.fit.left))
    };
    let best = FADES.into_iter().map(dying);
    let best = best.max_by(|a, b| a.log_likelihood.total_cmp(&b.log_likelihood))?;
    let staying = settle(problem, &state.columns, &best.noises).log_likelihood;
    let gain = 2.0 * (best.log_likelihood - staying.max(state.fit.log_likelihood));
    let p_value = looks * count(FADES.len()) * chi_squared_tail(gain, count(used.len()));
    let moved: Vec<f64> = state.fit.left.iter().zip(&best.left).map(|(a, b)| a - b).collect();
    let rms_um = rms(&problem.layout, &moved);
    let shape = format!("{} that dies away", state.components[index].term.name);
    (p_value < DISAGREES && is_large(problem, &best, rms_um))
        .then(|| Structure::without_place("time", &shape, rms_um, p_value))
}

fn passes(problem: &Problem) -> Parts {
    let blocks = problem.layout.blocks.iter();
    let of_rows = blocks.flat_map(|block| block.rows.clone().map(|_| block.pass)).collect();
    Parts { along: "passes", differs: "in some passes", of_rows }
}

fn ways(problem: &Problem) -> Parts {
    let forward = |&sample: &usize| usize::from(0.0 < problem.record.direction[sample]);
    let of_rows = problem.samples.iter().map(forward).collect();
    Parts { along: "direction", differs: "each way", of_rows }
}

fn stretches(problem: &Problem) -> Parts {
    let rows = problem.record.time_s.len();
    let of_rows = problem.samples.iter().map(|sample| sample * PARTS_OF_A_RECORD / rows).collect();
    Parts { along: "time", differs: "from one part of the record to the next", of_rows }
}

fn differing(
    problem: &Problem,
    state: &State,
    index: usize,
    (parts, looks): (&Parts, f64),
) -> Option<Structure> {
    let component = &state.components[index];
    if component.is_of_one_size() {
        return None;
    }
    let (used, from) = state.coefficients(index);
    let raw = part_by_part(problem, &state.columns.raw[from..from + used.len()], &parts.of_rows);
    if component.term.nature().is_setting() {
        return None;
    }
    let shape = format!("{} of another size or phase {}", component.term.name, parts.differs);
    other_sizes(problem, state, &raw, (looks, parts.along, shape))
}

/// What columns of an effect's parts show beside the whole of it, where that is beyond chance.
fn other_sizes(
    problem: &Problem,
    state: &State,
    parts: &[Column],
    (looks, along, shape): (f64, &str, String),
) -> Option<Structure> {
    if parts.is_empty() || COLUMNS_OF_PASSES < parts.len() {
        return None;
    }
    let model = (&state.columns, &state.fit);
    let (rms_um, p_value) = asked(problem, model, parts, (looks, DISAGREES));
    (p_value < DISAGREES && is_large(problem, &state.fit, rms_um))
        .then(|| Structure::without_place(along, &shape, rms_um, p_value))
}

/// What an effect that acts when the axis turns back shows of another size at some reversals.
fn at_reversals(problem: &Problem, state: &State, index: usize, looks: f64) -> Option<Structure> {
    if !state.components[index].term.nature().at_reversal {
        return None;
    }
    let (used, from) = state.coefficients(index);
    let strokes = strokes(problem);
    let behind = |stroke: &(Range<usize>, usize)| -> Vec<Column> {
        let own = state.columns.raw[from..from + used.len()].iter();
        own.map(|column| since(column, stroke)).collect()
    };
    let shown = |stroke: &Vec<Column>| stroke.iter().any(|own| varies_inside_a_pass(problem, own));
    let raw: Vec<Column> = strokes.iter().map(behind).filter(shown).skip(1).flatten().collect();
    let what = format!("{} of another size at some reversals", state.components[index].term.name);
    other_sizes(problem, state, &raw, (looks, "direction", what))
}

/// Rows of every stroke with which a pass goes on after another, and where that pass ends.
fn strokes(problem: &Problem) -> Vec<(Range<usize>, usize)> {
    let direction = |row: usize| problem.record.direction[problem.samples[row]];
    let of = |block: &Block| -> Vec<(Range<usize>, usize)> {
        let turns =
            block.rows.clone().skip(1).filter(|&row| direction(row) * direction(row - 1) < 0.0);
        let ends: Vec<usize> = turns.chain([block.rows.end]).collect();
        ends.windows(2).map(|two| (two[0]..two[1], block.rows.end)).collect()
    };
    problem.layout.blocks.iter().flat_map(of).collect()
}

/// What a column has changed by since a stroke began, and keeps behind it.
fn since(column: &Column, (stroke, end): &(Range<usize>, usize)) -> Column {
    let before = column[stroke.start - 1];
    let mut own = vec![0.0; column.len()];
    for row in stroke.start..*end {
        own[row] = column[row.min(stroke.end - 1)] - before;
    }
    own.into()
}

/// The columns of an effect in each part by itself, but for the first part that shows it.
fn part_by_part(problem: &Problem, columns: &[Column], of_rows: &[usize]) -> Vec<Column> {
    let parts = of_rows.iter().max().map_or(0, |last| last + 1);
    let alone = |part: usize| -> Vec<Column> {
        columns.iter().map(|column| alone(problem, column, (of_rows, part))).collect()
    };
    let shown = |part: &Vec<Column>| part.iter().any(|own| varies_inside_a_pass(problem, own));
    (0..parts).map(alone).filter(shown).skip(1).flatten().collect()
}

/// A column in one part, about its mean there in each pass: its zero is that of a pass, and from one way to the
/// other would be a step.
fn alone(problem: &Problem, column: &Column, (of_rows, part): (&[usize], usize)) -> Column {
    let size = column.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut own = vec![0.0; column.len()];
    for block in &problem.layout.blocks {
        let rows: Vec<usize> = block.rows.clone().filter(|&row| of_rows[row] == part).collect();
        let level = mean(&rows.iter().map(|&row| column[row]).collect::<Vec<f64>>());
        for row in rows {
            let value = column[row] - level;
            own[row] = if value.abs() <= ROUNDING * size { 0.0 } else { value };
        }
    }
    own.into()
}
