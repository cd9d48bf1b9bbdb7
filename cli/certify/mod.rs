//! `helixlock certify`: the synchronous device against the asynchronous one of the print.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_plant::Model;
use helixlock_sim::{Certificate, Course, FLIP_FLOP, FlipFlop, Options, certify, mtbf_log10_years};

use crate::shared::progress;
use crate::shared::quantity::length_mm;

/// Compare the clocked logic with the asynchronous original over a whole pass
///
/// Loop open and loop closed, and on edges made to coincide: prints the largest difference in time
/// and µm and the bound that follows from the clock. Exit status 1 when a bound is not kept.
#[derive(Debug, Args)]
pub(crate) struct Certify {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    length: Option<f64>,
    /// Time constant with which a flip-flop of the FPGA settles, ns; 0.2 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    settling: Option<f64>,
    /// Window around the clock edge in which a flip-flop is upset, ns; 0.2 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    window: Option<f64>,
    /// What clock-to-output, routing and set-up take of a clock, ns; 3 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    lost: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A time between a femtosecond and a second.
fn positive_ns(word: &str) -> Result<f64, String> {
    match word.parse() {
        Ok(ns) if (1e-6..=1e9).contains(&ns) => Ok(ns),
        _ => Err(format!("found `{word}`, expected a number of nanoseconds, 1e-6 to 1e9")),
    }
}

impl Certify {
    /// Runs the pass through both and prints what differs.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let machine = Model::read(&self.machine)?;
        let options = Options { length_mm: self.length, ..Options::default() };
        let bar = progress::bar(Course::new(&machine, &options)?.clocks(), "clocks");
        let certificate = certify(&machine, self.length, &mut |clocks| bar.set_position(clocks))?;
        bar.finish_and_clear();
        if self.json {
            writeln!(out, "{}", serde_json::to_string_pretty(&self.as_json(&certificate))?)?;
        } else {
            print(&certificate, out)?;
            self.print_metastability(&certificate, out)?;
        }
        Ok(if certificate.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// What is said of the flip-flops, and of what was not said what is assumed.
    fn flip_flop(&self) -> FlipFlop {
        let given_s = |ns: Option<f64>, assumed_s| ns.map_or(assumed_s, |ns| 1e-9 * ns);
        FlipFlop {
            tau_s: given_s(self.settling, FLIP_FLOP.tau_s),
            window_s: given_s(self.window, FLIP_FLOP.window_s),
            overhead_s: given_s(self.lost, FLIP_FLOP.overhead_s),
        }
    }

    fn mtbf_log10_years(&self, certificate: &Certificate) -> f64 {
        mtbf_log10_years(self.flip_flop(), certificate.clock_hz, certificate.fringe_hz)
    }

    fn print_metastability(
        &self,
        certificate: &Certificate,
        out: &mut impl Write,
    ) -> anyhow::Result<()> {
        let word = |given: Option<f64>, assumed_s: f64| match given {
            Some(ns) => format!("{ns} ns given"),
            None => format!("{} ns assumed", 1e9 * assumed_s),
        };
        writeln!(
            out,
            "metastability       mean time between failures of a synchroniser 10^{:.0} years \
             (settling {}, window {}, lost of the clock {})",
            self.mtbf_log10_years(certificate),
            word(self.settling, FLIP_FLOP.tau_s),
            word(self.window, FLIP_FLOP.window_s),
            word(self.lost, FLIP_FLOP.overhead_s),
        )?;
        Ok(())
    }

    fn as_json(&self, certificate: &Certificate) -> serde_json::Value {
        let Certificate { open, provoked, closed, bound_s, speed_um_per_s, .. } = certificate;
        let FlipFlop { tau_s, window_s, overhead_s } = self.flip_flop();
        serde_json::json!({
            "holds": certificate.holds(),
            "comparisons": open.comparisons,
            "largest_difference_s": open.largest_s,
            "largest_difference_um": open.largest_s * speed_um_per_s,
            "rms_difference_s": open.rms_s,
            "bound_s": bound_s,
            "bound_um": bound_s * speed_um_per_s,
            "other_decisions": open.other_decisions,
            "other_decision_from_coincidence_s": open.other_decision_s,
            "coincidences": open.coincidences,
            "short_clock_pulses": open.runts,
            "bound_at_ends_s": certificate.bound_at_ends_s(),
            "provoked_comparisons": provoked.each_ref().map(|run| run.comparisons),
            "provoked_coincidences": provoked.each_ref().map(|run| run.coincidences),
            "provoked_largest_difference_s": provoked.each_ref().map(|run| run.largest_s),
            "provoked_largest_difference_at_ends_s":
                provoked.each_ref().map(|run| run.largest_at_ends_s),
            "provoked_other_decisions": provoked.each_ref().map(|run| run.other_decisions),
            "closed_comparisons": closed.comparisons,
            "closed_steps": closed.steps_taken,
            "closed_largest_difference_steps": closed.largest_steps,
            "closed_largest_difference_um": closed.largest_um,
            "closed_bound_um": closed.bound_um,
            "closed_alike": closed.alike,
            "closed_alike_largest_difference_s": closed.alike_largest_s,
            "closed_largest_difference_s": closed.largest_s,
            "mtbf_log10_years": self.mtbf_log10_years(certificate),
            "flip_flop_tau_s": tau_s,
            "flip_flop_window_s": window_s,
            "flip_flop_overhead_s": overhead_s,
        })
    }
}

fn print(certificate: &Certificate, out: &mut impl Write) -> anyhow::Result<()> {
    let Certificate { open, bound_s, speed_um_per_s, .. } = certificate;
    let nm = |seconds: f64| 1e3 * seconds * speed_um_per_s;
    let kept = if certificate.holds() { "kept" } else { "NOT kept" };
    writeln!(out, "bound, one clock    {:.3} ns = {:.4} nm: {kept}", 1e9 * bound_s, nm(*bound_s))?;
    writeln!(
        out,
        "\nloop open           {} comparisons, the same lines and fringes for both devices",
        open.comparisons
    )?;
    writeln!(
        out,
        "largest difference  {:.3} ns = {:.4} nm of table travel (rms {:.3} ns)",
        1e9 * open.largest_s,
        nm(open.largest_s),
        1e9 * open.rms_s
    )?;
    writeln!(
        out,
        "other decisions     {}, the laser's edge at most {:.1} ns from a coincidence",
        open.other_decisions,
        1e9 * open.other_decision_s
    )?;
    writeln!(out, "coincident edges    {} within a clock", open.coincidences)?;
    writeln!(out, "short clock pulses  {} in the old flip-flop, none taken", open.runts)?;
    print_provoked(certificate, out)?;
    print_closed(certificate, out)
}

fn print_provoked(certificate: &Certificate, out: &mut impl Write) -> anyhow::Result<()> {
    for (run, place) in certificate.provoked.iter().zip(["middle", "ends"]) {
        writeln!(
            out,
            "\nprovoked, {place:6}    {} of {} comparisons within a clock of the {place}",
            run.coincidences, run.comparisons
        )?;
        let at_ends = format!(
            ", {:.3} ns at the ends, bound {:.3} ns",
            1e9 * run.largest_at_ends_s,
            1e9 * certificate.bound_at_ends_s()
        );
        writeln!(
            out,
            "largest difference  {:.3} ns{}",
            1e9 * run.largest_s,
            if place == "ends" { at_ends.as_str() } else { "" }
        )?;
        writeln!(
            out,
            "other decisions     {}, the laser's edge at most {:.1} ns from a coincidence",
            run.other_decisions,
            1e9 * run.other_decision_s
        )?;
    }
    Ok(())
}

fn print_closed(certificate: &Certificate, out: &mut impl Write) -> anyhow::Result<()> {
    let closed = &certificate.closed;
    writeln!(
        out,
        "\nloop closed         {} comparisons and {} steps, each device on a machine of its own",
        closed.comparisons, closed.steps_taken
    )?;
    writeln!(
        out,
        "tables apart        at most {} steps = {:.4} um; bound, two swings and two steps: {} steps \
         = {:.4} um",
        closed.largest_steps, closed.largest_um, closed.bound_steps, closed.bound_um
    )?;
    writeln!(
        out,
        "tables alike        in {} comparisons, the widths then at most {:.3} ns apart",
        closed.alike,
        1e9 * closed.alike_largest_s
    )?;
    writeln!(
        out,
        "largest difference  {:.3} us of width in any comparison\n",
        1e6 * closed.largest_s
    )?;
    Ok(())
}
