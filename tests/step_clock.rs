//! The step clock ticks every `period` clocks, exactly.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Clocks to the next tick, this one counted; none within `patience`.
fn to_tick(bench: &mut Bench, patience: u32) -> Option<u32> {
    (1..=patience).find(|_| {
        bench.clock();
        bench.high("tick")
    })
}

#[test]
fn every_short_period() {
    for period in 1..200 {
        let mut bench = Bench::new("step_clock");
        bench.set(&[("period", period.into())]);
        assert_eq!(to_tick(&mut bench, 400), Some(period), "from power-up");
        for _ in 0..3 {
            assert_eq!(to_tick(&mut bench, 400), Some(period));
        }
    }
}

#[test]
fn longest_period() {
    let mut bench = Bench::new("step_clock");
    bench.set(&[("period", 0xff_ffff)]);
    bench.clock();
    assert_eq!(bench.get("left_q"), 0xff_ffff);
    bench.force(&[("left_q", 3)]);
    assert_eq!(to_tick(&mut bench, 9), Some(2));
    bench.clock();
    assert_eq!(bench.get("left_q"), 0xff_ffff);
}

#[test]
fn zero_stops_it() {
    let mut bench = Bench::new("step_clock");
    assert_eq!(to_tick(&mut bench, 1000), None);
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Periods changed in mid-run hold from the next tick on, longer or shorter.
    #[test]
    fn changes_hold_from_the_next_tick(periods in vec(1..50_u32, 2..20), early in 0..50_u32) {
        let mut bench = Bench::new("step_clock");
        bench.set(&[("period", periods[0].into())]);
        prop_assert_eq!(to_tick(&mut bench, 100), Some(periods[0]));
        for pair in periods.windows(2) {
            // Somewhere in the running period, the wheels are turned.
            let before = early % pair[0] + 1;
            bench.clocks(before - 1);
            bench.clock();
            let ticked = bench.high("tick");
            prop_assert_eq!(ticked, before == pair[0]);
            bench.set(&[("period", pair[1].into())]);
            if !ticked {
                prop_assert_eq!(to_tick(&mut bench, 100), Some(pair[0] - before));
            }
            // The next pair starts at this tick, the end of its own first period.
            prop_assert_eq!(to_tick(&mut bench, 100), Some(pair[1]));
        }
    }

    /// `clear` asks for a whole period, whenever it comes.
    #[test]
    fn clear_starts_a_period(period in 2..50_u32, at in 0..100_u32) {
        let mut bench = Bench::new("step_clock");
        bench.set(&[("period", period.into())]);
        bench.clocks(at);
        bench.pulse(&["clear"]);
        let more = if bench.high("tick") { 0 } else { to_tick(&mut bench, 100).unwrap_or(999) };
        prop_assert_eq!(more, period - 1);
    }
}
