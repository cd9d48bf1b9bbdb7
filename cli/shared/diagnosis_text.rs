//! A diagnosis in words.

use std::io::Write;

use helixlock_lab::{
    Diagnosis, Doubt, FarReadings, FittedEffect, LoudPass, Measurement, Ranked, Round,
};

use crate::shared::far_readings::notes;
use crate::shared::words::{change, file_says, why_left, with_error, with_p, worth_of_a_pass};

/// Standard errors below this have no digit among three decimals.
const SMALL: f64 = 5e-4;
/// Candidates shown; the others are in JSON.
const MOST_CANDIDATES: usize = 8;

/// The diagnosis for people: verdict, rounds, candidates, what is left, what to do next.
pub(crate) fn print(
    out: &mut impl Write,
    diagnosis: &Diagnosis,
    measurement: &Measurement,
) -> anyhow::Result<()> {
    let unit = measurement.unit();
    writeln!(out, "verdict: {}", diagnosis.verdict.word())?;
    print_doubts(out, &diagnosis.doubts)?;
    if !diagnosis.doubts.is_empty() {
        writeln!(out, "no effect is named, and none is added, before this is settled")?;
        return Ok(());
    }
    writeln!(out, "left as noise: {:.4} {unit} rms", diagnosis.noise_um)?;
    writeln!(out, "{}\n", worth_of_a_pass(diagnosis.samples_a_pass))?;
    for round in &diagnosis.rounds {
        let change = change(round.added.as_deref(), &round.dropped);
        writeln!(
            out,
            "round {}: {change}: {:.4} {unit} rms, {:.4} on held-out data",
            round.round, round.rms_um, round.holdout_rms_um
        )?;
    }
    if let Some(last) = diagnosis.rounds.last() {
        for effect in &last.effects {
            print_effect(out, effect)?;
        }
    }
    print_candidates(out, diagnosis)?;
    for left in &diagnosis.residual {
        let at = left.at.map_or(String::new(), |at| format!(" at {at:.4}"));
        writeln!(
            out,
            "left: {} along {}{at}, {:.4} {unit} rms, {}",
            left.shape,
            left.along,
            left.rms_um,
            why_left(left)
        )?;
    }
    print_notes(out, measurement, diagnosis.far_readings.as_ref(), &diagnosis.loud_passes)
}

/// How the data were read, and which of them weigh little.
pub(crate) fn print_notes(
    out: &mut impl Write,
    measurement: &Measurement,
    far: Option<&FarReadings>,
    loud: &[LoudPass],
) -> anyhow::Result<()> {
    for note in notes(measurement, far, loud) {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}

/// What looks mistaken, each with the line that mends it.
pub(crate) fn print_doubts(out: &mut impl Write, doubts: &[Doubt]) -> anyhow::Result<()> {
    for doubt in doubts {
        writeln!(out, "doubt: {}: {} (evidence {:.0})", doubt.what, doubt.says, doubt.evidence)?;
        writeln!(out, "to mend it:")?;
        doubt.mend.lines().try_for_each(|line| writeln!(out, "  {line}"))?;
    }
    Ok(())
}

/// An effect with its parameters, a line each.
pub(crate) fn print_effect(out: &mut impl Write, effect: &FittedEffect) -> anyhow::Result<()> {
    writeln!(out, "\n{}", effect.name)?;
    for parameter in &effect.parameters {
        let value = match parameter.stderr {
            Some(stderr) if 0.0 < stderr && stderr < SMALL => with_error(parameter.value, stderr),
            Some(stderr) => format!("{:.4} ± {stderr:.3}", parameter.value),
            None => format!("{:.4}", parameter.value),
        };
        let warning = parameter.warning.map_or(String::new(), |w| format!("  ({w})"));
        let before = file_says(parameter).map_or(String::new(), |before| format!("  ({before})"));
        writeln!(out, "  {} = {value}{before}{warning}", parameter.key)?;
    }
    Ok(())
}

fn print_candidates(out: &mut impl Write, diagnosis: &Diagnosis) -> anyhow::Result<()> {
    writeln!(out, "\ntried:")?;
    for candidate in diagnosis.candidates.iter().take(MOST_CANDIDATES) {
        let mark = if candidate.accepted { "*" } else { " " };
        writeln!(
            out,
            "{mark} {:<24} rms {:.4}  held out {:.4}  {}",
            candidate.name,
            candidate.rms_um,
            candidate.holdout_rms_um,
            with_p(candidate.p_value)
        )?;
        if let Some((round, why)) = why_not(diagnosis, candidate) {
            writeln!(out, "    not taken{}: {why}", beside(round))?;
        }
        if !candidate.confounded_with.is_empty() {
            writeln!(out, "    cannot be told from: {}", candidate.confounded_with.join(", "))?;
        }
        if let Some(experiment) = &candidate.separate_by {
            writeln!(out, "    to tell: {experiment}")?;
        }
    }
    Ok(())
}

/// Why a candidate did not come into the model, and the last round that tried it.
fn why_not<'a>(diagnosis: &'a Diagnosis, candidate: &Ranked) -> Option<(&'a Round, &'a str)> {
    let rounds = diagnosis.rounds.iter().rev().filter(|_| !candidate.accepted);
    let mut rejected =
        rounds.flat_map(|round| round.rejected.iter().map(move |(name, why)| (round, name, why)));
    let (round, _, why) = rejected.find(|(_, name, _)| **name == candidate.name)?;
    Some((round, why))
}

/// What a round had found already: the figures of a candidate are those without.
fn beside(round: &Round) -> String {
    let names: Vec<&str> = round.effects.iter().map(|effect| effect.name.as_str()).collect();
    if names.is_empty() { String::new() } else { format!(" beside {}", names.join(", ")) }
}
