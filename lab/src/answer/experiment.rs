//! What an operator could do to tell confused effects apart, by the evidence that it would bring.
//!
//! The samples of an experiment are those of the record, as it would change them, behind the record
//! itself. One explanation makes what is measured there, the other is fitted to it anew, under the
//! noise that the record shows: what it cannot follow is the evidence to be expected.

use helixlock_plant::{Samples, Term};

use crate::hypotheses::{as_it_stands, however_begun, try_candidate};
use crate::measurement::Measurement;
use crate::model::{Columns, Component, Problem, Stage, State};
use crate::noise::{Noise, rms};
use crate::numerics::{count, mean, spread};
use crate::policy::evidence::MARGIN;
use crate::policy::size::{
    ANOTHER_LENGTH, ANOTHER_SPEED, DWELL, EVEN, MORE_THAN_A_REPEAT, WORTHWHILE_UM,
};
use crate::search::Rivals;

/// An experiment with what it is expected to separate.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What to do.
    pub action: String,
    /// The two effects it separates.
    pub between: (String, String),
    /// Evidence it is expected to bring, in units of twice the log likelihood.
    pub evidence: f64,
    /// Root mean square by which their predictions would differ, µm (arcsec).
    pub separation_um: f64,
    /// Unit of that.
    pub unit: &'static str,
}

impl Advice {
    /// True for a run whose samples were worked out; without, there are no figures to be told.
    #[must_use]
    pub fn is_a_run(&self) -> bool {
        0.0 < self.evidence
    }
}

/// A change of the measurement that an operator can make.
pub(crate) struct Experiment {
    action: &'static str,
    /// True when the record has it, or the machine cannot do it.
    done: fn(&Measurement) -> bool,
    change: fn(&mut Measurement),
}

/// The plain one first: another must bring more than it.
const EXPERIMENTS: [Experiment; 8] = [
    Experiment { action: "measure the same once more", done: |_| false, change: |_| {} },
    Experiment {
        action: "measure once more at half the spindle speed",
        done: |m| {
            ANOTHER_SPEED < spread(&m.speed_rpm) / m.speed_rpm.first().copied().unwrap_or(1.0)
        },
        change: slower,
    },
    Experiment {
        action: "measure once more in the reverse direction",
        done: |m| 0.0 < spread(&m.direction) || m.rotary,
        change: reversed,
    },
    Experiment {
        action: "turn the grating disc on its hub by 90° and measure once more",
        done: |m| m.varies("grating_index_deg"),
        change: |m| repeat_with(m, "grating_index_deg", 90.0),
    },
    Experiment {
        action: "turn the workpiece in its clamping by 180° and measure once more",
        done: |m| m.varies("clamping_index_deg"),
        change: |m| repeat_with(m, "clamping_index_deg", 180.0),
    },
    Experiment {
        action: "dwell with the table locked, then measure once more",
        done: |m| DWELL * spread(&m.time_s) < pause_s(m),
        change: later,
    },
    Experiment {
        action: "measure half of the travel once more",
        done: |m| m.rotary || ANOTHER_LENGTH < uneven_lengths(m),
        change: half_the_travel,
    },
    Experiment {
        action: "measure once more with targets at uneven steps",
        done: |m| m.rotary || !is_even(m),
        change: uneven,
    },
];

/// What helps when no run of the same machine would tell.
const LOG: &str = "log what could drive it beside the error: temperatures, pressures, currents";

/// Experiments not done yet, by the evidence that they would bring between confused effects.
#[must_use]
pub(crate) fn advice(problem: &Problem, state: &State, found: &[Rivals]) -> Vec<Advice> {
    let mut all = Vec::new();
    for found in found {
        let own = &state.components[found.index];
        let (used, _) = state.coefficients(found.index);
        let rivals: Vec<Term> = found
            .tried
            .iter()
            .filter(|judged| found.confused.contains(&judged.component.term.name))
            .map(|rival| rival.component.valued(rival.coefficients().0))
            .collect();
        all.extend(apart(problem, &state.fit.noises, &own.valued(used), &rivals));
    }
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    all
}

