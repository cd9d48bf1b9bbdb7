//! The step pin gives a driver its set-up time and its pulse.

use crate::support::bench::Bench;

#[test]
fn sixty_four_low_sixty_four_high() {
    for forward in [1, 0] {
        let mut bench = Bench::new("step_driver");
        bench.force(&[("direction_q", 1 - forward)]);
        bench.set(&[("forward", forward)]);
        bench.pulse(&["step"]);
        bench.set(&[("forward", 1 - forward)]);
        for clock in 1..300 {
            assert_eq!(bench.high("step_pin"), (65..=128).contains(&clock), "clock {clock}");
            assert_eq!(bench.get("direction_pin"), forward, "clock {clock}");
            bench.clock();
        }
    }
}

/// The closest steps the board shell allows each have their pulse.
#[test]
fn closest_steps() {
    let mut bench = Bench::new("step_driver");
    let mut pulses = 0;
    let mut before = false;
    for clock in 0..128 * 10 {
        bench.set(&[("step", u64::from(clock % 128 == 0))]);
        bench.clock();
        pulses += u32::from(bench.high("step_pin") && !before);
        before = bench.high("step_pin");
    }
    assert_eq!(pulses, 10);
}

#[test]
fn clear_takes_the_pulse_away() {
    let mut bench = Bench::new("step_driver");
    bench.set(&[("forward", 1)]);
    bench.pulse(&["step"]);
    bench.clocks(80);
    bench.pulse(&["clear"]);
    assert_eq!((bench.get("step_pin"), bench.get("direction_pin")), (0, 0));
    bench.clocks(80);
    assert!(!bench.high("step_pin"));
}
