//! Another lead of the machine's own screw than the file's: what comes with its turns is elsewhere then.

use helixlock_plant::{Lead, Model, Part};

use super::column::STEPS;
use super::hypothesis::Hypothesis;
use crate::measurement::Measurement;
use crate::model::Problem;
use crate::policy::mistakes::FARTHEST_LEAD;

/// Leads that screws of machines are made in: of ISO 3408-2 and ISO 2904, and whole threads an inch.
const LEADS: [&str; 34] = [
    "1 mm", "1.5 mm", "2 mm", "2.5 mm", "3 mm", "4 mm", "5 mm", "6 mm", "7 mm", "8 mm", "9 mm",
    "10 mm", "12 mm", "14 mm", "16 mm", "18 mm", "20 mm", "22 mm", "24 mm", "25 mm", "28 mm",
    "32 mm", "36 mm", "40 mm", "44 mm", "50 mm", "1 in", "2 tpi", "4 tpi", "5 tpi", "6 tpi",
    "8 tpi", "10 tpi", "20 tpi",
];

/// The file with each other lead, where it predicts anything.
pub(super) fn leads(problem: &Problem) -> Vec<Hypothesis> {
    let is_told = !problem.model.rotary && !problem.model.effects.is_empty();
    let screw = problem.model.lead_screw.filter(|_| is_told);
    screw.map_or_else(Vec::new, |own| {
        LEADS.iter().filter_map(|lead| with_lead(problem, own, lead)).collect()
    })
}

/// The file with another lead of its screw; `None` for one too far off, or which its places are doubted for.
pub(super) fn with_lead(problem: &Problem, own: Lead, text: &str) -> Option<Hypothesis> {
    let lead: Lead = text.parse().ok().filter(|lead: &Lead| lead.rational() != own.rational())?;
    let ratio = lead.mm() / own.mm();
    // The position is asked for those, which moves waves alike.
    let is_a_step = STEPS.iter().any(|step| (ratio - step).abs() < f64::EPSILON * step);
    if FARTHEST_LEAD < ratio.max(ratio.recip()) || is_a_step {
        return None;
    }
    let mut machine = problem.model.machine.clone();
    let mut mended = problem.measurement.clone();
    machine.lead_screw = Some(lead);
    // An axis that makes no screw turns once a lead of its own.
    if !machine.has(Part::Workpiece) {
        machine.workpiece.lead = lead;
        turned_by(&mut mended, own.mm() / lead.mm());
    }
    let model = Model { machine, effects: problem.model.effects.clone() };
    let (lead_mm, own_mm) = (lead.mm(), own.mm());
    let says =
        format!("what comes with the screw has a lead of {lead_mm:.4} mm, not of {own_mm:.4} mm");
    let mend = format!("[lead_screw]\nlead = \"{text}\"");
    Hypothesis::of_both(problem, &model, &mended, ("lead", says, mend))
}

fn turned_by(measurement: &mut Measurement, factor: f64) {
    measurement.samples.angle_rev.iter_mut().for_each(|turns| *turns *= factor);
}
