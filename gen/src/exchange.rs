//! Another block in the place of one in the top of a design, and one beside those that are there.

use std::collections::BTreeMap;

use helixlock_netlist::{
    Design, Expression, Instance, Module, ModuleSignal, Node, PortKind, Role, SignalId, Statement,
};

use crate::GenError;
use crate::bypass::{drop_unused, forget, is_read, with_signals};

/// What an input of a block in the top gets.
#[derive(Clone, Copy, Debug)]
pub enum Source<'a> {
    /// This for ever.
    Level(u64),
    /// Signals of the top by their names, the first one lowest.
    Signals(&'a [&'a str]),
}

/// Takes the block `old` from the top and puts the top of `block`, called `name`, in its place: what
/// read an output of the old one reads that of the same name.
///
/// # Errors
///
/// [`GenError::NoBlock`] when the top has no such block, [`GenError::NoSignal`] when a source is not
/// there, [`GenError::NoWay`] when an output is read that the new block does not have.
pub fn exchange(
    design: &mut Design,
    old: &str,
    (name, block): (&str, &Design),
    inputs: &[(&str, Source<'_>)],
) -> Result<(), GenError> {
    let missing = || GenError::NoBlock { block: old.to_owned() };
    let mut found = design.clone();
    let instance = found.top().instances.iter().find(|instance| instance.name == old);
    let instance = instance.ok_or_else(missing)?.clone();
    let before = wires(&found, &instance);
    let index = add_modules(&mut found, block);
    let after = insert(&mut found, name, index, inputs)?;

    let mut slim = found.top().clone();
    let gone = &instance.connections;
    slim.instances.retain(|other| other.name != old);
    slim.body.retain(|statement| match statement {
        Statement::Assign { target, .. } => !gone.contains(target),
        _ => true,
    });
    let instead: BTreeMap<SignalId, SignalId> =
        before.iter().filter_map(|(port, id)| Some((*id, *after.get(port)?))).collect();
    for statement in &mut slim.body {
        *statement = with_signals(statement, &|id, width| {
            Expression::signal(width, instead.get(&id).copied().unwrap_or(id))
        });
    }
    if let Some((output, _)) = before.iter().find(|(_, id)| is_read(&slim, **id)) {
        return Err(GenError::NoWay { block: old.to_owned(), output: output.clone() });
    }
    forget(&mut slim, gone);
    if let Some(top) = found.modules.last_mut() {
        *top = slim;
    }
    drop_unused(&mut found);
    *design = found;
    Ok(())
}

/// Adds the modules of another design below the top; gives the index of its top.
fn add_modules(design: &mut Design, block: &Design) -> usize {
    let first = design.modules.len() - 1;
    for (place, module) in block.modules.iter().enumerate() {
        let mut module = module.clone();
        module.instances.iter_mut().for_each(|instance| instance.module += first);
        design.modules.insert(first + place, module);
    }
    first + block.modules.len() - 1
}

/// Adds an instance of a module to the top; gives the signals at its ports. An input without a source
/// stays low.
pub(crate) fn insert(
    design: &mut Design,
    name: &str,
    index: usize,
    inputs: &[(&str, Source<'_>)],
) -> Result<BTreeMap<String, SignalId>, GenError> {
    let inner = design.modules[index].clone();
    let mut top = design.top().clone();
    let mut connections = vec![];
    for port in &inner.ports {
        let (role, id) = match port.kind {
            PortKind::Clock => continue,
            PortKind::Input(id) => (Role::InstanceInput, id),
            PortKind::Output(id) => (Role::InstanceOutput, id),
        };
        let width = inner.signal(id).width;
        let outside = SignalId(u32::try_from(top.signals.len()).unwrap_or(u32::MAX));
        top.signals.push(ModuleSignal { name: format!("{name}_{}", port.name), width, role });
        connections.push(outside);
        if role == Role::InstanceInput {
            let source = inputs.iter().find(|(input, _)| *input == port.name);
            let source = source.map_or(Source::Level(0), |(_, source)| *source);
            let value = value_of(&top, source, width)?;
            top.body.push(Statement::Assign { target: outside, value });
        }
    }
    top.instances.push(Instance { name: name.to_owned(), module: index, connections });
    if let Some(last) = design.modules.last_mut() {
        *last = top;
    }
    Ok(design.top().instances.last().map(|instance| wires(design, instance)).unwrap_or_default())
}

/// The signals at the ports of a block in the top.
fn wires(design: &Design, instance: &Instance) -> BTreeMap<String, SignalId> {
    let ports = design.modules[instance.module].ports.iter();
    let ports = ports.filter(|port| port.kind != PortKind::Clock);
    ports.map(|port| port.name.clone()).zip(instance.connections.iter().copied()).collect()
}

fn value_of(top: &Module, source: Source<'_>, width: u32) -> Result<Expression, GenError> {
    let names = match source {
        Source::Level(level) => return Ok(Expression::constant(width, level)),
        Source::Signals(names) => names,
    };
    let mut value = None;
    let mut low = 0;
    for name in names {
        let missing = || GenError::NoSignal { signal: (*name).to_owned() };
        let place = top.signals.iter().position(|signal| signal.name == *name);
        let place = place.and_then(|place| u32::try_from(place).ok()).ok_or_else(missing)?;
        let part = Expression::signal(top.signal(SignalId(place)).width, SignalId(place));
        let part_width = part.width;
        let part = placed(part, low, width);
        value = Some(match value {
            None => part,
            Some(others) => Expression { width, node: Node::Or(Box::new(others), Box::new(part)) },
        });
        low += part_width;
    }
    Ok(value.unwrap_or(Expression::constant(width, 0)))
}

/// A value in its place among wider ones.
fn placed(part: Expression, low: u32, width: u32) -> Expression {
    let wide = match part.width {
        same if same == width => part,
        _ => Expression { width, node: Node::Extend(Box::new(part)) },
    };
    if low == 0 {
        return wide;
    }
    let by = Expression::constant(width, low.into());
    Expression { width, node: Node::ShiftUp(Box::new(wide), Box::new(by)) }
}
