//! Many copies of a design at once, one bit a copy.
//!
//! Bit `n % 64` of word `n / 64` of every flip-flop belongs to copy (lane) n. All lanes take each
//! clock together; their inputs and flip-flops may differ. Where nothing rests and many copies are
//! wanted this is the fastest engine per copy; where most clocks are idle, [`crate::Leap`] is.

use helixlock_netlist::{Netlist, SignalId};

use super::circuit::{Circuit, Place};
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

/// Straight-line code for all lanes of a design.
pub trait LaneKernel {
    /// Bits of the inputs, in port order, lowest first.
    type Inputs: AsRef<[Lane]> + AsMut<[Lane]> + Clone + std::fmt::Debug;
    /// Flip-flops, in the order of [`FlipFlops`].
    type State: AsRef<[Lane]> + AsMut<[Lane]> + Clone + std::fmt::Debug;
    /// All low.
    const INPUTS: Self::Inputs;
    /// All clear.
    const STATE: Self::State;

    /// Takes one rising edge in all lanes.
    fn step<V: Vector>(inputs: &Self::Inputs, now: &Self::State, next: &mut Self::State);
}

/// 512 copies of a design.
#[derive(Clone, Debug)]
pub struct Lanes<'a, K: LaneKernel> {
    circuit: &'a Circuit,
    clock: u64,
    inputs: Box<K::Inputs>,
    now: Box<K::State>,
    next: Box<K::State>,
    vectors: Vectors,
}

/// The widest vectors the processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Vectors {
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
        let registers = &circuit.netlist().registers;
        let initial = pack(circuit.netlist(), registers.iter().map(|register| register.initial));
        let mut lanes = Self {
            circuit,
            clock: 0,
            inputs: Box::new(K::INPUTS),
            now: Box::new(K::STATE),
            next: Box::new(K::STATE),
            vectors: Vectors::widest(),
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
            self.inputs.as_mut().as_mut()[place] = [if bit { u64::MAX } else { 0 }; LANE_WORDS];
        }
    }

    /// Drives an input of one lane.
    ///
    /// # Panics
    ///
    /// When the signal is not an input, the value is wider than it, or there is no such lane.
    pub fn set_input_of(&mut self, lane: usize, input: SignalId, value: u64) {
        for (place, bit) in self.input_bits(input, value) {
            set_bit(&mut self.inputs.as_mut().as_mut()[place], lane, bit);
        }
    }

    /// Flips one flip-flop of one lane.
    ///
    /// # Panics
    ///
    /// When there is no such lane or flip-flop.
    pub fn flip(&mut self, lane: usize, flip_flop: usize) {
        self.now.as_mut().as_mut()[flip_flop][lane / 64] ^= 1 << (lane % 64);
    }

    /// Puts all lanes into one state.
    ///
    /// # Panics
    ///
    /// When the design has more flip-flops.
    pub fn fill(&mut self, state: &FlipFlops) {
        for (bit, lanes) in state.iter().zip(self.now.as_mut().as_mut()) {
            *lanes = [if *bit { u64::MAX } else { 0 }; LANE_WORDS];
        }
    }

    /// Takes rising edges up to a clock number, with the inputs held.
    pub fn run_until(&mut self, clock: u64) {
        while self.clock < clock {
            self.step();
        }
    }

    /// Takes one rising edge in all lanes.
    pub fn step(&mut self) {
        match self.vectors {
            #[cfg(target_arch = "x86_64")]
            Vectors::Bits512 => {
                // SAFETY: `Vectors::widest` has found AVX-512F and AVX-512VL on this processor.
                unsafe { step_512::<K>(&self.inputs, &self.now, &mut self.next) }
            }
            #[cfg(target_arch = "x86_64")]
            Vectors::Bits256 => {
                // SAFETY: `Vectors::widest` has found AVX2 on this processor.
                unsafe { step_256::<K>(&self.inputs, &self.now, &mut self.next) }
            }
            Vectors::Plain => K::step::<Lane>(&self.inputs, &self.now, &mut self.next),
        }
        std::mem::swap(&mut self.now, &mut self.next);
        self.clock += 1;
    }

    /// The flip-flops of one lane.
    ///
    /// # Panics
    ///
    /// When there is no such lane.
    #[must_use]
    pub fn flip_flops(&self, lane: usize) -> FlipFlops {
        let bits = self.now.as_ref().as_ref().iter();
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
        for lanes in self.now.as_ref().as_ref() {
            let bit = (lanes[reference / 64] >> (reference % 64) & 1).wrapping_neg();
            for (unlike, word) in unlike.iter_mut().zip(lanes) {
                *unlike |= word ^ bit;
            }
        }
        unlike
    }

    /// Places of the bits of an input, with their levels.
    fn input_bits(
        &self,
        input: SignalId,
        value: u64,
    ) -> impl Iterator<Item = (usize, bool)> + use<'a, K> {
        let index = self.circuit.input_index(input, value);
        debug_assert_eq!(self.circuit.place(input), Place::Input(index));
        let netlist = self.circuit.netlist();
        let widths = netlist.inputs.iter().map(|input| netlist.signal(*input).width as usize);
        let low: usize = widths.take(index).sum();
        let width = netlist.signal(input).width as usize;
        (0..width).map(move |bit| (low + bit, value >> bit & 1 == 1))
    }
}

impl Vectors {
    fn widest() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512vl") {
                return Self::Bits512;
            }
            if is_x86_feature_detected!("avx2") {
                return Self::Bits256;
            }
        }
        Self::Plain
    }
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
fn step_512<K: LaneKernel>(inputs: &K::Inputs, now: &K::State, next: &mut K::State) {
    K::step::<Bits512>(inputs, now, next);
}

/// The same code, compiled for vectors of 256 bits.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn step_256<K: LaneKernel>(inputs: &K::Inputs, now: &K::State, next: &mut K::State) {
    K::step::<Bits256>(inputs, now, next);
}
