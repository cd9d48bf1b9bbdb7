//! Our engines, Verilator and Icarus run the same clocks: every flip-flop and every output is equal
//! after each of them.
//!
//! A simulator of the emitted Verilog reads packed inputs, one record a clock, and answers with
//! the packed flip-flops (in the order of the netlist's registers) and outputs (in port order).

mod icarus;
mod post_synthesis;
mod records;
pub(crate) mod stimulus;
mod verilator;

use std::sync::LazyLock;

use expect_test::expect;
use helixlock_netlist::Netlist;
use helixlock_sim::{Engine, Interpreter, device, device_engine, stepped_device};

use crate::golden_verilog::{device_design, whole_design};
use records::{Layout, expected, report};
use stimulus::{Stimulus, dense, realistic};
use verilator::Program;

/// Clocks that Verilator and the engine run side by side; `HELIXLOCK_LOCKSTEP_CLOCKS` overrides.
const CLOCKS: u64 = 1_000_000;

/// Records after which a simulator hands over its answers.
const BATCH: usize = 4096;

fn clocks() -> u64 {
    let set = std::env::var("HELIXLOCK_LOCKSTEP_CLOCKS").ok();
    set.map_or(CLOCKS, |set| set.parse().expect("a number of clocks"))
}

/// The device, compiled by Verilator once.
fn device_program() -> &'static Program {
    static DEVICE: LazyLock<Program> =
        LazyLock::new(|| Program::of(&device_design(), device().netlist()));
    &DEVICE
}

/// Verilator and an engine, clock by clock.
fn compare(program: &Program, engine: &mut impl Engine, mut stimulus: Stimulus, clocks: u64) {
    let netlist = engine.netlist().clone();
    let layout = Layout::of(&netlist);
    let mut verilator = program.start();
    let mut inputs = vec![0; netlist.inputs.len()];
    let mut done = 0;
    while done < clocks {
        let mut asked = vec![];
        let mut answers = vec![];
        for _ in 0..BATCH {
            stimulus.next(&mut inputs);
            asked.extend(layout.pack_inputs(&inputs));
            answers.extend(expected(engine, &layout, &netlist, &inputs));
        }
        let found = verilator.run(&asked, answers.len());
        assert!(found == answers, "{}", report(&layout, &netlist, done, &answers, &found));
        done += BATCH as u64;
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn verilator_agrees_with_the_compiled_engine_on_noise() {
    compare(device_program(), &mut stepped_device(), dense(device().netlist(), 1), clocks());
}

#[test]
fn verilator_agrees_with_the_compiled_engine_on_a_pass() {
    compare(device_program(), &mut stepped_device(), realistic(device().netlist(), 2), clocks());
}

#[test]
fn verilator_agrees_with_the_leaping_engine() {
    for stimulus in [realistic(device().netlist(), 3), dense(device().netlist(), 4)] {
        compare(device_program(), &mut device_engine(), stimulus, clocks() / 10);
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn verilator_agrees_with_the_interpreter_on_the_board() {
    let design = whole_design();
    let netlist = Netlist::new(&design).unwrap();
    let program = Program::of(&design, &netlist);
    compare(&program, &mut Interpreter::new(&netlist), realistic(&netlist, 5), clocks() / 20);
}

/// Inputs of 20 000 clocks for Icarus, and what the compiled engine answers.
fn stepped(netlist: &Netlist, layout: &Layout, mut stimulus: Stimulus) -> (Vec<Vec<u8>>, Vec<u8>) {
    let mut engine = stepped_device();
    let mut inputs = vec![0; netlist.inputs.len()];
    let (mut asked, mut answers) = (vec![], vec![]);
    for _ in 0..20_000 {
        stimulus.next(&mut inputs);
        asked.push(layout.pack_inputs(&inputs));
        answers.extend(expected(&mut engine, layout, netlist, &inputs));
    }
    (asked, answers)
}

#[test]
fn icarus_agrees_with_the_compiled_engine() {
    let netlist = device().netlist();
    let layout = Layout::of(netlist);
    for stimulus in [dense(netlist, 6), realistic(netlist, 7)] {
        let (asked, answers) = stepped(netlist, &layout, stimulus);
        let found = icarus::run(&device_design(), netlist, &layout, &asked);
        assert!(found == answers, "{}", report(&layout, netlist, 0, &answers, &found));
    }
}

/// A fault in the Verilog is found, and its first clock and signals are said with what they are
/// worth: here the discriminator takes narrower for wider.
#[test]
fn a_divergence_says_what_it_is_worth() {
    let (design, netlist) = (device_design(), device().netlist());
    let mut modules = helixlock_gen::verilog(&design).expect("legal names");
    let (_, text) = modules
        .iter_mut()
        .find(|(name, _)| name == "direction_discriminator")
        .expect("the device decides");
    let sound = text.clone();
    *text = text.replacen("= 1'b1;", "= 1'b0;", 1);
    assert_ne!(*text, sound);
    let layout = Layout::of(netlist);
    let (asked, answers) = stepped(netlist, &layout, realistic(netlist, 7));
    let found = icarus::run_modules(&modules, &design, netlist, &layout, &asked);
    let said = report(&layout, netlist, 0, &answers, &found);
    expect![[r"
        first difference after clock 977:
          discriminator.jk_q: engine 0x1, Verilog 0x0: until the next decision the motor goes 0.316 µm the other way
          q: engine 0x1, Verilog 0x0: until the next decision the motor goes 0.316 µm the other way
          q_bar: engine 0x0, Verilog 0x1: until the next decision the motor goes 0.316 µm the other way
          forward: engine 0x1, Verilog 0x0: a step is 0.0125 µm
          reverse: engine 0x0, Verilog 0x1: a step is 0.0125 µm"]]
    .assert_eq(&said);
}
