//! Every formula that the samples of a problem may show.

use super::dimension::Dimension;
use super::expression::{Expression, Unknown};
use super::quantities::Quantities;
use super::shape::{Part, Shape};
use super::{logged, moving, turning};
use crate::model::{Problem, Shaft};
use crate::numerics::{evenly, spread};
use crate::policy::extent::{MOST_A_TURN, MOST_OF_A_TURN, TURNS};

/// The plain shapes: what stands in the place of effects whenever a model is judged.
#[must_use]
pub(crate) fn nameless(problem: &Problem) -> Vec<Shape> {
    let quantities = Quantities::of(problem);
    let mut all: Vec<Shape> = moving::another_ratio(&quantities).into_iter().collect();
    if quantities.have_places() {
        all.extend(moving::along_travel(&quantities));
        all.extend(moving::one_target(&quantities));
        all.extend(moving::edges(&quantities));
        all.extend(moving::again_and_again(&quantities));
        all.extend(moving::of_each_pass(&quantities));
    }
    if quantities.timed && 0.0 < spread(&quantities.time.values) {
        all.extend(moving::in_time(&quantities));
        all.extend(moving::warming(&quantities));
    }
    all.extend(moving::since_a_reversal(&quantities));
    all.extend(moving::since_a_stop(&quantities));
    all.extend(moving::late(&quantities));
    all.extend(each_turn(&quantities, problem, false));
    all.extend(each_way(&quantities, problem));
    for column in &quantities.columns {
        all.extend(logged::of_a_column(&quantities, column));
        all.extend(logged::beyond_a_line(&quantities, column));
    }
    all.extend(logged::products(&quantities));
    all.extend(turning::sized_by_a_column(&quantities, problem));
    all.extend(turning::swelling(&quantities, problem));
    all
}

/// The whole grammar: those, and what is looked for when nothing else explains the data.
#[must_use]
pub(crate) fn formulas(problem: &Problem) -> Vec<Shape> {
    let quantities = Quantities::of(problem);
    let mut all = nameless(problem);
    all.extend(each_turn(&quantities, problem, true));
    let shafts = problem.shafts(TURNS).into_iter().filter(|shaft| !shaft.of_a_gear);
    let times = |shaft: Shaft| {
        (1..=MOST_A_TURN).map(f64::from).map(move |times| (times * shaft.order, times))
    };
    let mut orders: Vec<(f64, f64)> = shafts.flat_map(times).collect();
    orders.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    orders.dedup_by(|a, b| a.0.total_cmp(&b.0).is_eq());
    all.extend(orders.iter().flat_map(|(order, _)| several_a_turn(problem, *order)));
    if 1 < problem.sensors.len() {
        // One sensor shows what goes in anywhere as it shows an effect of that order, which has a name.
        let sine = |&(order, times)| Shape { listed: times, ..turning::sine(&quantities, order) };
        all.extend(orders.iter().map(sine));
    }
    all.extend(turning::waves(&quantities, problem));
    all.extend(turning::switching(&quantities, problem));
    all.extend(turning::resonances(&quantities, problem));
    all.extend(moving::powers(&quantities));
    all.extend(moving::of_the_way(&quantities));
    all.extend(quantities.columns.iter().map(|one| logged::not_followed(&quantities, one)));
    all
}

/// What switches at even times, which waves in time follow.
#[must_use]
pub(crate) fn switching(problem: &Problem) -> Option<Shape> {
    turning::switching(&Quantities::of(problem), problem)
}

/// A sine of an order between two.
#[must_use]
pub(crate) fn sine_between(problem: &Problem, ends: [f64; 2]) -> Option<Shape> {
    turning::sine_between(&Quantities::of(problem), problem, ends)
}

