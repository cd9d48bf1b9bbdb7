//! The module of one block: its fields become ports, signals, flip-flops and instances.

use std::collections::{BTreeMap, BTreeSet};

use rust_hdl::core::ast::Verilog;
use rust_hdl::core::atom::AtomKind;

use crate::execute::execute;
use crate::kernel::Kernel;
use crate::scope::{Name, Scope, parse_literal};
use crate::source::{Field, Source};
use crate::{
    Instance, Module, ModuleSignal, NetlistError, Port, PortKind, Register, Role, SignalId,
};

/// The module of `source`; `inner` are the indices of the blocks inside, in order, in `modules`.
pub(crate) fn module(
    source: &Source,
    path: &str,
    inner: &[usize],
    modules: &[Module],
) -> Result<Module, NetlistError> {
    let code = kernel_of(source, path)?;
    let mut fields = Fields::new(path);
    for field in &source.fields {
        fields.add_own(field)?;
    }
    let mut inner = inner.iter();
    for block in &source.inner {
        match block.initial_state() {
            Some(initial) => fields.add_register(block, initial)?,
            None => {
                if let Some(&index) = inner.next() {
                    fields.add_instance(&block.name, index, &modules[index])?;
                }
            }
        }
    }
    fields.finish(code)
}

fn kernel_of<'a>(
    source: &'a Source,
    path: &str,
) -> Result<&'a [rust_hdl::core::ast::VerilogStatement], NetlistError> {
    let found = match &source.code {
        Verilog::Combinatorial(code) => return Ok(code),
        Verilog::Empty => "no code",
        Verilog::Custom(_) => "custom Verilog",
        Verilog::Blackbox(_) => "a black box",
        Verilog::Wrapper(_) => "a wrapper",
    };
    Err(NetlistError::UnsupportedCode { block: path.to_owned(), found })
}

struct Fields {
    module: Module,
    scope: Scope,
    taken: BTreeSet<String>,
    /// Clock inputs of flip-flops and blocks inside, by their name in the kernel.
    clocks: Vec<String>,
}

impl Fields {
    fn new(path: &str) -> Self {
        Self {
            module: Module::default(),
            scope: Scope { block: path.to_owned(), names: BTreeMap::new() },
            taken: BTreeSet::new(),
            clocks: vec![],
        }
    }

    fn add_own(&mut self, field: &Field) -> Result<(), NetlistError> {
        for (state, code) in &field.states {
            self.scope.names.insert(state.clone(), Name::State(*code));
        }
        let name = &field.name;
        match field.kind {
            AtomKind::InputParameter if field.is_clock => self.add_clock(name),
            AtomKind::InputParameter => {
                let id = self.add_data(name, name.clone(), field, Role::Input)?;
                self.port(name, PortKind::Input(id));
                Ok(())
            }
            AtomKind::OutputParameter if !field.is_clock => {
                let id = self.add_data(name, name.clone(), field, Role::Output)?;
                self.port(name, PortKind::Output(id));
                Ok(())
            }
            AtomKind::LocalSignal if !field.is_clock => {
                self.add_data(name, name.clone(), field, Role::Local).map(drop)
            }
            AtomKind::Constant => {
                let (_, value) = parse_literal(&field.literal)
                    .ok_or_else(|| self.scope.refuse(name, "a constant above 64 bits"))?;
                self.add_data(name, name.clone(), field, Role::Constant(value)).map(drop)
            }
            _ if field.is_clock => Err(self.scope.refuse(name, "a derived clock")),
            _ => Err(self.scope.refuse(name, "a bidirectional signal")),
        }
    }

    fn add_clock(&mut self, name: &str) -> Result<(), NetlistError> {
        if self.module.clock().is_some() {
            return Err(self.scope.refuse(name, "a second clock"));
        }
        self.claim(name)?;
        self.scope.names.insert(name.to_owned(), Name::Clock);
        self.port(name, PortKind::Clock);
        Ok(())
    }

    fn port(&mut self, name: &str, kind: PortKind) {
        self.module.ports.push(Port { name: name.to_owned(), kind });
    }

