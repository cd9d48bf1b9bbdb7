//! A logic analyser in the place of the telemetry, and its memory.

use helixlock_gen::{Source, attach_memory, exchange};
use helixlock_netlist::{Design, elaborate};
use helixlock_rtl::BLOCKS;
use helixlock_sim::library;

/// The block.
const BLOCK: &str = "logic_analyser";

/// Its name in the board shell.
const NAME: &str = "analyser";

/// What it sees, in the order of its channels: pins of the board.
const PROBES: [&str; 8] =
    ["grating", "laser", "t1", "step", "direction", "measuring", "fault", "alarm"];

/// Ticks of SUMP in a microsecond.
const TICKS_PER_US: u64 = 100;

/// Puts it into a board shell without a settings port, whose clock is that fast. What it has captured
/// is zero as long as [`with_memory`] has not been there.
pub(crate) fn put_in(design: &mut Design, clock_mhz: u64) -> anyhow::Result<()> {
    let blocks = BLOCKS.iter().filter(|card| card.name == BLOCK);
    for card in blocks {
        let block = elaborate(BLOCK, &*(card.build)(), &library())?;
        let inputs = [
            ("clear", Source::Signals(&["reset"])),
            ("probes", Source::Signals(&PROBES)),
            ("received", Source::Signals(&["receiver_received"])),
            ("received_byte", Source::Signals(&["receiver_data"])),
            ("ready", Source::Signals(&["transmitter_ready"])),
            ("rate", Source::Level(1_000_000 * clock_mhz)),
            ("megahertz", Source::Level(clock_mhz)),
            ("ticks", Source::Level(TICKS_PER_US / clock_mhz)),
            ("ticks_rest", Source::Level(TICKS_PER_US % clock_mhz)),
        ];
        exchange(design, "telemetry", (NAME, &block), &inputs)?;
    }
    Ok(())
}

/// Gives it its memory, which a simulation does not have.
pub(crate) fn with_memory(design: &mut Design) -> anyhow::Result<()> {
    Ok(attach_memory(design, NAME)?)
}
