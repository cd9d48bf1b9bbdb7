//! Prints how often the ± of `compare`, `diagnose` and `discover` hold the truth: tables in
//! docs/metrology.md. What is measured is drawn, with a known truth.
//!
//! `cargo run --release -p helixlock-lab --example lab_coverage -- NUMBER`, the number of records of
//! each table; after it, a word that asks for the tables that have it in their name alone.

use std::collections::BTreeMap;
use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;
use std::path::Path;

use helixlock_lab::{
    Challenge, FittedParameter, Measurement, Nominal, Problem, Verdict, challenge, compare,
    diagnose, discover,
};
use helixlock_plant::Model;
use helixlock_traces::{Column, Table as Samples};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

const MACHINE: &str = r#"
workpiece.lead = "6 mm"
spindle.speed = "6 rpm"
grating.lines = 14400
laser.wavelength = "0.6 um"
dividers = { a = 36, b = 50 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;
const NOISE_UM: f64 = 0.05;
/// First seed of the challenges, which no test and no other campaign of this project uses.
const FIRST_SEED: u64 = 5_000_000;

type Drawn = Result<Held, Box<dyn Error>>;
type Table = (&'static str, fn(u64) -> Drawn);

fn main() -> Result<(), Box<dyn Error>> {
    let number = std::env::args().nth(1).map_or(Ok(100), |number| number.parse())?;
    let asked = std::env::args().nth(2).unwrap_or_default();
    let mut out = std::io::stdout().lock();
    let tables: [Table; 3] =
        [("compare", of_lines), ("discover", of_formulas), ("diagnose", of_effects)];
    for (name, table) in tables.into_iter().filter(|(name, _)| name.contains(&asked)) {
        let held = table(number)?;
        writeln!(out, "| `{name}` | | ± told | within two ± | error / ±, mean | rms |")?;
        writeln!(out, "|---|---|---:|---:|---:|---:|")?;
        for ((what, parameter), errors) in &held.0 {
            writeln!(out, "| {what} | `{parameter}` | {} |", cells(errors))?;
        }
        let all: Vec<f64> = held.0.into_values().flatten().collect();
        writeln!(out, "| all | | {} |\n", cells(&all))?;
    }
    Ok(())
}

/// By what it belongs to and its name, how often its ± a value is off the truth.
#[derive(Default)]
struct Held(BTreeMap<(String, String), Vec<f64>>);

impl Held {
    fn add(&mut self, of: &str, name: &str, error: f64, stderr: f64) {
        self.0.entry((of.to_owned(), name.to_owned())).or_default().push(error / stderr);
    }
}

#[expect(clippy::cast_precision_loss, reason = "thousands")]
fn cells(errors: &[f64]) -> String {
    let number = errors.len().max(1) as f64;
    let within = errors.iter().filter(|error| error.abs() <= 2.0).count() as f64;
    let rms = (errors.iter().map(|error| error * error).sum::<f64>() / number).sqrt();
    let mean = errors.iter().sum::<f64>() / number;
    format!("{} | {:.1} % | {mean:+.2} | {rms:.2}", errors.len(), 100.0 * within / number)
}

/// A hidden effect of a challenge, where it is named rightly.
fn of_effects(number: u64) -> Drawn {
    let mut held = Held::default();
    for seed in FIRST_SEED..FIRST_SEED + number {
        let task = challenge(seed)?;
        let found = diagnose(&problem(&task.machine.model, &task.table)?);
        let Some(last) = found.rounds.last() else { continue };
        if found.verdict != Verdict::Explained || last.effects.len() != task.terms.len() {
            continue;
        }
        for effect in &last.effects {
            for (one, truth) in with_truth(&task, &effect.name, &effect.parameters) {
                let Some(stderr) = one.stderr else { continue };
                let turn = if one.key.ends_with("_deg") { 360.0 } else { f64::INFINITY };
                held.add(&effect.name, &one.key, around(one.value - truth, turn), stderr);
            }
        }
    }
    Ok(held)
}

/// The fitted parameters of an effect beside their true values; none where it is not hidden.
fn with_truth<'a>(
    task: &Challenge,
    name: &str,
    fitted: &'a [FittedParameter],
) -> Vec<(&'a FittedParameter, f64)> {
    let Some(term) = task.terms.iter().find(|term| term.name == name) else { return Vec::new() };
    let of = |one: &&FittedParameter| {
        let mut all = term.parameters.iter().zip(&term.values);
        all.find(|(what, _)| what.key() == one.key).map(|(_, truth)| *truth)
    };
    fitted.iter().filter_map(|one| Some((one, of(&one)?))).collect()
}

fn around(error: f64, turn: f64) -> f64 {
    if turn.is_finite() { error - turn * (error / turn).round() } else { error }
}

/// A wave of an order that no shaft has, under white and under slow noise, sampled evenly or not.
fn of_lines(number: u64) -> Drawn {
    let mut held = Held::default();
    for (words, alike, uneven) in [
        ("white noise", 0.0, 0.0),
        ("white noise, uneven samples", 0.0, 0.45),
        ("noise alike over 5 samples", libm::exp(-0.2), 0.0),
    ] {
        for seed in 0..number {
            let mut chance = ChaCha8Rng::seed_from_u64(seed);
            let order = chance.random_range(1.2..2.8);
            let amplitude = chance.random_range(0.03..0.2);
            let phase = chance.random_range(0.0..TAU);
            let wave = |x: f64| amplitude * libm::sin(TAU * order * x / 6.0 + phase);
            let drawn = record(&mut chance, 2, 400, [uneven, alike], wave)?;
            let found = compare(&drawn);
            let nearest =
                found.lines.iter().map(|one| &one.line).min_by(|a, b| {
                    (a.frequency - order).abs().total_cmp(&(b.frequency - order).abs())
                });
            // A line a resolution away is another one.
            let Some(line) = nearest.filter(|line| (line.frequency - order).abs() < 0.015) else {
                continue;
            };
            held.add(words, "order", line.frequency - order, line.frequency_stderr);
            held.add(words, "amplitude_um", line.amplitude - amplitude, line.amplitude_stderr);
        }
    }
    Ok(held)
}

/// Shapes that have no name, where the formula that is proposed first is theirs.
fn of_formulas(number: u64) -> Drawn {
    type Law = fn(f64, [f64; 2]) -> f64;
    let root: Law = |x, [size, at]| size * (x - at).max(0.0).sqrt();
    let bend: Law = |x, [size, at]| size * (x - at).max(0.0);
    let laws = [
        ("size*sqrt(ramp(position_mm - at_mm))", root, 0.1),
        ("slope*position_mm + size*ramp(position_mm - at_mm)", bend, 0.008),
    ];
    let mut held = Held::default();
    for (formula, law, usual) in laws {
        for seed in 0..number {
            let mut chance = ChaCha8Rng::seed_from_u64(seed);
            let truth = [usual * chance.random_range(0.5..2.0), chance.random_range(100.0..300.0)];
            let drawn = record(&mut chance, 2, 100, [0.0, 0.0], |x| law(x, truth))?;
            let found = discover(&drawn);
            let Some(first) = found.proposals.first().filter(|first| first.formula == formula)
            else {
                continue;
            };
            for (name, truth) in ["size", "at_mm"].into_iter().zip(truth) {
                let one = first.parameters.iter().find(|one| one.name == name);
                let Some((one, stderr)) = one.and_then(|one| Some((one, one.stderr?))) else {
                    continue;
                };
                held.add(&format!("`{formula}`"), name, one.value - truth, stderr);
            }
        }
    }
    Ok(held)
}

/// Passes over 400 mm of a table motion; places as uneven as said, in steps, and noise as alike from
/// one sample to the next as said.
fn record(
    chance: &mut ChaCha8Rng,
    passes: u32,
    rows: u32,
    [uneven, alike]: [f64; 2],
    motion_um: impl Fn(f64) -> f64,
) -> Result<Problem, Box<dyn Error>> {
    let model = Model::parse(MACHINE, Path::new("machine.toml"))?;
    let step_mm = 400.0 / f64::from(rows);
    let mut columns = [Vec::new(), Vec::new(), Vec::new()];
    for pass in 0..passes {
        let mut noise = 0.0;
        for row in 0..rows {
            let off = uneven * chance.random_range(-1.0..1.0);
            let place_mm = step_mm * (f64::from(row) + 0.5 + off);
            let new: f64 = StandardNormal.sample(chance);
            noise = if row == 0 { new } else { alike * noise + (1.0 - alike * alike).sqrt() * new };
            columns[0].push(f64::from(pass));
            columns[1].push(place_mm);
            columns[2].push(NOISE_UM * noise - motion_um(place_mm));
        }
    }
    let names = ["pass", "position_mm", "error_um"];
    let columns = names.into_iter().zip(columns).map(|(name, values)| Column::new(name, values));
    problem(&model, &Samples::new(columns.collect()))
}

fn problem(model: &Model, table: &Samples) -> Result<Problem, Box<dyn Error>> {
    let measurement = Measurement::from_table(table, &Nominal::of(model))?;
    Ok(Problem::new(model, &measurement)?)
}
