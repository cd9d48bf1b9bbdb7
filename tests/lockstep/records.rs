//! Values packed into bytes, lowest bit first, as every simulator writes them.

use helixlock_evidence::prove::consequence::worth;
use helixlock_netlist::{Netlist, SignalId};
use helixlock_sim::Engine;

/// Where each value lies in a record.
pub(crate) struct Layout {
    inputs: Vec<u32>,
    /// Registers, then outputs.
    answers: Vec<(SignalId, u32)>,
}

impl Layout {
    pub(crate) fn of(netlist: &Netlist) -> Self {
        let width = |id: SignalId| netlist.signal(id).width;
        let registers = netlist.registers.iter().map(|register| register.output);
        let answers = registers.chain(netlist.outputs.iter().copied());
        Self {
            inputs: netlist.inputs.iter().map(|&id| width(id)).collect(),
            answers: answers.map(|id| (id, width(id))).collect(),
        }
    }

    pub(crate) fn input_widths(&self) -> &[u32] {
        &self.inputs
    }

    /// Signals of an answer with their widths, from the lowest bit.
    pub(crate) fn answers(&self) -> &[(SignalId, u32)] {
        &self.answers
    }

    pub(crate) fn input_bytes(&self) -> usize {
        bytes(self.inputs.iter().sum())
    }

    pub(crate) fn answer_bytes(&self) -> usize {
        bytes(self.answers.iter().map(|(_, width)| width).sum())
    }

    pub(crate) fn pack_inputs(&self, values: &[u64]) -> Vec<u8> {
        pack(self.inputs.iter().copied().zip(values.iter().copied()))
    }
}

fn bytes(bits: u32) -> usize {
    bits.div_ceil(8) as usize
}

fn pack(values: impl Iterator<Item = (u32, u64)>) -> Vec<u8> {
    let mut packed = vec![];
    let (mut held, mut bits) = (0_u128, 0);
    for (width, value) in values {
        held |= u128::from(value) << bits;
        bits += width;
        while bits >= 8 {
            packed.push(held.to_le_bytes()[0]);
            held >>= 8;
            bits -= 8;
        }
    }
    if bits > 0 {
        packed.push(held.to_le_bytes()[0]);
    }
    packed
}

/// The engine's answer to one clock with these inputs.
pub(crate) fn expected(
    engine: &mut impl Engine,
    layout: &Layout,
    netlist: &Netlist,
    inputs: &[u64],
) -> Vec<u8> {
    for (&input, &value) in netlist.inputs.iter().zip(inputs) {
        engine.set_input(input, value);
    }
    engine.step();
    pack(layout.answers.iter().map(|&(id, width)| (width, engine.value(id))))
}

/// The first clock and the signals in which answers differ, with what each is worth at the table.
pub(crate) fn report(
    layout: &Layout,
    netlist: &Netlist,
    before: u64,
    expected: &[u8],
    found: &[u8],
) -> String {
    let size = layout.answer_bytes();
    let records = expected.chunks(size).zip(found.chunks(size)).enumerate();
    for (clock, (expected, found)) in records {
        if expected == found {
            continue;
        }
        let clock = before + clock as u64 + 1;
        let mut lines = vec![format!("first difference after clock {clock}:")];
        let mut low = 0;
        for &(id, width) in &layout.answers {
            let [ours, theirs] = [expected, found].map(|record| value(record, low, width));
            if ours != theirs {
                let path = &netlist.signal(id).path;
                let worth = worth(path);
                lines.push(format!("  {path}: engine {ours:#x}, Verilog {theirs:#x}: {worth}"));
            }
            low += width;
        }
        return lines.join("\n");
    }
    format!("the Verilog answered {} bytes, expected {}", found.len(), expected.len())
}

fn value(record: &[u8], low: u32, width: u32) -> u64 {
    (0..width).fold(0, |value, bit| {
        let at = (low + bit) as usize;
        value | u64::from(record[at / 8] >> (at % 8) & 1) << bit
    })
}
