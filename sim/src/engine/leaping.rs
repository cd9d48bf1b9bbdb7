//! The engine that leaps, compiled ahead of time: what comes of a pin change is looked up as a whole,
//! and when nothing changes any more, it jumps to the clock at which something happens.
//!
//! ```text
//! clock         0 1 2 3 4 5 6 ················ 4711 4712 4713 4714
//! laser         ▁▔▔▔▔▔▔▔▔▔▔▔▔
//! synchroniser  ▁▁▔▔▔▔▔▔▔▔▔▔▔                                        a trace
//! divider       · · · ×                                              a busy edge, taken at ×
//! step clock    9 8 7 6 5 4 3 ················    2    1    0        known without stepping
//!                           └─── one jump ───┘
//! ```
//!
//! The result is that of stepping every clock, flip-flop by flip-flop. A design whose tables do not
//! tell when an edge is busy is stepped clock by clock.

use helixlock_netlist::settle::clocks_within;
use helixlock_netlist::{Netlist, SignalId};

use super::all_signals::Evaluated;
use super::circuit::{Circuit, Place};
use super::dense::{Coast, DenseKernel, Edge, Known, Machine};
use super::gather::{Gather, Gathering, Work};
use super::state::{FlipFlops, Snapshot};
use super::traces::{End, Traces};
use super::{Engine, Stop};

/// Leaps through a design with the code `K`.
#[derive(Clone, Debug)]
pub struct Leaping<'a, K: DenseKernel> {
    circuit: &'a Circuit,
    by: Gathering,
    run: Run<K>,
    /// One a signal: its place among outputs that follow from what is known.
    shown: Vec<Option<u32>>,
    /// What these are, and of what: several are read at one clock.
    last_shown: (Known, u64),
    /// Watched signals of which traces know nothing, with the values they had.
    watched_others: Vec<(SignalId, u64)>,
    /// A watched signal shows a counter that coasts.
    watches_counter: bool,
    evaluated: Evaluated,
}

/// What the edges behind one change, all of them alike until an input changes or a counter wakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Behind {
    /// Not known.
    More,
    /// Counters alone, which coast.
    Coasting,
    /// Nothing.
    Nothing,
}

/// A machine with counters that coast.
#[derive(Clone, Debug)]
struct Run<K: DenseKernel> {
    /// Counters that coast have the values they had at clock `since`.
    machine: Machine<K>,
    since: u64,
    /// The clock at which a counter has left its stretch.
    wake: u64,
    traces: Traces,
}

impl<'a, K: DenseKernel> Leaping<'a, K> {
    /// The design at power-up, with all inputs low; `K` must be of the same design.
    #[must_use]
    pub fn new(circuit: &'a Circuit) -> Self {
        Self::by(circuit, Gathering::best())
    }

    /// The same, by the given way of gathering bits.
    pub(super) fn by(circuit: &'a Circuit, by: Gathering) -> Self {
        let netlist = circuit.netlist();
        let mut shown = vec![None; netlist.signals.len()];
        for (output, place) in netlist.outputs.iter().zip(K::SHOWN) {
            shown[output.0 as usize] = *place;
        }
        let machine = Machine::new(netlist);
        let mut run = Run { machine, since: 0, wake: 0, traces: Traces::watching(0) };
        run.find_wake();
        Self {
            circuit,
            by,
            last_shown: (run.machine.known, K::shown(run.machine.known)),
            run,
            shown,
            watched_others: Vec::new(),
            watches_counter: false,
            evaluated: Evaluated::new(circuit),
        }
    }

    /// Outputs that follow from what is known.
    fn shown_now(&mut self) -> u64 {
        self.run.settle();
        let known = self.run.machine.known;
        if known.difference(self.last_shown.0) != 0 {
            self.last_shown = (known, K::shown(known));
        }
        self.last_shown.1
    }

    fn evaluate(&mut self) -> &[u64] {
        self.run.settle();
        if !self.evaluated.is_fresh() {
            self.run.catch_up();
            let machine = &self.run.machine;
            let (inputs, registers) = (machine.inputs.as_ref(), machine.joined());
            self.evaluated.renew(&K::default(), inputs, registers.as_ref());
        }
        self.evaluated.values()
    }

    /// Notes the values of watched signals of which traces know nothing; true when one is another.
    fn note_watched_others(&mut self) -> bool {
        let mut others = std::mem::take(&mut self.watched_others);
        let mut changed = false;
        let all = self.evaluate();
        for (signal, before) in &mut others {
            let value = all[signal.0 as usize];
            changed |= std::mem::replace(before, value) != value;
        }
        self.watched_others = others;
        changed
    }

