//! Structure that no effect needs to explain: what a residual must not show if it is noise.
//!
//! Each probe is a set of columns that belong to no effect. Its likelihood against the model, the
//! noise fitted anew on both sides, says whether something is left, and its shape says what.

use super::alternating::alternating;
use super::bursts::bursts;
use super::calibration;
use super::chirps::chirps;
use super::common_curve::common_curve;
use super::excursions::excursions;
use super::flaws::{above_flaws, of_stairs};
use super::jumps::jumps;
use super::levels::levels;
use super::local::{self, Local};
use super::lost_signs::lost_signs;
use super::nonlinearity::nonlinearity;
use super::odd_pass::odd_pass;
use super::outliers::{Company, outliers};
use super::repeatability::repeatability;
use super::slow_noise::taken_for_noise;
use super::swings::swings;
use super::tails::chance_with_tails;
use super::time_reversal::one_way;
use super::uneven_slowness::uneven_slowness;
use super::waves;
use super::waves_of_passes::waves_of_passes;
use helixlock_plant::Column;

use crate::model::{Columns, Fit, Problem, Shaft, Stage, settle};
use crate::noise::{Whitener, rms, swift_rms, weighed_rms};
use crate::numerics::{chi_squared_tail, count, spread};
use crate::policy::chance::{MANY_COLUMNS, NAMED, PROBES, SIGNIFICANCE};
use crate::policy::extent::{
    BUMP_ORDER, COLUMNS_OF_PASSES, CURVE_OF_A_LOG, CURVE_OF_A_PASS, CURVE_ORDER, HARMONICS,
    ROWS_A_COLUMN, SLOWEST_WAVES, TURNS, WAVE_ORDER,
};
use crate::policy::size::{FAR_ABOVE, LOOP_JUMP, SHARE_OF_NOISE};
use crate::spectrum::Line;

/// What is left, in the words of a person.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// The coordinate or covariate along which it shows.
    pub along: String,
    /// Its shape in words.
    pub shape: String,
    /// Root mean square of it, µm (arcsec).
    pub rms_um: f64,
    /// Chance of as much in noise, with all probes counted.
    pub p_value: f64,
    /// Where it is, when it has a place: order, mm or s.
    pub at: Option<f64>,
    /// Standard error of the place.
    pub at_stderr: Option<f64>,
    /// The line, when it is one.
    pub line: Option<Line>,
    /// Columns that draw it, row by row, in any size; none where no columns do.
    pub(crate) drawn_by: Vec<Column>,
}

impl Structure {
    /// True for what is beyond chance; what is not was left for another reason, as a curve that
    /// cannot be told from slow noise.
    #[must_use]
    pub fn is_beyond_chance(&self) -> bool {
        self.p_value < NAMED
    }

    /// Structure along a coordinate that stands at no particular place of it.
    pub(crate) fn without_place(along: &str, shape: &str, rms_um: f64, p_value: f64) -> Self {
        let (along, shape) = (along.to_owned(), shape.to_owned());
        let (at, at_stderr, line, drawn_by) = (None, None, None, Vec::new());
        Self { along, shape, rms_um, p_value, at, at_stderr, line, drawn_by }
    }

    /// The same with the columns that draw it.
    pub(crate) fn drawn_by(self, columns: Vec<Column>) -> Self {
        Self { drawn_by: columns, ..self }
    }
}

/// Tells shapes no larger than all that is left: against slow noise they may be fitted so.
pub(crate) fn no_larger_than(left_um: f64, told: &mut [Structure]) {
    for one in told {
        one.rms_um = one.rms_um.min(left_um);
    }
}

/// Seconds of a day.
const A_DAY_S: f64 = 86_400.0;

/// Words for what targets show.
const AT_TARGETS: &str = "own error of each target, at every visit";

/// The same where it is another one way than the other.
const EACH_WAY: &str = "own error of each target, another each way";

/// Number of probes, for they are counted together: every logged column is two more, a speed that
/// changes within a pass one, and so is every shaft beside the spindle and the screw.
pub(super) fn probes(problem: &Problem) -> f64 {
    let columns = 2 * problem.measurement.covariates.len();
    let speeds = usize::from(problem.velocity_rpm().is_some());
    PROBES + count(columns + speeds + problem.shafts(TURNS).len().saturating_sub(2))
}