/// What comes so often a turn of the spindle, several times with each of the spindle or of the screw: each one of those
/// that come as often or less.
#[must_use]
pub(crate) fn several_a_turn(problem: &Problem, order: f64) -> Vec<Shape> {
    let times = |shaft: &Shaft| (order / shaft.order).round();
    let is_so = |shaft: &Shaft| {
        let times = times(shaft);
        1.0 < times && (order - times * shaft.order).abs() < 1e-9 * order
    };
    let mut shafts = problem.shafts(TURNS).into_iter().filter(|shaft| !shaft.of_a_gear);
    let Some(shaft) = shafts.find(is_so) else { return Vec::new() };
    let all = turning::several_a_turn(&Quantities::of(problem), &shaft.name, order);
    all.into_iter().map(|one| Shape { listed: times(&shaft), ..one }).collect()
}

/// What comes with every turn of shafts, those of gears or the others: over as much of one as its waves have names.
fn each_turn(all: &Quantities, problem: &Problem, of_a_gear: bool) -> Vec<Shape> {
    let shafts =
        problem.shafts(MOST_OF_A_TURN).into_iter().filter(|shaft| shaft.of_a_gear == of_a_gear);
    let of = |Shaft { name, order, .. }: Shaft| turning::each_turn(all, &name, order);
    shafts.flat_map(of).collect()
}

/// What every shaft makes each way by itself. Sines in time follow a gear that bears on its other flank on the way
/// back, for between two reversals they differ little.
fn each_way(all: &Quantities, problem: &Problem) -> Vec<Shape> {
    let of = |Shaft { name, order, .. }: Shaft| turning::each_way(all, &name, order);
    problem.shafts(TURNS).into_iter().filter_map(of).collect()
}

/// A shape without unknowns, to be filled.
pub(super) fn shape(words: &'static str, along: &str, physics: &'static str) -> Shape {
    Shape {
        words,
        along: along.to_owned(),
        physics,
        parts: Vec::new(),
        makes: 1,
        unknowns: Vec::new(),
        turns: false,
        placed: false,
        listed: 1.0,
        scan: None,
    }
}

impl Shape {
    /// With one more curve and its size.
    pub(super) fn curve(mut self, size: &'static str, curve: Expression) -> Self {
        self.parts.push(Part::Curve { size, curve });
        self
    }

    /// With one more sine and its amplitude.
    pub(super) fn wave(
        mut self,
        size: &'static str,
        phase: &'static str,
        swell: Option<Expression>,
        angle: Expression,
    ) -> Self {
        self.parts.push(Part::Wave { size, phase, swell, angle });
        self
    }

    /// With one more unknown.
    pub(super) fn unknown(
        mut self,
        name: &'static str,
        dimension: &Dimension,
        axis: Vec<f64>,
    ) -> Self {
        self.unknowns.push(Unknown { name, dimension: dimension.clone(), axis });
        self
    }

    /// With so many of its last parts each making it.
    pub(super) fn made_by(mut self, parts: usize) -> Self {
        self.makes = parts;
        self
    }

    /// With its first unknown a place.
    pub(super) fn placed(mut self) -> Self {
        self.placed = true;
        self
    }
}

/// An unknown by its place in the list.
pub(super) fn unknown(place: usize) -> Expression {
    Expression::Unknown(place)
}

