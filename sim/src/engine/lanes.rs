//! Many copies of a design at once, one bit a copy.
//!
//! Bit `n % 64` of word `n / 64` of every flip-flop belongs to copy (lane) n. All lanes take each
//! clock together; their inputs and flip-flops may differ. What rests in all lanes is passed over.
//! Where many copies are wanted this is the fastest engine per copy; where most clocks are idle,
//! [`crate::Leap`] is.

use std::ops::Range;

use helixlock_netlist::{Netlist, SignalId};

use super::circuit::Circuit;
use super::state::{FlipFlops, pack};
use super::vector::Vector;
#[cfg(target_arch = "x86_64")]
use super::vector::{Bits256, Bits512};

/// Words a bit: 512 lanes, one vector register of the widest kind.
pub const LANE_WORDS: usize = 8;

/// Copies that run together.
pub const LANES: usize = 64 * LANE_WORDS;

/// One bit in all lanes.
pub type Lane = [u64; LANE_WORDS];

/// Code for all lanes of a design, which passes over what rests in all of them.
pub trait LaneKernel {
    /// Bits of the inputs, in port order, lowest first.
    type Inputs: AsRef<[Lane]> + AsMut<[Lane]> + Clone + std::fmt::Debug;
    /// Flip-flops, in the order of [`FlipFlops`].
    type State: AsRef<[Lane]> + AsMut<[Lane]> + Clone + std::fmt::Debug;
    /// Gates that are computed anew only when what they read may have changed.
    type Kept: AsRef<[Lane]> + Clone + std::fmt::Debug;
    /// Edges until each group of registers that follow inputs has settled.
    type Settling: AsRef<[usize]> + AsMut<[usize]> + Clone + std::fmt::Debug;
    /// All low.
    const INPUTS: Self::Inputs;
    /// All clear.
    const STATE: Self::State;
    /// Not computed yet.
    const KEPT: Self::Kept;
    /// Edges until an input that has changed shows everywhere in each of those groups.
    const SETTLING: Self::Settling;
    /// By the place of an input's bit: something kept is computed from it.
    const TELLS: &'static [bool];
    /// By the place of an input's bit: the groups that follow it.
    const FOLLOWED_BY: &'static [&'static [usize]];

    /// Takes one rising edge in all lanes.
    fn step<V: Vector>(
        inputs: &Self::Inputs,
        state: &mut Self::State,
        kept: &mut Self::Kept,
        settling: &mut Self::Settling,
    );

    /// Computes what is kept.
    fn keep<V: Vector>(inputs: &Self::Inputs, state: &Self::State, kept: &mut Self::Kept);
}

/// 512 copies of a design.
#[derive(Clone, Debug)]
pub struct Lanes<'a, K: LaneKernel> {
    circuit: &'a Circuit,
    clock: u64,
    held: Box<Held<K>>,
    vectors: Vectors,
    /// What is kept is to be computed.
    stale: bool,
    /// The last edge changed nothing, and neither will the next.
    resting: bool,
    /// The flip-flop that is looked at to see whether anything changes.
    watched: usize,
    /// How many edges the flip-flops looked at have stood still, one an edge.
    still: usize,
    /// Places of an input's bits, by signal; none for any other signal.
    ports: Vec<Range<usize>>,
}

/// Lanes of which each is a line of the cache: one that lies across two takes twice as long.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct OnLines<T>(T);

/// What all lanes hold.
#[derive(Clone, Debug)]
struct Held<K: LaneKernel> {
    inputs: OnLines<K::Inputs>,
    state: OnLines<K::State>,
    kept: OnLines<K::Kept>,
    settling: K::Settling,
}

impl<K: LaneKernel> Held<K> {
    /// Takes one rising edge; what is kept is `stale` when something was set from outside.
    #[inline(always)]
    fn step<V: Vector>(&mut self, stale: bool) {
        let Self { inputs, state, kept, settling } = self;
        if stale {
            K::keep::<V>(&inputs.0, &state.0, &mut kept.0);
        }
        K::step::<V>(&inputs.0, &mut state.0, &mut kept.0, settling);
    }
}

/// What lanes are computed with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Vectors {
    #[cfg(target_arch = "x86_64")]
    Bits512,
    #[cfg(target_arch = "x86_64")]
    Bits256,
    Plain,
}

