//! `helixlock challenge`: a machine with something hidden, or how well many of them are solved.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::challenge::{Challenge as Task, Hidden, Outcome, challenge, judge};
use helixlock_lab::diagnosis::diagnose;
use helixlock_lab::measurement::{Measurement, Nominal};
use helixlock_lab::problem::Problem;
use helixlock_traces::csv::write_csv;
use serde_json::{Value, json};

use crate::output::Batch;
use crate::progress;

/// Make a machine and data with something hidden, or score the diagnosis on many of them
#[derive(Debug, Args)]
pub(crate) struct Challenge {
    /// Seed; equal seeds make equal files
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for `machine.toml`, `data.csv` and, apart from them, `answer.json`
    #[arg(short, long, required_unless_present = "score")]
    output: Option<PathBuf>,
    /// Solve this many challenges from the seed on and print how many were named rightly
    #[arg(long, value_name = "K")]
    score: Option<u64>,
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
                writeln!(out, "{}", serde_json::to_string_pretty(&score.json())?)?;
            } else {
                score.print(out)?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn write(task: &Task, seed: u64, folder: &Path) -> anyhow::Result<()> {
    let mut files = Batch::new(folder)?;
    files.write_content("machine.toml", task.machine.text())?;
    files.write("data.csv", |mut file| Ok(write_csv(&task.table, &mut file)?))?;
    files.write_json("answer.json", &answer(task, seed))?;
    files.keep()
}

fn answer(task: &Task, seed: u64) -> Value {
    let effects: Vec<Value> = task
        .terms
        .iter()
        .map(|term| {
            let pairs = term.parameters.iter().zip(&term.values);
            let values: BTreeMap<String, f64> = pairs.map(|(p, v)| (p.key(), *v)).collect();
            json!({ "effect": term.name, "parameters": values })
        })
        .collect();
    let outside = match &task.hidden {
        Hidden::Outside(name) => Some(*name),
        _ => None,
    };
    json!({
        "seed": seed,
        "effects": effects,
        "outside_the_catalogue": outside,
        "noise_um": task.noise_um,
        "hidden_rms_um": task.hidden_um,
    })
}

/// Counts over many challenges.
#[derive(Debug, Default)]
struct Score {
    outcomes: BTreeMap<(&'static str, &'static str), u64>,
    before: f64,
    after: f64,
    number: f64,
    wrong: Vec<u64>,
}

fn score(seed: u64, number: u64) -> anyhow::Result<Score> {
    let bar = progress::bar(number, "challenges");
    let mut score = Score::default();
    for seed in seed..seed + number {
        let task = challenge(seed)?;
        let nominal = Nominal::from(&task.machine.machine);
        let measurement = Measurement::from_table(&task.table, &nominal)?;
        let diagnosis = diagnose(&Problem::new(&task.machine.machine, &measurement)?);
        let last = diagnosis.rounds.last();
        let names: Vec<String> = last
            .map(|round| round.effects.iter().map(|effect| effect.name.clone()).collect())
            .unwrap_or_default();
        let outcome = judge(&task.hidden, diagnosis.verdict, &names);
        if matches!(outcome, Outcome::FalselyNamed | Outcome::Missed) {
            score.wrong.push(seed);
        }
        *score.outcomes.entry((hidden_word(&task.hidden), outcome_word(outcome))).or_default() += 1;
        score.before += diagnosis.rounds.first().map_or(0.0, |round| round.rms_um);
        score.after += last.map_or(0.0, |round| round.holdout_rms_um);
        score.number += 1.0;
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(score)
}

fn hidden_word(hidden: &Hidden) -> &'static str {
    match hidden {
        Hidden::Nothing => "nothing hidden",
        Hidden::Effects(effects) if effects.len() == 1 => "one effect",
        Hidden::Effects(_) => "two effects",
        Hidden::Outside(_) => "outside the catalogue",
    }
}

fn outcome_word(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Right => "named rightly",
        Outcome::Abstained => "abstained",
        Outcome::FalselyNamed => "falsely named",
        Outcome::Missed => "missed",
    }
}

impl Score {
    fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        for ((hidden, outcome), number) in &self.outcomes {
            writeln!(out, "{hidden:<24} {outcome:<16} {number:>5}")?;
        }
        let number = self.number.max(1.0);
        writeln!(out, "mean error before        {:.4} µm rms", self.before / number)?;
        writeln!(out, "mean error held out      {:.4} µm rms", self.after / number)?;
        if !self.wrong.is_empty() {
            writeln!(out, "seeds to look at: {:?}", self.wrong)?;
        }
        Ok(())
    }

    fn json(&self) -> Value {
        let number = self.number.max(1.0);
        json!({
            "outcomes": self.outcomes.iter().map(|((hidden, outcome), number)| json!({
                "hidden": hidden, "outcome": outcome, "number": number,
            })).collect::<Vec<_>>(),
            "mean_rms_before_um": self.before / number,
            "mean_holdout_rms_um": self.after / number,
            "seeds_to_look_at": self.wrong,
        })
    }
}
