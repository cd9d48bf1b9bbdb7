//! One challenge, as far as a score counts it.

use helixlock_plant::Term;

use super::{Challenge, Figure, Hidden, Outcome, Share, judge};
use crate::answer::{Diagnosis, Verdict};

/// Held-out error that counts as noise, against the true noise.
const HELD_OUT: f64 = 1.1;

/// How the diagnosis did on one challenge.
#[derive(Debug, Clone, PartialEq)]
pub struct Scored {
    pub(super) seed: u64,
    pub(super) hidden: HiddenKind,
    pub(super) outcome: Outcome,
    /// By figure, in order; of 0 where it was not asked.
    pub(super) shares: [Share; Figure::ALL.len()],
    /// Error before the diagnosis, µm rms.
    pub(super) rms_um: f64,
    /// Error after it on held-out data, µm rms.
    pub(super) holdout_rms_um: f64,
}

/// What was hidden, without its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HiddenKind {
    Nothing,
    OneEffect,
    TwoEffects,
    Outside,
}

impl HiddenKind {
    const ALL: [Self; 4] = [Self::Nothing, Self::OneEffect, Self::TwoEffects, Self::Outside];

    fn of(hidden: &Hidden) -> Self {
        match hidden {
            Hidden::Nothing => Self::Nothing,
            Hidden::Effects(effects) if effects.len() == 1 => Self::OneEffect,
            Hidden::Effects(_) => Self::TwoEffects,
            Hidden::Outside(_) => Self::Outside,
        }
    }

    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Nothing => "nothing hidden",
            Self::OneEffect => "one effect",
            Self::TwoEffects => "two effects",
            Self::Outside => "outside the catalogue",
        }
    }
}

const OUTCOMES: [Outcome; 4] =
    [Outcome::Right, Outcome::Abstained, Outcome::FalselyNamed, Outcome::Missed];

impl Scored {
    /// Judges the diagnosis of a challenge.
    #[must_use]
    pub fn new(seed: u64, task: &Challenge, diagnosis: &Diagnosis) -> Self {
        let last = diagnosis.rounds.last();
        let names: Vec<String> = last
            .map(|round| round.effects.iter().map(|effect| effect.name.clone()).collect())
            .unwrap_or_default();
        let mut scored = Self {
            seed,
            hidden: HiddenKind::of(&task.hidden),
            outcome: judge(&task.hidden, diagnosis.verdict, &names),
            shares: Default::default(),
            rms_um: diagnosis.rounds.first().map_or(0.0, |round| round.rms_um),
            holdout_rms_um: last.map_or(0.0, |round| round.holdout_rms_um),
        };
        scored.count_verdict(diagnosis.verdict);
        if diagnosis.verdict == Verdict::Explained && scored.outcome == Outcome::Right {
            let held_out = last.map_or(f64::INFINITY, |round| round.holdout_rms_um);
            scored.count(Figure::HeldOut, held_out <= HELD_OUT * task.noise_um);
            scored.count_parameters(&task.terms, diagnosis);
        }
        scored
    }

    fn count(&mut self, figure: Figure, yes: bool) {
        self.shares[figure as usize].add(yes);
    }

    fn count_verdict(&mut self, verdict: Verdict) {
        self.count(Figure::FalselyNamed, self.outcome == Outcome::FalselyNamed);
        match self.hidden {
            HiddenKind::Nothing => {
                self.count(Figure::NothingMissing, verdict == Verdict::NothingMissing);
            }
            HiddenKind::Outside => self.count(Figure::Unexplained, verdict == Verdict::Unexplained),
            HiddenKind::OneEffect => {
                self.count(Figure::NamedRightly, self.outcome == Outcome::Right);
            }
            HiddenKind::TwoEffects => {}
        }
    }

    /// Every fitted parameter with a standard error against its true value.
    fn count_parameters(&mut self, truth: &[Term], diagnosis: &Diagnosis) {
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

    /// Names of the columns of a table of many.
    pub fn columns() -> impl Iterator<Item = String> {
        let first = ["seed", "hidden", "outcome", "rms_um", "holdout_rms_um"].map(str::to_owned);
        let shares = Figure::ALL
            .iter()
            .flat_map(|figure| ["yes", "of"].map(|word| format!("{}_{word}", figure.key())));
        first.into_iter().chain(shares)
    }

    /// Its row: what was hidden and what came of it as places in their lists, which
    /// [`Self::from_cells`] reads back.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "seeds below 2⁵³, lists of four")]
    pub fn cells(&self) -> Vec<f64> {
        let place = |place: Option<usize>| place.map_or(f64::NAN, |place| place as f64);
        let hidden = place(HiddenKind::ALL.iter().position(|one| *one == self.hidden));
        let outcome = place(OUTCOMES.iter().position(|one| *one == self.outcome));
        let first = [self.seed as f64, hidden, outcome, self.rms_um, self.holdout_rms_um];
        first
            .into_iter()
            .chain(self.shares.iter().flat_map(|share| [share.yes, share.of]))
            .collect()
    }

    /// Reads a row back; `None` when it is none.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
    pub fn from_cells(cells: &[f64]) -> Option<Self> {
        let whole = |cell: f64| (0.0 <= cell && cell.fract() == 0.0).then_some(cell as u64);
        let [seed, hidden, outcome, rms_um, holdout_rms_um, shares @ ..] = cells else {
            return None;
        };
        let shares: Vec<Share> =
            shares.chunks_exact(2).map(|pair| Share { yes: pair[0], of: pair[1] }).collect();
        Some(Self {
            seed: whole(*seed)?,
            hidden: *HiddenKind::ALL.get(whole(*hidden)? as usize)?,
            outcome: *OUTCOMES.get(whole(*outcome)? as usize)?,
            shares: shares.try_into().ok()?,
            rms_um: *rms_um,
            holdout_rms_um: *holdout_rms_um,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_reads_back() {
        let mut one = Scored {
            seed: 7,
            hidden: HiddenKind::Outside,
            outcome: Outcome::Missed,
            shares: Default::default(),
            rms_um: 0.3,
            holdout_rms_um: 0.1,
        };
        one.count(Figure::Unexplained, true);
        assert_eq!(one.cells().len(), Scored::columns().count());
        assert_eq!(Scored::from_cells(&one.cells()), Some(one.clone()));
        let mut broken = one.cells();
        broken[1] = 4.0;
        assert_eq!(Scored::from_cells(&broken), None);
        assert_eq!(Scored::from_cells(&one.cells()[1..]), None);
    }
}
