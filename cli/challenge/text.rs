//! A score in words.

use std::io::Write;

use helixlock_lab::Score;

/// Prints the counts and each figure with its interval and target.
pub(crate) fn print(score: &Score, out: &mut impl Write) -> anyhow::Result<()> {
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
