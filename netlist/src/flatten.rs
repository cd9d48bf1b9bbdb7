//! From modules to one flat list of signals, registers and assignments in order.

use crate::execute::execute;
use crate::expression::resize;
use crate::order::ordered;
use crate::{
    Assignment, Design, Expression, Module, Netlist, NetlistError, PortKind, Register, Role,
    Signal, SignalId,
};

impl Netlist {
    /// Joins the modules of a design.
    ///
    /// Ports of inner blocks and the wires that lead to them are one signal, called by the path
    /// of the port: `divider_a.units.carry`.
    ///
    /// # Errors
    ///
    /// [`NetlistError::Loop`] when logic feeds itself without a flip-flop, [`NetlistError::Memory`]
    /// when a module has more than flip-flops.
    pub fn new(design: &Design) -> Result<Self, NetlistError> {
        let mut flat = Flat { design, netlist: Self::default() };
        let top = design.top();
        let mut ports = vec![];
        for port in &top.ports {
            if let Some(inside) = port.kind.signal() {
                let id = flat.add_signal(port.name.clone(), top.signal(inside).width);
                match port.kind {
                    PortKind::Input(_) => flat.netlist.inputs.push(id),
                    _ => flat.netlist.outputs.push(id),
                }
                ports.push(id);
            }
        }
        flat.add_module(top, "", &ports)?;
        let Self { signals, inputs, outputs, mut registers, assignments } = flat.netlist;
        registers.sort_by(|a, b| {
            signals[a.output.0 as usize].path.cmp(&signals[b.output.0 as usize].path)
        });
        let assignments = ordered(&signals, assignments)?;
        Ok(Self { signals, inputs, outputs, registers, assignments })
    }
}

struct Flat<'a> {
    design: &'a Design,
    netlist: Netlist,
}

impl Flat<'_> {
    fn add_signal(&mut self, path: String, width: u32) -> SignalId {
        let id = SignalId(u32::try_from(self.netlist.signals.len()).unwrap_or(u32::MAX));
        self.netlist.signals.push(Signal { path, width });
        id
    }

    /// Adds what is inside a module; `ports` are its ports but the clock, in order.
    fn add_module(
        &mut self,
        module: &Module,
        prefix: &str,
        ports: &[SignalId],
    ) -> Result<(), NetlistError> {
        let wires = self.wires(module, prefix, ports);
        let block = prefix.strip_suffix('.').unwrap_or(&module.name);
        if module.memory.is_some() {
            return Err(NetlistError::Memory { block: block.to_owned() });
        }
        for (target, value) in execute(module, block)? {
            self.netlist.assignments.push(Assignment {
                target: wires.of(target),
                value: wires.expression(module, &value),
            });
        }
        self.netlist.registers.extend(module.registers.iter().map(|register| Register {
            output: wires.of(register.output),
            input: wires.of(register.input),
            initial: register.initial,
        }));
        for instance in &module.instances {
            let ports: Vec<_> = instance.connections.iter().map(|&id| wires.of(id)).collect();
            let path = format!("{prefix}{}.", instance.name);
            self.add_module(&self.design.modules[instance.module], &path, &ports)?;
        }
        Ok(())
    }

    /// A flat signal for each signal of the module; ports have theirs already.
    fn wires(&mut self, module: &Module, prefix: &str, ports: &[SignalId]) -> Wires {
        let mut wires = Wires(vec![SignalId(u32::MAX); module.signals.len()]);
        let data_ports = module.ports.iter().filter_map(|port| port.kind.signal());
        for (inside, &outside) in data_ports.zip(ports) {
            wires.0[inside.0 as usize] = outside;
        }
        for (index, signal) in module.signals.iter().enumerate() {
            if matches!(signal.role, Role::Local | Role::RegisterInput | Role::RegisterOutput) {
                wires.0[index] = self.add_signal(format!("{prefix}{}", signal.name), signal.width);
            }
        }
        for instance in &module.instances {
            let inner = &self.design.modules[instance.module];
            let ports = inner.ports.iter().filter(|port| port.kind != PortKind::Clock);
            for (port, &id) in ports.zip(&instance.connections) {
                let path = format!("{prefix}{}.{}", instance.name, port.name);
                wires.0[id.0 as usize] = self.add_signal(path, module.signal(id).width);
            }
        }
        wires
    }
}

/// Flat signals by their index in the module; constants have none.
struct Wires(Vec<SignalId>);

impl Wires {
    fn of(&self, id: SignalId) -> SignalId {
        self.0[id.0 as usize]
    }

    fn expression(&self, module: &Module, e: &Expression) -> Expression {
        let replaced = e.substitute(&mut |id| {
            let signal = module.signal(id);
            Ok::<_, std::convert::Infallible>(match signal.role {
                Role::Constant(value) => Expression::constant(signal.width, value),
                _ => Expression::signal(signal.width, self.of(id)),
            })
        });
        let Ok(replaced) = replaced;
        resize(replaced, e.width)
    }
}
