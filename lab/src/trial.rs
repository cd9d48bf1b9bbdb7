//! One effect tried on what a model leaves: its best place, its columns, its likelihood.

use helixlock_plant::Search;
use rayon::prelude::*;

use crate::candidates::{Candidate, between_samples};
use crate::component::Component;
use crate::count;
use crate::fit::Columns;
use crate::simplex::{self, minimise};
use crate::stage::{Gain, Stage};

/// A candidate at its best under a stage's noise.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The effect with its nonlinear values and the columns that pay for themselves.
    pub component: Component,
    /// Whitened square it takes away.
    pub gain: f64,
    /// Independent places that were looked at.
    pub looks: f64,
    /// Coefficients of the columns in use.
    pub coefficients: Vec<f64>,
}

impl Trial {
    /// Free numbers of the effect, linear and nonlinear.
    #[must_use]
    pub fn freedom(&self) -> f64 {
        count(self.component.width().max(1))
    }
}

/// The best of one candidate; `None` when it explains nothing.
#[must_use]
pub fn try_candidate(stage: &Stage<'_>, candidate: &Candidate) -> Option<Trial> {
    let gains: Vec<f64> = (0..candidate.grid.len())
        .into_par_iter()
        .map(|point| gain_at(stage, &Component::new(candidate.at(point))).map_or(0.0, |g| g.gain))
        .collect();
    let mut order: Vec<usize> = (0..gains.len()).collect();
    order.sort_by(|&a, &b| gains[b].total_cmp(&gains[a]));
    let starts = order.into_iter().take(3).filter(|&point| 0.0 < gains[point]);
    let refined = starts.map(|point| refined(stage, candidate, point));
    let term = refined.max_by(|a, b| a.1.total_cmp(&b.1))?.0;
    let component = reduced(stage, Component::new(term));
    let (component, choices) = counted(stage, component)?;
    let best = gain_at(stage, &component)?;
    let coefficients = best.fit.coefficients;
    Some(Trial { component, gain: best.gain, looks: candidate.looks * choices, coefficients })
}

/// Largest step that a count is looked for, µm; it sets what a whole number must pay.
const LARGEST_STEP_UM: f64 = 5.0;

/// Holds counts at the whole number nearest to their fit; `None` when they are none.
///
/// Also the number of whole numbers that were open, against the freedom of one coefficient.
fn counted(stage: &Stage<'_>, component: Component) -> Option<(Component, f64)> {
    let mut held = component;
    let mut choices = 1.0;
    for column in held.counts() {
        let free = gain_at(stage, &held)?.fit;
        let value = free.coefficients[column];
        let stderr = free.covariance[(column, column)].max(0.0).sqrt();
        let whole = value.round();
        if whole == 0.0 || 4.0 * stderr + 0.02 < (value - whole).abs() {
            return None;
        }
        held.whole[column] = Some(whole);
        let raw = Columns::of(stage.problem, std::slice::from_ref(&held)).ok()?.raw;
        let unit_um = crate::measurement::spread(raw.get(column)?).max(1e-6);
        // The Bayesian price of one coefficient is √n; a whole number costs its alternatives.
        let rows = count(stage.problem.rows.len()).max(3.0);
        choices *= (2.0 * LARGEST_STEP_UM / unit_um).max(1.0) / rows.sqrt();
    }
    Some((held, choices))
}

/// Gain of a component under the stage's noise; `None` when its columns cannot be made.
#[must_use]
pub fn gain_at(stage: &Stage<'_>, component: &Component) -> Option<Gain> {
    let columns = Columns::of(stage.problem, std::slice::from_ref(component)).ok()?;
    let usable = columns.raw.iter().all(|column| is_usable(column));
    usable.then(|| stage.gain(&columns))
}

/// Smallest swing, µm, of a column that says anything: what lies below is the far end of a bump
/// outside the data, and would ask for coefficients of hundreds of digits.
const SMALLEST_SWING_UM: f64 = 1e-12;

