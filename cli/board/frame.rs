//! Frames of a board: bytes of a line become comparisons, and answers of its settings port.
//!
//! The layout of a comparison is that of the block's page, `rtl/src/telemetry.rs`.

use super::message::Answer;

/// Bytes of a frame, its check included.
const LENGTH: usize = 15;

/// First byte of the frame of a comparison.
const COMPARISON: u8 = 1;

/// One comparison, as the board measured it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Frame {
    /// Its number, modulo 65 536.
    pub(super) number: u16,
    /// Clocks that T1 was high.
    pub(super) width: u32,
    /// Its clocks.
    pub(super) period: u32,
    /// Net steps, forward positive.
    pub(super) steps: i32,
    /// The discriminator's Q.
    pub(super) forward: bool,
    /// A step was refused.
    pub(super) fault: bool,
    /// The supervisor's alarm.
    pub(super) alarm: bool,
}

/// What bytes that end with a zero were.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Received {
    /// A comparison that came over whole.
    Whole(Frame),
    /// An answer that did.
    Answer(Answer),
    /// Something else.
    Damaged,
}

/// Gathers bytes to frames.
#[derive(Clone, Debug, Default)]
pub(super) struct Decoder {
    held: Vec<u8>,
    /// False until the first end of a frame: what came before may have begun earlier.
    in_step: bool,
}

impl Decoder {
    /// Takes a byte; gives what it ends.
    pub(super) fn take(&mut self, byte: u8) -> Option<Received> {
        if byte != 0 {
            // Nothing of ours is that long: the rest of it is of no use either.
            if self.held.len() <= 2 * LENGTH {
                self.held.push(byte);
            }
            return None;
        }
        let held = std::mem::take(&mut self.held);
        let known = std::mem::replace(&mut self.in_step, true);
        let plain = cobs::decode_vec(&held).ok();
        let whole = plain.as_ref().and_then(|plain| {
            decode(plain).map(Received::Whole).or_else(|| Answer::read(plain).map(Received::Answer))
        });
        whole.or(known.then_some(Received::Damaged))
    }
}

fn decode(plain: &[u8]) -> Option<Frame> {
    if plain.len() != LENGTH {
        return None;
    }
    let (content, check) = plain.split_at(LENGTH - 2);
    if content[0] != COMPARISON || check != check_of(content).to_le_bytes() {
        return None;
    }
    let word = |low: usize| u16::from_le_bytes([content[low], content[low + 1]]);
    let long = |low: usize| u32::from(word(low)) | u32::from(word(low + 2)) << 16;
    let state = word(11);
    let bit = |bit: u32| state >> bit & 1 == 1;
    let steps = i32::from(state & 0xfff);
    let (width, period) = (long(3), long(7));
    // No logic of ours says that, whatever the check.
    if period == 0 || width > period {
        return None;
    }
    Some(Frame {
        number: word(1),
        width,
        period,
        steps: if bit(12) { steps } else { -steps },
        forward: bit(13),
        fault: bit(14),
        alarm: bit(15),
    })
}

fn check_of(content: &[u8]) -> u16 {
    check_of_bits(content.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1)))
}

/// CRC-16/IBM-SDLC.
pub(super) fn check_of_bits(bits: impl Iterator<Item = u8>) -> u16 {
    !bits.fold(0xffff, |crc: u16, bit| (crc >> 1) ^ (0x8408 * ((crc ^ u16::from(bit)) & 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_the_wire(content: &[u8]) -> Vec<u8> {
        let whole = [content, &check_of(content).to_le_bytes()].concat();
        let mut wire = cobs::encode_vec(&whole);
        wire.push(0);
        wire
    }

    const CONTENT: [u8; 13] = [1, 7, 0, 0x10, 0x27, 0, 0, 0x20, 0x4e, 0, 0, 0x2a, 0x30];

    #[test]
    fn a_frame_is_read() {
        let mut decoder = Decoder::default();
        let got: Vec<_> =
            on_the_wire(&CONTENT).into_iter().filter_map(|byte| decoder.take(byte)).collect();
        let expected = Frame {
            number: 7,
            width: 10_000,
            period: 20_000,
            steps: 42,
            forward: true,
            fault: false,
            alarm: false,
        };
        assert_eq!(got, [Received::Whole(expected)]);
    }

    /// Each single bit turned over is noticed, and the frame behind it is read.
    #[test]
    fn a_wrong_bit_is_noticed() {
        let wire = on_the_wire(&CONTENT);
        for place in 0..wire.len() - 1 {
            for bit in 0..8 {
                let mut wrong = wire.clone();
                wrong[place] ^= 1 << bit;
                let mut decoder = Decoder { in_step: true, ..Decoder::default() };
                let all = wrong.iter().chain(&wire);
                let got: Vec<_> = all.filter_map(|byte| decoder.take(*byte)).collect();
                let (last, before) = got.split_last().expect("frames ended");
                assert!(matches!(last, Received::Whole(_)));
                assert!(!before.is_empty(), "place {place}, bit {bit}");
                assert!(before.iter().all(|one| *one == Received::Damaged));
            }
        }
    }

    /// Who listens later hears the end of a frame first: that is no damage.
    #[test]
    fn half_a_frame_at_the_beginning_is_passed_over() {
        let mut decoder = Decoder::default();
        let wire = on_the_wire(&CONTENT);
        let got: Vec<_> =
            wire[5..].iter().chain(&wire).filter_map(|byte| decoder.take(*byte)).collect();
        assert!(matches!(got[..], [Received::Whole(_)]));
    }

    /// Bytes without an end, as from a line at another speed, are no frame and cost no memory.
    #[test]
    fn a_long_run_without_a_zero_is_damage() {
        let mut decoder = Decoder { in_step: true, ..Decoder::default() };
        let noise = (0..100_000_u32).map(|place| 1 + (place % 255).to_le_bytes()[0]);
        for byte in noise {
            assert_eq!(decoder.take(byte), None);
        }
        assert!(decoder.held.len() <= 2 * LENGTH + 1);
        assert_eq!(decoder.take(0), Some(Received::Damaged));
        let got = on_the_wire(&CONTENT).into_iter().find_map(|byte| decoder.take(byte));
        assert!(matches!(got, Some(Received::Whole(_))));
    }
}
