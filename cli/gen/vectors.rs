//! Stimulus for the test bench of the board, and what our engine answers to it.
//!
//! First a pass as a grinder would drive it, only faster: fringes every 24 clocks, lines in the
//! ratio of the dividers, then the panel's switches one after the other. Then noise on all pins.

use helixlock_gen::Vector;
use helixlock_netlist::Netlist;
use helixlock_rtl::settings::{Conditioning, Settings};
use helixlock_sim::Circuit;

use super::bench::{Bench, Trains};

/// Clocks from fringe to fringe.
const FRINGE_CLOCKS: u32 = 24;

/// Most clocks of the pass, so that large dividers do not make a long test.
const PASS_CLOCKS: u32 = 100_000;

/// About as many clocks for the steps of the panel: Icarus takes some seconds for a million.
const PANEL_CLOCKS: u32 = 600_000;

/// Steps the counter can be away from zero.
const MOST_STEPS: u32 = 4095;

/// Clocks of noise.
const NOISE_CLOCKS: u32 = 20_000;

/// The vectors for a board shell with these settings.
pub(super) fn vectors(
    netlist: Netlist,
    settings: &Settings,
    conditioning: &Conditioning,
) -> Vec<Vector> {
    let circuit = Circuit::new(netlist);
    let mut bench = Bench::new(&circuit, conditioning.active_low);
    let settled = conditioning.tick_period * (conditioning.debounce_ticks + 1) + 6;
    pass(&mut bench, settings, settled);
    panel(&mut bench, settings, settled);
    bench.noise(NOISE_CLOCKS);
    bench.vectors
}

/// A pass of eight comparison periods: measured first, then corrected, the phase drifting.
fn pass(bench: &mut Bench<'_>, settings: &Settings, settled: u32) {
    let period = settings.range.factor() * settings.b * FRINGE_CLOCKS;
    let clocks = (8 * period).min(PASS_CLOCKS);
    let mut trains = Trains::new(settings.a, settings.b, FRINGE_CLOCKS);
    bench.clocks(20);
    bench.set("range_x2", u64::from(settings.range.factor() == 2));
    bench.set("enable", 1);
    bench.set("start", 1);
    bench.clocks(settled);
    trains.drive(bench, clocks / 4);
    bench.set("correct", 1);
    bench.clocks(settled);
    trains.drive(bench, clocks / 8 * 5);
    for calibration in [1, 2, 3, 0] {
        bench.set("calibrate", calibration);
        trains.drive(bench, clocks / 32);
    }
}

/// Manual steps both ways, and the playback to zero; each waits for the step clock.
fn panel(bench: &mut Bench<'_>, settings: &Settings, settled: u32) {
    let steps = (PANEL_CLOCKS / (settings.step_period + 2 * settled)).clamp(1, 60);
    bench.set("correct", 0);
    bench.clocks(settled);
    for step in 0..steps {
        bench.set("manual_forward", u64::from(3 * step < 2 * steps));
        bench.set("manual_step", 1);
        bench.clocks(settled);
        bench.set("manual_step", 0);
        bench.clocks(settings.step_period.max(settled));
    }
    bench.set("playback", 1);
    bench.clocks(settled);
    for _ in 0..MOST_STEPS {
        bench.clocks(settings.step_period);
        if bench.is_high("zero") {
            break;
        }
    }
    bench.clocks(settings.step_period + 100);
    bench.set("playback", 0);
    bench.clocks(settled);
}
