//! The kernel that takes every clock: all registers at once, no question asked.

use std::fmt::Write as _;

use super::words::Words;
use crate::drivers::{Driver, Drivers};
use crate::{Netlist, SignalId};

/// `impl DenseKernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let (inputs, registers) = (netlist.inputs.len(), netlist.registers.len());
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl DenseKernel for {name} {{
    type Inputs = [u64; {inputs}];
    type Registers = [u64; {registers}];
    const INPUTS: Self::Inputs = [0; {inputs}];
    const REGISTERS: Self::Registers = {initial:?};

    #[inline(always)]
    fn step(inputs: &Self::Inputs, registers: &Self::Registers, next: &mut Self::Registers) {{
{step}    }}

    #[inline(always)]
    fn outputs(inputs: &Self::Inputs, registers: &Self::Registers, values: &mut [u64]) {{
{outputs}    }}
}}

",
        initial = netlist.registers.iter().map(|register| register.initial).collect::<Vec<_>>(),
        step = indented(&step(netlist)),
        outputs = indented(&outputs(netlist)),
    );
    source
}

/// Each register is written as soon as its next value is known: that value need not be kept.
fn step(netlist: &Netlist) -> Vec<String> {
    let mut words = Words::new(netlist);
    place_sources(&mut words, netlist, netlist.registers.iter().map(|register| register.input));
    for (index, register) in netlist.registers.iter().enumerate() {
        let word = words.signal(register.input);
        words.lines.push(format!("next[{index}] = {word};"));
    }
    words.lines
}

fn outputs(netlist: &Netlist) -> Vec<String> {
    let mut words = Words::new(netlist);
    place_sources(&mut words, netlist, netlist.outputs.iter().copied());
    let values: Vec<String> = netlist.outputs.iter().map(|output| words.signal(*output)).collect();
    let mut lines = words.lines;
    let stores = values.iter().enumerate();
    lines.extend(stores.map(|(index, word)| format!("values[{index}] = {word};")));
    lines
}

/// Places the inputs and registers that `roots` depend on, and no others.
fn place_sources(words: &mut Words, netlist: &Netlist, roots: impl Iterator<Item = SignalId>) {
    let drivers = Drivers::new(netlist);
    for end in drivers.ends(roots, |_| false) {
        match drivers.of(end) {
            Driver::Input(index) => words.place(end, &format!("inputs[{index}]")),
            Driver::Register(index) => words.place(end, &format!("registers[{index}]")),
            Driver::Assignment(_) | Driver::Nothing => {}
        }
    }
}

/// Lines of a function body.
pub(super) fn indented(lines: &[String]) -> String {
    lines.iter().flat_map(|line| ["        ", line, "\n"]).collect()
}
