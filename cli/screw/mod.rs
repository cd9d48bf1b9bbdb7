//! `helixlock screw`: grades a lead screw from its travel deviation.

mod evaluation;
mod json;
mod page;
mod sheet;
mod text;

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::{Args, ValueEnum};
use helixlock_metrology::Error;
use helixlock_metrology::screw::{
    Characteristic, Curve, Doubt, Estimate, Grading, ToleranceTable, Weighting, built_in_table,
    doubt, evaluate_travel, grade, helical_characteristics, pitch_characteristics,
    without_reading_noise, without_wild,
};
use helixlock_traces::{Column, Table};

use self::evaluation::Evaluation;
use self::json::ScrewJson;
use self::sheet::{Measured, reading_noise_um, sheet_of, with_budgets};
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::quantity::{deviation_um, lead_mm, length_mm, length_um, position_mm};
use crate::shared::refused::in_file;
use crate::shared::series::Series;
use crate::shared::sheet::{Sheet, SheetFile, Subject};

/// Grade a lead screw from its travel deviation
///
/// Reads `position_mm` and `lead_error_um` (positive: the thread is too long) from CSV or Parquet.
/// ISO 3408-3 gives e (mean travel deviation), Vu, V300 and V2π (variation over the useful travel,
/// any 300 mm, any turn, parallel to the least-squares mean line). JB/T 2886 gives the helical axial
/// error in any turn, 25, 100, 300 mm and the useful length, and pitch errors. Windows are closed and
/// begin at every sample; nothing is interpolated at their ends. Exit status 1: the grade asked for
/// with `--grade` is not met.
#[derive(Debug, Args)]
pub(crate) struct Screw {
    /// Measured travel deviation
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Standard to grade by
    #[arg(long, value_enum, default_value = "iso3408-3")]
    standard: Standard,
    /// Lead, such as "5 mm", "1/6 in", "0.5 pi mm"
    #[arg(long, value_name = "LENGTH", value_parser = lead_mm)]
    lead: f64,
    /// Begin of the useful travel, mm [default: first sample]
    #[arg(long, value_name = "MM", value_parser = position_mm, allow_hyphen_values = true)]
    from: Option<f64>,
    /// End of the useful travel, mm [default: last sample]
    #[arg(long, value_name = "MM", value_parser = position_mm, allow_hyphen_values = true)]
    to: Option<f64>,
    /// Thread run-out to leave out at each end, mm
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    run_out: Option<f64>,
    /// Travel compensation asked for over the useful travel, µm
    #[arg(long, value_name = "UM", value_parser = deviation_um, allow_hyphen_values = true, default_value = "0")]
    compensation: f64,
    /// Standard uncertainty (k = 1) of each characteristic, µm: gives every grade its probability
    #[arg(long, value_name = "UM", value_parser = length_um)]
    uncertainty: Option<f64>,
    /// Standard deviation of a single reading, independent from reading to reading, µm: takes off
    /// what noise adds to each characteristic, and gives it an uncertainty and every grade a probability
    #[arg(long, value_name = "UM", value_parser = length_um, conflicts_with = "uncertainty")]
    reading_noise: Option<f64>,
    /// What is known of the measurement, tolerances, and what is printed on the sheet: gives every
    /// figure its uncertainty, and the grade asked for is decided by ISO 14253-1
    #[arg(long, value_name = "SHEET.toml", conflicts_with = "uncertainty")]
    sheet: Option<PathBuf>,
    /// Seed of the curves that `--reading-noise` draws; equal seeds give equal results
    #[arg(long, default_value = "1")]
    seed: u64,
    /// Grade the screw has to meet
    #[arg(long, value_name = "GRADE")]
    grade: Option<String>,
    /// What a sample counts for in the mean line
    #[arg(long, value_enum, default_value = "samples")]
    weighting: By,
    /// Tolerance table of your own instead of the one shipped
    #[arg(long, value_name = "TABLE.toml")]
    table: Option<PathBuf>,
    /// Pass to evaluate, when the file holds several
    #[arg(long, value_name = "PASS")]
    pass: Option<f64>,
    /// Folder for report.html, figure.svg and result.json
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Standards there are tables for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Standard {
    /// Ball screws: ISO 3408-3, JB 3162.2, GB/T 17587.3
    #[value(name = "iso3408-3")]
    Iso3408,
    /// Trapezoidal screws of machine tools
    #[value(name = "jbt2886")]
    Jbt2886,
}

/// Weighting on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum By {
    /// Every sample alike, as the standard's formulas
    Samples,
    /// Every sample by the travel it stands for
    Travel,
}

