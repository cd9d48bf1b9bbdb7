//! One effect tried on what a model leaves: its best place, its columns, its likelihood.

use helixlock_plant::Search;

use super::candidates::{Candidate, INSTANTS, around, between_samples};
use super::grid::{on_grid, usable};
use crate::model::{Columns, Component, Gain, Problem, Stage};
use crate::numerics::simplex::minimise;
use crate::numerics::{Looks, count, in_parallel, simplex, spread};
use crate::policy::chance::EXACT_STANDARD_ERRORS;
use crate::policy::evidence::{LARGEST_STEP_UM, WHOLE};
use crate::policy::extent::SUDDEN_CHANGES;

/// A candidate at its best under a stage's noise.
#[derive(Debug, Clone)]
pub(crate) struct Trial {
    /// The effect with its nonlinear values and the columns that pay for themselves.
    pub(crate) component: Component,
    /// Whitened square it takes away.
    pub(crate) gain: f64,
    /// Where it was looked for, if that has been worked out.
    pub(crate) looks: Option<Looks>,
    /// Whole numbers that were open, against the freedom of one coefficient.
    pub(crate) choices: f64,
    /// Coefficients of the columns in use.
    pub(crate) coefficients: Vec<f64>,
}

impl Trial {
    /// Free numbers of the effect, linear and nonlinear.
    #[must_use]
    pub(crate) fn freedom(&self) -> f64 {
        self.component.freedom()
    }

    /// It with where its candidate was looked for, which takes time that only the best are worth.
    #[must_use]
    pub(crate) fn with_looks(mut self, stage: &Stage<'_>, candidate: &Candidate) -> Self {
        let place = self.component.term.nonlinear();
        self.looks.get_or_insert_with(|| looks(stage, candidate, &place));
        self
    }

    /// At how many independent places a gain was looked for.
    #[must_use]
    pub(crate) fn places(&self, gain: f64) -> f64 {
        self.choices * self.looks.as_ref().map_or(1.0, |looks| looks.for_gain(gain))
    }
}

/// Relative difference of coefficients below which two trials leave the same noise.
const ALIKE: f64 = 0.01;

impl Trial {
    /// True when another trial has the same columns and hardly other coefficients: what a fit
    /// begins with is then the same, and so is where it ends.
    #[must_use]
    pub(crate) fn leaves_as_much_as(&self, other: &Self) -> bool {
        let (own, others) = (&self.component, &other.component);
        let alike = |(a, b): (&f64, &f64)| (a - b).abs() <= ALIKE * a.abs().max(b.abs());
        own.term.nonlinear() == others.term.nonlinear()
            && own.term.priors() == others.term.priors()
            && own.kept == others.kept
            && own.whole == others.whole
            && self.coefficients.len() == other.coefficients.len()
            && self.coefficients.iter().zip(&other.coefficients).all(alike)
    }
}

/// The best of one candidate; `None` when it explains nothing.
#[must_use]
pub(crate) fn try_candidate(stage: &Stage<'_>, candidate: &Candidate) -> Option<Trial> {
    let on_grid = on_grid(stage.problem, candidate);
    let mut gains = gains_of(stage, &on_grid);
    let sudden = sudden_places(stage, candidate);
    let columns = in_parallel(&sudden, |place| columns_at(stage, candidate, place));
    gains.extend(gains_of(stage, &columns));
    let grid = [candidate.grid.as_slice(), &sudden].concat();
    let starts = starts(&grid, &gains);
    let refined = starts.into_iter().map(|point| refined(stage, candidate, &grid[point]));
    let term = refined.max_by(|a, b| a.1.total_cmp(&b.1))?.0;
    let component = reduced(stage, Component::new(term));
    let (component, looks) = placed(stage, candidate, component, &same_everywhere(&on_grid));
    let (component, choices) = counted(stage, component)?;
    let best = gain_at(stage, &component)?;
    let coefficients = best.fit.coefficients;
    Some(Trial { component, gain: best.gain, looks, choices, coefficients })
}

