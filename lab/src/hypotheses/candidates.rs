//! Which effects can be tried on a measurement, and where their nonlinear parameters may lie.

use std::cell::LazyCell;
use std::ops::Range;

use helixlock_plant::units::Dimension;
use helixlock_plant::{CATALOGUE, Card, Entry, Formula, Parameter, Role, Search, Term};

use super::corrections::{corrections, is_correctable};
use super::unfolding::unfolded;
use crate::model::{Component, Problem, Stage};
use crate::numerics::{
    Looks, by_factors, count, evenly, longest, may_resolve, product, spread, usual_rate,
    waves_drawn,
};
use crate::policy::evidence::{ANOTHER_MATERIAL, HIGH_HARMONIC_PRICE, LOOSELY_KNOWN, MARGIN};
use crate::policy::extent::{
    FEWEST_DRAWN, FREQUENCIES, LONGEST, NARROWEST, OVERTONES, SHORTEST, SLOWEST_WAVES,
};
use crate::spectrum::{Scan, arc, gear_orders, strongest_first};

/// An effect that may be missing.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// The effect at its defaults.
    pub(crate) term: Term,
    /// Nonlinear values worth trying; one empty list when there are none.
    pub(crate) grid: Vec<Vec<f64>>,
    /// Per nonlinear parameter: distance of grid values, as a share of them where they are spread logarithmically; 0
    /// when only grid values count.
    pub(crate) steps: Vec<f64>,
    /// Which of them vary continuously, and over which values.
    pub(crate) continuous: Vec<(usize, Vec<f64>)>,
    /// What is looked at beside what the curve turns by along these.
    pub(crate) looks: Looks,
}

/// Grid values of a plain parameter.
const PLAIN: usize = 24;
/// Places along the travel.
const PLACES: usize = 48;
/// Instants along the record.
pub(super) const INSTANTS: usize = 96;
/// Values of a user's own parameter on either side of the one that was given, and how far they
/// reach, as a factor: neighbours differ by half a per cent, a quarter of a wave after fifty.
const OWN_VALUES: usize = 280;
const OWN_REACH: f64 = 4.0;
/// Most grid points of an effect.
const MOST: usize = 3000;

/// Every effect of the catalogue that the sensors could see and whose logs are there, of parts that
/// the machine has.
///
/// The user's own effects of [`Problem::extra`] take part like any other. `found` are the effects
/// the search has added so far.
#[must_use]
pub(crate) fn candidates(stage: &Stage<'_>, found: &[Component]) -> Vec<Candidate> {
    let mut all = candidates_of(stage, found, |_| true);
    all.extend(corrections(stage, found));
    all
}

/// Those of them that are the same effect as one, of the file if that is.
#[must_use]
pub(crate) fn candidates_like(
    stage: &Stage<'_>,
    found: &[Component],
    term: &Term,
) -> Vec<Candidate> {
    let mut all = candidates_of(stage, found, |other| other.name == term.name);
    all.extend(corrections(stage, found));
    all.retain(|one| one.term.name == term.name && one.term.instead_of == term.instead_of);
    all
}

/// Those of them whose size physics fixes.
#[must_use]
pub(crate) fn of_known_size(stage: &Stage<'_>, found: &[Component]) -> Vec<Candidate> {
    let is_known =
        |term: &Term| term.parameters.iter().any(|what| matches!(what.role, Role::Known { .. }));
    let mut known = candidates_of(stage, found, is_known);
    known.retain(|candidate| is_known(&candidate.term));
    known
}

