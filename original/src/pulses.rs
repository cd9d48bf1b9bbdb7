//! Trains of pulses for the pins.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::circuit::{Circuit, Net};

/// A change at a pin: when, ps, which, and to what.
pub type Change = (u64, Net, bool);

/// Changes at the pins of a circuit, to be put in order.
#[derive(Clone, Debug, Default)]
pub struct Train(Vec<Change>);

impl Train {
    /// None yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A level from an instant on.
    pub fn level(&mut self, time_ps: u64, pin: Net, level: bool) {
        self.0.push((time_ps, pin, level));
    }

    /// One pulse, high.
    pub fn pulse(&mut self, time_ps: u64, pin: Net, width_ps: u64) {
        self.level(time_ps, pin, true);
        self.level(time_ps + width_ps, pin, false);
    }

    /// So many pulses, with drawn gaps and widths within these limits, ps. Gives when they end.
    pub fn drawn(&mut self, pin: Net, pulses: usize, limits: [u64; 2], seed: u64) -> u64 {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let mut time_ps = 0;
        for _ in 0..pulses {
            time_ps += chance.random_range(limits[0]..=limits[1]);
            let width_ps = chance.random_range(limits[0]..=limits[1]);
            self.pulse(time_ps, pin, width_ps);
            time_ps += width_ps;
        }
        time_ps
    }

    /// All changes, in the order of time; of a pin twice at one instant the last one counts.
    #[must_use]
    pub fn changes(mut self) -> Vec<Change> {
        self.0.sort_by_key(|(time_ps, pin, _)| (*time_ps, *pin));
        self.0
    }
}

/// Pulses at every pin of a circuit, against its level at power-up, gaps and widths drawn from 5 ns
/// to 1 µs; pins that begin with `reset`, `clear`, `hold` or `playback` move a hundred times less
/// often.
#[must_use]
pub fn at_every_pin(circuit: &Circuit, pulses: usize, seed: u64) -> Vec<Change> {
    let mut train = Train::new();
    for ((pin, level), place) in circuit.inputs.iter().zip(0..) {
        let mut one = Train::new();
        let name = &circuit.nets[pin.0];
        let rare = ["reset", "clear", "hold", "playback"].iter().any(|word| name.starts_with(word));
        let (count, factor) = if rare { (pulses / 100, 100) } else { (pulses, 1) };
        one.drawn(*pin, count, [factor * 5_000, factor * 1_000_000], seed ^ (place << 32));
        train.0.extend(one.0.into_iter().map(|(time, pin, high)| (time, pin, high != *level)));
    }
    train.changes()
}
