//! Thumb wheels of the file that do not belong to its lead.

use helixlock_plant::dividers::{
    COMPENSATOR_REACH_PPM, LARGEST_PRESET, Task, fringes_per_mm, solve,
};
use helixlock_plant::{Entry, Machine, Model, Part, rationalisation_um_per_m};

use super::doubt::Doubt;
use super::hypothesis::Hypothesis;
use crate::model::{Columns, Problem, Stage, noises_of};
use crate::policy::evidence::PHYSICAL_UM_PER_M;

/// A doubt of the file alone: its dividers leave more of the lead than any compensation takes out.
///
/// A machine may really stand so; only data that show the slope say that it does.
#[must_use]
pub fn divider_doubt(machine: &Machine) -> Option<Doubt> {
    let (says, mend, _) = misfit(machine)?;
    let left = rationalisation_um_per_m(machine) / PHYSICAL_UM_PER_M;
    Some(Doubt { what: "dividers", evidence: left * left, says, mend })
}

/// The file's dividers against those that fit its lead, by the slope that the data show.
pub(super) fn other_dividers(problem: &Problem) -> Option<Hypothesis> {
    let (says, mend, machine) = misfit(&problem.model)?;
    let model = Model { machine, effects: problem.model.effects.clone() };
    let one = Hypothesis::of_model(problem, &model, ("dividers", says, mend))?;
    Some(Hypothesis { usual: slope(&one.mended) - slope(problem), ..one })
}

/// Twice the log probability of the slope that is left, but for a constant.
fn slope(problem: &Problem) -> f64 {
    let stage = Stage::new(problem, &Columns::default(), &noises_of(problem, &problem.residual()));
    let metres: Vec<f64> = problem.record.position_mm.iter().map(|place| place / 1000.0).collect();
    let line = Columns::free(vec![problem.column(Entry::AngleReference, &metres)]);
    let slope = stage.gain(&line).fit.coefficients[0] / PHYSICAL_UM_PER_M;
    -slope * slope
}

/// What is wrong with the dividers, the lines that put it right, and the machine with them.
fn misfit(machine: &Machine) -> Option<(String, String, Machine)> {
    if machine.rotary || !machine.has(Part::Dividers) {
        return None;
    }
    let left = rationalisation_um_per_m(machine);
    if left.abs() <= COMPENSATOR_REACH_PPM {
        return None;
    }
    let (a, b) = (machine.dividers.a, machine.dividers.b);
    let (good_a, good_b) = fitting(machine)?;
    let lead_mm = machine.workpiece.lead.mm();
    let says = format!(
        "dividers `a = {a}`, `b = {b}` do not fit the lead of {lead_mm} mm: they leave {left:.0} µm/m"
    );
    let mut mended = machine.clone();
    (mended.dividers.a, mended.dividers.b) = (good_a, good_b);
    let mut mend = Vec::new();
    if good_a != a {
        mend.push(format!("a = {good_a}"));
    }
    if good_b != b {
        mend.push(format!("b = {good_b}"));
    }
    Some((says, mend.join("\n"), mended))
}

/// Dividers that fit: with one wheel turned if that does, else the best there are.
fn fitting(machine: &Machine) -> Option<(u16, u16)> {
    let (a, b) = (machine.dividers.a, machine.dividers.b);
    let lead = machine.workpiece.lead;
    let sought =
        lead.mm() * fringes_per_mm(machine.laser.wavelength_um) / f64::from(machine.grating.lines);
    let fits = |&(a, b): &(u16, u16)| {
        let mut other = machine.clone();
        (other.dividers.a, other.dividers.b) = (a, b);
        rationalisation_um_per_m(&other).abs() <= COMPENSATOR_REACH_PPM
    };
    let one_wheel = [
        wheel(f64::from(a) * sought).map(|b| (a, b)),
        wheel(f64::from(b) / sought).map(|a| (a, b)),
    ];
    let task = Task {
        lead,
        lines: machine.grating.lines,
        wavelength_um: machine.laser.wavelength_um,
        range_um: f64::from(b) * machine.fringe_um(),
    };
    let best = || solve(&task).map(|setting| (setting.a, setting.b));
    one_wheel.into_iter().flatten().find(fits).or_else(best)
}

fn wheel(number: f64) -> Option<u16> {
    let number = libm::round(number);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 999")]
    (1.0..=f64::from(LARGEST_PRESET)).contains(&number).then_some(number as u16)
}
