//! The table in `docs/verification.md`, and whether it is that of the Verilog as it is now.
//!
//! The proofs take minutes, so a test does not repeat them all: with the table stands a checksum of
//! each block's Verilog and properties, and what is said of the block is stale when that has changed.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, bail};

use super::sources::Sources;
use super::synthesis;
use super::table::{Share, markdown, shares, total};
use crate::tools::read;

/// Where it begins; a checksum a line follows, and the end of the comment.
const BEGIN: &str = "<!-- cargo xtask prove --write, of sources\n";

/// Where the table begins.
const TABLE: &str = "-->\n";

/// Where it ends.
const END: &str = "<!-- end of what it wrote -->";

/// The document.
const DOCUMENT: &str = "docs/verification.md";

/// What the document says of each block, in the order of the list, and of which sources.
type Printed = Vec<(Share, String)>;

/// Renews the shares of these blocks and the totals; what is said of the others stays as it is.
///
/// # Errors
///
/// When the document cannot be read or written, or has lost its marks.
#[expect(clippy::disallowed_methods, reason = "the one file this task is asked to write")]
pub fn write(root: &Path, sources: &Sources, renewed: Vec<Share>) -> anyhow::Result<()> {
    let path = root.join(DOCUMENT);
    let text = read(&path)?;
    let (before, checksums, table, after) = parts(&text)?;
    let merged = merged(printed(checksums, table), renewed, &present(sources)?);
    let lines = merged.iter().map(|(share, checksum)| format!("{} {checksum}\n", share.block));
    let checksums: String = lines.collect();
    let shares: Vec<_> = merged.into_iter().map(|(share, _)| share).collect();
    let table = markdown(&shares);
    let text = format!("{before}{BEGIN}{checksums}{TABLE}{}\n{END}{after}", table.trim_end());
    std::fs::write(&path, text).with_context(|| path.display().to_string())
}

/// The blocks whose share was not made from the Verilog and the properties as they are; "the totals"
/// when they are not the sum.
///
/// # Errors
///
/// When a file cannot be read, or the document has lost its marks.
pub fn stale(root: &Path, sources: &Sources) -> anyhow::Result<Vec<String>> {
    let text = read(&root.join(DOCUMENT))?;
    let (_, checksums, table, _) = parts(&text)?;
    let printed = printed(checksums, table);
    let mut stale = present(sources)?;
    stale.retain(|block, now| {
        !printed.iter().any(|(share, checksum)| share.block == *block && checksum == now)
    });
    let mut stale: Vec<_> = stale.into_keys().collect();
    let shares: Vec<_> = printed.into_iter().map(|(share, _)| share).collect();
    let sum = total(&shares).row("").line();
    if !table.lines().any(|line| line == sum) {
        stale.push("the totals".to_owned());
    }
    Ok(stale)
}

/// The printed shares with those of them exchanged, or added, that are new.
fn merged(old: Printed, renewed: Vec<Share>, now: &BTreeMap<String, String>) -> Printed {
    let new = renewed.into_iter().filter_map(|share| {
        let checksum = now.get(&share.block)?.clone();
        Some((share, checksum))
    });
    let mut all: BTreeMap<_, _> = BTreeMap::new();
    for (share, checksum) in old.into_iter().chain(new) {
        all.insert(share.block.clone(), (share, checksum));
    }
    synthesis::blocks().filter_map(|card| all.remove(card.name)).collect()
}

/// Shares and checksums of the document.
fn printed(checksums: &str, table: &str) -> Printed {
    let checksum = |block: &str| {
        let found = checksums.lines().find_map(|line| line.strip_prefix(block)?.strip_prefix(' '));
        found.unwrap_or_default().to_owned()
    };
    let with = |share: Share| {
        let checksum = checksum(&share.block);
        (share, checksum)
    };
    shares(table).into_iter().map(with).collect()
}

/// What is before the mark, the checksums, the table, and what is behind it.
fn parts(text: &str) -> anyhow::Result<(&str, &str, &str, &str)> {
    let found = text.split_once(BEGIN).and_then(|(before, rest)| {
        let (written, after) = rest.split_once(END)?;
        let (checksums, table) = written.split_once(TABLE)?;
        Some((before, checksums, table, after))
    });
    let Some(found) = found else {
        bail!("{DOCUMENT}: expected `{}`, `{}` and `{END}`", BEGIN.trim_end(), TABLE.trim_end());
    };
    Ok(found)
}

/// The checksum of every block as it is.
fn present(sources: &Sources) -> anyhow::Result<BTreeMap<String, String>> {
    let blocks = synthesis::blocks().map(|card| card.name);
    blocks.map(|block| Ok((block.to_owned(), checksum(sources, block)?))).collect()
}

/// FNV-1a of names and texts: of the modules that a block is made of, in order of name, and of its
/// properties.
fn checksum(sources: &Sources, block: &str) -> anyhow::Result<String> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |text: &str| {
        for byte in text.bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (module, text) in sources.made_of(block)? {
        take(&module);
        take(&text);
    }
    if sources.blocks()?.iter().any(|proven| proven == block) {
        take(block);
        take(&sources.properties_of(block)?);
    }
    Ok(format!("{hash:016x}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(block: &str, claim: &str) -> Share {
        let lines = vec![format!("| `{block}`: {claim} | so | true |")];
        Share { block: block.to_owned(), lines, unnoticed: Vec::new() }
    }

    #[test]
    fn one_block_is_renewed_and_the_others_stay() {
        let old = vec![
            (share("level_synchroniser", "old"), "1".to_owned()),
            (share("range_stage", "old"), "2".to_owned()),
            (share("a_block_of_the_past", "old"), "3".to_owned()),
        ];
        let blocks = ["level_synchroniser", "range_stage", "device"];
        let now = blocks.map(|block| (block.to_owned(), "now".to_owned())).into();
        let renewed = vec![share("device", "new"), share("range_stage", "new")];
        let expected = [
            (share("level_synchroniser", "old"), "1".to_owned()),
            (share("range_stage", "new"), "now".to_owned()),
            (share("device", "new"), "now".to_owned()),
        ];
        assert_eq!(merged(old, renewed, &now), expected);
    }
}