/// Chance of one probe with all of them counted.
pub(super) fn of_all(problem: &Problem, chance: f64) -> f64 {
    (probes(problem) * chance).min(1.0)
}

/// True for something beyond chance and large enough to change a figure: as much against the swift
/// part of what a fit leaves as an effect must have to be taken, since slow noise covers no wave.
#[must_use]
pub(crate) fn matters(problem: &Problem, fit: &Fit, size_um: f64, p_value: f64) -> bool {
    p_value < SIGNIFICANCE && is_large(problem, fit, size_um)
}

/// True for something large enough to change a figure.
pub(super) fn is_large(problem: &Problem, fit: &Fit, size_um: f64) -> bool {
    SHARE_OF_NOISE * swift_rms(&problem.layout, &fit.left) < size_um
}

/// Everything a fit leaves that is not noise, clearest first.
#[must_use]
pub(crate) fn structures(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut found = all_structures(problem, model, fit);
    let taken = taken_for_noise(problem, fit, &found);
    found.retain(|structure| matters(problem, fit, structure.rms_um, structure.p_value));
    found.extend(taken);
    found.retain(|structure| above_flaws(problem, fit, structure));
    found
}

/// Waves that a fit leaves, beyond chance.
#[must_use]
pub(crate) fn waves_left(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut found = waves::lines(problem, model, fit);
    found.retain(|structure| is_left(problem, fit, structure));
    found
}

/// True for structure beyond chance, and larger than flaws of the noise, of the formulas and of a
/// loop may make.
#[must_use]
pub(crate) fn is_left(problem: &Problem, fit: &Fit, structure: &Structure) -> bool {
    matters(problem, fit, structure.rms_um, structure.p_value)
        && above_flaws(problem, fit, structure)
}

/// Everything that was looked for, found or not, clearest first.
#[must_use]
pub(crate) fn all_structures(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut all = smooth(problem, model, fit);
    all.extend(cyclic_shapes(problem, model, fit));
    all.extend(daily(problem, model, fit));
    all.extend(repeats(problem, fit));
    all.extend(in_common(problem, fit));
    all.extend(at_targets(problem, model, fit));
    all.extend(each_way_at_targets(problem, model, fit));
    all.extend(bent_pass(problem, fit));
    all.extend(standing_out(problem, fit));
    all.extend(predicted(problem, model, fit));
    all.extend(keeping(problem, fit));
    all.extend(swinging(problem, fit));
    all.extend(slow_in_some_passes(problem, fit));
    all.extend(standing_apart(problem, fit));
    all.extend(on_the_other_side(problem, fit));
    all.extend(jumping(problem, fit));
    all.extend(one_way_jumps(problem, fit));
    all.extend(local_shapes(problem, fit));
    all.extend(waves::lines(problem, model, fit));
    all.extend(waves::bands(problem, fit));
    all.extend(waves_of_passes(problem, model, fit));
    all.extend(waves::combs(problem, model, fit));
    all.extend(chirps(problem, model, fit));
    all.extend(bursts(problem, model, fit));
    all.extend(step(problem, model, fit));
    all.push(alternating(problem, model, fit));
    all.extend(covariates(problem, model, fit));
    all.extend(curves_of_logs(problem, model, fit));
    all.sort_by(|a, b| a.p_value.total_cmp(&b.p_value).then(b.rms_um.total_cmp(&a.rms_um)));
    all
}

/// Change inside a pass, against a column's size, that is rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// True unless the zero of each pass stands for all there is of a column: a speed, a direction, or
/// a harmonic that samples at whole parts of a turn always meet at the same angle.
pub(super) fn varies_inside_a_pass(problem: &Problem, column: &[f64]) -> bool {
    let size = column.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let mut blocks = problem.layout.blocks.iter();
    blocks.any(|block| ROUNDING * size < spread(&column[block.rows.clone()]))
}

/// Structure explained by free columns: its size, and its chance with all probes counted.
pub(super) fn probe(problem: &Problem, model: &Columns, fit: &Fit, raw: &[Column]) -> (f64, f64) {
    asked(problem, (model, fit), raw, (probes(problem), SIGNIFICANCE))
}

