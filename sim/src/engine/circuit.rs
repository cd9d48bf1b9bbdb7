//! A design with what an engine looks up in it.

use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::partition::Partition;
use helixlock_netlist::{Netlist, Signal, SignalId, mask};

/// Where the value of a signal is found without evaluating anything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// Index in [`Netlist::inputs`].
    Input(usize),
    /// Index in [`Netlist::registers`].
    Register(usize),
    /// Index in [`Partition::nets`].
    Net(usize),
    /// Nowhere: logic is to be evaluated.
    Logic,
}

/// A netlist, its pieces, and the place of every signal.
#[derive(Clone, Debug)]
pub struct Circuit {
    netlist: Netlist,
    partition: Partition,
    /// One a signal.
    places: Vec<Place>,
    /// One a signal: the index in [`Partition::nets`] of the one that shows it, if one does.
    nets: Vec<Option<usize>>,
    /// One a register: its counter, if it is one.
    counters: Vec<Option<usize>>,
}

impl Circuit {
    /// Cuts a netlist into pieces.
    #[must_use]
    pub fn new(netlist: Netlist) -> Self {
        let partition = Partition::new(&netlist);
        let (places, nets) = places(&netlist, &partition);
        let counters = (0..netlist.registers.len())
            .map(|register| {
                partition.counters.iter().position(|piece| piece.counter.register == register)
            })
            .collect();
        Self { netlist, partition, places, nets, counters }
    }

    /// The netlist.
    #[must_use]
    pub fn netlist(&self) -> &Netlist {
        &self.netlist
    }

    /// The pieces.
    #[must_use]
    pub fn partition(&self) -> &Partition {
        &self.partition
    }

    pub(crate) fn place(&self, signal: SignalId) -> Place {
        self.places[signal.0 as usize]
    }

    /// The net that shows a signal; also of a register, when others see it through one.
    pub(crate) fn net_of(&self, signal: SignalId) -> Option<usize> {
        self.nets[signal.0 as usize]
    }

    pub(crate) fn counter_of(&self, register: usize) -> Option<usize> {
        self.counters[register]
    }

    pub(crate) fn register_slot(&self, register: usize) -> usize {
        self.netlist.inputs.len() + register
    }

    pub(crate) fn net_slot(&self, net: usize) -> usize {
        self.netlist.inputs.len() + self.netlist.registers.len() + net
    }

    pub(crate) fn slots(&self) -> usize {
        self.net_slot(self.partition.nets.len())
    }

    /// Counters that one of the signals shows as they are.
    pub(crate) fn counters_shown_by(&self, signals: &[SignalId]) -> Vec<usize> {
        let shown = |index: &usize| {
            let shown = &self.partition.counters[*index].counter.shown;
            signals.iter().any(|signal| shown.contains(signal))
        };
        (0..self.partition.counters.len()).filter(shown).collect()
    }

    /// Index of an input in port order.
    ///
    /// # Panics
    ///
    /// When the signal is no input, or the value is wider than it.
    pub(crate) fn input_index(&self, input: SignalId, value: u64) -> usize {
        match self.place(input) {
            Place::Input(index) if value <= mask(self.netlist.signal(input).width) => index,
            _ => self.refuse(input, value),
        }
    }

    /// Says why a signal takes no such value from outside.
    ///
    /// # Panics
    ///
    /// Always.
    #[cold]
    pub(crate) fn refuse(&self, input: SignalId, value: u64) -> ! {
        let Signal { path, width } = self.netlist.signal(input);
        assert!(value <= mask(*width), "{value} fits `{path}`");
        panic!("`{path}` is an input");
    }
}

fn places(netlist: &Netlist, partition: &Partition) -> (Vec<Place>, Vec<Option<usize>>) {
    let drivers = Drivers::new(netlist);
    let mut nets = vec![None; netlist.signals.len()];
    for (index, net) in partition.nets.iter().enumerate() {
        nets[net.signal.0 as usize] = Some(index);
    }
    let place = |signal| {
        let origin = drivers.origin(signal);
        match (nets[origin.0 as usize], drivers.of(origin)) {
            (_, Driver::Input(index)) if origin == signal => Place::Input(index),
            (_, Driver::Register(index)) => Place::Register(index),
            (Some(net), _) => Place::Net(net),
            _ => Place::Logic,
        }
    };
    let signals = (0..).map(SignalId).take(netlist.signals.len());
    let shown = signals.clone().map(|signal| nets[drivers.origin(signal).0 as usize]);
    (signals.map(place).collect(), shown.collect())
}
