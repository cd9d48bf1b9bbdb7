//! The table in `docs/verification.md`, and whether it is that of the Verilog as it is now.
//!
//! The proofs take minutes, so a test does not repeat them all: the table carries a checksum of the
//! Verilog and the properties it was made from, and is stale when that has changed.

use std::path::Path;

use anyhow::{Context, bail};

use super::sources::Sources;
use crate::tools::read;

/// Where the table begins; the checksum and the end of the comment follow.
const BEGIN: &str = "<!-- cargo xtask prove --write, of sources ";

/// Where it ends.
const END: &str = "<!-- end of what it wrote -->";

/// The document.
const DOCUMENT: &str = "docs/verification.md";

/// Puts a table into the document.
///
/// # Errors
///
/// When the document cannot be read or written, or has lost its marks.
#[expect(clippy::disallowed_methods, reason = "the one file this task is asked to write")]
pub fn write(root: &Path, sources: &Sources, table: &str) -> anyhow::Result<()> {
    let path = root.join(DOCUMENT);
    let text = read(&path)?;
    let (before, _, after) = parts(&text)?;
    let checksum = checksum(sources)?;
    let text = format!("{before}{BEGIN}{checksum} -->\n{}\n{END}{after}", table.trim_end());
    std::fs::write(&path, text).with_context(|| path.display().to_string())
}

/// True when the table was made from the Verilog and the properties as they are.
///
/// # Errors
///
/// When a file cannot be read, or the document has lost its marks.
pub fn is_fresh(root: &Path, sources: &Sources) -> anyhow::Result<bool> {
    let text = read(&root.join(DOCUMENT))?;
    let (_, written, _) = parts(&text)?;
    Ok(written.starts_with(&checksum(sources)?))
}

/// What is before the table's mark, from the checksum to the end mark, and behind it.
fn parts(text: &str) -> anyhow::Result<(&str, &str, &str)> {
    let found = text.split_once(BEGIN).and_then(|(before, rest)| {
        rest.split_once(END).map(|(written, after)| (before, written, after))
    });
    let Some(found) = found else {
        bail!("{DOCUMENT}: expected `{BEGIN}` and `{END}`");
    };
    Ok(found)
}

/// FNV-1a of all names and texts, in order of name.
fn checksum(sources: &Sources) -> anyhow::Result<String> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |text: &str| {
        for byte in text.bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for module in sources.modules()? {
        take(&module);
        take(&read(&sources.verilog.join(format!("{module}.v")))?);
    }
    for block in sources.blocks()? {
        take(&block);
        take(&sources.properties_of(&block)?);
    }
    Ok(format!("{hash:016x}"))
}
