//! A figure and its synchronous block, side by side.

use std::collections::BTreeMap;

use helixlock_netlist::{Netlist, SignalId};
use helixlock_original::{Circuit, Delays, Edge, Error, Finding, Simulator};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::drives::{Drive, Move, Output};
use crate::engine::{Engine, Interpreter};

/// Shortest and longest pulse, and pause behind it, ps; a divider's clear is over in 1.4 µs.
const WIDTH_PS: [u64; 2] = [500_000, 3_000_000];
const PAUSE_PS: [u64; 2] = [3_000_000, 9_000_000];

/// Clocks that the synchronous block gets for a pulse, and to rest.
const CLOCKS: u32 = 5;

/// Both, and what they are given.
pub(super) struct Pair<'a> {
    drive: &'a Drive,
    circuit: &'a Circuit,
    old: Simulator<'a>,
    new: Interpreter<'a>,
    chance: ChaCha8Rng,
    /// Ports and signals of the block.
    names: BTreeMap<&'a str, SignalId>,
    now_ps: u64,
    slowest_ps: u64,
}

impl<'a> Pair<'a> {
    /// Both switched on, their standing inputs set.
    pub(super) fn new(
        drive: &'a Drive,
        (circuit, netlist): (&'a Circuit, &'a Netlist),
        delays: &Delays,
        seed: u64,
    ) -> Result<Self, Error> {
        let mut old = Simulator::new(circuit, delays)?;
        let mut watched = Vec::new();
        for output in drive.outputs {
            for pin in output.pins() {
                watched.push(circuit.pin(&pin)?);
            }
        }
        old.watch(&watched);
        for (pin, level) in drive.before {
            old.drive(1, circuit.pin(pin)?, *level)?;
        }
        let chance = ChaCha8Rng::seed_from_u64(seed);
        let names = (0..).zip(&netlist.signals).map(|(id, one)| (&*one.path, SignalId(id)));
        let (new, names) = (Interpreter::new(netlist), names.collect());
        let now_ps = PAUSE_PS[1];
        let mut pair = Self { drive, circuit, old, new, chance, names, now_ps, slowest_ps: 0 };
        for (input, value) in drive.set {
            pair.new.set_input(pair.signal(input), *value);
        }
        (0..CLOCKS).for_each(|_| pair.new.step());
        pair.old.run_until(now_ps - 1);
        for _ in 0..drive.warm_up {
            pair.move_both()?;
        }
        Ok(pair)
    }

    /// Gives both so many pulses; after how many they differ.
    pub(super) fn run(&mut self, pulses: u64) -> Result<u64, Error> {
        let mut different = 0;
        for _ in 0..pulses {
            different += u64::from(!self.move_both()?);
        }
        Ok(different)
    }

    pub(super) fn findings(&self) -> Vec<Finding> {
        self.old.findings()
    }

    pub(super) fn slowest_ps(&self) -> u64 {
        self.slowest_ps
    }

    /// One drawn move; true when both answer alike.
    fn move_both(&mut self) -> Result<bool, Error> {
        let chosen = self.choose();
        let moved_ps = self.move_old(chosen)?;
        let came_out = self.move_new(chosen)?;
        let edges = self.old.take_edges();
        for edge in &edges {
            let cause_ps = moved_ps.iter().rfind(|moved_ps| **moved_ps < edge.time_ps);
            let answer_ps = cause_ps.map_or(0, |cause_ps| edge.time_ps - cause_ps);
            self.slowest_ps = self.slowest_ps.max(answer_ps);
        }
        let mut alike = true;
        for (output, came_out) in self.drive.outputs.iter().zip(came_out) {
            alike &= self.is_alike(output, came_out, &edges)?;
        }
        Ok(alike)
    }

    /// Compares an output, of which so many pulses came out of the block.
    fn is_alike(&mut self, output: &Output, pulses: i64, edges: &[Edge]) -> Result<bool, Error> {
        let rises = |pin| {
            let net = self.circuit.pin(pin)?;
            Ok(edges.iter().filter(|edge| edge.net == net && edge.level).map(|_| 1).sum::<i64>())
        };
        match output {
            Output::Pulses { pin, .. } => return Ok(rises(pin)? == pulses),
            Output::Way { up, down, .. } => return Ok(rises(up)? - rises(down)? == pulses),
            Output::Level { .. } | Output::Bits { .. } => {}
        }
        let mut number = 0;
        for (bit, pin) in output.pins().iter().enumerate() {
            number |= u64::from(self.old.level(self.circuit.pin(pin)?)) << bit;
        }
        Ok(number == self.new.value(self.signal(output.signal())))
    }

    fn choose(&mut self) -> &'static Move {
        let total: u32 = self.drive.moves.iter().map(|(weight, _)| weight).sum();
        let mut left = self.chance.random_range(0..total);
        for (weight, chosen) in self.drive.moves {
            if left < *weight {
                return chosen;
            }
            left -= weight;
        }
        unreachable!("what is left is below the sum of the weights")
    }

    /// Gives the original a pulse or a level; when its edges were, a level's once.
    fn move_old(&mut self, chosen: &Move) -> Result<[u64; 2], Error> {
        let width_ps = self.chance.random_range(WIDTH_PS[0]..=WIDTH_PS[1]);
        let pause_ps = self.chance.random_range(PAUSE_PS[0]..=PAUSE_PS[1]);
        let pin = self.circuit.pin(chosen.pin())?;
        let level = !self.old.level(pin);
        self.old.drive(self.now_ps, pin, level)?;
        let mut moved_ps = [self.now_ps; 2];
        if !matches!(chosen, Move::Level { .. }) {
            moved_ps[1] += width_ps;
            self.old.drive(moved_ps[1], pin, !level)?;
        }
        self.now_ps += width_ps + pause_ps;
        self.old.run_until(self.now_ps - 1);
        Ok(moved_ps)
    }

    /// Gives the synchronous block the same; how many clocks each output was high, less what it is
    /// behind by now.
    fn move_new(&mut self, chosen: &Move) -> Result<Vec<i64>, Error> {
        for (wire, input) in self.drive.copied {
            let level = self.old.level(self.circuit.pin(wire)?);
            self.new.set_input(self.signal(input), level.into());
        }
        let input = chosen.input().map(|input| self.signal(input));
        let before = input.map(|input| (input, self.new.value(input)));
        if let Some((input, level)) = before {
            self.new.set_input(input, level ^ 1);
        }
        let outputs = self.drive.outputs;
        let mut high: Vec<_> = outputs.iter().map(|output| self.behind(output)).collect();
        for _ in 0..CLOCKS {
            for (output, high) in outputs.iter().zip(&mut high) {
                *high += i64::from(self.new.value(self.signal(output.signal())) == 1);
            }
            self.new.step();
            if let Some((input, level)) = before
                && !matches!(chosen, Move::Level { .. })
            {
                self.new.set_input(input, level);
            }
        }
        outputs.iter().zip(&mut high).for_each(|(output, high)| *high -= self.behind(output));
        Ok(high)
    }

    /// What the block has to make up for before its pulses count again.
    fn behind(&mut self, output: &Output) -> i64 {
        let Output::Way { behind, .. } = output else { return 0 };
        self.new.value(self.signal(behind)).cast_signed()
    }

    fn signal(&self, name: &str) -> SignalId {
        *self.names.get(name).unwrap_or_else(|| unreachable!("the block has a port `{name}`"))
    }
}
