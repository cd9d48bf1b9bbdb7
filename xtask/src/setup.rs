//! The tools that the checks run: looked for before anything else, and installed where they may be.

mod list;
mod plan;

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, bail, ensure};

pub use list::{Kind, PACKAGES, Package};
pub use plan::{Plan, Rights, plan};

/// Folder of packages that are not Debian's, below the repository's root.
const FOLDER: &str = "target/tools";

/// Where tools are looked for: what stands in `PATH`, and the folders of the project's own.
#[derive(Clone, Debug)]
pub struct Tools {
    root: PathBuf,
    folders: Vec<PathBuf>,
}

impl Tools {
    /// As things stand on this machine.
    #[must_use]
    pub fn of(root: &Path) -> Self {
        let own = root.join(FOLDER);
        let mut folders = vec![own.join("python/bin"), own.join("node/node_modules/.bin")];
        folders.extend(std::env::var_os("PATH").iter().flat_map(std::env::split_paths));
        Self { root: root.to_owned(), folders }
    }

    /// Makes sure that every package is there: says what is missing, and installs it if it may.
    ///
    /// # Errors
    ///
    /// When one is missing and may not or cannot be installed.
    pub fn prepare(&self, install: bool) -> anyhow::Result<()> {
        let missing: Vec<_> = PACKAGES.iter().filter(|package| !self.has(package)).collect();
        match plan(&missing, self.rights(), install) {
            Plan::Ready => Ok(()),
            Plan::Refuse(message) => bail!(message),
            Plan::Install(commands) => {
                for words in commands {
                    self.install(&words)?;
                }
                let missing = missing.into_iter().find(|package| !self.has(package));
                match missing {
                    Some(package) => bail!("`{}` was installed but is not found", package.name),
                    None => Ok(()),
                }
            }
        }
    }

    /// `PATH` for whatever runs these tools.
    ///
    /// # Errors
    ///
    /// When the repository's path has a `:` in it.
    pub fn path(&self) -> anyhow::Result<OsString> {
        std::env::join_paths(&self.folders).context("`PATH` cannot be set")
    }

    fn has(&self, package: &Package) -> bool {
        let mut places = package.signs.iter().flat_map(|sign| self.beside_commands(sign));
        places.any(|place| place.exists())
    }

    /// Where a command, or a file by its way from the commands, may lie.
    fn beside_commands(&self, sign: &str) -> impl Iterator<Item = PathBuf> {
        self.folders.iter().map(move |folder| folder.join(sign))
    }

    fn rights(&self) -> Rights {
        let there = |command: &str| self.beside_commands(command).any(|place| place.exists());
        if !there("apt-get") {
            Rights::NotDebian
        } else if user_is_root() {
            Rights::Root
        } else if there("sudo") {
            Rights::Sudo
        } else {
            Rights::None
        }
    }

    fn install(&self, words: &[String]) -> anyhow::Result<()> {
        let mut out = std::io::stdout();
        writeln!(out, "installing: {}", words.join(" "))?;
        out.flush()?;
        let mut command = Command::new(&words[0]);
        command.args(&words[1..]).current_dir(&self.root).env("DEBIAN_FRONTEND", "noninteractive");
        let status =
            command.status().with_context(|| format!("`{}` cannot be started", words[0]))?;
        ensure!(status.success(), "`{}` failed", words.join(" "));
        Ok(())
    }
}

fn user_is_root() -> bool {
    let output = Command::new("id").arg("-u").output();
    output.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}