    /// Edge by edge while anything changes.
    #[inline(never)]
    fn run_watching(&mut self, clock: u64) -> Stop {
        self.note_watched_others();
        let watched = self.run.traces.watched();
        while self.run.machine.clock < clock {
            self.run.settle();
            let before = K::shown(self.run.machine.known);
            let next = self.run.machine.clock + 1;
            let until = if self.watches_counter { next } else { clock };
            self.by.have(OneEdge(&mut self.run, until));
            self.evaluated.forget();
            // Others first: their values are noted even when an output has changed.
            let others = self.note_watched_others();
            if others || (K::shown(self.run.machine.known) ^ before) & watched != 0 {
                return Stop::Changed;
            }
        }
        Stop::Reached
    }
}

impl<K: DenseKernel> Run<K> {
    /// Gives counters the values they have now.
    #[inline]
    fn catch_up(&mut self) {
        coast(&mut self.machine, self.since);
        self.since = self.machine.clock;
    }

    /// Has everything follow the inputs.
    #[inline]
    fn settle(&mut self) {
        if self.machine.is_stale() {
            self.catch_up();
            self.machine.settle();
        }
    }

    /// As it is, with counters as they are.
    fn now(&self) -> Machine<K> {
        let mut machine = self.machine.clone();
        coast(&mut machine, self.since);
        machine
    }

    /// Finds when counters that have just been stepped, or set, leave their stretches.
    #[inline]
    fn find_wake(&mut self) {
        let clocks =
            K::COASTING.iter().flat_map(|Coast { register, width, step, thresholds, .. }| {
                let value = self.machine.registers.as_ref()[*register];
                thresholds
                    .iter()
                    .map(move |threshold| clocks_within(value, *step, *threshold, *width))
            });
        self.since = self.machine.clock;
        self.wake = self.since.saturating_add(clocks.min().unwrap_or(u64::MAX));
    }

    /// Takes an edge with all that it changes.
    #[inline(always)]
    fn edge<G: Gather>(&mut self) -> Behind {
        let Machine { inputs, registers, kept, known, .. } = &self.machine;
        let edge = K::look::<G>(inputs, registers, kept, *known);
        self.take(edge)
    }

    /// The same for one that has been looked at.
    #[inline(always)]
    fn take(&mut self, edge: Edge) -> Behind {
        self.catch_up();
        let counter = |machine: &Machine<K>| {
            K::COASTING.first().map(|coast| machine.registers.as_ref()[coast.register])
        };
        let before = counter(&self.machine);
        self.machine.take(edge);
        self.find_wake();
        let same = self.machine.known.difference(edge.known) == 0;
        if !same || 1 < K::COASTING.len() || !self.machine.rest.is_settled() {
            return Behind::More;
        }
        let after = counter(&self.machine);
        let coasted = before.zip(K::COASTING.first()).map(|(value, coast)| coast.after(value, 1));
        match after {
            _ if after == before => Behind::Nothing,
            _ if after == coasted => Behind::Coasting,
            _ => Behind::More,
        }
    }

    /// Goes to this clock at the farthest, while counters do nothing but coast.
    #[inline]
    fn coast_to(&mut self, clock: u64) {
        self.machine.clock = clock.min(self.wake - 1).max(self.machine.clock);
    }
}

/// Leaps to this clock, or to the first edge that changes what is watched.
struct Leaps<'a, K: DenseKernel>(&'a mut Run<K>, u64);

impl<K: DenseKernel> Work for Leaps<'_, K> {
    type Answer = Stop;

    #[inline(always)]
    fn work<G: Gather>(self) -> Stop {
        let Self(run, clock) = self;
        run.settle();
        let Some(busy) = K::BUSY else { return step_all::<K, G>(run, clock) };
        // What was shown before an edge that was taken by itself.
        let mut before = None;
        loop {
            let Run { machine, traces, wake, .. } = &mut *run;
            let Machine { inputs, registers, kept, known, .. } = &*machine;
            let look = |known| K::look::<G>(inputs, registers, kept, known);
            let watched = traces.watched();
            let trace = traces.from::<K>(*known, busy, look);
            if before.is_some_and(|shown| (shown ^ trace.shown[0]) & watched != 0) {
                return Stop::Changed;
            }
            if clock <= machine.clock {
                return Stop::Reached;
            }
            // The edge that takes a counter out of its stretch is one to be taken by itself.
            let calm = clock.min(*wake - 1);
            let behind = if trace.clocks <= calm.saturating_sub(machine.clock) {
                machine.clock += trace.clocks;
                machine.known = trace.to;
                before = Some(trace.shown[1]);
                match trace.end {
                    End::Changed => return Stop::Changed,
                    End::Cut => continue,
                    End::Rest => {
                        machine.clock = calm;
                        if calm == clock {
                            return Stop::Reached;
                        }
                        run.edge::<G>()
                    }
                    End::Busy if machine.clock == clock => return Stop::Reached,
                    End::Busy => {
                        let edge = trace.behind;
                        run.take(edge)
                    }
                }
            } else {
                before = Some(trace.shown[0]);
                run.edge::<G>()
            };
            match behind {
                Behind::More => {}
                Behind::Coasting => run.coast_to(clock),
                Behind::Nothing => {
                    run.machine.clock = clock;
                    run.find_wake();
                    return Stop::Reached;
                }
            }
        }
    }
}

