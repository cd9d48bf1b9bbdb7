//! Inputs clock by clock: noise that no machine would make, and passes as a machine drives them.

use helixlock_netlist::{Netlist, mask};
use helixlock_rtl::settings::bcd;
use rand::seq::IndexedRandom;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// An endless source of inputs, in the order of [`Netlist::inputs`].
pub(crate) struct Stimulus {
    names: Vec<String>,
    widths: Vec<u32>,
    dice: ChaCha8Rng,
    next: fn(&mut Self, &mut [u64]),
    clock: u64,
    /// Clocks left until switches and wheels may change.
    left: u32,
    /// How often a pin changes in noise.
    often: f64,
    line: Train,
    fringe: Train,
}

/// A pulse train: a phase that wraps once a pulse.
#[derive(Clone, Copy, Default)]
struct Train {
    phase: u32,
    step: u32,
}

/// Every input at random; wheels show anything, also what is no decimal digit.
pub(crate) fn dense(netlist: &Netlist, seed: u64) -> Stimulus {
    Stimulus::new(netlist, seed, noise)
}

/// Trains of lines and fringes of nearly the same divided rate, switches thrown now and then.
pub(crate) fn realistic(netlist: &Netlist, seed: u64) -> Stimulus {
    Stimulus::new(netlist, seed, pass)
}

impl Stimulus {
    fn new(netlist: &Netlist, seed: u64, next: fn(&mut Self, &mut [u64])) -> Self {
        let signals = netlist.inputs.iter().map(|&id| netlist.signal(id));
        Self {
            names: signals.clone().map(|signal| signal.path.clone()).collect(),
            widths: signals.map(|signal| signal.width).collect(),
            dice: ChaCha8Rng::seed_from_u64(seed),
            next,
            clock: 0,
            left: 0,
            often: 0.5,
            line: Train::default(),
            fringe: Train::default(),
        }
    }

    /// The inputs of the next clock, from those of the last.
    pub(crate) fn next(&mut self, inputs: &mut [u64]) {
        (self.next)(self, inputs);
        self.clock += 1;
    }

    fn set(&self, inputs: &mut [u64], name: &str, value: u64) {
        if let Some(index) = self.names.iter().position(|known| known == name) {
            inputs[index] = value & mask(self.widths[index]);
        }
    }
}

fn noise(stimulus: &mut Stimulus, inputs: &mut [u64]) {
    if stimulus.left == 0 {
        stimulus.left = stimulus.dice.random_range(1..3000);
        stimulus.often = *[0.5, 0.1, 0.01].choose(&mut stimulus.dice).expect("a choice");
        wheels(stimulus, inputs);
        if stimulus.dice.random_bool(0.3) {
            for name in ["divide_a", "divide_b", "initial_phase", "compensation"] {
                let anything = stimulus.dice.next_u64();
                stimulus.set(inputs, name, anything);
            }
        }
    }
    stimulus.left -= 1;
    for (index, width) in stimulus.widths.iter().enumerate().filter(|(_, width)| **width <= 2) {
        // Resets as often as the rest would leave nothing to reset.
        let rare = matches!(stimulus.names[index].as_str(), "master_reset" | "start");
        let often = if rare { stimulus.often / 100.0 } else { stimulus.often };
        if stimulus.dice.random_bool(often) {
            inputs[index] = stimulus.dice.next_u64() & mask(*width);
        }
    }
}

/// Presets small enough that much happens, and a fast step clock.
fn wheels(stimulus: &mut Stimulus, inputs: &mut [u64]) {
    let dice = &mut stimulus.dice;
    let small = |dice: &mut ChaCha8Rng| bcd(dice.random_range(1..40));
    let (a, b, m) = (small(dice), small(dice), bcd(dice.random_range(0..30)));
    let (period, compensation) = (dice.random_range(1..60), dice.random_range(0..3));
    let insert = u64::from(dice.random_bool(0.5));
    let range = u64::from(dice.random_bool(0.5));
    for (name, value) in [
        ("divide_a", a),
        ("divide_b", b),
        ("initial_phase", m),
        ("step_period", period),
        ("compensation", compensation),
        ("compensation_insert", insert),
        ("range_x2", range),
    ] {
        stimulus.set(inputs, name, value);
    }
}

fn pass(stimulus: &mut Stimulus, inputs: &mut [u64]) {
    if stimulus.left == 0 {
        stimulus.left = stimulus.dice.random_range(5_000..60_000);
        new_pass(stimulus, inputs);
    }
    stimulus.left -= 1;
    for (name, train) in [("grating", &mut stimulus.line), ("laser", &mut stimulus.fringe)] {
        train.phase = train.phase.wrapping_add(train.step);
        let level = u64::from(train.phase >> 31);
        if let Some(index) = stimulus.names.iter().position(|known| known == name) {
            inputs[index] = level;
        }
    }
    if stimulus.dice.random_bool(0.001) {
        let name = *["correct", "playback", "manual_step", "manual_forward", "calibrate"]
            .choose(&mut stimulus.dice)
            .expect("a choice");
        let value = stimulus.dice.next_u64();
        stimulus.set(inputs, name, value);
    }
}

/// Another workpiece: wheels, speeds, and the phase zeroed.
fn new_pass(stimulus: &mut Stimulus, inputs: &mut [u64]) {
    wheels(stimulus, inputs);
    let (a, b) = (stimulus.dice.random_range(2..40_u32), stimulus.dice.random_range(2..40_u32));
    stimulus.set(inputs, "divide_a", bcd(a));
    stimulus.set(inputs, "divide_b", bcd(b));
    // The faster train has a pulse every 8 to 100 clocks; the other one follows from A and B.
    let fastest = u32::MAX / stimulus.dice.random_range(8..100_u32);
    let (slow_a, slow_b) = (fastest / b.max(a) * a, fastest / b.max(a) * b);
    let drift = stimulus.dice.random_range(0..slow_a / 200 + 1);
    stimulus.line.step = slow_a + drift;
    stimulus.fringe.step = slow_b;
    let reset = u64::from(stimulus.dice.random_bool(0.3));
    stimulus.set(inputs, "master_reset", 0);
    stimulus.set(inputs, "start", 1 - reset);
    stimulus.set(inputs, "correct", u64::from(stimulus.dice.clone().random_bool(0.7)));
}
