//! Whether an effect that was found is the same in every pass, and each way.

use helixlock_plant::Column;

use super::probes::{ROUNDING, Structure, asked, is_large, varies_inside_a_pass};
use crate::model::{Problem, State};
use crate::numerics::{count, mean};
use crate::policy::chance::DISAGREES;
use crate::policy::extent::COLUMNS_OF_PASSES;

/// What an effect may differ between: a part of the record for each row.
struct Parts {
    along: &'static str,
    differs: &'static str,
    of_rows: Vec<usize>,
}

/// Effects of which some passes show another size or phase than others, or one way than the other, each with its
/// chance.
///
/// Of such an effect the one value that all were given is that of none: a worm's wave after the telescope has been
/// turned over, a drift that has changed its way, a wheel that bears on one flank only.
#[must_use]
pub(crate) fn disagreements(problem: &Problem, state: &State) -> Vec<Structure> {
    let all = [passes(problem), ways(problem)];
    let looks = count(all.len() * state.components.len());
    let of = |index: usize| {
        let found =
            all.iter().filter_map(|parts| disagreement(problem, state, index, (parts, looks)));
        found.min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    };
    (0..state.components.len()).filter_map(of).collect()
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

fn disagreement(
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
    if raw.is_empty() || COLUMNS_OF_PASSES < raw.len() || component.term.nature().is_setting() {
        return None;
    }
    let model = (&state.columns, &state.fit);
    let (rms_um, p_value) = asked(problem, model, &raw, (looks, DISAGREES));
    let shape = format!("{} of another size or phase {}", component.term.name, parts.differs);
    (p_value < DISAGREES && is_large(problem, &state.fit, rms_um))
        .then(|| Structure::without_place(parts.along, &shape, rms_um, p_value))
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
