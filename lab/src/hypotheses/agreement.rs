//! Whether an effect that was found is the same in every pass.

use helixlock_plant::Column;

use super::probes::{Structure, asked, is_large, varies_inside_a_pass};
use crate::model::{Problem, State};
use crate::numerics::count;
use crate::policy::chance::DISAGREES;
use crate::policy::extent::COLUMNS_OF_PASSES;

/// Effects of which some passes show another size or phase than others, each with its chance.
///
/// Of such an effect the one value that all passes were given is that of no pass: a worm's wave after
/// the telescope has been turned over, a drift that has changed its way.
#[must_use]
pub(crate) fn disagreements(problem: &Problem, state: &State) -> Vec<Structure> {
    let effects = count(state.components.len());
    let of = |index: usize| {
        let component = &state.components[index];
        let (used, from) = state.coefficients(index);
        let columns = &state.columns.raw[from..from + used.len()];
        let raw = pass_by_pass(problem, columns);
        if raw.is_empty() || COLUMNS_OF_PASSES < raw.len() || component.term.nature().is_setting() {
            return None;
        }
        let model = (&state.columns, &state.fit);
        let (rms_um, p_value) = asked(problem, model, &raw, (effects, DISAGREES));
        let shape = format!("{} of another size or phase in some passes", component.term.name);
        (p_value < DISAGREES && is_large(problem, &state.fit, rms_um))
            .then(|| Structure::without_place("passes", &shape, rms_um, p_value))
    };
    (0..state.components.len()).filter_map(of).collect()
}

/// The columns of an effect in each pass by itself, but for the first pass that shows it.
fn pass_by_pass(problem: &Problem, columns: &[Column]) -> Vec<Column> {
    let alone = |pass: usize| {
        columns.iter().map(move |column| {
            let mut part = vec![0.0; column.len()];
            for block in problem.layout.blocks.iter().filter(|block| block.pass == pass) {
                let rows = block.rows.clone();
                part[rows.clone()].copy_from_slice(&column[rows]);
            }
            Column::from(part)
        })
    };
    let shown = |pass: &Vec<Column>| pass.iter().any(|part| varies_inside_a_pass(problem, part));
    let passes = 0..problem.layout.passes();
    passes.map(|pass| alone(pass).collect()).filter(shown).skip(1).flatten().collect()
}
