//! The reference engine: walks the netlist's expressions, slow and plain.

use helixlock_netlist::{Netlist, SignalId, mask};

use super::state::{FlipFlops, Snapshot, pack, unpack};
use super::{Engine, Stop};

/// Evaluates every assignment, in order, at every clock; nothing is clever here, so that the other
/// engines have something to agree with.
#[derive(Clone, Debug)]
pub struct Interpreter<'a> {
    netlist: &'a Netlist,
    clock: u64,
    /// One a signal; combinational ones are right only when `settled`.
    values: Vec<u64>,
    settled: bool,
    watched: Vec<SignalId>,
}

impl<'a> Interpreter<'a> {
    /// The design at power-up, with all inputs low.
    #[must_use]
    pub fn new(netlist: &'a Netlist) -> Self {
        let mut values = vec![0; netlist.signals.len()];
        for register in &netlist.registers {
            values[register.output.0 as usize] = register.initial;
        }
        Self { netlist, clock: 0, values, settled: false, watched: Vec::new() }
    }

    fn settle(&mut self) {
        if self.settled {
            return;
        }
        for assignment in &self.netlist.assignments {
            self.values[assignment.target.0 as usize] = assignment.value.evaluate(&self.values);
        }
        self.settled = true;
    }

    fn watched_values(&mut self) -> Vec<u64> {
        self.settle();
        self.watched.iter().map(|signal| self.values[signal.0 as usize]).collect()
    }
}

impl Engine for Interpreter<'_> {
    fn netlist(&self) -> &Netlist {
        self.netlist
    }

    fn clock(&self) -> u64 {
        self.clock
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        assert!(self.netlist.inputs.contains(&input), "{input:?} is an input");
        let signal = self.netlist.signal(input);
        assert!(value <= mask(signal.width), "{value} fits `{}`", signal.path);
        self.values[input.0 as usize] = value;
        self.settled = false;
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        self.settle();
        self.values[signal.0 as usize]
    }

    fn step(&mut self) {
        self.settle();
        let next: Vec<u64> = self
            .netlist
            .registers
            .iter()
            .map(|register| self.values[register.input.0 as usize])
            .collect();
        for (register, value) in self.netlist.registers.iter().zip(next) {
            self.values[register.output.0 as usize] = value;
        }
        self.settled = false;
        self.clock += 1;
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.watched = signals.to_vec();
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        let before = self.watched_values();
        while self.clock < clock {
            self.step();
            if self.watched_values() != before {
                return Stop::Changed;
            }
        }
        Stop::Reached
    }

    fn flip_flops(&self) -> FlipFlops {
        let outputs = self.netlist.registers.iter().map(|register| register.output.0 as usize);
        pack(self.netlist, outputs.map(|output| self.values[output]))
    }

    fn snapshot(&self) -> Snapshot {
        let inputs = self.netlist.inputs.iter().map(|input| self.values[input.0 as usize]);
        Snapshot { clock: self.clock, inputs: inputs.collect(), flip_flops: self.flip_flops() }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        assert_eq!(snapshot.inputs.len(), self.netlist.inputs.len(), "inputs of this design");
        for (input, value) in self.netlist.inputs.iter().zip(&snapshot.inputs) {
            self.values[input.0 as usize] = *value;
        }
        let flip_flops = unpack(self.netlist, &snapshot.flip_flops);
        for (register, value) in self.netlist.registers.iter().zip(flip_flops) {
            self.values[register.output.0 as usize] = value;
        }
        self.clock = snapshot.clock;
        self.settled = false;
    }
}

#[cfg(test)]
mod tests {
    use helixlock_netlist::{Assignment, Expression, Node, Register, Signal};

    use super::*;

    const ENABLE: SignalId = SignalId(0);
    const COUNT: SignalId = SignalId(1);
    const NEXT: SignalId = SignalId(2);
    const CARRY: SignalId = SignalId(3);

    /// Two bits that count while `enable`, and a carry from both set.
    fn counter() -> Netlist {
        let signal = |path: &str, width| Signal { path: path.into(), width };
        let read = |id, width| Box::new(Expression { width, node: Node::Signal(id) });
        let enable = Box::new(Expression { width: 2, node: Node::Extend(read(ENABLE, 1)) });
        let sum = Expression { width: 2, node: Node::Add(read(COUNT, 2), enable) };
        let all = Expression { width: 1, node: Node::All(read(COUNT, 2)) };
        Netlist {
            signals: vec![
                signal("enable", 1),
                signal("count", 2),
                signal("next", 2),
                signal("carry", 1),
            ],
            inputs: vec![ENABLE],
            outputs: vec![CARRY],
            registers: vec![Register { output: COUNT, input: NEXT, initial: 0 }],
            assignments: vec![
                Assignment { target: NEXT, value: sum },
                Assignment { target: CARRY, value: all },
            ],
        }
    }

    #[test]
    fn an_input_is_seen_by_the_next_edge() {
        let netlist = counter();
        let mut engine = Interpreter::new(&netlist);
        engine.step();
        engine.set_input(ENABLE, 1);
        assert_eq!((engine.value(COUNT), engine.value(NEXT)), (0, 1));
        engine.step();
        assert_eq!((engine.clock(), engine.value(COUNT)), (2, 1));
    }

    #[test]
    fn a_watched_change_stops_the_run() {
        let netlist = counter();
        let mut engine = Interpreter::new(&netlist);
        engine.set_input(ENABLE, 1);
        engine.watch(&[CARRY]);
        assert_eq!((engine.run_until(100), engine.clock()), (Stop::Changed, 3));
        assert_eq!((engine.run_until(100), engine.clock()), (Stop::Changed, 4));
        assert_eq!((engine.run_until(6), engine.clock()), (Stop::Reached, 6));
        assert_eq!((engine.run_until(5), engine.clock()), (Stop::Reached, 6));
    }

    #[test]
    fn a_snapshot_is_gone_on_from() {
        let netlist = counter();
        let mut engine = Interpreter::new(&netlist);
        engine.set_input(ENABLE, 1);
        engine.run_until(3);
        let moment = engine.snapshot();
        assert_eq!(moment.flip_flops, FlipFlops::from_iter([true, true]));
        let mut other = Interpreter::new(&netlist);
        other.restore(&moment);
        other.step();
        engine.step();
        assert_eq!(other.snapshot(), engine.snapshot());
        assert_eq!(other.value(COUNT), 0);
    }
}
