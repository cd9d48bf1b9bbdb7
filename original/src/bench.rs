//! A bench in Verilog that plays changes to a circuit and writes the edges of every wire.

use crate::circuit::{Circuit, Net};
use crate::delays::Delays;
use crate::pulses::Change;
use crate::verilog::put;

/// A bench for [`verilog()`](crate::verilog()), and what it plays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bench {
    /// Its Verilog. It reads `stimuli.hex` and writes `edges.vcd`, in the folder it runs in.
    pub text: String,
    /// The text of `stimuli.hex`.
    pub stimuli: String,
    /// When the changes and the waveform begin, ps.
    pub begins_ps: u64,
}

/// Shortest pause between gates at rest and the first change, ps.
const PAUSE_PS: u64 = 1_000;

/// A bench that plays `changes` and ends so many picoseconds after the last of them.
///
/// Gates of Verilog wake up undefined, and a pair of NAND gates would stay so: until all are at
/// rest, their outputs are held at `levels`, those at power-up.
#[must_use]
pub fn bench(
    circuit: &Circuit,
    delays: &Delays,
    levels: &[bool],
    changes: &[Change],
    tail_ps: u64,
) -> Bench {
    let longest_ps = delays.0.iter().flatten().max().copied().unwrap_or(0);
    let begins_ps = longest_ps + PAUSE_PS;
    let driven: Vec<Net> =
        circuit.elements.iter().flat_map(|element| &element.outputs).copied().collect();
    let mut text = pins(circuit, changes.len());
    for net in &driven {
        let (name, level) = (&circuit.nets[net.0], u8::from(levels[net.0]));
        put(&mut text, format_args!("    force device.{name} = 1'b{level};\n"));
    }
    put(&mut text, format_args!("    #{begins_ps};\n"));
    for net in &driven {
        put(&mut text, format_args!("    release device.{};\n", circuit.nets[net.0]));
    }
    put(&mut text, format_args!(include_str!("play.v"), changes.len(), tail_ps));
    Bench { text, stimuli: stimuli(changes), begins_ps }
}

/// The device at its pins, with their levels at power-up.
fn pins(circuit: &Circuit, changes: usize) -> String {
    let name = &circuit.name;
    let last = circuit.inputs.iter().map(|(net, _)| net.0).max().unwrap_or(0);
    let joined: Vec<_> = circuit
        .inputs
        .iter()
        .map(|(net, _)| format!(".{}(pins[{}])", circuit.nets[net.0], net.0))
        .collect();
    let mut text = format!(
        "`timescale 1ps/100fs\nmodule bench;\n  reg [63:0] stimuli [0:{}], change;\n  \
         reg [{last}:0] pins;\n  integer number;\n  {name} device ({});\n  initial begin\n",
        changes.saturating_sub(1),
        joined.join(", "),
    );
    for (net, level) in &circuit.inputs {
        put(&mut text, format_args!("    pins[{}] = 1'b{};\n", net.0, u8::from(*level)));
    }
    text
}

/// A line a change, one number of 64 bits: 48 for the time since the one before, ps, 15 for the
/// number of the net, and the level.
fn stimuli(changes: &[Change]) -> String {
    let mut text = String::new();
    let mut before_ps = 0;
    for (time_ps, pin, level) in changes {
        put(&mut text, format_args!("{:012x}", time_ps - before_ps));
        put(&mut text, format_args!("{:04x}\n", pin.0 << 1 | usize::from(*level)));
        before_ps = *time_ps;
    }
    text
}