/// The same as one of so many looks, of a chance that is beyond noise below a limit.
pub(super) fn asked(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    raw: &[Column],
    (looks, limit): (f64, f64),
) -> (f64, f64) {
    let varying = raw.iter().filter(|column| varies_inside_a_pass(problem, column));
    let raw: &[Column] = &varying.cloned().collect::<Vec<_>>();
    if raw.is_empty() {
        return (0.0, 1.0);
    }
    let width = count(raw.len());
    let wider = settle(problem, &model.and(&Columns::free(raw.to_vec())), &fit.noises);
    let gain = 2.0 * (wider.log_likelihood - fit.log_likelihood);
    // A bad reading has no say in a shape's size either.
    let before = weighed_rms(&problem.layout, &fit.left);
    let after = weighed_rms(&problem.layout, &wider.left);
    let size = (before * before - after * after).max(0.0).sqrt();
    let mut chance = chi_squared_tail(gain, width);
    if MANY_COLUMNS <= raw.len() && looks * chance < limit && is_large(problem, fit, size) {
        chance = calibration::chance(problem, (model, fit), raw, gain, limit / looks);
    }
    (size, (looks * chance).min(1.0))
}

/// True for a shape that stands far above the rest: many columns also follow slow noise.
fn far_above(rms_um: f64, noise_um: f64) -> bool {
    FAR_ABOVE * (noise_um * noise_um - rms_um * rms_um) <= rms_um * rms_um
}

fn smooth(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let record = &problem.record;
    let noise = weighed_rms(&problem.layout, &fit.left);
    let passes = record.passes().len();
    let position = &record.position_mm;
    let orders = [CURVE_ORDER, BUMP_ORDER, WAVE_ORDER];
    let mut axes: Vec<_> = orders.map(|order| ("position", position, order)).into();
    if problem.model.rotary || 1 < passes {
        axes.push(("time", &record.time_s, CURVE_ORDER));
    }
    let mut found = Vec::new();
    for (along, values, order) in axes {
        if spread(values) <= 0.0 || problem.samples.len() < ROWS_A_COLUMN * order {
            continue;
        }
        let raw = stacked(problem, &chebyshev(values, order));
        let (rms_um, mut p_value) = probe(problem, model, fit, &raw);
        if order == WAVE_ORDER && !far_above(rms_um, noise) {
            p_value = 1.0;
        }
        let shape = match order {
            CURVE_ORDER => "smooth curve",
            BUMP_ORDER => "local bump or wave",
            _ => "wave whose length changes, or several bumps",
        };
        found.push(Structure::without_place(along, shape, rms_um, p_value).drawn_by(raw));
    }
    found.extend(smooth_in_passes(problem, model, fit));
    found
}

/// A smooth curve over the travel that is another one in every pass.
fn smooth_in_passes(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    let passes = problem.record.passes();
    let order = (COLUMNS_OF_PASSES / passes.len().max(1)).min(*CURVE_OF_A_PASS.end());
    let few = problem.samples.len() < ROWS_A_COLUMN * order * passes.len();
    if passes.len() < 2 || order < *CURVE_OF_A_PASS.start() || few {
        return None;
    }
    let mut raw = Vec::new();
    for rows in passes {
        for curve in chebyshev(&problem.record.position_mm[rows.clone()], order) {
            let mut whole = vec![0.0; problem.record.len()];
            whole[rows.clone()].copy_from_slice(&curve);
            raw.push(whole);
        }
    }
    let raw = stacked(problem, &raw);
    let (rms_um, chance) = probe(problem, model, fit, &raw);
    let p_value =
        if far_above(rms_um, weighed_rms(&problem.layout, &fit.left)) { chance } else { 1.0 };
    let shape = "smooth curve, another in each pass";
    Some(Structure::without_place("position", shape, rms_um, p_value).drawn_by(raw))
}

/// Anything at all that comes back at the same place in another pass.
fn repeats(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (share, chance) = repeatability(problem, fit)?;
    let rms_um = weighed_rms(&problem.layout, &fit.left) * share.max(0.0).sqrt();
    let p_value = of_all(problem, chance);
    Some(Structure::without_place("position", "repeats from pass to pass", rms_um, p_value))
}

/// A curve of all passes, in another size in each.
fn in_common(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = common_curve(problem, fit)?;
    let p_value = of_all(problem, chance);
    let shape = "curve that passes have in common, each in its own size";
    Some(Structure::without_place("position", shape, rms_um, p_value))
}

