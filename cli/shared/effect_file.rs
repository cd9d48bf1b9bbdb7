//! Effects in a file of the user's own.

use std::path::Path;

use anyhow::{Context, bail};
use helixlock_plant::nearest::one_of;
use helixlock_plant::{CATALOGUE, MachineFile, Term};

/// Effects of a user's own file, read as part of the machine.
pub(crate) fn own_effects(file: &MachineFile, path: &Path) -> anyhow::Result<Vec<Term>> {
    let before = file.model.effects.len();
    let whole = file.with_text(&effect_text(path)?, path)?;
    let own = whole.model.effects[before..].to_vec();
    if own.is_empty() {
        bail!("{}: found no effect, expected a table `[[effect]]`", path.display());
    }
    Ok(own)
}

/// The text of that file; its absence is told as the want of an effect.
pub(crate) fn effect_text(path: &Path) -> anyhow::Result<String> {
    let known = || {
        let kinds: Vec<_> = CATALOGUE.iter().map(|card| card.kind).collect();
        format!(
            "{}: neither an effect nor a file, expected {}, or a TOML file with `[[effect]]`",
            path.display(),
            one_of(&path.to_string_lossy(), &kinds)
        )
    };
    std::fs::read_to_string(path).with_context(known)
}
