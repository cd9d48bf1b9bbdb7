//! A computer that reads a logic analyser: commands of its protocol, and what is none.

use std::collections::VecDeque;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// What it has still to send, and when.
#[derive(Default)]
pub(super) struct Sniffer {
    bytes: VecDeque<u8>,
    /// Clock of the next byte.
    due: usize,
    byte: u8,
    /// Commands since the analyser forgot what was set.
    commands: usize,
}

impl Sniffer {
    /// The analyser has forgotten what was set.
    pub(super) fn begin(&mut self) {
        self.bytes.clear();
        self.commands = 0;
    }

    /// A byte, if one comes over in this clock.
    pub(super) fn received(&mut self, clock: usize, random: &mut ChaCha8Rng) -> bool {
        if clock < self.due {
            return false;
        }
        if self.bytes.is_empty() {
            self.bytes = self.command(random).into();
        }
        self.byte = self.bytes.pop_front().unwrap_or_default();
        // A run is waited for, now and then not long enough; so is an answer.
        let pause = match (self.bytes.is_empty(), self.byte) {
            (true, 1) => [20..60, 200..700, 200..700][random.random_range(0..3_usize)].clone(),
            (true, 2 | 4) => 5..200,
            _ => 1..4,
        };
        self.due = clock + random.random_range(pause);
        true
    }

    /// The last byte.
    pub(super) fn byte(&self) -> u64 {
        self.byte.into()
    }

    /// Of what was forgotten, every second run shows a part: nothing is set, or one thing alone.
    fn command(&mut self, random: &mut ChaCha8Rng) -> Vec<u8> {
        self.commands += 1;
        match self.commands {
            1 | 3 => vec![1],
            2 => set(random),
            _ => match random.random_range(0..12) {
                0..6 => set(random),
                6..10 => vec![1],
                10 => vec![[0, 2, 4, 4][random.random_range(0..4_usize)]],
                _ => vec![random.random_range(0..0x80)],
            },
        }
    }
}

/// A command with four bytes behind it: mostly small numbers, so that a run ends.
fn set(random: &mut ChaCha8Rng) -> Vec<u8> {
    let wild: u32 = random.random();
    let [code, argument] = match random.random_range(0..9) {
        0 => [0x80, wild],
        1 | 2 => [0x80, random.random_range(0..60)],
        3 | 4 => {
            let total = random.random_range(0..8);
            // Bits that no count has are not looked at.
            [0x81, total | random.random_range(0..=total) << 16 | wild & 0xf000_f000]
        }
        5 => [0xc0, wild],
        6 => [0xc0, 1 << random.random_range(0..8_u32) | wild & 0xffff_ff00],
        7 => [0xc1, wild],
        _ => [random.random_range(0x80..0x100), wild],
    };
    let mut bytes = vec![code.to_le_bytes()[0]];
    bytes.extend(argument.to_le_bytes());
    bytes
}
