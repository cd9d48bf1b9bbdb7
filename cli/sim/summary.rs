//! The numbers of a simulation, for people and as JSON.

use std::io::{self, Write};
use std::path::Path;

use helixlock_lab::divider_doubt;
use helixlock_plant::Machine;
use helixlock_plant::motion::LeftOut;
use helixlock_sim::{Course, Findings, Hunting, Pass, PassFindings, Playback, Simulation};

use crate::shared::keys::keys;
use crate::shared::wheels::Wheels;
use crate::shared::words::doubted;

keys! {
    /// `summary.json`: keys are stable, units are in the names.
    Summary(file: &Path, machine: &Machine, simulation: &Simulation, findings: &Findings) {
        title: String = machine.title.clone(),
        machine_file: String = file.display().to_string(),
        run: Run = Run::new(simulation),
        settings: Wheels = Wheels::new(&simulation.course.dialled),
        without_correction: PassSummary = PassSummary::new(&simulation.open, &findings.open),
        with_correction: PassSummary = PassSummary::new(&simulation.closed, &findings.closed),
        hunting: Option<HuntingSummary> = hunting(simulation, findings),
        slew: Slew = Slew::new(&simulation.course, findings),
        playback: Option<PlaybackSummary> = simulation.closed.playback.map(PlaybackSummary::new),
        notes: Vec<String> = notes(machine, simulation, findings),
    }

    /// What was run.
    Run(simulation: &Simulation) {
        length_mm: f64 = simulation.course.length_mm,
        duration_s: f64 = simulation.course.duration_s,
        clock_hz: u64 = simulation.course.clock_hz,
        clocks: u64 = simulation.open.clocks + simulation.closed.clocks,
        comparisons: usize = simulation.closed.trace.time_s.len(),
        comparison_hz: f64 = simulation.course.comparison_hz,
        range_um: f64 = simulation.course.full_scale_um,
    }

    /// One pass.
    PassSummary(pass: &Pass, findings: &PassFindings) {
        periodic_error_um: f64 = findings.lead.periodic_um,
        cumulative_error_um: f64 = findings.lead.cumulative_um,
        lead_error_peak_to_peak_um: f64 = findings.lead.total_um,
        recorder_peak_to_peak_um: f64 = findings.recorder_um,
        filtered_recorder_peak_to_peak_um: f64 = findings.filtered_um,
        recorder_jumps: usize = pass.jumps,
        steps_taken: u64 = pass.steps_taken,
        steps_net: i64 = pass.steps_net,
        counter_fault: bool = pass.fault,
    }

    /// The limit cycle.
    HuntingSummary(hunting: Hunting, expected_swing_um: f64) {
        frequency_hz: f64 = hunting.frequency_hz,
        comparison_hz: f64 = hunting.comparison_hz,
        ratio: f64 = hunting.frequency_hz / hunting.comparison_hz,
        swing_um: f64 = hunting.swing_um,
        expected_swing_um: f64 = expected_swing_um,
    }

    /// What the motor can follow and what it had to.
    Slew(course: &Course, findings: &Findings) {
        limit_um_per_s: f64 = course.slew_limit_um_per_s,
        needed_um_per_s: f64 = findings.needed_um_per_s,
        limited: bool = findings.slew_limited,
        outrun_share: Option<f64> = findings.hunting.map(|hunting| hunting.outrun_share),
    }

    /// The way home.
    PlaybackSummary(playback: Playback) {
        steps: u64 = playback.steps,
        duration_s: f64 = playback.duration_s,
        steps_left: i64 = playback.left,
    }
}

/// A number of a pass.
type Quantity = fn(&PassSummary) -> f64;

impl Summary {
    /// What the run is, beside the machine's own title, which has no language.
    pub(crate) fn heading(&self) -> String {
        format!("{}: without and with the correction", self.title)
    }

    /// For people.
    pub(crate) fn print(&self, out: &mut impl Write) -> io::Result<()> {
        let run = &self.run;
        writeln!(out, "{}", self.heading())?;
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

fn hunting(simulation: &Simulation, findings: &Findings) -> Option<HuntingSummary> {
    let hunts = !findings.slew_limited && !simulation.closed.fault;
    // A motor that never catches up does not hunt.
    let hunting = findings.hunting.filter(|_| hunts);
    hunting.map(|hunting| HuntingSummary::new(hunting, simulation.course.swing_um))
}

/// What a user should not have to find out alone.
fn notes(machine: &Machine, simulation: &Simulation, findings: &Findings) -> Vec<String> {
    let (course, open, closed) = (&simulation.course, &simulation.open, &simulation.closed);
    let misfit = divider_doubt(machine);
    let mut notes: Vec<String> = misfit.iter().map(doubted).collect();
    let asked = machine.dividers.compensation_um_per_m;
    let given = course.dialled.compensation_um_per_m;
    if (asked - given).abs() > 0.0005 {
        notes.push(format!(
            "compensation {asked} um/m is set as {given:.4} um/m: four digits of F can be dialled"
        ));
    }
    for LeftOut { effect, column } in &simulation.left_out {
        notes.push(format!(
            "effect `{effect}` did nothing: `[environment]` does not say what `{column}` is"
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
