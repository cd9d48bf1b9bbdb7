//! `helixlock challenge`: a machine with something hidden, or how well many of them are solved.

mod json;
mod text;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::{
    Challenge as Task, Experimented, Measurement, Nominal, Problem, Score, challenge, diagnose,
    experiment,
};
use helixlock_traces::csv::write_csv;

use self::json::{AnswerJson, ExperimentedJson, ScoreJson};
use crate::shared::output::{Batch, print_json};
use crate::shared::progress;

/// Make a machine and data with something hidden, or score the diagnosis on many of them
#[derive(Debug, Args)]
pub(crate) struct Challenge {
    /// Seed; equal seeds make equal files
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for `machine.toml`, `data.csv` and, apart from them, `answer.json`
    #[arg(short, long, required_unless_present_any = ["score", "experiment"])]
    output: Option<PathBuf>,
    /// Solve this many challenges from the seed on and print how many were named rightly
    #[arg(long, value_name = "K")]
    score: Option<u64>,
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
        if let Some(folder) = &self.output {
            write(&challenge(self.seed)?, self.seed, folder)?;
            writeln!(out, "{}: machine.toml, data.csv, answer.json", folder.display())?;
        }
        if let Some(number) = self.score {
            let score = score(self.seed, number)?;
            if self.json {
                print_json(out, &ScoreJson::new(&score))?;
            } else {
                text::print(&score, out)?;
            }
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

fn score(seed: u64, number: u64) -> anyhow::Result<Score> {
    let bar = progress::bar(number, "challenges");
    let mut score = Score::default();
    for seed in seed..seed + number {
        let task = challenge(seed)?;
        let nominal = Nominal::of(&task.machine.model);
        let measurement = Measurement::from_table(&task.table, &nominal)?;
        let diagnosis = diagnose(&Problem::new(&task.machine.model, &measurement)?);
        score.add(seed, &task, &diagnosis);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(score)
}
