//! The comparison cell of the print: asynchronous gates and flip-flops, with their delays.
//!
//! Figures 6, 15 and 16 of document 1. Nothing here has a clock: the meter and the standard wave
//! follow their pulses, three NAND gates compare them, and the two-clock flip-flop takes whichever
//! of its clocks falls, as soon as that has been low long enough.
//!
//! ```text
//! grating ─► meter ────────┬──► NAND1 ─ CP1 ─► ┐
//! laser ───► (set, clear)  │                   ├ Q
//! grating ─► standard ─► NAND3 ─► NAND2 ─ CP2 ► ┘
//! half ────► (set, clear)
//! ```
//!
//! Every element has one delay and is inertial: a change that would last shorter than the delay
//! is swallowed, as a real gate does. Delays are those of the 74-series parts of the time; their
//! sum shifts all edges alike, and what matters is how they differ.

/// Delays of the parts, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delays {
    /// A NAND gate.
    pub gate_s: f64,
    /// Meter and standard flip-flop, from a pulse to the output.
    pub flip_flop_s: f64,
    /// How long a clock of the two-clock flip-flop must be low to be taken.
    pub shortest_clock_s: f64,
    /// Two-clock flip-flop, from there to Q.
    pub two_clock_s: f64,
}

/// Typical values of the TTL data books: SN7400 11 ns, SN7476 25 ns, and 20 ns of clock.
pub const TTL: Delays =
    Delays { gate_s: 11e-9, flip_flop_s: 25e-9, shortest_clock_s: 20e-9, two_clock_s: 25e-9 };

/// A pulse at an input of the cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pulse {
    /// Divided grating: a comparison begins.
    Grating,
    /// Middle of the period: the standard falls.
    Half,
    /// Divided laser.
    Laser,
}

/// A change of the two outputs that matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Change {
    /// The meter changed to this level.
    Meter(bool),
    /// Q changed to this level.
    Q(bool),
}

/// The cell; time runs forward only.
#[derive(Clone, Debug)]
pub(crate) struct HistoricCell {
    delays: Delays,
    level: [bool; ELEMENTS],
    /// What each element is about to do, and when.
    pending: [Option<(f64, bool)>; ELEMENTS],
    /// Clock pulses too short for the two-clock flip-flop.
    pub(crate) runts: u64,
    /// The two-clock flip-flop has taken a clock.
    pub(crate) decided: bool,
}

/// Elements by number: outputs, except the two that time the clocks of the last flip-flop.
const METER: usize = 0;
const STANDARD: usize = 1;
const NAND3: usize = 2;
const NAND1: usize = 3;
const NAND2: usize = 4;
const CLOCK1: usize = 5;
const CLOCK2: usize = 6;
const Q: usize = 7;
const ELEMENTS: usize = 8;

impl HistoricCell {
    /// A cell at rest: meter, standard and Q low.
    pub(crate) fn new(delays: Delays) -> Self {
        let mut level = [false; ELEMENTS];
        for nand in [NAND1, NAND2, NAND3] {
            level[nand] = true;
        }
        Self { delays, level, pending: [None; ELEMENTS], runts: 0, decided: false }
    }

    /// A pulse comes; `changes` gets what happens before it, with the times.
    pub(crate) fn pulse(&mut self, time_s: f64, pulse: Pulse, changes: &mut Vec<(f64, Change)>) {
        self.advance(time_s, changes);
        let after_s = time_s + self.delays.flip_flop_s;
        match pulse {
            Pulse::Grating => {
                self.plan(METER, after_s, true);
                self.plan(STANDARD, after_s, true);
            }
            Pulse::Half => self.plan(STANDARD, after_s, false),
            Pulse::Laser => self.plan(METER, after_s, false),
        }
    }

    /// Lets time pass; `changes` gets what happens up to then.
    pub(crate) fn advance(&mut self, time_s: f64, changes: &mut Vec<(f64, Change)>) {
        while let Some((element, at_s, level)) = self.next().filter(|next| next.1 <= time_s) {
            self.pending[element] = None;
            self.change(element, at_s, level, changes);
        }
    }

