//! `helixlock sweep`: one simulation a point of a grid, or a draw of chance.

mod journal;

use std::io::Write;
use std::ops::Range;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;

use anyhow::{Context, anyhow, bail};
use clap::Args;
use helixlock_plant::{Formula, MachineFile, MeasuredCurve, Model};
use helixlock_sim::sweep::{Axis, Case, DrawnAxis, FIGURES, MOST_CASES, Plan};
use helixlock_sim::{Options, parallel};
use helixlock_traces::table::{Column, Table};

use self::journal::{Journal, Row};
use crate::shared::answer::{Answer, Answering};
use crate::shared::input::machine_files;
use crate::shared::keys::keys;
use crate::shared::output::make_folder;
use crate::shared::progress;
use crate::shared::shards::{Format, PartName, Shard, write_cases};

/// Simulate many machines: any value of the file over a range, or by chance
///
/// Results stream into FILE.journal while they come; run the same command again and only what is
/// missing is simulated, after an interruption as at the end. Then FILE holds all cases in order.
#[derive(Debug, Args)]
pub(crate) struct Sweep {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Results, one row a case: `.csv` or `.parquet`; with `--shard` the folder of the parts
    #[arg(short, long, value_name = "FILE|DIR", required = true)]
    output: Option<PathBuf>,
    /// Simulate only this part of so many, `2/8`, on one machine of many; `helixlock merge` joins them
    #[arg(long, value_name = "PART/PARTS")]
    shard: Option<Shard>,
    /// A key of the machine file and its values: `drive.frequency=80,160 Hz`, or eight values
    /// `drive.frequency=40..320:8 Hz`; effects are counted from 0: `effect.0.amplitude=1,2 um`
    #[arg(long = "set", value_name = "KEY=VALUES")]
    axes: Vec<String>,
    /// A key of the machine file and bounds to draw from: `effect.0.amplitude=0.5..3 um`
    #[arg(long = "draw", value_name = "KEY=LOW..HIGH")]
    drawn: Vec<String>,
    /// Draws at every point of the grid
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    samples: u64,
    /// Seed of the draws
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Grind only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = crate::shared::quantity::length_mm)]
    length: Option<f64>,
}

impl Sweep {
    /// Runs what is missing and writes the table.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let file = MachineFile::read(&self.machine)?;
        let plan = self.plan()?;
        let options = self.options();
        let curves = curves(&file.model);
        let version = env!("CARGO_PKG_VERSION");
        let identity = format!("{version}\n{}\n{curves:?}\n{plan:?}\n{options:?}", file.text());
        let (output, format) = self.target(&plan, fingerprint(&identity))?;
        let width = plan.columns().len() + FIGURES.len();
        let journal = Journal::open(&output, fingerprint(&identity), width)?;
        let resumed = journal.rows.len();
        let rows = run_missing(&file, &plan, self.cases(&plan), &options, journal)?;
        let inputs = machine_files(&self.machine, &file.model);
        write_cases(&output, format, inputs, &table(&plan, &rows))?;
        let done = rows.len() - resumed;
        writeln!(out, "{}: {} cases, {done} of them run now", output.display(), rows.len())?;
        let failed = |row: &Row| Some(format!("case {}: {}", row.case, row.failure.as_ref()?));
        let failures: Vec<String> = rows.iter().filter_map(failed).collect();
        for failure in &failures {
            writeln!(out, "{failure}")?;
        }
        Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    fn options(&self) -> Options {
        Options { length_mm: self.length, ..Options::default() }
    }

    fn plan(&self) -> anyhow::Result<Plan> {
        if self.axes.is_empty() && self.drawn.is_empty() {
            bail!("nothing is varied: expected `--set KEY=VALUES` or `--draw KEY=LOW..HIGH`");
        }
        if self.drawn.is_empty() && 1 < self.samples {
            bail!("`--samples {}`: nothing is drawn, expected `--draw` with it", self.samples);
        }
        let grid = self.axes.iter().map(|text| Axis::parse(text)).collect::<Result<_, _>>()?;
        let drawn =
            self.drawn.iter().map(|text| DrawnAxis::parse(text)).collect::<Result<_, _>>()?;
        let plan = Plan { grid, drawn, samples: self.samples, seed: self.seed };
        let (all, range) = (plan.cases(), self.cases(&plan));
        let cases = range.end - range.start;
        if all == u64::MAX || MOST_CASES < cases {
            let more = if all == u64::MAX { " or more" } else { "" };
            bail!(
                "{cases}{more} cases, expected at most {MOST_CASES}\n                 hint: fewer values of each key, `--draw` with `--samples`, or parts of it with `--shard`"
            );
        }
        if let Some(Shard { of, .. }) = self.shard
            && all < of
        {
            bail!("`--shard`: {of} parts of {all} cases, expected a case for each at least");
        }
        Ok(plan)
    }

