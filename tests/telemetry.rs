//! Every comparison becomes a frame that says its width and period to the clock.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Byte stuffing undone, by its definition: a code, that many bytes less one, then a zero.
fn unstuffed(stuffed: &[u8]) -> Vec<u8> {
    let mut plain = vec![];
    let mut rest = stuffed;
    while let Some((&code, after)) = rest.split_first() {
        let (run, further) = after.split_at(usize::from(code) - 1);
        plain.extend_from_slice(run);
        if !further.is_empty() {
            plain.push(0);
        }
        rest = further;
    }
    plain
}

/// CRC-16/IBM-SDLC, bit by bit.
pub(crate) fn check(bytes: &[u8]) -> u16 {
    let step = |crc: u16, bit: u16| {
        let out = (crc ^ bit) & 1;
        (crc >> 1) ^ (0x8408 * out)
    };
    let bits = bytes.iter().flat_map(|byte| (0..8).map(move |bit| u16::from(byte >> bit & 1)));
    !bits.fold(0xffff, step)
}

#[test]
fn the_check_is_the_one_of_the_standard() {
    assert_eq!(check(b"123456789"), 0x906e, "the check value of the catalogue of CRCs");
}

/// The block in a pass, its steps and flags as the frame's last two bytes say them.
fn in_state(state: u64) -> Bench {
    let mut bench = Bench::new("telemetry");
    bench.set(&[("measuring", 1), ("ready", 1), ("count", state & 0xfff)]);
    let flags = ["count_forward", "forward", "fault", "alarm"];
    for (bit, flag) in flags.into_iter().enumerate() {
        bench.set(&[(flag, state >> (12 + bit) & 1)]);
    }
    bench
}

/// One clock, and the byte handed over in it.
fn take(bench: &mut Bench, sent: &mut Vec<u8>) {
    if bench.high("send") {
        sent.push(u8::try_from(bench.get("data")).expect("a byte"));
    }
    bench.clock();
}

/// Runs comparisons of these periods and widths; the bytes sent, split at zeros.
fn frames(comparisons: &[(u32, u32)], state: u64) -> Vec<Vec<u8>> {
    let mut bench = in_state(state);
    let mut sent = vec![];
    for (period, width) in comparisons {
        for clock in 0..*period {
            bench.set(&[("opening", u64::from(clock == 0))]);
            bench.set(&[("meter", u64::from((1..=*width).contains(&clock)))]);
            take(&mut bench, &mut sent);
        }
    }
    bench.set(&[("opening", 1)]);
    take(&mut bench, &mut sent);
    bench.set(&[("opening", 0)]);
    (0..4000).for_each(|_| take(&mut bench, &mut sent));
    let mut frames: Vec<_> = sent.split(|byte| *byte == 0).map(<[u8]>::to_vec).collect();
    assert_eq!(frames.pop(), Some(vec![]), "the last frame is ended");
    frames
}

/// What a frame says, read by two decoders: the one above and that of the crate `cobs`.
fn plain(frame: &[u8]) -> Vec<u8> {
    let plain = unstuffed(frame);
    assert_eq!(cobs::decode_vec(frame).ok().as_ref(), Some(&plain), "{frame:02x?}");
    plain
}

/// The frame of these numbers, by the page of the block.
fn content(number: u16, width: u32, period: u32, state: u16) -> Vec<u8> {
    let mut content = vec![1];
    content.extend(number.to_le_bytes());
    content.extend(width.to_le_bytes());
    content.extend(period.to_le_bytes());
    content.extend(state.to_le_bytes());
    content.extend(check(&content).to_le_bytes());
    content
}

/// A number whose bytes are zero as often as not, so that runs between zeros have every length.
fn patchy(bytes: [(bool, u8); 4]) -> u32 {
    u32::from_le_bytes(bytes.map(|(zero, byte)| if zero { 0 } else { byte }))
}

proptest! {
    #![proptest_config(kept_beside_source())]

    #[test]
    fn frames_say_what_was(
        comparisons in vec((3000_u32..4000, 0_u32..2999), 1..4),
        state in any::<u16>(),
    ) {
        let frames = frames(&comparisons, state.into());
        prop_assert_eq!(frames.len(), comparisons.len());
        for (number, (frame, (period, width))) in (0_u16..).zip(frames.iter().zip(&comparisons)) {
            prop_assert_eq!(plain(frame), content(number, *width, *period, state));
        }
    }

    /// Counters put where they are seldom: whatever they hold comes over, however slow the line.
    #[test]
    fn any_numbers_come_over(
        bytes in any::<[[(bool, u8); 4]; 3]>(),
        state in any::<u16>(),
        ready_every in 1_u32..40,
    ) {
        let [width, period, number] = bytes.map(patchy);
        let number = number.to_le_bytes();
        let number = u16::from_le_bytes([number[0], number[1]]);
        let mut bench = in_state(state.into());
        bench.force(&[("begun_q", 1), ("number_q", number.into())]);
        bench.force(&[("since_q", period.into()), ("high_q", width.into())]);
        bench.set(&[("opening", 1)]);
        let mut sent = vec![];
        for clock in 0..2000 {
            bench.set(&[("ready", u64::from(clock % ready_every == 0))]);
            take(&mut bench, &mut sent);
            bench.set(&[("opening", 0)]);
        }
        let (end, frame) = sent.split_last().expect("a frame");
        prop_assert_eq!((*end, plain(frame)), (0, content(number, width, period, state)));
        prop_assert!(!frame.contains(&0));
    }
}

/// A comparison that ends while a frame is under way leaves a gap in the numbers.
#[test]
fn what_is_not_sent_is_missed_in_the_numbers() {
    let frames = frames(&[(3000, 7), (50, 3), (50, 3), (3000, 9)], 0);
    let numbers: Vec<_> = frames.iter().map(|frame| plain(frame)[1]).collect();
    assert_eq!(numbers, [0, 3]);
}
