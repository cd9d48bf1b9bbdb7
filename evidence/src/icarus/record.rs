//! What has been compared: a row of a table each, written as soon as it is known.

use std::fmt;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

use anyhow::Context;

use crate::tools::read;

const HEAD: &str = "circuit,delays,seed,pulses,netlist,edges\n";

/// Circuit and delays that gave the same edges in both simulators.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Name of the circuit.
    pub circuit: String,
    /// `shortest`, `typical`, `longest` or `drawn`.
    pub delays: String,
    /// Of the pulses, and of the delays when they are drawn.
    pub seed: u64,
    /// At each pin.
    pub pulses: usize,
    /// Checksum of the Verilog, which has the delays.
    pub netlist: u64,
    /// How many edges were compared.
    pub edges: usize,
}

impl fmt::Display for Row {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let Self { circuit, delays, seed, pulses, netlist, edges } = self;
        write!(out, "{circuit},{delays},{seed},{pulses},{netlist:016x},{edges}")
    }
}

/// The rows of a file; none when there is no file yet. A last line without its end is none: the
/// command was interrupted there.
///
/// # Errors
///
/// When the file cannot be read, or is another one.
pub fn rows(path: &Path) -> anyhow::Result<Vec<Row>> {
    if !path.exists() {
        return Ok(vec![]);
    }
    let text = read(path)?;
    let lines = text.strip_prefix(HEAD).with_context(|| format!("{}: the head", path.display()))?;
    let whole = lines.rfind('\n').map_or("", |end| &lines[..end]);
    whole.lines().map(|line| row(line).with_context(|| format!("`{line}`"))).collect()
}

fn row(line: &str) -> Option<Row> {
    let mut words = line.split(',');
    Some(Row {
        circuit: words.next()?.to_owned(),
        delays: words.next()?.to_owned(),
        seed: words.next()?.parse().ok()?,
        pulses: words.next()?.parse().ok()?,
        netlist: u64::from_str_radix(words.next()?, 16).ok()?,
        edges: words.next()?.parse().ok()?,
    })
}

/// Writes the rows that still count, so that those to come can follow them.
pub(super) fn begin(path: &Path, rows: &[Row]) -> anyhow::Result<()> {
    let lines: String = rows.iter().flat_map(|row| [row.to_string(), "\n".to_owned()]).collect();
    append(path, true, &format!("{HEAD}{lines}"))
}

pub(super) fn add(path: &Path, row: &Row) -> anyhow::Result<()> {
    append(path, false, &format!("{row}\n"))
}

fn append(path: &Path, anew: bool, text: &str) -> anyhow::Result<()> {
    let mut options = OpenOptions::new();
    options.create(true).write(true).append(!anew).truncate(anew);
    let mut file = options.open(path).with_context(|| path.display().to_string())?;
    file.write_all(text.as_bytes()).with_context(|| path.display().to_string())
}
