//! `helixlock diagnose`: which effects a model lacks, and how sure that is.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::{Diagnosis, Problem, Verdict, diagnose};
use helixlock_plant::MachineFile;

use crate::shared::angular::in_unit;
use crate::shared::answer::{Answer, Answering};
use crate::shared::diagnosis_json::DiagnosisJson;
use crate::shared::diagnosis_page::page;
use crate::shared::diagnosis_text::print;
use crate::shared::effect_file::own_effects;
use crate::shared::language::Reporter;
use crate::shared::measured::Files;
use crate::shared::next::Next;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::residual_table::residual_table;
use crate::shared::words::status;

/// Name the effects that a machine file lacks, with evidence, rivals, and the experiment that tells
#[derive(Debug, Args)]
pub(crate) struct Diagnose {
    #[command(flatten)]
    files: Files,
    /// TOML file with custom effects to try beside the catalogue
    #[arg(long = "with", visible_alias = "custom", value_name = "EFFECTS")]
    custom: Option<PathBuf>,
    /// Folder for `report.html`
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Diagnose {
    /// Prints the diagnosis; exit status 1 when the input itself is doubted, else 0.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let (file, problem, diagnosis) = self.found()?;
        let mut written = Written::default();
        if let Some(folder) = &self.output {
            let mut inputs = self.files.inputs(&file.model);
            inputs.extend(self.custom.clone());
            let mut files = Batch::new(folder, inputs)?.in_language(out.language());
            files.write_page(&page(&problem, &diagnosis, Vec::new()))?;
            written = files.kept()?;
        }
        if self.json {
            let json = DiagnosisJson::new(&diagnosis, &problem.measurement);
            print_json(out, &in_unit(&json, problem.measurement.unit_word())?)?;
        } else {
            print(out, &diagnosis, &problem.measurement)?;
            written.print(out)?;
            self.print_next(diagnosis.verdict, out)?;
        }
        Ok(status(diagnosis.verdict))
    }

    /// What was named is learned; where no name fits, a formula may.
    fn print_next(&self, verdict: Verdict, out: &mut impl Write) -> anyhow::Result<()> {
        let (command, output) = match verdict {
            Verdict::Explained | Verdict::Ambiguous => ("learn", "learned"),
            Verdict::Unexplained => ("discover", "proposed.toml"),
            Verdict::NothingMissing | Verdict::DoubtfulInput => return Ok(()),
        };

        let mut next = Next::command(command).words(self.files.words());
        if let Some(custom) = self.custom.as_ref().filter(|_| command == "learn") {
            next = next.words(["--with"]).words([custom]);
        }
        next.output(output).print(out)
    }

    fn found(&self) -> anyhow::Result<(MachineFile, Problem, Diagnosis)> {
        let (file, mut problem) = self.files.read()?;
        if let Some(custom) = &self.custom {
            problem.extra = own_effects(&file, custom)?;
        }
        let diagnosis = diagnose(&problem);
        Ok((file, problem, diagnosis))
    }
}

impl Answering for Diagnose {
    /// With the table `residual`, before and after the effects that were found.
    fn answer(&self) -> anyhow::Result<Answer> {
        let (_, problem, found) = self.found()?;
        let json = DiagnosisJson::new(&found, &problem.measurement);
        let answer = Answer::in_unit(&json, problem.measurement.unit_word())?;
        let residual =
            residual_table(&problem, &[("before", &found.before), ("after", &found.left)]);
        Ok(answer.with_table("residual", residual))
    }
}
