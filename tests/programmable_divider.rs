//! The divider gives one pulse for every N, for every N on its wheels.

use helixlock_rtl::settings::bcd;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Exhaustive: each preset, a pulse in every clock, three periods.
#[test]
fn divides_by_every_preset() {
    let mut bench = Bench::new("programmable_divider");
    for n in 1..=999 {
        bench.set(&[("preset", bcd(n)), ("clear", 1), ("pulse", 0)]);
        bench.clock();
        bench.set(&[("clear", 0), ("pulse", 1)]);
        for pulses in 1..=3 * n {
            bench.clock();
            assert_eq!(bench.high("divided"), pulses % n == 0, "after {pulses} pulses, N = {n}");
        }
    }
}

/// Exhaustive: half of each preset is where integer division puts it.
#[test]
fn half_is_half_of_every_preset() {
    let mut bench = Bench::new("programmable_divider");
    for n in 1..=999 {
        bench.set(&[("preset", bcd(n)), ("clear", 1), ("pulse", 0)]);
        bench.clock();
        bench.set(&[("clear", 0), ("pulse", 1)]);
        for pulses in 0..n {
            assert_eq!(bench.high("half"), pulses == n / 2, "after {pulses} pulses, N = {n}");
            bench.clock();
        }
    }
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// However the pulses come, and whenever it is cleared, it loses and doubles none.
    #[test]
    fn loses_no_pulse(n in 1..=40_u32, train in vec((any::<bool>(), 0..20), 0..400)) {
        let mut bench = Bench::new("programmable_divider");
        bench.set(&[("preset", bcd(n))]);
        let mut counted = 0;
        for (pulse, dice) in train {
            let clear = dice == 0;
            bench.set(&[("pulse", pulse.into()), ("clear", clear.into())]);
            bench.clock();
            counted = if clear { 0 } else { counted + u32::from(pulse) };
            prop_assert_eq!(bench.high("divided"), counted == n);
            counted %= n;
        }
    }
}
