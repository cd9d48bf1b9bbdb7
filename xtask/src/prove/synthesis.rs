//! After synthesis: the gates that yosys makes for a family of FPGAs equal the Verilog they were
//! made from.
//!
//! Registers and outputs of both are paired by name. By induction with yosys' solver: pairs that
//! are equal are equal after the next clock, whatever the inputs; and they are equal from power-up,
//! where every register of the Verilog has to be zero. So are the flip-flops of an iCE40; those of
//! the others are what the models of their cells say.

use std::path::Path;

use anyhow::bail;
use helixlock_gen::Family;
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
pub fn synthesised(
    sources: &Sources,
    built: &Sources,
    block: &str,
    family: Family,
) -> anyhow::Result<Verdict> {
    let gates = format!("{} {} -top {block}; stat;", read(built, block), family.synthesis());
    compare(sources, &gates, block, family)
}

/// Compares gates that a file has, as yosys wrote them, with the Verilog.
///
/// # Errors
///
/// As of [`synthesised`].
pub fn recorded(
    sources: &Sources,
    gates: &Path,
    block: &str,
    family: Family,
) -> anyhow::Result<Verdict> {
    compare(sources, &format!("read_verilog {};", gates.display()), block, family)
}

/// Compares the Verilog with what the commands in `gates` leave.
fn compare(sources: &Sources, gates: &str, block: &str, family: Family) -> anyhow::Result<Verdict> {
    starts_at_zero(block)?;
    // Registers are called `*_q`; what else has kept its name in the gates may serve another end.
    let script = format!(
        "{source} splitnets; design -stash source; {gates} \
         read_verilog -icells -overwrite -D EQUIV {models}; hierarchy -top {block}; \
         proc; flatten; rename -hide w:* w:*_q %d; splitnets; opt_clean -purge; \
         design -stash gates; design -copy-from source -as source {block}; \
         design -copy-from gates -as gates {block}; equiv_make source gates both; \
         hierarchy -top both; equiv_miter -assert start; \
         sat -verify -prove-asserts -set-init-zero -tempinduct -tempinduct-baseonly \
         -maxsteps {CLOCKS} start; \
         hierarchy -top both; equiv_simple; equiv_induct -seq {CLOCKS}; equiv_status -assert",
        source = read(sources, block),
        models = family.models(),
    );
    let (content, log) = yosys(&script)?;
    Ok(match pairs(&log) {
        Some(pairs) if content && log.contains("Equivalence successfully proven!") => {
            Verdict::Equal { pairs, cells: cells(&log, family) }
        }
        _ => Verdict::Unequal { log },
    })
}

/// Commands that read a block.
fn read(sources: &Sources, block: &str) -> String {
    format!(
        "read_verilog {}/*.v; hierarchy -top {block}; proc; flatten; opt_clean;",
        sources.verilog.display()
    )
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
fn cells(log: &str, family: Family) -> u32 {
    let begins = log.rfind("Number of cells:").unwrap_or_default();
    let counts = log[begins..].lines().skip(1).map_while(|line| line.trim().split_once(' '));
    let sorts = [family.flip_flops(), family.tables()];
    counts
        .filter(|(kind, _)| sorts.iter().any(|sort| kind.starts_with(sort)))
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
        assert_eq!((pairs(log), cells(log, Family::Ice40)), (Some(161), 8));
    }
}
