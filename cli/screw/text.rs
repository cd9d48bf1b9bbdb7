//! A graded screw in words.

use std::io::Write;

use helixlock_metrology::screw::Estimate;

use super::evaluation::Evaluation;
use crate::shared::sheet::Sheet;

/// Characteristics, grade, notes; `asked` is the grade asked for, and whether it is met.
pub(crate) fn print(
    out: &mut impl Write,
    evaluation: &Evaluation,
    asked: Option<(&str, bool)>,
) -> anyhow::Result<()> {
    let (curve, grading) = (&evaluation.curve, &evaluation.grading);
    let (length, samples) = (curve.length_mm(), curve.travel_mm().len());
    writeln!(
        out,
        "{}: {samples} samples over {length:.3} mm, by {}",
        evaluation.path.display(),
        evaluation.standard
    )?;
    if let Some(intervals) = evaluation.intervals_in_300_mm {
        writeln!(out, "{intervals} intervals in 300 mm, every sample a start")?;
    }
    let slope = evaluation.mean_line.slope_um_per_mm * 1000.0;
    writeln!(out, "mean line {slope:+.3} µm/m\n")?;
    for (one, without_noise) in evaluation.without_noise() {
        if let Ok(reached) = &one.reached {
            let [from, to] = reached.stretch_mm();
            writeln!(
                out,
                "{:<6} {:9.3} µm   {from:10.3} … {to:.3} mm   {}",
                one.symbol, reached.value_um, one.meaning
            )?;
            if let Some(Estimate { size_um, uncertainty_um }) = without_noise {
                let twice = 2.0 * uncertainty_um;
                writeln!(out, "       {size_um:9.3} µm   without noise, ± {twice:.3} µm (k = 2)")?;
            }
        }
    }
    writeln!(out)?;
    let status = grading.status.name();
    match &grading.grade {
        Some(grade) => writeln!(out, "grade {grade} (limits {status})")?,
        None => writeln!(out, "no grade of the table holds (limits {status})")?,
    }
    for verdict in &grading.verdicts {
        if let Some(probability) = verdict.probability {
            writeln!(out, "  grade {} or better: probability {probability:.4}", verdict.grade)?;
        }
    }
    if let Some((grade, meets)) = asked {
        writeln!(out, "grade {grade} is {}", if meets { "met" } else { "not met" })?;
    }
    for line in evaluation.sheet.iter().flat_map(Sheet::words) {
        writeln!(out, "{line}")?;
    }
    for note in evaluation.notes() {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}
