//! Block by block: the gates of the original and the synchronous block, given the same pulses.
//!
//! Pulses are drawn; after each, when both have come to rest, their outputs have to be alike, and
//! every pulse that came out of the one has to have come out of the other.

mod drives;
mod pair;

use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_original::{Check, Circuit, Corner, Delays, Error as OriginalError};
use helixlock_rtl::BLOCKS;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::error::Error;

use self::drives::{DRIVES, Drive};
use self::pair::Pair;

/// What the comparison of one figure gave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BlockCheck {
    /// Figure of the print.
    pub figure: &'static str,
    /// The synchronous block.
    pub block: &'static str,
    /// Pulses given, with typical delays and with all drawn ones.
    pub pulses: u64,
    /// Pulses after which the two differ, with typical delays.
    pub different: u64,
    /// Sets of delays drawn.
    pub drawn: u64,
    /// Those of them with which the two differ somewhere.
    pub drawn_different: u64,
    /// The first such, by its seed.
    pub first_seed: Option<u64>,
    /// Longest time from the last change of an input to the last one of an output, ps.
    pub slowest_ps: u64,
    /// Pulses shorter, or data less at rest, than a data sheet allows.
    pub violations: u64,
    /// Pulses that a gate swallowed.
    pub swallowed: u64,
}

impl Spread {
    /// Seed of the delays in a place; `None` for the typical ones.
    fn seed_of(&self, place: u64) -> Option<u64> {
        place.checked_sub(1).map(|drawn| self.seed.wrapping_add(drawn))
    }
}

impl BlockCheck {
    /// A figure that nothing was tried on yet.
    #[must_use]
    pub fn new(figure: &'static str, block: &'static str) -> Self {
        Self { figure, block, ..Self::default() }
    }

    /// Adds what the figure did with the delays of a place.
    pub fn add(&mut self, spread: &Spread, place: u64, seen: &Seen) {
        self.pulses += seen.pulses;
        self.slowest_ps = self.slowest_ps.max(seen.slowest_ps);
        self.violations += seen.violations;
        self.swallowed += seen.swallowed;
        let drawn_from = spread.seed_of(place);
        if drawn_from.is_none() {
            self.different = seen.different;
            return;
        }
        self.drawn += 1;
        if 0 < seen.different {
            self.drawn_different += 1;
            self.first_seed = self.first_seed.or(drawn_from);
        }
    }

    /// Alike with typical delays.
    #[must_use]
    pub fn is_alike(&self) -> bool {
        self.different == 0
    }
}

/// How much is compared.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spread {
    /// Pulses with typical delays.
    pub pulses: u64,
    /// Sets of delays drawn between the limits of the data sheets.
    pub drawn: u64,
    /// Pulses with each of them.
    pub drawn_pulses: u64,
    /// Where drawing begins.
    pub seed: u64,
}

/// What one set of delays did to one figure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Pulses given.
    pub pulses: u64,
    /// Pulses after which the two differ.
    pub different: u64,
    /// Longest time from the last change of an input to the last one of an output, ps.
    pub slowest_ps: u64,
    /// Pulses shorter, or data less at rest, than a data sheet allows.
    pub violations: u64,
    /// Pulses that a gate swallowed.
    pub swallowed: u64,
}

/// The figures that have a synchronous block, each with the block's name.
pub fn figures() -> impl Iterator<Item = (&'static str, &'static str)> {
    DRIVES.iter().map(|drive| (drive.figure, drive.block))
}

/// Every figure and its block, ready to be compared.
#[derive(Debug)]
pub struct Blocks {
    pairs: Vec<(&'static Drive, Circuit, Netlist)>,
}

impl Blocks {
    /// Builds all of them.
    #[must_use]
    pub fn all() -> Self {
        let pairs = DRIVES.iter().map(|drive| (drive, (drive.build)(), netlist(drive.block)));
        Self { pairs: pairs.collect() }
    }

