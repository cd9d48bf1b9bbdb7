//! `helixlock scale`: errors of a machine scale stored, applied, exported, modelled.

mod model;
mod page;
mod samples;
mod summary;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};
use clap::{Args, Subcommand, ValueEnum};
use helixlock_metrology::scale::{
    CorrectionTable, Detector, Direction, JointRule, LookUp, Scheme, TableRule, apply, build_table,
    from_hex, from_image, linuxcnc_file, nominal_actual_csv, siemens_file, to_hex, to_image,
};
use helixlock_traces::csv::RowWriter;
use serde_json::{Value, json};

use self::model::Model;
use self::samples::{axis_result, read_samples};
use self::summary::{
    AxisTest, Comparison, applied_json, axis_json, built_json, print_applied, print_axis,
    print_built,
};
use crate::shared::output::{Batch, write_content};
use crate::shared::quantity::{length_mm, length_um, position_mm};
use crate::shared::series::print_json;

/// Build, apply and export a table of positioning errors
///
/// Errors of a machine scale against a calibrated one are read from `position_mm`, `error_um`
/// (what the machine's scale shows less what is true) and, where known, `direction` (+1, −1). The
/// table is the image of a 2 KiB EEPROM, as Intel HEX (`.hex`) or binary.
#[derive(Debug, Args)]
pub(crate) struct ScaleCommand {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, Subcommand)]
enum Action {
    Build(Build),
    Apply(Apply),
    Export(Export),
    Iso230(Iso230),
    Model(Model),
}

/// Make the EEPROM image from measured errors
#[derive(Debug, Args)]
struct Build {
    /// Measured errors
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Image to write: Intel HEX for `.hex`, binary otherwise
    #[arg(short, long, value_name = "IMAGE")]
    output: PathBuf,
    /// Position of the origin pulse, mm: the table counts from there
    #[arg(long, value_name = "MM", value_parser = position_mm, allow_hyphen_values = true, default_value = "0")]
    origin: f64,
    /// Distance of the table's places, mm
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "1 mm")]
    step: f64,
    /// Weight of the least of the eight bits, µm
    #[arg(long, value_name = "UM", value_parser = length_um, default_value = "0.1 um")]
    lsb: f64,
    /// Length of one scale, mm: joints are looked for at its multiples
    #[arg(long, value_name = "MM", value_parser = length_mm, default_value = "250 mm")]
    joint: f64,
    /// Length about each joint that is bridged from both sides, mm; samples there are not used
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    joint_zone: Option<f64>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Take the errors off measured ones, by a table
#[derive(Debug, Args)]
struct Apply {
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

/// Write a table in the format of a machine control
#[derive(Debug, Args)]
struct Export {
    /// EEPROM image, Intel HEX or binary
    #[arg(value_name = "IMAGE")]
    image: PathBuf,
    /// Format
    #[arg(long, value_enum)]
    format: Format,
    /// Axis, for Siemens
    #[arg(long, value_name = "AXIS", default_value = "AX1")]
    axis: String,
    /// File to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Evaluate positioning accuracy by ISO 230-2
#[derive(Debug, Args)]
struct Iso230 {
    /// Measured errors: two approaches or more of every target and direction
    #[arg(value_name = "DATA")]
    data: PathBuf,
    /// Accuracy A that must not be exceeded, µm; exit status 1 beyond
    #[arg(long, value_name = "UM", value_parser = length_um)]
    limit: Option<f64>,
    /// Expanded uncertainty of A (k = 2), µm: the limit is then decided by ISO 14253-1
    #[arg(long, value_name = "UM", value_parser = length_um, requires = "limit")]
    expanded_uncertainty: Option<f64>,
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

/// Formats on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Compensation file, `COMP_FILE_TYPE = 0`
    Linuxcnc,
    /// Nominal and actual positions, in the style of Heidenhain and Siemens
    Csv,
    /// `$AA_ENC_COMP` program
    Siemens,
}

impl ScaleCommand {
    /// Does what the word after `scale` says.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        match self.action {
            Action::Build(build) => build.run(out),
            Action::Apply(apply) => apply.run(out),
            Action::Export(export) => export.run(out),
            Action::Iso230(iso230) => iso230.run(out),
            Action::Model(model) => model.run(out),
        }
    }
}