/// Where a candidate is looked for, with what its curve turns by through its best place.
fn looks(stage: &Stage<'_>, candidate: &Candidate, best: &[f64]) -> Looks {
    let itself = candidate.term.without_starts();
    let along = |looks: Looks, (axis, values): &(usize, Vec<f64>)| {
        looks.over(values, |value| {
            let mut place = best.to_vec();
            place[*axis] = value;
            let component = Component::new(itself.with_nonlinear(&place));
            let columns = usable(stage.problem, &component);
            columns.map_or_else(Vec::new, |columns| stage.span(&columns))
        })
    };
    candidate.continuous.iter().fold(candidate.looks.clone(), along)
}

/// Which nonlinear value of a candidate is an instant, if one is.
fn time_axis(candidate: &Candidate) -> Option<usize> {
    let terms = candidate.term.nonlinear_indices();
    terms.iter().position(|&index| candidate.term.parameters[index].search == Search::Time)
}

/// Instants of the most sudden changes, for effects of one moment.
///
/// Slow noise takes back a step that is tried a few samples too early or too late, so that it
/// shows at its own instant only, which a grid may miss.
fn sudden_places(stage: &Stage<'_>, candidate: &Candidate) -> Vec<Vec<f64>> {
    let (Some(axis), Some(first)) = (time_axis(candidate), candidate.grid.first()) else {
        return Vec::new();
    };
    let Problem { samples, record, .. } = stage.problem;
    let time_s = |row: usize| record.time_s[samples[row]];
    let mut later: Vec<usize> =
        (1..samples.len()).filter(|&row| time_s(row - 1) < time_s(row)).collect();
    let size = |row: usize| stage.target[row].abs();
    later.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
    later.truncate(SUDDEN_CHANGES);
    let before = |row: usize| 0.5 * (time_s(row - 1) + time_s(row));
    let at = |row: usize| {
        let mut place = first.clone();
        place[axis] = before(row);
        place
    };
    later.into_iter().map(at).collect()
}

/// Columns of a candidate at some nonlinear values; `None` where they say nothing.
fn columns_at(stage: &Stage<'_>, candidate: &Candidate, place: &[f64]) -> Option<Columns> {
    usable(stage.problem, &Component::new(candidate.term.with_nonlinear(place)))
}

/// Columns whose gains are worked out together.
const TOGETHER: usize = 16;

/// Gains of many columns; nothing is gained by those that say nothing.
fn gains_of(stage: &Stage<'_>, all: &[Option<Columns>]) -> Vec<f64> {
    let of = |some: &[Option<Columns>]| {
        let usable: Vec<&Columns> = some.iter().flatten().collect();
        let mut gains = stage.gains(&usable).into_iter().map(|gain| gain.gain);
        let gain = |columns: &Option<Columns>| {
            columns.as_ref().and_then(|_| gains.next()).unwrap_or_default()
        };
        some.iter().map(gain).collect::<Vec<f64>>()
    };
    in_parallel(all.chunks(TOGETHER), of).concat()
}

/// Share of the best gain of a grid from which a place may lead further up than the best.
const HOPEFUL: f64 = 0.5;

