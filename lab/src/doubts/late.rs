//! Logs by another clock than the rest: each reading stands beside what the machine did earlier, or later.

use helixlock_plant::{Bridging, LOGGED_COLUMNS};

use super::hypothesis::{Hypothesis, Words};
use super::shift::{best, moved, stages};
use crate::measurement::Measurement;
use crate::model::{Problem, Stage};
use crate::noise::Noise;
use crate::numerics::spread;
use crate::policy::mistakes::{LATE_PLACES, LATEST};

/// For the logs that the file's effects need, each alone and all of them, the lateness that brings what the file
/// predicts nearest to the data, under each noise.
pub(super) fn late_logs(problem: &Problem, noises: &[Vec<Noise>]) -> Vec<Hypothesis> {
    let measurement = &problem.measurement;
    let runs_on = measurement.time_s.windows(2).all(|pair| pair[0] <= pair[1]);
    let needed = needed(problem);
    if !measurement.timed || !runs_on || needed.is_empty() {
        return Vec::new();
    }
    let stages = stages(problem, noises);
    let all = (1 < needed.len()).then(|| needed.clone());
    let sets = needed.iter().map(|name| vec![*name]).chain(all);
    sets.flat_map(|set| hypotheses(&stages, &set)).collect()
}

/// Readings of instruments that the effects of the file need.
fn needed(problem: &Problem) -> Vec<&'static str> {
    let effects = &problem.model.effects;
    let read = LOGGED_COLUMNS.iter().filter(|column| column.bridging != Bridging::Never);
    let is_needed = |name: &&str| {
        problem.measurement.covariates.contains_key(*name)
            && effects.iter().any(|term| term.needs().contains(name))
    };
    read.map(|column| column.name).filter(is_needed).collect()
}

fn hypotheses(stages: &[Stage<'_>], set: &[&str]) -> Vec<Hypothesis> {
    let problem = stages[0].problem;
    let Ok(before) = problem.predicted_of(&problem.measurement) else { return Vec::new() };
    let step_s = LATEST * spread(&problem.measurement.time_s) / f64::from(LATE_PLACES);
    let earlier = |late_s: f64| earlier(&problem.measurement, set, late_s);
    let by = |late_s: f64| moved(problem, &earlier(late_s), &before);
    let found = stages.iter().filter_map(|stage| best(stage, &by, (step_s, LATE_PLACES)));
    let hypothesis = |(late_s, looks): (f64, f64)| {
        let one = Hypothesis::of_measurement(problem, &earlier(late_s), words(set, late_s))?;
        Some(Hypothesis { numbers: 1.0, looks, usual: 0.0, ..one })
    };
    found.filter_map(hypothesis).collect()
}

/// A measurement whose logs are taken so much earlier; before the first and after the last reading they stand.
fn earlier(measurement: &Measurement, set: &[&str], late_s: f64) -> Measurement {
    let mut mended = measurement.clone();
    let time_s = &measurement.time_s;
    for name in set {
        let Some(values) = mended.samples.covariates.get_mut(*name) else { continue };
        let read: Vec<f64> = values.to_vec();
        for (value, now_s) in values.iter_mut().zip(time_s.iter()) {
            *value = at(time_s, &read, now_s + late_s);
        }
    }
    mended
}

/// Value at an instant, between two readings along their line.
fn at(time_s: &[f64], values: &[f64], instant_s: f64) -> f64 {
    let after = time_s.partition_point(|known| *known <= instant_s);
    let (Some(before), true) = (after.checked_sub(1), after < values.len()) else {
        return values[after.min(values.len() - 1)];
    };
    let share = (instant_s - time_s[before]) / (time_s[after] - time_s[before]);
    values[before] + share * (values[after] - values[before])
}

fn words(set: &[&str], late_s: f64) -> Words {
    let names = set.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let (how, mend) = if late_s < 0.0 { ("early", "add") } else { ("late", "take") };
    let off = if late_s < 0.0 { "to" } else { "off" };
    let size_s = late_s.abs();
    let says = format!("the readings of {names} come {size_s:.1} s {how}");
    ("shift", says, format!("{mend} {size_s:.1} s {off} the clock of {names}"))
}
