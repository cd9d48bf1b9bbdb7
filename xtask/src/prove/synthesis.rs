//! After synthesis: the gates that yosys makes for an iCE40 equal the Verilog they were made from.
//!
//! Registers and outputs of both are paired by name. By induction with yosys' solver: pairs that
//! are equal are equal after the next clock, whatever the inputs; and they are equal from power-up,
//! where every flip-flop of an iCE40 is zero, as every register of the Verilog has to be.

use anyhow::bail;
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_rtl::{APART, BLOCKS, BlockCard};

use super::sources::Sources;
use crate::tools::yosys;

/// Clocks from power-up in which the pairs are compared: the deepest induction looks no further back.
const CLOCKS: u32 = 4;

/// What became of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The gates answer like the Verilog, for ever.
    Equal {
        /// Bits of registers and outputs that were paired.
        pairs: u32,
        /// Flip-flops and look-up tables of the gates.
        cells: u32,
    },
    /// They do not, or it could not be shown.
    Unequal {
        /// What yosys logged.
        log: String,
    },
}

/// Every block there is, those of documents 3 and 4 too.
pub fn blocks() -> impl Iterator<Item = &'static BlockCard> {
    BLOCKS.iter().chain(APART)
}

/// Synthesises the Verilog of `built` and compares the gates with the Verilog of `sources`.
///
/// # Errors
///
/// When yosys cannot be started, or a register does not start at zero.
pub fn synthesised(sources: &Sources, built: &Sources, block: &str) -> anyhow::Result<Verdict> {
    starts_at_zero(block)?;
    let read = |sources: &Sources| {
        format!(
            "read_verilog {}/*.v; hierarchy -top {block}; proc; flatten; opt_clean;",
            sources.verilog.display()
        )
    };
    // Registers are called `*_q`; what else has kept its name in the gates may serve another end.
    let script = format!(
        "{source} splitnets; design -stash source; {built} \
         synth_ice40 -dffe_min_ce_use 4 -top {block}; stat; \
         read_verilog -icells -overwrite -D EQUIV +/ice40/cells_sim.v; hierarchy -top {block}; \
         proc; flatten; rename -hide w:* w:*_q %d; splitnets; opt_clean -purge; \
         design -stash gates; design -copy-from source -as source {block}; \
         design -copy-from gates -as gates {block}; equiv_make source gates both; \
         hierarchy -top both; equiv_miter -assert start; \
         sat -verify -prove-asserts -set-init-zero -tempinduct -tempinduct-baseonly \
         -maxsteps {CLOCKS} start; \
         hierarchy -top both; equiv_simple; equiv_induct -seq {CLOCKS}; equiv_status -assert",
        source = read(sources),
        built = read(built),
    );
    let (content, log) = yosys(&script)?;
    Ok(match pairs(&log) {
        Some(pairs) if content && log.contains("Equivalence successfully proven!") => {
            Verdict::Equal { pairs, cells: cells(&log) }
        }
        _ => Verdict::Unequal { log },
    })
}

fn starts_at_zero(block: &str) -> anyhow::Result<()> {
    let Some(card) = blocks().find(|card| card.name == block) else {
        bail!("block `{block}`, expected one of the list");
    };
    let netlist = Netlist::new(&elaborate(block, &*(card.build)(), &Library::new())?)?;
    for register in &netlist.registers {
        if register.initial != 0 {
            let path = &netlist.signal(register.output).path;
            bail!("{block}: `{path}` starts at {}, expected 0", register.initial);
        }
    }
    Ok(())
}

/// From "Of those cells 161 are proven and 0 are unproven."
fn pairs(log: &str) -> Option<u32> {
    let line = log.lines().rev().find(|line| line.contains("are unproven."))?;
    line.trim().strip_prefix("Of those cells ")?.split(' ').next()?.parse().ok()
}

/// Flip-flops and look-up tables in the statistics of the synthesis.
fn cells(log: &str) -> u32 {
    let begins = log.rfind("Number of cells:").unwrap_or_default();
    let counts = log[begins..].lines().skip(1).map_while(|line| line.trim().split_once(' '));
    let counts = counts.take_while(|(kind, _)| kind.starts_with("SB_"));
    counts
        .filter(|(kind, _)| kind.starts_with("SB_DFF") || *kind == "SB_LUT4")
        .filter_map(|(_, count)| count.trim().parse::<u32>().ok())
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_from_the_log() {
        let log = "   Number of cells:    9\n     SB_CARRY       1\n     SB_DFFESR      3\n     \
                   SB_LUT4         5\n\n  Of those cells 161 are proven and 0 are unproven.\n";
        assert_eq!((pairs(log), cells(log)), (Some(161), 8));
    }
}
