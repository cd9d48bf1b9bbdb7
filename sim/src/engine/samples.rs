//! The generator's Rust, compiled in for random designs and every block, held to the reference
//! engine flip-flop by flip-flop: stepped, leapt and, some, in lanes.

use helixlock_netlist::{Library, Netlist, elaborate, mask};
use helixlock_rtl::{APART, BLOCKS};

use super::Engine;
use super::agreement::compare;
use super::circuit::Circuit;
use super::compiled::{Compiled, DenseKernel};
use super::interpreter::Interpreter;
use super::lanes::{LaneKernel, Lanes};
use super::leap::Leap;
use super::moment::Kernel;
use super::random_design::{Dice, random_bits, random_design};

#[allow(clippy::all, clippy::pedantic, reason = "generated: written for the compiler alone")]
#[allow(unused_imports, reason = "a design may do without shifts")]
#[allow(unused_variables, reason = "bits that nobody takes: the compiler drops them")]
#[allow(unused_mut, reason = "a design may have nothing that is kept")]
#[allow(unused_comparisons, reason = "a random design compares with anything")]
#[allow(unreachable_pub, reason = "the device's kernel is public, these are not")]
mod generated {
    use super::{Check, check, check_lanes};
    use crate::engine::all_signals::AllSignals;
    use crate::engine::compiled::DenseKernel;
    use crate::engine::lanes::{LANE_WORDS, Lane, LaneKernel};
    use crate::engine::moment::{Coasting, Kernel, Moment};
    use crate::engine::rest::Rest;
    use crate::engine::vector::Vector;
    use crate::engine::words::{choose, shift_down, shift_up};

    include!(concat!(env!("OUT_DIR"), "/samples.rs"));
}

/// Holds the engines of one kernel to the reference.
type Check = fn(&Circuit, &Dice) -> Traits;

/// What makes a design one that tests something.
struct Traits {
    keeps_words: bool,
    has_counters: bool,
    /// Registers that are bits of one word.
    packed: u32,
    tables: usize,
}

fn check<K: DenseKernel + Kernel + Default>(circuit: &Circuit, dice: &Dice) -> Traits {
    compare(circuit.netlist(), &mut Compiled::<K>::new(circuit), &mut dice.clone());
    compare(circuit.netlist(), &mut Leap::new(circuit, K::default()), &mut dice.clone());
    Traits {
        keeps_words: !K::KEPT.as_ref().is_empty(),
        has_counters: !circuit.partition().counters.is_empty(),
        packed: packed::<K>(),
        tables: K::TABLES,
    }
}

/// Counted by setting all registers.
fn packed<K: DenseKernel>() -> u32 {
    let mut registers = K::REGISTERS;
    registers.as_mut().fill(1);
    K::pack(&registers, 0).count_ones()
}

/// One lane among others with inputs of their own, besides the other engines.
fn check_lanes<K: LaneKernel + DenseKernel + Kernel + Default>(
    circuit: &Circuit,
    seed: &Dice,
) -> Traits {
    let netlist = circuit.netlist();
    let mut dice = seed.clone();
    let mut lanes = Lanes::<K>::new(circuit);
    let mut single = Interpreter::new(netlist);
    for _ in 0..200 {
        for input in &netlist.inputs {
            let [value, other] = [(); 2].map(|()| dice.roll() & mask(netlist.signal(*input).width));
            lanes.set_input(*input, other);
            lanes.set_input_of(300, *input, value);
            single.set_input(*input, value);
        }
        lanes.step();
        single.step();
        assert_eq!(lanes.flip_flops(300), single.flip_flops(), "clock {}", single.clock());
    }
    check::<K>(circuit, seed)
}

#[test]
fn generated_engines_of_random_designs_agree_with_the_reference() {
    let mut traits = Vec::new();
    for checks in [generated::RANDOM, generated::LANES] {
        for (seed, check) in (0..).zip(checks) {
            let mut dice = Dice(seed);
            let circuit = Circuit::new(random_design(&mut dice));
            traits.push(check(&circuit, &dice));
        }
    }
    let count = |has: fn(&Traits) -> bool| traits.iter().filter(|traits| has(traits)).count();
    assert!(10 <= count(|traits| traits.keeps_words), "designs that keep words");
    assert!(10 <= count(|traits| traits.has_counters), "designs that leap");
    assert!(10 <= count(|traits| !traits.has_counters), "designs with nothing to leap");
    assert!(10 <= count(|traits| 0 < traits.packed), "designs with packed registers");
    assert!(10 <= count(|traits| 0 < traits.tables), "designs that look logic up");
}

#[test]
fn generated_engines_of_more_flip_flops_than_a_word_has_bits_agree_with_the_reference() {
    for (seed, check) in (0..).zip(generated::BITS) {
        let mut dice = Dice(seed);
        let circuit = Circuit::new(random_bits(&mut dice));
        let traits = check(&circuit, &dice);
        assert_eq!(traits.packed, u64::BITS, "as many as there is room for");
        assert!(4 <= traits.tables, "logic of more bits than one table takes");
    }
}

#[test]
fn generated_engines_of_every_block_agree_with_the_reference() {
    for (card, check) in BLOCKS.iter().chain(APART).zip(generated::BLOCKS) {
        let design = elaborate(card.name, (card.build)().as_ref(), &Library::new()).unwrap();
        let circuit = Circuit::new(Netlist::new(&design).unwrap());
        for seed in 0..5 {
            check(&circuit, &Dice(seed));
        }
    }
}