/// What targets show each way, whatever the shape from one to the next: a screw that is pulled and pushed, a
/// carriage that tilts with its motion.
fn each_way_at_targets(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    let between = problem.columns_between_ways();
    if between.is_empty() || problem.are_targets_free() {
        return None;
    }
    let own = problem.columns_of_targets();
    of_targets(problem, (model, fit), [own, between].concat(), EACH_WAY)
}

/// What targets show at every visit, whatever the shape from one to the next.
#[must_use]
pub(crate) fn at_targets(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    if problem.are_targets_free() {
        return None;
    }
    of_targets(problem, (model, fit), problem.columns_of_targets(), AT_TARGETS)
}

/// What targets show one way and not the other, though what they show at every visit may be free.
#[must_use]
pub(crate) fn between_ways(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    of_targets(problem, (model, fit), problem.columns_between_ways(), EACH_WAY)
}

/// What some columns of targets show.
fn of_targets(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    columns: Vec<Vec<f64>>,
    shape: &str,
) -> Option<Structure> {
    if columns.is_empty() {
        return None;
    }
    let raw: Vec<Column> = columns.into_iter().map(Column::from).collect();
    let (rms_um, p_value) = probe(problem, model, fit, &raw);
    Some(Structure::without_place("position", shape, rms_um, p_value).drawn_by(raw))
}

/// One pass that is bent as no other is.
fn bent_pass(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let odd = odd_pass(problem, fit)?;
    let p_value = of_all(problem, odd.chance);
    let told = Structure::without_place("position", "curve of one pass alone", odd.rms_um, p_value);
    Some(told.drawn_by(odd.columns))
}

/// Several jumps, wherever they are.
fn jumping(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = jumps(problem, fit)?;
    if rms_um < LOOP_JUMP * problem.hunting_um {
        return None;
    }
    let p_value = of_all(problem, chance);
    Some(Structure::without_place("time", "several jumps", rms_um, p_value))
}

/// What most of the record does not show.
fn standing_out(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let found = excursions(problem, fit)?;
    let p_value = of_all(problem, found.p_value);
    let shape = "excursions that most of the record does not show";
    Some(Structure::without_place("time", shape, found.rms_um, p_value))
}

/// What goes on as noise does not. Beside effects it is not asked: of 200 challenges two that were
/// explained rightly were not believed.
fn predicted(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    if problem.starts < model.raw.len() {
        return None;
    }
    let (rms_um, chance) = nonlinearity(problem, fit)?;
    let p_value = of_all(problem, chance);
    let shape = "humps, levels or teeth, more regular than noise";
    Some(Structure::without_place("time", shape, rms_um, p_value))
}

/// Levels or bounds that noise does not keep to.
fn keeping(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = levels(problem, fit)?;
    let shape = "switches between levels, or swings between bounds";
    Some(Structure::without_place("time", shape, rms_um, of_all(problem, chance)))
}

/// What goes there and back at no one frequency.
fn swinging(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = swings(problem, fit)?;
    let shape = "swings there and back, of changing length";
    Some(Structure::without_place("time", shape, rms_um, of_all(problem, chance)))
}

/// What moves in some passes, where others are still.
fn slow_in_some_passes(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = uneven_slowness(problem, fit)?;
    let shape = "slow in some passes or stretches, and not in others";
    Some(Structure::without_place("time", shape, rms_um, of_all(problem, chance)))
}

/// Outliers that do not come by chance.
fn standing_apart(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let found = outliers(problem, fit).filter(|one| of_stairs(problem) < one.rms_um)?;
    let (along, how, at) = match found.company {
        Company::Rows => ("time", "several together", None),
        Company::Angle(order) => ("spindle order", "at one angle", Some(order)),
        Company::Intervals => ("time", "at even intervals", None),
        Company::Place => ("position", "where the last pass has one", None),
        Company::Number => ("time", "more than noise has", None),
    };
    let shape = format!("samples far from their neighbours, {how}");
    let p_value = of_all(problem, found.p_value);
    Some(Structure { at, ..Structure::without_place(along, &shape, found.rms_um, p_value) })
}

