//! From a rust-hdl block to modules: one for each sort of block, each once.

use std::collections::BTreeSet;

use rust_hdl::core::block::Block;

use crate::fields::module;
use crate::source::Source;
use crate::{Design, Library, Module, NetlistError};

/// The design whose top is `block`, called `name`.
///
/// Blocks of equal structure share a module. Below the top its name is that of the equal block in
/// `library`, or else that of its first instance.
///
/// ```
/// use helixlock_netlist::{Library, elaborate};
/// use rust_hdl::prelude::*;
///
/// #[derive(Default, LogicBlock)]
/// struct Toggle {
///     pub clock: Signal<In, Clock>,
///     pub level: Signal<Out, Bit>,
///     state: DFF<Bit>,
/// }
///
/// impl Logic for Toggle {
///     #[hdl_gen]
///     fn update(&mut self) {
///         dff_setup!(self, clock, state);
///         self.state.d.next = !self.state.q.val();
///         self.level.next = self.state.q.val();
///     }
/// }
///
/// let design = elaborate("toggle", &Toggle::default(), &Library::new())?;
/// assert_eq!(design.top().registers.len(), 1);
/// # Ok::<(), helixlock_netlist::NetlistError>(())
/// ```
///
/// # Errors
///
/// The first place where the description has no single sound meaning; see [`NetlistError`].
pub fn elaborate(name: &str, block: &dyn Block, library: &Library) -> Result<Design, NetlistError> {
    let mut shelf = Shelf { modules: vec![] };
    for entry in &library.entries {
        let index = shelf.add(&Source::of(&entry.name, &*entry.block), &entry.name)?;
        let found = &mut shelf.modules[index];
        if found.name.is_empty() {
            found.name.clone_from(&entry.name);
            found.comment.clone_from(&entry.comment);
            found.port_notes = found.ports.iter().map(|port| entry.note(&port.name)).collect();
        }
    }
    let top = shelf.add(&Source::of(name, block), name)?;
    name.clone_into(&mut shelf.modules[top].name);
    Ok(Design { modules: shelf.take(top), licence: library.licence.clone() })
}

/// Modules found so far, inner ones before those that hold them.
struct Shelf {
    modules: Vec<Module>,
}

impl Shelf {
    /// Index of the module of that structure.
    fn add(&mut self, source: &Source, path: &str) -> Result<usize, NetlistError> {
        let mut inner = vec![];
        for block in source.inner.iter().filter(|block| !block.is_flip_flop()) {
            inner.push(self.add(block, &format!("{path}.{}", block.name))?);
        }
        let new = module(source, path, &inner, &self.modules)?;
        let same = |old: &Module| {
            (&old.ports, &old.signals, &old.registers, &old.instances, &old.body)
                == (&new.ports, &new.signals, &new.registers, &new.instances, &new.body)
        };
        if let Some(found) = self.modules.iter().position(same) {
            return Ok(found);
        }
        self.modules.push(new);
        Ok(self.modules.len() - 1)
    }

    /// The modules that `top` needs, named, with `top` last.
    fn take(mut self, top: usize) -> Vec<Module> {
        let mut used = BTreeSet::new();
        self.mark(top, &mut used);
        self.name_after_instances(&used);
        let index_of = |old: usize| used.iter().position(|&kept| kept == old).unwrap_or(0);
        let mut modules = vec![];
        for &old in &used {
            let mut module = std::mem::take(&mut self.modules[old]);
            for instance in &mut module.instances {
                instance.module = index_of(instance.module);
            }
            modules.push(module);
        }
        modules
    }

    fn mark(&self, module: usize, used: &mut BTreeSet<usize>) {
        used.insert(module);
        for instance in &self.modules[module].instances {
            self.mark(instance.module, used);
        }
    }

    fn name_after_instances(&mut self, used: &BTreeSet<usize>) {
        let mut taken: BTreeSet<String> =
            used.iter().map(|&index| self.modules[index].name.clone()).collect();
        for &holder in used.iter().rev() {
            for instance in self.modules[holder].instances.clone() {
                if self.modules[instance.module].name.is_empty() {
                    let name = unused_name(&instance.name, &taken);
                    taken.insert(name.clone());
                    self.modules[instance.module].name = name;
                }
            }
        }
    }
}

fn unused_name(wanted: &str, taken: &BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{wanted}_{n}"));
    std::iter::once(wanted.to_owned())
        .chain(numbered)
        .find(|name| !taken.contains(name))
        .unwrap_or_default()
}
