//! `helixlock transmission`: transmission error from two pulse trains, by five methods.

mod evaluation;
mod json;
mod page;
mod pulses;
mod text;
mod truth;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use helixlock_metrology::transmission::{
    Gearing, Method, Reading, Sample, Setup, Shaft, error_against, measure, order_spectrum, peaks,
};
use helixlock_plant::Model;
use helixlock_traces::csv::{RowWriter, write_csv};
use helixlock_traces::{Column, Table};

use self::evaluation::{ARCSEC, Evaluation, Found, MethodResult};
use self::json::TransmissionJson;
use self::pulses::{Names, read_pulses};
use self::truth::read_truth;
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::next::Next;
use crate::shared::output::{Batch, Written, print_json};
use crate::shared::quantity::{frequency_hz, lead_mm, time_s};
use crate::shared::refused::in_file;

/// Measure a transmission error from two pulse trains
///
/// The error is what the output has turned less what it should have, δ = θ2 − θ1/i: positive when
/// the output is ahead, zero at the first sample. Pulses come from a value change dump, or from a
/// table: `input_s` and `output_s`; or `time_s` and `channel` (1 input, 2 output); or `time_s` and the
/// levels `input` and `output`. Exit status 1: the error exceeds `--limit`.
#[derive(Debug, Args)]
pub(crate) struct TransmissionCommand {
    /// Pulses: value change dump, CSV or Parquet
    #[arg(value_name = "CAPTURE")]
    capture: PathBuf,
    /// Method
    #[arg(long, value_enum, default_value = "all")]
    method: By,
    /// Pulses a turn of the input
    #[arg(long, value_name = "N")]
    input_lines: u64,
    /// Pulses a turn of the output
    #[arg(long, value_name = "N")]
    output_lines: u64,
    /// Turns of the input for one turn of the output, such as 36 or 5/2
    #[arg(long, value_name = "I", value_parser = ratio, default_value = "1")]
    ratio: (u64, u64),
    /// Signal or column of the input
    #[arg(long, value_name = "NAME")]
    input_signal: Option<String>,
    /// Signal or column of the output
    #[arg(long, value_name = "NAME")]
    output_signal: Option<String>,
    /// Clock that subdivides pulses
    #[arg(long, value_name = "HZ", value_parser = frequency_hz, default_value = "12 MHz")]
    clock: f64,
    /// Further division for the analog and the digital method: more range, fewer samples
    #[arg(long, value_name = "K", default_value_t = 1)]
    range_divider: u64,
    /// Time constant of the analog method's recorder
    #[arg(long, value_name = "S", value_parser = time_s, default_value = "0.05 s")]
    recorder: f64,
    /// Shaft by its turns for one turn of the output, such as worm=36; may be repeated
    #[arg(long = "shaft", value_name = "NAME=ORDER", value_parser = shaft)]
    shafts: Vec<Shaft>,
    /// Machine file whose gears name the orders
    #[arg(long, value_name = "MACHINE.toml")]
    machine: Option<PathBuf>,
    /// True error, `output_turns` and `delta_arcsec`, to hold the methods against
    #[arg(long, value_name = "DATA")]
    truth: Option<PathBuf>,
    /// Lead, when the output is a length: the hand-over file is in mm and µm
    #[arg(long, value_name = "LENGTH", value_parser = lead_mm)]
    lead: Option<f64>,
    /// Peak-to-peak error that must not be exceeded, arcsec
    #[arg(long, value_name = "ARCSEC")]
    limit: Option<f64>,
    /// Folder for report.html, figure.svg, result.json, error.csv and compare.csv
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

/// Methods on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum By {
    /// All five, side by side
    All,
    /// Trigger phase meter and recorder
    Analog,
    /// Digital phase comparison
    Digital,
    /// Subdivided phase comparison
    Subdivided,
    /// Direct counting
    Counting,
    /// Subdivided counting
    SubdividedCounting,
}

/// Most shafts that a spectrum is looked through for; a gearbox has some ten.
const MOST_SHAFTS: usize = 500;

/// What `helixlock compare` reads.
const HAND_OVER: &str = "compare.csv";

