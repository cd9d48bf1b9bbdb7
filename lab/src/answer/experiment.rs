//! What an operator could do to tell confused effects apart, scored in µm (arcsec).

use helixlock_plant::Term;

use crate::measurement::Measurement;
use crate::model::{Component, Problem, State};
use crate::noise::rms;
use crate::numerics::spread;
use crate::policy::size::{ANOTHER_SPEED, DWELL, WORTHWHILE_UM};
use crate::search::Rivals;

/// An experiment with what it is expected to separate.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What to do.
    pub action: String,
    /// The two effects it separates.
    pub between: (String, String),
    /// Root mean square by which their predictions would differ, µm (arcsec).
    pub separation_um: f64,
    /// Unit of that.
    pub unit: &'static str,
}

/// A change of the measurement that an operator can make.
struct Experiment {
    action: &'static str,
    done: fn(&Measurement) -> bool,
    change: fn(&mut Measurement),
}

const EXPERIMENTS: [Experiment; 5] = [
    Experiment {
        action: "measure once more at half the spindle speed",
        done: |m| {
            ANOTHER_SPEED < spread(&m.speed_rpm) / m.speed_rpm.first().copied().unwrap_or(1.0)
        },
        change: slower,
    },
    Experiment {
        action: "measure once more in the reverse direction",
        done: |m| 0.0 < spread(&m.direction),
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
];

/// Experiments not done yet, by how far they would drive confused effects apart.
#[must_use]
pub(crate) fn advice(problem: &Problem, state: &State, found: &[Rivals]) -> Vec<Advice> {
    let mut all = Vec::new();
    for found in found {
        let own = &state.components[found.index];
        let (used, _) = state.coefficients(found.index);
        let own_term = own.valued(used);
        for rival in found.tried.iter().filter(|j| found.confused.contains(&j.component.term.name))
        {
            let from = rival.fit.linear.coefficients.len() - rival.component.width();
            let rival_term = rival.component.valued(&rival.fit.linear.coefficients[from..]);
            all.extend(pair_advice(problem, &own_term, &rival_term));
        }
    }
    all.sort_by(|a, b| b.separation_um.total_cmp(&a.separation_um));
    all
}

fn pair_advice(problem: &Problem, a: &Term, b: &Term) -> Vec<Advice> {
    EXPERIMENTS
        .iter()
        .filter(|experiment| !(experiment.done)(&problem.measurement))
        .filter_map(|experiment| {
            let mut changed = problem.measurement.clone();
            (experiment.change)(&mut changed);
            let separation_um = separation(problem, &changed, a, b)?;
            Some(Advice {
                action: experiment.action.to_owned(),
                between: (a.name.clone(), b.name.clone()),
                separation_um,
                unit: problem.measurement.unit(),
            })
        })
        .filter(|advice| WORTHWHILE_UM < advice.separation_um)
        .collect()
}

/// How far apart two fitted effects are on samples as an experiment would give them.
fn separation(problem: &Problem, changed: &Measurement, a: &Term, b: &Term) -> Option<f64> {
    let both = Problem::new(&problem.model, changed).ok()?;
    let pattern = |term: &Term| {
        let effect = term.effect(&both.model, &both.record.columns).ok()?;
        Some(both.column(term.entry, &helixlock_plant::Effect::deltas_um(&effect, &both.record)))
    };
    let (a, b) = (pattern(a)?, pattern(b)?);
    let apart: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
    Some(rms(&both.layout, &apart))
}

/// The best experiment for an effect, or what its card says when none was worked out.
#[must_use]
pub(crate) fn for_pair(advice: &[Advice], name: &str, component: &Component) -> String {
    let best = advice.iter().find(|one| one.between.0 == name || one.between.1 == name);
    let card = Term::card(component.term.kind()).map(|card| card.separated_by);
    match (best, card) {
        (Some(best), Some(card)) => format!(
            "{}: {} and {} would differ by {:.3} {}; also: {card}",
            best.action, best.between.0, best.between.1, best.separation_um, best.unit
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
    measurement.time_s.iter_mut().for_each(|time| *time *= 2.0);
    measurement.speed_rpm.iter_mut().for_each(|speed| *speed *= 0.5);
}

fn reversed(measurement: &mut Measurement) {
    let end = measurement.position_mm.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let turn = measurement.angle_rev.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    measurement.position_mm.iter_mut().for_each(|place| *place = end - *place);
    measurement.angle_rev.iter_mut().for_each(|angle| *angle = turn - *angle);
    measurement.direction.iter_mut().for_each(|direction| *direction = -*direction);
}

fn later(measurement: &mut Measurement) {
    let span = spread(&measurement.time_s);
    measurement.time_s.iter_mut().for_each(|time| *time += span);
}

fn repeat_with(measurement: &mut Measurement, column: &str, value: f64) {
    let rows = measurement.len();
    measurement.covariates.insert(column.to_owned(), vec![value; rows]);
}