    /// What every figure does, in the order of [`figures`], with typical delays in place 0, with
    /// drawn ones in the places behind.
    ///
    /// # Errors
    ///
    /// When a circuit cannot be run.
    pub fn try_delays(&self, spread: &Spread, place: u64) -> Result<Vec<Seen>, Error> {
        match spread.seed_of(place) {
            Some(seed) => {
                self.compare(spread.drawn_pulses, seed, |circuit| Delays::drawn(circuit, seed))
            }
            None => self.compare(spread.pulses, spread.seed, |circuit| {
                Delays::corner(circuit, Corner::Typical)
            }),
        }
    }

    fn compare(
        &self,
        pulses: u64,
        seed: u64,
        delays: impl Fn(&Circuit) -> Delays + Sync,
    ) -> Result<Vec<Seen>, Error> {
        let compared = self.pairs.par_iter().map(|(drive, circuit, netlist)| {
            let mut pair = Pair::new(drive, (circuit, netlist), &delays(circuit), seed)?;
            let different = pair.run(pulses)?;
            Ok(Seen::of(&pair, pulses, different))
        });
        compared.collect::<Result<Vec<Seen>, OriginalError>>().map_err(Error::from)
    }
}

/// The flat netlist of a block.
fn netlist(block: &str) -> Netlist {
    let card = BLOCKS.iter().find(|card| card.name == block).expect("the drives name blocks");
    let design = elaborate(card.name, &*(card.build)(), &Library::new());
    let design = design.expect("every block elaborates, which the build of the engine relies on");
    Netlist::new(&design).expect("every design of ours flattens")
}

impl Seen {
    fn of(pair: &Pair, pulses: u64, different: u64) -> Self {
        let slowest_ps = pair.slowest_ps();
        let mut seen = Self { pulses, different, slowest_ps, ..Self::default() };
        for finding in pair.findings() {
            match finding.check {
                Check::Swallowed => seen.swallowed += finding.count,
                _ => seen.violations += finding.count,
            }
        }
        seen
    }
}

#[cfg(test)]
mod tests {
    use helixlock_original::figures::{Clear, divider, laser_direction};

    use super::*;

    const SPREAD: Spread = Spread { pulses: 3000, drawn: 4, drawn_pulses: 700, seed: 1977 };

    /// Typical parts do what the synchronous blocks do, and every figure is given pulses.
    #[test]
    fn figures_do_what_the_blocks_do() {
        let blocks = Blocks::all();
        let mut checks: Vec<_> =
            figures().map(|(figure, block)| BlockCheck::new(figure, block)).collect();
        for place in 0..=SPREAD.drawn {
            let seen = blocks.try_delays(&SPREAD, place).unwrap();
            checks.iter_mut().zip(&seen).for_each(|(check, seen)| check.add(&SPREAD, place, seen));
        }
        assert_eq!(checks.len(), DRIVES.len());
        for check in checks {
            assert!(check.is_alike(), "{check:?}");
            assert!(
                check.block == "direction_discriminator" || check.drawn_different == 0,
                "{check:?}"
            );
            assert!((10_000..1_000_000).contains(&check.slowest_ps), "{check:?}");
        }
    }

    /// How many of 1000 pulses a block and another circuit than its own answer differently.
    fn different(block: &str, circuit: &Circuit) -> u64 {
        let drive = DRIVES.iter().find(|drive| drive.block == block).unwrap();
        let netlist = netlist(block);
        let typical = Delays::corner(circuit, Corner::Typical);
        Pair::new(drive, (circuit, &netlist), &typical, 1).unwrap().run(1000).unwrap()
    }

    /// A pair that is set differently is seen to differ, and one whose photocells are crossed.
    #[test]
    fn another_circuit_is_seen() {
        let preset = divider::circuit(128, Clear::Delayed);
        assert!(0 < different("programmable_divider", &preset));
        let mut crossed = Circuit::new("crossed");
        let [sine, cosine] = laser_direction::PHOTOCELLS.map(|name| crossed.input(name, false));
        let [up, down, _] = laser_direction::add(&mut crossed, cosine, sine);
        crossed.output("up", up);
        crossed.output("down", down);
        assert!(100 < different("quadrature_decoder", &crossed));
    }
}
