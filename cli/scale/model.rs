//! `helixlock scale model`: a scale like the document's, and what limits its compensation.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_metrology::scale::{
    Detector, Direction, ModelledScale, Residual, Spread, residual_budget,
};
use helixlock_report::{Colour, Page, Panel, Part, Series, Style, Table};
use helixlock_traces::csv::RowWriter;

use super::build::print_build;
use super::json::ModelJson;
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::page_pieces::{panel, picture};
use crate::shared::quantity::{length_mm, length_um};

/// Pitch of an inductosyn, mm.
const PITCH_MM: f64 = 2.0;

/// The run that a table is built of.
const TABLE_RUN: &str = "table-run.csv";

/// Model a scale of ±5.5 µm, compensate it, and show what limits the rest
#[derive(Debug, Args)]
pub(crate) struct Model {
    /// Length of the scale, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "250 mm")]
    length: f64,
    /// Amplitude of the slow error, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "4.7 um")]
    long_wave: f64,
    /// Amplitude of the interpolation error, one period a pitch of 2 mm, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.55 um")]
    interpolation: f64,
    /// Phase of the interpolation error at the places of the table, degrees
    #[arg(long, value_name = "DEG", default_value_t = 0.0)]
    interpolation_phase: f64,
    /// Error forward less error backward, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.4 um")]
    reversal: f64,
    /// Scatter of a sample, standard deviation, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    scatter: f64,
    /// Weight of the least of the eight bits, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    lsb: f64,
    /// Distance of the table's places, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "1 mm")]
    step: f64,
    /// Motion of one step of the corrector, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    step_size: f64,
    /// Seed of the scatter
    #[arg(long, value_name = "N", default_value_t = 3)]
    seed: u64,
    /// Folder for table-run.csv, check-run.csv and report.html
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl Model {
    /// Models, writes, prints.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let (before, budget) = self.budget()?;
        let written = match &self.output {
            Some(output) => {
                let files = Batch::new(output, [])?.in_language(out.language());
                self.write_files(files, &budget)?
            }
            None => Written::default(),
        };
        if self.json {
            print_json(out, &ModelJson::new(&before, &budget))?;
            return Ok(ExitCode::SUCCESS);
        }
        writeln!(out, "before  ±{:.2} µm", before.largest_um)?;
        for one in &budget {
            writeln!(
                out,
                "after   ±{:.2} µm, rms {:.3} µm   without {}",
                one.left.largest_um, one.left.rms_um, one.without
            )?;
        }
        written.print(out)?;
        if let Some(output) = &self.output {
            print_build(out, &output.join(TABLE_RUN))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Errors before compensation, and what is left of them.
    fn budget(&self) -> anyhow::Result<(Spread, Vec<Residual>)> {
        if 1e6 < self.length / self.step {
            bail!(
                "`--length` holds {:.0} steps of `--step`, expected a million or fewer",
                self.length / self.step
            );
        }
        let (scale, detector) = (self.scale(), self.detector());
        let check = scale.samples(self.step / 20.0, &detector, 2);
        let before = Spread::of(&check.iter().map(|sample| sample.error_um).collect::<Vec<_>>());
        Ok((before, residual_budget(&scale, &detector, self.step, self.step_size)))
    }

    fn detector(&self) -> Detector {
        Detector { pitch_mm: PITCH_MM, lsb_um: self.lsb }
    }

    fn scale(&self) -> ModelledScale {
        ModelledScale {
            length_mm: self.length,
            long_wave_um: self.long_wave,
            long_wave_mm: 1.6 * self.length,
            interpolation_um: self.interpolation,
            interpolation_phase_rad: self.interpolation_phase.to_radians(),
            reversal_um: self.reversal,
            scatter_um: self.scatter,
            seed: self.seed,
        }
    }

    fn write_files(&self, mut files: Batch, budget: &[Residual]) -> anyhow::Result<Written> {
        let (scale, detector) = (self.scale(), self.detector());
        let page = self.page(&scale, budget);
        for (name, step_mm, run) in
            [(TABLE_RUN, self.step, 1), ("check-run.csv", self.step / 10.0, 2)]
        {
            let samples = scale.samples(step_mm, &detector, run);
            files.write(name, |file| {
                let mut rows = RowWriter::new(file, &["position_mm", "error_um", "direction"])?;
                for sample in &samples {
                    let way = if sample.direction == Direction::Forward { 1.0 } else { -1.0 };
                    rows.row(&[sample.position_mm, sample.error_um, way])?;
                }
                Ok(())
            })?;
        }
        files.write_page(&page)?;
        files.kept()
    }

    /// The budget as a page.
    fn page(&self, scale: &ModelledScale, budget: &[Residual]) -> Page {
        let mut table = Table::new(["without", "left ± in µm", "rms in µm"]);
        for one in budget {
            let (largest, rms) = (one.left.largest_um, one.left.rms_um);
            table.row([one.without.to_owned(), format!("{largest:.2}"), format!("{rms:.3}")]);
        }
        Page {
            title: "What limits the compensation of a scale".into(),
            summary: "Errors left after compensation, and what would be left without each of their causes.".into(),
            parts: vec![
                picture(
                    self.panels(scale),
                    "A table with two places a pitch cannot tell the interpolation error from a \
                     constant or a line.",
                ),
                Part::Table(table),
            ],
        }
    }

    /// The true error over the scale, and over a few pitches with what a table of its step sees.
    fn panels(&self, scale: &ModelledScale) -> Vec<Panel> {
        let error = |x: f64| [x, scale.error_um(x, Direction::Forward, PITCH_MM)];
        let along = |to_mm: f64, step_mm: f64| {
            (0..).map(move |k: u32| f64::from(k) * step_mm).take_while(move |x| *x <= to_mm)
        };
        let few_mm = (6.0 * PITCH_MM).min(self.length);
        let line = |to_mm: f64, step_mm: f64| {
            Series::new("error", Colour::Blue, Style::Line, along(to_mm, step_mm).map(error))
        };
        let places = along(few_mm, self.step).map(error);
        let seen = Series::new("places of the table", Colour::Orange, Style::Dots, places);
        let few = vec![line(few_mm, 0.02), seen];
        let panel = |title, series| panel(title, "position in mm", "error in µm", series);
        vec![
            panel("the scale, forward", vec![line(self.length, self.length / 5000.0)]),
            panel("a few pitches: what the table sees is aliased", few),
        ]
    }
}

impl Answering for Model {
    fn answer(&self) -> anyhow::Result<Answer> {
        let (before, budget) = self.budget()?;
        Answer::new(&ModelJson::new(&before, &budget))
    }
}
