//! `helixlock challenge`: a machine with something hidden, or how well many of them are solved.

mod json;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Args;
use helixlock_lab::{
    Challenge as Task, Experimented, Measurement, Nominal, Problem, Score, Scored, challenge,
    diagnose, experiment,
};
use helixlock_sim::parallel;
use helixlock_traces::Table;
use helixlock_traces::csv::write_csv;

use self::json::{AnswerJson, ExperimentedJson, ScoreJson};
use crate::shared::cases::{Campaign, Cases, Row, Shard, cells, write_numbers};
use crate::shared::next::Next;
use crate::shared::output::{Batch, print_json};
use crate::shared::progress;

/// Challenges of a score.
pub(crate) const CAMPAIGN: Campaign = Campaign {
    word: "challenges",
    write_csv: write_numbers,
    print: |table, out| {
        text::print(&score_of(table)?, out)?;
        Ok(ExitCode::SUCCESS)
    },
};

/// Seeds are numbers of a table, which are exact below.
const MOST_SEEDS: u64 = 1 << 53;

/// Make a machine and data with something hidden, or score the diagnosis on many of them
#[derive(Debug, Args)]
pub(crate) struct Challenge {
    /// Seed; equal seeds make equal files
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for `machine.toml`, `data.csv` and, apart from them, `answer.json`; with `--score` a
    /// table, one row a challenge, `.csv` or `.parquet`; with `--shard` the folder of the parts
    #[arg(short, long, value_name = "DIR|FILE", required_unless_present_any = ["score", "experiment"])]
    output: Option<PathBuf>,
    /// Solve this many challenges from the seed on and print how many were named rightly; what is
    /// in the table already is not solved again
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u64).range(1..))]
    score: Option<u64>,
    /// Solve only this part of so many, `2/8`, on one machine of many; `helixlock merge` joins them
    #[arg(long, value_name = "PART/PARTS", requires = "score")]
    shard: Option<Shard>,
    /// Hide this many effects in records that cannot tell them, carry out the experiment that is
    /// advised, and print what the verdict is before and after
    #[arg(long, value_name = "K")]
    experiment: Option<u64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Challenge {
    /// Writes a folder or prints a score.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        match (self.score, &self.output) {
            (Some(number), _) => self.score(number, out)?,
            (None, Some(folder)) => {
                write(&challenge(self.seed)?, self.seed, folder)?;
                writeln!(out, "{}: machine.toml, data.csv, answer.json", folder.display())?;
                let files = ["machine.toml", "data.csv"].map(|name| folder.join(name));
                Next::command("compare").words(files).print(out)?;
            }
            (None, None) => {}
        }
        if let Some(number) = self.experiment {
            let tried = experiments(self.seed, number)?;
            if self.json {
                let tried: Vec<_> =
                    tried.iter().map(|(seed, one)| ExperimentedJson::new(one, *seed)).collect();
                print_json(out, &tried)?;
            } else {
                text::print_experiments(&tried, out)?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }

    /// Solves what is missing and prints the score; of a part only how much there is.
    fn score(&self, number: u64, out: &mut impl Write) -> anyhow::Result<()> {
        let last = self.seed.checked_add(number).filter(|last| *last <= MOST_SEEDS);
        last.with_context(|| {
            format!("`--seed {}`: expected seeds up to {MOST_SEEDS} for a score", self.seed)
        })?;
        let cases = Cases {
            campaign: &CAMPAIGN,
            number,
            shard: self.shard,
            columns: Scored::columns().collect(),
            identity: format!("challenges {number} from {}", self.seed),
            inputs: Vec::new(),
        };
        let worked = cases.work_out(self.output.as_deref(), |missing, keep| {
            parallel(missing, |case| {
                let cells = scored(self.seed + case)?.cells();
                keep(Row { case: *case, cells, failure: None })
            })
        })?;
        if self.json {
            return print_json(out, &ScoreJson::new(&score_of(&worked.table)?));
        }
        worked.print(&CAMPAIGN, out)?;
        if self.shard.is_none() {
            text::print(&score_of(&worked.table)?, out)?;
        }
        Ok(())
    }
}

/// What each seed's record says before and after the experiment that is advised.
fn experiments(seed: u64, number: u64) -> anyhow::Result<Vec<(u64, Experimented)>> {
    let bar = progress::bar(number, "experiments");
    let mut tried = Vec::new();
    for seed in seed..seed + number {
        tried.push((seed, experiment(seed)?));
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(tried)
}

fn write(task: &Task, seed: u64, folder: &Path) -> anyhow::Result<()> {
    let mut files = Batch::new(folder, [])?;
    files.write_content("machine.toml", task.machine.text())?;
    files.write("data.csv", |mut file| Ok(write_csv(&task.table, &mut file)?))?;
    files.write_json("answer.json", &AnswerJson::new(task, seed))?;
    files.keep()
}

fn scored(seed: u64) -> anyhow::Result<Scored> {
    let task = challenge(seed)?;
    let nominal = Nominal::of(&task.machine.model);
    let measurement = Measurement::from_table(&task.table, &nominal)?;
    let diagnosis = diagnose(&Problem::new(&task.machine.model, &measurement)?);
    Ok(Scored::new(seed, &task, &diagnosis))
}

fn score_of(table: &Table) -> anyhow::Result<Score> {
    let mut score = Score::default();
    for (row, cells) in cells(table).enumerate() {
        let scored = Scored::from_cells(&cells);
        score.add(&scored.with_context(|| {
            format!("{}: row {row} is no challenge that was scored", table.path.display())
        })?);
    }
    Ok(score)
}
