//! `helixlock certify`: the synchronous device against the asynchronous one of the print.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_plant::Machine;
use helixlock_sim::{Certificate, Course, FLIP_FLOP, Options, certify};

use crate::progress;
use crate::quantity::length_mm;

/// Compare the clocked logic with the asynchronous original over a whole pass
///
/// Prints the largest difference in time and µm and the bound that follows from the clock. Exit
/// status 1 when the bound is not kept.
#[derive(Debug, Args)]
pub(crate) struct Certify {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    length: Option<f64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Certify {
    /// Runs the pass through both and prints what differs.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let machine = Machine::read(&self.machine)?;
        let options = Options { length_mm: self.length, ..Options::default() };
        let bar = progress::bar(Course::new(&machine, &options)?.clocks(), "clocks");
        let certificate = certify(&machine, self.length, &mut |clocks| bar.set_position(clocks))?;
        bar.finish_and_clear();
        if self.json {
            writeln!(out, "{}", serde_json::to_string_pretty(&json(&certificate))?)?;
        } else {
            print(&certificate, out)?;
        }
        Ok(if certificate.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}

fn json(certificate: &Certificate) -> serde_json::Value {
    serde_json::json!({
        "holds": certificate.holds(),
        "comparisons": certificate.comparisons,
        "largest_difference_s": certificate.largest_s,
        "largest_difference_um": certificate.largest_um,
        "rms_difference_s": certificate.rms_s,
        "bound_s": certificate.bound_s,
        "bound_um": certificate.bound_um,
        "other_decisions": certificate.other_decisions,
        "other_decision_from_coincidence_s": certificate.other_decision_s,
        "coincidences": certificate.coincidences,
        "short_clock_pulses": certificate.runts,
        "mtbf_log10_years": certificate.mtbf_log10_years,
        "flip_flop_tau_s": FLIP_FLOP.tau_s,
        "flip_flop_window_s": FLIP_FLOP.window_s,
        "flip_flop_overhead_s": FLIP_FLOP.overhead_s,
    })
}

fn print(certificate: &Certificate, out: &mut impl Write) -> anyhow::Result<()> {
    let Certificate { comparisons, coincidences, runts, .. } = certificate;
    let ns = |seconds: f64| 1e9 * seconds;
    let nm = |um: f64| 1e3 * um;
    writeln!(out, "{comparisons} comparisons, the same lines and fringes for both devices")?;
    writeln!(
        out,
        "largest difference  {:.3} ns = {:.4} nm of table travel (rms {:.3} ns)",
        ns(certificate.largest_s),
        nm(certificate.largest_um),
        ns(certificate.rms_s)
    )?;
    writeln!(
        out,
        "bound, one clock    {:.3} ns = {:.4} nm: {}",
        ns(certificate.bound_s),
        nm(certificate.bound_um),
        if certificate.holds() { "kept" } else { "NOT kept" }
    )?;
    writeln!(
        out,
        "other decisions     {}, the laser's edge at most {:.1} ns from a coincidence",
        certificate.other_decisions,
        ns(certificate.other_decision_s)
    )?;
    writeln!(out, "coincident edges    {coincidences} within a clock")?;
    writeln!(out, "short clock pulses  {runts} in the old flip-flop, none taken")?;
    writeln!(
        out,
        "metastability       mean time between failures of a synchroniser 10^{:.0} years \
         (assumed: τ {} ns, window {} ns, {} ns of the clock lost)",
        certificate.mtbf_log10_years,
        ns(FLIP_FLOP.tau_s),
        ns(FLIP_FLOP.window_s),
        ns(FLIP_FLOP.overhead_s)
    )?;
    Ok(())
}
