//! Cover properties: the interesting states are reachable, with a waveform of the way there.
//!
//! A proof of assertions that nothing can reach would be empty. Each `cover` of a block's
//! properties is turned into the claim that it never happens, and yosys has to find the
//! counterexample, with the block's assertions, which are proven, as assumptions.

use std::path::{Path, PathBuf};

use super::sources::Sources;
use crate::tools::{write_scratch, yosys};

/// Clocks a search goes.
const LONGEST: u32 = 24;

/// From where a state was reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum From {
    /// From power-up, all registers as the FPGA starts them.
    PowerUp,
    /// From some state in which all proven properties hold: after an upset, or too far from
    /// power-up for a search clock by clock.
    Invariant,
}

/// A cover property and its witness.
#[derive(Clone, Debug)]
pub struct Witness {
    /// The condition.
    pub condition: String,
    /// How it was reached, if it was, and the waveform.
    pub reached: Option<(From, PathBuf)>,
}

/// Searches a way to each cover property of a block; waveforms go to `folder`.
///
/// # Errors
///
/// When yosys cannot be started, or a file cannot be read or written.
pub fn witnesses(sources: &Sources, block: &str, folder: &Path) -> anyhow::Result<Vec<Witness>> {
    let text = sources.properties_of(block)?;
    let mut found = Vec::new();
    for (index, condition) in conditions(&text).into_iter().enumerate() {
        let name = format!("{block}_{index}");
        let reached = reachable(sources, block, &name, &refutable(&text, index), folder)?;
        found.push(Witness { condition, reached });
    }
    Ok(found)
}

/// Searches a way to violate the one assertion of these properties.
pub(super) fn reachable(
    sources: &Sources,
    block: &str,
    name: &str,
    properties: &str,
    folder: &Path,
) -> anyhow::Result<Option<(From, PathBuf)>> {
    let property = folder.join(format!("{name}.sv"));
    write_scratch(&property, properties)?;
    let waveform = folder.join(format!("{name}.vcd"));
    for from in [From::PowerUp, From::Invariant] {
        if search(sources, block, &property, &waveform, from)? {
            return Ok(Some((from, waveform)));
        }
    }
    Ok(None)
}

fn search(
    sources: &Sources,
    block: &str,
    property: &Path,
    waveform: &Path,
    from: From,
) -> anyhow::Result<bool> {
    let forget = match from {
        From::PowerUp => "",
        From::Invariant => "setattr -unset init w:*;",
    };
    let script = format!(
        "read_verilog {verilog}/*.v; read_verilog -sv -formal {property}; \
         prep -top {block}_proof -flatten; {forget} \
         sat -falsify -prove-asserts -set-assumes -tempinduct -tempinduct-baseonly \
         -maxsteps {LONGEST} -dump_vcd {waveform} {block}_proof",
        verilog = sources.verilog.display(),
        property = property.display(),
        waveform = waveform.display(),
    );
    Ok(yosys(&script)?.0)
}

/// The conditions of the `cover` statements, in order.
fn conditions(text: &str) -> Vec<String> {
    text.lines().filter_map(cover).map(str::to_owned).collect()
}

/// The condition of the `cover` statement in a line.
fn cover(line: &str) -> Option<&str> {
    line.trim().strip_prefix("always @* cover (")?.strip_suffix(");")
}

/// The properties with one `cover` turned into the claim that it never happens.
fn refutable(text: &str, index: usize) -> String {
    let mut seen = 0;
    let mut lines = Vec::new();
    for line in text.lines() {
        if let Some(condition) = cover(line) {
            if seen == index {
                lines.push(format!("    always @* assert (!({condition}));"));
            }
            seen += 1;
        } else {
            lines.push(line.replace("assert (", "assume ("));
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_cover_is_claimed_never_to_happen() {
        let text = "always @* assert (a);\nalways @* cover (b);\nalways @* cover (c && (d));";
        assert_eq!(conditions(text), ["b", "c && (d)"]);
        assert_eq!(
            refutable(text, 1),
            "always @* assume (a);\n    always @* assert (!(c && (d)));"
        );
    }
}