/// Experiments that would decide between an explanation and others that do nearly as well, best
/// first; to log more where none would.
#[must_use]
pub(crate) fn apart(
    problem: &Problem,
    noises: &[Noise],
    own: &Term,
    rivals: &[Term],
) -> Vec<Advice> {
    let Some(first) = rivals.first() else { return Vec::new() };
    let feasible = EXPERIMENTS.iter().filter(|one| !(one.done)(&problem.measurement));
    let runs: Vec<(&Experiment, Problem)> =
        feasible.filter_map(|one| Some((one, changed(problem, one)?))).collect();
    let mut all: Vec<Advice> = rivals
        .iter()
        .flat_map(|rival| {
            let run = |(one, both): &(&Experiment, Problem)| {
                separated(problem, noises, (one, both), (own, rival))
            };
            worth_more(runs.iter().filter_map(run).collect())
        })
        .filter(|advice| WORTHWHILE_UM < advice.separation_um && MARGIN <= advice.evidence)
        .collect();
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    if all.is_empty() {
        all.push(Advice {
            action: LOG.to_owned(),
            between: (own.name.clone(), first.name.clone()),
            evidence: 0.0,
            separation_um: 0.0,
            unit: problem.measurement.unit(),
        });
    }
    all
}

/// Experiments between two explanations, without those that bring no more than the first of them,
/// the same once more.
fn worth_more(mut advice: Vec<Advice>) -> Vec<Advice> {
    let plain = advice.first().map_or(0.0, |first| first.evidence);
    let mut place = 0;
    advice.retain(|one| {
        place += 1;
        place == 1 || MORE_THAN_A_REPEAT * plain < one.evidence
    });
    advice
}

/// The record and an experiment behind it.
fn changed(problem: &Problem, experiment: &Experiment) -> Option<Problem> {
    let both = with_experiment(&problem.measurement, experiment);
    Problem::new(&problem.model, &both).ok()
}

/// A measurement, and behind it the samples of an experiment.
fn with_experiment(measurement: &Measurement, experiment: &Experiment) -> Measurement {
    let mut new = measurement.clone();
    let gap_s = spread(&new.time_s) / count(new.len().max(2) - 1);
    let after_s = spread(&new.time_s) + gap_s;
    (experiment.change)(&mut new);
    new.samples.time_s.iter_mut().for_each(|time| *time += after_s);
    measurement.followed_by(&new)
}

/// A record with the samples of an advised experiment behind it; `None` for advice that is no run.
#[must_use]
pub(crate) fn carried_out(measurement: &Measurement, action: &str) -> Option<Measurement> {
    let of_action = EXPERIMENTS.iter().find(|one| one.action == action)?;
    Some(with_experiment(measurement, of_action))
}

/// What an experiment would say between two explanations.
fn separated(
    problem: &Problem,
    noises: &[Noise],
    (experiment, both): (&Experiment, &Problem),
    (own, rival): (&Term, &Term),
) -> Option<Advice> {
    let shown = |term: &Term| Component::new(term.clone()).shown_um(both, &term.coefficients());
    let (true_um, other_um) = (shown(own)?, shown(rival)?);
    let apart: Vec<f64> = true_um.iter().zip(&other_um).map(|(a, b)| a - b).collect();
    let mut measured = both.clone();
    measured.observed = true_um.iter().zip(&both.predicted).map(|(a, b)| a + b).collect();
    let stage = Stage::new(&measured, &Columns::default(), noises);
    let all = stage.gain(&Columns::of(&measured, &[Component::new(own.clone())]).ok()?).gain;
    let rivals = however_begun(&stage, as_it_stands(rival.clone()));
    let refitted = rivals.filter_map(|one| try_candidate(&stage, &one));
    let followed = refitted.map(|trial| trial.gain).fold(0.0, f64::max);
    Some(Advice {
        action: experiment.action.to_owned(),
        between: (own.name.clone(), rival.name.clone()),
        evidence: all - followed,
        separation_um: rms(&both.layout, &apart),
        unit: problem.measurement.unit(),
    })
}

