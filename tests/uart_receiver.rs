//! What a serial port sends is received, and nothing else.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// The wire at a level for that many clocks; bytes received in them.
fn hold(bench: &mut Bench, level: u64, clocks: u32) -> Vec<u8> {
    bench.set(&[("line", level)]);
    let mut got = vec![];
    for _ in 0..clocks {
        if bench.high("received") {
            got.push(u8::try_from(bench.get("data")).expect("a byte"));
        }
        bench.clock();
    }
    got
}

/// A byte on the wire, each bit as long as `clocks` says of its end since the start, and a stop bit.
fn send(bench: &mut Bench, byte: u8, stop: u64, ends: impl Fn(u32) -> u32) -> Vec<u8> {
    let bits = (0..8).map(|bit| u64::from(byte >> bit & 1));
    let levels = std::iter::once(0).chain(bits).chain([stop]);
    let spans = (0..).map(|bit| ends(bit + 1) - ends(bit));
    levels.zip(spans).flat_map(|(level, clocks)| hold(bench, level, clocks)).collect()
}

fn idle(bit_clocks: u32) -> Bench {
    let mut bench = Bench::new("uart_receiver");
    bench.set(&[("bit_clocks", bit_clocks.into()), ("line", 1)]);
    bench.clocks(10);
    bench
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// One behind the other, without a pause.
    #[test]
    fn bytes_are_received(bytes in vec(any::<u8>(), 1..6), bit_clocks in 2_u32..60) {
        let mut bench = idle(bit_clocks);
        let mut got = vec![];
        for byte in &bytes {
            got.extend(send(&mut bench, *byte, 1, |bit| bit * bit_clocks));
        }
        got.extend(hold(&mut bench, 1, bit_clocks + 4));
        prop_assert_eq!(got, bytes);
    }

    /// The other side's clock is fast or slow by as much as the page says.
    #[test]
    fn clocks_differ(byte in any::<u8>(), parts in -4_i32..=4) {
        let mut bench = idle(104);
        let thousandths = u32::try_from(1000 + 10 * parts).expect("positive");
        let mut got = send(&mut bench, byte, 1, |bit| bit * 104 * thousandths / 1000);
        got.extend(hold(&mut bench, 1, 200));
        prop_assert_eq!(got, [byte]);
    }

    /// Too short a start, and a byte whose stop bit is low: none.
    #[test]
    fn what_is_no_byte_is_not_received(byte in any::<u8>(), bit_clocks in 8_u32..60) {
        let mut bench = idle(bit_clocks);
        let mut got = hold(&mut bench, 0, bit_clocks / 2 - 1);
        got.extend(hold(&mut bench, 1, 12 * bit_clocks));
        prop_assert_eq!(&got, &[] as &[u8]);
        got.extend(send(&mut bench, byte, 0, |bit| bit * bit_clocks));
        prop_assert_eq!(&got, &[] as &[u8]);
    }
}

/// A line that nobody drives high, or a break: no byte for as long as it lasts.
#[test]
fn a_low_line_is_no_byte() {
    let mut bench = idle(20);
    assert_eq!(hold(&mut bench, 0, 5000), [0_u8; 0]);
}
