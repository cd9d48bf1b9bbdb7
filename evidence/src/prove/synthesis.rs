//! After synthesis: the gates that yosys makes for a family of FPGAs equal the Verilog they were
//! made from.
//!
//! They are compared from power-up on, where every register of the Verilog has to be zero. So are
//! the flip-flops of an iCE40; those of the others are what the models of their cells say.

use std::path::Path;

use anyhow::bail;
use helixlock_gen::Family;
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_rtl::{APART, BLOCKS, BlockCard};

use super::alike::{Likeness, alike};
use super::sources::Sources;

/// What became of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The gates answer like the Verilog, for ever.
    Equal {
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
    let gates = format!("{} {} -top {block}; stat;", read_block(built, block), family.synthesis());
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
    let gates = format!(
        "{gates} read_verilog -icells -overwrite -D EQUIV {}; hierarchy -top {block}; \
         proc; flatten; opt_clean -purge;",
        family.models()
    );
    let (likeness, log) = alike(block, &read_block(sources, block), &gates)?;
    Ok(match likeness {
        Likeness::Alike => Verdict::Equal { cells: cells(&log, family) },
        Likeness::Differ { clock } => {
            Verdict::Unequal { log: format!("{log}\nthey differ {clock} clocks after power-up") }
        }
        Likeness::Open => Verdict::Unequal { log },
    })
}

/// Commands that read a block, and those it is made of.
pub(super) fn read_block(sources: &Sources, block: &str) -> String {
    let folder = sources.verilog.display();
    format!(
        "read_verilog {folder}/{block}.v; hierarchy -libdir {folder} -top {block}; \
         proc; flatten; opt_clean;"
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
                   SB_LUT4         5\n\n";
        assert_eq!(cells(log, Family::Ice40), 8);
    }
}
