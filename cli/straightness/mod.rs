//! `helixlock straightness`: a guideway and a workpiece apart, from three probes.

mod evaluation;
mod json;
mod page;
mod readings;
mod sheet;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};
use clap::Args;
use helixlock_metrology::straightness::{
    Combined, CompensationModel, Plan, Readings, Separated, Spacing, correction_table, plan,
    propose, separate_by_fourier, separate_by_least_squares, simulate_compensation,
};
use helixlock_traces::csv::write_csv;
use helixlock_traces::{Column, Table};

use self::evaluation::{By, Evaluation, Outcome};
use self::json::{PlansJson, StraightnessJson};
use self::readings::read_readings;
use self::sheet::sheet_of;
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::quantity::{length_mm, length_um};
use crate::shared::refused::in_file;
use crate::shared::sheet::{SheetFile, Subject};

/// Separate a guideway and a workpiece by three probes
///
/// Reads `position_mm`, `probe1_um`, `probe2_um`, `probe3_um` and, when runs were repeated, `repeat`:
/// carriage positions at even steps; probe 2 touches the bar L1 behind probe 1, probe 3 L2 behind
/// probe 2. Gives straightness of the bar and the carriage, the carriage's tilt, and their
/// uncertainty, by Fourier series and by least squares without periodicity. Exit status 1: the
/// straightness exceeds `--limit`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
pub(crate) struct StraightnessCommand {
    /// Readings of the three probes; not needed with `--plan`
    #[arg(value_name = "DATA", required_unless_present = "plan")]
    data: Option<PathBuf>,
    /// Probe spacings L1 and L2, such as "25 mm,30 mm"
    #[arg(long, value_name = "L1,L2", value_parser = length_mm, value_delimiter = ',', required_unless_present = "plan")]
    spacing: Vec<f64>,
    /// Show what spacings do to each harmonic, and propose better ones
    #[arg(long)]
    plan: bool,
    /// Samples of the stroke (with `--plan`)
    #[arg(long, value_name = "N", default_value = "32", value_parser = clap::value_parser!(u32).range(4..=100_000))]
    samples: u32,
    /// Sampling step, mm (with `--plan`)
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "5 mm")]
    step: f64,
    /// Longest distance from probe 1 to probe 3 to propose, mm [default: a third of the stroke]
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    longest: Option<f64>,
    /// Method whose result makes the correction table and is held against `--limit`
    #[arg(long, value_enum, default_value = "fourier")]
    method: By,
    /// The probes' zeros are matched: the bar's parabola is measured, not assumed
    #[arg(long)]
    zeros_matched: bool,
    /// Go on although the spacings lose harmonics; those are left at zero
    #[arg(long)]
    accept_lost_harmonics: bool,
    /// Straightness of the bar (minimum zone) that must not be exceeded, µm
    #[arg(long, value_name = "UM", value_parser = length_um)]
    limit: Option<f64>,
    /// What is known of the measurement, tolerances, and what is printed on the sheet: gives the
    /// straightness its uncertainty, and decides tolerances by ISO 14253-1
    #[arg(long, value_name = "SHEET.toml")]
    sheet: Option<PathBuf>,
    /// Step of the correction table, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "1 mm")]
    table_step: f64,
    /// Simulate cutting the next bar with the correction
    #[arg(long)]
    simulate: bool,
    /// Carriage motion that does not repeat, standard deviation, µm [default: from the runs]
    #[arg(long, value_name = "UM", value_parser = length_um)]
    unrepeatable: Option<f64>,
    /// Length over which that motion stays alike, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "20 mm")]
    correlation: f64,
    /// Smallest motion of the corrector, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.01 um")]
    corrector_step: f64,
    /// Seed of the simulation
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Folder for report.html, figure.svg, result.json, separated.csv and correction.csv
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl StraightnessCommand {
    /// Plans, or separates, writes and prints.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        if self.plan {
            return self.run_plan(out);
        }
        let path = self.data()?;
        let evaluation = self.separated(path)?;
        let exceeded = !evaluation.holds(self.limit);
        let result = StraightnessJson::new(&evaluation, self.limit);
        let inputs = self.sheet.as_deref().into_iter().chain([path]).map(Path::to_owned);
        let written = match &self.output {
            Some(output) => {
                let files = Batch::new(output, inputs)?.in_language(out.language());
                write_files(files, &evaluation, &result)?
            }
            None => Written::default(),
        };
        if self.json {
            print_json(out, &result)?;
        } else {
            text::print(out, &evaluation, self.limit)?;
            written.print(out)?;
        }
        Ok(if exceeded { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }

    fn run_plan(&self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let Plans { samples, step_mm, asked, proposals } = self.plans()?;
        if self.json {
            print_json(out, &PlansJson::new(samples, step_mm, asked.as_ref(), &proposals))?;
        } else {
            text::print_plan(out, step_mm, asked.as_ref(), &proposals)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn plans(&self) -> anyhow::Result<Plans> {
        let (samples, step_mm) = match &self.data {
            Some(path) => {
                let readings = read_readings(path)?;
                (readings.samples(), readings.step_mm)
            }
            None => (usize::try_from(self.samples)?, self.step),
        };
        let asked = match self.spacing.as_slice() {
            [] => None,
            _ => Some(plan(self.spacing(step_mm)?, samples)),
        };
        let longest = match self.longest {
            Some(longest_mm) => whole_steps(longest_mm / step_mm).clamp(2, samples),
            None => (samples / 3).max(2),
        };
        Ok(Plans { samples, step_mm, asked, proposals: propose(samples, longest, 5) })
    }

    fn data(&self) -> anyhow::Result<&Path> {
        self.data.as_deref().context("no data, expected a file")
    }

    /// What a file of readings gives.
    fn separated(&self, path: &Path) -> anyhow::Result<Evaluation> {
        let readings = read_readings(path)?;
        #[expect(clippy::cast_precision_loss, reason = "samples of a stroke are few")]
        let stroke_mm = readings.samples() as f64 * readings.step_mm;
        if 1e6 < stroke_mm / self.table_step {
            bail!(
                "`--table-step`: {} mm, expected a millionth of the stroke or more",
                self.table_step
            );
        }
        let spacing = self.spacing(readings.step_mm)?;
        let mut evaluation = self.evaluate(path, &readings, spacing).map_err(in_file(path))?;
        if let Some(path) = &self.sheet {
            let file = SheetFile::read(path, Subject::Heights)?;
            let file = file.with_tolerance("minimum_zone", self.limit)?;
            evaluation.sheet = Some(sheet_of(file, &evaluation)?);
        }
        Ok(evaluation)
    }

    fn spacing(&self, step_mm: f64) -> anyhow::Result<Spacing> {
        let &[first_mm, second_mm] = self.spacing.as_slice() else {
            bail!("`--spacing`: one length, expected two, such as `25 mm,30 mm`")
        };
        Spacing::from_lengths(first_mm, second_mm, step_mm)
            .map_err(|error| anyhow!("`--spacing`: {error}"))
    }

    fn evaluate(
        &self,
        path: &Path,
        readings: &Readings,
        spacing: Spacing,
    ) -> Result<Evaluation, helixlock_metrology::Error> {
        let combined = readings.combine(spacing)?;
        let least_squares = separate_by_least_squares(&combined, self.zeros_matched)?;
        let fourier = separate_by_fourier(&combined, self.accept_lost_harmonics)?;
        let fourier = Outcome::new(fourier.with_difference_from(&least_squares))?;
        let least_squares = Outcome::new(least_squares)?;
        let chosen = match self.method {
            By::Fourier => &fourier.separated,
            By::LeastSquares => &least_squares.separated,
        };
        let correction = correction_table(chosen, self.table_step);
        let compensation = self.simulate.then(|| {
            let model = self.model(readings, &combined, chosen);
            (model, simulate_compensation(chosen, &model))
        });
        Ok(Evaluation {
            path: path.to_owned(),
            repeats: readings.repeats.len(),
            zeros_matched: self.zeros_matched,
            sheet: None,
            plan: plan(spacing, combined.z_um.len()),
            method: self.method,
            rms_difference_um: fourier.separated.rms_difference_um(&least_squares.separated),
            combined,
            fourier,
            least_squares,
            correction,
            compensation,
        })
    }

    /// The simulation's parameters: told, or taken from the runs.
    fn model(
        &self,
        readings: &Readings,
        combined: &Combined,
        separated: &Separated,
    ) -> CompensationModel {
        let from_runs = || readings.unrepeatable_um(combined).unwrap_or(0.0);
        let uncertainty = separated.uncertainty_um.as_ref();
        CompensationModel {
            unrepeatable_um: self.unrepeatable.unwrap_or_else(from_runs),
            correlation_mm: self.correlation,
            measurement_um: uncertainty.and_then(|each| each.first().copied()).unwrap_or(0.0),
            corrector_step_um: self.corrector_step,
            table_step_mm: self.table_step,
            passes: 400,
            seed: self.seed,
        }
    }
}

/// What spacings do, and better ones.
struct Plans {
    samples: usize,
    step_mm: f64,
    asked: Option<Plan>,
    proposals: Vec<Plan>,
}

impl Answering for StraightnessCommand {
    /// With the tables `separated` and `correction`, unless it is a plan.
    fn answer(&self) -> anyhow::Result<Answer> {
        if self.plan {
            let Plans { samples, step_mm, asked, proposals } = self.plans()?;
            return Answer::new(&PlansJson::new(samples, step_mm, asked.as_ref(), &proposals));
        }
        let evaluation = self.separated(self.data()?)?;
        Ok(Answer::new(&StraightnessJson::new(&evaluation, self.limit))?
            .with_table("separated", separated_table(evaluation.chosen()))
            .with_table("correction", correction_rows(&evaluation)))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped by the caller"
)]
fn whole_steps(steps: f64) -> usize {
    (steps + 1e-9).floor() as usize
}

fn write_files(
    mut files: Batch,
    evaluation: &Evaluation,
    result: &StraightnessJson<'_>,
) -> anyhow::Result<Written> {
    let page = page::page(evaluation);
    files.write_report(&page::figure(evaluation), result, &page)?;
    let tables = [
        ("separated.csv", separated_table(evaluation.chosen())),
        ("correction.csv", correction_rows(evaluation)),
    ];
    for (name, table) in &tables {
        files.write(name, |mut file| Ok(write_csv(table, &mut file)?))?;
    }
    files.kept()
}

fn separated_table(outcome: &Outcome) -> Table {
    let found = &outcome.separated;
    let unknown = || vec![f64::NAN; found.position_mm.len()];
    Table::new(vec![
        Column::new("position_mm", found.position_mm.clone()),
        Column::new("workpiece_um", found.workpiece_um.clone()),
        Column::new("carriage_um", found.carriage_um.clone()),
        Column::new("tilt_urad", found.tilt_urad.clone()),
        Column::new("uncertainty_um", found.uncertainty_um.clone().unwrap_or_else(unknown)),
    ])
}

fn correction_rows(evaluation: &Evaluation) -> Table {
    let points = || evaluation.correction.iter();
    Table::new(vec![
        Column::new("position_mm", points().map(|point| point.position_mm).collect()),
        Column::new("correction_um", points().map(|point| point.correction_um).collect()),
    ])
}
