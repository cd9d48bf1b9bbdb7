//! Added pulses of the compensation are lost while divider B clears itself.
//!
//! ```text
//! δ = λ/2·floor(x/(n·F·λ/2)),  n·(F + 1) ≡ 1 (mod B)
//!
//! δ, λ in µm    x way since the start of the pass, µm    B divider of the laser
//! F fringes from one added pulse to the next    n one in so many is lost; none when no n fits
//! ```
//!
//! An added pulse stands half a microsecond behind the F-th fringe, where a divider that this fringe
//! has filled is still being cleared. Both begin at zero; from one added pulse to the next divider
//! B counts on by F + 1, and by F behind one that was lost. With F = 1000 and B = 30 it is one in
//! 11, with B = 125 every one.

use super::shape::rough;
use crate::compensation::{dialled_um_per_m, stairs_um};
use crate::machine::Part;
use crate::{Basis, Card, Entry, Machine, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "lost-added-pulses",
    entry: Entry::LengthReference,
    summary: "added pulses of the compensation are lost while divider B clears itself",
    formula: "λ/2·floor(x/(n·F·λ/2)), n·(F + 1) ≡ 1 (mod B)",
    example: "F = 1000, B = 30: one in 11, 0.316 µm every 3.48 mm",
    parameters: &[Parameter::known(0.01, "factor on the count")],
    parts: &[Part::Table, Part::Laser, Part::Dividers],
    needs: &[],
    signature: "stairs of λ/2 over travel, each the same number of added pulses long",
    confused_with: &["compensator-staircase", "screw-progressive"],
    separated_by: "change F by 1000: the stairs get another length or vanish",
    source: "document 1, figures 7 and 9, simulated gate by gate",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let fringe_um = context.machine.fringe_um();
        let lost_um_per_m = lost_um_per_m(context.machine);
        // The pulse is added behind the fall of the F-th fringe, half a fringe late.
        let late_mm = fringe_um / 2000.0;
        Ok(Basis::one(rough(move |now| {
            stairs_um(lost_um_per_m, fringe_um, (now.travelled_mm - late_mm).max(0.0))
        })))
    },
};

/// Rate of what is lost, µm/m; 0 when nothing is.
fn lost_um_per_m(machine: &Machine) -> f64 {
    let dividers = &machine.dividers;
    let added = dividers.compensation_cycle().filter(|_| dialled_um_per_m(machine) < 0.0);
    let one_in = added.and_then(|cycle| Some((cycle, lost_one_in(cycle, dividers.b.into())?)));
    one_in.map_or(0.0, |(cycle, one_in)| 1e6 / (f64::from(cycle) * f64::from(one_in)))
}

/// Of how many added pulses one is lost: the least `n` with `n·(F + 1) ≡ 1 (mod B)`.
fn lost_one_in(cycle: u32, divider: u32) -> Option<u32> {
    let step = (u64::from(cycle) + 1) % u64::from(divider).max(1);
    let mut place = 0;
    (1..=divider).find(|_| {
        place = (place + step) % u64::from(divider);
        place == 1 % u64::from(divider)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pulse by pulse: divider B counts fringes and what is added, unless it has just been filled.
    fn lost_of(cycle: u32, divider: u32, added: u32) -> u32 {
        let (mut place, mut lost) = (0, 0);
        for _ in 0..added {
            place = (place + cycle) % divider;
            if place == 0 {
                lost += 1;
            } else {
                place = (place + 1) % divider;
            }
        }
        lost
    }

    #[test]
    fn one_in_so_many_is_what_counting_gives() {
        for divider in 1..=200 {
            for cycle in (1000..=30_000).step_by(1000) {
                let told = lost_one_in(cycle, divider).map_or(0, |one_in| 1000 / one_in);
                assert_eq!(told, lost_of(cycle, divider, 1000), "F {cycle}, B {divider}");
            }
        }
    }
}
