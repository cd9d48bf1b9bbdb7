//! `helixlock screw`: grades a lead screw from its travel deviation.

mod page;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};
use clap::{Args, ValueEnum};
use helixlock_metrology::Error;
use helixlock_metrology::screw::{
    Characteristic, Curve, FAITHFUL_PER_TURN, Gap, Grading, MeanLine, Status, ToleranceTable,
    Weighting, built_in_table, evaluate_travel, fit_mean_line, grade, helical_characteristics,
    pitch_characteristics,
};
use serde_json::{Map, Value, json};

use crate::shared::output::Batch;
use crate::shared::quantity::{deviation_um, lead_mm, length_mm, length_um, position_mm};
use crate::shared::series::{Series, print_json};

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

/// A screw evaluated by either standard.
pub(crate) struct Evaluation {
    /// The file.
    pub(crate) path: PathBuf,
    /// Name of the standard.
    pub(crate) standard: String,
    /// The useful travel.
    pub(crate) curve: Curve,
    /// Lead, mm.
    pub(crate) lead_mm: f64,
    /// Mean line; the helix of JB/T 2886 is judged without it.
    pub(crate) mean_line: MeanLine,
    /// Samples a turn.
    pub(crate) samples_per_turn: f64,
    /// Sampling intervals in 300 mm.
    pub(crate) intervals_in_300_mm: Option<usize>,
    /// The characteristics.
    pub(crate) characteristics: Vec<Characteristic>,
    /// Stretches without samples.
    pub(crate) gaps: Vec<Gap>,
    /// The grades.
    pub(crate) grading: Grading,
    /// Standard uncertainty, µm.
    pub(crate) uncertainty_um: Option<f64>,
}

impl Screw {
    /// Evaluates, writes, prints.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let table = self.tolerance_table()?;
        if let Some(asked) = &self.grade
            && !table.grades.contains(asked)
        {
            let (found, expected) = (asked.clone(), table.grades.join(", "));
            bail!("`--grade`: {}", Error::UnknownGrade { found, expected });
        }
        let evaluation = self.evaluate(&table)?;
        let asked = self.grade.as_ref().map(|grade| (grade.as_str(), evaluation.meets(grade)));
        let result = json_of(&evaluation, asked);
        if let Some(output) = &self.output {
            write_files(output, &evaluation, &result)?;
        }
        if self.json {
            print_json(out, &result)?;
        } else {
            print(out, &evaluation, asked)?;
        }
        let refused = asked.is_some_and(|(_, meets)| !meets);
        Ok(if refused { ExitCode::from(1) } else { ExitCode::SUCCESS })
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
        ToleranceTable::parse(&text).map_err(|error| anyhow!("{}: {error}", path.display()))
    }

    fn evaluate(&self, table: &ToleranceTable) -> anyhow::Result<Evaluation> {
        let series = Series::read(&self.data, self.pass)?;
        let (travel, deviation) = (series.column("position_mm")?, series.column("lead_error_um")?);
        let whole = Curve::new(&travel, &deviation).map_err(|error| series.refused(&error))?;
        let curve = self.useful(&whole).map_err(|error| series.refused(&error))?;
        let weighting = match self.weighting {
            By::Samples => Weighting::Samples,
            By::Travel => Weighting::Travel,
        };
        let variation = evaluate_travel(&curve, self.lead, self.compensation, weighting)?;
        let characteristics = match self.standard {
            Standard::Iso3408 => variation.characteristics.to_vec(),
            Standard::Jbt2886 => {
                let mut all = helical_characteristics(&curve, self.lead).to_vec();
                all.extend(pitch_characteristics(&curve, self.lead));
                all
            }
        };
        let grading = grade(table, &characteristics, curve.length_mm(), self.uncertainty);
        Ok(Evaluation {
            path: self.data.clone(),
            standard: table.standard.clone(),
            lead_mm: self.lead,
            mean_line: fit_mean_line(&curve, weighting),
            samples_per_turn: variation.samples_per_turn,
            intervals_in_300_mm: variation.intervals_in_300_mm,
            gaps: variation.gaps,
            uncertainty_um: self.uncertainty,
            characteristics,
            grading,
            curve,
        })
    }

    /// The useful travel, without run-outs.
    fn useful(&self, whole: &Curve) -> Result<Curve, Error> {
        let run_out_mm = self.run_out.unwrap_or(0.0);
        let from_mm = self.from.unwrap_or(whole.first_mm()) + run_out_mm;
        let to_mm = self.to.unwrap_or(whole.last_mm()) - run_out_mm;
        whole.between(from_mm, to_mm)
    }
}

