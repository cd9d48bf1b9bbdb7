//! Mutants: the emitted Verilog with one thing wrong, which the proofs or the lockstep must notice.
//!
//! A mutant differs in one place of one line: an inversion dropped, a gate or comparison of another
//! kind, a constant off by one, a condition inverted, a register that never changes.

use std::path::Path;

use anyhow::Context;

use super::alike::{Likeness, alike};
use super::lockstep::History;
use super::properties::{Verdict, prove};
use super::sources::Sources;
use super::synthesis::read_block;
use crate::tools::{read, write_scratch};

/// One wrong line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mutant {
    /// The module.
    pub module: String,
    /// Its line, from 1.
    pub line: usize,
    /// The line as it is emitted.
    pub was: String,
    /// The line with the mistake.
    pub now: String,
}

/// What noticed a mutant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The block's properties no longer hold.
    Properties,
    /// The block's outputs differ from the engine's.
    Lockstep,
    /// Nothing did, and yosys proves it the same as the original: it is no mistake.
    Equivalent,
    /// Nothing did.
    Survived,
}

impl Fate {
    /// True when the properties or the lockstep noticed it.
    #[must_use]
    pub fn is_noticed(&self) -> bool {
        matches!(self, Self::Properties | Self::Lockstep)
    }
}

/// Pairs of texts exchanged for one another, blanks around them so that they stand alone.
const EXCHANGES: [(&str, &str); 16] = [
    (" & ", " | "),
    (" | ", " & "),
    (" ^ ", " ~^ "),
    (" == ", " != "),
    (" != ", " == "),
    (" >= ", " > "),
    (" < ", " <= "),
    (" + ", " - "),
    (" - ", " + "),
    ("~", ""),
    ("if (", "if (!"),
    ("1'b0;", "1'b1;"),
    ("1'b1;", "1'b0;"),
    ("[0]", "[1]"),
    ("(&", "(|"),
    ("(|", "(&"),
];

/// Every mutant of a module.
///
/// # Errors
///
/// When its file cannot be read.
pub fn of_module(sources: &Sources, module: &str) -> anyhow::Result<Vec<Mutant>> {
    let text = read(&sources.verilog.join(format!("{module}.v")))?;
    let mut mutants = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let is_logic = !line.trim_start().starts_with("//") && !line.contains("wire ");
        for now in if is_logic { wrong(line) } else { Vec::new() } {
            let (module, was) = (module.to_owned(), line.trim().to_owned());
            mutants.push(Mutant { module, line: index + 1, was, now });
        }
    }
    Ok(mutants)
}

/// The line with each possible mistake.
fn wrong(line: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for (from, to) in EXCHANGES {
        for (place, _) in line.match_indices(from) {
            let (before, after) = (&line[..place], &line[place + from.len()..]);
            let closes = if to == "if (!" { negated(after) } else { after.to_owned() };
            lines.push(format!("{before}{to}{closes}"));
        }
    }
    lines.extend(constants(line));
    if let Some((left, right)) = line.split_once(" <= ").filter(|_| !line.ends_with("_d;")) {
        lines.push(format!("{left} < {right}"));
    }
    if let Some((register, _)) = line.split_once(" <= ").filter(|_| line.ends_with("_d;")) {
        lines.push(format!("{register} <= {};", register.trim()));
    }
    lines
}

/// The rest of an `if (` whose condition is now inverted: brackets around it.
fn negated(after: &str) -> String {
    match after.rsplit_once(") begin") {
        Some((condition, _)) => format!("({condition})) begin"),
        None => after.to_owned(),
    }
}

/// The line with each sized constant, decimal or hexadecimal, one larger.
fn constants(line: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for (mark, radix) in [("'d", 10), ("'h", 16)] {
        for (place, _) in line.match_indices(mark) {
            let rest = &line[place + mark.len()..];
            let length = rest.find(|digit: char| !digit.is_digit(radix)).unwrap_or(rest.len());
            if let Ok(number) = u64::from_str_radix(&rest[..length], radix) {
                let (before, after) = (&line[..place + mark.len()], &rest[length..]);
                lines.push(match radix {
                    10 => format!("{before}{}{after}", number + 1),
                    _ => format!("{before}{:x}{after}", number + 1),
                });
            }
        }
    }
    lines
}

/// Tries the lockstep, then the proofs, on a mutant.
///
/// # Errors
///
/// When a tool cannot be started or a file cannot be read or written.
pub fn try_mutant(sources: &Sources, mutant: &Mutant, history: &History) -> anyhow::Result<Fate> {
    let folder = tempfile::tempdir()?;
    let wrong = infected(sources, mutant, folder.path())?;
    // Clocks are over sooner than proofs.
    if history.first_difference(&wrong)?.is_some() {
        return Ok(Fate::Lockstep);
    }
    if sources.blocks()?.contains(&mutant.module)
        && matches!(prove(&wrong, &mutant.module)?, Verdict::NotProven { .. })
    {
        return Ok(Fate::Properties);
    }
    Ok(if equivalent(sources, &wrong, &mutant.module)? { Fate::Equivalent } else { Fate::Survived })
}

/// A copy of the sources with the mutant in it.
fn infected(sources: &Sources, mutant: &Mutant, folder: &Path) -> anyhow::Result<Sources> {
    for module in sources.modules()? {
        let mut text = read(&sources.verilog.join(format!("{module}.v")))?;
        if module == mutant.module {
            let mut lines: Vec<_> = text.lines().collect();
            *lines.get_mut(mutant.line - 1).context("a line of the module")? = &mutant.now;
            text = lines.join("\n");
        }
        write_scratch(&folder.join(format!("{module}.v")), &text)?;
    }
    Ok(Sources { verilog: folder.to_owned(), properties: sources.properties.clone() })
}

/// True when both modules answer alike for ever from power-up.
fn equivalent(sources: &Sources, wrong: &Sources, module: &str) -> anyhow::Result<bool> {
    let (likeness, _) = alike(module, &read_block(sources, module), &read_block(wrong, module))?;
    Ok(likeness == Likeness::Alike)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_mistake_is_one_place() {
        assert_eq!(
            wrong("    assign a = b & ~c;"),
            ["    assign a = b | ~c;", "    assign a = b & c;"]
        );
        assert_eq!(wrong("        a_q <= a_d;"), ["        a_q <= a_q;"]);
        assert_eq!(wrong("x = y + 4'd5;"), ["x = y - 4'd5;", "x = y + 4'd6;"]);
        assert_eq!(wrong("if (a) begin"), ["if (!(a)) begin"]);
    }
}
