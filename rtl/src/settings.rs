//! Settings: what thumb wheels and switches say, as plain numbers.
//!
//! The [device](crate::device) takes binary-coded decimals; people and solvers take integers.

use std::fmt;

/// The two ranges of the phase meter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// 360° is `B·λ/2`.
    X1,
    /// 360° is twice that.
    X2,
}

impl Range {
    /// 1 or 2.
    #[must_use]
    pub fn factor(self) -> u32 {
        match self {
            Self::X1 => 1,
            Self::X2 => 2,
        }
    }
}

/// Every wheel and switch that is set before a pass.
///
/// # Examples
///
/// The 6 mm screw of document 1, with +6.4 µm/m taken out and 160 steps per second at 12 MHz:
///
/// ```
/// use helixlock_rtl::settings::{Range, Settings};
///
/// let settings = Settings {
///     a: 110,
///     b: 150,
///     range: Range::X2,
///     initial_phase: 150,
///     compensation_f: 156_000,
///     insert: false,
///     step_period: 75_000,
/// };
/// let wheels = settings.wheels()?;
/// assert_eq!(wheels.divide_a, 0x110);
/// assert_eq!(wheels.compensation, 0x0156);
/// # Ok::<(), helixlock_rtl::settings::SettingsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Grating divider A, 1 to 999.
    pub a: u32,
    /// Laser divider B, 1 to 999.
    pub b: u32,
    /// Range of the phase meter.
    pub range: Range,
    /// Laser pulses m before the grating starts, 0 to 999.
    pub initial_phase: u32,
    /// One pulse in F is blocked or inserted: a multiple of 1000 up to 9 999 000; 0 is off.
    pub compensation_f: u32,
    /// Insert the pulse instead of blocking one.
    pub insert: bool,
    /// Clocks from step to step, 1 to 16 777 215.
    pub step_period: u32,
}

/// What an encoder has beside its one signal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Encoder {
    /// A second signal, a quarter of a line behind: it may go back.
    pub quadrature: bool,
    /// An index, at which a pass begins.
    pub index: bool,
}

/// What stands between the pins of a board and the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conditioning {
    /// Clocks a grating or laser level has to stand, 0 to 15; 0 is off.
    pub glitch_clocks: u32,
    /// Ticks a switch or button has to stand, 0 to 15; 0 is off.
    pub debounce_ticks: u32,
    /// Clocks of such a tick, 1 to 16 777 215.
    pub tick_period: u32,
    /// Ticks without a line or a fringe after which the loop stops, 0 to 4095; 0 is off.
    pub watchdog_ticks: u32,
    /// Clocks of a bit of the serial port, 2 to 4095.
    pub bit_clocks: u32,
    /// Switches connect their pins to ground.
    pub active_low: bool,
    /// The range is a switch, and not that of the settings.
    pub range_pin: bool,
    /// Steps need a switch that allows them.
    pub enable_pin: bool,
    /// The grating.
    pub grating: Encoder,
    /// The interferometer, or a scale in its place.
    pub laser: Encoder,
}

impl Conditioning {
    /// Pins as they are: what the board shell did before it could do more.
    pub const OFF: Self = Self {
        glitch_clocks: 0,
        debounce_ticks: 0,
        tick_period: 1,
        watchdog_ticks: 0,
        bit_clocks: 104,
        active_low: false,
        range_pin: false,
        enable_pin: false,
        grating: Encoder { quadrature: false, index: false },
        laser: Encoder { quadrature: false, index: false },
    };

    /// Checks that counters can hold the numbers.
    ///
    /// # Errors
    ///
    /// The first that they cannot.
    pub fn check(&self) -> Result<(), SettingsError> {
        in_range("glitch filter", self.glitch_clocks, 0, 15)?;
        in_range("debouncing", self.debounce_ticks, 0, 15)?;
        in_range("tick period", self.tick_period, 1, 0xff_ffff)?;
        in_range("watchdog", self.watchdog_ticks, 0, 4095)?;
        in_range("bit of the serial port", self.bit_clocks, 2, 4095)
    }
}

/// The same as the levels on the device's inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wheels {
    /// A, three BCD digits.
    pub divide_a: u64,
    /// B, three BCD digits.
    pub divide_b: u64,
    /// 1 for ×2.
    pub range_x2: u64,
    /// m, three BCD digits.
    pub initial_phase: u64,
    /// F/1000, four BCD digits.
    pub compensation: u64,
    /// 1 for insert.
    pub compensation_insert: u64,
    /// Clocks from step to step.
    pub step_period: u64,
}

