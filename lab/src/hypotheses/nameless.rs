//! Shapes without a name: what no effect of the catalogue makes, and machines show all the same.
//!
//! Each stands along a coordinate or a logged column, has at most two nonlinear numbers that are
//! looked for on a grid, and one or two sizes. They are tried like the effects, by the same judge.

use std::f64::consts::TAU;

use helixlock_plant::Entry;
use rayon::prelude::*;

use crate::model::{Columns, Gain, Problem, Stage};
use crate::numerics::{Looks, count, spread};
use crate::policy::evidence::NO_SINE_PRICE;
use crate::policy::extent::TURNS;

/// A shape, where it stands and where its numbers are looked for.
pub(crate) struct Nameless {
    /// What it is called in words.
    pub(crate) shape: &'static str,
    /// What it stands along.
    pub(crate) along: String,
    /// Values of its nonlinear numbers worth trying.
    axes: Vec<Vec<f64>>,
    /// True when it comes back with every turn of a shaft.
    turns: bool,
    /// Lowest value and spread of the coordinate, when its first number is a place on it.
    place: Option<[f64; 2]>,
    coordinate: Vec<f64>,
    /// Travel from 0 to 1, or the direction, and time in s.
    travel: Vec<f64>,
    time_s: Vec<f64>,
    formula: Formula,
}

/// Unit curves of every sample for some nonlinear numbers.
type Formula = fn(&Nameless, &[f64]) -> Vec<Vec<f64>>;

/// A shape at its best numbers.
pub(crate) struct Placed<'a> {
    /// Which.
    pub(crate) shape: &'a Nameless,
    /// Its columns there.
    pub(crate) columns: Columns,
    /// Their coefficients.
    pub(crate) coefficients: Vec<f64>,
    /// Whitened square that it takes away.
    pub(crate) gain: f64,
    /// Its nonlinear numbers.
    values: Vec<f64>,
    /// Where it enters.
    entry: Entry,
    /// Its place, mm or s, when it has one.
    pub(crate) at: Option<f64>,
}

/// Width of a knock, against the distance of two.
const KNOCK: f64 = 0.07;

/// Columns whose gains are worked out together.
const TOGETHER: usize = 16;

/// Finer grids around the best numbers, each by [`FINER`] finer.
const ROUNDS: i32 = 4;
const FINER: f64 = 2.5;

impl Nameless {
    /// Places of its grid.
    pub(crate) fn places(&self) -> usize {
        self.axes.iter().map(Vec::len).product()
    }

