//! What rust-hdl's visitor shows of a block: fields, blocks inside, and the kernel's syntax tree.

use rust_hdl::core::ast::Verilog;
use rust_hdl::core::atom::{Atom, AtomKind};
use rust_hdl::core::block::Block;
use rust_hdl::core::probe::Probe;
use rust_hdl::core::type_descriptor::{TypeDescriptor, TypeKind};

/// One block as rust-hdl describes it.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) code: Verilog,
    pub(crate) fields: Vec<Field>,
    pub(crate) inner: Vec<Self>,
}

/// A signal or constant of a block.
#[derive(Debug)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) kind: AtomKind,
    pub(crate) width: usize,
    pub(crate) is_clock: bool,
    pub(crate) is_signed: bool,
    /// Verilog text of the value it has now.
    pub(crate) literal: String,
    /// Names and codes when it is an enum.
    pub(crate) states: Vec<(String, u64)>,
}

impl Source {
    /// Reads a block and all inside it.
    pub(crate) fn of(name: &str, block: &dyn Block) -> Self {
        let mut reader = Reader { open: vec![Self::new(name, Verilog::Empty)], namespace: vec![] };
        block.accept(name, &mut reader);
        let mut holder = reader.open.swap_remove(0);
        holder.inner.pop().unwrap_or(holder)
    }

    fn new(name: &str, code: Verilog) -> Self {
        Self { name: name.to_owned(), code, fields: vec![], inner: vec![] }
    }
}

struct Reader {
    open: Vec<Source>,
    namespace: Vec<String>,
}

impl Probe for Reader {
    fn visit_start_scope(&mut self, name: &str, node: &dyn Block) {
        self.open.push(Source::new(name, node.hdl()));
    }

    fn visit_start_namespace(&mut self, name: &str, _node: &dyn Block) {
        self.namespace.push(name.to_owned());
    }

    fn visit_atom(&mut self, name: &str, signal: &dyn Atom) {
        let path: Vec<&str> = self.namespace.iter().map(String::as_str).chain([name]).collect();
        if let Some(block) = self.open.last_mut() {
            block.fields.push(field(path.join("$"), signal));
        }
    }

    fn visit_end_namespace(&mut self, _name: &str, _node: &dyn Block) {
        self.namespace.pop();
    }

    fn visit_end_scope(&mut self, _name: &str, _node: &dyn Block) {
        let closed = self.open.pop();
        if let (Some(outer), Some(inner)) = (self.open.last_mut(), closed) {
            outer.inner.push(inner);
        }
    }
}

fn field(name: String, signal: &dyn Atom) -> Field {
    let descriptor = signal.descriptor();
    Field {
        name,
        kind: signal.kind(),
        width: signal.bits(),
        is_clock: descriptor.name == "clock",
        is_signed: matches!(descriptor.kind, TypeKind::Signed(_)),
        literal: format!("{:x}", signal.verilog()),
        states: states(&descriptor),
    }
}

/// Enum names as the kernel writes them, with their codes.
fn states(descriptor: &TypeDescriptor) -> Vec<(String, u64)> {
    let TypeKind::Enum(names) = &descriptor.kind else { return vec![] };
    names.iter().map(|name| name.replace("::", "$")).zip(0..).collect()
}
