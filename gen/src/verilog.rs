//! One Verilog-2005 module for each module of a design.
//!
//! Ports keep the names of the documentation. A flip-flop `x` is `x_q`, and takes `x_d` at the
//! rising edge. Every literal has its width, every connection its name, and nothing is extended
//! or cut by the language.

use helixlock_netlist::{
    Design, Expression, Module, Node, PortKind, Role, SignalId, Statement, literal,
};

use crate::GenError;
use crate::groups::{Group, groups};
use crate::lines::Lines;
use crate::names;
use crate::synchronisers::synchronisers;
use crate::tidy::tidy;
use crate::unused::{bits_read, unused};

/// Name and text of every module, leaves first.
///
/// # Errors
///
/// A name Verilog reserves, or an expression it cannot spell.
pub fn verilog(design: &Design) -> Result<Vec<(String, String)>, GenError> {
    let text = |module: &Module| {
        let tidied = tidy(module);
        Ok((module.name.clone(), Writer::new(&tidied).write(design)?))
    };
    design.modules.iter().map(text).collect()
}

/// Asks vendors' tools and yosys to keep a synchroniser's flip-flops, side by side.
const KEPT: &str = "(* ASYNC_REG = \"TRUE\", keep = \"true\" *)";

struct Writer<'a> {
    module: &'a Module,
    groups: Vec<Group<'a>>,
    read: Vec<u64>,
    lines: Lines,
}

impl<'a> Writer<'a> {
    fn new(module: &'a Module) -> Self {
        Self { module, groups: groups(module), read: bits_read(module), lines: Lines::default() }
    }

    fn write(mut self, design: &Design) -> Result<String, GenError> {
        names::check(self.module)?;
        self.header(&design.licence);
        self.lines.indent();
        self.declarations();
        self.instances(design);
        self.lines.gap();
        let groups = std::mem::take(&mut self.groups);
        for group in &groups {
            self.group(group)?;
        }
        self.flip_flops();
        self.memory();
        self.unused();
        self.lines.dedent();
        self.lines.push("endmodule");
        self.lines.gap();
        self.lines.push("`default_nettype wire");
        Ok(self.lines.finish())
    }

    fn name(&self, id: SignalId) -> String {
        self.module.signal(id).name.clone()
    }

    fn text(&self, e: &Expression) -> String {
        e.verilog(&|id| self.name(id))
    }

    fn header(&mut self, licence: &str) {
        let module = self.module;
        if !licence.is_empty() {
            self.lines.remark(&format!("SPDX-License-Identifier: {licence}"));
        }
        self.lines.comment(&module.name, &module.comment);
        self.lines.gap();
        self.lines.push("`default_nettype none");
        self.lines.gap();
        self.lines.push(&format!("module {} (", self.module.name));
        self.lines.indent();
        for (index, port) in module.ports.iter().enumerate() {
            if let Some(note) = module.port_notes.get(index).filter(|note| !note.is_empty()) {
                self.lines.comment(&port.name, note);
            }
            let comma = if index + 1 < module.ports.len() { "," } else { "" };
            let line = self.port(&port.name, port.kind);
            self.lines.push(&format!("{line}{comma}"));
        }
        self.lines.dedent();
        self.lines.push(");");
    }

    fn port(&self, name: &str, kind: PortKind) -> String {
        let range = |id| range(self.module.signal(id).width);
        match kind {
            PortKind::Clock => format!("input  wire {:7} {name}", ""),
            PortKind::Input(id) => format!("input  wire {:7} {name}", range(id)),
            PortKind::Output(id) => {
                format!("output {:4} {:7} {name}", self.sort(id), range(id))
            }
        }
    }

