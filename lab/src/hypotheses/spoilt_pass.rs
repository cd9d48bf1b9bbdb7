//! A pass that is weighed away, and is no noise: what is so loud, or so often far off, has a cause.

use super::probes::Structure;
use crate::model::{Fit, Problem};
use crate::noise::{Block, weighed_rms};
use crate::numerics::count;
use crate::policy::reading::{FAR_LOUDER, FEWEST_OF_A_LOUD_PASS, MOST_FAR};

/// The loudest pass, or the one that has most far readings, where it is more so than noise is.
#[must_use]
pub(super) fn spoilt_pass(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let shape = far_louder(problem).or_else(|| mostly_far(problem))?;
    let rms_um = weighed_rms(&problem.layout, &fit.left);
    Some(Structure::without_place("time", &shape, rms_um, 1.0))
}

fn far_louder(problem: &Problem) -> Option<String> {
    let loudest = problem.layout.blocks.iter().max_by_key(|block| block.loudness)?;
    let times = loudest.variance().sqrt();
    let name = problem.measurement.pass_names[loudest.pass];
    (FAR_LOUDER <= times).then(|| format!("pass {name}, {times:.0} times as loud as the others"))
}

fn mostly_far(problem: &Problem) -> Option<String> {
    let far = problem.far_rows();
    let far_share = |block: &Block| {
        count(far.iter().filter(|row| block.rows.contains(row)).count()) / count(block.rows.len())
    };
    let asked =
        problem.layout.blocks.iter().filter(|block| FEWEST_OF_A_LOUD_PASS <= block.rows.len());
    let shares = asked.map(|block| (block, far_share(block)));
    let (block, share) = shares.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let (name, percent) = (problem.measurement.pass_names[block.pass], 100.0 * share);
    (MOST_FAR <= share)
        .then(|| format!("pass {name}, {percent:.0} % of which lies far from the rest"))
}