/// Readings that lost their sign.
fn on_the_other_side(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (rms_um, chance) = lost_signs(problem, fit)?;
    let shape = "samples on the other side of zero";
    Some(Structure::without_place("position", shape, rms_um, of_all(problem, chance)))
}

/// Creep one way and jumps back, as stick and slip leave them.
fn one_way_jumps(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let (jump_um, chance) = one_way(problem, fit)?;
    // Root mean square of a saw tooth of that height.
    let rms_um = jump_um / f64::sqrt(12.0);
    let p_value = of_all(problem, chance);
    Some(Structure::without_place("time", "creeps one way and jumps back", rms_um, p_value))
}

/// Anything in a short stretch.
fn local_shapes(problem: &Problem, fit: &Fit) -> Vec<Structure> {
    let told = |along: &str, shape: &str, found: Option<Local>| {
        let Local { rms_um, p_value, at } = found?;
        let p_value = of_all(problem, p_value);
        Some(Structure { at: Some(at), ..Structure::without_place(along, shape, rms_um, p_value) })
    };
    let white = Whitener::new(&problem.layout, &fit.noises).whiten(fit.left.clone());
    let everywhere =
        told("position", "shape at one place", local::along_travel(problem, fit, &white));
    let once = || told("time", "shape in one pass", local::in_one_pass(problem, fit, &white));
    let several = 1 < problem.record.passes().len();
    everywhere.into_iter().chain(several.then(once).flatten()).collect()
}

/// A shape that comes back with every turn of a shaft.
fn cyclic_shapes(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let turns: Vec<f64> = problem.record.turns().collect();
    let of = |shaft: Shaft| {
        let raw = stacked(problem, &turning(&turns, shaft.order));
        let (rms_um, p_value) = probe(problem, model, fit, &raw);
        Structure::without_place(&shaft.name, "shape that repeats each turn", rms_um, p_value)
            .drawn_by(raw)
    };
    problem.shafts(TURNS).into_iter().map(of).collect()
}

/// What comes back with every day, in a record of more than one: of all waves the one that is known beforehand.
fn daily(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    let days: Vec<f64> = problem.record.time_s.iter().map(|time| time / A_DAY_S).collect();
    if !problem.measurement.timed || spread(&days) < SLOWEST_WAVES {
        return None;
    }
    let raw = stacked(problem, &turning(&days, 1.0));
    let (rms_um, p_value) = probe(problem, model, fit, &raw);
    Some(
        Structure::without_place("time", "shape that repeats each day", rms_um, p_value)
            .drawn_by(raw),
    )
}

/// Sines and cosines of the first harmonics.
fn turning(turns: &[f64], order: f64) -> Vec<Vec<f64>> {
    (1..=HARMONICS)
        .flat_map(|harmonic| {
            let angle = |turn: &f64| std::f64::consts::TAU * order * f64::from(harmonic) * turn;
            let sine = turns.iter().map(|turn| libm::sin(angle(turn))).collect();
            let cosine = turns.iter().map(|turn| libm::cos(angle(turn))).collect();
            [sine, cosine]
        })
        .collect()
}

/// Sensor by sensor its own columns: a probe assumes nothing of entries.
fn stacked(problem: &Problem, samples: &[Vec<f64>]) -> Vec<Column> {
    let sensors = 0..problem.sensors.len();
    let column = |values: &Vec<f64>, sensor| problem.alone(sensor, |sample| values[sample]).into();
    sensors.flat_map(|sensor| samples.iter().map(move |values| column(values, sensor))).collect()
}

/// Chebyshev polynomials 1 … order over the range of a coordinate.
pub(super) fn chebyshev(values: &[f64], order: usize) -> Vec<Vec<f64>> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let range = spread(values);
    let scaled: Vec<f64> = values.iter().map(|v| 2.0 * (v - low) / range - 1.0).collect();
    let mut all = vec![vec![1.0; values.len()], scaled.clone()];
    for degree in 2..=order {
        let next = (0..values.len())
            .map(|i| 2.0 * scaled[i] * all[degree - 1][i] - all[degree - 2][i])
            .collect();
        all.push(next);
    }
    all.remove(0);
    all
}

