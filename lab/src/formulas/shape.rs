//! One shape of the grammar: its formula, where its unknowns are looked for, and its best place.

use std::borrow::Cow;
use std::ops::Range;

use helixlock_plant::{Column, EffectError, Entry, Parameter, Term};

use super::dimension::Dimension;
use super::expression::{Expression, Function, Unknown, call};
use crate::model::{Columns, Problem, Stage};
use crate::numerics::{Looks, count, in_parallel, product};
use crate::policy::evidence::NO_SINE_PRICE;
use crate::spectrum::{Scan, arc, strongest_first};

/// A shape, where it stands and where its unknowns are looked for.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    /// What it is called in words.
    pub(crate) words: &'static str,
    /// What it stands along.
    pub(crate) along: String,
    /// What kind of physics has this shape.
    pub(crate) physics: &'static str,
    /// What it adds up from, a size each.
    pub(crate) parts: Vec<Part>,
    /// How many of the last parts make it: without all of them it is no such shape.
    pub(crate) makes: usize,
    /// Its nonlinear numbers.
    pub(crate) unknowns: Vec<Unknown>,
    /// True when it comes back with every turn of a shaft, and is no sine.
    pub(crate) turns: bool,
    /// True when its first unknown is a place on the coordinate.
    pub(crate) placed: bool,
    /// How many there are like it, of which it is one.
    pub(crate) listed: f64,
    /// When its first unknown is a frequency: of what, one value a sample, and up to where.
    pub(crate) scan: Option<Band>,
}

/// Frequencies to look at.
#[derive(Debug, Clone)]
pub(crate) struct Band {
    /// Cyclic coordinate, one value a sample.
    pub(crate) over: Column,
    /// Lowest and highest frequency.
    pub(crate) ends: [f64; 2],
}

/// A part of a formula that one size belongs to.
#[derive(Debug, Clone)]
pub(crate) enum Part {
    /// size · curve.
    Curve { size: &'static str, curve: Expression },
    /// size · swell · sin(angle + phase), as a sine and a cosine in a fit.
    Wave { size: &'static str, phase: &'static str, swell: Option<Expression>, angle: Expression },
}

/// What the error is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Delta {
    Micrometres,
    Arcseconds,
}

impl Delta {
    /// That of a problem's machine.
    pub(crate) fn of(problem: &Problem) -> Self {
        if problem.model.rotary { Self::Arcseconds } else { Self::Micrometres }
    }

    fn symbol(self) -> &'static str {
        if self == Self::Arcseconds { "arcsec" } else { "µm" }
    }
}

/// A shape at its best numbers.
#[derive(Debug, Clone)]
pub(crate) struct Placed<'a> {
    /// Which.
    pub(crate) shape: &'a Shape,
    /// The best of its unknowns.
    pub(crate) values: Vec<f64>,
    /// Where it enters.
    pub(crate) entry: Entry,
    /// Its columns there.
    pub(crate) columns: Columns,
    /// Their coefficients.
    pub(crate) coefficients: Vec<f64>,
    /// Whitened square that it takes away.
    pub(crate) gain: f64,
    /// Its place, mm or s, when it has one.
    pub(crate) at: Option<f64>,
}

/// What the number of waves a turn is called.
pub(crate) const ORDER: &str = "order";

/// Columns whose gains are worked out together.
const TOGETHER: usize = 16;

/// Finer grids around the best numbers, each by [`FINER`] finer.
const ROUNDS: i32 = 5;
const FINER: f64 = 2.5;

/// Lines of a scan that are tried.
const LINES: usize = 6;

/// First step of an unknown that is looked for from one value, against that value.
const SHARE: f64 = 0.4;

impl Part {
    /// Its numbers: a size, and a phase.
    fn width(&self) -> usize {
        if matches!(self, Self::Wave { .. }) { 2 } else { 1 }
    }

    /// What each of its numbers is multiplied by, the sine before the cosine.
    fn curves(&self) -> Vec<Expression> {
        match self {
            Self::Curve { curve, .. } => vec![curve.clone()],
            Self::Wave { swell, angle, .. } => {
                let wave = |of| {
                    let wave = call(of, angle.clone());
                    match swell {
                        Some(swell) => wave * swell.clone(),
                        None => wave,
                    }
                };
                vec![wave(Function::Sin), wave(Function::Cos)]
            }
        }
    }

    fn text(&self, names: &[&str]) -> String {
        match self {
            Self::Curve { size, curve } if curve.is_a_sum() => {
                format!("{size}*({})", curve.text(names))
            }
            Self::Curve { size, curve } => format!("{size}*{}", curve.text(names)),
            Self::Wave { size, phase, swell, angle } => {
                let factor = |swell: &Expression| {
                    let text = swell.text(names);
                    if swell.is_a_sum() { format!("*({text})") } else { format!("*{text}") }
                };
                let swell = swell.as_ref().map_or(String::new(), factor);
                format!("{size}{swell}*sin({} + {phase})", angle.text(names))
            }
        }
    }

