//! `helixlock compare`: how large the residual is, whether it is noise, and where it fails.

mod json;
mod page;
mod text;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::compare;

use self::json::ComparisonJson;
use crate::shared::angular::in_unit;
use crate::shared::measured::Files;
use crate::shared::output::{Batch, print_json};

/// Show where a machine file and a measurement part
#[derive(Debug, Args)]
pub(crate) struct Compare {
    #[command(flatten)]
    files: Files,
    /// Folder for `report.html`
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Compare {
    /// Prints the comparison; exit status 0 whatever it says.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let (file, problem) = self.files.read()?;
        let comparison = compare(&problem);
        if let Some(folder) = &self.output {
            let page = page::page(&problem, &comparison).html();
            let mut files = Batch::new(folder, self.files.inputs(&file.model))?;
            files.write_content("report.html", page)?;
            files.keep()?;
        }
        if self.json {
            let json = ComparisonJson::new(&comparison, &problem.measurement);
            print_json(out, &in_unit(&json, problem.measurement.unit_word())?)?;
        } else {
            text::print(out, &comparison, &problem.measurement)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
