//! Orders of the spindle against those of the machine file: a line beside a listed one is no shaft of its own.

use helixlock_plant::Term;

use crate::model::{Component, Problem};
use crate::policy::extent::{OVERTONES, SIDEBANDS};
use crate::spectrum::gear_orders;

/// Share of what the turns of a record resolve within which two orders are one.
const ONE_LINE: f64 = 0.5;

/// True for an order that the turns of a record do not tell from one that is looked for by a name: that of a listed
/// wheel, twice that, and the overtones of those that a model has.
#[must_use]
pub(super) fn is_named(problem: &Problem, model: &[Component], order: f64) -> bool {
    let near = ONE_LINE / turns(problem);
    named(problem, model).iter().any(|line| (order - line).abs() < near)
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

/// Orders that are looked for by a name.
fn named(problem: &Problem, model: &[Component]) -> Vec<f64> {
    let own = model.iter().map(|one| &one.term).chain(problem.model.effects.iter());
    let of_model = own.filter(|term| term.is_of_a_gear()).flat_map(Term::nonlinear);
    let times = |most: u16| move |order: f64| (1..=most).map(move |times| f64::from(times) * order);
    let listed = gear_orders(&problem.model).into_iter().flat_map(times(2));
    listed.chain(of_model.flat_map(times(OVERTONES))).collect()
}

/// Turns of the spindle in a record, where it turns at all.
fn turns(problem: &Problem) -> f64 {
    problem.turned().max(f64::MIN_POSITIVE)
}