    /// `reg` for what an `always` assigns, else `wire`.
    fn sort(&self, id: SignalId) -> &'static str {
        let role = self.module.signal(id).role;
        let assigned =
            self.groups.iter().any(|group| group.as_assignment().is_none() && group.assigns(id));
        if role == Role::RegisterOutput || assigned { "reg" } else { "wire" }
    }

    fn declarations(&mut self) {
        self.lines.gap();
        let synchronisers = synchronisers(self.module);
        for (index, signal) in self.module.signals.iter().enumerate() {
            let id = SignalId(u32::try_from(index).unwrap_or(u32::MAX));
            let (range, name) = (range(signal.width), &signal.name);
            match signal.role {
                Role::Constant(value) if self.read[index] != 0 => {
                    let value = literal(signal.width, value);
                    self.lines.push(&spaced(&["localparam", &range, name, "=", &value, ";"]));
                }
                Role::Input | Role::Output | Role::Constant(_) => {}
                Role::InstanceInput if self.connection(id).is_some() => {}
                _ => {
                    let kept = if synchronisers.contains(&id) { KEPT } else { "" };
                    self.lines.push(&spaced(&[kept, self.sort(id), &range, name, ";"]));
                }
            }
        }
    }

    /// What an inner block's input is connected to, when that needs no wire of its own.
    fn connection(&self, id: SignalId) -> Option<&'a Expression> {
        let plain = |group: &Group<'a>| group.as_assignment().filter(|(target, _)| *target == id);
        let (_, value) = self.groups.iter().find_map(plain)?;
        is_bare(value).then_some(value)
    }

    fn instances(&mut self, design: &Design) {
        for instance in &self.module.instances {
            let inner = &design.modules[instance.module];
            let mut wires = instance.connections.iter();
            let mut connections = vec![];
            for port in &inner.ports {
                let outside = match port.kind {
                    PortKind::Clock => self.module.clock().unwrap_or_default().to_owned(),
                    _ => wires.next().map(|&id| self.outside(id)).unwrap_or_default(),
                };
                connections.push(format!(".{}({outside})", port.name));
            }
            self.lines.gap();
            self.lines.push(&format!("{} {} (", inner.name, instance.name));
            self.lines.indent();
            self.lines.push_list(&connections);
            self.lines.dedent();
            self.lines.push(");");
        }
    }

    fn outside(&self, id: SignalId) -> String {
        let role = self.module.signal(id).role;
        match self.connection(id).filter(|_| role == Role::InstanceInput) {
            Some(value) => self.text(value),
            None => self.name(id),
        }
    }

    fn group(&mut self, group: &Group<'a>) -> Result<(), GenError> {
        if let Some((target, value)) = group.as_assignment() {
            let role = self.module.signal(target).role;
            if role == Role::InstanceInput && is_bare(value) {
                return Ok(());
            }
            let line = format!("assign {} = {};", self.name(target), self.value(target, value)?);
            self.lines.push(&line);
            return Ok(());
        }
        self.lines.gap();
        self.lines.push("always @* begin");
        self.lines.indent();
        for statement in &group.statements {
            self.statement(statement)?;
        }
        self.lines.dedent();
        self.lines.push("end");
        self.lines.gap();
        Ok(())
    }

    fn value(&self, target: SignalId, value: &Expression) -> Result<String, GenError> {
        if value.has_cut_arithmetic() {
            let (module, signal) = (self.module.name.clone(), self.name(target));
            return Err(GenError::CutValue { module, signal });
        }
        Ok(self.text(value))
    }

    fn block(&mut self, statements: &[Statement]) -> Result<(), GenError> {
        self.lines.indent();
        for statement in statements {
            self.statement(statement)?;
        }
        self.lines.dedent();
        Ok(())
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), GenError> {
        match statement {
            Statement::Assign { target, value } => {
                let line = format!("{} = {};", self.name(*target), self.value(*target, value)?);
                self.lines.push(&line);
                Ok(())
            }
            Statement::If { condition, then, otherwise } => {
                self.branch("", condition, then, otherwise)
            }
            Statement::Case { of, arms, default } => self.case(of, arms, default),
        }
    }

    fn branch(
        &mut self,
        before: &str,
        condition: &Expression,
        then: &[Statement],
        otherwise: &[Statement],
    ) -> Result<(), GenError> {
        let condition = self.text(condition);
        self.lines.push(&format!("{before}if ({condition}) begin"));
        self.block(then)?;
        match otherwise {
            [] => {}
            [Statement::If { condition, then, otherwise }] => {
                return self.branch("end else ", condition, then, otherwise);
            }
            _ => {
                self.lines.push("end else begin");
                self.block(otherwise)?;
            }
        }
        self.lines.push("end");
        Ok(())
    }

    fn case(
        &mut self,
        of: &Expression,
        arms: &[(u64, Vec<Statement>)],
        default: &[Statement],
    ) -> Result<(), GenError> {
        let text = self.text(of);
        self.lines.push(&format!("case ({text})"));
        self.lines.indent();
        for (code, body) in arms {
            self.lines.push(&format!("{}: begin", literal(of.width, *code)));
            self.block(body)?;
            self.lines.push("end");
        }
        if default.is_empty() {
            self.lines.push("default: ;");
        } else {
            self.lines.push("default: begin");
            self.block(default)?;
            self.lines.push("end");
        }
        self.lines.dedent();
        self.lines.push("endcase");
        Ok(())
    }

    fn flip_flops(&mut self) {
        let Some(clock) = self.module.clock() else { return };
        if self.module.registers.is_empty() {
            return;
        }
        self.lines.gap();
        self.lines.push("initial begin");
        self.lines.indent();
        for register in &self.module.registers {
            let q = self.module.signal(register.output);
            let value = literal(q.width, register.initial);
            self.lines.push(&format!("{} = {value};", q.name));
        }
        self.lines.dedent();
        self.lines.push("end");
        self.lines.gap();
        self.lines.push(&format!("always @(posedge {clock}) begin"));
        self.lines.indent();
        for register in &self.module.registers {
            let (q, d) = (self.name(register.output), self.name(register.input));
            self.lines.push(&format!("{q} <= {d};"));
        }
        self.lines.dedent();
        self.lines.push("end");
    }

    /// Written or read, never both: so block RAM of every family does it alike.
    fn memory(&mut self) {
        let (Some(memory), Some(clock)) = (self.module.memory, self.module.clock()) else { return };
        let [address, write, sample, word] =
            [memory.address, memory.write, memory.sample, memory.word].map(|id| self.name(id));
        let width = range(self.module.signal(memory.word).width);
        self.lines.gap();
        self.lines.push(&spaced(&["reg", &width, &format!("words [0:{}]", memory.words - 1), ";"]));
        self.lines.gap();
        self.lines.push(&format!("always @(posedge {clock}) begin"));
        self.lines.indent();
        self.lines.push(&format!("if ({write}) begin"));
        self.lines.indent();
        self.lines.push(&format!("words[{address}] <= {sample};"));
        self.lines.dedent();
        self.lines.push("end else begin");
        self.lines.indent();
        self.lines.push(&format!("{word} <= words[{address}];"));
        self.lines.dedent();
        self.lines.push("end");
        self.lines.dedent();
        self.lines.push("end");
    }

    fn unused(&mut self) {
        let mut unused = unused(self.module);
        let clocked = !self.module.registers.is_empty()
            || !self.module.instances.is_empty()
            || self.module.memory.is_some();
        unused.extend(self.module.clock().filter(|_| !clocked).map(str::to_owned));
        if unused.is_empty() {
            return;
        }
        self.lines.gap();
        self.lines.remark("Without a reader here; named so that linters know it is meant.");
        let list = unused.join(", ");
        self.lines.push(&format!("wire {} = &{{1'b0, {list}}};", names::UNUSED));
    }
}

fn is_bare(value: &Expression) -> bool {
    match &value.node {
        Node::Constant(_) | Node::Signal(_) => true,
        Node::Slice { of, .. } => matches!(of.node, Node::Signal(_)),
        _ => false,
    }
}

/// `[7:0]`, or nothing for one bit.
fn range(width: u32) -> String {
    if width == 1 { String::new() } else { format!("[{}:0]", width - 1) }
}

/// Words with single spaces, none before the semicolon.
fn spaced(words: &[&str]) -> String {
    let words: Vec<&str> = words.iter().copied().filter(|word| !word.is_empty()).collect();
    words.join(" ").replace(" ;", ";")
}