impl TransmissionCommand {
    /// Measures, writes, prints.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let evaluation = self.evaluate()?;
        let result = TransmissionJson::new(&evaluation);
        let written = match &self.output {
            Some(output) => {
                let files = Batch::new(output, self.inputs())?.in_language(out.language());
                self.write_files(files, &evaluation, &result)?
            }
            None => Written::default(),
        };
        if self.json {
            print_json(out, &result)?;
        } else {
            text::print(out, &evaluation)?;
            written.print(out)?;
            self.print_next(out)?;
        }
        Ok(if evaluation.holds() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// What was handed over is compared with a model, once there is one.
    fn print_next(&self, out: &mut impl Reporter) -> anyhow::Result<()> {
        match (&self.output, &self.machine) {
            (Some(output), Some(machine)) => {
                Next::command("compare").words([machine, &output.join(HAND_OVER)]).print(out)
            }
            (Some(_), None) => Next::command("init").print(out),
            (None, _) => Ok(()),
        }
    }

    fn evaluate(&self) -> anyhow::Result<Evaluation> {
        let names =
            Names { input: self.input_signal.as_deref(), output: self.output_signal.as_deref() };
        let gearing = Gearing {
            input_lines: self.input_lines,
            output_lines: self.output_lines,
            ratio: self.ratio,
        };
        gearing.check()?;
        let setup = Setup {
            gearing,
            clock_hz: self.clock,
            range_divider: self.range_divider,
            recorder_s: self.recorder,
        };
        let pulses = read_pulses(&self.capture, &names)?;
        pulses.check_ratio(&gearing).map_err(in_file(&self.capture))?;
        let shafts = self.named_shafts()?;
        let truth = self.truth.as_deref().map(read_truth).transpose()?;
        let evaluate = |method: Method| {
            let found = measure(&pulses, &setup, method).map(|reading| {
                let spectrum = order_spectrum(&reading.samples, &shafts).ok();
                let peaks = spectrum.as_ref().map_or(Vec::new(), |s| peaks(s, &shafts, 8));
                let against_truth = truth.as_ref().map(|t| error_against(&reading, |x| t.at(x)));
                Found { reading, spectrum, peaks, against_truth }
            });
            MethodResult { method, found: found.map_err(|error| error.to_string()) }
        };
        let results: Vec<MethodResult> = self.methods().into_iter().map(evaluate).collect();
        if let [MethodResult { found: Err(why), .. }] = results.as_slice() {
            bail!("{}: {why}", self.capture.display());
        }
        Ok(Evaluation {
            path: self.capture.clone(),
            pulses,
            setup,
            results,
            limit_arcsec: self.limit,
        })
    }

    fn methods(&self) -> Vec<Method> {
        match self.method {
            By::All => Method::ALL.to_vec(),
            By::Analog => vec![Method::Analog],
            By::Digital => vec![Method::Digital],
            By::Subdivided => vec![Method::SubdividedComparison],
            By::Counting => vec![Method::DirectCounting],
            By::SubdividedCounting => vec![Method::SubdividedCounting],
        }
    }

    fn named_shafts(&self) -> anyhow::Result<Vec<Shaft>> {
        let mut shafts = self.shafts.clone();
        if let Some(path) = &self.machine {
            let gears = Model::read(path)?.gear_orders().into_iter();
            shafts.extend(gears.map(|(name, order)| Shaft { name, order }));
        }
        if MOST_SHAFTS < shafts.len() {
            bail!("found {} shafts, expected at most {MOST_SHAFTS}", shafts.len());
        }
        Ok(shafts)
    }

    /// What was read, for outputs to spare.
    fn inputs(&self) -> Vec<PathBuf> {
        let beside = [&self.truth, &self.machine].into_iter().flatten();
        beside.chain([&self.capture]).cloned().collect()
    }

    fn write_files(
        &self,
        mut files: Batch,
        evaluation: &Evaluation,
        result: &TransmissionJson<'_>,
    ) -> anyhow::Result<Written> {
        let page = page::page(evaluation);
        files.write_report(&page::figure(evaluation), result, &page)?;
        if let Some(best) = evaluation.best() {
            let error = error_table(&best.reading);
            files.write("error.csv", |mut file| Ok(write_csv(&error, &mut file)?))?;
            files.write(HAND_OVER, |file| self.hand_over(file, &best.reading))?;
        }
        files.kept()
    }

    /// What `helixlock compare` reads. Its recorder counts an output that lags as positive: −δ.
    fn hand_over(&self, file: &mut dyn Write, reading: &Reading) -> anyhow::Result<()> {
        let Some(lead_mm) = self.lead else {
            let mut rows = RowWriter::new(file, &["time_s", "angle_rev", "error_arcsec"])?;
            for one in &reading.samples {
                rows.row(&[one.time_s, one.output_turns, -one.error_rad * ARCSEC])?;
            }
            return Ok(());
        };
        let mut rows = RowWriter::new(file, &["time_s", "angle_rev", "position_mm", "error_um"])?;
        let um_per_rad = lead_mm * 1000.0 / std::f64::consts::TAU;
        for one in &reading.samples {
            let (turns, error) = (one.output_turns, -one.error_rad * um_per_rad);
            rows.row(&[one.time_s, turns, turns * lead_mm, error])?;
        }
        Ok(())
    }
}

impl Answering for TransmissionCommand {
    /// With the table `error`, by the best method that worked.
    fn answer(&self) -> anyhow::Result<Answer> {
        let evaluation = self.evaluate()?;
        let answer = Answer::new(&TransmissionJson::new(&evaluation))?;
        Ok(match evaluation.best() {
            Some(best) => answer.with_table("error", error_table(&best.reading)),
            None => answer,
        })
    }
}

/// The error along the run.
fn error_table(reading: &Reading) -> Table {
    let column = |name: &str, value: fn(&Sample) -> f64| {
        Column::new(name, reading.samples.iter().map(value).collect())
    };
    Table::new(vec![
        column("time_s", |one| one.time_s),
        column("output_turns", |one| one.output_turns),
        column("delta_arcsec", |one| one.error_rad * ARCSEC),
    ])
}

/// `36`, `5/2` or `2.5` as numerator and denominator.
fn ratio(text: &str) -> Result<(u64, u64), String> {
    let expected =
        || String::from("expected a whole number, a fraction such as 5/2, or a decimal number");
    if let Some((over, under)) = text.split_once('/') {
        let parts = over.trim().parse().ok().zip(under.trim().parse().ok());
        return parts.filter(|(_, under)| 0 < *under).ok_or_else(expected);
    }
    let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
    let under = 10_u64.checked_pow(u32::try_from(decimals.len()).unwrap_or(u32::MAX));
    let over = format!("{whole}{decimals}").parse().ok();
    over.zip(under).filter(|(over, _)| 0 < *over).ok_or_else(expected)
}

fn shaft(text: &str) -> anyhow::Result<Shaft> {
    let expected = || anyhow!("expected NAME=ORDER, such as worm=36");
    let (name, order) = text.rsplit_once('=').ok_or_else(expected)?;
    let order: f64 = order.trim().parse().map_err(|_| expected())?;
    if !(0.0 < order && order.is_finite()) {
        return Err(expected());
    }
    Ok(Shaft { name: name.trim().into(), order })
}
