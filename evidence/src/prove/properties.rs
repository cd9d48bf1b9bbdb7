//! Safety properties by induction: true from any power-up state, for ever.
//!
//! Each `tests/formal/<block>.sv` holds a module `<block>_proof` around the emitted block. yosys
//! flattens it, forgets the power-up values of the block, and proves the assertions by temporal
//! induction with its own SAT solver. The inner registers a proof looks at are wires of the same
//! name with the attribute `hierconn`.

use super::sources::Sources;
use crate::tools::yosys;

/// Induction depth beyond which a proof is given up.
const DEEPEST: u32 = 8;

/// What became of a block's properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// They hold in every state reachable from any power-up state; induction of this depth.
    Proven {
        /// Clocks the induction hypothesis spans.
        depth: u32,
    },
    /// Not proven: a counterexample, or no proof up to the deepest induction.
    NotProven {
        /// What yosys logged.
        log: String,
    },
}

/// Proves the properties of one block.
///
/// # Errors
///
/// When yosys cannot be started or a file is missing.
pub fn prove(sources: &Sources, block: &str) -> anyhow::Result<Verdict> {
    let script = format!(
        "read_verilog {verilog}/*.v; read_verilog -sv -formal {properties}/{block}.sv; \
         prep -top {block}_proof -flatten; setattr -unset init w:dut.*; delete t:$cover; \
         sat -verify -prove-asserts -set-assumes -tempinduct -maxsteps {DEEPEST} -seq 1 \
         {block}_proof",
        verilog = sources.verilog.display(),
        properties = sources.properties.display(),
    );
    let (content, log) = yosys(&script)?;
    let depth = log
        .lines()
        .rev()
        .find_map(|line| line.strip_prefix("[induction step ")?.split(']').next()?.parse().ok());
    Ok(match depth {
        Some(depth) if content && log.contains("Induction step proven") => {
            Verdict::Proven { depth }
        }
        _ => Verdict::NotProven { log },
    })
}

/// Number of assertions in a block's properties, and the sentence they begin with.
///
/// # Errors
///
/// When the file cannot be read.
pub fn claim(sources: &Sources, block: &str) -> anyhow::Result<(usize, String)> {
    let text = sources.properties_of(block)?;
    let sentence: Vec<_> = text.lines().map_while(|line| line.strip_prefix("// ")).collect();
    Ok((text.matches("assert (").count(), sentence.join(" ")))
}
