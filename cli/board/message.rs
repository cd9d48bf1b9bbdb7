//! Requests to the settings port of a board, and its answers.
//!
//! The layout is that of the block's page, `rtl/src/settings_port.rs`.

use helixlock_rtl::settings::Wheels;

use super::frame::check_of_bits;

/// What every settings port calls itself.
pub(super) const IDENTIFIER: u32 = 7430;

/// Version of the layout that is spoken here.
pub(super) const VERSION: u32 = 1;

/// Digits of a message, its check included.
const DIGITS: usize = 25;

/// Digits of each setting, in the order of the line: A, B, m, F/1000, step period.
const PLACES: [usize; 5] = [3, 3, 3, 4, 6];

/// What a board is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Request {
    /// What it is.
    Identify,
    /// The settings it has.
    Read,
    /// To take these.
    Write(Wheels),
}

/// What it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// What it is.
    Identity(Identity),
    /// The settings it has.
    Settings(Wheels),
    /// The same, after it has taken them.
    Written(Wheels),
    /// The same: it did not take others, being not at rest.
    NotAtRest(Wheels),
    /// The same: no wheel shows the others.
    NotShown(Wheels),
}

/// What a board is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Identity {
    /// 7430.
    pub(super) identifier: u32,
    /// Of the layout of its messages.
    pub(super) version: u32,
    /// Its clock.
    pub(super) clocks_a_millisecond: u32,
}

impl Request {
    /// Its bytes, byte stuffing and end included.
    pub(super) fn on_the_wire(&self) -> Vec<u8> {
        let none = [0; DIGITS - 5];
        let (kind, content) = match self {
            Self::Identify => (1, none),
            Self::Read => (2, none),
            Self::Write(wheels) => (3, digits(wheels)),
        };
        let mut all = vec![kind];
        all.extend(content);
        let check = u64::from(check_of(&all));
        all.extend((0..4).map(|place| digit(check, place)));
        let bytes: Vec<u8> = all.iter().map(|digit| 0x30 | digit).collect();
        let mut wire = cobs::encode_vec(&bytes);
        wire.push(0);
        wire
    }
}

impl Answer {
    /// Reads a message without its byte stuffing.
    pub(super) fn read(bytes: &[u8]) -> Option<Self> {
        if bytes.len() != DIGITS || bytes.iter().any(|byte| byte >> 4 != 3) {
            return None;
        }
        let all: Vec<u8> = bytes.iter().map(|byte| byte & 15).collect();
        let (content, check) = all.split_at(DIGITS - 4);
        if number(check) != u64::from(check_of(content)) {
            return None;
        }
        let (kind, content) = content.split_first()?;
        Some(match kind {
            1 => Self::Identity(Identity::read(content)),
            2 => Self::Settings(wheels(content)),
            3 => Self::Written(wheels(content)),
            4 => Self::NotAtRest(wheels(content)),
            5 => Self::NotShown(wheels(content)),
            _ => return None,
        })
    }

    /// True when that was asked.
    pub(super) fn is_to(&self, request: &Request) -> bool {
        match request {
            Request::Identify => matches!(self, Self::Identity(_)),
            Request::Read => matches!(self, Self::Settings(_)),
            Request::Write(_) => {
                matches!(self, Self::Written(_) | Self::NotAtRest(_) | Self::NotShown(_))
            }
        }
    }
}

impl Identity {
    fn read(content: &[u8]) -> Self {
        let decimal = |digits: &[u8]| {
            digits.iter().rev().fold(0, |number, digit| 10 * number + u32::from(*digit))
        };
        Self {
            identifier: decimal(&content[..4]),
            version: decimal(&content[4..5]),
            clocks_a_millisecond: u32::try_from(number(&content[13..19])).unwrap_or_default(),
        }
    }
}

fn digits(wheels: &Wheels) -> [u8; DIGITS - 5] {
    let numbers = [
        wheels.divide_a,
        wheels.divide_b,
        wheels.initial_phase,
        wheels.compensation,
        wheels.step_period,
    ];
    let switches = wheels.range_x2 | wheels.compensation_insert << 1;
    let all = numbers.into_iter().zip(PLACES).chain([(switches, 1)]);
    let all = all.flat_map(|(number, places)| (0..places).map(move |place| digit(number, place)));
    let mut digits = [0; DIGITS - 5];
    for (place, digit) in digits.iter_mut().zip(all) {
        *place = digit;
    }
    digits
}

fn wheels(content: &[u8]) -> Wheels {
    let mut rest = content;
    let [divide_a, divide_b, initial_phase, compensation, step_period] = PLACES.map(|places| {
        let (digits, further) = rest.split_at(places);
        rest = further;
        number(digits)
    });
    let switches = number(rest);
    Wheels {
        divide_a,
        divide_b,
        range_x2: switches & 1,
        initial_phase,
        compensation,
        compensation_insert: switches >> 1,
        step_period,
    }
}

/// A digit of four bits.
fn digit(number: u64, place: usize) -> u8 {
    (number >> (4 * place) & 15).to_le_bytes()[0]
}

/// Digits of four bits, the low one first, together.
fn number(digits: &[u8]) -> u64 {
    digits.iter().rev().fold(0, |number, digit| number << 4 | u64::from(*digit))
}

fn check_of(digits: &[u8]) -> u16 {
    check_of_bits(digits.iter().flat_map(|digit| (0..4).map(move |bit| digit >> bit & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHEELS: Wheels = Wheels {
        divide_a: 0x352,
        divide_b: 0x158,
        range_x2: 1,
        initial_phase: 0x079,
        compensation: 0x1789,
        compensation_insert: 1,
        step_period: 0x03_0d40,
    };

    #[test]
    fn a_request_is_digits_the_low_one_first() {
        let wire = Request::Write(WHEELS).on_the_wire();
        assert_eq!(wire.len(), 27);
        assert_eq!((wire[0], wire[26]), (0x1a, 0));
        assert_eq!(&wire[1..22], b"3253851970987104=0303", "{wire:02x?}");
    }

    /// As a board answers: the same digits, another kind.
    #[test]
    fn what_was_written_is_read() {
        let wire = Request::Write(WHEELS).on_the_wire();
        let plain = cobs::decode_vec(&wire[..26]).expect("it is stuffed");
        assert_eq!(Answer::read(&plain), Some(Answer::Written(WHEELS)));
    }

    /// Each single bit turned over is noticed.
    #[test]
    fn a_wrong_bit_is_noticed() {
        let wire = Request::Write(WHEELS).on_the_wire();
        let plain = cobs::decode_vec(&wire[..26]).expect("it is stuffed");
        for place in 0..plain.len() {
            for bit in 0..8 {
                let mut wrong = plain.clone();
                wrong[place] ^= 1 << bit;
                assert_eq!(Answer::read(&wrong), None, "digit {place}, bit {bit}");
            }
        }
    }
}
