//! A design compiled ahead of time, at a moment: what the engine that takes every clock and the one
//! that leaps are made of.

use helixlock_netlist::{Netlist, SignalId, mask};

use super::all_signals::AllSignals;
use super::gather::Gather;
use super::rest::Rest;
use super::state::{FlipFlops, Snapshot, pack, unpack};

/// Straight-line code for a whole design.
pub trait DenseKernel: AllSignals + Clone + Default {
    /// One word an input, then what is computed from inputs alone.
    type Inputs: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One word a register; narrow ones may be split into bits.
    type Registers: AsRef<[u64]> + AsMut<[u64]> + Clone + PartialEq + std::fmt::Debug;
    /// One word a register, each whole.
    type Joined: AsRef<[u64]>;
    /// One word for each that is kept from clock to clock: it depends on inputs that `TELLS`
    /// names and registers that rarely change. Those of one bit that are looked up with are bits of
    /// what is known instead.
    type Kept: AsRef<[u64]> + Clone + std::fmt::Debug;
    /// All inputs low.
    const INPUTS: Self::Inputs;
    /// All zero.
    const REGISTERS: Self::Registers;
    /// Nothing computed yet.
    const KEPT: Self::Kept;
    /// One an input: when it has changed, more has than the bit that it is. Words kept are to be
    /// computed anew, and blocks to be looked at again.
    const TELLS: &'static [bool];
    /// One an input: the early bit that is this input, if there is one.
    const TOGGLES: &'static [u64];
    /// Number of tables that are asked at every clock.
    const TABLES: usize;
    /// Bits found: while all of them are clear, an edge changes nothing but what is known and counters
    /// that coast. `None` when that is not so.
    const BUSY: Option<u64>;
    /// Registers that move by the same step at every clock that is not busy.
    const COASTING: &'static [Coast];
    /// One an output: its place in what [`DenseKernel::shown`] tells, if it tells it.
    const SHOWN: &'static [Option<u32>];

    /// Asks all tables of what is known, which must be of these inputs and registers.
    fn look<G: Gather>(
        inputs: &Self::Inputs,
        registers: &Self::Registers,
        kept: &Self::Kept,
        known: Known,
    ) -> Edge;

    /// Takes an edge that has been looked at, for all that is not packed: what is known after it.
    /// Registers that are packed are out of date among `registers`.
    fn take(
        inputs: &Self::Inputs,
        registers: &mut Self::Registers,
        kept: &mut Self::Kept,
        edge: Edge,
        rest: &mut Rest,
    ) -> Known;

    /// Computes what is kept, and the early bits that are, when those were `known`.
    fn keep(
        inputs: &mut Self::Inputs,
        registers: &Self::Registers,
        kept: &mut Self::Kept,
        known: u64,
    ) -> u64;

    /// Takes registers from where each stands whole; what is known, when the early bits were `known`.
    fn split(values: &[u64], registers: &mut Self::Registers, known: u64) -> Known;

    /// The other way about.
    fn join(known: Known, registers: &Self::Registers) -> Self::Joined;

    /// Outputs of one bit that follow from what is known alone.
    fn shown(known: Known) -> u64;

    /// Writes the outputs, in port order.
    fn outputs(inputs: &[u64], registers: &[u64], values: &mut [u64]);
}

/// One-bit registers and what is known with them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known {
    /// Registers that one look-up tells, and what is kept and compared beside them.
    pub early: u64,
    /// Registers known only after one look-up has followed another.
    pub late: u64,
}

impl Known {
    /// Bits in which they differ; word by word, since as one list just written each would wait.
    #[inline]
    pub(super) fn difference(self, other: Self) -> u64 {
        (self.early ^ other.early) | (self.late ^ other.late)
    }
}

/// What the tables say of an edge.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// What is known before it.
    pub known: Known,
    /// The same with the values that packed registers take.
    pub next: Known,
    /// What else is found.
    pub found: u64,
}

/// A register that is seen only by how it compares, and moves by the same step unless it is told
/// otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Coast {
    /// Index in [`DenseKernel::Registers`].
    pub register: usize,
    /// The signal that is the register.
    pub output: SignalId,
    /// In bits.
    pub width: u32,
    /// What is added at every clock.
    pub step: u64,
    /// What it is compared with.
    pub thresholds: &'static [u64],
}

