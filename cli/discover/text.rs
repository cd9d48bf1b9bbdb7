//! Proposals in words.

use std::io::Write;

use helixlock_lab::{Discovery, Found, Measurement, Proposal, RunnerUp};

use crate::shared::diagnosis_text::{print_doubts, print_effect, print_notes};
use crate::shared::words::{why_left, with_error, with_p, worth_of_a_pass};

/// Verdict, formulas with their numbers, what else could stand there, what to do next.
pub(super) fn print(
    out: &mut impl Write,
    found: &Discovery,
    measurement: &Measurement,
) -> anyhow::Result<()> {
    let unit = measurement.unit();
    writeln!(out, "verdict: {}", found.found.word())?;
    print_doubts(out, &found.doubts)?;
    if found.found == Found::DoubtfulInput {
        writeln!(out, "nothing is proposed before this is settled")?;
        return Ok(());
    }
    writeln!(out, "error:     {:.4} → {:.4} {unit} rms", found.rms_um[0], found.rms_um[1])?;
    let unseen = found.holdout_rms_um;
    writeln!(out, "held out:  {:.4} → {:.4} {unit} rms", unseen[0], unseen[1])?;
    writeln!(out, "{}", worth_of_a_pass(found.samples_a_pass))?;
    for proposal in &found.proposals {
        print_proposal(out, proposal)?;
    }
    if !found.effects.is_empty() {
        writeln!(out, "\nbeside it, by name:")?;
    }
    for effect in &found.effects {
        print_effect(out, effect)?;
    }
    for left in &found.residual {
        writeln!(
            out,
            "\nleft: {} along {}, {:.4} {unit} rms, {}",
            left.shape,
            left.along,
            left.rms_um,
            why_left(left)
        )?;
    }
    for (place, best) in found.experiments.iter().take(3).enumerate() {
        writeln!(
            out,
            "{}",
            if place == 0 { "\nto tell it from the others:" } else { "" }.trim_end()
        )?;
        write!(out, "  {}", best.action)?;
        if best.is_a_run() {
            write!(out, ": evidence {:.0} against {}", best.evidence, best.between.1)?;
        }
    }
    if !found.experiments.is_empty() {
        writeln!(out)?;
    }
    print_notes(out, measurement, found.far_readings.as_ref(), &found.loud_passes)
}

/// Where a runner-up stands, and why that is not in front.
fn standing(one: &Proposal, other: &RunnerUp) -> String {
    match other.refused {
        Some(why) => format!("ahead, but {why}"),
        None if 0.0 <= other.behind => "behind".to_owned(),
        None if one.parameters.len() < other.numbers => "ahead by more numbers".to_owned(),
        None => "ahead".to_owned(),
    }
}

fn print_proposal(out: &mut impl Write, one: &Proposal) -> anyhow::Result<()> {
    writeln!(out, "\nproposal: {} along {}", one.shape, one.along)?;
    writeln!(out, "  δ = {}", one.formula)?;
    for what in &one.parameters {
        let value = match what.stderr {
            Some(stderr) => with_error(what.value, stderr),
            None => format!("{} (the data do not hold it)", what.value),
        };
        writeln!(out, "  {} = {value} {}", what.name, what.unit)?;
    }
    writeln!(out, "  physics of this shape: {}", one.physics)?;
    let against = match one.instead_of.as_slice() {
        [] => "against the model without it".to_owned(),
        names => format!("in the place of {}", names.join(" and ")),
    };
    writeln!(out, "  evidence {:.0} {against}, {}", one.evidence, with_p(one.p_value))?;
    for other in &one.runners_up {
        let told = if other.alike { ", which the data cannot tell from it" } else { "" };
        let place = match other.instead_of.as_slice() {
            same if same == one.instead_of => String::new(),
            [] => " beside all names".to_owned(),
            names => format!(" in the place of {}", names.join(" and ")),
        };
        writeln!(
            out,
            "  or {} along {}{place}: evidence {:.0} {}{told}\n     δ = {}",
            other.shape,
            other.along,
            other.behind.abs(),
            standing(one, other),
            other.formula
        )?;
    }
    Ok(())
}
