//! Where an output goes: what stands there decides how it is written.

use std::fs::{Metadata, Permissions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

/// Links that lead to links are followed this far, as the system does.
const MOST_LINKS: usize = 40;

/// Where an output goes in the end.
#[derive(Clone, Debug)]
pub(super) enum Target {
    /// A file, or nothing yet: it is replaced by one that is whole.
    File {
        /// Its own name, where links lead.
        path: PathBuf,
        /// Those of the file that stands there.
        mode: Option<Permissions>,
    },
    /// A device or a pipe: it is written into.
    Stream(PathBuf),
}

impl Target {
    /// Looks at what stands at a path.
    ///
    /// Refuses a name that the system does not take, a folder, a file that may not be written, and
    /// one that the command itself has read.
    pub(super) fn of(path: &Path, inputs: &[PathBuf]) -> anyhow::Result<Self> {
        let place = path.display();
        let found = match std::fs::metadata(path) {
            Ok(found) => found,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Ok(Self::File { path: followed(path), mode: None });
            }
            // A name that is too long, say: no file could ever have it.
            Err(error) => return Err(error).with_context(|| super::cannot(path)),
        };
        if found.is_dir() {
            bail!("{place}: found a folder, expected a file or nothing");
        }
        if !found.is_file() || is_open_already(path) {
            return Ok(Self::Stream(path.to_owned()));
        }
        if let Some(input) = inputs.iter().find(|input| is_same(&found, input)) {
            bail!(
                "{place}: is read by this command (`{}`) and would be replaced, expected another output",
                input.display()
            );
        }
        if found.permissions().readonly() {
            bail!("{place}: found a file that may not be written, expected another output");
        }
        let path = path.canonicalize().with_context(|| format!("{place}: cannot be written"))?;
        Ok(Self::File { path, mode: Some(found.permissions()) })
    }
}

/// The end of a chain of links that leads to nothing yet.
pub(super) fn followed(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Ok(next) = std::fs::read_link(&path) else { break };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
}

/// A name such as `/dev/stdout` for what the command was started with.
fn is_open_already(path: &Path) -> bool {
    ["/dev/stdin", "/dev/stdout", "/dev/stderr", "/dev/fd", "/proc/self/fd"]
        .iter()
        .any(|name| path.starts_with(name))
}

#[cfg(unix)]
fn is_same(found: &Metadata, input: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let other = std::fs::metadata(input);
    other.is_ok_and(|other| (found.dev(), found.ino()) == (other.dev(), other.ino()))
}

#[cfg(not(unix))]
fn is_same(_: &Metadata, input: &Path) -> bool {
    let _ = input;
    false
}