    /// Unit of what its size is multiplied by; `None` for a formula of unlike units.
    fn dimension(&self, unknowns: &[Unknown]) -> Option<Dimension> {
        match self {
            Self::Curve { curve, .. } => curve.dimension(unknowns),
            Self::Wave { swell, angle, .. } => {
                call(Function::Sin, angle.clone()).dimension(unknowns)?;
                swell.as_ref().map_or(Some(Dimension::number()), |one| one.dimension(unknowns))
            }
        }
    }
}

impl Shape {
    /// Places of its grid.
    pub(crate) fn places(&self) -> f64 {
        let lines = self.scan.as_ref().map_or(1.0, Band::lines);
        let axes = self.unknowns.iter().skip(usize::from(self.scan.is_some()));
        lines * axes.map(|unknown| count(unknown.axis.len())).product::<f64>()
    }

    /// All its numbers.
    pub(crate) fn numbers(&self) -> usize {
        self.sizes() + self.unknowns.len()
    }

    /// Its sizes, a phase among them.
    pub(crate) fn sizes(&self) -> usize {
        self.parts.iter().map(Part::width).sum()
    }

    /// Its sizes apart from those of what makes it.
    pub(crate) fn sizes_beside(&self) -> usize {
        let others = self.parts.len().saturating_sub(self.makes);
        self.parts.iter().take(others).map(Part::width).sum()
    }

    /// Its numbers where only what makes it is left.
    pub(crate) fn fewest_numbers(&self) -> usize {
        self.parts.last().map_or(0, Part::width) + self.unknowns.len()
    }

    /// It without one of its parts; `None` where nothing is left that makes it.
    pub(crate) fn without(&self, part: usize) -> Option<Self> {
        let mut fewer = self.clone();
        if self.parts.len() <= part + self.makes {
            fewer.makes -= 1;
        }
        fewer.parts.remove(part);
        (0 < fewer.makes).then_some(fewer)
    }

    /// Where in a list of its numbers those of a part stand, its size first.
    pub(crate) fn numbers_of(&self, part: usize) -> Range<usize> {
        let first = self.parts[..part].iter().map(Part::width).sum();
        first..first + self.parts[part].width()
    }

    /// What it costs as evidence beside its looks when a size costs so much.
    pub(crate) fn price(&self, of_a_size: f64) -> f64 {
        let rare = if self.turns { NO_SINE_PRICE } else { 0.0 };
        rare + count(self.sizes()) * of_a_size
    }