/// Some effects of the catalogue and of the user's own. Where to look for one takes long to find out, so that
/// nobody should ask for those that are not wanted.
fn candidates_of(
    stage: &Stage<'_>,
    found: &[Component],
    is_wanted: impl Fn(&Term) -> bool,
) -> Vec<Candidate> {
    let problem = stage.problem;
    CATALOGUE
        .iter()
        .filter(|card| card.candidate && !card.random && problem.sees(card.entry))
        .filter(|card| problem.model.lacks(card.parts).is_none())
        .filter(|card| card.entry != Entry::Actuator || corrector_moves(problem))
        .filter(|card| !is_another_size(problem, card))
        .map(|card| over_the_way(problem, Term::candidate(card, problem.model.rotary)))
        .chain(problem.extra.iter().cloned())
        .filter(|term| is_wanted(term) && logged(problem, term))
        .filter_map(|term| candidate(stage, term))
        .map(|candidate| with_overtones(candidate, stage.problem, found))
        .flat_map(|candidate| {
            let others = [
                freed(&candidate),
                doubled(stage, &candidate),
                at_once(stage, &candidate),
                in_motion(stage, &candidate),
                within_the_rate(stage, &candidate),
            ];
            let begun = begun_otherwise(stage.problem, &candidate).into_iter().map(Some);
            others.into_iter().chain(begun).chain([Some(candidate)])
        })
        .flatten()
        .filter_map(|candidate| without_smooth_aliases(problem, candidate))
        .collect()
}

/// An effect whose bends are as large as leave the slopes of a metre, where the travel is shorter.
fn over_the_way(problem: &Problem, mut term: Term) -> Term {
    let way_m = spread(&problem.record.position_mm) / 1000.0;
    if way_m <= 0.0 || 1.0 <= way_m {
        return term;
    }
    for what in &mut term.parameters {
        let times = match what.unit.dimension {
            Dimension::Curvature => way_m.recip(),
            Dimension::CurvatureChange => way_m.powi(-2),
            _ => 1.0,
        };
        what.range = times * what.range.start()..=times * what.range.end();
    }
    term
}

/// True for an effect that beside one of the file's is that one in another size.
fn is_another_size(problem: &Problem, card: &Card) -> bool {
    card.parameters.iter().all(|what| !what.is_nonlinear())
        && problem.model.effects.iter().any(|term| term.kind() == card.kind && is_correctable(term))
}

/// Adds the overtones of gears of which the model has a line already.
fn with_overtones(mut candidate: Candidate, problem: &Problem, found: &[Component]) -> Candidate {
    if !candidate.term.is_of_a_gear() {
        return candidate;
    }
    let orders = gear_orders(&problem.model);
    let known = problem.model.effects.iter().chain(found.iter().map(|one| &one.term));
    let known = known.filter(|term| term.is_of_a_gear()).flat_map(Term::nonlinear);
    let overtones = known
        .filter(|order| orders.contains(order) || orders.contains(&(0.5 * order)))
        .flat_map(|order| (2..=OVERTONES).map(move |times| f64::from(times) * order))
        .filter(|order| !orders.contains(order));
    let before = candidate.grid.len();
    candidate.grid.extend(overtones.map(|order| vec![order]));
    let grown = count(candidate.grid.len()) / count(before.max(1));
    candidate.looks = candidate.looks.times(grown);
    candidate
}

/// A wave twice as often as a listed gear's, whose own need not be there: an oval wheel, a universal
/// joint, the detent of a stepping motor. It must pay for that.
fn doubled(stage: &Stage<'_>, candidate: &Candidate) -> Option<Candidate> {
    if !candidate.term.is_of_a_gear() {
        return None;
    }
    let orders = gear_orders(&stage.problem.model);
    let twice = orders.iter().map(|order| 2.0 * order).filter(|twice| !orders.contains(twice));
    let grid: Vec<Vec<f64>> = twice.map(|order| vec![order]).collect();
    let looks = Looks::at_places(count(grid.len())).times(libm::exp(0.5 * HIGH_HARMONIC_PRICE));
    (!grid.is_empty()).then(|| Candidate { grid, looks, ..candidate.clone() })
}

/// An effect whose constant is that of a material, with any value of it: nobody looks into an alloy.
///
/// It must beat the constant of the textbook by the margin that names an effect.
fn freed(candidate: &Candidate) -> Option<Candidate> {
    let mut term = candidate.term.clone();
    let what = term
        .parameters
        .iter_mut()
        .find(|what| matches!(what.role, Role::Known { stderr } if LOOSELY_KNOWN <= stderr))?;
    what.role = Role::Linear;
    what.range = ANOTHER_MATERIAL;
    let looks = candidate.looks.clone().times(libm::exp(0.5 * MARGIN));
    Some(Candidate { term, looks, ..candidate.clone() })
}

