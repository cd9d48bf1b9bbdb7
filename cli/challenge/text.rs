//! A score in words.

use std::io::Write;

use helixlock_lab::{Experimented, Outcome, Score};

/// Prints the counts and each figure with its interval and target.
pub(crate) fn print(score: &Score, out: &mut dyn Write) -> anyhow::Result<()> {
    for ((hidden, outcome), number) in &score.outcomes {
        writeln!(out, "{hidden:<24} {outcome:<16} {number:>5}")?;
    }
    for (figure, share) in &score.figures {
        let ([low, high], [least, most]) = (share.interval_pct(), figure.target_pct());
        let words = figure.words();
        writeln!(
            out,
            "{words:<40} {:>4} of {:<4} {:>5.1} %  (95 %: {low:.1} to {high:.1}; target {least} to {most})",
            share.yes,
            share.of,
            share.pct()
        )?;
    }
    let [before, after] = score.mean_rms_um();
    writeln!(out, "mean error before        {before:.4} µm rms")?;
    writeln!(out, "mean error held out      {after:.4} µm rms")?;
    if !score.wrong.is_empty() {
        writeln!(out, "seeds to look at: {:?}", score.wrong)?;
    }
    Ok(())
}

/// A line a record, then how many of the confused were settled.
pub(super) fn print_experiments(
    tried: &[(u64, Experimented)],
    out: &mut impl Write,
) -> anyhow::Result<()> {
    for (seed, one) in tried {
        write!(out, "{seed}: {} hidden, {}", one.hidden, one.before.0.word())?;
        if let (Some((action, evidence)), Some(after)) = (&one.advised, one.after) {
            write!(out, "; {action} (evidence {evidence:.0} expected): {}", after.0.word())?;
            write!(out, ", {}", if after.1 == Outcome::Right { "right" } else { "not right" })?;
        }
        writeln!(out)?;
    }
    let after: Vec<Outcome> = tried.iter().filter_map(|(_, one)| one.after).map(|a| a.1).collect();
    let right = after.iter().filter(|outcome| **outcome == Outcome::Right).count();
    writeln!(out, "{} confused, {right} of them right after the experiment", after.len())?;
    Ok(())
}
