//! What the pins of the device do in a benchmark: the same for every engine and peer.

use helixlock_netlist::Netlist;
use helixlock_rtl::settings::{Range, Settings};
use helixlock_sim::Engine;

/// A pin changes before the edge after `clock`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PinEvent {
    pub(crate) clock: u64,
    /// Index among the inputs.
    pub(crate) pin: usize,
    pub(crate) value: u64,
}

/// A grinding pass on the 6 mm screw, ×2, correcting: square waves of fringes and lines that drift
/// past each other by 20 µm/m, at a spindle speed in rpm and a clock in Hz.
pub(crate) fn pass(netlist: &Netlist, clocks: u64, speed_rpm: f64, clock_hz: f64) -> Vec<PinEvent> {
    let turns_per_clock = speed_rpm / 60.0 / clock_hz;
    let fringes_per_turn = 6.0 / (0.632_819_83e-3 / 2.0) * (1.0 + 20e-6);
    let mut events = settings(netlist, correcting(clock_hz));
    for (pin, per_turn) in [("grating", 13906.0), ("laser", fringes_per_turn)] {
        square_wave(&mut events, pin_of(netlist, pin), 0.5 / (per_turn * turns_per_clock), clocks);
    }
    events.sort_by_key(|event| event.clock);
    events
}

/// Pulses every eight clocks on both inputs, now and then one clock later, a short step period: the
/// logic never rests.
pub(crate) fn dense(netlist: &Netlist, clocks: u64) -> Vec<PinEvent> {
    let mut events = settings(netlist, correcting(500.0));
    square_wave(&mut events, pin_of(netlist, "grating"), 4.01, clocks);
    square_wave(&mut events, pin_of(netlist, "laser"), 3.99, clocks);
    events.sort_by_key(|event| event.clock);
    events
}

/// Held in reset, where the conditions of all registers are met at every clock and nothing changes.
#[allow(dead_code, reason = "the peers' run alone has a use for it")]
pub(crate) fn held(netlist: &Netlist) -> Vec<PinEvent> {
    let mut events = settings(netlist, correcting(500.0));
    events.push(PinEvent { clock: 10, pin: pin_of(netlist, "master_reset"), value: 1 });
    events
}

/// The most that the device can be made to do: one input changes at every clock and the other at every
/// second, each pulse is compared and steps the motor, the compensator inserts at every wrap of its
/// shortest count. No block rests.
#[allow(dead_code, reason = "the peers' run alone has a use for it")]
pub(crate) fn all_active(netlist: &Netlist, clocks: u64) -> Vec<PinEvent> {
    let shortest = Settings {
        a: 1,
        b: 1,
        range: Range::X1,
        initial_phase: 0,
        compensation_f: 1000,
        insert: true,
        step_period: 1,
    };
    let mut events = settings(netlist, shortest);
    square_wave(&mut events, pin_of(netlist, "grating"), 1.0, clocks);
    square_wave(&mut events, pin_of(netlist, "laser"), 2.0, clocks);
    events.sort_by_key(|event| event.clock);
    events
}

/// Pulses on both inputs, each level held for 2 to 6 clocks as chance will have it: what happens next
/// cannot be foreseen, not by a processor's branch predictor either.
#[allow(dead_code, reason = "the peers' run alone has a use for it")]
pub(crate) fn irregular(netlist: &Netlist, clocks: u64) -> Vec<PinEvent> {
    let mut events = settings(netlist, correcting(500.0));
    // The multiplicative generator of Park and Miller (1988).
    let mut state = 1977_u64;
    for pin in ["grating", "laser"].map(|name| pin_of(netlist, name)) {
        let mut clock = 20;
        for edge in 1_u64.. {
            state = state * 16807 % 0x7fff_ffff;
            clock += 2 + state % 5;
            if clocks <= clock {
                break;
            }
            events.push(PinEvent { clock, pin, value: edge % 2 });
        }
    }
    events.sort_by_key(|event| event.clock);
    events
}

/// Drives an engine through all events and on to clock number `clocks`.
pub(crate) fn drive(engine: &mut dyn Engine, events: &[PinEvent], clocks: u64) {
    let inputs = engine.netlist().inputs.clone();
    for event in events.iter().take_while(|event| event.clock < clocks) {
        engine.run_until(event.clock);
        engine.set_input(inputs[event.pin], event.value);
    }
    engine.run_until(clocks);
}

/// The 6 mm screw, ×2.
fn correcting(clock_hz: f64) -> Settings {
    Settings {
        a: 110,
        b: 150,
        range: Range::X2,
        initial_phase: 150,
        compensation_f: 156_000,
        insert: false,
        step_period: step_period(clock_hz),
    }
}

fn settings(netlist: &Netlist, settings: Settings) -> Vec<PinEvent> {
    let named = settings.wheels().expect("the settings are in range").named();
    let switches = [("start", 1), ("correct", 1)];
    let levels = named.into_iter().chain(switches);
    levels.map(|(name, value)| PinEvent { clock: 10, pin: pin_of(netlist, name), value }).collect()
}

fn square_wave(events: &mut Vec<PinEvent>, pin: usize, half_period_clocks: f64, clocks: u64) {
    let mut level = 0;
    for edge in 1_u64.. {
        let clock = 20 + whole(edge, half_period_clocks);
        if clocks <= clock {
            return;
        }
        level ^= 1;
        events.push(PinEvent { clock, pin, value: level });
    }
}

/// Clocks of 160 steps a second.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2²⁴")]
fn step_period(clock_hz: f64) -> u32 {
    (clock_hz / 160.0) as u32
}

/// So many half periods in whole clocks.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "far below 2⁵³"
)]
fn whole(edges: u64, half_period_clocks: f64) -> u64 {
    (edges as f64 * half_period_clocks) as u64
}

fn pin_of(netlist: &Netlist, name: &str) -> usize {
    let input = netlist.find(name);
    let pin = netlist.inputs.iter().position(|candidate| Some(*candidate) == input);
    pin.unwrap_or_else(|| panic!("`{name}` is an input of the device"))
}