    /// The best of it on what a stage's model leaves; `None` when it takes nothing away.
    pub(crate) fn best(&self, stage: &Stage<'_>, entry: Entry) -> Option<Placed<'_>> {
        let mut placed = self.best_of(stage, entry, &product(&self.axes))?;
        let steps: Vec<f64> = self.axes.iter().map(|axis| axis[1] - axis[0]).collect();
        for round in 0..ROUNDS * i32::from(!steps.is_empty()) {
            let share = FINER.powi(-round);
            let steps: Vec<f64> = steps.iter().map(|step| share * step).collect();
            let near = self.best_of(stage, entry, &around(&placed.values, &steps));
            if let Some(near) = near.filter(|near| placed.gain < near.gain) {
                placed = near;
            }
        }
        (0.0 < placed.gain).then_some(placed)
    }

    fn best_of(&self, stage: &Stage<'_>, entry: Entry, grid: &[Vec<f64>]) -> Option<Placed<'_>> {
        let of = move |some: &'_ [Vec<f64>]| -> Option<((Vec<f64>, Columns), Gain)> {
            let columns: Vec<Columns> =
                some.iter().map(|values| self.columns(stage.problem, entry, values)).collect();
            let gains = stage.gains(&columns.iter().collect::<Vec<_>>());
            let best = some.iter().cloned().zip(columns).zip(gains);
            best.max_by(|a, b| a.1.gain.total_cmp(&b.1.gain))
        };
        let best = grid.par_chunks(TOGETHER).filter_map(of).collect::<Vec<_>>().into_iter();
        let ((values, columns), gain) = best.max_by(|a, b| a.1.gain.total_cmp(&b.1.gain))?;
        let at = self.place.map(|[low, range]| low + range * values[0]);
        let coefficients = gain.fit.coefficients;
        Some(Placed { shape: self, columns, coefficients, gain: gain.gain, values, entry, at })
    }

    fn columns(&self, problem: &Problem, entry: Entry, values: &[f64]) -> Columns {
        let curves = (self.formula)(self, values);
        Columns::free(curves.iter().map(|deltas| problem.column(entry, deltas)).collect())
    }

    fn over(&self, of: impl Fn(f64) -> f64) -> Vec<f64> {
        self.coordinate.iter().map(|&value| of(value)).collect()
    }

    /// The coordinate as something of first order follows it, from rest.
    fn followed(&self, constant_s: f64) -> Vec<f64> {
        let mut value = self.coordinate.first().copied().unwrap_or_default();
        let mut before_s = self.time_s.first().copied().unwrap_or_default();
        let with_time = self.coordinate.iter().zip(&self.time_s);
        with_time
            .map(|(&led, &now_s)| {
                value += (led - value) * -libm::expm1(-(now_s - before_s).max(0.0) / constant_s);
                before_s = now_s;
                value
            })
            .collect()
    }

    /// 1 from where the coordinate has passed the upper threshold to where it passes the lower.
    fn switched(&self, low: f64, high: f64) -> Vec<f64> {
        let first = self.coordinate.first().copied().unwrap_or_default();
        let mut on = 0.5 * (low + high) < first;
        let switch = |value: &f64| {
            on = high < *value || (on && low <= *value);
            f64::from(u8::from(on))
        };
        self.coordinate.iter().map(switch).collect()
    }

    /// The travel, or direction, and a curve times that.
    fn by_travel(&self, curve: &[f64]) -> Vec<Vec<f64>> {
        let product = self.travel.iter().zip(curve).map(|(x, value)| x * value).collect();
        vec![self.travel.clone(), product]
    }
}

impl Placed<'_> {
    /// Where it was looked for: what its curve turns by along each of its numbers through the best.
    pub(crate) fn looks(&self, stage: &Stage<'_>) -> Looks {
        let axes = self.shape.axes.iter().enumerate();
        axes.fold(Looks::at_places(1.0), |looks, (place, axis)| {
            looks.over(axis, |value| {
                let mut values = self.values.clone();
                values[place] = value;
                stage.span(&self.shape.columns(stage.problem, self.entry, &values))
            })
        })
    }

    /// What it costs as evidence beside its looks when a size costs so much.
    pub(crate) fn price(&self, of_a_size: f64) -> f64 {
        let rare = if self.shape.turns { NO_SINE_PRICE } else { 0.0 };
        rare + count(self.columns.raw.len()) * of_a_size
    }
}

/// Points around some values, two on either side in each direction.
fn around(values: &[f64], steps: &[f64]) -> Vec<Vec<f64>> {
    let axes: Vec<Vec<f64>> = values
        .iter()
        .zip(steps)
        .map(|(value, step)| [-0.8, -0.4, 0.0, 0.4, 0.8].map(|by| value + by * step).to_vec())
        .collect();
    product(&axes)
}

fn product(axes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    axes.iter().fold(vec![Vec::new()], |points, axis| {
        let with = |point: &Vec<f64>| {
            let longer = |value: &f64| [point.as_slice(), &[*value]].concat();
            axis.iter().map(longer).collect::<Vec<_>>()
        };
        points.iter().flat_map(with).collect()
    })
}

/// So many values between two ends, evenly.
fn evenly(low: f64, high: f64, points: usize) -> Vec<f64> {
    (0..points).map(|i| low + (high - low) * (count(i) + 0.5) / count(points)).collect()
}

