//! Block by block: the gates of the original and the synchronous block, given the same pulses.
//!
//! Pulses are drawn; after each, when both have come to rest, their outputs have to be alike, and
//! every pulse that came out of the one has to have come out of the other.

mod drives;
mod pair;

use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_original::{Check, Corner, Delays, Error as OriginalError};
use helixlock_rtl::BLOCKS;

use crate::error::Error;

use self::drives::DRIVES;
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

impl BlockCheck {
    /// Alike with typical delays.
    #[must_use]
    pub fn is_alike(&self) -> bool {
        self.different == 0
    }
}

/// How much is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Compares every figure that has a synchronous block.
///
/// # Errors
///
/// When a circuit cannot be run.
pub fn check_blocks(spread: &Spread) -> Result<Vec<BlockCheck>, Error> {
    DRIVES.iter().map(|drive| check(drive, spread).map_err(Error::from)).collect()
}

/// The flat netlist of a block.
fn netlist(block: &str) -> Netlist {
    let card = BLOCKS.iter().find(|card| card.name == block).expect("the drives name blocks");
    let design = elaborate(card.name, &*(card.build)(), &Library::new());
    let design = design.expect("every block elaborates, which the build of the engine relies on");
    Netlist::new(&design).expect("every design of ours flattens")
}

fn check(drive: &drives::Drive, spread: &Spread) -> Result<BlockCheck, OriginalError> {
    let (circuit, netlist) = ((drive.build)(), netlist(drive.block));
    let both = (&circuit, &netlist);
    let mut check = BlockCheck {
        figure: drive.figure,
        block: drive.block,
        drawn: spread.drawn,
        ..BlockCheck::default()
    };
    let typical = Delays::corner(&circuit, Corner::Typical);
    let mut pair = Pair::new(drive, both, &typical, spread.seed)?;
    check.different = pair.run(spread.pulses)?;
    check.add(&pair, spread.pulses);
    for place in 0..spread.drawn {
        let seed = spread.seed.wrapping_add(place);
        let mut pair = Pair::new(drive, both, &Delays::drawn(&circuit, seed), seed)?;
        if 0 < pair.run(spread.drawn_pulses)? {
            check.drawn_different += 1;
            check.first_seed = check.first_seed.or(Some(seed));
        }
        check.add(&pair, spread.drawn_pulses);
    }
    Ok(check)
}

impl BlockCheck {
    fn add(&mut self, pair: &Pair, pulses: u64) {
        self.pulses += pulses;
        self.slowest_ps = self.slowest_ps.max(pair.slowest_ps());
        for finding in pair.findings() {
            match finding.check {
                Check::Swallowed => self.swallowed += finding.count,
                _ => self.violations += finding.count,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPREAD: Spread = Spread { pulses: 3000, drawn: 4, drawn_pulses: 700, seed: 1977 };

    /// Typical parts do what the synchronous blocks do, and every figure is given pulses.
    #[test]
    fn figures_do_what_the_blocks_do() {
        let checks = check_blocks(&SPREAD).unwrap();
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

    /// A pair that is set differently is seen to differ.
    #[test]
    fn another_preset_is_seen() {
        for drive in DRIVES.iter().filter(|drive| drive.block == "programmable_divider") {
            let circuit = helixlock_original::figures::divider::circuit(
                128,
                helixlock_original::figures::Clear::Delayed,
            );
            let typical = Delays::corner(&circuit, Corner::Typical);
            let netlist = netlist(drive.block);
            let mut pair = Pair::new(drive, (&circuit, &netlist), &typical, 1).unwrap();
            assert!(0 < pair.run(1000).unwrap());
        }
    }
}