/// An effect that takes no time or way unless the data ask for one.
fn at_once(stage: &Stage<'_>, candidate: &Candidate) -> Option<Candidate> {
    let mut term = candidate.term.clone();
    let what = term.parameters.iter_mut().find(|what| what.may_be_none())?;
    what.search = Search::Fixed;
    let nonlinear = term.parameters.iter().filter(|what| what.is_nonlinear());
    let axes = nonlinear.map(|what| axis(stage, term.entry, what)).collect();
    on_axes(stage, term, axes)
}

/// An effect whose passes begin as the one before ended, where they begin there, or as behind a turn: where an axis
/// turns, how it came to its start may show.
///
/// It must beat play that is taken up by the margin that names an effect: what a shape without a name follows better is
/// no more that play for it.
fn begun_otherwise(problem: &Problem, candidate: &Candidate) -> Vec<Candidate> {
    let mut nonlinear = candidate.term.parameters.iter().filter(|what| what.is_nonlinear());
    let Some(place) = nonlinear.position(|what| what.search == Search::Switch) else {
        return Vec::new();
    };
    let since_turn = &problem.record.since_turn_mm;
    let goes_on = |rows: Range<usize>| since_turn[rows.start].is_finite();
    let goes_on = problem.record.passes().into_iter().any(goes_on);
    let turns = since_turn.iter().any(|way| way.is_finite());
    let told = [goes_on.then_some(1.0), turns.then_some(2.0)];
    let with = |value: f64| {
        let looks = candidate.looks.clone().times(libm::exp(0.5 * MARGIN));
        let mut begun = Candidate { looks, ..candidate.clone() };
        begun.grid.iter_mut().for_each(|values| values[place] = value);
        begun
    };
    told.into_iter().flatten().map(with).collect()
}

/// A wave in time of those that rows resolve at their usual rate, where uneven ones resolve more: chance
/// lines far above, which are many, would drown it, and their number cost it its significance. A look of its own.
fn within_the_rate(stage: &Stage<'_>, candidate: &Candidate) -> Option<Candidate> {
    let usual_hz = 0.5 * usual_rate(&row_times(stage.problem));
    let mut term = candidate.term.clone();
    let what = term.parameters.iter_mut().find(|what| what.is_frequency())?;
    let (low, high) = (*what.range.start(), *what.range.end());
    if high.min(stage.problem.highest_hz()) <= usual_hz || usual_hz <= low {
        return None;
    }
    what.range = low..=usual_hz;
    let within = self::candidate(stage, term)?;
    Some(Candidate { looks: within.looks.times(2.0), ..within })
}

/// An effect whatever its passes began with, at rest or, where it delays, in motion.
pub(crate) fn however_begun(
    stage: &Stage<'_>,
    resting: Candidate,
) -> impl Iterator<Item = Candidate> + use<> {
    in_motion(stage, &resting).into_iter().chain([resting])
}

/// An effect that delays on a record that began while it followed: what each pass began with is open. `None`
/// where the model shows nothing that it could delay.
pub(super) fn in_motion(stage: &Stage<'_>, candidate: &Candidate) -> Option<Candidate> {
    let term = stage.problem.with_starts(&candidate.term)?;
    let delayed = stage.problem.design(&candidate.at(0)).ok()?.fixed?;
    if delayed.iter().all(|delta| *delta == 0.0) {
        return None;
    }
    Some(Candidate { term, ..candidate.clone() })
}

/// An effect with its grid; `None` when there is no place to look for it.
#[must_use]
pub(crate) fn candidate(stage: &Stage<'_>, term: Term) -> Option<Candidate> {
    if matches!(term.formula, Formula::Custom(_)) {
        return Some(around_its_values(term));
    }
    let nonlinear = term.parameters.iter().filter(|parameter| parameter.is_nonlinear());
    let axes = nonlinear.map(|parameter| axis(stage, term.entry, parameter)).collect();
    on_axes(stage, term, axes)
}