    /// The best of it on what each of some stages leaves; `None` where it takes nothing away.
    pub(crate) fn best(&self, stages: &[&Stage<'_>], entry: Entry) -> Vec<Option<Placed<'_>>> {
        let curves = self.curves();
        let coarse: Vec<Option<Placed<'_>>> = match &self.scan {
            None => self.best_of(stages, entry, &curves, &product(&self.axes())),
            Some(band) => {
                // Each stage leaves lines of its own.
                let of = |stage: &&Stage<'_>| {
                    let mut axes = self.axes();
                    axes[0] = band.strongest(stage, entry);
                    self.best_of(&[stage], entry, &curves, &product(&axes)).pop().flatten()
                };
                in_parallel(stages, of)
            }
        };
        let refined =
            |(placed, stage): (Option<_>, &&Stage<'_>)| self.refined(stage, &curves, placed?);
        in_parallel(coarse.into_iter().zip(stages), refined)
    }

    /// Values of each unknown that are tried.
    fn axes(&self) -> Vec<Vec<f64>> {
        self.unknowns.iter().map(|one| one.axis.clone()).collect()
    }

    /// It at better numbers near those of a grid; `None` when it takes nothing away.
    fn refined<'a>(
        &'a self,
        stage: &Stage<'_>,
        curves: &[Expression],
        coarse: Placed<'a>,
    ) -> Option<Placed<'a>> {
        let mut placed = coarse;
        let steps = self.steps(&placed.values);
        for round in 0..ROUNDS * i32::from(!steps.is_empty()) {
            let share = FINER.powi(-round);
            let steps: Vec<f64> = steps.iter().map(|step| share * step).collect();
            let near = around(&placed.values, &steps);
            let near = self.best_of(&[stage], placed.entry, curves, &near);
            let better = near.into_iter().flatten().find(|near| placed.gain < near.gain);
            placed = better.unwrap_or(placed);
        }
        (0.0 < placed.gain).then_some(placed)
    }

    /// Distance of grid values near some values, unknown by unknown.
    fn steps(&self, values: &[f64]) -> Vec<f64> {
        let of = |(place, unknown): (usize, &Unknown)| match &self.scan {
            Some(band) if place == 0 => 0.3 * band.resolution(),
            _ => spacing(&unknown.axis, values[place]),
        };
        self.unknowns.iter().enumerate().map(of).collect()
    }

    /// The best place of a grid on each of some stages, which share its columns.
    fn best_of(
        &self,
        stages: &[&Stage<'_>],
        entry: Entry,
        curves: &[Expression],
        grid: &[Vec<f64>],
    ) -> Vec<Option<Placed<'_>>> {
        let Some(problem) = stages.first().map(|stage| stage.problem) else { return Vec::new() };
        let of = |some: &[Vec<f64>]| -> Vec<Option<Placed<'_>>> {
            let columns: Vec<Columns> =
                some.iter().map(|values| columns(curves, problem, entry, values)).collect();
            stages.iter().map(|stage| self.best_at(stage, entry, some, &columns)).collect()
        };
        let parts: Vec<Vec<Option<Placed<'_>>>> = in_parallel(grid.chunks(TOGETHER), of);
        let of_stage = |nth: usize| {
            let found = parts.iter().filter_map(|part| part[nth].as_ref());
            found.max_by(|a, b| a.gain.total_cmp(&b.gain)).cloned()
        };
        (0..stages.len()).map(of_stage).collect()
    }

    /// The best of some places, whose columns are known, on a stage.
    fn best_at(
        &self,
        stage: &Stage<'_>,
        entry: Entry,
        places: &[Vec<f64>],
        columns: &[Columns],
    ) -> Option<Placed<'_>> {
        let gains = stage.gains(&columns.iter().collect::<Vec<_>>());
        let all = places.iter().zip(columns).zip(gains);
        let ((values, columns), gain) = all.max_by(|a, b| a.1.gain.total_cmp(&b.1.gain))?;
        let (values, columns) = (values.clone(), columns.clone());
        let at = self.placed.then(|| values[0]);
        let coefficients = gain.fit.coefficients;
        Some(Placed { shape: self, values, entry, columns, coefficients, gain: gain.gain, at })
    }

    /// Curves of all its parts, with all that no unknown changes worked out.
    fn curves(&self) -> Vec<Expression> {
        self.parts.iter().flat_map(Part::curves).map(|curve| curve.worked_out()).collect()
    }

    /// The formula, and the unit of each of its parameters; `None` when it mixes units.
    pub(crate) fn written(&self, delta: Delta) -> Option<(String, Vec<(&'static str, Dimension)>)> {
        let delta = Dimension::unit(delta.symbol());
        let names: Vec<&str> = self.unknowns.iter().map(|unknown| unknown.name).collect();
        let text: Vec<String> = self.parts.iter().map(|part| part.text(&names)).collect();
        let mut parameters = Vec::new();
        for part in &self.parts {
            let unit = delta.over(&part.dimension(&self.unknowns)?);
            match part {
                Part::Curve { size, .. } => parameters.push((*size, unit)),
                Part::Wave { size, phase, .. } => {
                    parameters.extend([(*size, unit), (*phase, Dimension::number())]);
                }
            }
        }
        parameters.extend(self.unknowns.iter().map(|one| (one.name, one.dimension.clone())));
        Some((text.join(" + "), parameters))
    }

    /// The units of its parameters in words.
    pub(crate) fn units(&self, delta: Delta) -> Vec<String> {
        let written = self.written(delta).map_or_else(Vec::new, |(_, parameters)| parameters);
        written.into_iter().map(|(_, unit)| unit.to_string()).collect()
    }
}

impl Placed<'_> {
    /// What it costs as evidence where a size costs so much and a gain was looked for.
    pub(crate) fn price(&self, of_a_size: f64, looks: &Looks, gain: f64) -> f64 {
        self.shape.price(of_a_size) + 2.0 * libm::log(looks.for_gain(gain))
    }

    /// Where it was looked for: among those like it, and what its curve turns by along each of its unknowns through the
    /// best.
    pub(crate) fn looks(&self, stage: &Stage<'_>) -> Looks {
        let curves = self.shape.curves();
        let unknowns = self.shape.unknowns.iter().enumerate();
        unknowns.fold(Looks::at_places(self.shape.listed), |looks, (place, unknown)| {
            match &self.shape.scan {
                Some(band) if place == 0 => looks.along(band.arc(stage)),
                _ => looks.over(&reach(&unknown.axis), |value| {
                    let mut values = self.values.clone();
                    values[place] = value;
                    stage.span(&columns(&curves, stage.problem, self.entry, &values))
                }),
            }
        })
    }

    /// Its order of the spindle, for a wave of any.
    pub(crate) fn order(&self) -> Option<f64> {
        let is_order = |unknown: &Unknown| unknown.name == ORDER;
        let place = self.shape.unknowns.iter().position(is_order)?;
        Some(self.values[place])
    }

    /// It as an effect of the user, with its values.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when the formula cannot be read, which a test excludes.
    pub(crate) fn term(&self, name: &str) -> Result<Term, EffectError> {
        let mut values = Vec::new();
        let mut rest = self.coefficients.iter().copied();
        for part in &self.shape.parts {
            let first = rest.next().unwrap_or_default();
            if matches!(part, Part::Wave { .. }) {
                let second = rest.next().unwrap_or_default();
                values.extend([libm::hypot(first, second), libm::atan2(second, first)]);
            } else {
                values.push(first);
            }
        }
        values.extend(&self.values);
        self.shape.term(name, self.entry, values)
    }
}

