//! The numbers of a simulation, for people and as JSON.

use std::io::{self, Write};
use std::path::Path;

use helixlock_plant::Machine;
use helixlock_sim::{Findings, Pass, PassFindings, Simulation};
use serde::Serialize;

use crate::shared::wheels::Wheels;

/// `summary.json`: keys are stable, units are in the names.
#[derive(Debug, Serialize)]
pub(crate) struct Summary {
    pub(crate) title: String,
    machine_file: String,
    pub(crate) run: Run,
    settings: Wheels,
    pub(crate) without_correction: PassSummary,
    pub(crate) with_correction: PassSummary,
    pub(crate) hunting: Option<HuntingSummary>,
    pub(crate) slew: Slew,
    pub(crate) playback: Option<PlaybackSummary>,
    pub(crate) notes: Vec<String>,
}

/// What was run.
#[derive(Debug, Serialize)]
pub(crate) struct Run {
    pub(crate) length_mm: f64,
    pub(crate) duration_s: f64,
    pub(crate) clock_hz: u64,
    pub(crate) clocks: u64,
    pub(crate) comparisons: usize,
    comparison_hz: f64,
    pub(crate) range_um: f64,
}

/// One pass.
#[derive(Debug, Serialize)]
pub(crate) struct PassSummary {
    pub(crate) periodic_error_um: f64,
    pub(crate) cumulative_error_um: f64,
    pub(crate) lead_error_peak_to_peak_um: f64,
    pub(crate) recorder_peak_to_peak_um: f64,
    filtered_recorder_peak_to_peak_um: f64,
    pub(crate) recorder_jumps: usize,
    pub(crate) steps_taken: u64,
    pub(crate) steps_net: i64,
    pub(crate) counter_fault: bool,
}

/// The limit cycle.
#[derive(Debug, Serialize)]
pub(crate) struct HuntingSummary {
    pub(crate) frequency_hz: f64,
    pub(crate) comparison_hz: f64,
    pub(crate) ratio: f64,
    pub(crate) swing_um: f64,
    pub(crate) expected_swing_um: f64,
}

/// What the motor can follow and what it had to.
#[derive(Debug, Serialize)]
pub(crate) struct Slew {
    pub(crate) limit_um_per_s: f64,
    pub(crate) needed_um_per_s: f64,
    pub(crate) limited: bool,
    outrun_share: Option<f64>,
}

/// The way home.
#[derive(Debug, Serialize)]
pub(crate) struct PlaybackSummary {
    pub(crate) steps: u64,
    pub(crate) duration_s: f64,
    pub(crate) steps_left: i64,
}

/// A number of a pass.
type Quantity = fn(&PassSummary) -> f64;

impl Summary {
    pub(crate) fn new(file: &Path, machine: &Machine, simulation: &Simulation) -> Self {
        let findings = simulation.findings();
        let (course, closed) = (&simulation.course, &simulation.closed);
        Self {
            title: machine.title.clone(),
            machine_file: file.display().to_string(),
            run: Run {
                length_mm: course.length_mm,
                duration_s: course.duration_s,
                clock_hz: course.clock_hz,
                clocks: simulation.open.clocks + closed.clocks,
                comparisons: closed.trace.time_s.len(),
                comparison_hz: course.comparison_hz,
                range_um: course.full_scale_um,
            },
            settings: Wheels::from(&course.dialled),
            without_correction: pass(&simulation.open, &findings.open),
            with_correction: pass(closed, &findings.closed),
            hunting: hunting(simulation, &findings),
            slew: Slew {
                limit_um_per_s: course.slew_limit_um_per_s,
                needed_um_per_s: findings.needed_um_per_s,
                limited: findings.slew_limited,
                outrun_share: findings.hunting.map(|hunting| hunting.outrun_share),
            },
            playback: closed.playback.map(|playback| PlaybackSummary {
                steps: playback.steps,
                duration_s: playback.duration_s,
                steps_left: playback.left,
            }),
            notes: notes(machine, simulation, &findings),
        }
    }

