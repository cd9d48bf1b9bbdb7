//! A design as modules: what Verilog is written from, and what [`crate::flatten`] joins.

use crate::{Expression, Register, SignalId};

/// Modules, leaves first; the top is the last.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Design {
    /// Every module that is used, each once.
    pub modules: Vec<Module>,
    /// SPDX expression of the licence, or nothing.
    pub licence: String,
}

impl Design {
    /// The module that holds all others.
    ///
    /// # Panics
    ///
    /// Never for a design made by [`crate::elaborate()`], which has at least one module.
    #[must_use]
    pub fn top(&self) -> &Module {
        self.modules.last().expect("a design has a top module")
    }
}

/// One sort of block. Its expressions name signals by their index in [`Module::signals`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Module {
    /// Module name.
    pub name: String,
    /// What it is, in a sentence or two.
    pub comment: String,
    /// Ports in order of declaration.
    pub ports: Vec<Port>,
    /// What each port is for, in the same order; empty where nobody said.
    pub port_notes: Vec<String>,
    /// Every signal but the clock.
    pub signals: Vec<ModuleSignal>,
    /// Flip-flops, in order of declaration.
    pub registers: Vec<Register>,
    /// Blocks inside, in order of declaration.
    pub instances: Vec<Instance>,
    /// What drives outputs, locals, flip-flops and the inputs of blocks inside.
    pub body: Vec<Statement>,
    /// Words beside the flip-flops; no block of rust-hdl has them, and no engine.
    pub memory: Option<Memory>,
}

/// Words of which one is written or read at every clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Memory {
    /// How many.
    pub words: u64,
    /// Which one.
    pub address: SignalId,
    /// It is written.
    pub write: SignalId,
    /// What is written.
    pub sample: SignalId,
    /// The word last read.
    pub word: SignalId,
}

impl Module {
    /// Name of the clock port, if there is one.
    #[must_use]
    pub fn clock(&self) -> Option<&str> {
        let clock = self.ports.iter().find(|port| port.kind == PortKind::Clock);
        clock.map(|port| port.name.as_str())
    }

    /// The signal of that index.
    #[must_use]
    pub fn signal(&self, id: SignalId) -> &ModuleSignal {
        &self.signals[id.0 as usize]
    }
}

/// A pin of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port {
    /// Name as in the source.
    pub name: String,
    /// Direction, and the signal inside.
    pub kind: PortKind,
}

/// Direction of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortKind {
    /// The clock, an input.
    Clock,
    /// Driven from outside.
    Input(SignalId),
    /// Driven by the module.
    Output(SignalId),
}

impl PortKind {
    /// The signal inside, unless it is the clock.
    #[must_use]
    pub const fn signal(self) -> Option<SignalId> {
        match self {
            Self::Clock => None,
            Self::Input(signal) | Self::Output(signal) => Some(signal),
        }
    }
}

/// A named value inside a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ModuleSignal {
    /// Unique in its module, a legal identifier: field `x` of a flip-flop gives `x_q` and `x_d`,
    /// port `p` of the block `b` inside gives `b_p`.
    pub name: String,
    /// Number of bits, 1 to 64.
    pub width: u32,
    /// What drives it.
    pub role: Role,
}

/// What a signal is in its module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Port, driven from outside.
    Input,
    /// Port, driven by the body.
    Output,
    /// Driven by the body.
    Local,
    /// A named constant.
    Constant(u64),
    /// Flip-flop's output.
    RegisterOutput,
    /// Flip-flop's input, driven by the body.
    RegisterInput,
    /// Output of a block inside.
    InstanceOutput,
    /// Input of a block inside, driven by the body.
    InstanceInput,
}

impl Role {
    /// True when the body has to assign it.
    #[must_use]
    pub const fn is_driven_by_body(self) -> bool {
        matches!(self, Self::Output | Self::Local | Self::RegisterInput | Self::InstanceInput)
    }
}

/// A block inside a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    /// Field name.
    pub name: String,
    /// Index in [`Design::modules`].
    pub module: usize,
    /// For each port of that module but its clock, in order, the signal here.
    pub connections: Vec<SignalId>,
}

/// A step of the body; later ones win.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Statement {
    /// `target` takes `value`, equally wide.
    Assign {
        /// The signal.
        target: SignalId,
        /// Its value.
        value: Expression,
    },
    /// One branch or the other.
    If {
        /// One bit.
        condition: Expression,
        /// When it is set.
        then: Vec<Self>,
        /// When it is clear.
        otherwise: Vec<Self>,
    },
    /// The arm with the value, or the default.
    Case {
        /// The value compared.
        of: Expression,
        /// Distinct values and what happens for each.
        arms: Vec<(u64, Vec<Self>)>,
        /// What happens for all others.
        default: Vec<Self>,
    },
}
