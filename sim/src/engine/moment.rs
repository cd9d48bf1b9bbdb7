//! A moment of a design in pieces, and what the code of the pieces does to it.

use helixlock_netlist::mask;
use helixlock_netlist::settle::clocks_within;

use super::all_signals::AllSignals;

/// Code that evaluates the pieces of a design; see [`helixlock_netlist::partition`].
///
/// Bits of the word arrays are numbered from the lowest bit of the first word. Slots hold the inputs,
/// the registers and the nets, in that order.
pub trait Kernel: AllSignals + Sized {
    /// One word an input, register, net.
    type Slots: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One bit a net, then one a counter's mode.
    type Nets: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One bit a group, then one a counter's load.
    type Groups: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One a counter.
    type Counters: AsRef<[Coasting]> + AsMut<[Coasting]> + Clone + std::fmt::Debug;

    /// A moment with all words zero.
    fn blank(&self) -> Moment<Self>;

    /// Evaluates a net or mode; what is new calls upon its readers.
    fn net(&self, index: usize, now: &mut Moment<Self>);

    /// Takes the edge for a group or load; what is new calls upon its readers.
    fn group(&self, index: usize, now: &mut Moment<Self>);

    /// Calls upon the readers of an input.
    fn input_changed(&self, index: usize, now: &mut Moment<Self>);

    /// Calls upon the readers of a counter and its own mode.
    fn counter_moved(&self, index: usize, now: &mut Moment<Self>);
}

/// How a counter moves: its value at `clock` is its slot plus `step · (clock − since)`.
#[derive(Clone, Copy, Debug)]
pub struct Coasting {
    slot: usize,
    width: u32,
    step: u64,
    since: u64,
    /// The clock at which it has left its stretch.
    wake: u64,
    /// What it is loaded with at this edge.
    next: u64,
}

impl Coasting {
    /// A counter of `width` bits in a slot, that stays as it is.
    #[must_use]
    pub const fn rest(slot: usize, width: u32) -> Self {
        Self { slot, width, step: 0, since: 0, wake: u64::MAX, next: 0 }
    }
}

/// Values, and who is called upon to look at them.
#[derive(Clone, Debug)]
pub struct Moment<K: Kernel> {
    /// Rising edges taken.
    pub clock: u64,
    /// Inputs, registers, nets.
    pub slots: K::Slots,
    /// Nets and modes called upon.
    pub nets: K::Nets,
    /// Groups and loads called upon.
    pub groups: K::Groups,
    /// Nets that have changed since this was last cleared.
    pub changed: K::Nets,
    counters: K::Counters,
    /// One bit a counter that takes its `next` at this edge.
    loading: u64,
    /// The first clock at which a counter has left its stretch.
    wake: u64,
}

impl<K: Kernel> Moment<K> {
    /// A moment at clock number 0.
    pub fn new(slots: K::Slots, nets: K::Nets, groups: K::Groups, counters: K::Counters) -> Self {
        let changed = nets.clone();
        Self { clock: 0, slots, nets, groups, changed, counters, loading: 0, wake: u64::MAX }
    }

    /// The value of a counter now.
    #[inline]
    pub fn counter(&self, index: usize) -> u64 {
        let counter = &self.counters.as_ref()[index];
        let moved = counter.step.wrapping_mul(self.clock.wrapping_sub(counter.since));
        self.slots.as_ref()[counter.slot].wrapping_add(moved) & mask(counter.width)
    }

    /// Sets how a counter moves from now on: by `step` a clock, until it leaves the stretch between
    /// its `thresholds`.
    #[inline]
    pub fn count(&mut self, index: usize, step: u64, thresholds: &[u64]) {
        let value = self.counter(index);
        let counter = &mut self.counters.as_mut()[index];
        let clocks = thresholds
            .iter()
            .map(|threshold| clocks_within(value, step, *threshold, counter.width))
            .min()
            .unwrap_or(u64::MAX);
        counter.step = step;
        counter.since = self.clock;
        counter.wake = self.clock.saturating_add(clocks);
        self.slots.as_mut()[counter.slot] = value;
        self.wake = self.first_wake();
    }