impl Shape {
    /// It as an effect of the user, with values of its sizes and then of its unknowns.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when the formula cannot be read, which a test excludes.
    pub(crate) fn term(
        &self,
        name: &str,
        entry: Entry,
        values: Vec<f64>,
    ) -> Result<Term, EffectError> {
        let Some((formula, units)) = self.written(Delta::Micrometres) else {
            return Term::custom(name, entry, "", Vec::new(), Vec::new());
        };
        let parameter = |((name, _), value): (&(&'static str, _), &f64)| {
            let parameter = Parameter::of_formula((*name).to_owned(), *value);
            let mut unknowns = self.unknowns.iter();
            match unknowns.find(|unknown| unknown.name == *name).and_then(Unknown::places) {
                Some(places) => parameter.within(places),
                None => parameter,
            }
        };
        let parameters = units.iter().zip(&values).map(parameter).collect();
        Term::custom(name, entry, &formula, parameters, values)
    }
}

impl Band {
    /// From so many waves over the coordinate up to a frequency; `None` when nothing is between.
    pub(crate) fn new(over: Column, ends: [f64; 2]) -> Option<Self> {
        (ends[0] < ends[1]).then_some(Self { over, ends })
    }

    fn resolution(&self) -> f64 {
        1.0 / crate::numerics::spread(&self.over).max(f64::MIN_POSITIVE)
    }

    /// Frequencies that a record tells apart.
    fn lines(&self) -> f64 {
        (2.0 * (self.ends[1] - self.ends[0]) / self.resolution()).max(1.0)
    }

    /// What a wave turns by over all frequencies, rad.
    fn arc(&self, stage: &Stage<'_>) -> f64 {
        arc(&self.of_rows(stage), self.ends)
    }

    fn of_rows(&self, stage: &Stage<'_>) -> Vec<f64> {
        stage.problem.samples.iter().map(|&sample| self.over[sample]).collect()
    }

    /// Frequencies of the strongest lines of an entry that a stage leaves, none next to a stronger one.
    fn strongest(&self, stage: &Stage<'_>, entry: Entry) -> Vec<f64> {
        let over = self.of_rows(stage);
        let unit = stage.problem.unit_column(entry);
        let scan = Scan {
            layout: &stage.problem.layout,
            noises: &stage.noises,
            turns: &over,
            unit: &unit,
            whitener: &stage.whitener,
            lowest: self.ends[0],
            highest: self.ends[1],
        };
        let mut lines: Vec<f64> = Vec::new();
        for point in strongest_first(scan.spectrum(&stage.target[..over.len()])) {
            let apart = |known: &f64| self.resolution() < (known - point.frequency).abs();
            if lines.iter().all(apart) {
                lines.push(point.frequency);
            }
            if lines.len() == LINES {
                break;
            }
        }
        lines
    }
}

/// Columns of curves for some unknowns.
fn columns(curves: &[Expression], problem: &Problem, entry: Entry, unknowns: &[f64]) -> Columns {
    let column = |curve: &Expression| match &*curve.values(unknowns) {
        &[same] => problem.column(entry, &vec![same; problem.record.len()]),
        deltas => problem.column(entry, deltas),
    };
    Columns::free(curves.iter().map(column))
}

/// Distance of the values of an axis around one of them.
fn spacing(axis: &[f64], value: f64) -> f64 {
    let near = axis.partition_point(|known| *known < value).clamp(1, axis.len().max(2) - 1);
    match axis.get(near - 1..=near) {
        Some(pair) => pair[1] - pair[0],
        None => SHARE * value.abs(),
    }
}

/// Values of an axis, or those around its only one that the search comes to.
fn reach(axis: &[f64]) -> Cow<'_, [f64]> {
    match axis {
        [value] => Cow::Owned(vec![(1.0 - SHARE) * value, *value, (1.0 + SHARE) * value]),
        _ => Cow::Borrowed(axis),
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