/// Every shape that the samples of a problem may show.
#[must_use]
pub(crate) fn nameless(problem: &Problem) -> Vec<Nameless> {
    let record = &problem.record;
    let along = |along: &str, coordinate: &[f64]| Nameless {
        shape: "",
        along: along.to_owned(),
        axes: Vec::new(),
        turns: false,
        place: None,
        coordinate: coordinate.to_vec(),
        travel: from_zero_to_one(&record.position_mm),
        time_s: record.time_s.clone(),
        formula: |_, _| Vec::new(),
    };
    let mut all = Vec::new();
    if 0.0 < spread(&record.position_mm) {
        all.extend(along_travel(
            &along("position", &from_zero_to_one(&record.position_mm)),
            problem,
        ));
    }
    if problem.measurement.timed && 0.0 < spread(&record.time_s) {
        all.extend(in_time(&along("time", &from_zero_to_one(&record.time_s)), problem));
    }
    all.extend(since_a_reversal(
        &along("way since the reversal", &record.since_reversal_mm),
        problem,
    ));
    for (name, turns) in shafts(problem) {
        all.extend(each_turn(&Nameless { turns: true, ..along(name, &turns) }));
    }
    for (name, values) in &problem.measurement.covariates {
        if 0.0 < spread(values) {
            all.extend(of_a_column(&along(name, &about_mean(values))));
        }
    }
    all
}

/// The same with a formula and a grid.
fn with(of: &Nameless, shape: &'static str, axes: &[Vec<f64>], formula: Formula) -> Nameless {
    Nameless {
        shape,
        along: of.along.clone(),
        axes: axes.to_vec(),
        turns: of.turns,
        place: of.place,
        coordinate: of.coordinate.clone(),
        travel: of.travel.clone(),
        time_s: of.time_s.clone(),
        formula,
    }
}

fn from_zero_to_one(values: &[f64]) -> Vec<f64> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let range = spread(values).max(f64::MIN_POSITIVE);
    values.iter().map(|value| (value - low) / range).collect()
}

fn about_mean(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / count(values.len().max(1));
    values.iter().map(|value| value - mean).collect()
}

/// The coordinate's lowest value and range.
fn placed(mut of: Nameless, values: &[f64]) -> Nameless {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    of.place = Some([low, spread(values)]);
    of
}

fn beyond(place: f64) -> impl Fn(f64) -> f64 {
    move |u| (u - place).max(0.0)
}

fn step(place: f64) -> impl Fn(f64) -> f64 {
    move |u| f64::from(u8::from(place < u))
}

fn triangle(waves: f64) -> f64 {
    (waves - waves.floor() - 0.5).abs()
}

fn along_travel(of: &Nameless, problem: &Problem) -> Vec<Nameless> {
    let places = evenly(0.0, 1.0, 100);
    let at = |shape, formula| {
        placed(with(of, shape, std::slice::from_ref(&places), formula), &problem.record.position_mm)
    };
    let waves = [evenly(0.8, 4.0, 16), evenly(0.0, 1.0, 12)];
    vec![
        at("kink at one place", |this, v| vec![this.travel.clone(), this.over(beyond(v[0]))]),
        at("bend from one place on", |this, v| {
            vec![this.travel.clone(), this.over(|u| beyond(v[0])(u) * beyond(v[0])(u))]
        }),
        at("step at one place", |this, v| vec![this.travel.clone(), this.over(step(v[0]))]),
        at("root from one place on", |this, v| vec![this.over(|u| beyond(v[0])(u).sqrt())]),
        with(of, "sawtooth", &[evenly(4.0, 32.0, 94), evenly(0.0, 1.0, 5)], |this, v| {
            vec![this.over(|u| (v[0] * u + v[1]).rem_euclid(1.0))]
        }),
        with(
            of,
            "knocks at even distances",
            &[evenly(4.0, 32.0, 140), evenly(0.0, 1.0, 8)],
            |this, v| {
                vec![this.over(|u| {
                    let off = ((v[0] * u + v[1]).rem_euclid(1.0) - 0.5) / KNOCK;
                    libm::exp(-0.5 * off * off)
                })]
            },
        ),
        with(of, "triangles", &waves, |this, v| vec![this.over(|u| triangle(v[0] * u + v[1]))]),
        with(of, "half waves", &waves, |this, v| {
            vec![this.over(|u| libm::sin(TAU * (v[0] * u + v[1])).max(0.0))]
        }),
    ]
}

