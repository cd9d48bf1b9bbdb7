//! The unit of time of a dump.

use std::str::FromStr;

use ::vcd::TimescaleUnit;

/// Unit of time of a dump: a count of seconds, milliseconds … femtoseconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tick {
    pub(crate) count: u32,
    pub(crate) unit: TimescaleUnit,
}

impl Tick {
    /// 1 ps: a clock of 12 MHz, which no decimal unit meets, is off by half of that at most.
    pub const PICOSECOND: Self = Self { count: 1, unit: TimescaleUnit::PS };
    /// 1 ns.
    pub const NANOSECOND: Self = Self { count: 1, unit: TimescaleUnit::NS };

    /// Length of a tick in femtoseconds, exactly.
    #[must_use]
    pub fn femtoseconds(self) -> u128 {
        let per_second = u128::from(TimescaleUnit::FS.divisor());
        u128::from(self.count) * (per_second / u128::from(self.unit.divisor()))
    }

    /// The power of ten of a second that a tick is: −12 for a picosecond.
    #[must_use]
    pub(crate) fn exponent(self) -> i8 {
        let digits = self.femtoseconds().ilog10();
        i8::try_from(digits).map_or(0, |digits| digits - 15)
    }

    /// An instant counted in ticks, in seconds.
    ///
    /// ```
    /// use helixlock_traces::Tick;
    /// assert_eq!(Tick::NANOSECOND.seconds(1_500_000_000), 1.5);
    /// ```
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "beyond 2^53 ticks the nearest number is meant")]
    pub fn seconds(self, ticks: u64) -> f64 {
        // One division, so that the result is the number nearest to the decimal fraction.
        (u128::from(ticks) * u128::from(self.count)) as f64 / self.unit.divisor() as f64
    }

    /// The tick nearest to a rising edge of a clock, counted from 0; no error adds up.
    ///
    /// ```
    /// use helixlock_traces::Tick;
    /// assert_eq!(Tick::PICOSECOND.of_clock(1, 12_000_000), 83_333);
    /// assert_eq!(Tick::PICOSECOND.of_clock(12_000_000, 12_000_000), 1_000_000_000_000);
    /// ```
    #[must_use]
    pub fn of_clock(self, clock: u64, clock_hz: u64) -> u64 {
        let per_second = u128::from(self.unit.divisor());
        let ticks_by_clock = u128::from(clock) * per_second;
        let divisor = u128::from(clock_hz.max(1)) * u128::from(self.count);
        u64::try_from((ticks_by_clock + divisor / 2) / divisor).unwrap_or(u64::MAX)
    }
}

impl FromStr for Tick {
    type Err = ();

    /// Reads `1ns`, `10 us`.
    fn from_str(text: &str) -> Result<Self, ()> {
        let unit_at = text.find(|c: char| !c.is_ascii_digit()).ok_or(())?;
        let (count, unit) = text.split_at(unit_at);
        let count = count.parse().map_err(|_| ())?;
        let unit = unit.trim().parse().map_err(|_| ())?;
        if count == 0 { Err(()) } else { Ok(Self { count, unit }) }
    }
}
