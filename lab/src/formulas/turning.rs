//! Shapes over the turns of shafts.

use std::sync::Arc;

use super::dimension::Dimension;
use super::expression::{Expression, Function, Quantity, call, number, turns};
use super::grammar::{shape, unknown};
use super::moving::{KNOCK, knock, triangle};
use super::quantities::{Quantities, about_mean, of, shaft_turns};
use super::shape::{Band, ORDER, Shape};
use crate::model::Problem;
use crate::numerics::{evenly, spread, usual_rate};
use crate::policy::extent::{LONGEST_WAVE, MOST_OF_A_TURN, SLOWEST_WAVES, TURNS};
use crate::spectrum::gear_orders;

/// What comes with a turn and is no sine, once a turn and several times.
const EACH: [&str; 5] = [
    "square wave each turn",
    "triangle each turn",
    "half wave each turn",
    "knock each turn",
    "sawtooth each turn",
];
const SEVERAL: [&str; 5] = [
    "square wave several times a turn",
    "triangle several times a turn",
    "half wave several times a turn",
    "knock several times a turn",
    "sawtooth several times a turn",
];

/// Shapes that come with every turn of a shaft and are no sine.
pub(super) fn each_turn(all: &Quantities, shaft: &str, order: f64) -> Vec<Shape> {
    of_turns(shaft, &(shaft_turns(&all.turns, order) + unknown(0)), EACH)
}

/// The same of parts of a shaft's turn, so many a turn of the spindle.
pub(super) fn several_a_turn(all: &Quantities, shaft: &str, order: f64) -> Vec<Shape> {
    of_turns(shaft, &(shaft_turns(&all.turns, order) + unknown(0)), SEVERAL)
}

/// A sine of so many waves a turn of the spindle.
pub(super) fn sine(all: &Quantities, order: f64) -> Shape {
    let angle = turns(shaft_turns(&all.turns, order));
    shape("sine each turn or several times", "spindle angle", "a bearing or a wheel that runs out")
        .wave("amplitude", "phase_rad", None, angle)
}

