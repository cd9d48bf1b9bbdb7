//! Direction of the laser's fringes, figure 6: drawn, and "not used in practice".
//!
//! Two photocells (⑩ and ⑪ of figure 5) see the fringes a quarter apart. An edge of the one, while
//! the other is low, is a fringe forward when it rises and a fringe back when it falls; a
//! double-input flip-flop keeps which it was.
//!
//! | sine    | cosine | pulse     | forward then |
//! |---------|--------|-----------|--------------|
//! | rises   | 0      | `up`      | 1            |
//! | falls   | 0      | `down`    | 0            |
//! | any     | 1      | none      | as it was    |
//!
//! # Inferred
//!
//! All of it but that it exists. Edges are found with an RC delay and a gate, one pulse a fringe;
//! the alternative with four pulses a fringe needs four times the gates, and the reversible counter
//! behind it was not used either. The synchronous device has no such block.

use crate::circuit::{Circuit, Net};

/// How long a pulse lasts, ps.
const PULSE_PS: u64 = 500_000;

/// The two photocells, the second a quarter of a fringe behind the first one.
pub const PHOTOCELLS: [&str; 2] = ["sine", "cosine"];

/// Pulses up and down, and the direction.
pub fn add(c: &mut Circuit, sine: Net, cosine: Net) -> [Net; 3] {
    let late = c.delay("late", sine, PULSE_PS);
    let late_bar = c.not("late_bar", late);
    let sine_bar = c.not("sine_bar", sine);
    let cosine_bar = c.not("cosine_bar", cosine);
    let up_bar = c.nand("up_bar", &[sine, late_bar, cosine_bar]);
    let down_bar = c.nand("down_bar", &[sine_bar, late, cosine_bar]);
    let [forward, _] = c.latch("forward", &[up_bar], &[down_bar]);
    [c.not("up", up_bar), c.not("down", down_bar), forward]
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("laser_direction");
    let [sine, cosine] = PHOTOCELLS.map(|name| c.input(name, false));
    let [up, down, forward] = add(&mut c, sine, cosine);
    for (name, net) in [("up", up), ("down", down), ("forward", forward)] {
        c.output(name, net);
    }
    c
}
