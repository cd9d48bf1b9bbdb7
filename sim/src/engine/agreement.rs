//! Holds an engine to the reference engine, in tests.

use helixlock_netlist::{Netlist, SignalId, mask};

use super::Engine;
use super::interpreter::Interpreter;
use super::random_design::Dice;

/// Holds inputs for a while, now and then a long one, and compares everything with the reference
/// engine at every stop.
pub(crate) fn compare(netlist: &Netlist, engine: &mut dyn Engine, dice: &mut Dice) {
    let mut reference = Interpreter::new(netlist);
    let all: Vec<SignalId> = (0..).map(SignalId).take(netlist.signals.len()).collect();
    for _ in 0..30 {
        for input in &netlist.inputs {
            let value = dice.roll() & mask(netlist.signal(*input).width);
            if dice.below(2) == 0 {
                reference.set_input(*input, value);
                engine.set_input(*input, value);
            }
        }
        let watchable = if dice.below(2) == 0 { &netlist.outputs } else { &all };
        let some = (0..dice.below(3)).map(|_| dice.pick(watchable)).collect();
        let watched: Vec<SignalId> = if dice.below(8) == 0 { all.clone() } else { some };
        reference.watch(&watched);
        engine.watch(&watched);
        let span = dice.pick(&[0, 1, 2, 3, 17, 300]);
        let until = reference.clock() + dice.below(span + 1);
        assert_eq!(engine.run_until(until), reference.run_until(until), "{watched:?}");
        assert_eq!(engine.clock(), reference.clock(), "{watched:?}");
        assert_eq!(engine.snapshot(), reference.snapshot(), "clock {}", reference.clock());
        for signal in &all {
            let path = &netlist.signal(*signal).path;
            assert_eq!(engine.value(*signal), reference.value(*signal), "`{path}`");
        }
    }
}