impl Evaluation {
    /// True when the grade holds.
    fn meets(&self, grade: &str) -> bool {
        self.grading.verdicts.iter().any(|verdict| verdict.grade == grade && verdict.holds)
    }

    /// What a reader of the result must know.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for one in &self.characteristics {
            if let Err(why) = &one.reached {
                notes.push(format!("{} has no value: {why}", one.symbol));
            }
        }
        if self.samples_per_turn < FAITHFUL_PER_TURN {
            let found = self.samples_per_turn;
            notes.push(format!("{found:.1} samples a turn: what varies within a turn is a lower bound, expected {FAITHFUL_PER_TURN} or more"));
        }
        for gap in &self.gaps {
            let (from, to) = (gap.from_mm, gap.to_mm);
            notes.push(format!(
                "no samples from {from:.3} mm to {to:.3} mm: a variation across it is a lower bound"
            ));
        }
        if self.grading.status != Status::Verified {
            let status = self.grading.status.name();
            notes.push(format!("the limits of this grade are {status}: see the source of each"));
        }
        if let Some(status) = self.grading.refused_by.filter(|s| *s != Status::Verified) {
            let status = status.name();
            notes.push(format!("a better grade is refused by limits, some of them {status}"));
        }
        notes
    }
}

fn write_files(output: &Path, evaluation: &Evaluation, result: &Value) -> anyhow::Result<()> {
    let page = page::page(evaluation);
    let figure = page::figure(evaluation).svg();
    let mut files = Batch::new(output)?;
    files.write_content("figure.svg", figure)?;
    files.write_json("result.json", result)?;
    files.write_content("report.html", page.html())?;
    files.keep()
}

/// A grade as a number, or as text where a table names it otherwise.
fn grade_json(grade: &str) -> Value {
    grade.parse::<i64>().map_or_else(|_| json!(grade), Value::from)
}

fn json_of(evaluation: &Evaluation, asked: Option<(&str, bool)>) -> Value {
    let (curve, grading) = (&evaluation.curve, &evaluation.grading);
    let mut result = Map::new();
    let mut put = |key: &str, value: Value| result.insert(key.into(), value);
    put("standard", json!(evaluation.standard));
    put("lead_mm", json!(evaluation.lead_mm));
    put("useful_travel_mm", json!(curve.length_mm()));
    put("from_mm", json!(curve.first_mm()));
    put("to_mm", json!(curve.last_mm()));
    put("samples", json!(curve.travel_mm().len()));
    put("samples_per_turn", json!(evaluation.samples_per_turn));
    put("intervals_in_300_mm", json!(evaluation.intervals_in_300_mm));
    put("mean_line", mean_line_json(&evaluation.mean_line));
    for one in &evaluation.characteristics {
        let key = key(one.symbol);
        let reached = one.reached.as_ref().ok();
        put(&format!("{key}_um"), json!(reached.map(|reached| reached.value_um)));
        put(
            &format!("{key}_at_mm"),
            json!(reached.map(helixlock_metrology::screw::Reached::stretch_mm)),
        );
        if one.symbol == "e" {
            put("mean_travel_deviation_um", json!(reached.map(|reached| reached.value_um)));
        }
    }
    put("grade", json!(grading.grade.as_deref().map(grade_json)));
    put("status", json!(grading.status.name()));
    put("refused_by", json!(grading.refused_by.map(Status::name)));
    put("uncertainty_um", json!(evaluation.uncertainty_um));
    put("not_judged", json!(grading.not_judged));
    if let Some((grade, meets)) = asked {
        put("asked", json!({ "grade": grade_json(grade), "holds": meets }));
    }
    put("characteristics", evaluation.characteristics.iter().map(characteristic_json).collect());
    put("grades", verdicts_json(grading));
    put(
        "gaps",
        evaluation.gaps.iter().map(|g| json!({ "from_mm": g.from_mm, "to_mm": g.to_mm })).collect(),
    );
    put("notes", json!(evaluation.notes()));
    Value::Object(result)
}