    fn add_data(
        &mut self,
        kernel_name: &str,
        name: String,
        field: &Field,
        role: Role,
    ) -> Result<SignalId, NetlistError> {
        if field.is_signed {
            return Err(self.scope.refuse(kernel_name, "a signed value"));
        }
        if kernel_name.contains('$') && !kernel_name.ends_with("$q") && !kernel_name.ends_with("$d")
        {
            return Err(self.scope.refuse(kernel_name, "an interface"));
        }
        let width = self.scope.width(field.width, kernel_name)?;
        self.add_signal(kernel_name, name, width, role)
    }

    fn add_signal(
        &mut self,
        kernel_name: &str,
        name: String,
        width: u32,
        role: Role,
    ) -> Result<SignalId, NetlistError> {
        self.claim(&name)?;
        let id = SignalId(u32::try_from(self.module.signals.len()).unwrap_or(u32::MAX));
        self.module.signals.push(ModuleSignal { name, width, role });
        let known = match role {
            Role::RegisterInput | Role::InstanceInput => Name::WriteOnly(id, width),
            _ => Name::Data(id, width),
        };
        self.scope.names.insert(kernel_name.to_owned(), known);
        Ok(id)
    }

    fn claim(&mut self, name: &str) -> Result<(), NetlistError> {
        if self.taken.insert(name.to_owned()) {
            return Ok(());
        }
        Err(NetlistError::NameClash { block: self.scope.block.clone(), name: name.to_owned() })
    }

    fn add_register(&mut self, source: &Source, initial: u64) -> Result<(), NetlistError> {
        let field = &source.name;
        self.add_inner_clock(format!("{field}$clock"));
        let mut pin = |pin: &str, role| match source.fields.iter().find(|f| f.name == pin) {
            Some(data) => {
                for (state, code) in &data.states {
                    self.scope.names.insert(state.clone(), Name::State(*code));
                }
                self.add_data(&format!("{field}${pin}"), format!("{field}_{pin}"), data, role)
            }
            None => Err(self.scope.refuse(field, "a flip-flop without `d` and `q`")),
        };
        let input = pin("d", Role::RegisterInput)?;
        let output = pin("q", Role::RegisterOutput)?;
        self.module.registers.push(Register { output, input, initial });
        Ok(())
    }

    fn add_inner_clock(&mut self, kernel_name: String) {
        self.scope.names.insert(kernel_name.clone(), Name::InnerClock);
        self.clocks.push(kernel_name);
    }

    fn add_instance(
        &mut self,
        field: &str,
        index: usize,
        inner: &Module,
    ) -> Result<(), NetlistError> {
        self.claim(field)?;
        let mut connections = vec![];
        for port in &inner.ports {
            let kernel_name = format!("{field}${}", port.name);
            let (id, role) = match port.kind {
                PortKind::Clock => {
                    self.add_inner_clock(kernel_name);
                    continue;
                }
                PortKind::Input(id) => (id, Role::InstanceInput),
                PortKind::Output(id) => (id, Role::InstanceOutput),
            };
            let name = format!("{field}_{}", port.name);
            let width = inner.signal(id).width;
            connections.push(self.add_signal(&kernel_name, name, width, role)?);
        }
        self.module.instances.push(Instance { name: field.to_owned(), module: index, connections });
        Ok(())
    }

    fn finish(
        mut self,
        code: &[rust_hdl::core::ast::VerilogStatement],
    ) -> Result<Module, NetlistError> {
        let mut kernel =
            Kernel { scope: &self.scope, signals: &self.module.signals, clocked: BTreeSet::new() };
        let body = kernel.body(code)?;
        if let Some(clock) = self.clocks.iter().find(|clock| !kernel.clocked.contains(*clock)) {
            return Err(NetlistError::Clock {
                block: self.scope.block.clone(),
                target: clock.replace('$', "."),
                found: "nothing",
            });
        }
        self.module.body = body;
        execute(&self.module, &self.scope.block)?;
        Ok(self.module)
    }
}
