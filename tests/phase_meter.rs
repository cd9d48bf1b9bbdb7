//! The meter is high between the two pulses exactly.

use crate::support::bench::Bench;

#[test]
fn truth_table() {
    for case in 0..16_u32 {
        let [hold, grating, laser, before] = [3, 2, 1, 0].map(|bit| u64::from(case >> bit & 1));
        let mut bench = Bench::new("phase_meter");
        bench.force(&[("state_q", before)]);
        bench.set(&[("hold", hold), ("grating", grating), ("laser", laser)]);
        bench.clock();
        let expected = match (hold, grating, laser) {
            (1, _, _) | (_, 0, 1) => 0,
            (_, 1, 0) => 1,
            _ => before,
        };
        assert_eq!(bench.get("meter"), expected, "{hold} {grating} {laser} {before}");
    }
}

/// A laser pulse `lag` clocks behind each grating pulse of a period of 20.
#[test]
fn width_is_the_lag() {
    for lag in 1..20 {
        let mut bench = Bench::new("phase_meter");
        let mut high = 0;
        for clock in 0..200 {
            let (grating, laser) = (clock % 20 == 0, clock % 20 == lag);
            bench.set(&[("grating", grating.into()), ("laser", laser.into())]);
            bench.clock();
            high += bench.get("meter");
        }
        assert_eq!(high, 10 * lag);
    }
}

/// At 0° and at 360°, where the pulses coincide, the meter stays where it was.
#[test]
fn coincidence_keeps_the_phase() {
    for state in [0, 1] {
        let mut bench = Bench::new("phase_meter");
        bench.force(&[("state_q", state)]);
        for _ in 0..5 {
            bench.pulse(&["grating", "laser"]);
            bench.clocks(3);
            assert_eq!(bench.get("meter"), state);
        }
    }
}
