//! Designs of a few flip-flops become the logic they describe, and unsound ones are refused.

mod blocks;
mod evaluate;

use blocks::{Decade, Nested, Ring};
use evaluate::Machine;
use helixlock_netlist::{Library, Netlist, elaborate};
use rust_hdl::core::block::Block;
use rust_hdl::core::logic::Logic;
use rust_hdl::core::simulate::simulate;

fn flat(block: &dyn Block) -> Netlist {
    let design = elaborate("top", block, &Library::new()).expect("the block is sound");
    Netlist::new(&design).expect("no loop")
}

/// Pseudo-random words (Marsaglia 2003, xorshift64).
fn random(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

#[test]
fn blocks_of_equal_structure_share_a_module() {
    let nested = Nested::default();
    let library = Library::new().with("decade_counter", "One digit.", Box::new(Decade::default()));
    let design = elaborate("two_digits", &nested, &library).unwrap();
    let names: Vec<_> = design.modules.iter().map(|module| module.name.as_str()).collect();
    assert_eq!(names, ["decade_counter", "two_digits"]);
    assert_eq!(design.modules[0].comment, "One digit.");
}

#[test]
fn unknown_blocks_are_named_after_their_first_instance() {
    let design = elaborate("two_digits", &Nested::default(), &Library::new()).unwrap();
    let names: Vec<_> = design.modules.iter().map(|module| module.name.as_str()).collect();
    assert_eq!(names, ["units", "two_digits"]);
}

#[test]
fn paths_are_instances_joined_by_dots() {
    let netlist = flat(&Nested::default());
    let paths: Vec<_> = netlist.signals.iter().map(|s| s.path.as_str()).collect();
    for path in ["pulse", "value", "units.pulse", "tens.carry", "units.digit_q", "tens.digit_d"] {
        assert!(paths.contains(&path), "{path} in {paths:?}");
    }
    let registers: Vec<_> =
        netlist.registers.iter().map(|r| netlist.signal(r.output).path.as_str()).collect();
    assert_eq!(registers, ["tens.digit_q", "units.digit_q"]);
}

#[test]
fn ring_agrees_with_the_simulator() {
    let mut block = Ring::default();
    block.clock.connect();
    block.step.connect();
    block.forward.connect();
    block.connect_all();
    let mut machine = Machine::new(flat(&Ring::default()));
    let mut seed = 0x9e37_79b9_7f4a_7c15;
    for clock in 0..2000 {
        let word = random(&mut seed);
        block.step.next = word & 1 == 1;
        block.forward.next = word & 2 == 2;
        machine.set("step", word & 1);
        machine.set("forward", word >> 1 & 1);
        for level in [false, true] {
            block.clock.next = level.into();
            assert!(simulate(&mut block, 20));
        }
        machine.clock();
        let expected = [block.phase_a.val(), block.phase_b.val(), block.phase_c.val()];
        let found = ["phase_a", "phase_b", "phase_c"].map(|phase| machine.get(phase) == 1);
        assert_eq!(found, expected, "clock {clock}");
    }
}

#[test]
fn nested_decades_agree_with_the_simulator() {
    let mut block = Nested::default();
    block.clock.connect();
    block.pulse.connect();
    block.clear.connect();
    block.connect_all();
    let mut machine = Machine::new(flat(&Nested::default()));
    let mut seed = 1;
    let mut highest = 0;
    for clock in 0..5000 {
        let word = random(&mut seed);
        let (pulse, clear) = (word & 7 != 0, word.is_multiple_of(101));
        block.pulse.next = pulse;
        block.clear.next = clear;
        machine.set("pulse", pulse.into());
        machine.set("clear", clear.into());
        for level in [false, true] {
            block.clock.next = level.into();
            assert!(simulate(&mut block, 20));
        }
        machine.clock();
        assert_eq!(machine.get("value"), block.value.val().to_u64(), "clock {clock}");
        highest = highest.max(machine.get("value"));
    }
    assert_eq!(highest, 0x99, "both digits were driven through their range");
}
