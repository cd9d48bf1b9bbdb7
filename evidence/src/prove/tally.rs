//! How many mutants were noticed.

use std::iter::Sum;

use super::mutants::Fate;
use super::table::Row;

/// How it begins to say how many there were.
const TRIED: &str = " mutants, one mistake each";

/// A campaign's mutants, counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// All of them.
    pub tried: usize,
    /// By the properties or by the lockstep.
    pub noticed: usize,
    /// By neither.
    pub survive: usize,
    /// No mistakes after all.
    pub equal: usize,
}

impl Tally {
    /// Counts fates.
    pub fn of<'a>(fates: impl Iterator<Item = &'a Fate>) -> Self {
        let mut tally = Self::default();
        for fate in fates {
            tally.tried += 1;
            match fate {
                Fate::Properties | Fate::Lockstep => tally.noticed += 1,
                Fate::Survived => tally.survive += 1,
                Fate::Equivalent => tally.equal += 1,
            }
        }
        tally
    }

    /// A block's row; without a block that of all, which says whether they are good enough.
    #[must_use]
    pub fn row(&self, block: &str) -> Row {
        let Self { tried, noticed, survive, equal } = self;
        let of = if block.is_empty() { String::new() } else { format!("`{block}`: ") };
        Row {
            what: format!("{of}{tried}{TRIED}"),
            how: "30 000 clocks in Icarus against the engine, then properties".to_owned(),
            outcome: format!(
                "{noticed} are noticed, {survive} survive; \
                 {equal} more are proven equal to the original"
            ),
            good: !block.is_empty() || 100 * noticed >= 95 * (noticed + survive),
        }
    }

    /// What a block's line of a printed table says, if it is one of mutants.
    #[must_use]
    pub fn of_line(line: &str) -> Option<Self> {
        let (what, rest) = line.strip_prefix("| `")?.split_once(TRIED)?;
        let (_, tried) = what.split_once("`: ")?;
        let (_, outcome) = rest.split_once(" | ")?.1.split_once(" | ")?;
        let (noticed, outcome) = outcome.split_once(" are noticed, ")?;
        let (survive, outcome) = outcome.split_once(" survive; ")?;
        let (equal, _) = outcome.split_once(' ')?;
        let count = |digits: &str| digits.parse().ok();
        Some(Self {
            tried: count(tried)?,
            noticed: count(noticed)?,
            survive: count(survive)?,
            equal: count(equal)?,
        })
    }
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(tallies: I) -> Self {
        tallies.fold(Self::default(), |sum, one| Self {
            tried: sum.tried + one.tried,
            noticed: sum.noticed + one.noticed,
            survive: sum.survive + one.survive,
            equal: sum.equal + one.equal,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_read_back() {
        let tally = Tally { tried: 42, noticed: 38, survive: 3, equal: 1 };
        assert_eq!(Tally::of_line(&tally.row("calibrator").line()), Some(tally));
        assert_eq!(Tally::of_line(&tally.row("").line()), None, "the sum is none of them");
        assert!(!tally.row("").good);
    }
}
