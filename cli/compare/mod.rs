//! `helixlock compare`: how large the residual is, whether it is noise, and where it fails.

mod json;
mod page;
mod text;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::compare;

use self::json::ComparisonJson;
use crate::shared::angular::in_unit;
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::measured::Files;
use crate::shared::next::Next;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::residual_table::{residual_table, spectrum_table};

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
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let (file, problem) = self.files.read()?;
        let comparison = compare(&problem);
        let mut written = Written::default();
        if let Some(folder) = &self.output {
            let page = page::page(&problem, &comparison);
            let mut files =
                Batch::new(folder, self.files.inputs(&file.model))?.in_language(out.language());
            files.write_page(&page)?;
            written = files.kept()?;
        }
        if self.json {
            let json = ComparisonJson::new(&comparison, &problem.measurement);
            print_json(out, &in_unit(&json, problem.measurement.unit_word())?)?;
        } else {
            text::print(out, &comparison, &problem.measurement)?;
            written.print(out)?;
            if !comparison.noise_only && comparison.doubts.is_empty() {
                Next::command("diagnose").words(self.files.words()).print(out)?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Answering for Compare {
    /// With the tables `residual` and `spectrum`.
    fn answer(&self) -> anyhow::Result<Answer> {
        let (_, problem) = self.files.read()?;
        let comparison = compare(&problem);
        let json = ComparisonJson::new(&comparison, &problem.measurement);
        let answer = Answer::in_unit(&json, problem.measurement.unit_word())?;
        let spectra: Vec<_> =
            comparison.sensors.iter().map(|sensor| sensor.spectrum.as_slice()).collect();
        Ok(answer
            .with_table("residual", residual_table(&problem, &[("residual", &comparison.residual)]))
            .with_table("spectrum", spectrum_table(&problem, &spectra)))
    }
}
