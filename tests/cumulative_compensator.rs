//! The compensator changes the number of pulses by exactly one in F, and loses none.

use helixlock_rtl::settings::bcd;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Pulses in and out of the compensator, the given idle clocks after each.
fn counts(thousands: u32, insert: bool, gaps: &[u8], clocks: u32) -> (u64, u64) {
    let mut bench = Bench::new("cumulative_compensator");
    bench.set(&[("preset", bcd(thousands)), ("insert", insert.into())]);
    let (mut pulses_in, mut pulses_out) = (0, 0);
    let mut gaps = gaps.iter().cycle();
    let mut wait = 0;
    for _ in 0..clocks {
        let laser = wait == 0;
        wait = if laser { *gaps.next().expect("a cycle") } else { wait - 1 };
        bench.set(&[("laser", laser.into())]);
        pulses_in += u64::from(laser);
        pulses_out += bench.get("pulse");
        bench.clock();
    }
    bench.set(&[("laser", 0)]);
    for _ in 0..2 {
        pulses_out += bench.get("pulse");
        bench.clock();
    }
    (pulses_in, pulses_out)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..kept_beside_source() })]

    #[test]
    fn one_more_per_f(thousands in 1..=3_u32, gaps in vec(1..6_u8, 1..30), clocks in 5000..30_000_u32) {
        let (pulses_in, pulses_out) = counts(thousands, true, &gaps, clocks);
        prop_assert_eq!(pulses_out, pulses_in + pulses_in / (1000 * u64::from(thousands)));
    }

    /// The blocked one is the pulse behind the F-th: none is missing before it has come.
    #[test]
    fn one_less_per_f(thousands in 1..=3_u32, gaps in vec(1..6_u8, 1..30), clocks in 5000..30_000_u32) {
        let (pulses_in, pulses_out) = counts(thousands, false, &gaps, clocks);
        prop_assert_eq!(pulses_out, pulses_in - (pulses_in - 1) / (1000 * u64::from(thousands)));
    }
}

#[test]
fn off_is_off() {
    for insert in [false, true] {
        let (pulses_in, pulses_out) = counts(0, insert, &[1], 10_000);
        assert_eq!(pulses_in, pulses_out);
    }
}

/// F = 9 999 000, from just below: the top decades take part.
#[test]
fn largest_f() {
    let mut bench = Bench::new("compensation_divider");
    bench.set(&[("preset", 0x9999)]);
    let decades = ["units", "tens", "hundreds", "thousands"];
    let upper = ["ten_thousands", "hundred_thousands", "millions"];
    for (decade, digit) in decades.iter().zip([8, 9, 9, 8]).chain(upper.iter().zip([9; 3])) {
        bench.force(&[(&format!("{decade}.state_q"), digit)]);
    }
    bench.pulse(&["pulse"]);
    assert!(!bench.high("due"), "9 998 999");
    bench.pulse(&["pulse"]);
    assert!(bench.high("due"), "9 999 000");
    bench.clock();
    assert!(!bench.high("due"), "for one clock");
}

/// An insertion due in the clock of a real pulse follows it.
#[test]
fn inserted_pulse_waits_for_a_real_one() {
    let mut bench = Bench::new("cumulative_compensator");
    bench.set(&[("preset", 0x0001), ("insert", 1)]);
    for _ in 0..1000 {
        bench.pulse(&["laser"]);
    }
    bench.set(&[("laser", 1)]);
    assert!(bench.high("divider.due") && bench.high("pulse"), "the real one passes");
    bench.clock();
    bench.set(&[("laser", 0)]);
    assert!(bench.high("pulse"), "the inserted one follows");
    bench.clock();
    assert!(!bench.high("pulse"), "once");
}
