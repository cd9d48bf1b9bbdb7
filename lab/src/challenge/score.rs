//! How well the diagnosis does on many challenges, against the figures it has to reach.

use std::collections::BTreeMap;

use super::{Outcome, Scored};

/// Counts over many challenges.
#[derive(Debug, Default)]
pub struct Score {
    /// What was hidden and what was said of it, in words, and how often.
    pub outcomes: BTreeMap<(&'static str, &'static str), u64>,
    /// How often each figure was asked, and met.
    pub figures: BTreeMap<Figure, Share>,
    /// Seeds whose answer was false or missing.
    pub wrong: Vec<u64>,
    before: f64,
    after: f64,
    number: f64,
}

/// A share with a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Figure {
    /// One effect hidden, and named.
    NamedRightly,
    /// An effect named that is not there.
    FalselyNamed,
    /// Nothing hidden, and so said.
    NothingMissing,
    /// Something outside the catalogue, and so said.
    Unexplained,
    /// Explained down to the noise on held-out data.
    HeldOut,
    /// A true value within two standard errors of the fitted one.
    Parameters,
}

impl Figure {
    /// All of them, in order.
    pub(super) const ALL: [Self; 6] = [
        Self::NamedRightly,
        Self::FalselyNamed,
        Self::NothingMissing,
        Self::Unexplained,
        Self::HeldOut,
        Self::Parameters,
    ];

    /// As the name of a column.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::NamedRightly => "named_rightly",
            Self::FalselyNamed => "falsely_named",
            Self::NothingMissing => "nothing_missing",
            Self::Unexplained => "unexplained",
            Self::HeldOut => "held_out",
            Self::Parameters => "parameters",
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
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
    #[must_use]
    pub fn target_pct(self) -> [f64; 2] {
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
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Share {
    /// So many.
    pub yes: f64,
    /// Of so many.
    pub of: f64,
}

impl Share {
    pub(super) fn add(&mut self, yes: bool) {
        self.of += 1.0;
        self.yes += f64::from(u8::from(yes));
    }

    /// The share, %.
    #[must_use]
    pub fn pct(self) -> f64 {
        100.0 * self.yes / self.of.max(1.0)
    }

    /// 95 % interval of the true share, % (Wilson 1927, J. Am. Stat. Assoc. 22:209).
    #[must_use]
    pub fn interval_pct(self) -> [f64; 2] {
        const Z: f64 = 1.959_963_984_540_054;
        let (n, p) = (self.of.max(1.0), self.yes / self.of.max(1.0));
        let middle = p + Z * Z / (2.0 * n);
        let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let scale = 100.0 / (1.0 + Z * Z / n);
        [(scale * (middle - half)).max(0.0), (scale * (middle + half)).min(100.0)]
    }
}

impl Score {
    /// Counts one challenge.
    pub fn add(&mut self, one: &Scored) {
        if matches!(one.outcome, Outcome::FalselyNamed | Outcome::Missed) {
            self.wrong.push(one.seed);
        }
        let words = (one.hidden.word(), outcome_word(one.outcome));
        *self.outcomes.entry(words).or_default() += 1;
        self.before += one.rms_um;
        self.after += one.holdout_rms_um;
        self.number += 1.0;
        for (figure, share) in Figure::ALL.into_iter().zip(one.shares) {
            if 0.0 < share.of {
                let sum = self.figures.entry(figure).or_default();
                sum.yes += share.yes;
                sum.of += share.of;
            }
        }
    }

    /// Mean error before the diagnosis, and after it on held-out data, µm rms.
    #[must_use]
    pub fn mean_rms_um(&self) -> [f64; 2] {
        [self.before, self.after].map(|sum| sum / self.number.max(1.0))
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
