//! Shapes over a logged column.

use std::sync::Arc;

use super::expression::{Expression, Function, Quantity, call};
use super::grammar::{shape, unknown};
use super::quantities::{Quantities, about_mean, about_middle, less_mean, lowest, of};
use super::shape::Shape;
use crate::numerics::{by_factors, evenly, spread};

/// Straight, through the travel, late, late through the travel, and by a relay.
pub(super) fn of_a_column(all: &Quantities, column: &Arc<Quantity>) -> Vec<Shape> {
    let (x, time) = (&all.position, &all.time);
    let (low, range) = (lowest(&column.values), spread(&column.values));
    let record_s = spread(&time.values).max(f64::MIN_POSITIVE);
    // Time constants from a hundredth of the record to half of it.
    let constants = || by_factors(0.01 * record_s, 0.5 * record_s, 12);
    let late = || Expression::Lag { of: Arc::clone(column), time: Arc::clone(time), constant: 0 };
    let of_column = |words, physics| shape(words, &column.name, physics);
    let hysteresis = evenly(0.0, 0.6, 6).iter().map(|share| share * range).collect();
    let mut shapes = vec![
        of_column("straight relation", "what the column measures moves or stretches a part")
            .curve("size", of(column)),
        of_column("late relation", "heat or pressure that takes its time to reach a part")
            .unknown("late_s", &time.dimension, constants())
            .curve("size", late()),
        of_column("relay", "a switch with hysteresis: a thermostat, a valve, a contactor")
            .unknown("middle", &column.dimension, evenly(low, low + range, 10))
            .unknown("hysteresis", &column.dimension, hysteresis)
            .curve("size", Expression::Relay { of: Arc::clone(column), middle: 0, width: 1 }),
    ];
    if all.moves() {
        shapes.push(
            of_column(
                "straight relation times the travel",
                "a scale, screw or bed that stretches with the column",
            )
            .curve("slope", of(x))
            .curve("size", of(x) * about_mean(column)),
        );
        shapes.extend(bows(x, column));
        let late_times_travel = |words, physics, stretch| {
            of_column(words, physics)
                .unknown("late_s", &time.dimension, constants())
                .curve("slope", of(x))
                .curve("size", of(x) * stretch)
        };
        shapes.extend([
            late_times_travel(
                "late relation times the travel",
                "a scale, screw, bed or beam path that follows the column late",
                less_mean(late(), column),
            ),
            late_times_travel(
                "what the column has not followed yet, times the travel",
                "a sensor that lags behind what it measures",
                of(column) - late(),
            ),
        ]);
    }
    shapes
}

/// A bow that changes with a column, and one that is none where the column is.
fn bows(x: &Arc<Quantity>, column: &Arc<Quantity>) -> Vec<Shape> {
    let (middle, _) = about_middle(x);
    let bow = |words, physics, by: Expression| {
        shape(words, &column.name, physics)
            .curve("slope", of(x))
            .curve("level", of(column))
            .curve("tilt", middle.clone() * by.clone())
            .curve("size", Expression::Power(Box::new(middle.clone()), 2) * by)
    };
    let bends = bow(
        "relation that bends along the travel",
        "a bed, beam or screw that bows with the column",
        about_mean(column),
    );
    let largest = column.values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let grows = OF_THE_LARGEST * largest < spread(&column.values);
    let as_large = grows.then(|| {
        let physics = "a ram, arm or load that bends what carries it";
        bow("bow as large as the column", physics, of(column))
    });
    std::iter::once(bends).chain(as_large).collect()
}

/// What follows a column ahead of its time, or by what it has not followed yet.
pub(super) fn not_followed(all: &Quantities, column: &Arc<Quantity>) -> Shape {
    let time = &all.time;
    let record_s = spread(&time.values).max(f64::MIN_POSITIVE);
    let late = Expression::Lag { of: Arc::clone(column), time: Arc::clone(time), constant: 0 };
    let physics =
        "what shows how fast the column changes: a bridge, a sensor or a part of two heats";
    shape("what the column has not followed yet", &column.name, physics)
        .unknown("late_s", &time.dimension, by_factors(0.01 * record_s, 0.5 * record_s, 12))
        .curve("slope", of(column))
        .curve("size", of(column) - late)
}

/// Part of its largest value that a column changes by, for what may be as large as it.
///
/// Chosen: the rest bends no more than what changes, so that a bow of one size is another curve. Doubled: a force
/// that never falls to a quarter makes none.
const OF_THE_LARGEST: f64 = 0.5;

/// A square, a kink at a value, and each way its own.
pub(super) fn beyond_a_line(all: &Quantities, column: &Arc<Quantity>) -> Vec<Shape> {
    let (low, range) = (lowest(&column.values), spread(&column.values));
    let of_column = |words, physics| shape(words, &column.name, physics);
    let above = of(column) - unknown(0);
    let mut shapes = vec![
        of_column("square of a column", "bending, dissipation or drag: what grows with the square")
            .curve("slope", of(column))
            .curve("size", Expression::Power(Box::new(about_mean(column)), 2)),
        of_column("kink in a column", "what touches, opens or saturates at a value")
            .unknown("from", &column.dimension, evenly(low, low + range, 24))
            .curve("slope", of(column))
            .curve("size", call(Function::Ramp, above)),
    ];
    if 0.0 < spread(&all.direction.values) {
        shapes.push(
            of_column("relation each way its own", "wind-up or play under the column's load")
                .curve("slope", of(column))
                .curve("size", of(&all.direction) * about_mean(column)),
        );
    }
    shapes
}

/// What two columns make together and neither alone.
pub(super) fn products(all: &Quantities) -> Vec<Shape> {
    let columns = all.few_columns();
    let pairs = columns
        .iter()
        .enumerate()
        .flat_map(|(place, one)| columns[place + 1..].iter().map(move |other| (one, other)));
    pairs
        .map(|(one, other)| {
            let along = format!("{} × {}", one.name, other.name);
            shape("product of two columns", &along, "a load whose effect another quantity scales")
                .curve("slope", of(one))
                .curve("other_slope", of(other))
                .curve("size", about_mean(one) * about_mean(other))
        })
        .collect()
}
