//! Instants of the plant become clock numbers of the logic: one pulse a grating line or fringe.
//!
//! A photo-receiver's pulse shaper is modelled as what the FPGA pin sees of it: a pulse of
//! [`PULSE_CLOCKS`], low for at least as long afterwards. The synchronisers are part of the logic
//! and are not repeated here.
//!
//! ```text
//! instant       t
//! clock edges   |   |   |   |   |        edge n comes at n / f
//! pin           ▁▁▁▁▔▔▔▔▔▔▔▔▁▁▁▁         set after edge floor(t·f), first seen by the next one
//! ```

use crate::Error;

/// Clocks a pulse stays high, and at least stays low before the next one.
pub const PULSE_CLOCKS: u64 = 2;

/// Clocks a pulse may wait for the one before it: a slip of a few fringes at one instant comes out
/// as pulses in quick succession, a lasting rush is an error.
const LONGEST_WAIT_CLOCKS: u64 = 1_000;

/// The clock after whose edge a change at `time_s` shows at a pin.
///
/// `time_s` is not negative and `time_s · clock_hz` stays below 2⁵³.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "times count from zero, and a product of 2⁵³ clocks is years of grinding"
)]
pub fn clock_of(time_s: f64, clock_hz: f64) -> u64 {
    (time_s * clock_hz) as u64
}

/// The instant of a clock edge, s.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "clock numbers stay below 2⁵³")]
pub fn time_of(clock: u64, clock_hz: f64) -> f64 {
    clock as f64 / clock_hz
}

/// A pin that carries one pulse per line or fringe.
#[derive(Clone, Copy, Debug)]
pub struct PulsePin {
    name: &'static str,
    high: bool,
    rise: Option<u64>,
    fall: Option<u64>,
    free_from: u64,
}

impl PulsePin {
    /// A pin that is low; `name` is for messages.
    #[must_use]
    pub fn new(name: &'static str) -> Self {
        Self { name, high: false, rise: None, fall: None, free_from: 0 }
    }

    /// Plans the next pulse for the instant `time_s`, instead of one planned but not begun; an
    /// instant before clock `now` means now.
    ///
    /// # Errors
    ///
    /// [`Error::PulsesTooFast`] when pulses keep coming faster than the pin can show them.
    pub fn plan(&mut self, time_s: f64, now: u64, clock_hz: f64) -> Result<(), Error> {
        let asked = clock_of(time_s, clock_hz);
        let rise = asked.max(now).max(self.free_from);
        if rise - asked > LONGEST_WAIT_CLOCKS {
            return Err(Error::PulsesTooFast { input: self.name, time_s, clock_hz });
        }
        self.rise = Some(rise);
        Ok(())
    }

    /// Plans no further pulse; one that has begun still ends.
    pub fn cancel(&mut self) {
        self.rise = None;
    }

    /// The clock of the next change, if one is planned.
    #[must_use]
    pub fn next_change(&self) -> Option<u64> {
        self.fall.or(self.rise)
    }

    /// Takes the change due at `clock`; true when the pin has just risen.
    pub fn change(&mut self, clock: u64) -> bool {
        if self.fall == Some(clock) {
            self.high = false;
            self.fall = None;
            return false;
        }
        if self.fall.is_some() || self.rise != Some(clock) {
            return false;
        }
        self.high = true;
        self.rise = None;
        self.fall = Some(clock + PULSE_CLOCKS);
        self.free_from = clock + 2 * PULSE_CLOCKS;
        true
    }

    /// Level of the pin.
    #[must_use]
    pub fn is_high(&self) -> bool {
        self.high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOCK_HZ: f64 = 12e6;

    /// Clocks of rise and fall of pulses asked for at these clock numbers.
    fn pulses(asked: &[u64]) -> Vec<(u64, u64)> {
        let mut pin = PulsePin::new("laser");
        let mut seen = Vec::new();
        for &clock in asked {
            pin.plan(time_of(clock, CLOCK_HZ) + 1e-9, 0, CLOCK_HZ).unwrap();
            let rise = loop {
                let next = pin.next_change().unwrap();
                if pin.change(next) {
                    break next;
                }
            };
            seen.push((rise, pin.next_change().unwrap()));
        }
        seen
    }

    #[test]
    fn a_change_shows_after_the_edge_before_it() {
        assert_eq!(clock_of(2.5 / CLOCK_HZ, CLOCK_HZ), 2);
        assert_eq!(clock_of(0.0, CLOCK_HZ), 0);
    }

    #[test]
    fn pulses_far_apart_come_when_asked() {
        assert_eq!(pulses(&[10, 2_541]), [(10, 12), (2_541, 2_543)]);
    }

    #[test]
    fn pulses_at_one_instant_come_one_after_the_other() {
        assert_eq!(pulses(&[10, 10, 10]), [(10, 12), (14, 16), (18, 20)]);
    }

    #[test]
    fn a_lasting_rush_is_an_error() {
        let mut pin = PulsePin::new("laser");
        let mut now = 0;
        let refused = (0..2_000).find_map(|_| {
            let result = pin.plan(0.0, now, CLOCK_HZ);
            while result.is_ok() && !pin.change(now) {
                now = pin.next_change().unwrap();
            }
            result.err()
        });
        assert!(matches!(refused, Some(Error::PulsesTooFast { input: "laser", .. })));
    }
}
