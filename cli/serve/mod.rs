//! `helixlock serve`: the workbench in a browser, over one folder.

mod axes;
mod desk;
mod edit;
mod folder;
mod frame;
mod jobs;
mod ledger;
mod measurement;
mod opened;
mod orders;
mod refusal;
mod rounds;
mod said;
mod spectrum;
mod state;
mod trial;
mod waves;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::anyhow;
use clap::Args;
use helixlock_workbench::serve;

use self::desk::Workbench;
use self::folder::Folder;
use crate::shared::browser::open_page;

/// Show the workbench in a browser: where a model fails, which effect, and how the error falls
///
/// Prints one line, the address of the page. Only this machine can reach it, and only with the token
/// in that address. Files are read from DIR and written into it, whole or not at all.
#[derive(Debug, Args)]
pub(crate) struct Serve {
    /// Folder with the machine file and the data
    #[arg(value_name = "DIR", default_value = ".")]
    folder: PathBuf,
    /// Port of 127.0.0.1; 0 takes a free one
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
}

impl Serve {
    /// Serves until the process is ended.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let workbench = Workbench::new(Folder::new(&self.folder)?)?;
        let desk = Arc::new(move |ask| workbench.answer(&ask));
        let mut told = Ok(());
        serve(self.port, &token()?, desk, |address| {
            told = writeln!(out, "{address}").and_then(|()| out.flush());
            if self.open && told.is_ok() {
                told = open_page(out, address);
            }
        })?;
        told?;
        Ok(ExitCode::SUCCESS)
    }
}

/// 128 bits that nobody can guess, as hexadecimal digits.
fn token() -> anyhow::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| anyhow!("no random numbers: {error}"))?;
    Ok(format!("{:032x}", u128::from_be_bytes(bytes)))
}