    /// The element that acts next; among several at once the first in the list.
    fn next(&self) -> Option<(usize, f64, bool)> {
        let acting = self.pending.iter().enumerate();
        let acting =
            acting.filter_map(|(element, p)| p.map(|(at_s, level)| (element, at_s, level)));
        acting.min_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// An element will change, unless it stands there already: then a change on its way is off.
    fn plan(&mut self, element: usize, at_s: f64, level: bool) {
        self.pending[element] = (self.level[element] != level).then_some((at_s, level));
    }

    fn change(&mut self, element: usize, at_s: f64, level: bool, changes: &mut Vec<(f64, Change)>) {
        self.level[element] = level;
        match element {
            METER => changes.push((at_s, Change::Meter(level))),
            Q => changes.push((at_s, Change::Q(level))),
            CLOCK1 | CLOCK2 => {
                // The clock was low long enough: Q follows, and the timer is ready again.
                self.level[element] = false;
                self.decided = true;
                self.plan(Q, at_s + self.delays.two_clock_s, element == CLOCK1);
            }
            NAND1 => self.time_clock(CLOCK1, at_s, level),
            NAND2 => self.time_clock(CLOCK2, at_s, level),
            _ => {}
        }
        self.follow(at_s);
    }

    /// A clock input fell or rose: its shortest time begins, or is broken off.
    fn time_clock(&mut self, timer: usize, at_s: f64, level: bool) {
        if !level {
            self.plan(timer, at_s + self.delays.shortest_clock_s, true);
        } else if self.pending[timer].take().is_some() {
            self.runts += 1;
        }
    }

    /// The gates follow their inputs.
    fn follow(&mut self, at_s: f64) {
        let [meter, standard, nand3] = [METER, STANDARD, NAND3].map(|input| self.level[input]);
        let outputs = [(NAND3, !standard), (NAND1, !(meter && nand3)), (NAND2, meter || !standard)];
        for (gate, output) in outputs {
            let on_its_way = self.pending[gate].is_some_and(|(_, level)| level == output);
            if !on_its_way {
                self.plan(gate, at_s + self.delays.gate_s, output);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A comparison of 1 ms with the laser this late; Q at its end, and the meter's width.
    fn compare(cell: &mut HistoricCell, begin_s: f64, lag_s: f64) -> (bool, f64) {
        let mut changes = Vec::new();
        let mut pulses = [
            (begin_s, Pulse::Grating),
            (begin_s + 0.5e-3, Pulse::Half),
            (begin_s + lag_s, Pulse::Laser),
        ];
        pulses.sort_by(|one, other| one.0.total_cmp(&other.0));
        for (time_s, pulse) in pulses {
            cell.pulse(time_s, pulse, &mut changes);
        }
        cell.advance(begin_s + 0.999e-3, &mut changes);
        let edge = |level| {
            changes
                .iter()
                .find(|(_, change)| *change == Change::Meter(level))
                .map(|(time, _)| *time)
        };
        (cell.level[Q], edge(false).unwrap() - edge(true).unwrap())
    }

    #[test]
    fn wider_goes_forward_and_narrower_in_reverse() {
        let mut cell = HistoricCell::new(TTL);
        for (period, (lag_s, forward)) in
            [(0.6e-3, true), (0.7e-3, true), (0.4e-3, false), (0.51e-3, true)]
                .into_iter()
                .enumerate()
        {
            let begin_s = f64::from(u32::try_from(period).unwrap()) * 1e-3;
            let (q, width_s) = compare(&mut cell, begin_s, lag_s);
            assert_eq!(q, forward, "lag {lag_s}");
            assert!((width_s - lag_s).abs() < 1e-12, "the delays shift, and do not widen");
        }
    }

    /// The standard reaches NAND1 one gate later than the meter. The spike of a gate's length is
    /// swallowed by the gate itself: even a flip-flop without a shortest clock is not fooled.
    #[test]
    fn the_spike_at_the_start_is_swallowed() {
        let mut cell = HistoricCell::new(Delays { shortest_clock_s: 0.0, ..TTL });
        let mut changes = Vec::new();
        cell.pulse(0.0, Pulse::Grating, &mut changes);
        cell.advance(1e-3, &mut changes);
        assert_eq!(changes, [(TTL.flip_flop_s, Change::Meter(true))]);
        assert_eq!(cell.runts, 0);
    }

    /// Widths that differ by less than the shortest clock decide nothing: Q keeps.
    #[test]
    fn equal_widths_keep() {
        let mut cell = HistoricCell::new(TTL);
        assert!(compare(&mut cell, 0.0, 0.6e-3).0);
        assert!(compare(&mut cell, 1e-3, 0.5e-3 - 10e-9).0, "10 ns narrower is not noticed");
        assert!(!compare(&mut cell, 2e-3, 0.5e-3 - 100e-9).0, "100 ns is");
    }
}
