//! The gate opens after exactly m laser pulses, for every m on the wheels.

use helixlock_rtl::settings::bcd;

use crate::support::bench::Bench;

/// Exhaustive: each m, pulses every third clock, lines in every clock.
#[test]
fn opens_after_every_preset() {
    let mut bench = Bench::new("initial_phase_selector");
    bench.set(&[("grating", 1)]);
    for m in 0..=999 {
        bench.set(&[("preset", bcd(m)), ("clear", 1)]);
        bench.clock();
        bench.set(&[("clear", 0)]);
        let mut pulses = 0;
        bench.clocks(2);
        while !bench.high("open") {
            assert!(!bench.high("line"), "shut, m = {m}");
            bench.pulse(&["laser"]);
            bench.clocks(2);
            pulses += 1;
        }
        assert_eq!(pulses, m);
        assert!(bench.high("line"), "open, m = {m}");
    }
}

/// A second pulse right behind the m-th neither delays nor undoes the opening.
#[test]
fn pulse_behind_the_last() {
    let mut bench = Bench::new("initial_phase_selector");
    bench.set(&[("preset", 0x003)]);
    for _ in 0..20 {
        bench.pulse(&["laser"]);
    }
    assert!(bench.high("open"));
    assert_eq!(bench.get("units.digit"), 3);
    bench.pulse(&["clear"]);
    assert!(!bench.high("open"), "shut again");
}
