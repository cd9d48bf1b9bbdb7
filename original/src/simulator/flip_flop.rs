//! JK flip-flop of master and slave.
//!
//! The master listens all the while the clock is high, and keeps what it once heard: J when the
//! flip-flop is low, K when it is high. The slave takes it when the clock falls. Preset and clear
//! act at once on both; clear wins.

use crate::library::FLIP_FLOP_PULSES;

use super::findings::Check;

/// Levels at the pins.
#[expect(clippy::struct_excessive_bools, reason = "a flip-flop has five pins, each with a level")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pins {
    pub(super) clock: bool,
    pub(super) preset: bool,
    pub(super) clear: bool,
    pub(super) j: bool,
    pub(super) k: bool,
}

/// Master, slave, and what the checks remember.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlipFlop {
    slave: bool,
    master: bool,
    seen: Pins,
    /// Last edges of clock and of preset or clear; `None` before there was one.
    clock_ps: Option<u64>,
    preset_ps: Option<u64>,
    clear_ps: Option<u64>,
}

impl FlipFlop {
    pub(super) fn new(level: bool) -> Self {
        let seen = Pins { clock: false, preset: true, clear: true, j: true, k: true };
        let (slave, master) = (level, level);
        Self { slave, master, seen, clock_ps: None, preset_ps: None, clear_ps: None }
    }

    pub(super) fn level(&self) -> bool {
        self.slave
    }

    /// Power comes, with these levels at the pins.
    pub(super) fn wake(&mut self, pins: Pins) {
        self.seen = pins;
        self.master = self.slave;
        self.follow(pins, false);
    }

    /// Something changed at the pins; `note` gets what the data sheet does not allow.
    pub(super) fn look(&mut self, now_ps: u64, pins: Pins, mut note: impl FnMut(Check, u64)) {
        let seen = std::mem::replace(&mut self.seen, pins);
        self.check(now_ps, seen, pins, &mut note);
        self.follow(pins, seen.clock && !pins.clock);
    }

    fn follow(&mut self, pins: Pins, falls: bool) {
        if !pins.clear || !pins.preset {
            self.slave = pins.clear;
            self.master = self.slave;
            return;
        }
        if falls {
            self.slave = self.master;
        }
        if !pins.clock {
            self.master = self.slave;
        } else if self.slave && pins.k {
            self.master = false;
        } else if !self.slave && pins.j {
            self.master = true;
        }
    }

    fn check(&mut self, now_ps: u64, seen: Pins, pins: Pins, note: &mut impl FnMut(Check, u64)) {
        let limits = FLIP_FLOP_PULSES;
        if seen.clock != pins.clock {
            let (check, shortest_ps) = if seen.clock {
                (Check::ClockHigh, limits.clock_high_ps)
            } else {
                (Check::ClockLow, limits.clock_low_ps)
            };
            let since_ps = self.clock_ps.replace(now_ps);
            too_short(now_ps, since_ps, shortest_ps, |width_ps| note(check, width_ps));
        } else if pins.clock && pins.clear && pins.preset && (seen.j, seen.k) != (pins.j, pins.k) {
            note(Check::Data, now_ps - self.clock_ps.unwrap_or(0));
        }
        let directs = [
            (seen.preset, pins.preset, &mut self.preset_ps),
            (seen.clear, pins.clear, &mut self.clear_ps),
        ];
        for (was, is, since_ps) in directs {
            if was != is {
                let began_ps = since_ps.replace(now_ps).filter(|_| is);
                too_short(now_ps, began_ps, limits.preset_clear_ps, |width_ps| {
                    note(Check::PresetClear, width_ps);
                });
            }
        }
    }
}

fn too_short(now_ps: u64, since_ps: Option<u64>, shortest_ps: u64, note: impl FnOnce(u64)) {
    if let Some(width_ps) = since_ps.map(|since_ps| now_ps - since_ps)
        && width_ps < shortest_ps
    {
        note(width_ps);
    }
}
