//! The one folder that the workbench reads and writes.

use std::path::{Component, Path, PathBuf};

use anyhow::{Context, bail};

use crate::shared::output::Batch;

/// A folder, and nothing outside of it.
#[derive(Debug)]
pub(crate) struct Folder {
    root: PathBuf,
}

impl Folder {
    /// A folder that is there.
    pub(crate) fn new(path: &Path) -> anyhow::Result<Self> {
        let root = path
            .canonicalize()
            .with_context(|| format!("{}: cannot be opened, expected a folder", path.display()))?;
        if !root.is_dir() {
            bail!("{}: found a file, expected a folder", path.display());
        }
        Ok(Self { root })
    }

    /// The folder itself.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// The place of a name below the folder; a name that leads out of it, or to something hidden, is
    /// refused, by whatever links.
    pub(crate) fn path(&self, name: &str) -> anyhow::Result<PathBuf> {
        let outside = || format!("`{name}` is no name of a file in {}", self.root.display());
        let plain = |part| matches!(part, Component::Normal(word) if !word.to_string_lossy().starts_with('.'));
        let path = Path::new(name);
        if name.is_empty() || name.contains(['\\', '\0']) || !path.components().all(plain) {
            bail!(outside());
        }
        let path = self.root.join(path);
        // A pipe would be waited for, a device read without end.
        if path.metadata().is_ok_and(|there| !there.is_file() && !there.is_dir()) {
            bail!("`{name}`: found a pipe or a device, expected a file");
        }
        let there = path.ancestors().find_map(|part| part.canonicalize().ok());
        if !there.is_some_and(|there| there.starts_with(&self.root)) {
            bail!(outside());
        }
        Ok(path)
    }

    /// The bytes of a file.
    pub(crate) fn read(&self, name: &str) -> anyhow::Result<Vec<u8>> {
        std::fs::read(self.path(name)?).with_context(|| format!("{name}: cannot be read"))
    }

    /// The text of a file.
    pub(crate) fn text(&self, name: &str) -> anyhow::Result<String> {
        let bytes = self.read(name)?;
        String::from_utf8(bytes).ok().with_context(|| format!("{name}: found no UTF-8 text"))
    }

    /// True when a file is there.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.path(name).is_ok_and(|path| path.is_file())
    }

    /// Writes files that belong together, each whole, in this order.
    pub(crate) fn write(&self, files: &[(&str, &[u8])]) -> anyhow::Result<()> {
        let mut batch = Batch::new(&self.root, [])?;
        for (name, content) in files {
            self.path(name)?;
            batch.write_content(name, content)?;
        }
        batch.keep()
    }

    /// Names of its files, in order; those of folders below are not listed.
    pub(crate) fn names(&self) -> anyhow::Result<Vec<String>> {
        let mut names = Vec::new();
        for entry in std::fs::read_dir(&self.root)? {
            let name = entry?.file_name();
            names.extend(name.to_str().filter(|name| self.has(name)).map(str::to_owned));
        }
        names.sort();
        Ok(names)
    }

    /// `data.csv`, or `data-2.csv` and so on where that is taken by something else.
    pub(crate) fn free_name(&self, stem: &str, ending: &str) -> String {
        let numbered = |number: u32| match number {
            1 => format!("{stem}.{ending}"),
            _ => format!("{stem}-{number}.{ending}"),
        };
        let free = |name: &String| !self.root.join(name).exists();
        (1..u32::MAX).map(numbered).find(free).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_outside_the_folder_is_reached() {
        let outer = tempfile::tempdir().unwrap();
        let inner = outer.path().join("inner");
        Batch::new(&inner.join("below"), []).unwrap().keep().unwrap();
        crate::shared::output::write_content(&outer.path().join("secret"), [], "x").unwrap();
        let folder = Folder::new(&inner).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(outer.path(), inner.join("link")).unwrap();
        for name in ["../secret", "/etc/passwd", "below/../../secret", "", ".hidden", "a\\..\\b"] {
            assert!(folder.path(name).is_err(), "{name}");
        }
        #[cfg(unix)]
        assert!(folder.path("link/secret").is_err() && folder.path("link/new").is_err());
        assert!(folder.path("below/new.csv").is_ok() && folder.path("new.csv").is_ok());
    }

    #[test]
    fn a_free_name_is_nobodys() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::new(place.path()).unwrap();
        assert_eq!(folder.free_name("data", "csv"), "data.csv");
        folder.write(&[("data.csv", b"x"), ("data-2.csv", b"y")]).unwrap();
        assert_eq!(folder.free_name("data", "csv"), "data-3.csv");
        assert_eq!(folder.names().unwrap(), ["data-2.csv", "data.csv"]);
    }
}
