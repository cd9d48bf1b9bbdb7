//! The generator's Rust, compiled in for random designs and every block, held to the reference
//! engine flip-flop by flip-flop: stepped, leapt and, some, in lanes.

use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_rtl::{APART, BLOCKS};

use super::agreement::compare;
use super::circuit::Circuit;
use super::compiled::Compiled;
use super::dense::{DenseKernel, Known};
use super::gather::Gathering;
use super::lane_agreement::compare_lanes;
use super::lanes::LaneKernel;
use super::leaping::Leaping;
use super::random_design::{Dice, random_bits, random_design, random_waiting};

#[allow(clippy::all, clippy::pedantic, reason = "generated: written for the compiler alone")]
#[allow(unused_imports, reason = "a design may do without shifts")]
#[allow(unused_variables, reason = "bits that nobody takes: the compiler drops them")]
#[allow(unused_mut, reason = "a design may have nothing that is kept")]
#[allow(unused_comparisons, reason = "a random design compares with anything")]
#[allow(unreachable_pub, reason = "the device's kernel is public, these are not")]
mod generated {
    use helixlock_netlist::SignalId;

    use super::{Check, LaneCheck, check, check_lanes};
    use crate::device::DeviceKernel;
    use crate::engine::all_signals::AllSignals;
    use crate::engine::dense::{Coast, DenseKernel, Edge, Known};
    use crate::engine::gather::Gather;
    use crate::engine::lanes::{LANE_WORDS, Lane, LaneKernel};
    use crate::engine::rest::Rest;
    use crate::engine::vector::Vector;
    use crate::engine::words::{choose, shift_down, shift_up};

    include!(concat!(env!("OUT_DIR"), "/samples.rs"));
}

/// Holds the engines of one kernel to the reference.
type Check = fn(&Circuit, &Dice) -> Traits;

/// What makes a design one that tests something.
struct Traits {
    /// Words that are kept, and such as follow from inputs alone.
    kept: usize,
    set: usize,
    /// Registers that are bits of what is known, early and late.
    packed: [u32; 2],
    tables: usize,
    /// It is leapt through, and a counter coasts meanwhile.
    leaps: bool,
    coasts: bool,
    /// Registers that splitting adds.
    split: usize,
}

fn check<K: DenseKernel>(circuit: &Circuit, dice: &Dice) -> Traits {
    let netlist = circuit.netlist();
    for by in Gathering::all() {
        compare(netlist, &mut Compiled::<K>::by(circuit, by), &mut dice.clone());
        compare(netlist, &mut Leaping::<K>::by(circuit, by), &mut dice.clone());
    }
    Traits {
        kept: K::KEPT.as_ref().len(),
        set: K::INPUTS.as_ref().len() - netlist.inputs.len(),
        packed: packed::<K>(),
        tables: K::TABLES,
        leaps: K::BUSY.is_some(),
        coasts: K::BUSY.is_some() && !K::COASTING.is_empty(),
        split: K::REGISTERS.as_ref().len() - netlist.registers.len(),
    }
}

/// Counted by setting all registers.
fn packed<K: DenseKernel>() -> [u32; 2] {
    let values = vec![u64::MAX; K::join(Known::default(), &K::REGISTERS).as_ref().len()];
    let Known { early, late } = K::split(&values, &mut { K::REGISTERS }, 0);
    [early.count_ones(), late.count_ones()]
}

/// Holds the lanes of one kernel to the reference.
type LaneCheck = fn(&Circuit, &Dice) -> LaneTraits;

/// What makes a design one that tests something in lanes.
struct LaneTraits {
    /// Gates that are kept.
    kept: usize,
    /// Groups of registers that follow inputs.
    following: usize,
}

fn check_lanes<K: LaneKernel>(circuit: &Circuit, dice: &Dice) -> LaneTraits {
    compare_lanes::<K>(circuit, dice);
    LaneTraits { kept: K::KEPT.as_ref().len(), following: K::SETTLING.as_ref().len() }
}

#[test]
fn generated_engines_of_random_designs_agree_with_the_reference() {
    let mut traits = Vec::new();
    for (seed, check) in (0..).zip(generated::RANDOM) {
        let mut dice = Dice(seed);
        let circuit = Circuit::new(random_design(&mut dice));
        traits.push(check(&circuit, &dice));
    }
    let count = |has: fn(&Traits) -> bool| traits.iter().filter(|traits| has(traits)).count();
    assert!(8 <= count(|traits| 0 < traits.kept), "designs that keep words");
    assert!(8 <= count(|traits| !traits.leaps), "designs with nothing to leap");
    assert!(8 <= count(|traits| 0 < traits.packed[0]), "designs with packed registers");
    assert!(8 <= count(|traits| 0 < traits.tables), "designs that look logic up");
    assert!(8 <= count(|traits| 0 < traits.set), "designs with words that follow from inputs");
}

#[test]
fn generated_engines_of_designs_that_wait_agree_with_the_reference() {
    let mut traits = Vec::new();
    for (seed, check) in (0..).zip(generated::WAITING) {
        let mut dice = Dice(seed);
        let circuit = Circuit::new(random_waiting(&mut dice));
        for round in 0..20 {
            traits.push(check(&circuit, &Dice(round)));
        }
    }
    let count = |has: fn(&Traits) -> bool| traits.iter().filter(|traits| has(traits)).count() / 20;
    assert!(3 <= count(|traits| traits.coasts), "designs with a counter that coasts");
    assert!(3 <= count(|traits| 0 < traits.split), "designs with narrow registers that are split");
    assert!(3 <= count(|traits| 0 < traits.packed[1]), "designs with registers known late");
}

#[test]
fn generated_engines_of_more_flip_flops_than_a_word_has_bits_agree_with_the_reference() {
    for (seed, check) in (0..).zip(generated::BITS) {
        let mut dice = Dice(seed);
        let circuit = Circuit::new(random_bits(&mut dice));
        let traits = check(&circuit, &dice);
        assert_eq!(traits.packed[0], u64::BITS, "as many as there is room for");
        assert!(4 <= traits.tables, "logic of more bits than one table takes");
    }
}

#[test]
fn generated_engines_of_every_block_agree_with_the_reference() {
    let mut leaping = 0;
    for (card, check) in BLOCKS.iter().chain(APART).zip(generated::BLOCKS) {
        let design = elaborate(card.name, (card.build)().as_ref(), &Library::new()).unwrap();
        let circuit = Circuit::new(Netlist::new(&design).unwrap());
        leaping += usize::from((0..5).all(|seed| check(&circuit, &Dice(seed)).leaps));
    }
    assert!(10 <= leaping, "blocks that leap");
}

#[test]
fn lanes_of_random_designs_agree_with_the_reference() {
    let mut traits = Vec::new();
    let random = (0..).zip(generated::LANES);
    let waiting = (0..).zip(generated::WAITING_LANES);
    let designs = random.map(|of| (of, random_design as fn(&mut Dice) -> Netlist));
    for ((seed, check), design) in designs.chain(waiting.map(|of| (of, random_waiting as _))) {
        let mut dice = Dice(seed);
        let circuit = Circuit::new(design(&mut dice));
        for round in 0..4 {
            traits.push(check(&circuit, &Dice(round)));
        }
    }
    let count = |has: fn(&LaneTraits) -> bool| traits.iter().filter(|of| has(of)).count() / 4;
    assert!(3 <= count(|traits| 0 < traits.kept), "designs that keep gates");
    assert!(3 <= count(|traits| 0 < traits.following), "designs with registers that follow inputs");
}