/// An effect with the grid of some values of each of its nonlinear parameters.
pub(super) fn on_axes(stage: &Stage<'_>, term: Term, axes: Vec<Vec<f64>>) -> Option<Candidate> {
    if axes.iter().any(Vec::is_empty) {
        return None;
    }
    let steps = term
        .parameters
        .iter()
        .filter(|parameter| parameter.is_nonlinear())
        .zip(&axes)
        .map(|(parameter, axis)| {
            if parameter.is_frequency() {
                0.3 / spread(&stage.problem.record.time_s).max(f64::MIN_POSITIVE)
            } else {
                step(parameter, axis)
            }
        })
        .collect();
    let axes = thinned(axes);
    let continuous = continuous(stage, &term, &axes);
    let looks = looks(stage, &term, &axes);
    let mut candidate = Candidate { term, grid: product(&axes), steps, continuous, looks };
    keep_resolved(stage.problem, &mut candidate);
    let sound = |one: &Candidate| !one.grid.is_empty() && stage.problem.design(&one.at(0)).is_ok();
    Some(candidate).filter(sound)
}

/// Leaves out harmonics that the samples do not tell from a lower one, whatever their size; uneven
/// places may tell some far above the others.
fn keep_resolved(problem: &Problem, candidate: &mut Candidate) {
    if candidate.term.parameters.iter().all(|what| what.search != Search::Whole) {
        return;
    }
    let places = LazyCell::new(|| places(problem));
    let is_told = |point| {
        let waves = Component::new(candidate.at(point)).waves_a_turn(problem);
        waves <= problem.highest_order() || may_resolve(&places, waves)
    };
    let told = (0..candidate.grid.len()).filter(|point| is_told(*point));
    candidate.grid = told.map(|point| candidate.grid[point].clone()).collect();
}

/// Leaves out listed gears, quicker than the samples, of which they draw so little of a wave that any smooth curve is as
/// near to it; `None` where none is left.
fn without_smooth_aliases(problem: &Problem, mut candidate: Candidate) -> Option<Candidate> {
    if candidate.term.is_of_a_gear() {
        let places = LazyCell::new(|| places(problem));
        let highest = problem.highest_order();
        let is_drawn = |order: f64| order <= highest || FEWEST_DRAWN <= waves_drawn(&places, order);
        candidate.grid.retain(|values| values.iter().all(|order| is_drawn(*order)));
    }
    Some(candidate).filter(|candidate| !candidate.grid.is_empty())
}

/// Where the samples were taken, turns of the spindle: the targets, or the places of all.
fn places(problem: &Problem) -> Vec<f64> {
    problem.places().unwrap_or_else(|| problem.record.turns().collect())
}

/// Axes along which the curve of an effect turns, with their values; of an instant, all gaps between
/// samples are looked at.
fn continuous(stage: &Stage<'_>, term: &Term, axes: &[Vec<f64>]) -> Vec<(usize, Vec<f64>)> {
    let nonlinear = term.parameters.iter().filter(|what| what.is_nonlinear());
    let varying = |(axis, what): (usize, &Parameter)| match what.search {
        _ if what.is_frequency() => None,
        Search::Time => Some((axis, between_samples(&stage.problem.record.time_s))),
        Search::Linear | Search::Logarithmic | Search::Position => Some((axis, axes[axis].clone())),
        Search::Whole | Search::GearOrder | Search::Switch | Search::Fixed => None,
    };
    nonlinear.enumerate().filter_map(varying).collect()
}

/// What is looked at along axes whose columns need not be known: listed values, and all frequencies,
/// along which a wave turns by `2π·σ(t)` a hertz.
fn looks(stage: &Stage<'_>, term: &Term, axes: &[Vec<f64>]) -> Looks {
    let nonlinear = term.parameters.iter().filter(|what| what.is_nonlinear());
    nonlinear.zip(axes).fold(Looks::at_places(1.0), |looks, (what, axis)| match what.search {
        _ if what.is_frequency() => {
            let times = row_times(stage.problem);
            looks.along(arc(&times, heard(stage.problem, &times, [0.0, *what.range.end()])))
        }
        Search::Time | Search::Linear | Search::Logarithmic | Search::Position => looks,
        Search::Whole | Search::GearOrder | Search::Switch | Search::Fixed => {
            looks.times(count(axis.len()))
        }
    })
}

