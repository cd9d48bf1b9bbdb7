//! Orders of the spindle against those of the machine file: a line beside a listed one is no shaft of its own.

use crate::model::Problem;
use crate::numerics::spread;
use crate::policy::extent::{OVERTONES, SIDEBANDS};
use crate::spectrum::gear_orders;

/// Share of what the turns of a record resolve within which two orders are one.
const ONE_LINE: f64 = 0.5;

/// True for an order that the turns of a record do not tell from that of a listed wheel, or an overtone of it.
#[must_use]
pub(super) fn is_listed(problem: &Problem, order: f64) -> bool {
    let near = ONE_LINE / turns(problem);
    lines(problem).any(|line| (order - line).abs() < near)
}

/// True for an order that is a whole multiple of a listed one, or lies off it by whole turns of the spindle or of
/// another wheel: what swells, or comes early and late, with those.
#[must_use]
pub(super) fn is_beside_listed(problem: &Problem, order: f64) -> bool {
    let near = ONE_LINE / turns(problem);
    let wheels = gear_orders(&problem.model);
    let is_off = |off: f64, wheel: f64| {
        let times = (off / wheel).round();
        times <= f64::from(SIDEBANDS) && (off - times * wheel).abs() < near
    };
    let is_beside = |&listed: &f64| {
        let carrier = listed * (order / listed).round().max(1.0);
        let slower = wheels.iter().copied().chain([1.0]);
        let mut slower = slower.filter(|wheel| f64::from(SIDEBANDS) * wheel < carrier);
        slower.any(|wheel| is_off((order - carrier).abs(), wheel))
    };
    wheels.iter().any(is_beside)
}

/// Orders of listed wheels and their overtones.
fn lines(problem: &Problem) -> impl Iterator<Item = f64> {
    let overtones = |order: f64| (1..=OVERTONES).map(move |times| f64::from(times) * order);
    gear_orders(&problem.model).into_iter().flat_map(overtones)
}

/// Turns of the spindle in a record, where it turns at all.
fn turns(problem: &Problem) -> f64 {
    spread(&problem.record.turns().collect::<Vec<_>>()).max(f64::MIN_POSITIVE)
}