fn in_time(of: &Nameless, problem: &Problem) -> Vec<Nameless> {
    let moments = evenly(0.0, 1.0, 200);
    let peaks = evenly(0.03, 0.75, 24);
    vec![
        placed(
            with(of, "step at one moment", &[moments], |this, v| vec![this.over(step(v[0]))]),
            &problem.record.time_s,
        ),
        with(of, "parabola", &[], |this, _| vec![this.over(|u| u), this.over(|u| u * u)]),
        with(of, "rise and fall", &[peaks], |this, v| {
            vec![this.over(|u| u / v[0] * libm::exp(1.0 - u / v[0]))]
        }),
    ]
}

/// Play that is not taken up at once, where passes turn back inside.
fn since_a_reversal(of: &Nameless, problem: &Problem) -> Option<Nameless> {
    let ways = of.coordinate.iter().copied().filter(|way| way.is_finite());
    let longest = ways.fold(0.0, f64::max);
    // Natural logarithms of a way against the longest: from a two-hundredth to half of it.
    let over = [evenly(-5.3, -0.7, 12).iter().map(|l| l + libm::log(longest)).collect()];
    let way =
        Nameless { travel: problem.record.direction.clone(), ..with(of, "", &[], of.formula) };
    (0.0 < longest).then(|| {
        with(&way, "taken up after a turn", &over, |this, v| {
            this.by_travel(&this.over(|way| libm::exp(-way / libm::exp(v[0]))))
        })
    })
}

/// Turns of the spindle and of the machine's screw, where the samples resolve them.
fn shafts(problem: &Problem) -> Vec<(&'static str, Vec<f64>)> {
    let mut orders = vec![("spindle angle", 1.0)];
    if let Some(screw) = problem.model.lead_screw.as_ref().filter(|_| !problem.model.rotary) {
        orders.push(("machine screw angle", problem.model.workpiece.lead.mm() / screw.mm()));
    }
    orders.retain(|(_, order)| *order < problem.highest_order);
    let turns = |order: f64| problem.record.turns().map(|turn| order * turn).collect();
    let mut shafts: Vec<(&str, Vec<f64>)> =
        orders.into_iter().map(|(name, order)| (name, turns(order))).collect();
    shafts.retain(|(_, turns)| TURNS < spread(turns));
    shafts
}

fn each_turn(of: &Nameless) -> Vec<Nameless> {
    let phases = [evenly(0.0, 1.0, 24)];
    let half = [evenly(0.0, 0.5, 12)];
    vec![
        with(of, "square wave each turn", &half, |this, v| {
            vec![this.over(|u| f64::from(u8::from((u + v[0]).rem_euclid(1.0) < 0.5)))]
        }),
        with(of, "triangle each turn", &half, |this, v| vec![this.over(|u| triangle(u + v[0]))]),
        with(of, "half wave each turn", &phases, |this, v| {
            vec![this.over(|u| libm::sin(TAU * (u + v[0])).max(0.0))]
        }),
        with(of, "sawtooth each turn", &phases, |this, v| {
            vec![this.over(|u| (u + v[0]).rem_euclid(1.0))]
        }),
    ]
}

/// Straight, through the travel, late, late through the travel, and by a relay.
fn of_a_column(of: &Nameless) -> Vec<Nameless> {
    let mut sorted = of.coordinate.clone();
    sorted.sort_by(f64::total_cmp);
    let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
    let thresholds =
        [evenly(low, high, 10), evenly(0.0, 0.6, 6).iter().map(|s| s * (high - low)).collect()];
    let record_s = spread(&of.time_s).max(f64::MIN_POSITIVE);
    // Natural logarithms of a time constant against the record: from a hundredth to half of it.
    let constants: Vec<f64> =
        evenly(-4.6, -0.7, 12).iter().map(|l| l + libm::log(record_s)).collect();
    let constants = [constants];
    vec![
        with(of, "straight relation", &[], |this, _| vec![this.coordinate.clone()]),
        with(of, "straight relation times the travel", &[], |this, _| {
            this.by_travel(&this.coordinate)
        }),
        with(of, "late relation", &constants, |this, v| vec![this.followed(libm::exp(v[0]))]),
        with(of, "late relation times the travel", &constants, |this, v| {
            this.by_travel(&this.followed(libm::exp(v[0])))
        }),
        with(of, "relay", &thresholds, |this, v| {
            vec![this.switched(v[0] - 0.5 * v[1], v[0] + 0.5 * v[1])]
        }),
    ]
}