impl<'a, K: LaneKernel> Lanes<'a, K> {
    /// All lanes at power-up, with all inputs low; `K` must be of the same design.
    #[must_use]
    pub fn new(circuit: &'a Circuit) -> Self {
        Self::by(circuit, Vectors::widest())
    }

    /// The same, computed with the given vectors.
    pub(super) fn by(circuit: &'a Circuit, vectors: Vectors) -> Self {
        let registers = &circuit.netlist().registers;
        let initial = pack(circuit.netlist(), registers.iter().map(|register| register.initial));
        let mut lanes = Self {
            circuit,
            clock: 0,
            held: Box::new(Held {
                inputs: OnLines(K::INPUTS),
                state: OnLines(K::STATE),
                kept: OnLines(K::KEPT),
                settling: K::SETTLING,
            }),
            vectors,
            stale: true,
            resting: false,
            watched: 0,
            still: 0,
            ports: ports(circuit.netlist()),
        };
        lanes.fill(&initial);
        lanes
    }

    /// The design.
    #[must_use]
    pub fn netlist(&self) -> &Netlist {
        self.circuit.netlist()
    }

    /// Rising edges taken since power-up.
    #[must_use]
    pub fn clock(&self) -> u64 {
        self.clock
    }

    /// Drives an input of all lanes alike.
    ///
    /// # Panics
    ///
    /// When the signal is not an input, or the value is wider than it.
    pub fn set_input(&mut self, input: SignalId, value: u64) {
        for (place, bit) in self.input_bits(input, value) {
            self.held.inputs.0.as_mut()[place] = [if bit { u64::MAX } else { 0 }; LANE_WORDS];
            self.input_changed(place);
        }
    }

    /// Drives an input of one lane.
    ///
    /// # Panics
    ///
    /// When the signal is not an input, the value is wider than it, or there is no such lane.
    pub fn set_input_of(&mut self, lane: usize, input: SignalId, value: u64) {
        for (place, bit) in self.input_bits(input, value) {
            set_bit(&mut self.held.inputs.0.as_mut()[place], lane, bit);
            self.input_changed(place);
        }
    }

    /// Flips one flip-flop of one lane.
    ///
    /// # Panics
    ///
    /// When there is no such lane or flip-flop.
    pub fn flip(&mut self, lane: usize, flip_flop: usize) {
        self.held.state.0.as_mut()[flip_flop][lane / 64] ^= 1 << (lane % 64);
        self.state_changed();
    }

    /// Puts all lanes into one state.
    ///
    /// # Panics
    ///
    /// When the design has more flip-flops.
    pub fn fill(&mut self, state: &FlipFlops) {
        for (bit, lanes) in state.iter().zip(self.held.state.0.as_mut()) {
            *lanes = [if *bit { u64::MAX } else { 0 }; LANE_WORDS];
        }
        self.state_changed();
    }

    /// Takes rising edges up to a clock number, with the inputs held.
    pub fn run_until(&mut self, clock: u64) {
        while self.clock < clock && !self.resting {
            self.step();
        }
        self.clock = clock.max(self.clock);
    }

    /// Takes one rising edge in all lanes.
    pub fn step(&mut self) {
        self.clock += 1;
        if self.resting {
            return;
        }
        let all = self.held.state.0.as_ref().len();
        if all <= self.still {
            return self.step_looking_at_all();
        }
        let before = self.watched_lanes();
        self.take_edge();
        if are_alike(self.watched_lanes(), before) {
            self.still += 1;
            self.watched = if self.watched + 1 < all { self.watched + 1 } else { 0 };
        } else {
            self.still = 0;
        }
    }

    /// Flip-flops have stood still, each when it was looked at.
    #[cold]
    fn step_looking_at_all(&mut self) {
        let before = self.held.state.clone();
        self.take_edge();
        self.resting = self.held.state.0.as_ref() == before.0.as_ref();
        self.still = 0;
    }

    /// The flip-flop that is looked at, if there is one.
    #[inline]
    fn watched_lanes(&self) -> Lane {
        self.held.state.0.as_ref().get(self.watched).copied().unwrap_or_default()
    }