impl Screw {
    /// Evaluates, writes, prints.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let evaluation = self.evaluate()?;
        let asked = self.asked(&evaluation);
        let result = ScrewJson::new(&evaluation, asked);
        let inputs = self.table.iter().chain(&self.sheet).chain([&self.data]).cloned();
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
            text::print(out, &evaluation, asked)?;
            written.print(out)?;
        }
        Ok(if evaluation.holds(asked) { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn tolerance_table(&self) -> anyhow::Result<ToleranceTable> {
        let Some(path) = &self.table else {
            return Ok(built_in_table(match self.standard {
                Standard::Iso3408 => "iso3408-3",
                Standard::Jbt2886 => "jbt2886",
            })?);
        };
        let text = std::fs::read_to_string(path)
            .with_context(|| format!("{}: cannot be read", path.display()))?;
        ToleranceTable::parse(&text).map_err(in_file(path))
    }

    /// The grade asked for, and whether it is met.
    fn asked(&self, evaluation: &Evaluation) -> Option<(&str, bool)> {
        self.grade.as_ref().map(|grade| (grade.as_str(), evaluation.meets(grade)))
    }

    fn evaluate(&self) -> anyhow::Result<Evaluation> {
        let table = self.tolerance_table()?;
        if let Some(asked) = &self.grade
            && !table.grades.contains(asked)
        {
            let (found, expected) = (asked.clone(), table.grades.join(", "));
            bail!("`--grade`: {}", Error::UnknownGrade { found, expected });
        }
        let series = Series::read(&self.data, self.pass)?;
        let (travel, deviation) = (series.column("position_mm")?, series.column("lead_error_um")?);
        let whole = Curve::new(&travel, &deviation).map_err(|error| series.refused(error))?;
        let curve = self.useful(&whole).map_err(|error| series.refused(error))?;
        let weighting = match self.weighting {
            By::Samples => Weighting::Samples,
            By::Travel => Weighting::Travel,
        };
        let variation = evaluate_travel(&curve, self.lead, self.compensation, weighting)?;
        let evaluate = |curve: &Curve| self.characteristics(curve, weighting);
        let measured = Measured { curve: &curve, evaluate: &evaluate };
        let characteristics = evaluate(&curve);
        let subject = Subject::Positions(curve.length_mm());
        let file = self.sheet.as_deref().map(|path| SheetFile::read(path, subject)).transpose()?;
        let (file, noise_um) = match file {
            None => (None, self.reading_noise),
            Some(mut file) => {
                let noise_um = reading_noise_um(&mut file, self.reading_noise)?;
                (Some(file), noise_um)
            }
        };
        let (doubt, wild_mm) = doubts(&curve, noise_um);
        let file = file.map(|file| if doubt.is_some() { file.without_noise_known() } else { file });
        let mut estimates = self.estimates(&measured, noise_um, &characteristics);
        let sheet = file.map(|file| sheet_of(file, &measured, &estimates, noise_um)).transpose()?;
        if let Some(sheet) = &sheet {
            estimates = with_budgets(sheet, &characteristics, estimates);
        }
        let grading = grade(&table, &characteristics, curve.length_mm(), &estimates);
        let sheet = sheet.map(|sheet| self.with_limits_of_the_grade(sheet, &grading));
        Ok(Evaluation {
            path: self.data.clone(),
            left_out: travel.len() - whole.travel_mm().len(),
            asked_mm: [self.from, self.to],
            data_mm: [whole.first_mm(), whole.last_mm()],
            standard: table.standard,
            lead_mm: self.lead,
            mean_line: variation.mean_line,
            samples_per_turn: variation.samples_per_turn,
            intervals_in_300_mm: variation.intervals_in_300_mm,
            gaps: variation.gaps,
            uncertainty_um: self.uncertainty,
            reading_noise_um: noise_um,
            doubt,
            wild_mm,
            characteristics,
            estimates,
            grading,
            sheet,
            curve,
        })
    }

    /// The characteristics of the standard.
    fn characteristics(&self, curve: &Curve, weighting: Weighting) -> Vec<Characteristic> {
        match self.standard {
            // The lead, all that can be refused, was accepted before.
            Standard::Iso3408 => evaluate_travel(curve, self.lead, self.compensation, weighting)
                .map_or_else(|_| Vec::new(), |found| found.characteristics.to_vec()),
            Standard::Jbt2886 => {
                let mut all = helical_characteristics(curve, self.lead).to_vec();
                all.extend(pitch_characteristics(curve, self.lead));
                all
            }
        }
    }

    /// The limits of the grade asked for are tolerances where the sheet has no other.
    fn with_limits_of_the_grade(&self, mut sheet: Sheet, grading: &Grading) -> Sheet {
        let asked = grading.verdicts.iter().find(|one| Some(&one.grade) == self.grade.as_ref());
        for limit in asked.into_iter().flat_map(|verdict| &verdict.judgements) {
            let line = sheet.lines.iter_mut().find(|line| line.named.symbol == limit.symbol);
            if let Some(line) = line.filter(|line| line.tolerance_um.is_none()) {
                line.tolerance_um = Some(limit.limit_um);
            }
        }
        sheet
    }

    /// What is known of each characteristic: nothing, unless its uncertainty or the noise is.
    fn estimates(
        &self,
        measured: &Measured<'_>,
        noise_um: Option<f64>,
        characteristics: &[Characteristic],
    ) -> Vec<Option<Estimate>> {
        if let Some(noise_um) = noise_um {
            let (curve, evaluate) = (measured.curve, measured.evaluate);
            return without_reading_noise(curve, noise_um, self.lead, self.seed, evaluate);
        }
        let estimate = |one: &Characteristic| {
            let size_um = one.reached.ok()?.value_um.abs();
            Some(Estimate { size_um, uncertainty_um: self.uncertainty? })
        };
        characteristics.iter().map(estimate).collect()
    }

    /// The useful travel, without run-outs.
    fn useful(&self, whole: &Curve) -> Result<Curve, Error> {
        let run_out_mm = self.run_out.unwrap_or(0.0);
        let from_mm = self.from.unwrap_or(whole.first_mm()) + run_out_mm;
        let to_mm = self.to.unwrap_or(whole.last_mm()) - run_out_mm;
        whole.between(from_mm, to_mm)
    }
}

impl Answering for Screw {
    /// With the table `travel`: the useful travel with its deviation.
    fn answer(&self) -> anyhow::Result<Answer> {
        let evaluation = self.evaluate()?;
        let answer = Answer::new(&ScrewJson::new(&evaluation, self.asked(&evaluation)))?;
        let curve = &evaluation.curve;
        let travel = Table::new(vec![
            Column::new("position_mm", curve.travel_mm().to_vec()),
            Column::new("lead_error_um", curve.deviation_um().to_vec()),
        ]);
        Ok(answer.with_table("travel", travel))
    }
}

/// Why nothing is said without noise, and places of readings far off their neighbours, mm.
fn doubts(curve: &Curve, noise_um: Option<f64>) -> (Option<Doubt>, Vec<f64>) {
    let Some(noise_um) = noise_um else { return (None, Vec::new()) };
    let (rest, wild_mm) = without_wild(curve, noise_um);
    (doubt(&rest, noise_um), wild_mm)
}

fn write_files(
    mut files: Batch,
    evaluation: &Evaluation,
    result: &ScrewJson<'_>,
) -> anyhow::Result<Written> {
    let page = page::page(evaluation);
    files.write_report(&page::figure(evaluation), result, &page)?;
    files.kept()
}