impl Build {
    fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let detector = Detector { pitch_mm: 2.0, lsb_um: self.lsb };
        let samples = read_samples(&self.data, self.origin, &detector)?;
        let zone_mm = self.joint_zone.unwrap_or(0.0);
        let joints = JointRule { every_mm: self.joint, first_mm: self.joint, zone_mm };
        let rule = TableRule { step_mm: self.step, lsb_um: self.lsb, joints: Some(joints) };
        let refused = |error| anyhow!("{}: {error}", self.data.display());
        let table = build_table(&samples, &rule).map_err(refused)?;
        write_image(&self.output, &table)
            .map_err(|error| error.context(self.data.display().to_string()))?;
        let mut forward: Vec<(f64, f64)> = samples
            .iter()
            .filter(|sample| sample.direction == Direction::Forward)
            .map(|sample| (sample.position_mm, sample.error_um))
            .collect();
        forward.sort_by(|a, b| a.0.total_cmp(&b.0));
        let found = joints.joints(&forward);
        if self.json {
            print_json(out, &built_json(&table, &found, samples.len()))?;
        } else {
            print_built(out, &self.output, &table, &found)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Apply {
    fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let table = read_image(&self.image)?;
        let detector = Detector { pitch_mm: 2.0, lsb_um: table.lsb_um };
        let samples = read_samples(&self.data, self.origin, &detector)?;
        let scheme = match self.scheme {
            By::Step => Scheme::Step { step_um: self.step_size },
            By::Display => Scheme::Display { resolution_um: self.resolution },
        };
        let look_up = if self.interpolate { LookUp::Linear } else { LookUp::Nearest };
        let corrected = apply(&table, &samples, scheme, look_up);
        let comparison = Comparison::new(&self.data, corrected);
        let result = applied_json(&comparison, self.limit);
        if let Some(output) = &self.output {
            write_applied(output, &comparison, &result)?;
        }
        if self.json {
            print_json(out, &result)?;
        } else {
            print_applied(out, &comparison, self.limit)?;
        }
        let exceeded = self.limit.is_some_and(|limit| limit < comparison.after.largest_um);
        Ok(if exceeded { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }
}

impl Export {
    fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let table = read_image(&self.image)?;
        let (text, every) = match self.format {
            Format::Linuxcnc => linuxcnc_file(&table),
            Format::Csv => (nominal_actual_csv(&table), 1),
            Format::Siemens => (siemens_file(&table, &self.axis), 1),
        };
        write_content(&self.output, text)?;
        if 1 < every {
            writeln!(out, "note: every {every}th place, as this control takes no more rows")?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl Iso230 {
    fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        // Eight-bit codes are of no use here: approaches come as errors.
        let detector = Detector { pitch_mm: 2.0, lsb_um: 1.0 };
        let samples = read_samples(&self.data, 0.0, &detector)?;
        let errors = samples.iter().map(|sample| (*sample, sample.error_um));
        let found =
            axis_result(errors).map_err(|error| anyhow!("{}: {error}", self.data.display()))?;
        let test = AxisTest { limit_um: self.limit, expanded_um: self.expanded_uncertainty, found };
        if self.json {
            print_json(out, &axis_json(&test))?;
        } else {
            print_axis(out, &test)?;
        }
        Ok(if test.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}

/// Writes an image: Intel HEX by the name, binary otherwise.
pub(crate) fn write_image(path: &Path, table: &CorrectionTable) -> anyhow::Result<()> {
    let image = to_image(table)?;
    if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hex")) {
        return write_content(path, to_hex(&image)?);
    }
    write_content(path, image)
}

/// Reads an image, Intel HEX or binary by its first byte.
fn read_image(path: &Path) -> anyhow::Result<CorrectionTable> {
    let place = path.display();
    let bytes = std::fs::read(path).with_context(|| format!("{place}: cannot be read"))?;
    let refused = |error| anyhow!("{place}: {error}");
    if bytes.first() != Some(&b':') {
        return from_image(&bytes).map_err(refused);
    }
    let Ok(text) = std::str::from_utf8(&bytes) else {
        bail!("{place}: found other than text after a colon, expected Intel HEX")
    };
    from_image(&from_hex(text).map_err(refused)?).map_err(refused)
}

fn write_applied(output: &Path, comparison: &Comparison, result: &Value) -> anyhow::Result<()> {
    let page = page::page(comparison);
    let figure = page::figure(comparison).svg();
    let mut files = Batch::new(output)?;
    files.write_content("figure.svg", figure)?;
    files.write_json("result.json", result)?;
    files.write_content("report.html", page.html())?;
    files.write("corrected.csv", |file| write_corrected(file, comparison))?;
    files.keep()
}

fn write_corrected(file: &mut dyn Write, comparison: &Comparison) -> anyhow::Result<()> {
    let names = ["position_mm", "error_um", "direction", "correction_um", "steps", "left_um"];
    let mut rows = RowWriter::new(file, &names)?;
    for one in &comparison.corrected {
        let direction = if one.sample.direction == Direction::Forward { 1.0 } else { -1.0 };
        let correction = one.correction_um.unwrap_or(f64::NAN);
        #[expect(clippy::cast_precision_loss, reason = "a correction holds few steps")]
        let steps = one.steps as f64;
        let (position, error) = (one.sample.position_mm, one.sample.error_um);
        rows.row(&[position, error, direction, correction, steps, one.left_um])?;
    }
    Ok(())
}

/// The spread of errors as JSON.
pub(crate) fn spread_json(spread: &helixlock_metrology::scale::Spread) -> Value {
    json!({
        "largest_um": spread.largest_um,
        "half_range_um": spread.half_range_um,
        "rms_um": spread.rms_um,
    })
}
