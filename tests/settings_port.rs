//! The settings port takes what wheels show, at rest, and says what it has.

use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Digits of the settings: A, B, m, F/1000 and the step period, then ×2 and insert together.
pub(crate) type Digits = [u8; 20];

/// Outputs with the place of their first digit, and how many they have.
const NUMBERS: [(&str, usize, usize); 5] = [
    ("divide_a", 0, 3),
    ("divide_b", 3, 3),
    ("initial_phase", 6, 3),
    ("compensation", 9, 4),
    ("step_period", 13, 6),
];

/// A = 110, B = 150, m = 75, F = 1 182 000, 120 000 clocks, ×2.
const BUILT: Digits = [0, 1, 1, 0, 5, 1, 5, 7, 0, 2, 8, 1, 1, 0, 12, 4, 13, 1, 0, 1];

/// Other ones in every digit.
const OTHERS: Digits = [2, 5, 3, 8, 5, 1, 9, 8, 1, 9, 8, 7, 1, 1, 4, 13, 0, 3, 9, 2];

/// Kinds of requests and answers.
pub(crate) const IDENTIFY: u8 = 1;
pub(crate) const READ: u8 = 2;
pub(crate) const WRITE: u8 = 3;
pub(crate) const NOT_AT_REST: u8 = 4;
pub(crate) const NOT_SHOWN: u8 = 5;

/// CRC-16/IBM-SDLC of four bits a digit.
fn check(digits: &[u8]) -> u16 {
    let bits = digits.iter().flat_map(|digit| (0..4).map(move |bit| u16::from(digit >> bit & 1)));
    !bits.fold(0xffff, |crc: u16, bit| (crc >> 1) ^ (0x8408 * ((crc ^ bit) & 1)))
}

/// The frame of a kind and digits, by the page of the block.
pub(crate) fn frame(kind: u8, digits: &Digits) -> Vec<u8> {
    let mut all = vec![kind];
    all.extend(digits);
    let check = check(&all);
    all.extend((0..4).map(|place| u8::try_from(check >> (4 * place) & 15).expect("four bits")));
    let bytes = all.iter().map(|digit| 0x30 | digit);
    std::iter::once(0x1a).chain(bytes).chain([0]).collect()
}

/// A port just reset, whose transmitter takes a byte in every twentieth clock.
struct Port {
    bench: Bench,
    clock: u64,
}

impl Port {
    fn new() -> Self {
        let mut bench = Bench::new("settings_port");
        for (name, first, places) in NUMBERS {
            bench.set(&[(&format!("built_{name}"), number(&BUILT[first..first + places]))]);
        }
        bench.set(&[("built_range_x2", 1), ("at_rest", 1), ("tick_period", 12_000)]);
        bench.pulse(&["clear"]);
        Self { bench, clock: 0 }
    }

    /// One clock, and the byte that goes out in it.
    fn step(&mut self) -> Option<u8> {
        self.bench.set(&[("ready", u64::from(self.clock.is_multiple_of(20)))]);
        self.clock += 1;
        let sent = self.bench.high("send").then(|| self.bench.get("data"));
        self.bench.clock();
        sent.map(|byte| u8::try_from(byte).expect("a byte"))
    }

    fn hear(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.bench.set(&[("received_byte", u64::from(*byte)), ("received", 1)]);
            assert_eq!(self.step(), None);
            self.bench.set(&[("received", 0)]);
            (0..4).for_each(|_| assert_eq!(self.step(), None));
        }
    }

    /// What goes out in that many clocks.
    fn clocks(&mut self, clocks: usize) -> Vec<u8> {
        (0..clocks).filter_map(|_| self.step()).collect()
    }

    /// The answer to a request.
    fn ask(&mut self, kind: u8, digits: &Digits) -> Vec<u8> {
        self.hear(&frame(kind, digits));
        self.clocks(27 * 20 + 40)
    }

    /// What the device gets.
    fn set(&mut self) -> Digits {
        let mut digits = [0; 20];
        for (name, first, places) in NUMBERS {
            let value = self.bench.get(name);
            for place in 0..places {
                digits[first + place] = u8::try_from(value >> (4 * place) & 15).expect("four bits");
            }
        }
        let switches = self.bench.get("range_x2") + 2 * self.bench.get("compensation_insert");
        digits[19] = u8::try_from(switches).expect("two bits");
        digits
    }
}

/// Digits of four bits, the low one first, together.
fn number(digits: &[u8]) -> u64 {
    digits.iter().rev().fold(0, |number, digit| number << 4 | u64::from(*digit))
}

#[test]
fn it_wakes_up_with_the_bitstream_and_says_what_it_is() {
    let mut port = Port::new();
    assert_eq!(port.set(), BUILT);
    assert_eq!(port.ask(READ, &OTHERS), frame(READ, &BUILT));
    let mut identity = [0; 20];
    identity[..5].copy_from_slice(&[0, 3, 4, 7, 1]);
    identity[13..17].copy_from_slice(&[0, 14, 14, 2]);
    assert_eq!(port.ask(IDENTIFY, &OTHERS), frame(IDENTIFY, &identity));
    assert_eq!(port.set(), BUILT);
}

#[test]
fn what_is_written_is_set_and_read_back_and_forgotten_by_a_reset() {
    let mut port = Port::new();
    for digits in [OTHERS, BUILT, OTHERS] {
        assert_eq!(port.ask(WRITE, &digits), frame(WRITE, &digits));
        assert_eq!(port.set(), digits);
        port.bench.set(&[("at_rest", 0)]);
        assert_eq!(port.ask(READ, &BUILT), frame(READ, &digits));
        port.bench.set(&[("at_rest", 1)]);
    }
    port.bench.pulse(&["clear"]);
    assert_eq!(port.set(), BUILT);
}