fn of_turns(shaft: &str, turn: &Expression, words: [&'static str; 5]) -> Vec<Shape> {
    let each = |words, physics, most: f64, points| {
        let mut one = shape(words, shaft, physics).unknown(
            "offset_rev",
            &Dimension::number(),
            evenly(0.0, most, points),
        );
        one.turns = true;
        one
    };
    let fract = || call(Function::Fract, turn.clone());
    let [square, rise, half, blow, saw] = words;
    vec![
        each(square, "a face cam, a part that seats on one of two faces", 0.5, 12)
            .curve("size", call(Function::Step, number(0.5) - fract())),
        each(rise, "a cam of even rise", 0.5, 12).curve("size", triangle(turn.clone())),
        each(half, "contact over half of a turn only", 1.0, 24)
            .curve("size", call(Function::Ramp, call(Function::Sin, turns(turn.clone())))),
        each(blow, "a scratch, a chipped tooth, a ball or roller with a spot", 1.0, 36)
            .curve("size", knock(fract(), number(KNOCK))),
        each(saw, "a cam with an edge, one lost count a turn", 1.0, 24).curve("size", fract()),
    ]
}

/// A shaft's sine that is another one on the way back, where passes run both ways.
pub(super) fn each_way(all: &Quantities, shaft: &str, order: f64) -> Option<Shape> {
    let angle = || turns(shaft_turns(&all.turns, order));
    let way = &all.direction;
    (0.0 < spread(&way.values)).then(|| {
        let physics = "a shaft that is pressed to one side by each way";
        let mut one = shape("sine of each way its own", shaft, physics)
            .wave("amplitude", "phase_rad", None, angle())
            .wave("amplitude_by_way", "phase_by_way_rad", Some(of(way)), angle());
        one.turns = true;
        one
    })
}

/// A sine of any order of the spindle, and of any frequency in time.
pub(super) fn waves(all: &Quantities, problem: &Problem) -> Vec<Shape> {
    let mut shapes: Vec<Shape> =
        orders_resolved(all, problem).map(|band| sine_of_an_order(all, band)).into_iter().collect();
    if let Some(band) = in_time(all, problem) {
        let over = &all.time;
        let mut wave =
            shape("sine in time", "time", "a pump, a motor, a control loop, the building")
                .unknown("frequency_hz", &over.dimension.to_the(-1), band.ends.to_vec())
                .wave("amplitude", "phase_rad", None, turns(unknown(0) * of(over)));
        wave.scan = Some(band);
        shapes.push(wave);
    }
    shapes
}

/// A sine of an order between two: one of all that may be, wherever it is looked for.
pub(super) fn sine_between(
    all: &Quantities,
    problem: &Problem,
    [least, most]: [f64; 2],
) -> Option<Shape> {
    let [lowest, highest] = orders_resolved(all, problem)?.ends;
    let ends = [least.max(lowest), most.min(highest)];
    let band = Band::new(all.turns.values.clone(), ends)?;
    let listed = (highest - lowest) / (ends[1] - ends[0]);
    Some(Shape { listed, ..sine_of_an_order(all, band) })
}

fn sine_of_an_order(all: &Quantities, band: Band) -> Shape {
    let physics = "a shaft, wheel or belt that the machine file does not list";
    let mut wave = shape("sine of an order", "spindle angle", physics)
        .unknown(ORDER, &Dimension::number(), band.ends.to_vec())
        .wave("amplitude", "phase_rad", None, turns(unknown(0) * of(&all.turns)));
    wave.scan = Some(band);
    wave
}

/// Orders of the spindle that the samples resolve.
fn orders_resolved(all: &Quantities, problem: &Problem) -> Option<Band> {
    let over = &all.turns;
    let highest = problem.highest_order().min(0.5 * usual_rate(&over.values));
    let lowest = LONGEST_WAVE / spread(&over.values).max(f64::MIN_POSITIVE);
    Band::new(over.values.clone(), [lowest, highest]).filter(|_| all.placed)
}

/// What switches at even times: on for a share of each period.
pub(super) fn switching(all: &Quantities, problem: &Problem) -> Option<Shape> {
    let band = in_time(all, problem)?;
    let share = call(Function::Fract, of(&all.time) * unknown(0) + unknown(1));
    let physics = "a thermostat, a valve, a relay: what switches at even times";
    let mut one = shape("square wave in time", "time", physics)
        .unknown("frequency_hz", &all.time.dimension.to_the(-1), band.ends.to_vec())
        .unknown("offset", &Dimension::number(), evenly(0.0, 1.0, 24))
        .unknown("width", &Dimension::number(), vec![0.5])
        .curve("size", call(Function::Step, unknown(2) - share));
    one.scan = Some(band);
    Some(one)
}

/// Frequencies in time that the samples resolve.
fn in_time(all: &Quantities, problem: &Problem) -> Option<Band> {
    let over = &all.time;
    let highest = problem.highest_hz().min(0.5 * usual_rate(&over.values));
    let lowest = SLOWEST_WAVES / spread(&over.values).max(f64::MIN_POSITIVE);
    Band::new(over.values.clone(), [lowest, highest]).filter(|_| all.timed)
}

/// Orders of the machine that its samples resolve.
fn orders(all: &Quantities, problem: &Problem) -> Vec<f64> {
    let mut orders = gear_orders(&problem.model);
    orders.push(1.0);
    orders.retain(|order| {
        *order < problem.highest_order() && TURNS < order * spread(&all.turns.values)
    });
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    orders
}

/// A shaft's sine that swells with the turn of another, or once or twice with the spindle's: two sidebands. On a
/// record of one turn they are not told from whole waves of it.
pub(super) fn swelling(all: &Quantities, problem: &Problem) -> Vec<Shape> {
    let angle = |order| turns(shaft_turns(&all.turns, order));
    let carriers = orders(all, problem);
    let mut slow = carriers.clone();
    if MOST_OF_A_TURN < spread(&all.turns.values) {
        slow.extend([1.0, 2.0]);
        slow.sort_by(f64::total_cmp);
        slow.dedup();
    }
    let pairs = carriers.iter().flat_map(|a| slow.iter().map(move |b| (*a, *b)));
    let physics = "a wheel that another one drives: its wave swells with the other's turn";
    pairs
        .filter(|(carrier, slow)| carrier.to_bits() != slow.to_bits())
        .map(|(carrier, slow)| {
            let swell = call(Function::Sin, angle(slow) + unknown(0));
            shape("sine that swells with a turn", &format!("orders {carrier} and {slow}"), physics)
                .unknown("swell_rad", &Dimension::number(), evenly(0.0, std::f64::consts::PI, 6))
                .wave("amplitude", "phase_rad", None, angle(carrier))
                .wave("swell", "swell_phase_rad", Some(swell), angle(carrier))
        })
        .collect()
}

/// A shaft's sine whose size another quantity sets: a torque, a temperature, the speed, the time.
pub(super) fn sized_by_a_column(all: &Quantities, problem: &Problem) -> Vec<Shape> {
    let mut by: Vec<&Arc<Quantity>> = all.few_columns().iter().collect();
    by.push(&all.speed);
    by.extend(Some(&all.time).filter(|_| all.timed));
    by.extend(Some(&all.position).filter(|_| all.have_places()));
    by.retain(|quantity| 0.0 < spread(&quantity.values));
    let of_order = |order: f64, by: &Arc<Quantity>| {
        let angle = || turns(shaft_turns(&all.turns, order));
        let physics =
            "a mesh or a joint that gives way under a load, a wave that heat or wear takes away";
        shape("sine whose size follows a column", &format!("order {order} by {}", by.name), physics)
            .wave("amplitude", "phase_rad", None, angle())
            .wave("swell", "swell_phase_rad", Some(about_mean(by)), angle())
    };
    let orders = orders(all, problem);
    orders.iter().flat_map(|order| by.iter().map(move |by| of_order(*order, by))).collect()
}

/// A shaft's sine through a resonance that the speeds of the passes go over.
pub(super) fn resonances(all: &Quantities, problem: &Problem) -> Vec<Shape> {
    let mut speeds = all.speed.values.clone();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let (Some(slowest), Some(fastest)) = (speeds.first(), speeds.last()) else {
        return Vec::new();
    };
    if speeds.len() < 3 {
        return Vec::new();
    }
    let square = |of: Expression| Expression::Power(Box::new(of), 2);
    let ratio = || of(&all.speed) / unknown(0);
    let stiff = || number(1.0) - square(ratio());
    let damped = || number(2.0) * unknown(1) * ratio();
    let swell = || number(1.0) / call(Function::Sqrt, square(stiff()) + square(damped()));
    // The lag of a driven mass, from 0 at rest to half a turn far above.
    let late = || Expression::Pi / number(2.0) - call(Function::Atan, stiff() / damped());
    let physics = "something that swings at its own frequency, driven by a shaft's turn";
    let of_order = |order: f64| {
        let angle = turns(shaft_turns(&all.turns, order)) - late();
        shape("resonance of a shaft's wave", &format!("order {order} by speed"), physics)
            .unknown("resonance_rpm", &all.speed.dimension, evenly(*slowest, *fastest, 16))
            .unknown("damping", &Dimension::number(), vec![0.02, 0.05, 0.1, 0.2, 0.4])
            .wave("amplitude", "phase_rad", Some(swell()), angle)
    };
    orders(all, problem).into_iter().map(of_order).collect()
}