/// An effect at the values it has, to be refined from there.
#[must_use]
pub(crate) fn as_it_stands(term: Term) -> Candidate {
    let values = term.nonlinear();
    let parameters = term.parameters.iter().filter(|what| what.is_nonlinear());
    let step = |(value, what): (&f64, &Parameter)| {
        let is_share = *value == 0.0 || what.search == Search::Logarithmic;
        if is_share { 0.01 } else { 0.01 * value.abs() }
    };
    let (steps, looks) = (values.iter().zip(parameters).map(step).collect(), Looks::at_places(1.0));
    Candidate { steps, grid: vec![values], continuous: Vec::new(), looks, term }
}

/// A user's own effect is looked for around the values the user gave, one after the other from a
/// quarter to the fourfold: a period that is a fifth too long leads to no other one.
fn around_its_values(term: Term) -> Candidate {
    let mut candidate = as_it_stands(term);
    let values = candidate.grid[0].clone();
    for place in 0..values.len() {
        let mut axis = vec![values[place]];
        for step in 1..=OWN_VALUES {
            let factor = libm::exp(libm::log(OWN_REACH) * count(step) / count(OWN_VALUES));
            let ends = match values[place] {
                0.0 => [1.0 - factor, factor - 1.0],
                value => [value / factor, value * factor],
            };
            for end in ends {
                let mut moved = values.clone();
                moved[place] = end;
                candidate.grid.push(moved);
                axis.push(end);
            }
        }
        axis.sort_by(f64::total_cmp);
        candidate.continuous.push((place, axis));
    }
    candidate
}

impl Candidate {
    /// The effect at a grid point.
    #[must_use]
    pub(crate) fn at(&self, point: usize) -> Term {
        self.term.with_nonlinear(&self.grid[point])
    }
}

/// True when the corrector takes steps: in a closed loop, or by hand and logged.
fn corrector_moves(problem: &Problem) -> bool {
    problem.model.loop_closed || problem.measurement.covariates.contains_key("steps")
}

/// True when the covariates an effect needs are logged, and none is what was measured.
fn logged(problem: &Problem, term: &Term) -> bool {
    term.needs().iter().all(|name| problem.measurement.is_cause(name))
}

pub(super) fn axis(stage: &Stage<'_>, entry: Entry, parameter: &Parameter) -> Vec<f64> {
    let record = &stage.problem.record;
    let (low, high) = (*parameter.range.start(), *parameter.range.end());
    match parameter.search {
        _ if parameter.is_frequency() => frequencies(stage, entry, low, high),
        Search::Linear => evenly(low, high, PLAIN),
        Search::Logarithmic => logarithmic(stage.problem, parameter),
        Search::Whole => whole(low, high),
        Search::Position => inside(&record.position_mm, PLACES),
        Search::Time => evenly_among(&between_samples(&record.time_s), INSTANTS),
        Search::GearOrder => gear_orders(&stage.problem.model),
        Search::Switch | Search::Fixed => vec![parameter.default.unwrap_or(low)],
    }
}

/// Values that the record can tell apart: times from a part of an interval on, as short as formulas
/// work on, for a lag far below the rows' own shows by what the model says between them; widths
/// from a small part of the travel on, neither much longer than the record.
fn logarithmic(problem: &Problem, parameter: &Parameter) -> Vec<f64> {
    let (mut low, mut high) = (*parameter.range.start(), *parameter.range.end());
    let told = match parameter.unit.suffix().as_str() {
        "s" => Some((problem.finest_interval_s() / SHORTEST, spread(&problem.record.time_s))),
        "mm" => {
            let travel_mm = spread(&problem.record.position_mm);
            Some((travel_mm / NARROWEST, travel_mm))
        }
        "deg" => {
            let longest = longest(&problem.record.since_turn_mm);
            Some((longest / NARROWEST, longest))
        }
        _ => None,
    };
    if let Some((least, whole)) = told.filter(|(_, whole)| 0.0 < *whole) {
        low = low.max(least);
        high = high.min(whole * LONGEST).max(low);
    }
    by_factors(low.max(1e-12), high.max(1e-12), PLAIN)
}

/// The whole numbers between two values, but for none, 64 at most.
#[must_use]
pub(crate) fn whole(low: f64, high: f64) -> Vec<f64> {
    let mut values = Vec::new();
    let mut value = low.ceil();
    while value <= high && values.len() < 64 {
        if value != 0.0 {
            values.push(value);
        }
        value += 1.0;
    }
    values
}

