//! Times of an export, in seconds.
//!
//! "Full Timestamp" writes them as FILETIME: counts of 100 ns since 1601. Otherwise they are milliseconds from
//! the first sample of the export, with a sign where a channel began earlier.

use crate::number::number;

/// Smallest count of 100 ns that is taken for a FILETIME: the year 1604; milliseconds never get there.
const FILETIME: i64 = 1_000_000_000_000_000;
/// Counts of 100 ns from 1601 to 1970 (Microsoft, "Converting a `time_t` value to a FILETIME").
const UNIX_EPOCH: i64 = 116_444_736_000_000_000;

/// How the times of a file are written; its first one tells.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Counts of 100 ns, with the first of them.
    Ticks(i64),
    Milliseconds,
}

/// Reads times as the first was written.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock {
    kind: Option<Kind>,
}

impl Clock {
    /// Seconds from the first count; nothing for a cell that is no time, or one of the other kind.
    ///
    /// The counts are subtracted as whole numbers: as `f64` they would be 1.6 µs apart.
    pub(super) fn seconds(&mut self, cell: &str, decimal: char) -> Option<f64> {
        let ticks = cell.parse::<i64>().ok().filter(|ticks| FILETIME <= *ticks);
        let kind = match (self.kind, ticks) {
            (Some(kind), _) => kind,
            (None, Some(ticks)) => Kind::Ticks(ticks),
            (None, None) => Kind::Milliseconds,
        };
        let seconds = match kind {
            Kind::Ticks(first) => whole(ticks? - first) / 1e7,
            Kind::Milliseconds => {
                number(cell, decimal).filter(|time| time.abs() < whole(FILETIME))? / 1e3
            }
        };
        self.kind = Some(kind);
        Some(seconds)
    }

    /// The second since 1970 from which the seconds count, where the file tells it.
    pub(super) fn origin_s(self) -> Option<f64> {
        match self.kind? {
            Kind::Ticks(first) => Some(whole(first - UNIX_EPOCH) / 1e7),
            Kind::Milliseconds => None,
        }
    }

    /// What a time looks like in this file.
    pub(super) fn expected(self) -> &'static str {
        match self.kind {
            None => "a time in milliseconds, or in 100 ns since 1601",
            Some(Kind::Ticks(_)) => "a time in 100 ns since 1601, as in the rows above",
            Some(Kind::Milliseconds) => "a time in milliseconds, as in the rows above",
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "a recording lasts fewer than 2⁵³ counts: 28 years")]
fn whole(count: i64) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 132 900 081 483 250 000 is 2022-02-22 12:55:48.325 UTC.
    #[test]
    fn counts_since_1601_are_exact() {
        let mut clock = Clock::default();
        let mut at = |cell| clock.seconds(cell, '.');
        assert_eq!(at("132900081483250000"), Some(0.0));
        assert_eq!(at("132900081483250001"), Some(1e-7));
        assert_eq!(at("132900081483150000"), Some(-0.01));
        assert_eq!(at("40"), None, "milliseconds among counts");
        assert_eq!(clock.origin_s(), Some(1_645_534_548.325));
    }

    #[test]
    fn milliseconds_have_a_sign_and_a_fraction() {
        let mut clock = Clock::default();
        let mut at = |cell| clock.seconds(cell, ',');
        assert_eq!(at("-3"), Some(-0.003));
        assert_eq!(at("0,2"), Some(0.0002));
        assert_eq!(at("132900081483250000"), None, "a count among milliseconds");
        assert_eq!(clock.origin_s(), None);
        assert_eq!(Clock::default().seconds("1.329E+17", '.'), None, "digits are lost");
    }
}
