//! How much of a structure flaws may make: of the formulas, of rounded logs, of a loop that hunts.

use helixlock_plant::Part;

use super::probes::Structure;
use crate::model::{Fit, Problem};
use crate::noise::{about_means, rms};
use crate::numerics::least_squares::dot;
use crate::numerics::{count, spread};
use crate::policy::chance::STANDARD_ERRORS;
use crate::policy::size::{SHARE_OF_ERROR, SLOW_SHARE_OF_HUNTING};

/// True for something larger than what a hunting loop, whose steps are not known, may show.
///
/// A swing of ±u from comparison to comparison is a sawtooth of what the loop follows: u/√3 in
/// all, as a line at any frequency, and u/√12 of it slow.
#[must_use]
pub(crate) fn above_hunting(problem: &Problem, size_um: f64) -> bool {
    least_above_hunting(problem) <= size_um
}

/// The least of that, µm.
#[must_use]
pub(crate) fn least_above_hunting(problem: &Problem) -> f64 {
    problem.hunting_um / f64::sqrt(12.0)
}

/// True for structure larger than flaws of the formulas, of rounded logs and of a loop may make.
#[must_use]
pub(crate) fn above_flaws(problem: &Problem, fit: &Fit, structure: &Structure) -> bool {
    let exact = SHARE_OF_ERROR * rms(&problem.layout, &problem.residual());
    let exact = exact.max(STANDARD_ERRORS * of_rounded_logs(problem, fit)).max(of_steps(problem));
    let size_um = structure.rms_um.min(rms(&problem.layout, &fit.left));
    // What is no effect may be any of a loop's lines.
    exact < size_um && above_hunting(problem, SLOW_SHARE_OF_HUNTING * size_um)
}

/// What the motor's steps leave that are known and taken off, µm: one that is taken while a reading
/// is made is in it by any share, half a step off on either side.
fn of_steps(problem: &Problem) -> f64 {
    let known = problem.measurement.covariates.contains_key("steps");
    if known { 0.5 * problem.model.drive.step_um } else { 0.0 }
}

/// What stairs of the compensation leave, which come at even distances, µm: one that comes while a reading is made is
/// in it by any share, half a fringe off on either side.
pub(super) fn of_stairs(problem: &Problem) -> f64 {
    let machine = &problem.model;
    let cycle = machine.dividers.compensation_cycle().filter(|_| machine.has(Part::Dividers));
    let Some(cycle) = cycle else { return 0.0 };
    let way_mm = &problem.record.travelled_mm;
    let gone_mm =
        problem.record.passes().into_iter().map(|rows| spread(&way_mm[rows])).sum::<f64>();
    let stairs = 1000.0 * gone_mm / (f64::from(cycle) * machine.fringe_um());
    0.5 * machine.fringe_um() * (stairs / count(problem.samples.len())).min(1.0).sqrt()
}

/// What fitted effects show too much or too little because logs were rounded, µm: as much as their
/// curve changes with each log, as far as it follows it.
fn of_rounded_logs(problem: &Problem, fit: &Fit) -> f64 {
    let residual = problem.residual();
    let shown: Vec<f64> = residual.iter().zip(&fit.left).map(|(all, left)| all - left).collect();
    let shown = about_means(&problem.layout, &shown);
    let by_log = problem.measurement.off_by.iter().filter_map(|(name, off_by)| {
        let values = problem.measurement.covariates.get(name)?;
        let column: Vec<f64> = problem.samples.iter().map(|&sample| values[sample]).collect();
        let column = about_means(&problem.layout, &column);
        let (square, common) = (dot(&column, &column), dot(&column, &shown));
        let all = square * dot(&shown, &shown);
        (0.0 < all).then(|| off_by * common.abs() / square * common * common / all)
    });
    by_log.map(|um| um * um).sum::<f64>().sqrt()
}
