//! The two passes of a simulation compared.

use super::appraisal::{
    Hunting, LeadAppraisal, appraise_lead, fastest_um_per_s, measure_hunting, peak_to_peak,
};
use super::pass::Pass;
use super::simulate::Simulation;

/// Share of comparisons further out than the hunting allows, above which the motor is too slow.
const OUTRUN_SHARE: f64 = 0.02;

/// What a simulation says about the machine and its correction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Findings {
    /// Without the correction.
    pub open: PassFindings,
    /// With it.
    pub closed: PassFindings,
    /// How the closed loop hunts; `None` when the pass is too short to say.
    pub hunting: Option<Hunting>,
    /// Fastest change of the uncorrected lead error, over two comparisons, µm/s.
    pub needed_um_per_s: f64,
    /// True when the motor was too slow for it.
    pub slew_limited: bool,
}

/// One pass in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassFindings {
    /// The workpiece.
    pub lead: LeadAppraisal,
    /// Peak to peak of the raw recorder, µm.
    pub recorder_um: f64,
    /// Peak to peak of the filtered recorder, µm.
    pub filtered_um: f64,
}

impl Simulation {
    /// Appraises both passes.
    #[must_use]
    pub fn findings(&self) -> Findings {
        let course = &self.course;
        let hunting = measure_hunting(
            &self.closed.trace.time_s,
            &self.closed.trace.error_um,
            course.swing_um,
        );
        let open = &self.open.trace;
        let over_s = 2.0 / course.comparison_hz;
        let needed_um_per_s = fastest_um_per_s(&open.time_s, &open.lead_error_um, over_s);
        let too_slow = course.slew_limit_um_per_s < needed_um_per_s;
        Findings {
            open: appraise(&self.open, course.turn_mm),
            closed: appraise(&self.closed, course.turn_mm),
            hunting,
            needed_um_per_s,
            // A counter that stands at its end is another reason to fall behind.
            slew_limited: !self.closed.fault
                && hunting.map_or(too_slow, |found| OUTRUN_SHARE < found.outrun_share),
        }
    }
}

fn appraise(pass: &Pass, turn_mm: f64) -> PassFindings {
    let trace = &pass.trace;
    PassFindings {
        lead: appraise_lead(&trace.position_mm, &trace.lead_error_um, turn_mm),
        recorder_um: peak_to_peak(trace.error_um.iter().copied()),
        filtered_um: peak_to_peak(trace.filtered_error_um.iter().copied()),
    }
}
