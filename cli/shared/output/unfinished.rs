//! A file while it is filled: it has no name, so that an interruption leaves nothing behind.

use std::fs::{DirEntry, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempPath;

/// How temporary names begin.
pub(super) const PREFIX: &str = ".helixlock-";

/// A file on its way; where the system needs a name for it, it goes with the value.
#[derive(Debug)]
pub(super) struct Unfinished {
    file: File,
    folder: PathBuf,
    name: Option<TempPath>,
}

impl Unfinished {
    /// A new file on the file system of a folder.
    pub(super) fn new(folder: &Path) -> io::Result<Self> {
        let (file, name) = if let Some(file) = unnamed(folder) {
            (file, None)
        } else {
            let (file, name) = named(folder)?;
            (file, Some(name))
        };
        // Says to those who clear the folder that its writer lives; not every system can.
        let _ = file.try_lock();
        Ok(Self { file, folder: folder.to_owned(), name })
    }

    /// The file itself.
    pub(super) fn file(&self) -> &File {
        &self.file
    }

    /// Gives it a temporary name in its folder, which it keeps until it is renamed.
    pub(super) fn named(self) -> io::Result<(File, PathBuf)> {
        if let Some(name) = self.name {
            return Ok((self.file, name.keep()?));
        }
        let process = std::process::id();
        for number in 0..u32::MAX {
            let path = self.folder.join(format!("{PREFIX}{process}-{number}"));
            match link(&self.file, &path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                linked => return linked.map(|()| (self.file, path)),
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }
}

/// Removes what writers that live no more have left under temporary names.
pub(super) fn clear(folder: &Path) {
    for path in abandoned(folder) {
        // Who cannot remove it can still write beside it.
        let _ = std::fs::remove_file(path);
    }
}

/// Files under temporary names whose writers live no more.
pub(super) fn abandoned(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let is_abandoned = |entry: &DirEntry| {
        let temporary = entry.file_name().to_str().is_some_and(|name| name.starts_with(PREFIX));
        let plain = entry.file_type().is_ok_and(|kind| kind.is_file());
        temporary && plain && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
    };
    entries.flatten().filter(is_abandoned).map(|entry| entry.path()).collect()
}

#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    if !Path::new("/proc/self/fd").is_dir() {
        return None; // it could not be given a name later
    }
    rustix::fs::open(folder, flags, Mode::from_raw_mode(0o644)).ok().map(File::from)
}

#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use std::os::fd::AsRawFd;

    use rustix::fs::{AtFlags, CWD};
    let open = format!("/proc/self/fd/{}", file.as_raw_fd());
    Ok(rustix::fs::linkat(CWD, open, CWD, path, AtFlags::SYMLINK_FOLLOW)?)
}

#[cfg(not(target_os = "linux"))]
fn unnamed(_: &Path) -> Option<File> {
    None
}

#[cfg(not(target_os = "linux"))]
fn link(_: &File, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// A file under a temporary name, readable like any new file once it is renamed.
fn named(folder: &Path) -> io::Result<(File, TempPath)> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o644));
    }
    Ok(builder.tempfile_in(folder)?.into_parts())
}