#[test]
fn in_a_pass_nothing_is_set() {
    let mut port = Port::new();
    port.bench.set(&[("at_rest", 0)]);
    assert_eq!(port.ask(WRITE, &OTHERS), frame(NOT_AT_REST, &BUILT));
    assert_eq!(port.set(), BUILT);
}

/// Ten to fifteen in any place of a decimal wheel, no divider, steps too fast, a third switch.
#[test]
fn what_no_wheel_shows_is_not_set() {
    let mut port = Port::new();
    let mut refused = vec![];
    for place in 0..13 {
        for digit in 10..16 {
            let mut wrong = OTHERS;
            wrong[place] = digit;
            refused.push(wrong);
        }
    }
    for (first, places, value) in
        [(0, 3, 0), (3, 3, 0), (13, 6, 127), (13, 6, 0), (19, 1, 4), (19, 1, 8)]
    {
        let mut wrong = OTHERS;
        for place in 0..places {
            wrong[first + place] = u8::try_from(value >> (4 * place) & 15).expect("four bits");
        }
        refused.push(wrong);
    }
    for wrong in refused {
        assert_eq!(port.ask(WRITE, &wrong), frame(NOT_SHOWN, &BUILT), "{wrong:?}");
        assert_eq!(port.set(), BUILT);
    }
    let mut slowest = OTHERS;
    slowest[13..19].copy_from_slice(&[0, 8, 0, 0, 0, 0]);
    assert_eq!(port.ask(WRITE, &slowest), frame(WRITE, &slowest));
}

/// Each single bit turned over, each byte lost or doubled: no answer, and nothing set; what comes
/// behind it is heard.
#[test]
fn what_did_not_come_over_whole_is_not_heard() {
    let mut port = Port::new();
    let sound = frame(WRITE, &OTHERS);
    let mut wrong = vec![];
    for place in 0..sound.len() {
        for bit in 0..8 {
            let mut bytes = sound.clone();
            bytes[place] ^= 1 << bit;
            wrong.push(bytes);
        }
        let mut lost = sound.clone();
        lost.remove(place);
        wrong.push(lost);
        let mut doubled = sound.clone();
        doubled.insert(place, sound[place]);
        // A second beginning begins the same frame; a second end is one of nothing.
        if (1..sound.len() - 1).contains(&place) {
            wrong.push(doubled);
        }
    }
    for bytes in wrong {
        port.hear(&bytes);
        assert_eq!(port.clocks(100), [0_u8; 0], "{bytes:02x?}");
        assert_eq!(port.set(), BUILT, "{bytes:02x?}");
    }
    for kind in [0, 4, 5, 9, 15] {
        assert_eq!(port.ask(kind, &OTHERS), [0_u8; 0], "kind {kind}");
    }
    assert_eq!(port.ask(WRITE, &OTHERS), frame(WRITE, &OTHERS));
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Whatever wheels can show is set, all of it.
    #[test]
    fn whatever_can_be_shown_is_set(
        decimals in prop::array::uniform13(0_u8..10),
        period in 128_u64..0x100_0000,
        switches in 0_u8..4,
    ) {
        prop_assume!(number(&decimals[..3]) != 0 && number(&decimals[3..6]) != 0);
        let mut digits = [0; 20];
        digits[..13].copy_from_slice(&decimals);
        for place in 0..6 {
            digits[13 + place] = u8::try_from(period >> (4 * place) & 15).expect("four bits");
        }
        digits[19] = switches;
        let mut port = Port::new();
        prop_assert_eq!(port.ask(WRITE, &digits), frame(WRITE, &digits));
        prop_assert_eq!(port.set(), digits);
    }

    /// The telemetry sends a frame when the port is asked, whenever that is: both come over whole.
    #[test]
    fn frames_do_not_tear_each_other(delay in 0_usize..400, length in 2_usize..18) {
        let mut port = Port::new();
        let theirs: Vec<u8> = (1..).take(length - 1).chain([0]).collect();
        let mut left = theirs.clone();
        left.reverse();
        let request = frame(READ, &BUILT);
        let mut sent = vec![];
        for clock in 0..2000 {
            port.bench.set(&[("ready", u64::from(clock % 20 == 0))]);
            let heard = if clock % 5 == 0 { request.get(clock / 5) } else { None };
            port.bench.set(&[("received", u64::from(heard.is_some()))]);
            if let Some(byte) = heard {
                port.bench.set(&[("received_byte", u64::from(*byte))]);
            }
            let telling = clock >= delay && !left.is_empty() && port.bench.high("telemetry_ready");
            let byte = if telling { left.pop() } else { None };
            port.bench.set(&[("telemetry_send", u64::from(byte.is_some()))]);
            port.bench.set(&[("telemetry_byte", u64::from(byte.unwrap_or_default()))]);
            if port.bench.high("send") {
                sent.push(u8::try_from(port.bench.get("data")).expect("a byte"));
            }
            port.bench.clock();
        }
        let answer = frame(READ, &BUILT);
        let [one, other] = [[theirs.clone(), answer.clone()], [answer, theirs]].map(|both| both.concat());
        prop_assert!(sent == one || sent == other, "{sent:02x?}");
    }
}
