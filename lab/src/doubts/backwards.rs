//! Readings of one pass in reverse order: a way back that was written down as a way out.

use super::hypothesis::Hypothesis;
use crate::model::Problem;

/// The readings of the odd pass turned round.
pub(super) fn backwards(problem: &Problem, odd: Option<usize>) -> Option<Hypothesis> {
    let pass = odd?;
    let mut mended = problem.measurement.clone();
    let from = mended.pass.iter().position(|of| *of == pass)?;
    let rows = mended.pass.iter().filter(|of| **of == pass).count();
    for values in mended.observations.values_mut() {
        values[from..from + rows].reverse();
    }
    let name = problem.measurement.pass_names[pass];
    let says = format!(
        "the readings of pass {name} stand in reverse order, or its position counts the other way"
    );
    let mend = format!("turn the order of the readings of pass {name}, or its position");
    let one = Hypothesis::of_measurement(problem, &mended, ("reversed", says, mend))?;
    Some(Hypothesis { pass: Some(pass), ..one })
}