/// The best step over the travel, at the same place in every pass, and over time.
fn step(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let axes = [("position", &problem.record.position_mm), ("time", &problem.record.time_s)];
    let mut found = Vec::new();
    for (along, values) in axes {
        let places = quantiles(values, 200);
        let stage = Stage::new(problem, model, &fit.noises);
        let columns = |place: &f64| Columns::free(stacked(problem, &[above(values, *place)]));
        let gains = |some: &[f64]| {
            let columns: Vec<Columns> = some.iter().map(columns).collect();
            stage.gains(&columns.iter().collect::<Vec<_>>())
        };
        let gains = places.chunks(16).flat_map(gains).map(|gain| gain.gain);
        let best = places.iter().zip(gains).max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((&place, _)) = best else { continue };
        let raw = stacked(problem, &[above(values, place)]);
        let (explained_um, p_value) = probe(problem, model, fit, &raw);
        let mut p_value = (p_value * count(places.len())).min(1.0);
        let mut rms_um = explained_um;
        if p_value < SIGNIFICANCE {
            rms_um = rms_um.max(height_um(problem, model, fit, &raw));
        }
        if matters(problem, fit, rms_um, p_value) {
            let with_tails = step_with_tails(problem, model, fit, raw.clone(), places.len());
            p_value = p_value.max(with_tails);
        }
        let told = Structure::without_place(along, "step", rms_um, p_value).drawn_by(raw);
        found.push(Structure { at: Some(place), ..told });
    }
    found
}

/// Root mean square of what columns show, µm: slow noise that follows a step without it leaves no more
/// with it, though the step is there.
fn height_um(problem: &Problem, model: &Columns, fit: &Fit, raw: &[Column]) -> f64 {
    let columns = Columns::free(raw.to_vec());
    let wider = settle(problem, &model.and(&columns), &fit.noises);
    let own = &wider.linear.coefficients[model.raw.len()..];
    rms(&problem.layout, &columns.left(&vec![0.0; problem.samples.len()], own))
}

/// Chance of a step when the noise may have tails.
fn step_with_tails(
    problem: &Problem,
    model: &Columns,
    fit: &Fit,
    raw: Vec<Column>,
    places: usize,
) -> f64 {
    let (width, looks) = (count(raw.len()), probes(problem) * count(places));
    let wider = settle(problem, &model.and(&Columns::free(raw)), &fit.noises);
    let of_gain = |gain| looks * chi_squared_tail(gain, width);
    chance_with_tails(problem, [fit, &wider], of_gain).min(1.0)
}

fn above(values: &[f64], place: f64) -> Vec<f64> {
    values.iter().map(|value| f64::from(u8::from(place < *value))).collect()
}

fn quantiles(values: &[f64], points: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let points = points.min(sorted.len().saturating_sub(1));
    (1..points)
        .map(|i| {
            let place = i * (sorted.len() - 1) / points;
            0.5 * (sorted[place] + sorted[place + 1])
        })
        .collect()
}

/// A straight relation to every logged covariate, to direction and to speed.
fn covariates(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let logged = problem.measurement.causes();
    let mut columns: Vec<(&str, &Column)> =
        logged.map(|(name, values)| (name.as_str(), values)).collect();
    columns.push(("direction", &problem.record.direction));
    columns.push(("speed_rpm", &problem.record.speed_rpm));
    columns.extend(problem.velocity_rpm().map(|values| ("velocity_rpm", values)));
    columns
        .into_iter()
        .filter(|(_, values)| 0.0 < spread(values))
        .map(|(name, values)| {
            let raw = stacked(problem, std::slice::from_ref(values));
            let (rms_um, p_value) = probe(problem, model, fit, &raw);
            Structure::without_place(name, "straight relation", rms_um, p_value).drawn_by(raw)
        })
        .collect()
}

/// Any curve of what a column shows, but for what was told of the motor.
fn curves_of_logs(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    if problem.samples.len() < ROWS_A_COLUMN * CURVE_OF_A_LOG {
        return Vec::new();
    }
    let logs = problem.measurement.causes();
    logs.filter(|(name, values)| *name != "steps" && 0.0 < spread(values))
        .map(|(name, values)| {
            let raw = stacked(problem, &chebyshev(values, CURVE_OF_A_LOG));
            let (rms_um, p_value) = probe(problem, model, fit, &raw);
            Structure::without_place(name, "curve over the column", rms_um, p_value).drawn_by(raw)
        })
        .collect()
}
