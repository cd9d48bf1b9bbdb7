//! Stimulus for the test bench of the device, whose settings are inputs and so small here that
//! everything comes within some thousand clocks: a compensation, the end of the counter, a
//! coincidence at the meter, a button pressed in vain.

use helixlock_gen::Vector;
use helixlock_rtl::settings::{Range, Settings};

use super::bench::{Bench, Trains};

/// Clocks from fringe to fringe.
const FRINGE_CLOCKS: u32 = 6;

/// Clocks of a pass: 1100 fringes, for the shortest compensation is due after 1000.
const PASS_CLOCKS: u32 = 1100 * FRINGE_CLOCKS;

/// Steps the counter can be away from zero.
const MOST_STEPS: u32 = 4095;

/// Clocks of noise.
const NOISE_CLOCKS: u32 = 4000;

const SHORT: Settings = Settings {
    a: 4,
    b: 3,
    range: Range::X1,
    initial_phase: 2,
    compensation_f: 1000,
    insert: false,
    step_period: 40,
};

/// The vectors for the device.
///
/// # Errors
///
/// Never: these settings can be dialled.
pub(super) fn device_vectors() -> anyhow::Result<Vec<Vector>> {
    let mut bench = Bench::new(helixlock_sim::device(), false);
    for (range, insert) in
        [(Range::X1, false), (Range::X1, true), (Range::X2, false), (Range::X2, true)]
    {
        dial(&mut bench, &Settings { range, insert, ..SHORT })?;
        pass(&mut bench);
    }
    dial(&mut bench, &SHORT)?;
    buttons(&mut bench);
    dial(&mut bench, &Settings { a: 1, b: 1, initial_phase: 0, compensation_f: 0, ..SHORT })?;
    coincidences(&mut bench);
    dial(&mut bench, &Settings { step_period: 1, ..SHORT })?;
    end_of_the_counter(&mut bench);
    dial(&mut bench, &Settings { compensation_f: 0, step_period: 5, ..SHORT })?;
    bench.noise(NOISE_CLOCKS);
    Ok(bench.vectors)
}

/// Turns the wheels while nothing runs.
fn dial(bench: &mut Bench<'_>, settings: &Settings) -> anyhow::Result<()> {
    for switch in ["start", "correct", "playback", "manual_step", "calibrate"] {
        bench.set(switch, 0);
    }
    bench.set("master_reset", 1);
    for (name, level) in settings.wheels()?.named() {
        bench.set(name, level);
    }
    bench.clocks(6);
    bench.set("master_reset", 0);
    bench.clocks(6);
    Ok(())
}

/// Measured, corrected, calibrated and played back.
fn pass(bench: &mut Bench<'_>) {
    let mut trains = Trains::new(SHORT.a, SHORT.b, FRINGE_CLOCKS);
    bench.set("start", 1);
    trains.drive(bench, PASS_CLOCKS / 4);
    bench.set("correct", 1);
    trains.drive(bench, PASS_CLOCKS / 2);
    for calibration in [1, 2, 3, 0] {
        bench.set("calibrate", calibration);
        trains.drive(bench, PASS_CLOCKS / 16);
    }
    bench.set("start", 0);
    bench.set("playback", 1);
    bench.clocks(40 * SHORT.step_period);
}

/// Manual steps both ways; a press that correcting or playing back takes away before its tick.
fn buttons(bench: &mut Bench<'_>) {
    for forward in [1, 1, 0] {
        bench.set("manual_forward", forward);
        bench.pulse(&["manual_step"]);
        bench.clocks(2 * SHORT.step_period);
    }
    for switch in ["correct", "playback"] {
        // Ticks are 40 clocks apart: of five places at least four lie between two ticks.
        for _ in 0..5 {
            bench.pulse(&["manual_step"]);
            bench.clocks(4);
            bench.pulse(&[switch]);
            bench.clocks(2 * SHORT.step_period + 3);
        }
    }
}

/// A line and a fringe in one clock, the meter set or not; each is a divided pulse.
fn coincidences(bench: &mut Bench<'_>) {
    bench.set("start", 1);
    bench.clocks(6);
    let (line, fringe, both) = (["grating"], ["laser"], ["grating", "laser"]);
    for pulses in [&line[..], &both, &fringe, &both, &both, &line, &fringe, &line, &both] {
        bench.pulse(pulses);
    }
    bench.clocks(6);
}

/// The loop runs away: the counter stops at its end, says so, and takes it back at zero.
fn end_of_the_counter(bench: &mut Bench<'_>) {
    bench.set("start", 1);
    bench.set("correct", 1);
    Trains::new(SHORT.a, SHORT.b, FRINGE_CLOCKS).drive(bench, 40 * FRINGE_CLOCKS);
    bench.clocks(MOST_STEPS + 40);
    bench.set("start", 0);
    bench.set("correct", 0);
    bench.set("playback", 1);
    bench.clocks(MOST_STEPS + 40);
    bench.set("playback", 0);
    bench.clocks(10);
}
