//! Which files of a folder `gen` has written, so that it replaces those and no others.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::bail;
use helixlock_gen::Project;
use helixlock_lab::fingerprint;

use crate::shared::output::Batch;

/// Where it is kept, beside the files.
const NAME: &str = ".helixlock.json";

/// Names with the fingerprints of what was written.
pub(crate) struct Written(BTreeMap<String, String>);

impl Written {
    /// What an earlier run has left; nothing where none has been.
    pub(crate) fn read(folder: &Path) -> Self {
        let bytes = std::fs::read(folder.join(NAME)).unwrap_or_default();
        Self(serde_json::from_slice(&bytes).unwrap_or_default())
    }

    /// What this run writes.
    pub(crate) fn of(project: &Project) -> Self {
        let of = |(name, text): &(String, String)| (name.clone(), fingerprint(text.as_bytes()));
        Self(project.files.iter().map(of).collect())
    }

    /// Refuses to replace files that are of somebody else, or were changed since.
    pub(crate) fn spare_others(&self, folder: &Path, project: &Project) -> anyhow::Result<()> {
        for (name, text) in &project.files {
            let path = folder.join(name);
            let Ok(found) = std::fs::read(&path) else { continue };
            let ours = self.0.get(name).is_some_and(|known| *known == fingerprint(&found));
            if !ours && found != text.as_bytes() {
                bail!(
                    "{}: found a file that `gen` has not written so, expected none\n\
                     hint: another folder, or `--force` to replace it",
                    path.display()
                );
            }
        }
        Ok(())
    }

    /// Leaves it for the next run.
    pub(crate) fn write(&self, files: &mut Batch) -> anyhow::Result<()> {
        files.write_json(NAME, &self.0)
    }
}