/// Places of a grid where it is worth looking further: the three best, without those next to a
/// better one, which lead to the same top.
fn starts(grid: &[Vec<f64>], gains: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..gains.len()).filter(|&point| 0.0 < gains[point]).collect();
    order.sort_by(|&a, &b| gains[b].total_cmp(&gains[a]));
    order.truncate(3);
    let best = order.first().map_or(0.0, |&point| gains[point]);
    order.retain(|&point| HOPEFUL * best < gains[point]);
    let axes: Vec<Vec<f64>> = (0..grid.first().map_or(0, Vec::len))
        .map(|axis| {
            let mut values: Vec<f64> = grid.iter().map(|point| point[axis]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup();
            values
        })
        .collect();
    let rank = |axis: usize, value: f64| axes[axis].partition_point(|known| *known < value);
    let next_to = |a: usize, b: usize| {
        let pairs = grid[a].iter().zip(&grid[b]).enumerate();
        pairs.into_iter().all(|(axis, (a, b))| rank(axis, *a).abs_diff(rank(axis, *b)) <= 1)
    };
    let mut starts: Vec<usize> = Vec::new();
    for point in order {
        if !starts.iter().any(|&better| next_to(better, point)) {
            starts.push(point);
        }
    }
    starts
}

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
        let near = EXACT_STANDARD_ERRORS * stderr + WHOLE;
        // A column that the zero of a pass takes up has no coefficient.
        if !value.is_finite()
            || whole == 0.0
            || (stage.is_noise(&free) && near < (value - whole).abs())
        {
            return None;
        }
        held.whole[column] = Some(whole);
        let raw = Columns::of(stage.problem, std::slice::from_ref(&held)).ok()?.raw;
        let unit_um = spread(raw.get(column)?).max(1e-6);
        // The Bayesian price of one coefficient is √n; a whole number costs its alternatives, and no
        // more than a coefficient that need not be whole.
        let rows = count(stage.problem.samples.len()).max(3.0);
        choices *= ((2.0 * LARGEST_STEP_UM / unit_um).max(1.0) / rows.sqrt()).min(1.0);
    }
    Some((held, choices))
}

/// Gain of a component under the stage's noise; `None` when its columns cannot be made.
#[must_use]
pub(crate) fn gain_at(stage: &Stage<'_>, component: &Component) -> Option<Gain> {
    usable(stage.problem, component).map(|columns| stage.gain(&columns))
}

/// Nonlinear values improved from a grid point, within their ranges.
fn refined(
    stage: &Stage<'_>,
    candidate: &Candidate,
    place: &[f64],
) -> (helixlock_plant::Term, f64) {
    let start = &sharpened(stage, candidate, place);
    let free: Vec<usize> = (0..start.len()).filter(|&i| candidate.steps[i] != 0.0).collect();
    let ranges: Vec<(f64, f64)> = candidate
        .term
        .nonlinear_indices()
        .iter()
        .map(|&i| &candidate.term.parameters[i].range)
        .map(|range| (*range.start(), *range.end()))
        .collect();
    let terms = candidate.term.nonlinear_indices();
    let step = |i: usize| match candidate.term.parameters[terms[i]].search {
        Search::Logarithmic if start[i] != 0.0 => candidate.steps[i] * start[i].abs(),
        _ => step_of(start[i], candidate.steps[i]),
    };
    let place = |moved: &[f64]| {
        let mut values = start.clone();
        for (&i, shift) in free.iter().zip(moved) {
            values[i] = start[i] + shift * step(i);
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
        let reach = gaps.len() / INSTANTS + 2;
        let nearby = around(&gaps, best[place], reach);
        let columns = |gap: &f64| {
            let mut values = best.clone();
            values[place] = *gap;
            columns_at(stage, candidate, &values)
        };
        let columns = in_parallel(nearby, columns);
        let gains = gains_of(stage, &columns);
        if let Some(top) = nearby.iter().zip(gains).max_by(|a, b| a.1.total_cmp(&b.1)) {
            best[place] = *top.0;
        }
    }
    best
}

/// A step no larger than the value itself.
fn step_of(value: f64, step: f64) -> f64 {
    if value == 0.0 { step } else { step.min(value.abs()) }
}

/// With the sizes that pay by the Bayesian information criterion: those of all that are left when the weakest have gone,
/// or the best with those that have joined it, whichever is worth more.
///
/// From all alone, a square and a cube that undo each other would stand for a slope, which goes first; from
/// one alone, two would not be found that are worth something together.
#[must_use]
pub(crate) fn reduced(stage: &Stage<'_>, all: Component) -> Component {
    if all.atoms().len() < 2 {
        return all;
    }
    let none = Component { kept: vec![false; all.kept.len()], ..all.clone() };
    let [fewer, more] =
        [(all, true), (none, false)].map(|(start, goes)| stepped(stage, start, goes));
    if fewer.0 < more.0 { more.1 } else { fewer.1 }
}

/// An effect, and what it is worth, whose sizes go, or join, one by one while that pays.
fn stepped(stage: &Stage<'_>, start: Component, goes: bool) -> (f64, Component) {
    let price = stage.problem.price_of_a_number();
    let valued = |component: Component| {
        let gain = gain_at(stage, &component).map_or(f64::NEG_INFINITY, |gain| gain.gain);
        (gain - price * count(component.width()), component)
    };
    let atoms = start.atoms();
    let nothing = (f64::NEG_INFINITY, start.clone());
    let mut best = if goes { valued(start) } else { nothing };
    loop {
        let others = atoms.iter().filter(|atom| best.1.kept[atom[0]] == goes);
        let others = others.map(|atom| with(&best.1, atom, !goes));
        let next = others.filter(|other| 0 < other.width()).map(valued);
        match next.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some(next) if best.0 < next.0 => best = next,
            _ => return best,
        }
    }
}