fn mean_line_json(line: &MeanLine) -> Value {
    json!({ "start_um": line.start_um, "slope_um_per_m": line.slope_um_per_mm * 1000.0 })
}

/// Key of a characteristic: its symbol in plain letters.
fn key(symbol: &str) -> String {
    symbol.to_lowercase().replace('δ', "delta_").replace('π', "pi")
}

fn characteristic_json(one: &Characteristic) -> Value {
    match &one.reached {
        Ok(reached) => json!({
            "symbol": one.symbol,
            "meaning": one.meaning,
            "value_um": reached.value_um,
            "at_mm": reached.stretch_mm(),
            "highest_at_mm": reached.highest_mm,
            "lowest_at_mm": reached.lowest_mm,
        }),
        Err(why) => json!({
            "symbol": one.symbol, "meaning": one.meaning, "value_um": null, "missing": why.to_string(),
        }),
    }
}

fn verdicts_json(grading: &Grading) -> Value {
    let verdict = |verdict: &helixlock_metrology::screw::GradeVerdict| {
        let limits = verdict.judgements.iter().map(|one| {
            json!({
                "symbol": one.symbol,
                "value_um": one.value_um,
                "limit_um": one.limit_um,
                "holds": one.holds,
                "probability": one.probability,
                "status": one.status.name(),
                "source": one.source,
            })
        });
        json!({
            "grade": grade_json(&verdict.grade),
            "holds": verdict.holds,
            "probability": verdict.probability,
            "status": verdict.status.name(),
            "without_limit": verdict.without_limit,
            "unmeasured": verdict.unmeasured,
            "limits": limits.collect::<Vec<_>>(),
        })
    };
    grading.verdicts.iter().map(verdict).collect()
}

fn print(
    out: &mut impl Write,
    evaluation: &Evaluation,
    asked: Option<(&str, bool)>,
) -> anyhow::Result<()> {
    let (curve, grading) = (&evaluation.curve, &evaluation.grading);
    let (length, samples) = (curve.length_mm(), curve.travel_mm().len());
    writeln!(
        out,
        "{}: {samples} samples over {length:.3} mm, by {}",
        evaluation.path.display(),
        evaluation.standard
    )?;
    if let Some(intervals) = evaluation.intervals_in_300_mm {
        writeln!(out, "{intervals} intervals in 300 mm, every sample a start")?;
    }
    let slope = evaluation.mean_line.slope_um_per_mm * 1000.0;
    writeln!(out, "mean line {slope:+.3} µm/m\n")?;
    for one in &evaluation.characteristics {
        if let Ok(reached) = &one.reached {
            let [from, to] = reached.stretch_mm();
            writeln!(
                out,
                "{:<6} {:9.3} µm   {from:10.3} … {to:.3} mm   {}",
                one.symbol, reached.value_um, one.meaning
            )?;
        }
    }
    writeln!(out)?;
    let status = grading.status.name();
    match &grading.grade {
        Some(grade) => writeln!(out, "grade {grade} (limits {status})")?,
        None => writeln!(out, "no grade of the table holds (limits {status})")?,
    }
    for verdict in &grading.verdicts {
        if let Some(probability) = verdict.probability {
            writeln!(out, "  grade {} or better: probability {probability:.4}", verdict.grade)?;
        }
    }
    if let Some((grade, meets)) = asked {
        writeln!(out, "grade {grade} is {}", if meets { "met" } else { "not met" })?;
    }
    for note in evaluation.notes() {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}