    /// Has a counter take a value at this edge, unless it has it already.
    #[inline]
    pub fn load(&mut self, index: usize, value: u64) {
        if self.counter(index) != value {
            self.counters.as_mut()[index].next = value;
            self.loading |= 1 << index;
        }
    }

    /// Goes on from other inputs and registers: everything is to be looked at again.
    pub(crate) fn start(&mut self, clock: u64, nets: usize, groups: usize) {
        self.clock = clock;
        for counter in self.counters.as_mut() {
            *counter = Coasting::rest(counter.slot, counter.width);
        }
        self.loading = 0;
        self.wake = u64::MAX;
        fill_bits(self.nets.as_mut(), nets + self.counters.as_ref().len());
        fill_bits(self.groups.as_mut(), groups);
    }

    /// Lets everything follow the inputs and registers, at once.
    #[inline]
    pub(crate) fn settle(&mut self, kernel: &K) {
        for word in 0..self.nets.as_ref().len() {
            // A net calls upon later ones only, so each is evaluated once.
            while self.nets.as_ref()[word] != 0 {
                let index = take_bit(&mut self.nets.as_mut()[word]);
                kernel.net(64 * word + index, self);
            }
        }
    }

    /// True when the next edge changes nothing but counters that move on.
    #[inline]
    pub(crate) fn rests(&self) -> bool {
        self.groups.as_ref().iter().all(|word| *word == 0)
    }

    /// Takes an edge, from settled nets to nets not yet settled.
    #[inline]
    pub(crate) fn edge(&mut self, kernel: &K) {
        for word in 0..self.groups.as_ref().len() {
            // Who is called upon from here on is meant for the edge after this one.
            let mut called = std::mem::take(&mut self.groups.as_mut()[word]);
            while called != 0 {
                let index = take_bit(&mut called);
                kernel.group(64 * word + index, self);
            }
        }
        self.pass(kernel, self.clock + 1);
    }

    /// Lets time pass to a clock not behind the next wake; loads are taken with it.
    #[inline]
    pub(crate) fn pass(&mut self, kernel: &K, clock: u64) {
        self.clock = clock;
        while self.loading != 0 {
            let index = take_bit(&mut self.loading);
            self.take_load(kernel, index);
        }
        if self.wake <= clock {
            self.wake_counters(kernel);
        }
    }

    /// True when a counter is another one at the next clock.
    pub(crate) fn moves(&self, index: usize) -> bool {
        self.counters.as_ref()[index].step != 0
    }

    /// The next clock at which something happens by itself, `until` at the latest.
    #[inline]
    pub(crate) fn next_event(&self, until: u64) -> u64 {
        self.wake.min(until)
    }

    fn take_load(&mut self, kernel: &K, index: usize) {
        let counter = &mut self.counters.as_mut()[index];
        self.slots.as_mut()[counter.slot] = counter.next;
        *counter = Coasting::rest(counter.slot, counter.width);
        kernel.counter_moved(index, self);
    }

    fn wake_counters(&mut self, kernel: &K) {
        for index in 0..self.counters.as_ref().len() {
            if self.counters.as_ref()[index].wake <= self.clock {
                kernel.counter_moved(index, self);
            }
        }
    }

    fn first_wake(&self) -> u64 {
        self.counters.as_ref().iter().map(|counter| counter.wake).min().unwrap_or(u64::MAX)
    }
}

/// Clears the lowest bit set and gives its number.
fn take_bit(word: &mut u64) -> usize {
    let index = word.trailing_zeros() as usize;
    *word &= *word - 1;
    index
}

/// Sets the first `count` bits.
fn fill_bits(words: &mut [u64], count: usize) {
    for (index, word) in words.iter_mut().enumerate() {
        let bits = u32::try_from(count.saturating_sub(64 * index).min(64)).unwrap_or(64);
        *word = if bits == 0 { 0 } else { mask(bits) };
    }
}
