//! Which bits of a module nothing reads.

use helixlock_netlist::{Expression, Module, Node, PortKind, Role, SignalId, mask};

use crate::groups::for_each_expression;

/// For each signal of the module, the bits that somebody reads.
pub(crate) fn bits_read(module: &Module) -> Vec<u64> {
    let mut read = vec![0; module.signals.len()];
    let mut mark = |id: SignalId, bits: u64| read[id.0 as usize] |= bits;
    for statement in &module.body {
        for_each_expression(statement, &mut |e| mark_expression(e, &mut mark));
    }
    for port in &module.ports {
        if let PortKind::Output(id) = port.kind {
            mark(id, u64::MAX);
        }
    }
    for register in &module.registers {
        mark(register.input, u64::MAX);
    }
    if let Some(memory) = module.memory {
        for id in [memory.address, memory.write, memory.sample] {
            mark(id, u64::MAX);
        }
    }
    for instance in &module.instances {
        for &id in &instance.connections {
            if module.signal(id).role == Role::InstanceInput {
                mark(id, u64::MAX);
            }
        }
    }
    read
}

fn mark_expression(e: &Expression, mark: &mut impl FnMut(SignalId, u64)) {
    match &e.node {
        Node::Signal(id) => mark(*id, mask(e.width)),
        Node::Slice { of, low } if matches!(of.node, Node::Signal(_)) => {
            if let Node::Signal(id) = of.node {
                mark(id, mask(e.width) << low);
            }
        }
        _ => e.operands().into_iter().for_each(|operand| mark_expression(operand, mark)),
    }
}

/// Verilog texts of the bits without a reader: `carry`, `value[3:1]`.
pub(crate) fn unused(module: &Module) -> Vec<String> {
    let read = bits_read(module);
    let mut texts = vec![];
    for (signal, read) in module.signals.iter().zip(read) {
        let left = mask(signal.width) & !read;
        if matches!(signal.role, Role::Constant(_)) || left == 0 {
            continue;
        }
        if left == mask(signal.width) {
            texts.push(signal.name.clone());
            continue;
        }
        texts.extend(runs(left).map(|(high, low)| {
            let bits = if high == low { high.to_string() } else { format!("{high}:{low}") };
            format!("{}[{bits}]", signal.name)
        }));
    }
    texts
}

/// Runs of ones as (highest, lowest) bit, from the top.
fn runs(bits: u64) -> impl Iterator<Item = (u32, u32)> {
    let mut left = bits;
    std::iter::from_fn(move || {
        let high = left.checked_ilog2()?;
        let ones = (left << (63 - high)).leading_ones();
        let low = high + 1 - ones;
        left &= mask(64).checked_shr(64 - low).unwrap_or(0);
        Some((high, low))
    })
}
