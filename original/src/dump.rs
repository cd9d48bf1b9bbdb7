//! Waveforms of every wire as a value change dump.

use std::io::{self, Write};

use vcd::{IdCode, SimulationCommand, TimescaleUnit, Value, VarType, Writer};

use crate::circuit::Circuit;
use crate::simulator::Edge;

/// Writes `edges`, those of all wires since power-up, in the order of time.
///
/// `initial` are the levels at power-up, in the order of [`Circuit::nets`].
///
/// # Errors
///
/// When `out` does not take it.
pub fn dump(
    out: impl Write,
    circuit: &Circuit,
    initial: &[bool],
    edges: &[Edge],
) -> io::Result<()> {
    let mut dump = Writer::new(out);
    dump.timescale(1, TimescaleUnit::PS)?;
    dump.add_module(&circuit.name)?;
    let mut codes: Vec<IdCode> = Vec::new();
    for net in &circuit.nets {
        codes.push(dump.add_var(VarType::Wire, 1, net, None)?);
    }
    dump.upscope()?;
    dump.enddefinitions()?;
    dump.timestamp(0)?;
    dump.begin(SimulationCommand::Dumpvars)?;
    for (code, level) in codes.iter().zip(initial) {
        dump.change_scalar(*code, Value::from(*level))?;
    }
    dump.end()?;
    let mut now_ps = 0;
    for edge in edges {
        if edge.time_ps != now_ps {
            now_ps = edge.time_ps;
            dump.timestamp(now_ps)?;
        }
        dump.change_scalar(codes[edge.net.0], Value::from(edge.level))?;
    }
    Ok(())
}
