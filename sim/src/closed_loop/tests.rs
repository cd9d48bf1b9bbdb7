//! The real device against a machine simple enough to be worked out by hand.

use helixlock_rtl::settings::{Range, Settings};

use crate::pass::{Pass, PassPlan, run_pass};
use crate::swing::{Progress, Swing};
use crate::{device_engine, measure_hunting, set_wheels};

const CLOCK_HZ: f64 = 12e6;

/// The 6 mm screw at 6 rpm: lines of 6 mm / 13906, fringes of 22/69.53 µm, exactly commensurate.
const MACHINE: Swing = Swing {
    speed_um_per_s: 600.0,
    line_um: 6000.0 / 13906.0,
    fringe_um: 22.0 / 69.53,
    amplitude_um: 0.0,
    period_s: 1.0,
    step_um: 0.0125,
    begin_s: 0.1, // the initial phase is selected by then, which takes 150 fringes
    progress: Progress::START,
};

const FULL_SCALE_UM: f64 = 300.0 * 22.0 / 69.53;

fn run(machine: Swing, correct: bool, end_s: f64) -> Pass {
    let mut engine = device_engine();
    let settings = Settings {
        a: 110,
        b: 150,
        range: Range::X2,
        initial_phase: 150,
        compensation_f: 0,
        insert: false,
        step_period: 75_000, // 160 Hz
    };
    set_wheels(&mut engine, &settings).unwrap();
    let plan = PassPlan {
        clock_hz: CLOCK_HZ,
        end_s,
        full_scale_um: FULL_SCALE_UM,
        cutoff_hz: None,
        correct,
        playback_s: correct.then_some(30.0),
        probe: None,
    };
    run_pass(engine, machine, plan, &mut |_| {}).unwrap()
}

#[test]
fn the_open_loop_shows_the_lag_of_the_table() {
    let machine = Swing { amplitude_um: 10.0, period_s: 3.0, ..MACHINE };
    let pass = run(machine, false, 4.0);
    assert!(pass.trace.time_s.len() > 20, "{}", pass.trace.time_s.len());
    // The grating starts up to a line late, which is a constant.
    let differences: Vec<f64> = pass
        .trace
        .error_um
        .iter()
        .zip(&pass.trace.lead_error_um)
        .map(|(shown_um, lead_um)| shown_um + lead_um)
        .collect();
    let first_um = differences[0];
    assert!(first_um.abs() < 0.44, "{first_um}");
    for difference_um in differences {
        assert!((difference_um - first_um).abs() < 0.001, "{difference_um} after {first_um}");
    }
}

#[test]
fn the_closed_loop_hunts_at_half_the_comparison_frequency() {
    // Without any error, 180° is met to the clock and the motor is never asked to move.
    let machine = Swing { amplitude_um: 1.0, period_s: 40.0, ..MACHINE };
    let pass = run(machine, true, 8.0);
    let swing_um = 160.0 * 0.0125 / (13906.0 * 0.1 / 220.0);
    let hunting = measure_hunting(&pass.trace.time_s, &pass.trace.error_um, swing_um).unwrap();
    assert!((hunting.frequency_hz / hunting.comparison_hz - 0.5).abs() < 0.02, "{hunting:?}");
    assert!((hunting.swing_um - swing_um).abs() < 0.02, "{hunting:?}");
}

#[test]
fn the_closed_loop_follows_and_goes_home() {
    let machine = Swing { amplitude_um: 3.0, period_s: 20.0, ..MACHINE };
    let pass = run(machine, true, 16.0);
    let lead_um = &pass.trace.lead_error_um[4..];
    let largest_um = lead_um.iter().fold(0.0_f64, |largest, error| largest.max(error.abs()));
    assert!(largest_um < 0.7, "{largest_um}");
    let most = pass.trace.steps.iter().max().unwrap();
    assert!((220..270).contains(most), "3 µm are 240 steps forward: {most}");
    let playback = pass.playback.unwrap();
    assert_eq!(playback.left, 0);
    assert_eq!(playback.steps, pass.steps_net.unsigned_abs());
}
