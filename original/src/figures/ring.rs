//! Ring distributor of figure 14: three phases, six steps, three AND gates that bring it back.
//!
//! | state ABC | 100 | 110 | 010 | 011 | 001 | 101 | 000, 111     |
//! |-----------|-----|-----|-----|-----|-----|-----|--------------|
//! | forward   | 110 | 010 | 011 | 001 | 101 | 100 | 100, at once |
//! | reverse   | 101 | 100 | 110 | 010 | 011 | 001 | 100, at once |
//!
//! Each phase takes the inverse of the next one (forward) or of the one before (reverse), when
//! `step` falls. One phase changes in a step, so no step passes through an illegal state.
//!
//! # Inferred
//!
//! "Three AND gates beside the distributor are its automatic return to zero": one sees 111, one
//! 000, one joins them. *Zero* is read as phase A alone, as all phases off is itself illegal and the
//! ring would stay there. Alternative: only 111 is led to 000 and a step is let in from there; then
//! the motor would be without current for one step. The preset ends itself, two gates after the last
//! flip-flop that has to change.

use crate::circuit::{Circuit, Jk, Net};

/// Phases A, B, C; `forward` has to rest while `step` is high.
pub fn add(c: &mut Circuit, step: Net, forward: Net) -> [Net; 3] {
    let high = Circuit::HIGH;
    let reverse = c.not("reverse", forward);
    let phases = ["a", "b", "c"].map(|name| c.flip_flop_wires(name));
    let all = c.nand("all", &phases.map(|phase| phase[0]));
    let none = c.nand("none", &phases.map(|phase| phase[1]));
    let legal = c.and("legal", [all, none]);
    for (place, name) in ["a", "b", "c"].into_iter().enumerate() {
        let (next, before) = (phases[(place + 1) % 3], phases[(place + 2) % 3]);
        let k = c.and_or_invert(&format!("{name}_k"), [forward, next[1]], [reverse, before[1]]);
        let j = c.not(&format!("{name}_j"), k);
        let (preset, clear) = if place == 0 { (legal, high) } else { (high, legal) };
        c.flip_flop_onto(phases[place], Jk { clock: step, j: &[j], k: &[k], preset, clear });
    }
    phases.map(|phase| phase[0])
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("ring");
    let (step, forward) = (c.input("step", false), c.input("forward", true));
    let phases = add(&mut c, step, forward);
    for (name, net) in ["phase_a", "phase_b", "phase_c"].into_iter().zip(phases) {
        c.output(name, net);
    }
    c
}