fn inside(values: &[f64], points: usize) -> Vec<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    if spread(values) <= 0.0 { Vec::new() } else { evenly(low, low + spread(values), points) }
}

/// Some of the gaps between samples, evenly over the samples, so that pauses cost nothing.
#[must_use]
pub(crate) fn evenly_among(gaps: &[f64], most: usize) -> Vec<f64> {
    let points = most.min(gaps.len());
    (0..points).map(|i| gaps[(2 * i + 1) * gaps.len() / (2 * points)]).collect()
}

/// The gaps between samples on either side of a place, so many each.
#[must_use]
pub(crate) fn around(gaps: &[f64], place: f64, reach: usize) -> &[f64] {
    let near = gaps.partition_point(|gap| *gap < place);
    &gaps[near.saturating_sub(reach)..(near + reach).min(gaps.len())]
}

/// Every instant halfway between two samples, in order.
#[must_use]
pub(crate) fn between_samples(time_s: &[f64]) -> Vec<f64> {
    let mut sorted = time_s.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect()
}

/// Distinct frequencies of the strongest lines in time.
fn frequencies(stage: &Stage<'_>, entry: Entry, low: f64, high: f64) -> Vec<f64> {
    let (times, unit) = (row_times(stage.problem), stage.problem.unit_column(entry));
    let scan = time_scan(stage, (&times, &unit), [low, high]);
    let resolution = scan.resolution();
    let mut peaks: Vec<f64> = Vec::new();
    let white = &stage.target[..times.len()];
    for point in strongest_first(scan.spectrum(white)) {
        let apart = |known: &f64| resolution < (known - point.frequency).abs();
        if peaks.iter().all(apart) {
            peaks.push(point.frequency);
        }
        if peaks.len() == FREQUENCIES {
            break;
        }
    }
    peaks.extend(unfolded(stage.problem, &scan, white, &peaks));
    peaks
}

fn row_times(problem: &Problem) -> Vec<f64> {
    problem.samples.iter().map(|&sample| problem.record.time_s[sample]).collect()
}

fn time_scan<'a>(
    stage: &'a Stage<'_>,
    (times, unit): (&'a [f64], &'a [f64]),
    frequencies: [f64; 2],
) -> Scan<'a> {
    let [lowest, highest] = heard(stage.problem, times, frequencies);
    Scan {
        layout: &stage.problem.layout,
        noises: &stage.noises,
        turns: times,
        unit,
        whitener: &stage.whitener,
        lowest,
        highest,
    }
}

/// The lowest and the highest frequency in time, of those between two, that rows tell.
fn heard(problem: &Problem, times: &[f64], [low, high]: [f64; 2]) -> [f64; 2] {
    let slowest = SLOWEST_WAVES / spread(times).max(f64::MIN_POSITIVE);
    [low.max(slowest), high.min(problem.highest_hz())]
}

/// A scan of all rows over the spindle angle for what shows so in each.
#[must_use]
pub(crate) fn turn_scan<'a>(stage: &'a Stage<'_>, turns: &'a [f64], unit: &'a [f64]) -> Scan<'a> {
    Scan {
        layout: &stage.problem.layout,
        noises: &stage.noises,
        turns,
        unit,
        whitener: &stage.whitener,
        lowest: 1.5 / spread(turns).max(f64::MIN_POSITIVE),
        highest: stage.problem.highest_order(),
    }
}

fn step(parameter: &Parameter, axis: &[f64]) -> f64 {
    match parameter.search {
        Search::Whole | Search::GearOrder | Search::Switch | Search::Fixed | Search::Time => 0.0,
        _ if axis.len() < 2 => 0.0,
        Search::Logarithmic => 0.3 * (axis[1] / axis[0] - 1.0),
        _ => (axis[1] - axis[0]).abs(),
    }
}

