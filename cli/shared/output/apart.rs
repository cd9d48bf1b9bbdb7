//! Outputs of one command that would be the same file.

use std::path::{Path, PathBuf};

use anyhow::bail;

use super::target::followed;

/// What may be written into by all: it keeps nothing.
const NOWHERE: &str = "/dev/null";

/// Refuses outputs of which one would replace another; each is what says where it goes, as messages
/// name it, and the path.
///
/// To be asked before any work: a command that finds out at its end has lost it.
pub(crate) fn apart<'a, P: AsRef<Path> + 'a>(
    outputs: impl IntoIterator<Item = (&'a str, Option<P>)>,
) -> anyhow::Result<()> {
    let mut known: Vec<(&str, PathBuf)> = Vec::new();
    for (option, path) in outputs {
        let Some(path) = path else { continue };
        let (path, end) = (path.as_ref(), end_of(path.as_ref()));
        if let Some((other, _)) = known.iter().find(|(_, known)| *known == end) {
            let place = path.display();
            bail!("{place}: is both {other} and {option} of this command, expected a file each");
        }
        if end != Path::new(NOWHERE) {
            known.push((option, end));
        }
    }
    Ok(())
}

/// Where a path leads, whether or not there is a file yet.
fn end_of(path: &Path) -> PathBuf {
    let path = followed(path);
    let folder = super::folder_of(&path).canonicalize();
    let place = match (folder, path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path,
    };
    place.canonicalize().unwrap_or(place)
}
