//! A certificate in words.

use std::io::Write;

use helixlock_sim::{Certificate, FLIP_FLOP, OpenLoop};

/// The bound, and each run against it.
pub(crate) fn print(certificate: &Certificate, out: &mut impl Write) -> anyhow::Result<()> {
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
    print_other_decisions(open, out)?;
    writeln!(out, "coincident edges    {} within a clock", open.coincidences)?;
    writeln!(out, "short clock pulses  {} in the old flip-flop, none taken", open.runts)?;
    print_provoked(certificate, out)?;
    print_closed(certificate, out)
}

/// How often the two devices of a run took another direction, and how near to a coincidence.
pub(crate) fn print_other_decisions(run: &OpenLoop, out: &mut impl Write) -> anyhow::Result<()> {
    writeln!(
        out,
        "other decisions     {}, the laser's edge at most {:.1} ns from a coincidence",
        run.other_decisions,
        1e9 * run.other_decision_s
    )?;
    Ok(())
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
        print_other_decisions(run, out)?;
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

/// The flip-flops; `given_ns` is what was said of them, in the order of the words of the command.
pub(crate) fn print_metastability(
    mtbf_log10_years: f64,
    given_ns: [Option<f64>; 3],
    out: &mut impl Write,
) -> anyhow::Result<()> {
    let [settling, window, lost] = given_ns;
    let word = |given: Option<f64>, assumed_s: f64| match given {
        Some(ns) => format!("{ns} ns given"),
        None => format!("{} ns assumed", 1e9 * assumed_s),
    };
    writeln!(
        out,
        "metastability       mean time between failures of a synchroniser \
         10^{mtbf_log10_years:.0} years (settling {}, window {}, lost of the clock {})",
        word(settling, FLIP_FLOP.tau_s),
        word(window, FLIP_FLOP.window_s),
        word(lost, FLIP_FLOP.overhead_s),
    )?;
    Ok(())
}
