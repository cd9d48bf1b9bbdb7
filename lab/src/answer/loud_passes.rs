//! Passes that are louder than the others: what they hold weighs less.

use helixlock_plant::prediction::Sensor;

use crate::model::Problem;
use crate::policy::reading::LOUD_ENOUGH_TO_SAY;

/// A pass whose noise is louder than that of the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoudPass {
    /// Whose readings they are.
    pub sensor: Sensor,
    /// Name of the pass in the file.
    pub pass: f64,
    /// How many times as loud it is.
    pub times: f64,
}

/// Those that are weighed so, in the order of the record.
#[must_use]
pub(crate) fn loud_passes(problem: &Problem) -> Vec<LoudPass> {
    let pass_names = &problem.measurement.pass_names;
    let blocks = problem.layout.blocks.iter().map(|block| LoudPass {
        sensor: problem.sensors[block.sensor],
        pass: pass_names[block.pass],
        times: block.variance().sqrt(),
    });
    blocks.filter(|one| LOUD_ENOUGH_TO_SAY <= one.times).collect()
}
