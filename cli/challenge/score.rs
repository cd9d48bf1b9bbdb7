//! How well the diagnosis does on many challenges, against the figures it has to reach.

use std::collections::BTreeMap;
use std::io::Write;

use helixlock_lab::{Challenge, Diagnosis, Hidden, Outcome, Verdict, judge};
use helixlock_plant::Term;
use serde_json::{Value, json};

/// Counts over many challenges.
#[derive(Debug, Default)]
pub(crate) struct Score {
    outcomes: BTreeMap<(&'static str, &'static str), u64>,
    figures: BTreeMap<Figure, Share>,
    before: f64,
    after: f64,
    number: f64,
    wrong: Vec<u64>,
}

/// A share with a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Figure {
    NamedRightly,
    FalselyNamed,
    NothingMissing,
    Unexplained,
    HeldOut,
    Parameters,
}

/// Held-out error that counts as noise, against the true noise.
const HELD_OUT: f64 = 1.1;

impl Figure {
    fn words(self) -> &'static str {
        match self {
            Self::NamedRightly => "one effect, named rightly",
            Self::FalselyNamed => "falsely named",
            Self::NothingMissing => "nothing hidden, nothing missing",
            Self::Unexplained => "outside the catalogue, unexplained",
            Self::HeldOut => "explained, held out within 1.1 of noise",
            Self::Parameters => "true value within two standard errors",
        }
    }

    /// Lowest and highest share wanted, %.
    fn target_pct(self) -> [f64; 2] {
        match self {
            Self::NamedRightly | Self::Unexplained => [95.0, 100.0],
            Self::FalselyNamed => [0.0, 2.0],
            Self::NothingMissing => [98.0, 100.0],
            Self::HeldOut => [100.0, 100.0],
            Self::Parameters => [90.0, 99.0],
        }
    }
}

/// So many of so many.
#[derive(Debug, Clone, Copy, Default)]
struct Share {
    yes: f64,
    of: f64,
}

impl Share {
    fn add(&mut self, yes: bool) {
        self.of += 1.0;
        self.yes += f64::from(u8::from(yes));
    }

    fn pct(self) -> f64 {
        100.0 * self.yes / self.of.max(1.0)
    }

    /// 95 % interval of the true share, % (Wilson 1927, J. Am. Stat. Assoc. 22:209).
    fn interval_pct(self) -> [f64; 2] {
        const Z: f64 = 1.959_963_984_540_054;
        let (n, p) = (self.of.max(1.0), self.yes / self.of.max(1.0));
        let middle = p + Z * Z / (2.0 * n);
        let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let scale = 100.0 / (1.0 + Z * Z / n);
        [(scale * (middle - half)).max(0.0), (scale * (middle + half)).min(100.0)]
    }
}

impl Score {
    /// Counts one challenge with its diagnosis.
    pub(crate) fn add(&mut self, seed: u64, task: &Challenge, diagnosis: &Diagnosis) {
        let last = diagnosis.rounds.last();
        let names: Vec<String> = last
            .map(|round| round.effects.iter().map(|effect| effect.name.clone()).collect())
            .unwrap_or_default();
        let outcome = judge(&task.hidden, diagnosis.verdict, &names);
        if matches!(outcome, Outcome::FalselyNamed | Outcome::Missed) {
            self.wrong.push(seed);
        }
        *self.outcomes.entry((hidden_word(&task.hidden), outcome_word(outcome))).or_default() += 1;
        self.before += diagnosis.rounds.first().map_or(0.0, |round| round.rms_um);
        self.after += last.map_or(0.0, |round| round.holdout_rms_um);
        self.number += 1.0;
        self.count(Figure::FalselyNamed, outcome == Outcome::FalselyNamed);
        match &task.hidden {
            Hidden::Nothing => {
                self.count(Figure::NothingMissing, diagnosis.verdict == Verdict::NothingMissing);
            }
            Hidden::Outside(_) => {
                self.count(Figure::Unexplained, diagnosis.verdict == Verdict::Unexplained);
            }
            Hidden::Effects(effects) if effects.len() == 1 => {
                self.count(Figure::NamedRightly, outcome == Outcome::Right);
            }
            Hidden::Effects(_) => {}
        }
        if diagnosis.verdict == Verdict::Explained && outcome == Outcome::Right {
            let held_out = last.map_or(f64::INFINITY, |round| round.holdout_rms_um);
            self.count(Figure::HeldOut, held_out <= HELD_OUT * task.noise_um);
            self.parameters(&task.terms, diagnosis);
        }
    }