    /// The cases asked for, of all.
    fn cases(&self, plan: &Plan) -> Range<u64> {
        self.shard.map_or(0..plan.cases(), |shard| shard.cases(plan.cases()))
    }

    /// Where the results go.
    fn target(&self, plan: &Plan, fingerprint: u64) -> anyhow::Result<(PathBuf, Format)> {
        let output = self.output.as_deref().context("no file, expected `-o FILE`")?;
        let Some(shard) = self.shard else {
            return Ok((output.to_owned(), Format::of(output)?));
        };
        make_folder(output)?;
        let part = PartName { shard, cases: plan.cases(), fingerprint };
        Ok((output.join(part.to_string()), Format::Parquet))
    }
}

impl Answering for Sweep {
    /// With the table `cases`; nothing is kept for a later run.
    fn answer(&self) -> anyhow::Result<Answer> {
        let (file, plan, options) =
            (MachineFile::read(&self.machine)?, self.plan()?, self.options());
        let cases: Vec<u64> = self.cases(&plan).collect();
        let rows = Mutex::new(Vec::new());
        let lost = || anyhow!("another case has failed");
        parallel(&cases, |index| {
            let row = row(&plan.case(*index), &file, &options);
            rows.lock().map_err(|_| lost())?.push(row);
            anyhow::Ok(())
        })?;
        let mut rows = rows.into_inner().map_err(|_| lost())?;
        rows.sort_by_key(|row| row.case);
        Ok(Answer::new(&SweptJson::new(&rows))?.with_table("cases", table(&plan, &rows)))
    }
}

keys! {
    /// How many cases, and those that could not be run.
    SweptJson<'a>(rows: &'a [Row]) {
        cases: usize = rows.len(),
        failures: Vec<FailureJson<'a>> = rows.iter().filter_map(failure).collect(),
    }

    FailureJson<'a>(case: u64, reason: &'a str) {
        case: u64 = case,
        reason: &'a str = reason,
    }
}

fn failure(row: &Row) -> Option<FailureJson<'_>> {
    Some(FailureJson::new(row.case, row.failure.as_deref()?))
}

/// The measured curves of a machine, which its file only names.
fn curves(model: &Model) -> Vec<&MeasuredCurve> {
    let formulas = model.effects.iter().map(|term| &term.formula);
    formulas
        .filter_map(|formula| match formula {
            Formula::Curve(curve) => Some(curve.as_ref()),
            Formula::Card(_) | Formula::Custom(_) => None,
        })
        .collect()
}

/// Simulates the cases that the journal lacks, on all cores; gives all rows in order.
fn run_missing(
    file: &MachineFile,
    plan: &Plan,
    cases: Range<u64>,
    options: &Options,
    journal: Journal,
) -> anyhow::Result<Vec<Row>> {
    let bar = progress::bar(cases.end - cases.start, "cases");
    let missing: Vec<u64> = cases.filter(|case| !journal.has(*case)).collect();
    bar.set_position(journal.rows.len() as u64);
    let journal = Mutex::new(journal);
    parallel(&missing, |index| {
        let case = plan.case(*index);
        let row = row(&case, file, options);
        bar.inc(1);
        journal.lock().map_err(|_| anyhow!("another case has failed"))?.append(row)
    })?;
    bar.finish_and_clear();
    let mut rows = journal.into_inner().map_err(|_| anyhow!("another case has failed"))?.rows;
    rows.sort_by_key(|row| row.case);
    Ok(rows)
}

/// Values and figures of a case; figures are not numbers when it cannot be run.
fn row(case: &Case, file: &MachineFile, options: &Options) -> Row {
    let (figures, failure) = match case.run(file, options) {
        Ok(figures) => (figures, None),
        Err(error) => (vec![f64::NAN; FIGURES.len()], Some(error.to_string())),
    };
    Row { case: case.index, cells: [case.values.clone(), figures].concat(), failure }
}

#[expect(clippy::cast_precision_loss, reason = "fewer than 2⁵³ cases")]
fn table(plan: &Plan, rows: &[Row]) -> Table {
    let number =
        Column { name: "case".into(), values: rows.iter().map(|row| row.case as f64).collect() };
    let names = plan.columns().into_iter().chain(FIGURES.iter().map(|name| (*name).to_owned()));
    let columns = names.enumerate().map(|(place, name)| Column {
        name,
        values: rows.iter().map(|row| row.cells[place]).collect(),
    });
    Table::new(std::iter::once(number).chain(columns).collect())
}

/// FNV-1a over the bytes.
fn fingerprint(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
