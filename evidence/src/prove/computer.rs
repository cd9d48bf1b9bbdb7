//! A computer at the serial port of a board: requests of the settings port, and what is none.

use std::collections::VecDeque;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Clocks of a bit in the blocks' examples.
const BIT_CLOCKS: usize = 2;

/// What it has still to send, and when.
#[derive(Default)]
pub(super) struct Computer {
    bytes: VecDeque<u8>,
    /// On a line: bits of the byte under way.
    bits: VecDeque<u64>,
    /// Numbers need not be small.
    wild: bool,
    /// Clock of the next byte, or of the next bit.
    due: usize,
    byte: u8,
    bit: u64,
}

impl Computer {
    /// One whose numbers have all their digits.
    pub(super) fn wild() -> Self {
        Self { wild: true, ..Self::default() }
    }

    /// A byte, if one comes over in this clock.
    pub(super) fn received(&mut self, clock: usize, random: &mut ChaCha8Rng) -> bool {
        if clock < self.due {
            return false;
        }
        self.byte = self.next_byte(random);
        // Bits of a digit take four clocks. An answer is waited for, now and then not long enough.
        let pause = match (self.bytes.is_empty(), random.random_range(0..200)) {
            (true, _) => 20..500,
            (_, 0) => 1..5,
            _ => 5..12,
        };
        self.due = clock + random.random_range(pause);
        true
    }

    /// The last byte.
    pub(super) fn byte(&self) -> u64 {
        self.byte.into()
    }

    /// The level of a line.
    pub(super) fn line(&mut self, clock: usize, random: &mut ChaCha8Rng) -> u64 {
        if clock < self.due {
            return self.bit;
        }
        if self.bits.is_empty() {
            let byte = u64::from(self.next_byte(random));
            self.bits.push_back(0);
            self.bits.extend((0..8).map(|bit| byte >> bit & 1));
            self.bits.push_back(1);
        }
        self.bit = self.bits.pop_front().unwrap_or(1);
        let over = self.bits.is_empty() && self.bytes.is_empty();
        self.due = clock + if over { random.random_range(100..800) } else { BIT_CLOCKS };
        self.bit
    }

    fn next_byte(&mut self, random: &mut ChaCha8Rng) -> u8 {
        if self.bytes.is_empty() {
            self.bytes = request(self.wild, random).into();
        }
        self.bytes.pop_front().unwrap_or_default()
    }
}

/// Bytes of a request, as the page of the settings port has them; one in ten came over wrong.
fn request(wild: bool, random: &mut ChaCha8Rng) -> Vec<u8> {
    let kind = [3, 3, 3, 3, 2, 1, random.random_range(0..16)][random.random_range(0..7_usize)];
    let mut digits = vec![kind];
    // A, B, m, F/1000.
    for places in [3, 3, 3, 4] {
        let shown = if wild && random.random_range(0..2) == 0 { places } else { 1 };
        let number = (0..places).map(|place| match random.random_range(0..60) {
            0 => random.random_range(0..16),
            _ if place >= shown => 0,
            _ if wild => random.random_range(0..10),
            _ => random.random_range(1..5),
        });
        digits.extend(number);
    }
    let period = match random.random_range(0..8) {
        0 => random.random_range(0..128_u32),
        _ if wild => random.random_range(0..0x100_0000),
        _ => random.random_range(128..300),
    };
    digits.extend((0..6).map(|place| (period >> (4 * place) & 15).to_le_bytes()[0]));
    digits.push(if random.random_range(0..12) == 0 { 7 } else { random.random_range(0..4) });
    let check = check_of(&digits);
    digits.extend((0..4).map(|place| (check >> (4 * place) & 15).to_le_bytes()[0]));
    let mut bytes = vec![0x1a];
    bytes.extend(digits.iter().map(|digit| 0x30 | digit));
    bytes.push(0);
    if random.random_range(0..10) == 0 {
        let place = random.random_range(0..bytes.len());
        bytes[place] ^= 1 << random.random_range(0..8_u32);
    }
    bytes
}

/// CRC-16/IBM-SDLC of four bits a digit.
fn check_of(digits: &[u8]) -> u16 {
    let bits = digits.iter().flat_map(|digit| (0..4).map(move |bit| u16::from(digit >> bit & 1)));
    !bits.fold(0xffff, |crc: u16, bit| (crc >> 1) ^ (0x8408 * ((crc ^ bit) & 1)))
}