/// Periods that go so often into a range, evenly in how often, in ascending order.
pub(super) fn periods(range: f64, fewest: f64, most: f64, points: usize) -> Vec<f64> {
    evenly(fewest, most, points).into_iter().rev().map(|times| range / times).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use helixlock_plant::{Effect, Entry, Model};
    use helixlock_traces::{Column, Table};

    use super::super::shape::Delta;
    use super::*;
    use crate::measurement::{Measurement, Nominal};
    use crate::model::{Columns, Stage};
    use crate::noise::Noise;

    const MACHINE: &str = r#"
[workpiece]
lead = "6 mm"
[spindle]
speed = "6 rpm"
[lead_screw]
lead = "12 mm"
[[gear]]
name = "wheel"
order = 2.5
[grating]
lines = 13906
[laser]
wavelength = "0.63281983 um"
[dividers]
a = 110
b = 150
[drive]
step = "0.0125 um"
frequency = "160 Hz"
"#;

    /// Four passes there and back at three speeds, with a logged column.
    fn problem() -> Problem {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        let column = |name: &str, value: &dyn Fn(f64, f64) -> f64| {
            let samples = (0..4_u32).flat_map(|pass| (0..60_u32).map(move |row| (pass, row)));
            let values = samples.map(|(pass, row)| value(f64::from(pass), f64::from(row)));
            Column { name: name.into(), values: values.collect() }
        };
        let back = |row: f64| if row < 30.0 { row } else { 60.0 - row };
        let table = Table::new(vec![
            column("pass", &|pass, _| pass),
            column("time_s", &|pass, row| 100.0 * pass + 1.3 * row),
            column("position_mm", &|_, row| 3.7 * back(row)),
            column("speed_rpm", &|pass, _| 5.0 + pass % 3.0),
            column("oil_temperature_c", &|pass, row| 21.0 + libm::sin(pass + 0.1 * row)),
            column("error_um", &|pass, row| libm::sin(7.0 * row * row + pass)),
        ]);
        let measurement = Measurement::from_table(&table, &Nominal::of(&machine));
        Problem::new(&machine, &measurement.expect("a measurement")).expect("all columns")
    }

    /// A kink before the first reading was proposed for a straight line, and its moment had no error.
    #[test]
    fn a_place_is_looked_for_in_the_record() {
        let problem = problem();
        let stage = Stage::new(&problem, &Columns::default(), &[Noise::white()]);
        let ends = |values: &[f64]| {
            let of = |sum: fn(f64, f64) -> f64, first| values.iter().copied().fold(first, sum);
            of(f64::min, f64::INFINITY)..=of(f64::max, f64::NEG_INFINITY)
        };
        let (time, travel) = (ends(&problem.record.time_s), ends(&problem.record.position_mm));
        let mut asked = 0;
        for shape in formulas(&problem) {
            let placed = shape.best(&[&stage], Entry::Motion).pop().flatten();
            let Some(term) = placed.and_then(|placed| placed.term("formula").ok()) else {
                continue;
            };
            for parameter in &term.parameters {
                let within = match parameter.name.as_ref() {
                    "at_s" => &time,
                    "at_mm" => &travel,
                    _ => continue,
                };
                let (from, to) = (parameter.range.start(), parameter.range.end());
                let told = format!("{} along {}: {from} to {to}", shape.words, shape.along);
                assert!(within.contains(from) && within.contains(to), "{told}");
                asked += 1;
            }
        }
        assert!(10 < asked, "{asked}");
    }

    #[test]
    fn every_formula_has_a_unit_and_does_what_it_says() {
        let problem = problem();
        let stage = Stage::new(&problem, &Columns::default(), &[Noise::white()]);
        let all = formulas(&problem);
        assert!(30 < all.len(), "{}", all.len());
        for shape in &all {
            let told = format!("{} along {}", shape.words, shape.along);
            assert!(shape.written(Delta::Micrometres).is_some(), "{told}: unlike units");
            let Some(placed) = shape.best(&[&stage], Entry::Motion).pop().flatten() else {
                continue;
            };
            let term = placed.term("formula").expect(&told);
            let effect = term.effect(&problem.model, &problem.record.columns).expect(&told);
            let shown = problem.column(Entry::Motion, &effect.deltas_um(&problem.record));
            let mut fitted = vec![0.0; shown.len()];
            for (column, size) in placed.columns.raw.iter().zip(&placed.coefficients) {
                fitted.iter_mut().zip(column).for_each(|(sum, part)| *sum += size * part);
            }
            let most = fitted.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            for (a, b) in shown.iter().zip(&fitted) {
                assert!((a - b).abs() < 1e-6 * most, "{told}: {a} and {b}");
            }
        }
    }
}