fn is_usable(column: &[f64]) -> bool {
    let swing_um = crate::measurement::spread(column);
    let finite = column.iter().all(|value| value.is_finite());
    finite && (swing_um <= 0.0 || SMALLEST_SWING_UM < swing_um)
}

/// Nonlinear values improved from a grid point, within their ranges.
fn refined(stage: &Stage<'_>, candidate: &Candidate, point: usize) -> (helixlock_plant::Term, f64) {
    let start = &sharpened(stage, candidate, &candidate.grid[point]);
    let free: Vec<usize> = (0..start.len()).filter(|&i| candidate.steps[i] != 0.0).collect();
    let ranges: Vec<(f64, f64)> = candidate
        .term
        .nonlinear_indices()
        .iter()
        .map(|&i| &candidate.term.parameters[i].range)
        .map(|range| (*range.start(), *range.end()))
        .collect();
    let place = |moved: &[f64]| {
        let mut values = start.clone();
        for (&i, shift) in free.iter().zip(moved) {
            values[i] =
                start[i] + shift * candidate.steps[i].min(step_of(start[i], candidate.steps[i]));
            if ranges[i].0 < ranges[i].1 {
                values[i] = values[i].clamp(ranges[i].0, ranges[i].1);
            }
        }
        candidate.term.with_nonlinear(&values)
    };
    let loss = |moved: &[f64]| {
        gain_at(stage, &Component::new(place(moved))).map_or(f64::INFINITY, |gain| -gain.gain)
    };
    let search = simplex::Search { evaluations: 40 * free.len(), tolerance: 1e-3 };
    let (moved, loss) = minimise(loss, &vec![0.0; free.len()], &vec![0.6; free.len()], search);
    (place(&moved), -loss)
}

/// Instants moved to the best gap between two samples near a grid point.
fn sharpened(stage: &Stage<'_>, candidate: &Candidate, start: &[f64]) -> Vec<f64> {
    let mut best = start.to_vec();
    for (place, &index) in candidate.term.nonlinear_indices().iter().enumerate() {
        if candidate.term.parameters[index].search != Search::Time {
            continue;
        }
        let gaps = between_samples(&stage.problem.record.time_s);
        let reach = gaps.len() / 96 + 2;
        let near = gaps.partition_point(|gap| *gap < best[place]);
        let nearby = &gaps[near.saturating_sub(reach)..(near + reach).min(gaps.len())];
        let gain = |gap: f64| {
            let mut values = best.clone();
            values[place] = gap;
            let component = Component::new(candidate.term.with_nonlinear(&values));
            gain_at(stage, &component).map_or(0.0, |gain| gain.gain)
        };
        let scored: Vec<(f64, f64)> = nearby.par_iter().map(|&gap| (gap, gain(gap))).collect();
        if let Some(top) = scored.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
            best[place] = top.0;
        }
    }
    best
}

/// A step no larger than the value itself where values are spread logarithmically.
fn step_of(value: f64, step: f64) -> f64 {
    if value == 0.0 { step } else { step.min(value.abs()) }
}

/// Leaves out columns that do not pay by the Bayesian information criterion, weakest first.
#[must_use]
pub fn reduced(stage: &Stage<'_>, component: Component) -> Component {
    let mut best = component;
    let atoms = best.atoms();
    if atoms.len() < 2 {
        return best;
    }
    let price = libm::log(count(stage.problem.rows.len()).max(3.0));
    let score = |component: &Component| {
        gain_at(stage, component)
            .map_or(f64::NEG_INFINITY, |gain| gain.gain - price * count(component.width()))
    };
    let mut now = score(&best);
    loop {
        let smaller = atoms
            .iter()
            .filter(|atom| best.kept[atom[0]])
            .map(|atom| without(&best, atom))
            .filter(|component| 0 < component.width())
            .map(|component| (score(&component), component))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match smaller {
            Some((score, component)) if now < score => (now, best) = (score, component),
            _ => return best,
        }
    }
}

fn without(component: &Component, atom: &[usize]) -> Component {
    let mut smaller = component.clone();
    for &column in atom {
        smaller.kept[column] = false;
    }
    smaller
}
