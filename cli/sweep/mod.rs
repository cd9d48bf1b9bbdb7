//! `helixlock sweep`: one simulation a point of a grid, or a draw of chance.

mod page;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_plant::{Formula, MachineFile, MeasuredCurve, Model};
use helixlock_sim::sweep::{Axis, Case, DrawnAxis, FIGURES, MOST_CASES, Plan};
use helixlock_sim::{Options, parallel};
use helixlock_traces::Table;

use crate::shared::answer::{Answer, Answering};
use crate::shared::cases::{Campaign, Cases, Row, Shard, Worked, apart_from_cases, write_numbers};
use crate::shared::input::machine_files;
use crate::shared::keys::keys;
use crate::shared::language::Reporter;
use crate::shared::output::{print_page, write_page};

/// Most places that are named.
const NAMED: usize = 10;

/// Cases of a sweep.
pub(crate) const CAMPAIGN: Campaign =
    Campaign { word: "cases", write_csv: write_numbers, print: print_merged };

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
    /// The results as a page
    #[arg(long, value_name = "FILE.html", conflicts_with = "shard")]
    page: Option<PathBuf>,
    /// Grind only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = crate::shared::quantity::length_mm)]
    length: Option<f64>,
}

impl Sweep {
    /// Runs what is missing and writes the table.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        apart_from_cases(self.output.as_deref(), [("`--page`", self.page.as_deref())])?;
        let file = MachineFile::read(&self.machine)?;
        let plan = self.plan()?;
        let worked = self.worked(&file, &plan, self.output.as_deref())?;
        if let Some(path) = &self.page {
            let title = &file.model.title;
            let page = page::page(title, &worked.table, &plan.columns(), &worked.rows);
            write_page(path, machine_files(&self.machine, &file.model), &page, out.language())?;
        }
        worked.print(&CAMPAIGN, out)?;
        let failed = |row: &Row| Some(format!("case {}: {}", row.case, row.failure.as_ref()?));
        let failures: Vec<String> = worked.rows.iter().filter_map(failed).collect();
        for failure in &failures {
            writeln!(out, "{failure}")?;
        }
        print_page(out, self.page.as_deref())?;
        Ok(if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// All cases, those that are missing simulated on all cores.
    fn worked(
        &self,
        file: &MachineFile,
        plan: &Plan,
        output: Option<&Path>,
    ) -> anyhow::Result<Worked> {
        // A journal would keep the refusals of all cases from a command that has the key right.
        plan.check_keys(file)?;
        let options = self.options();
        self.cases(file, plan).work_out(output, |missing, keep| {
            parallel(missing, |index| keep(row(&plan.case(*index), file, &options)))
        })
    }

    fn cases(&self, file: &MachineFile, plan: &Plan) -> Cases {
        let (curves, options) = (curves(&file.model), self.options());
        let figures = FIGURES.iter().map(|name| (*name).to_owned());
        Cases {
            campaign: &CAMPAIGN,
            number: plan.cases(),
            shard: self.shard,
            columns: plan.columns().into_iter().chain(figures).collect(),
            identity: format!("{}\n{curves:?}\n{plan:?}\n{options:?}", file.text()),
            inputs: machine_files(&self.machine, &file.model),
        }
    }

    fn options(&self) -> Options {
        Options { length_mm: self.length }
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
        let keys = plan.columns();
        if let Some(twice) = keys
            .iter()
            .enumerate()
            .find_map(|(at, key)| keys[..at].iter().find(|other| *other == key))
        {
            bail!("`{twice}` is varied twice, expected each key once");
        }
        let all = plan.cases();
        let range = self.shard.map_or(0..all, |shard| shard.cases(all));
        let cases = range.end - range.start;
        if all == u64::MAX || MOST_CASES < cases {
            let more = if all == u64::MAX { " or more" } else { "" };
            bail!(
                "{cases}{more} cases, expected at most {MOST_CASES}\n\
                 hint: fewer values of each key, `--draw` with `--samples`, or parts of it with `--shard`"
            );
        }
        Ok(plan)
    }
}

impl Answering for Sweep {
    /// With the table `cases`; nothing is kept for a later run.
    fn answer(&self) -> anyhow::Result<Answer> {
        let file = MachineFile::read(&self.machine)?;
        let worked = self.worked(&file, &self.plan()?, None)?;
        Ok(Answer::new(&SweptJson::new(&worked.rows))?.with_table("cases", worked.table))
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

/// Values and figures of a case; figures are not numbers when it cannot be run.
fn row(case: &Case, file: &MachineFile, options: &Options) -> Row {
    let (figures, failure) = match case.run(file, options) {
        Ok(figures) => (figures, None),
        Err(error) => (vec![f64::NAN; FIGURES.len()], Some(error.to_string())),
    };
    Row { case: case.index, cells: [case.values.clone(), figures].concat(), failure }
}

/// Says which cases could not be run: those without figures, of which the last column is one.
fn print_merged(table: &Table, out: &mut dyn Write) -> anyhow::Result<ExitCode> {
    let last = table.columns.last().map_or(&[][..], |column| &column.values);
    let failed: Vec<u64> =
        (0..).zip(last).filter(|(_, figure)| figure.is_nan()).map(|(case, _)| case).collect();
    if failed.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    let more = if NAMED < failed.len() { " …" } else { "" };
    let named: Vec<String> = failed.iter().take(NAMED).map(u64::to_string).collect();
    writeln!(out, "{} cases could not be run: {}{more}", failed.len(), named.join(", "))?;
    writeln!(out, "the sweep of a part says why")?;
    Ok(ExitCode::from(1))
}
