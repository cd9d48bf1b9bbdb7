//! The other end of a board's serial port: levels of its pins become bytes, and bytes levels.

use std::collections::VecDeque;

use super::rig::{Change, Gates};

/// Clocks of a bit: 12 MHz at 115 200 baud.
pub(super) const BIT_CLOCKS: u64 = 104;

/// Listens: bits become bytes as the clocks go on.
#[derive(Default)]
pub(super) struct Line {
    /// Changes of `tx` that were heard.
    heard: usize,
    low_since: Option<u64>,
    byte: u8,
    bits: u64,
    low: bool,
}

impl Line {
    /// Bytes that are over at that clock.
    pub(super) fn bytes(&mut self, log: &[Change], clock: u64) -> Vec<u8> {
        let mut bytes = vec![];
        for change in &log[self.heard..] {
            if change.pin == "tx" {
                bytes.extend(self.until(change.clock));
                self.low = !change.high;
                if self.low && self.low_since.is_none() {
                    (self.low_since, self.bits, self.byte) = (Some(change.clock), 0, 0);
                }
            }
        }
        self.heard = log.len();
        bytes.extend(self.until(clock));
        bytes
    }

    /// Takes the bits whose middle has passed; gives the byte when the stop bit has.
    fn until(&mut self, clock: u64) -> Option<u8> {
        while let Some(since) = self.low_since {
            let middle = since + BIT_CLOCKS / 2 + (self.bits + 1) * BIT_CLOCKS;
            if clock <= middle {
                return None;
            }
            if self.bits == 8 {
                assert!(!self.low, "a stop bit after the clock {since}");
                self.low_since = None;
                return Some(self.byte);
            }
            self.byte |= u8::from(!self.low) << self.bits;
            self.bits += 1;
        }
        None
    }
}

/// Talks: bytes become levels of `rx`.
#[derive(Default)]
pub(super) struct Speaker {
    bits: VecDeque<bool>,
}

impl Speaker {
    pub(super) fn say(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.bits.push_back(false);
            self.bits.extend((0..8).map(|bit| byte >> bit & 1 == 1));
            self.bits.push_back(true);
        }
    }

    /// Puts the next bit on the pin, if there is one, and runs until it is over; otherwise for as
    /// many clocks.
    pub(super) fn run(&mut self, gates: &mut Gates<'_>, clocks: u64) {
        let end = gates.clock()
            + match self.bits.pop_front() {
                Some(high) => {
                    gates.set("rx", high);
                    BIT_CLOCKS
                }
                None => clocks,
            };
        while gates.clock() < end {
            gates.run_until(end);
        }
    }
}
