//! The standard wave is high for half a period of the divider it follows.

use helixlock_rtl::settings::bcd;

use crate::support::bench::Bench;

/// Counted in lines, for every A, behind the divider and range stage of the device.
#[test]
fn half_a_period_for_every_divider() {
    let mut bench = Bench::new("device");
    for range_x2 in [false, true] {
        for a in (1..=40).chain([99, 100, 101, 500, 999]) {
            // At A = 1, ×1, the one line has no middle.
            if a > 1 || range_x2 {
                let (high, period) = standard_in_lines(&mut bench, a, range_x2);
                let expected = if range_x2 { a } else { a / 2 };
                assert_eq!((high, period), (expected, a * (1 + u32::from(range_x2))), "A = {a}");
            }
        }
    }
}

/// Lines for which the standard is high, and lines in a period.
fn standard_in_lines(bench: &mut Bench, a: u32, range_x2: bool) -> (u32, u32) {
    bench.set(&[("divide_a", bcd(a)), ("divide_b", 0x999), ("range_x2", range_x2.into())]);
    bench.set(&[("start", 0), ("initial_phase", 0)]);
    bench.clocks(4);
    bench.set(&[("start", 1)]);
    bench.clocks(5);
    let line = |bench: &mut Bench| {
        bench.pulse(&["grating"]);
        bench.clocks(5);
        bench.high("standard")
    };
    while !line(bench) {}
    let mut high = 1;
    while line(bench) {
        high += 1;
    }
    let mut low = 1;
    while !line(bench) {
        low += 1;
    }
    (high, high + low)
}
