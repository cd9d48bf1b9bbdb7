//! Which flip-flops of a module are a synchroniser: tools have to leave these as they are.

use helixlock_netlist::{Expression, Module, Node, PortKind, SignalId, Statement};

/// Outputs of the flip-flops that take an input port as it is for one other flip-flop alone, which
/// takes it as it is, and of that other.
pub(crate) fn synchronisers(module: &Module) -> Vec<SignalId> {
    let inputs = module.ports.iter().filter_map(|port| match port.kind {
        PortKind::Input(id) => Some(id),
        _ => None,
    });
    let mut found = vec![];
    for pin in inputs {
        for first in followers(module, pin) {
            if let ([second], true) = (&followers(module, first)[..], is_read_once(module, first)) {
                found.extend([first, *second]);
            }
        }
    }
    found
}

/// Outputs of the flip-flops that take the signal as it is.
fn followers(module: &Module, signal: SignalId) -> Vec<SignalId> {
    let takes = |input: SignalId| {
        module.body.iter().any(|statement| match statement {
            Statement::Assign { target, value } => *target == input && is(value, signal),
            _ => false,
        })
    };
    let followers = module.registers.iter().filter(|register| takes(register.input));
    followers.map(|register| register.output).collect()
}

fn is(value: &Expression, signal: SignalId) -> bool {
    matches!(value.node, Node::Signal(id) if id == signal)
}

fn is_read_once(module: &Module, signal: SignalId) -> bool {
    let mut reads = 0;
    for statement in &module.body {
        crate::groups::for_each_expression(statement, &mut |value| {
            value.for_each_signal(&mut |read| reads += u32::from(read == signal));
        });
    }
    reads == 1
}