    fn count(&mut self, figure: Figure, yes: bool) {
        self.figures.entry(figure).or_default().add(yes);
    }

    /// Every fitted parameter with a standard error against its true value.
    fn parameters(&mut self, truth: &[Term], diagnosis: &Diagnosis) {
        let found = diagnosis.rounds.last().map_or(&[][..], |round| &round.effects);
        for term in truth {
            let Some(effect) = found.iter().find(|effect| effect.name == term.name) else {
                continue;
            };
            for (what, true_value) in term.parameters.iter().zip(&term.values) {
                let fitted = effect.parameters.iter().find(|one| one.key == what.key());
                let Some((fitted, stderr)) = fitted.and_then(|one| Some((one, one.stderr?))) else {
                    continue;
                };
                let turn = if what.unit.suffix() == "deg" { 360.0 } else { f64::INFINITY };
                let off = around(fitted.value - true_value, turn).abs();
                self.count(Figure::Parameters, off <= 2.0 * stderr);
            }
        }
    }

    /// Prints the counts and each figure with its interval and target.
    pub(crate) fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        for ((hidden, outcome), number) in &self.outcomes {
            writeln!(out, "{hidden:<24} {outcome:<16} {number:>5}")?;
        }
        for (figure, share) in &self.figures {
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
        let number = self.number.max(1.0);
        writeln!(out, "mean error before        {:.4} µm rms", self.before / number)?;
        writeln!(out, "mean error held out      {:.4} µm rms", self.after / number)?;
        if !self.wrong.is_empty() {
            writeln!(out, "seeds to look at: {:?}", self.wrong)?;
        }
        Ok(())
    }

    /// The same as JSON.
    pub(crate) fn json(&self) -> Value {
        let number = self.number.max(1.0);
        let figures = self.figures.iter().map(|(figure, share)| {
            json!({
                "figure": figure.words(),
                "yes": share.yes,
                "of": share.of,
                "share_pct": share.pct(),
                "interval_pct": share.interval_pct(),
                "target_pct": figure.target_pct(),
            })
        });
        json!({
            "outcomes": self.outcomes.iter().map(|((hidden, outcome), number)| json!({
                "hidden": hidden, "outcome": outcome, "number": number,
            })).collect::<Vec<_>>(),
            "figures": figures.collect::<Vec<_>>(),
            "mean_rms_before_um": self.before / number,
            "mean_holdout_rms_um": self.after / number,
            "seeds_to_look_at": self.wrong,
        })
    }
}

/// A difference brought within half a period of zero.
fn around(difference: f64, period: f64) -> f64 {
    if period.is_finite() {
        difference - period * (difference / period).round()
    } else {
        difference
    }
}

fn hidden_word(hidden: &Hidden) -> &'static str {
    match hidden {
        Hidden::Nothing => "nothing hidden",
        Hidden::Effects(effects) if effects.len() == 1 => "one effect",
        Hidden::Effects(_) => "two effects",
        Hidden::Outside(_) => "outside the catalogue",
    }
}

fn outcome_word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Right => "named rightly",
        Outcome::Abstained => "abstained",
        Outcome::FalselyNamed => "falsely named",
        Outcome::Missed => "missed",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_is_the_published_one() {
        // Newcombe 1998, Statist. Med. 17:857, table I: 81 of 263, score method 0.2553 to 0.3662.
        let [low, high] = Share { yes: 81.0, of: 263.0 }.interval_pct();
        assert!((low - 25.53).abs() < 0.01 && (high - 36.62).abs() < 0.01, "{low} {high}");
    }
}