/// Drops every second value of the longest axis until the product is small enough.
fn thinned(mut axes: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    while MOST < axes.iter().map(Vec::len).product() {
        let Some(longest) = axes.iter_mut().max_by_key(|axis| axis.len()) else { break };
        let mut keep = false;
        longest.retain(|_| {
            keep = !keep;
            keep
        });
    }
    axes
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::path::Path;

    use helixlock_plant::Model;
    use helixlock_traces::{Column, Table};

    use super::*;
    use crate::hypotheses::try_candidate;
    use crate::measurement::{Measurement, Nominal};
    use crate::model::{Columns, noises_of};

    /// A wave of 12 mm, of which a machine without comparisons is measured every 1.2 mm and 2 s,
    /// through a recorder of 0.05 s: `Im(exp(iωt)/(1 + iωτ))`, and a millinoise of no chance.
    #[test]
    fn a_lag_far_below_the_rows_is_found_by_what_the_file_says_between_them() {
        let machine = "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\n\
                       lead_screw.lead = '12 mm'\n[[effect]]\nkind = 'screw-periodic'\n\
                       amplitude = '2 um'\nphase = '0 deg'\n";
        let model = Model::parse(machine, Path::new("machine.toml")).expect("a machine");
        let time_s = |row: u32| 2.0 * f64::from(row);
        let (omega, tau_s) = (TAU * 0.6 / 12.0, 0.05);
        let shown = |row: u32| {
            let angle = omega * time_s(row);
            let late = libm::sin(angle) - omega * tau_s * libm::cos(angle);
            let noise = 0.01 * f64::from((row * row * 7919) % 101) / 101.0;
            -2.0 * late / (1.0 + (omega * tau_s).powi(2)) + noise
        };
        let column = |name: &str, value: &dyn Fn(u32) -> f64| Column {
            name: name.to_owned(),
            values: (0..500).map(value).collect(),
        };
        let table = Table::new(vec![
            column("time_s", &time_s),
            column("position_mm", &|row| 0.6 * time_s(row)),
            column("error_um", &shown),
        ]);
        let measurement = Measurement::from_table(&table, &Nominal::of(&model)).expect("samples");
        let problem = Problem::new(&model, &measurement).expect("all columns");
        let noises = noises_of(&problem, &problem.residual());
        let stage = Stage::new(&problem, &Columns::default(), &noises);
        let card = CATALOGUE.iter().find(|card| card.nature.delays).expect("a lag");
        let lag = candidate(&stage, Term::candidate(card, false)).expect("a place to look");
        let found = try_candidate(&stage, &lag).expect("it explains something");
        let found_s = found.component.term.nonlinear()[0];
        assert!((found_s - tau_s).abs() < 0.05 * tau_s, "{found_s} s");
    }

    /// Rows that come unevenly resolve frequencies far above the rate they have: those below are looked at by
    /// themselves. Even ones resolve none.
    #[test]
    fn waves_that_uneven_rows_resolve_at_their_rate_are_looked_at_alone() {
        let axis = "spindle.speed = '6 rpm'\nlead_screw.lead = '6 mm'\n";
        let model = Model::parse(axis, Path::new("machine.toml")).unwrap();
        let highest_hz = |uneven_s: f64| {
            let time_s =
                |row: u32| 2.0 * f64::from(row) + uneven_s * f64::from(row * row * 7919 % 101);
            let column = |name: &str, value: &dyn Fn(u32) -> f64| Column {
                name: name.to_owned(),
                values: (0..300).map(value).collect(),
            };
            let table = Table::new(vec![
                column("time_s", &time_s),
                column("position_mm", &|row| 0.6 * f64::from(row)),
                column("error_um", &|row| libm::sin(f64::from(row * row))),
            ]);
            let measurement = Measurement::from_table(&table, &Nominal::of(&model)).unwrap();
            let problem = Problem::new(&model, &measurement).unwrap();
            let noises = noises_of(&problem, &problem.residual());
            let stage = Stage::new(&problem, &Columns::default(), &noises);
            let in_time = |term: &Term| term.parameters.iter().any(Parameter::is_frequency);
            let highest = |one: &Candidate| one.grid.iter().map(|at| at[0]).fold(0.0, f64::max);
            candidates_of(&stage, &[], in_time).iter().map(highest).collect::<Vec<f64>>()
        };
        assert_eq!(highest_hz(0.0).len(), 1);
        let uneven = highest_hz(0.01);
        assert!(uneven[0] < 0.26 && 0.26 < uneven[1], "{uneven:?} Hz");
    }
}
