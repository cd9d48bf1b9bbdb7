//! What packed registers do while nothing else is called upon, remembered.
//!
//! From the same bits the same follows, clock by clock, until an edge is busy, or nothing changes any
//! more: after a pin has changed, a synchroniser's flip-flops one after the other. Bits that have been
//! met once are followed by one glance.

use super::dense::{DenseKernel, Edge, Known};

/// Edges in one trace at most: longer ones go on with another.
const LONGEST: u64 = 16;

/// Traces remembered; a new one takes the place of another.
const REMEMBERED: usize = 1024;

/// How a trace ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// At its longest: another begins here.
    Cut,
    /// The next edge is busy.
    Busy,
    /// No further edge changes anything but counters that coast.
    Rest,
    /// The last edge has changed what is watched.
    Changed,
}

/// Edges that are not busy, one after the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trace {
    from: Known,
    /// What is known after them.
    pub(super) to: Known,
    /// Number of edges.
    pub(super) clocks: u64,
    pub(super) end: End,
    /// Outputs that follow from what is known, before and after.
    pub(super) shown: [u64; 2],
    /// What the tables say of the edge behind it.
    pub(super) behind: Edge,
}

/// Traces of one kernel, by the bits that they begin with.
#[derive(Clone, Debug)]
pub(super) struct Traces {
    places: Vec<Option<Trace>>,
    /// Outputs that end a trace.
    watched: u64,
}

impl Traces {
    /// None yet.
    pub(super) fn watching(watched: u64) -> Self {
        Self { places: vec![None; REMEMBERED], watched }
    }

    /// Outputs that are watched.
    pub(super) fn watched(&self) -> u64 {
        self.watched
    }

    /// The trace that begins with these bits; `look` asks the tables.
    #[inline(always)]
    pub(super) fn from<K: DenseKernel>(
        &mut self,
        known: Known,
        busy: u64,
        look: impl Fn(Known) -> Edge,
    ) -> &Trace {
        let place = place(known);
        let is_met = |trace: &Trace| trace.from.difference(known) == 0;
        if !self.places[place].as_ref().is_some_and(is_met) {
            self.places[place] = Some(followed::<K>(known, self.watched, busy, look));
        }
        let found = self.places[place].as_ref();
        found.expect("it has just been found or put there")
    }
}

/// Follows bits as far as a trace goes.
#[cold]
#[inline(never)]
fn followed<K: DenseKernel>(
    from: Known,
    watched: u64,
    busy: u64,
    look: impl Fn(Known) -> Edge,
) -> Trace {
    let before = K::shown(from);
    let (clocks, end, behind) = (0, End::Cut, look(from));
    let mut trace = Trace { from, to: from, clocks, end, shown: [before; 2], behind };
    while trace.clocks < LONGEST {
        let Edge { next, found, .. } = trace.behind;
        if found & busy != 0 {
            return Trace { end: End::Busy, ..trace };
        }
        if next.difference(trace.to) == 0 {
            return Trace { end: End::Rest, ..trace };
        }
        trace.to = next;
        trace.behind = look(next);
        trace.clocks += 1;
        trace.shown[1] = K::shown(next);
        if (trace.shown[1] ^ before) & watched != 0 {
            return Trace { end: End::Changed, ..trace };
        }
    }
    trace
}

/// By a product of all bits.
#[inline]
fn place(Known { early, late }: Known) -> usize {
    let mixed = (early ^ late.rotate_left(32)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    usize::try_from(mixed >> (u64::BITS - REMEMBERED.ilog2())).expect("a place is a small number")
}