/// Per column: true when it is the same at the first, the middle and the last place of a grid;
/// nothing where there is one place only, whose looks are no places.
fn same_everywhere(on_grid: &[Option<Columns>]) -> Vec<bool> {
    let usable: Vec<&Columns> = on_grid.iter().flatten().collect();
    let Some(first) = usable.first().filter(|_| 1 < on_grid.len()) else { return Vec::new() };
    let others = [usable[usable.len() / 2], usable[usable.len() - 1]];
    let same = |column: usize| others.iter().all(|other| other.raw[column] == first.raw[column]);
    (0..first.raw.len()).map(same).collect()
}

/// An effect with the looks it must pay for, where they are known: none are for columns that have no
/// place, and those that have one must pay for the looks as well to stay beside them.
fn placed(
    stage: &Stage<'_>,
    candidate: &Candidate,
    component: Component,
    same_everywhere: &[bool],
) -> (Component, Option<Looks>) {
    let kept = component.kept.iter().zip(same_everywhere).map(|(kept, same)| *kept && *same);
    let placeless = Component { kept: kept.collect(), ..component.clone() };
    if placeless.width() == 0 || placeless.kept.len() != component.kept.len() {
        return (component, None);
    }
    let looks = looks(stage, candidate, &component.term.nonlinear());
    let gain = |component: &Component| gain_at(stage, component).map_or(0.0, |gain| gain.gain);
    let price = stage.problem.price_of_a_number();
    let score = |component: &Component, gain: f64| gain - price * count(component.width());
    let (with_place, without) = (gain(&component), gain(&placeless));
    let places = looks.for_gain(with_place);
    if places <= 1.0 {
        return (component, Some(looks));
    }
    let placed_wins = placeless.width() < component.width()
        && score(&placeless, without) < score(&component, with_place) - 2.0 * libm::log(places);
    let one_place = Looks::at_places(1.0);
    if placed_wins { (component, Some(looks)) } else { (placeless, Some(one_place)) }
}

/// An effect that uses a size, or does not.
fn with(component: &Component, atom: &[usize], used: bool) -> Component {
    let mut other = component.clone();
    for &column in atom {
        other.kept[column] = used;
    }
    other
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_search_goes_on_from_tops_that_are_apart() {
        let grid: Vec<Vec<f64>> =
            (0..20).map(|i| vec![count(i % 5), libm::exp(count(i / 5))]).collect();
        let mut gains = vec![1.0; 20];
        // A top with a neighbour across a corner, and another top two places on.
        (gains[6], gains[12], gains[8]) = (50.0, 40.0, 30.0);
        assert_eq!(starts(&grid, &gains), [6, 8]);
        gains[8] = 20.0;
        assert_eq!(starts(&grid, &gains), [6]);
        assert!(starts(&grid, &[0.0; 20]).is_empty());
        assert_eq!(starts(&[vec![]], &[3.0]), [0]);
    }
}