/// The best experiment for an effect, or what its card says when none was worked out.
#[must_use]
pub(crate) fn for_pair(advice: &[Advice], name: &str, component: &Component) -> String {
    let best = advice.iter().find(|one| one.between.0 == name || one.between.1 == name);
    let card = Term::card(component.term.kind()).map(|card| card.separated_by);
    match (best, card) {
        (Some(best), Some(card)) if !best.is_a_run() => format!("{}; also: {card}", best.action),
        (Some(best), Some(card)) => format!(
            "{}: {} and {} would differ by {:.3} {}, evidence {:.0}; also: {card}",
            best.action,
            best.between.0,
            best.between.1,
            best.separation_um,
            best.unit,
            best.evidence
        ),
        (Some(best), None) => best.action.clone(),
        (None, card) => card.unwrap_or("log one more sensor").to_owned(),
    }
}

/// Longest stretch of time without travel.
fn pause_s(measurement: &Measurement) -> f64 {
    measurement.time_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

fn slower(measurement: &mut Measurement) {
    measurement.samples.time_s.iter_mut().for_each(|time| *time *= 2.0);
    measurement.samples.speed_rpm.iter_mut().for_each(|speed| *speed *= 0.5);
}

fn reversed(measurement: &mut Measurement) {
    let end = measurement.position_mm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let turn = measurement.angle_rev.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    measurement.samples.position_mm.iter_mut().for_each(|place| *place = end - *place);
    measurement.samples.angle_rev.iter_mut().for_each(|angle| *angle = turn - *angle);
    measurement.samples.direction.iter_mut().for_each(|direction| *direction = -*direction);
}

fn later(measurement: &mut Measurement) {
    let span = spread(&measurement.time_s);
    measurement.samples.time_s.iter_mut().for_each(|time| *time += span);
}

fn repeat_with(measurement: &mut Measurement, column: &str, value: f64) {
    let rows = measurement.len();
    measurement.samples.covariates.insert(column.to_owned(), vec![value; rows].into());
}

/// Longest travel of a pass over the shortest.
fn uneven_lengths(measurement: &Measurement) -> f64 {
    let passes = measurement.pass.iter().copied().max().map_or(0, |last| last + 1);
    let lengths: Vec<f64> = (0..passes)
        .map(|pass| {
            let rows = measurement.pass.iter().zip(&measurement.position_mm);
            let own: Vec<f64> = rows.filter(|(of, _)| **of == pass).map(|(_, mm)| *mm).collect();
            spread(&own)
        })
        .collect();
    let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
    lengths.iter().copied().fold(0.0, f64::max) / least.max(f64::MIN_POSITIVE)
}

/// Distances from sample to sample along the travel.
fn distances_mm(measurement: &Measurement) -> Vec<f64> {
    let steps = measurement.position_mm.windows(2).zip(measurement.pass.windows(2));
    steps.filter(|(_, pass)| pass[0] == pass[1]).map(|(mm, _)| (mm[1] - mm[0]).abs()).collect()
}

fn is_even(measurement: &Measurement) -> bool {
    let steps = distances_mm(measurement);
    let mean = mean(&steps);
    0.0 < mean && spread(&steps) < EVEN * mean
}

fn half_the_travel(measurement: &mut Measurement) {
    let low = measurement.position_mm.iter().copied().fold(f64::INFINITY, f64::min);
    let middle = low + 0.5 * spread(&measurement.position_mm);
    let near: Vec<bool> = measurement.position_mm.iter().map(|place| *place <= middle).collect();
    measurement.keep(&near);
}

/// Every sample moved along the travel by another part of half a distance.
fn uneven(measurement: &mut Measurement) {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let steps = distances_mm(measurement);
    let mean = mean(&steps);
    let turns_a_mm = spread(&measurement.angle_rev) / spread(&measurement.position_mm);
    let Samples { position_mm, angle_rev, .. } = &mut measurement.samples;
    for (row, (place, angle)) in position_mm.iter_mut().zip(angle_rev.iter_mut()).enumerate() {
        let part = GOLDEN * count(row);
        let by = 0.5 * mean * (part - part.floor() - 0.5);
        *place += by;
        *angle += by * turns_a_mm;
    }
}