/// Every clock; what is watched is looked at.
fn step_all<K: DenseKernel, G: Gather>(run: &mut Run<K>, clock: u64) -> Stop {
    let watched = run.traces.watched();
    while run.machine.clock < clock {
        let before = K::shown(run.machine.known);
        run.edge::<G>();
        if (K::shown(run.machine.known) ^ before) & watched != 0 {
            return Stop::Changed;
        }
    }
    Stop::Reached
}

/// Takes one edge, or leaps to this clock at the farthest when nothing changes.
struct OneEdge<'a, K: DenseKernel>(&'a mut Run<K>, u64);

impl<K: DenseKernel> Work for OneEdge<'_, K> {
    type Answer = ();

    #[inline(always)]
    fn work<G: Gather>(self) {
        let Self(run, clock) = self;
        run.settle();
        let Machine { inputs, registers, kept, known, .. } = &run.machine;
        let Edge { next, found, .. } = K::look::<G>(inputs, registers, kept, *known);
        let calm = clock.min(run.wake - 1);
        let rests = K::BUSY.is_some_and(|busy| found & busy == 0 && next.difference(*known) == 0);
        if rests && run.machine.clock < calm {
            run.machine.clock = calm;
        } else if run.edge::<G>() == Behind::Coasting {
            run.coast_to(clock);
        }
    }
}

/// Gives counters that had their values at clock `since` those that they have now.
#[inline]
fn coast<K: DenseKernel>(machine: &mut Machine<K>, since: u64) {
    for coast in K::COASTING {
        let value = &mut machine.registers.as_mut()[coast.register];
        *value = coast.after(*value, machine.clock - since);
    }
}

impl<K: DenseKernel> Engine for Leaping<'_, K> {
    fn netlist(&self) -> &Netlist {
        self.circuit.netlist()
    }

    fn clock(&self) -> u64 {
        self.run.machine.clock
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        if !self.run.machine.set_input(input, value) {
            self.circuit.refuse(input, value);
        }
        self.evaluated.forget();
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        if let Some(place) = self.shown[signal.0 as usize] {
            return self.shown_now() >> place & 1;
        }
        match self.circuit.place(signal) {
            Place::Input(index) => self.run.machine.inputs.as_ref()[index],
            Place::Register(index) => {
                self.run.catch_up();
                self.run.machine.joined().as_ref()[index]
            }
            Place::Net(_) | Place::Logic => self.evaluate()[signal.0 as usize],
        }
    }

    fn values(&mut self, signals: &[SignalId], values: &mut Vec<u64>) {
        let all = self.evaluate();
        values.clear();
        values.extend(signals.iter().map(|signal| all[signal.0 as usize]));
    }

    fn step(&mut self) {
        self.evaluated.forget();
        let next = self.run.machine.clock + 1;
        self.by.have(OneEdge(&mut self.run, next));
    }

    fn watch(&mut self, signals: &[SignalId]) {
        let mut watched = 0;
        self.watched_others.clear();
        let coasts = |counter: &usize| {
            let register = self.circuit.partition().counters[*counter].counter.register;
            let output = self.circuit.netlist().registers[register].output;
            K::COASTING.iter().any(|coast| coast.output == output)
        };
        self.watches_counter = self.circuit.counters_shown_by(signals).iter().any(coasts);
        for signal in signals {
            match (self.shown[signal.0 as usize], self.circuit.place(*signal)) {
                (Some(place), _) => watched |= 1 << place,
                (None, Place::Input(_)) => {}
                (None, _) => self.watched_others.push((*signal, 0)),
            }
        }
        self.run.traces = Traces::watching(watched);
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        if !self.watched_others.is_empty() {
            return self.run_watching(clock);
        }
        self.evaluated.forget();
        self.by.have(Leaps(&mut self.run, clock))
    }

    fn flip_flops(&self) -> FlipFlops {
        self.run.now().flip_flops(self.circuit.netlist())
    }

    fn snapshot(&self) -> Snapshot {
        self.run.now().snapshot(self.circuit.netlist())
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.run.machine.restore(self.circuit.netlist(), snapshot);
        self.run.find_wake();
        self.evaluated.forget();
    }
}
