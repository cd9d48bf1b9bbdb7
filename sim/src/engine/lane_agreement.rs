//! Holds lanes to the reference engine, in tests.

use helixlock_netlist::{SignalId, mask};

use super::Engine;
use super::circuit::Circuit;
use super::interpreter::Interpreter;
use super::lanes::{LANES, LaneKernel, Lanes, Vectors};
use super::random_design::Dice;

/// Lanes in every part of a vector, at its edges and not.
const HELD_TO_IT: [usize; 5] = [0, 63, 64, 300, 511];

/// Lanes, and some of them alone.
struct Pair<'a, K: LaneKernel> {
    lanes: Lanes<'a, K>,
    singles: Vec<(usize, Interpreter<'a>)>,
}

/// Sets inputs of all lanes or of some, flips flip-flops of some, puts all into the state of one, runs for
/// a while, now and then a long one, so that lanes come to rest together or apart, and compares.
pub(crate) fn compare_lanes<K: LaneKernel>(circuit: &Circuit, dice: &Dice) {
    for vectors in Vectors::all() {
        let mut dice = dice.clone();
        let single = |lane| (lane, Interpreter::new(circuit.netlist()));
        let lanes = Lanes::<K>::by(circuit, vectors);
        let mut pair = Pair { lanes, singles: HELD_TO_IT.map(single).into() };
        for _ in 0..60 {
            pair.set_some_inputs(&mut dice);
            match dice.below(8) {
                0 | 1 => pair.flip_some(&mut dice),
                2 => pair.fill(&mut dice),
                _ => {}
            }
            let span = dice.pick(&[1, 1, 1, 2, 3, 17, 300]);
            pair.run(1 + dice.below(span));
        }
    }
}

impl<K: LaneKernel> Pair<'_, K> {
    fn set_some_inputs(&mut self, dice: &mut Dice) {
        for input in self.lanes.netlist().inputs.clone() {
            let width = self.lanes.netlist().signal(input).width;
            let value = dice.roll() & mask(width);
            match dice.below(4) {
                0 => self.set(input, value),
                1 => self.set_of(dice.pick(&HELD_TO_IT), input, value),
                2 => self.set_of(usize::try_from(dice.below(512)).expect("small"), input, value),
                _ => {}
            }
        }
    }

    fn set(&mut self, input: SignalId, value: u64) {
        self.lanes.set_input(input, value);
        for (_, single) in &mut self.singles {
            single.set_input(input, value);
        }
    }

    fn set_of(&mut self, lane: usize, input: SignalId, value: u64) {
        assert!(lane < LANES);
        self.lanes.set_input_of(lane, input, value);
        for (_, single) in self.singles.iter_mut().filter(|(number, _)| *number == lane) {
            single.set_input(input, value);
        }
    }

    /// Flips a flip-flop of one lane.
    fn flip_some(&mut self, dice: &mut Dice) {
        let lane = dice.pick(&HELD_TO_IT);
        for (_, single) in self.singles.iter_mut().filter(|(number, _)| *number == lane) {
            let mut snapshot = single.snapshot();
            let flip_flops = snapshot.flip_flops.len() as u64;
            let flip_flop = usize::try_from(dice.below(flip_flops)).expect("an index fits");
            let level = snapshot.flip_flops[flip_flop];
            snapshot.flip_flops.set(flip_flop, !level);
            single.restore(&snapshot);
            self.lanes.flip(lane, flip_flop);
        }
    }

    /// Puts all into the state of one.
    fn fill(&mut self, dice: &mut Dice) {
        let state = self.lanes.flip_flops(dice.pick(&HELD_TO_IT));
        self.lanes.fill(&state);
        for (_, single) in &mut self.singles {
            let mut snapshot = single.snapshot();
            snapshot.flip_flops = state.clone();
            single.restore(&snapshot);
        }
    }

    fn run(&mut self, clocks: u64) {
        let until = self.lanes.clock() + clocks;
        self.lanes.run_until(until);
        assert_eq!(self.lanes.clock(), until);
        for (lane, single) in &mut self.singles {
            single.run_until(until);
            assert_eq!(self.lanes.flip_flops(*lane), single.flip_flops(), "lane {lane}, {until}");
        }
    }
}