impl Coast {
    /// Its value so many clocks on.
    #[inline]
    pub(super) fn after(&self, value: u64, clocks: u64) -> u64 {
        value.wrapping_add(self.step.wrapping_mul(clocks)) & mask(self.width)
    }
}

/// A signal as an input.
#[derive(Clone, Copy, Debug)]
struct Port {
    /// Index in [`Netlist::inputs`]; beyond them for any other signal.
    index: usize,
    /// The largest value it takes.
    most: u64,
    toggles: u64,
    tells: bool,
}

/// A design at a moment.
#[derive(Clone, Debug)]
pub(super) struct Machine<K: DenseKernel> {
    pub(super) clock: u64,
    pub(super) known: Known,
    /// `kept` and `known` are of other inputs or registers.
    stale: bool,
    pub(super) rest: Rest,
    pub(super) inputs: K::Inputs,
    /// Those that are packed are as they were.
    pub(super) registers: K::Registers,
    pub(super) kept: K::Kept,
    /// One a signal.
    ports: Vec<Port>,
}

impl<K: DenseKernel> Machine<K> {
    /// At power-up, with all inputs low; `K` must be of the same design.
    pub(super) fn new(netlist: &Netlist) -> Self {
        let mut registers = K::REGISTERS;
        let initial: Vec<u64> = netlist.registers.iter().map(|register| register.initial).collect();
        let known = K::split(&initial, &mut registers, 0);
        let none = Port { index: usize::MAX, most: 0, toggles: 0, tells: false };
        let mut ports = vec![none; netlist.signals.len()];
        for (index, input) in netlist.inputs.iter().enumerate() {
            let most = mask(netlist.signal(*input).width);
            let (toggles, tells) = (K::TOGGLES[index], K::TELLS[index]);
            ports[input.0 as usize] = Port { index, most, toggles, tells };
        }
        Self {
            clock: 0,
            known,
            stale: true,
            rest: Rest::default(),
            inputs: K::INPUTS,
            registers,
            kept: K::KEPT,
            ports,
        }
    }

    /// Drives an input; false when the signal is none that takes this value.
    #[inline]
    pub(super) fn set_input(&mut self, input: SignalId, value: u64) -> bool {
        let Port { index, most, toggles, tells } = self.ports[input.0 as usize];
        let Some(held) = self.inputs.as_mut().get_mut(index).filter(|_| value <= most) else {
            return false;
        };
        if *held != value {
            *held = value;
            self.known.early ^= toggles;
            if tells {
                self.stale = true;
                self.rest = Rest::default();
            }
        }
        true
    }

    /// Has everything follow the inputs.
    #[inline]
    pub(super) fn settle(&mut self) {
        if self.stale {
            self.keep();
        }
    }

    /// True when [`Machine::settle`] has something to do.
    #[inline]
    pub(super) fn is_stale(&self) -> bool {
        self.stale
    }

    #[cold]
    fn keep(&mut self) {
        let Self { inputs, registers, kept, .. } = self;
        self.known.early = K::keep(inputs, registers, kept, self.known.early);
        self.stale = false;
    }

    /// Takes one rising edge that has been looked at.
    #[inline]
    pub(super) fn take(&mut self, edge: Edge) {
        let Self { inputs, registers, kept, rest, .. } = self;
        self.known = K::take(inputs, registers, kept, edge, rest);
        self.clock += 1;
    }

    /// All registers, each whole.
    pub(super) fn joined(&self) -> K::Joined {
        K::join(self.known, &self.registers)
    }

    pub(super) fn snapshot(&self, netlist: &Netlist) -> Snapshot {
        let inputs = self.inputs.as_ref()[..netlist.inputs.len()].to_vec();
        Snapshot { clock: self.clock, inputs, flip_flops: self.flip_flops(netlist) }
    }

    pub(super) fn flip_flops(&self, netlist: &Netlist) -> FlipFlops {
        pack(netlist, self.joined().as_ref().iter().copied())
    }

    pub(super) fn restore(&mut self, netlist: &Netlist, snapshot: &Snapshot) {
        assert_eq!(snapshot.inputs.len(), netlist.inputs.len(), "inputs of this design");
        self.inputs.as_mut()[..snapshot.inputs.len()].copy_from_slice(&snapshot.inputs);
        let registers = unpack(netlist, &snapshot.flip_flops);
        self.known = K::split(&registers, &mut self.registers, self.known.early);
        self.clock = snapshot.clock;
        self.rest = Rest::default();
        self.stale = true;
    }
}
