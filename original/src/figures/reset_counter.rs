//! Reset counter, figure 17: twelve JK flip-flops up and down, line 158, and the side of zero.
//!
//! | count  | playback | direction   | step passes | count then | side then     |
//! |--------|----------|-------------|-------------|------------|---------------|
//! | 0      | 0        | any         | yes         | 1          | the direction |
//! | 0      | 1        | –           | no          | 0          | same          |
//! | other  | 0        | the side's  | yes         | + 1        | same          |
//! | other  | any      | against it  | yes         | − 1        | same          |
//! | 4095   | 0        | the side's  | yes         | **0**      | same          |
//!
//! The last row is where the original differs from the synchronous block: it wraps, and zero is lost.
//!
//! ```text
//! request ─ NAND(zero ∧ playback) ─ step ─┬─ clock of all stages
//!                                         └─ AND(line 158) ─ clock of `side`
//! ```
//!
//! # Inferred
//!
//! All stages have one clock, and J = K of each is a chain of gates through those below it. A ripple
//! counter is the alternative; with it, every change of direction would clock the stages whose
//! output is high. The count pulse gets to the clock of `side` only while line 158 is high, the
//! count zero: "the last number of steps since the last pass through zero". The chain takes up to
//! 0.6 µs, so direction has to rest that long before a step.

use crate::circuit::{Circuit, Jk, Net};

/// Stages.
pub const STAGES: usize = 12;

/// Pins of the counter.
#[derive(Clone, Debug)]
pub struct Counter {
    /// Steps away from zero, low bit first.
    pub count: Vec<Net>,
    /// On which side.
    pub side: Net,
    /// Line 158: the count is zero.
    pub zero: Net,
    /// The step pulse that passes.
    pub step: Net,
    /// Its direction.
    pub drive_forward: Net,
}

/// Request, direction and playback come from the panel and the discriminator.
pub fn add(c: &mut Circuit, request: Net, forward: Net, playback: Net, reset_bar: Net) -> Counter {
    let stages: Vec<[Net; 2]> =
        (0..STAGES).map(|stage| c.flip_flop_wires(&format!("q{stage}"))).collect();
    let bars: Vec<Net> = stages.iter().map(|stage| stage[1]).collect();
    let (some, others) = (c.nand("some", &bars[..8]), c.nand("others", &bars[8..]));
    let zero = c.nor("line_158", &[some, others]);
    let open = c.nand("stop", &[zero, playback]);
    let step = c.and("step", [request, open]);
    let side = c.flip_flop_wires("side");
    let drive = direction(c, forward, playback, side);
    let (up, down) = up_and_down(c, drive, side, zero);
    count(c, &stages, step, (up, down), reset_bar);
    let clock = c.and("side_clock", [step, zero]);
    let pins =
        Jk { clock, j: &[drive[0]], k: &[drive[1]], preset: Circuit::HIGH, clear: reset_bar };
    c.flip_flop_onto(side, pins);
    let count = stages.iter().map(|stage| stage[0]).collect();
    Counter { count, side: side[0], zero, step, drive_forward: drive[0] }
}

/// Direction of the motor and its inverse: the discriminator's, or against the side.
fn direction(c: &mut Circuit, forward: Net, playback: Net, side: [Net; 2]) -> [Net; 2] {
    let normal = c.not("normal", playback);
    let reverse = c.and_or_invert("drive_reverse", [forward, normal], [side[1], playback]);
    [c.not("drive_forward", reverse), reverse]
}

/// Away from zero counts up.
fn up_and_down(c: &mut Circuit, drive: [Net; 2], side: [Net; 2], zero: Net) -> (Net, Net) {
    let against = c.and_or_invert("against", [drive[0], side[0]], [drive[1], side[1]]);
    let not_zero = c.not("not_zero", zero);
    let up = c.nand("up", &[against, not_zero]);
    (up, c.not("down", up))
}

/// The stages, each with J and K from those below.
fn count(
    c: &mut Circuit,
    stages: &[[Net; 2]],
    step: Net,
    (mut up, mut down): (Net, Net),
    reset_bar: Net,
) {
    for (number, stage) in stages.iter().enumerate() {
        let toggle =
            if number == 0 { Circuit::HIGH } else { c.or(&format!("toggle{number}"), [up, down]) };
        let toggles = [toggle];
        let pins = Jk { j: &toggles, k: &toggles, ..Jk::toggle(step, reset_bar) };
        c.flip_flop_onto(*stage, pins);
        up = c.and(&format!("up{number}"), [up, stage[0]]);
        down = c.and(&format!("down{number}"), [down, stage[1]]);
    }
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("reset_counter");
    let [request, playback] = ["request", "playback"].map(|name| c.input(name, false));
    let (forward, reset_bar) = (c.input("forward", true), c.input("reset_bar", true));
    let counter = add(&mut c, request, forward, playback, reset_bar);
    for (number, net) in counter.count.iter().enumerate() {
        c.output(&format!("count{number}"), *net);
    }
    let pins = [("count_forward", counter.side), ("zero", counter.zero)];
    for (name, net) in pins.into_iter().chain([("taken", counter.step)]) {
        c.output(name, net);
    }
    c
}
