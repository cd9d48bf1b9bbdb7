//! The same circuit as structural Verilog: one instance a part, its delays as parameters.
//!
//! Changes fall on whole picoseconds; parts look at their inputs half a picosecond later, when
//! everything that is due has changed. So another simulator, whatever its order within an instant,
//! gets the same edges.

use std::fmt::Write;

use crate::circuit::{Circuit, Element, Function, Net};
use crate::delays::Delays;

/// The parts, as modules.
const CELLS: &str = include_str!("cells.v");

/// The circuit as a module, and the modules of its parts.
///
/// `levels` are those at power-up, as [`Simulator::levels`](crate::Simulator::levels) has them.
#[must_use]
pub fn verilog(circuit: &Circuit, delays: &Delays, levels: &[bool]) -> String {
    let mut text = String::from(CELLS);
    let pins_in = circuit.inputs.iter().map(|(net, _)| format!("input {}", circuit.nets[net.0]));
    let pins_out = circuit.outputs.iter().map(|(name, _)| format!("output {name}"));
    let pins: Vec<_> = pins_in.chain(pins_out).collect();
    put(&mut text, format_args!("\nmodule {} (\n  {}\n);\n", circuit.name, pins.join(",\n  ")));
    text.push_str("  wire low = 1'b0;\n  wire high = 1'b1;\n");
    for element in &circuit.elements {
        for net in element.outputs.iter().filter(|net| !is_pin(circuit, **net)) {
            put(&mut text, format_args!("  wire {};\n", circuit.nets[net.0]));
        }
    }
    let mut edges = delays.0.iter();
    for element in &circuit.elements {
        let edges: Vec<_> = edges.by_ref().take(element.outputs.len()).copied().collect();
        text.push_str(&instance(circuit, element, &edges, levels));
    }
    for (name, net) in circuit.outputs.iter().filter(|(name, net)| *name != circuit.nets[net.0]) {
        put(&mut text, format_args!("  assign {name} = {};\n", circuit.nets[net.0]));
    }
    text.push_str("endmodule\n");
    text
}

fn instance(circuit: &Circuit, element: &Element, edges: &[[u64; 2]], levels: &[bool]) -> String {
    let name = |net: &Net| circuit.nets[net.0].as_str();
    let joined = |nets: &[Net]| nets.iter().map(name).collect::<Vec<_>>().join(", ");
    let first = format!(".RISE({}), .FALL({})", edges[0][0], edges[0][1]);
    let (label, inputs) = (&element.name, &element.inputs);
    let output = name(&element.outputs[0]);
    if let Function::FlipFlop { j } = element.function {
        let (j, k) = inputs[3..].split_at(j);
        let [clock, preset, clear] = [0, 1, 2].map(|place| name(&inputs[place]));
        return format!(
            "  // {}\n  original_jk #(.J({}), .K({}), {first}, .RISE_BAR({}), .FALL_BAR({}), \
             .INIT(1'b{}), .CLOCK(1'b{})) part_{label} (\n    .q({output}), .q_bar({}), .clock({clock}), \
             .preset({preset}), .clear({clear}), .j({{{}}}), .k({{{}}}));\n",
            element.part,
            j.len(),
            k.len(),
            edges[1][0],
            edges[1][1],
            u8::from(levels[element.outputs[0].0]),
            u8::from(levels[inputs[0].0]),
            name(&element.outputs[1]),
            joined(j),
            joined(k),
        );
    }
    let module = match element.function {
        Function::And => "and",
        Function::Nand => "nand",
        Function::Or => "or",
        Function::Nor => "nor",
        Function::AndOrInvert => "and_or_invert",
        Function::Delay | Function::FlipFlop { .. } => "delay",
    };
    format!(
        "  // {}\n  original_{module} #(.N({}), {first}) part_{label} (.y({output}), .a({{{}}}));\n",
        element.part,
        inputs.len(),
        joined(inputs),
    )
}

fn is_pin(circuit: &Circuit, net: Net) -> bool {
    circuit.outputs.iter().any(|(name, pin)| *pin == net && *name == circuit.nets[net.0])
}

pub(crate) fn put(text: &mut String, words: std::fmt::Arguments) {
    text.write_fmt(words).expect("text takes text");
}
