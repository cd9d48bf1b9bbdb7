//! Every state with every input: the engine's next state and outputs are the Verilog's.
//!
//! Where registers and inputs of a block are few enough, nothing is drawn: the engine and Icarus are
//! put into each state in turn, legal or not, with each level of the inputs, and take one clock.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use anyhow::Context;
use bitvec::field::BitField;
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_sim::{Engine, Interpreter};

use super::lockstep::{Port, bits, declare, names, ports};
use super::sources::Sources;
use super::synthesis::blocks;
use crate::tools::{run, write_scratch};

/// More transitions than this are left to drawn histories, and to the proofs.
const MOST: u64 = 1 << 22;

/// What became of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It has too many states.
    TooMany,
    /// So many transitions were alike.
    Alike(u64),
    /// The first that was not.
    Differs(String),
}

/// A block with all its states and inputs.
struct Space {
    netlist: Netlist,
    registers: Vec<Port>,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    /// Values of each register, then of each input.
    axes: Vec<Vec<u64>>,
}

/// Tries every state with every input, unless there are too many.
///
/// A decade that is one of several counts as its ten digits, and so do the wheels it is compared
/// with, when all sixteen would be too many.
///
/// # Errors
///
/// When there is no such block, or Icarus cannot be started.
pub fn exhaustively(sources: &Sources, block: &str) -> anyhow::Result<Outcome> {
    let mut space = Space::of(block)?;
    if space.transitions() > MOST {
        space.keep_to_decimals();
    }
    let transitions = space.transitions();
    if transitions > MOST {
        return Ok(Outcome::TooMany);
    }
    let folder = tempfile::tempdir()?;
    let (bench, program) = (folder.path().join("bench.v"), folder.path().join("bench.vvp"));
    let table = folder.path().join("table.txt");
    write_scratch(&table, &space.table())?;
    write_scratch(&bench, &space.test_bench(block, transitions, &table))?;
    let mut compile = Command::new("iverilog");
    compile.args(["-g2005", "-o"]).arg(&program).arg("-y").arg(&sources.verilog).arg(&bench);
    let (content, said) = run(&mut compile, "iverilog")?;
    if !content {
        return Ok(Outcome::Differs(said));
    }
    let (_, said) = run(Command::new("vvp").arg("-n").arg(&program), "iverilog")?;
    Ok(match said.lines().find(|line| line.starts_with("DIFFERS")) {
        Some(line) => Outcome::Differs(line.to_owned()),
        None if said.contains("ALIKE") => Outcome::Alike(transitions),
        None => Outcome::Differs(said),
    })
}

impl Space {
    fn of(block: &str) -> anyhow::Result<Self> {
        let card = blocks().find(|card| card.name == block).context("a block of the list")?;
        let netlist = Netlist::new(&elaborate(block, &*(card.build)(), &Library::new())?)?;
        let registers: Vec<_> = netlist.registers.iter().map(|register| register.output).collect();
        let registers = ports(&netlist, &registers);
        let inputs = ports(&netlist, &netlist.inputs);
        let outputs = ports(&netlist, &netlist.outputs);
        // Wider than the whole space may be: left as one value, which makes it too large.
        let all =
            |port: &Port| if port.width < 23 { (0..1 << port.width).collect() } else { vec![] };
        let axes = registers.iter().chain(&inputs).map(all).collect();
        Ok(Self { netlist, registers, inputs, outputs, axes })
    }

    /// States times inputs.
    fn transitions(&self) -> u64 {
        let lengths = self.axes.iter().map(|axis| axis.len() as u64);
        lengths.fold(1, |product, length| match length {
            0 => u64::MAX,
            _ => product.saturating_mul(length),
        })
    }

    fn keep_to_decimals(&mut self) {
        for (port, axis) in self.registers.iter().chain(&self.inputs).zip(&mut self.axes) {
            if port.name.ends_with("state_q") || port.name == "preset" {
                axis.retain(|value| {
                    (0..port.width / 4).all(|digit| value >> (4 * digit) & 15 < 10)
                });
            }
        }
    }

    /// A transition a line: state and inputs, then outputs and the next state, by the engine.
    fn table(&self) -> String {
        let mut engine = Interpreter::new(&self.netlist);
        let mut snapshot = engine.snapshot();
        let mut chosen = vec![0; self.axes.len()];
        let mut text = String::new();
        loop {
            let value = |axis: usize| self.axes[axis][chosen[axis]];
            let mut low = 0;
            for (axis, register) in self.registers.iter().enumerate() {
                let high = low + register.width as usize;
                snapshot.flip_flops[low..high].store_le(value(axis));
                low = high;
            }
            engine.restore(&snapshot);
            for (axis, input) in (self.registers.len()..).zip(&self.inputs) {
                engine.set_input(input.id, value(axis));
            }
            let given = self.registers.iter().chain(&self.inputs).chain(&self.outputs);
            given.for_each(|port| put(&mut text, port, engine.value(port.id)));
            engine.step();
            self.registers.iter().for_each(|port| put(&mut text, port, engine.value(port.id)));
            text.push('\n');
            if !self.advance(&mut chosen) {
                return text;
            }
        }
    }

    /// The next combination; false when there is none.
    fn advance(&self, chosen: &mut [usize]) -> bool {
        for (place, axis) in chosen.iter_mut().zip(&self.axes) {
            *place += 1;
            if *place < axis.len() {
                return true;
            }
            *place = 0;
        }
        false
    }

    fn test_bench(&self, block: &str, transitions: u64, table: &Path) -> String {
        let (ins, outs) = (names(&self.inputs), names(&self.outputs));
        let state: Vec<_> =
            self.registers.iter().map(|port| format!("dut.{}", port.name)).collect();
        let state = state.join(", ");
        let pins = self.inputs.iter().chain(&self.outputs);
        let pins: Vec<_> = pins.map(|port| format!(", .{0}({0})", port.name)).collect();
        let pins = pins.concat();
        let (state_bits, out_bits) = (bits(&self.registers), bits(&self.outputs));
        let width = 2 * state_bits + bits(&self.inputs) + out_bits;
        [
            "module bench;".to_owned(),
            declare("reg", &self.inputs),
            declare("wire", &self.outputs),
            format!("reg clock; {block} dut(.clock(clock){pins});"),
            format!("reg [{}:0] table_of [1:{transitions}];", width - 1),
            format!("reg [{}:0] before, after; reg [{}:0] shown;", state_bits - 1, out_bits - 1),
            "integer i;".to_owned(),
            format!("initial begin $readmemb(\"{}\", table_of); clock = 0;", table.display()),
            format!("for (i = 1; i <= {transitions}; i = i + 1) begin"),
            format!("{{before, {ins}, shown, after}} = table_of[i]; {{{state}}} = before; #1"),
            format!("if ({{{outs}}} !== shown) begin"),
            format!("$display(\"DIFFERS in state %b: outputs %b, engine %b\", before, {{{outs}}}, shown);"),
            "$finish; end clock = 1; #1 clock = 0; #1".to_owned(),
            format!("if ({{{state}}} !== after) begin"),
            format!("$display(\"DIFFERS after state %b: %b, engine %b\", before, {{{state}}}, after);"),
            "$finish; end end $display(\"ALIKE\"); end endmodule".to_owned(),
        ]
        .join("\n")
    }
}

fn put(text: &mut String, port: &Port, value: u64) {
    // Writing to a string cannot fail.
    let _ = write!(text, "{value:0width$b}", width = port.width as usize);
}
