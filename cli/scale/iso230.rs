//! `helixlock scale iso230`: positioning accuracy by ISO 230-2.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_metrology::iso230::{Approaches, Figure};
use helixlock_metrology::scale::Detector;
use helixlock_metrology::uncertainty::{Acts, Budget, Readings, Source};

use super::axis_test::AxisTest;
use super::build::print_build;
use super::json::AxisTestJson;
use super::samples::{read_samples, targets};
use super::{axis_page, text};
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::quantity::length_um;
use crate::shared::refused::in_file;
use crate::shared::sheet::{Named, Sheet, SheetFile, Subject};

/// Evaluate positioning accuracy by ISO 230-2
///
/// With `--sheet` every figure has its uncertainty, by a budget of what contributes to it as ISO/TR
/// 230-9 names it, and the decision by ISO 14253-1 on the tolerances of the sheet. Exit status 1: a
/// tolerance or the limit is not kept, or with an uncertainty not proven to be.
#[derive(Debug, Args)]
pub(crate) struct Iso230 {
    /// Measured errors: two approaches or more of every target and direction
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Accuracy A that must not be exceeded, µm; exit status 1 beyond
    #[arg(long, value_name = "UM", value_parser = length_um)]
    limit: Option<f64>,
    /// Expanded uncertainty of A (k = 2), µm: the limit is then decided by ISO 14253-1
    #[arg(long, value_name = "UM", value_parser = length_um, requires = "limit")]
    expanded_uncertainty: Option<f64>,
    /// What is known of the measurement, tolerances, and what is printed on the sheet
    #[arg(long, value_name = "SHEET.toml", conflicts_with = "expanded_uncertainty")]
    sheet: Option<PathBuf>,
    /// Folder for report.html, a sheet to sign, figure.svg and result.json
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Each reading is changed once and all are evaluated anew.
const MOST_READINGS: usize = 10_000;

impl Iso230 {
    /// Does it.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let test = self.test()?;
        let result = AxisTestJson::new(&test);
        let inputs = self.sheet.iter().chain([&self.data]).cloned();
        let written = match &self.output {
            Some(output) => {
                let files = Batch::new(output, inputs)?.in_language(out.language());
                write_files(files, &self.data, &test, &result)?
            }
            None => Written::default(),
        };
        if self.json {
            print_json(out, &result)?;
        } else {
            text::print_axis(out, &test)?;
            written.print(out)?;
            print_build(out, &self.data)?;
        }
        Ok(if test.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn test(&self) -> anyhow::Result<AxisTest> {
        // Eight-bit codes are of no use here: approaches come as errors.
        let detector = Detector { pitch_mm: 2.0, lsb_um: 1.0 };
        let samples = read_samples(&self.data, 0.0, &detector)?;
        let errors = samples.iter().map(|sample| (*sample, sample.error_um));
        let approaches = Approaches::new(targets(errors)).map_err(in_file(&self.data))?;
        Ok(AxisTest {
            sheet: self.sheet_of(&approaches)?,
            found: approaches.found().clone(),
            told: self.sheet.is_some(),
            notes: copied(&approaches),
        })
    }

    fn sheet_of(&self, approaches: &Approaches) -> anyhow::Result<Sheet> {
        let subject = Subject::Positions(approaches.length_mm());
        let file = self.sheet.as_deref().map(|path| SheetFile::read(path, subject)).transpose()?;
        let mut file =
            file.unwrap_or_else(SheetFile::empty).with_tolerance("accuracy", self.limit)?;
        let sources = std::mem::take(&mut file.sources);
        let readings = approaches.readings();
        if file.missing.is_empty() && MOST_READINGS < readings {
            let path = self.data.display();
            bail!(
                "{path}: {readings} readings, expected {MOST_READINGS} or fewer for an uncertainty"
            );
        }
        let noise_um = noise_um(&sources);
        // Beyond half of it what the readings vary by is taken for the axis' own scatter.
        if approaches.scatter_um() < 2.0 * noise_um {
            file.missing
                .push("the axis alone: half its scatter and more may be that of the readings");
        }
        let named = |figure: Figure| Named {
            symbol: figure.symbol.into(),
            key: figure.key.into(),
            meaning: figure.meaning.into(),
            value_um: figure.value_um,
        };
        let figures = approaches.found().figures().into_iter().map(named).collect();
        let mut sheet = Sheet::new(file, figures, approaches, &sources)?;
        if let Some((line, expanded_um)) = sheet.lines.first_mut().zip(self.expanded_uncertainty) {
            line.budget = Some(Budget::told(line.named.value_um, expanded_um));
        }
        Ok(sheet)
    }
}

impl Answering for Iso230 {
    fn answer(&self) -> anyhow::Result<Answer> {
        Answer::new(&AxisTestJson::new(&self.test()?))
    }
}

/// Approaches that are the same at every target: rows that are there twice make a scatter smaller.
fn copied(approaches: &Approaches) -> Vec<String> {
    let of = |[one, other]: [usize; 2]| {
        let places = approaches.found().targets.len();
        format!(
            "approaches {} and {} of all {places} targets are the same: are rows there twice?",
            one + 1,
            other + 1
        )
    };
    approaches.copied().map(of).into_iter().collect()
}

/// What adds to every reading on its own, as a standard uncertainty, µm.
fn noise_um(sources: &[Source]) -> f64 {
    let of = |source: &Source| match source.acts {
        Acts::AtEachReading(per_unit) | Acts::AsTimeGoes(per_unit) => per_unit * source.standard,
        _ => 0.0,
    };
    sources.iter().map(|source| of(source).powi(2)).sum::<f64>().sqrt()
}

fn write_files(
    mut files: Batch,
    data: &Path,
    test: &AxisTest,
    result: &AxisTestJson<'_>,
) -> anyhow::Result<Written> {
    files.write_report(&axis_page::figure(test), result, &axis_page::page(data, test))?;
    files.kept()
}