    fn take_edge(&mut self) {
        let stale = std::mem::take(&mut self.stale);
        match self.vectors {
            #[cfg(target_arch = "x86_64")]
            Vectors::Bits512 => {
                // SAFETY: `Vectors::all` has found AVX-512F and AVX-512VL on this processor.
                unsafe { step_512(&mut self.held, stale) }
            }
            #[cfg(target_arch = "x86_64")]
            Vectors::Bits256 => {
                // SAFETY: `Vectors::all` has found AVX2 on this processor.
                unsafe { step_256(&mut self.held, stale) }
            }
            Vectors::Plain => self.held.step::<Lane>(stale),
        }
    }

    /// Notes that a bit of an input may have another level.
    fn input_changed(&mut self, place: usize) {
        self.resting = false;
        self.stale |= K::TELLS[place];
        for group in K::FOLLOWED_BY[place] {
            self.held.settling.as_mut()[*group] = K::SETTLING.as_ref()[*group];
        }
    }

    /// Notes that flip-flops may have other levels.
    fn state_changed(&mut self) {
        self.resting = false;
        self.stale = true;
        self.held.settling = K::SETTLING;
    }

    /// The flip-flops of one lane.
    ///
    /// # Panics
    ///
    /// When there is no such lane.
    #[must_use]
    pub fn flip_flops(&self, lane: usize) -> FlipFlops {
        let bits = self.held.state.0.as_ref().iter();
        bits.map(|lanes| lanes[lane / 64] >> (lane % 64) & 1 == 1).collect()
    }

    /// One bit a lane: set where any flip-flop differs from that of `reference`.
    ///
    /// # Panics
    ///
    /// When there is no such lane.
    #[must_use]
    pub fn unlike(&self, reference: usize) -> Lane {
        let mut unlike = [0; LANE_WORDS];
        for lanes in self.held.state.0.as_ref() {
            let bit = (lanes[reference / 64] >> (reference % 64) & 1).wrapping_neg();
            for (unlike, word) in unlike.iter_mut().zip(lanes) {
                *unlike |= word ^ bit;
            }
        }
        unlike
    }

    /// Places of the bits of an input, with their levels.
    #[inline]
    fn input_bits(
        &self,
        input: SignalId,
        value: u64,
    ) -> impl Iterator<Item = (usize, bool)> + use<K> {
        let places = self.ports[input.0 as usize].clone();
        let bits = u64::BITS - value.leading_zeros();
        if places.is_empty() || places.len() < bits as usize {
            self.circuit.refuse(input, value);
        }
        places.enumerate().map(move |(bit, place)| (place, value >> bit & 1 == 1))
    }
}

impl Vectors {
    /// All that this processor has, the widest first.
    pub(super) fn all() -> Vec<Self> {
        let mut all = vec![];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
                all.push(Self::Bits512);
            }
            if is_x86_feature_detected!("avx2") {
                all.push(Self::Bits256);
            }
        }
        all.push(Self::Plain);
        all
    }

    fn widest() -> Self {
        Self::all()[0]
    }
}

/// Places of an input's bits, by signal.
fn ports(netlist: &Netlist) -> Vec<Range<usize>> {
    let mut ports = vec![0..0; netlist.signals.len()];
    let mut low = 0;
    for input in &netlist.inputs {
        let high = low + netlist.signal(*input).width as usize;
        ports[input.0 as usize] = low..high;
        low = high;
    }
    ports
}

/// Word by word: as lists they would be handed to a function that compares bytes.
#[inline]
fn are_alike(a: Lane, b: Lane) -> bool {
    a.iter().zip(b).fold(0, |unlike, (a, b)| unlike | (a ^ b)) == 0
}

fn set_bit(lanes: &mut Lane, lane: usize, bit: bool) {
    let mask = 1 << (lane % 64);
    if bit {
        lanes[lane / 64] |= mask;
    } else {
        lanes[lane / 64] &= !mask;
    }
}

/// The same code, compiled for vectors of 512 bits and three-input logic.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl")]
fn step_512<K: LaneKernel>(held: &mut Held<K>, stale: bool) {
    held.step::<Bits512>(stale);
}

/// The same code, compiled for vectors of 256 bits.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn step_256<K: LaneKernel>(held: &mut Held<K>, stale: bool) {
    held.step::<Bits256>(stale);
}
