//! `helixlock scale apply`: what a table leaves of measured errors.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, ValueEnum};
use helixlock_metrology::scale::{Corrected, Detector, Direction, LookUp, Scheme, apply};
use helixlock_traces::csv::write_csv;
use helixlock_traces::{Column, Table};

use super::comparison::Comparison;
use super::export::print_export;
use super::image::read_image;
use super::json::AppliedJson;
use super::samples::read_samples;
use super::{page, text};
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::quantity::{length_um, position_mm};

/// Take the errors off measured ones, by a table
#[derive(Debug, Args)]
pub(crate) struct Apply {
    /// EEPROM image, Intel HEX or binary
    #[arg(value_name = "IMAGE")]
    image: PathBuf,
    /// Measured errors
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Who takes the errors off
    #[arg(long, value_enum, default_value = "step")]
    scheme: By,
    /// Motion of one step of the corrector, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    step_size: f64,
    /// Resolution of the display, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.5 um")]
    resolution: f64,
    /// Read the table by straight lines between its places, not by the nearest place
    #[arg(long)]
    interpolate: bool,
    /// Position of the origin pulse, mm
    #[arg(long, value_name = "MM", value_parser = position_mm, allow_hyphen_values = true, default_value = "0")]
    origin: f64,
    /// Largest error that may be left, µm; exit status 1 beyond
    #[arg(long, value_name = "UM", value_parser = length_um)]
    limit: Option<f64>,
    /// Folder for corrected.csv, report.html, figure.svg and result.json
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Schemes on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum By {
    /// Scheme 1: step the tool
    Step,
    /// Scheme 2: correct the displayed value
    Display,
}

impl Apply {
    /// Does it.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let comparison = self.compared()?;
        let result = AppliedJson::new(&comparison, self.limit);
        let written = match &self.output {
            Some(output) => {
                let files = Batch::new(output, [self.image.clone(), self.data.clone()])?
                    .in_language(out.language());
                write_applied(files, &comparison, &result)?
            }
            None => Written::default(),
        };
        if self.json {
            print_json(out, &result)?;
        } else {
            text::print_applied(out, &comparison, self.limit)?;
            written.print(out)?;
            print_export(out, &self.image)?;
        }
        let exceeded = self.limit.is_some_and(|limit| !comparison.keeps(limit));
        Ok(if exceeded { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }

    fn compared(&self) -> anyhow::Result<Comparison> {
        let table = read_image(&self.image)?;
        let detector = Detector { pitch_mm: 2.0, lsb_um: table.lsb_um };
        let samples = read_samples(&self.data, self.origin, &detector)?;
        let scheme = match self.scheme {
            By::Step => Scheme::Step { step_um: self.step_size },
            By::Display => Scheme::Display { resolution_um: self.resolution },
        };
        let look_up = if self.interpolate { LookUp::Linear } else { LookUp::Nearest };
        let corrected = apply(&table, &samples, scheme, look_up);
        Ok(Comparison::new(&self.data, corrected))
    }
}

impl Answering for Apply {
    /// With the table `corrected`.
    fn answer(&self) -> anyhow::Result<Answer> {
        let comparison = self.compared()?;
        let answer = Answer::new(&AppliedJson::new(&comparison, self.limit))?;
        Ok(answer.with_table("corrected", corrected_table(&comparison)))
    }
}

fn write_applied(
    mut files: Batch,
    comparison: &Comparison,
    result: &AppliedJson<'_>,
) -> anyhow::Result<Written> {
    let page = page::page(comparison);
    files.write_report(&page::figure(comparison), result, &page)?;
    let corrected = corrected_table(comparison);
    files.write("corrected.csv", |mut file| Ok(write_csv(&corrected, &mut file)?))?;
    files.kept()
}

fn corrected_table(comparison: &Comparison) -> Table {
    let column = |name: &str, value: fn(&Corrected) -> f64| {
        Column::new(name, comparison.corrected.iter().map(value).collect())
    };
    Table::new(vec![
        column("position_mm", |one| one.sample.position_mm),
        column("error_um", |one| one.sample.error_um),
        column(
            "direction",
            |one| {
                if one.sample.direction == Direction::Forward { 1.0 } else { -1.0 }
            },
        ),
        column("correction_um", |one| one.correction_um.unwrap_or(f64::NAN)),
        column("steps", steps),
        column("left_um", |one| one.left_um),
    ])
}

#[expect(clippy::cast_precision_loss, reason = "a correction holds few steps")]
fn steps(one: &Corrected) -> f64 {
    one.steps as f64
}
