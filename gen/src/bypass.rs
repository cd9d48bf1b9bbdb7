//! A block taken out of the top of a design, as if its wires had never led through it.

use std::collections::BTreeMap;
use std::convert::Infallible;

use helixlock_netlist::{Design, Expression, Module, Node, PortKind, SignalId, Statement};

use crate::GenError;
use crate::groups::for_each_expression;

/// Takes the block of that name from the top. What read one of its outputs reads, by `ways`, what
/// drove one of its inputs: an output and that input each.
///
/// # Errors
///
/// [`GenError::NoBlock`] when the top has no such block, [`GenError::NoWay`] when something reads an
/// output that no way stands for, or a way does not lead through the block.
pub fn bypass(design: &mut Design, block: &str, ways: &[(&str, &str)]) -> Result<(), GenError> {
    let missing = || GenError::NoBlock { block: block.to_owned() };
    let top = design.top();
    let instance = top.instances.iter().find(|instance| instance.name == block);
    let instance = instance.ok_or_else(missing)?.clone();
    let ports = design.modules[instance.module].ports.iter();
    let ports = ports.filter(|port| port.kind != PortKind::Clock);
    let wires: BTreeMap<&str, SignalId> =
        ports.map(|port| port.name.as_str()).zip(instance.connections.iter().copied()).collect();

    let mut passed = BTreeMap::new();
    for (output, input) in ways {
        let no_way = || GenError::NoWay { block: block.to_owned(), output: (*output).to_owned() };
        let driver = wires.get(input).and_then(|wire| driver(top, *wire)).ok_or_else(no_way)?;
        passed.insert(*wires.get(output).ok_or_else(no_way)?, driver.clone());
    }
    let gone = &instance.connections;
    let drives = |statement: &Statement| match statement {
        Statement::Assign { target, .. } => gone.contains(target),
        _ => false,
    };
    let mut slim = top.clone();
    slim.body.retain(|statement| !drives(statement));
    slim.instances.retain(|other| other.name != block);
    for statement in &mut slim.body {
        *statement = with_signals(statement, &|id, width| {
            passed.get(&id).cloned().unwrap_or(Expression::signal(width, id))
        });
    }
    if let Some((name, _)) = wires.iter().find(|(_, wire)| is_read(&slim, **wire)) {
        return Err(GenError::NoWay { block: block.to_owned(), output: (*name).to_owned() });
    }
    forget(&mut slim, gone);
    if let Some(top) = design.modules.last_mut() {
        *top = slim;
    }
    drop_unused(design);
    Ok(())
}

/// True when something in the body reads the signal.
pub(crate) fn is_read(module: &Module, signal: SignalId) -> bool {
    let mut found = false;
    for statement in &module.body {
        for_each_expression(statement, &mut |value| {
            value.for_each_signal(&mut |read| found |= read == signal);
        });
    }
    found
}

/// Takes signals away that nothing reads or drives any more.
pub(crate) fn forget(module: &mut Module, gone: &[SignalId]) {
    let mut places = vec![SignalId(u32::MAX); module.signals.len()];
    let kept = (0..).map(SignalId).take(module.signals.len()).filter(|id| !gone.contains(id));
    for (place, id) in (0..).zip(kept) {
        places[id.0 as usize] = SignalId(place);
    }
    let now = |id: SignalId| places[id.0 as usize];
    let mut ids = (0..).map(SignalId);
    module.signals.retain(|_| ids.next().is_some_and(|id| !gone.contains(&id)));
    for port in &mut module.ports {
        if let PortKind::Input(id) | PortKind::Output(id) = &mut port.kind {
            *id = now(*id);
        }
    }
    for register in &mut module.registers {
        (register.input, register.output) = (now(register.input), now(register.output));
    }
    for id in module.instances.iter_mut().flat_map(|instance| &mut instance.connections) {
        *id = now(*id);
    }
    for statement in &mut module.body {
        *statement = with_signals(statement, &|id, width| Expression::signal(width, now(id)));
        retarget(statement, &now);
    }
}

/// The value of an input of a block inside, where one plain statement gives it.
fn driver(module: &Module, wire: SignalId) -> Option<&Expression> {
    module.body.iter().find_map(|statement| match statement {
        Statement::Assign { target, value } if *target == wire => Some(value),
        _ => None,
    })
}

/// The statement with other expressions in the place of signals, of a width each.
pub(crate) fn with_signals(
    statement: &Statement,
    replace: &impl Fn(SignalId, u32) -> Expression,
) -> Statement {
    let all = |body: &[Statement]| body.iter().map(|one| with_signals(one, replace)).collect();
    let value_of = |value: &Expression| replaced(value, replace);
    match statement {
        Statement::Assign { target, value } => {
            Statement::Assign { target: *target, value: value_of(value) }
        }
        Statement::If { condition, then, otherwise } => Statement::If {
            condition: value_of(condition),
            then: all(then),
            otherwise: all(otherwise),
        },
        Statement::Case { of, arms, default } => Statement::Case {
            of: value_of(of),
            arms: arms.iter().map(|(value, body)| (*value, all(body))).collect(),
            default: all(default),
        },
    }
}

fn replaced(value: &Expression, replace: &impl Fn(SignalId, u32) -> Expression) -> Expression {
    let mut widths = BTreeMap::new();
    note_widths(value, &mut widths);
    let Ok(replaced) = value.substitute(&mut |id| Ok::<_, Infallible>(replace(id, widths[&id])));
    replaced
}

fn note_widths(value: &Expression, widths: &mut BTreeMap<SignalId, u32>) {
    if let Node::Signal(id) = value.node {
        widths.insert(id, value.width);
    }
    value.operands().into_iter().for_each(|operand| note_widths(operand, widths));
}

fn retarget(statement: &mut Statement, now: &impl Fn(SignalId) -> SignalId) {
    let all = |body: &mut Vec<Statement>| body.iter_mut().for_each(|one| retarget(one, now));
    match statement {
        Statement::Assign { target, .. } => *target = now(*target),
        Statement::If { then, otherwise, .. } => [then, otherwise].into_iter().for_each(all),
        Statement::Case { arms, default, .. } => {
            arms.iter_mut().map(|(_, body)| body).chain([default]).for_each(all);
        }
    }
}

/// Takes modules away that no other is made of.
pub(crate) fn drop_unused(design: &mut Design) {
    let top = design.modules.len() - 1;
    let used = |design: &Design, module: usize| {
        let mut instances = design.modules.iter().flat_map(|module| &module.instances);
        module == design.modules.len() - 1 || instances.any(|instance| instance.module == module)
    };
    // Those that hold others come behind them.
    for module in (0..top).rev() {
        if !used(design, module) {
            design.modules.remove(module);
            let others = design.modules.iter_mut().flat_map(|other| &mut other.instances);
            others.filter(|other| other.module > module).for_each(|other| other.module -= 1);
        }
    }
}