    /// As text for `summary.json` and `--json`.
    pub(crate) fn json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self)
    }

    /// For people.
    pub(crate) fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let run = &self.run;
        writeln!(out, "{}", self.title)?;
        writeln!(
            out,
            "{:.0} mm in {:.1} s, {} comparisons, {} clocks at {} Hz\n",
            run.length_mm, run.duration_s, run.comparisons, run.clocks, run.clock_hz
        )?;
        self.print_errors(out)?;
        self.print_motor(out)?;
        self.notes.iter().try_for_each(|note| writeln!(out, "note: {note}"))
    }

    fn print_errors(&self, out: &mut impl Write) -> io::Result<()> {
        let (before, after) = (&self.without_correction, &self.with_correction);
        writeln!(out, "peak to peak, um          without correction   with")?;
        let rows: [(&str, Quantity); 3] = [
            ("periodic lead error", |pass| pass.periodic_error_um),
            ("cumulative lead error", |pass| pass.cumulative_error_um),
            ("lead error in all", |pass| pass.lead_error_peak_to_peak_um),
        ];
        rows.iter().try_for_each(|(name, value)| {
            writeln!(out, "{name:<26}{:>18.2}{:>7.2}", value(before), value(after))
        })
    }

    fn print_motor(&self, out: &mut impl Write) -> io::Result<()> {
        let (after, slew) = (&self.with_correction, &self.slew);
        writeln!(out, "\nsteps: {} taken, net {}", after.steps_taken, after.steps_net)?;
        if let Some(hunting) = &self.hunting {
            writeln!(
                out,
                "hunting: {:.3} Hz, {:.3} of the comparison frequency {:.3} Hz, swing {:.3} um",
                hunting.frequency_hz, hunting.ratio, hunting.comparison_hz, hunting.swing_um
            )?;
        }
        writeln!(
            out,
            "motor follows up to {:.3} um/s, the error moves at up to {:.3} um/s",
            slew.limit_um_per_s, slew.needed_um_per_s
        )
    }
}

fn pass(pass: &Pass, findings: &PassFindings) -> PassSummary {
    PassSummary {
        periodic_error_um: findings.lead.periodic_um,
        cumulative_error_um: findings.lead.cumulative_um,
        lead_error_peak_to_peak_um: findings.lead.total_um,
        recorder_peak_to_peak_um: findings.recorder_um,
        filtered_recorder_peak_to_peak_um: findings.filtered_um,
        recorder_jumps: pass.jumps,
        steps_taken: pass.steps_taken,
        steps_net: pass.steps_net,
        counter_fault: pass.fault,
    }
}

fn hunting(simulation: &Simulation, findings: &Findings) -> Option<HuntingSummary> {
    let expected_swing_um = simulation.course.swing_um;
    let hunts = !findings.slew_limited && !simulation.closed.fault;
    // A motor that never catches up does not hunt.
    findings.hunting.filter(|_| hunts).map(|hunting| HuntingSummary {
        frequency_hz: hunting.frequency_hz,
        comparison_hz: hunting.comparison_hz,
        ratio: hunting.frequency_hz / hunting.comparison_hz,
        swing_um: hunting.swing_um,
        expected_swing_um,
    })
}

/// What a user should not have to find out alone.
fn notes(machine: &Machine, simulation: &Simulation, findings: &Findings) -> Vec<String> {
    let (course, open, closed) = (&simulation.course, &simulation.open, &simulation.closed);
    let mut notes = Vec::new();
    let asked = machine.dividers.compensation_um_per_m;
    let given = course.dialled.compensation_um_per_m;
    if (asked - given).abs() > 0.0005 {
        notes.push(format!(
            "compensation {asked} um/m is set as {given:.4} um/m: four digits of F can be dialled"
        ));
    }
    for effect in &simulation.left_out {
        notes.push(format!(
            "effect `{effect}` did nothing: `[environment]` does not say what drives it"
        ));
    }
    if findings.slew_limited {
        notes.push(format!(
            "slew limit: the motor moves {:.3} um/s, the error up to {:.3} um/s; a faster step \
             clock or a slower spindle lets it follow",
            course.slew_limit_um_per_s, findings.needed_um_per_s
        ));
    }
    if open.jumps > 0 {
        notes.push(format!(
            "without correction the error leaves the range of ±{:.1} um: the recorder jumped {} \
             times and is drawn on past the edge",
            course.full_scale_um / 2.0,
            open.jumps
        ));
    }
    if closed.fault {
        notes.push(
            "the step counter stood at 4095 and refused further steps: the error is beyond the \
             stroke of the corrector"
                .into(),
        );
    }
    if let Some(left) = closed.playback.map(|playback| playback.left).filter(|left| *left != 0) {
        notes.push(format!("playback stopped {left} steps short of zero"));
    }
    notes
}