impl Settings {
    /// The levels for the device's inputs.
    ///
    /// # Errors
    ///
    /// A value no wheel can show.
    pub fn wheels(&self) -> Result<Wheels, SettingsError> {
        in_range("divider a", self.a, 1, 999)?;
        in_range("divider b", self.b, 1, 999)?;
        in_range("initial phase", self.initial_phase, 0, 999)?;
        in_range("compensation divider f", self.compensation_f, 0, 9_999_000)?;
        in_range("step period", self.step_period, 1, 0xff_ffff)?;
        if !self.compensation_f.is_multiple_of(1000) {
            return Err(SettingsError::LowDecades { found: self.compensation_f });
        }
        Ok(Wheels {
            divide_a: bcd(self.a),
            divide_b: bcd(self.b),
            range_x2: u64::from(self.range == Range::X2),
            initial_phase: bcd(self.initial_phase),
            compensation: bcd(self.compensation_f / 1000),
            compensation_insert: u64::from(self.insert),
            step_period: u64::from(self.step_period),
        })
    }
}

impl Wheels {
    /// Each level with the name of the device's input it goes to.
    #[must_use]
    pub fn named(&self) -> [(&'static str, u64); 7] {
        [
            ("divide_a", self.divide_a),
            ("divide_b", self.divide_b),
            ("range_x2", self.range_x2),
            ("initial_phase", self.initial_phase),
            ("compensation", self.compensation),
            ("compensation_insert", self.compensation_insert),
            ("step_period", self.step_period),
        ]
    }
}

/// Binary-coded decimal: each decimal digit in four bits.
///
/// # Examples
///
/// ```
/// assert_eq!(helixlock_rtl::settings::bcd(127), 0x127);
/// ```
#[must_use]
pub fn bcd(number: u32) -> u64 {
    let mut rest = u64::from(number);
    let mut coded = 0;
    let mut shift = 0;
    while rest > 0 {
        coded |= (rest % 10) << shift;
        rest /= 10;
        shift += 4;
    }
    coded
}

fn in_range(name: &'static str, found: u32, low: u32, high: u32) -> Result<(), SettingsError> {
    if (low..=high).contains(&found) {
        Ok(())
    } else {
        Err(SettingsError::OutOfRange { name, found, low, high })
    }
}

/// Why settings cannot be dialled.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SettingsError {
    /// A number the wheels cannot show.
    OutOfRange {
        /// What it sets.
        name: &'static str,
        /// The number.
        found: u32,
        /// The least the wheels show.
        low: u32,
        /// The most they show.
        high: u32,
    },
    /// Steps follow each other faster than a driver's pulses.
    StepTooFast {
        /// Clocks from step to step.
        found: u32,
        /// The least a pulse needs.
        least: u32,
    },
    /// F is not a multiple of 1000.
    LowDecades {
        /// The number.
        found: u32,
    },
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { name, found, low, high } => {
                write!(f, "{name} is `{found}`, expected {low} to {high}")
            }
            Self::StepTooFast { found, least } => {
                write!(f, "step period is `{found}` clocks, expected {least} or more at a step pin")
            }
            Self::LowDecades { found } => write!(
                f,
                "compensation divider f is `{found}`, expected a multiple of 1000: only four of \
                 its seven decades have wheels"
            ),
        }
    }
}

impl std::error::Error for SettingsError {}

#[cfg(test)]
mod tests {
    use super::*;

    const INCH: Settings = Settings {
        a: 132,
        b: 127,
        range: Range::X2,
        initial_phase: 126,
        compensation_f: 0,
        insert: false,
        step_period: 75_000,
    };

    #[test]
    fn digits_of_the_inch_screw() {
        let wheels = INCH.wheels().unwrap();
        assert_eq!((wheels.divide_a, wheels.divide_b), (0x132, 0x127));
        assert_eq!((wheels.initial_phase, wheels.compensation), (0x126, 0));
    }

    #[test]
    fn every_number_up_to_9999_reads_as_its_own_hexadecimal() {
        for number in 0..=9999 {
            assert_eq!(format!("{:x}", bcd(number)), number.to_string());
        }
    }

    #[test]
    fn refuses_what_the_wheels_cannot_show() {
        let cases = [
            (Settings { a: 0, ..INCH }, "divider a is `0`, expected 1 to 999"),
            (Settings { a: 1000, ..INCH }, "divider a is `1000`, expected 1 to 999"),
            (Settings { b: 0, ..INCH }, "divider b is `0`, expected 1 to 999"),
            (
                Settings { initial_phase: 1000, ..INCH },
                "initial phase is `1000`, expected 0 to 999",
            ),
            (
                Settings { compensation_f: 10_000_000, ..INCH },
                "compensation divider f is `10000000`, expected 0 to 9999000",
            ),
            (
                Settings { compensation_f: 156_250, ..INCH },
                "compensation divider f is `156250`, expected a multiple of 1000: only four of \
                 its seven decades have wheels",
            ),
            (Settings { step_period: 0, ..INCH }, "step period is `0`, expected 1 to 16777215"),
            (
                Settings { step_period: 1 << 24, ..INCH },
                "step period is `16777216`, expected 1 to 16777215",
            ),
        ];
        for (settings, expected) in cases {
            assert_eq!(settings.wheels().unwrap_err().to_string(), expected);
        }
    }
}
