//! Shapes over travel, time, speed, direction and way.

use std::sync::Arc;

use super::dimension::Dimension;
use super::expression::{Expression, Function, Quantity, call, number, turns};
use super::grammar::{periods, shape, unknown};
use super::quantities::{Quantities, about_middle, from_start, lowest, of, to_end};
use super::shape::Shape;
use crate::numerics::{by_factors, count, evenly, longest, median, spread};
use crate::policy::extent::{LONGEST_WAVE, RUN_IN};

/// First width of a knock, against the distance of two; it is refined.
pub(super) const KNOCK: f64 = 0.07;

/// Moments of a pass at which a knock or readings off are looked for, and the passes beyond which they lie wider.
const PLACES_A_PASS: usize = 130;
const MOST_PASSES: usize = 4;

/// Half of how many readings on end may be off.
const HALF_A_BURST_ROWS: [f64; 3] = [1.5, 3.0, 5.0];

/// Share of the record that a step stands away from its ends; a refined one comes as near as
/// [`RUN_IN`].
const AWAY: f64 = 2.0 * RUN_IN;

/// Half of the width of a target alone, as a share of the least way to another.
const SHARE_OF_A_GAP: f64 = 0.4;

/// Most that a wave changes over half of the travel, as a share of its frequency in the middle.
const CHANGE: f64 = 0.9;

fn ramp(from: Expression) -> Expression {
    call(Function::Ramp, from)
}

/// A pulse where the share of a period is a half, of so wide a bell.
pub(super) fn knock(share: Expression, width: Expression) -> Expression {
    bell((share - number(0.5)) / width)
}

/// A triangle of so many waves.
pub(super) fn triangle(waves: Expression) -> Expression {
    call(Function::Abs, call(Function::Fract, waves) - number(0.5))
}

/// What is nobody's where nothing of the catalogue grows with the way.
pub(crate) const STRAIGHT_LINE: &str = "straight line";

/// An error that grows with the angle, as no effect of the catalogue does; over a travel one has that name.
pub(super) fn another_ratio(all: &Quantities) -> Option<Shape> {
    let physics = "a gear ratio, a wheel or a number of lines that is not the file's";
    let line = || shape(STRAIGHT_LINE, all.way(), physics).curve("slope", of(&all.position));
    (all.is_rotary() && all.moves()).then(line)
}

/// Kinks, bends, steps and roots along the travel.
pub(super) fn along_travel(all: &Quantities) -> Vec<Shape> {
    let x = &all.position;
    let mm = &x.dimension;
    let range = spread(&x.values);
    let from = || of(x) - unknown(0);
    let at_one_of = |places, words, physics| at_one_of(all, places, words, physics);
    let at = |words, physics| at_one_of(100, words, physics);
    let squared = Expression::Power(Box::new(ramp(from())), 2);
    vec![
        at(
            "kink at one place",
            "two guides that meet at an angle, a joint of the bed, a rack's change of pitch",
        )
        .curve("slope", of(x))
        .curve("size", ramp(from())),
        at(
            "bend from one place on",
            "a bed that sags from a support on, a screw that is worn from a place on",
        )
        .curve("slope", of(x))
        .curve("size", squared),
        at("step at one place", "a joint of two racks or scales, a dent of the guide")
            .curve("slope", of(x))
            .curve("size", call(Function::Step, from())),
        at_one_of(
            48,
            "stretch at another level",
            "a piece of a scale, rack or guide that was set in or worn flat",
        )
        .unknown(all.in_unit("half_mm", "half_rev"), mm, by_factors(0.02 * range, 0.22 * range, 8))
        .curve("size", call(Function::Step, unknown(1) - call(Function::Abs, from()))),
        at("root from one place on", "contact that stiffens under load")
            .curve("size", call(Function::Sqrt, ramp(from()))),
        decay(x, all.way(), all.in_unit("length_mm", "length_rev")),
        at_one_of(98, "swing at one place", "a dent with the metal beside it, a joint that tilts")
            .unknown(
                all.in_unit("width_mm", "width_rev"),
                mm,
                by_factors(0.005 * range, 0.1 * range, 4),
            )
            .curve("size", (from() / unknown(1)) * bell(from() / unknown(1)))
            .curve("rim_size", rim(from() / unknown(1)))
            .made_by(2),
    ]
}

/// One target that is off and no other: what is narrower than targets lie apart has no other shape.
pub(super) fn one_target(all: &Quantities) -> Option<Shape> {
    let x = &all.position;
    let gaps = all.targets.windows(2).map(|pair| pair[1] - pair[0]);
    let half = Expression::Number(SHARE_OF_A_GAP * gaps.reduce(f64::min)?, x.dimension.clone());
    let physics = "a mistyped reading, dirt under a mount, a spot narrower than targets lie apart";
    let one = shape("one target alone", all.way(), physics)
        .unknown(all.in_unit("at_mm", "at_rev"), &x.dimension, all.targets.clone())
        .curve("size", call(Function::Step, half - call(Function::Abs, of(x) - unknown(0))));
    Some(one.placed())
}

/// A shape at one of so many places.
fn at_one_of(all: &Quantities, places: usize, words: &'static str, physics: &'static str) -> Shape {
    let x = &all.position;
    let low = lowest(&x.values);
    let places = evenly(low, low + spread(&x.values), places);
    let name = all.in_unit("at_mm", "at_rev");
    shape(words, all.way(), physics).unknown(name, &x.dimension, places).placed()
}

/// Edges that die away along the travel, behind them or before.
pub(super) fn edges(all: &Quantities) -> [Shape; 2] {
    let x = &all.position;
    let range = spread(&x.values);
    let edge = |words, physics, way: Expression| {
        let gone = number(-1.0) * ramp(way.clone()) / unknown(1);
        at_one_of(all, 100, words, physics)
            .unknown(
                all.in_unit("over_mm", "over_rev"),
                &x.dimension,
                by_factors(0.01 * range, 0.2 * range, 6),
            )
            .curve("size", call(Function::Step, way) * call(Function::Exp, gone))
    };
    [
        edge(
            "edge that dies away behind",
            "a joint or a step whose jump a slide takes up over a way",
            of(x) - unknown(0),
        ),
        edge(
            "edge that rises from before",
            "a joint or a step that a slide meets before it is there",
            unknown(0) - of(x),
        ),
    ]
}

/// A bell over so many standard deviations.
fn bell(deviations: Expression) -> Expression {
    call(Function::Exp, number(-0.5) * Expression::Power(Box::new(deviations), 2))
}

/// A bell and the rim that takes as much away as it adds.
fn rim(deviations: Expression) -> Expression {
    (number(1.0) - Expression::Power(Box::new(deviations.clone()), 2)) * bell(deviations)
}

/// An exponential that dies away.
fn decay(x: &Arc<Quantity>, along: &str, constant: &'static str) -> Shape {
    let range = spread(&x.values);
    let (start, _) = from_start(x);
    shape("decay", along, "warming towards a balance, play that is taken up")
        .unknown(constant, &x.dimension, by_factors(0.02 * range, 2.0 * range, 24))
        .curve("size", call(Function::Exp, number(-1.0) * start / unknown(0)))
}

/// Shapes that come again along the travel.
pub(super) fn again_and_again(all: &Quantities) -> Vec<Shape> {
    let x = &all.position;
    let mm = &x.dimension;
    let range = spread(&x.values);
    let number = Dimension::number();
    let (start, _) = from_start(x);
    let waves = || start.clone() / unknown(0) + unknown(1);
    let again = |words, physics, fewest: f64, most: f64, points: [usize; 2]| {
        shape(words, all.way(), physics)
            .unknown(
                all.in_unit("period_mm", "period_rev"),
                mm,
                periods(range, fewest, most, points[0]),
            )
            .unknown("offset_rev", &number, evenly(0.0, 1.0, points[1]))
    };
    vec![
        again(
            "sawtooth",
            "a rack or scale of pieces, each as long as the period",
            2.0,
            32.0,
            [100, 5],
        )
        .curve("size", call(Function::Fract, waves())),
        again(
            "knocks at even distances",
            "a chipped tooth, a ball or roller with a spot",
            4.0,
            32.0,
            [140, 8],
        )
        .unknown("width", &number, vec![KNOCK])
        .curve("size", knock(call(Function::Fract, waves()), unknown(2))),
        again(
            "triangles",
            "a guide ground in strokes, supports at even distances",
            1.0,
            12.0,
            [45, 8],
        )
        .curve("size", triangle(waves())),
        again("half waves", "contact at one side only: what lifts off", 1.0, 12.0, [45, 8])
            .curve("size", ramp(call(Function::Sin, turns(waves())))),
        wave_of_changing_length(all),
    ]
}

/// A sine over the travel that is of its period in the middle, and the faster the farther from
/// there, or the slower.
fn wave_of_changing_length(all: &Quantities) -> Shape {
    let x = &all.position;
    let (middle, range) = about_middle(x);
    let growth = evenly(-CHANGE, CHANGE, 21).iter().map(|share| share / range).collect();
    let angle = middle.clone() / unknown(0) * (number(1.0) + unknown(1) * middle);
    let (period, per_unit) =
        (all.in_unit("period_mm", "period_rev"), all.in_unit("growth_per_mm", "growth_per_rev"));
    shape("wave of changing length", all.way(), "a belt that creeps, a mesh of uneven pitch")
        .unknown(period, &x.dimension, periods(range, LONGEST_WAVE, 12.0, 23))
        .unknown(per_unit, &x.dimension.to_the(-1), growth)
        .wave("amplitude", "phase_rad", None, turns(angle))
}

/// Moments with as many samples between them everywhere: in a pause between passes there are none.
fn moments(t: &Quantity, points: usize) -> Vec<f64> {
    let mut times = t.values.to_vec();
    times.sort_by(f64::total_cmp);
    let mut moments: Vec<f64> =
        (0..points).map(|point| times[point * (times.len() - 1) / (points - 1)]).collect();
    moments.dedup();
    moments
}

/// A step, a kink, a parabola, a rise and its decay.
pub(super) fn in_time(all: &Quantities) -> Vec<Shape> {
    let t = &all.time;
    let s = &t.dimension;
    let (low, range) = (lowest(&t.values), spread(&t.values));
    let inside = |mut moments: Vec<f64>| {
        moments.retain(|at| (AWAY..=1.0 - AWAY).contains(&((at - low) / range)));
        moments
    };
    let peaks: Vec<f64> = evenly(0.03, 0.75, 24).iter().map(|share| share * range).collect();
    let (start, _) = from_start(t);
    let share = start.clone() / unknown(0);
    let passes = all.passes;
    let pass = range / count(passes);
    let widths = by_factors(0.005 * pass, 0.1 * pass, 4);
    let mut shapes = vec![
        shape("step at one moment", "time", "something slipped or was knocked and stayed so")
            .unknown("at_s", s, inside(moments(t, 200)))
            .placed()
            .curve("size", call(Function::Step, of(t) - unknown(0))),
        shape("kink at one moment", "time", "a drift that turns: a heater, a door, a valve")
            .unknown("at_s", s, moments(t, 60))
            .placed()
            .curve("slope", of(t))
            .curve("size", ramp(of(t) - unknown(0))),
        shape("parabola", "time", "a load or heat that grows ever faster")
            .curve("slope", of(t))
            .curve("size", Expression::Power(Box::new(start), 2)),
        shape("rise and fall", "time", "one part warms first, another takes the heat away")
            .unknown("peak_s", s, peaks)
            .curve("size", share.clone() * call(Function::Exp, number(1.0) - share)),
    ];
    if all.tell_moments_from_places() {
        let instants = moments(t, PLACES_A_PASS * passes.min(MOST_PASSES));
        let off = (of(t) - unknown(0)) / unknown(1);
        shapes.push(
            shape(
                "knock at one moment",
                "time",
                "a blow, a chip under the slide, a hand on the bed",
            )
            .unknown("at_s", s, instants)
            .unknown("width_s", s, widths)
            .placed()
            .curve("size", bell(off)),
        );
        let off = call(Function::Abs, of(t) - unknown(0));
        // As dense over several passes as over one, where it stands in the place of effects, too.
        let halves = if passes == 1 { 8 } else { 12 };
        shapes.push(
            shape("spell at another level", "time", "something gave way and came back")
                .unknown("at_s", s, moments(t, 48 * passes.min(MOST_PASSES)))
                .unknown("half_s", s, by_factors(0.02 * pass, 0.22 * range, halves))
                .placed()
                .curve("size", call(Function::Step, unknown(1) - off)),
        );
    } else {
        shapes.push(readings_off(t));
    }
    shapes
}

/// A few readings on end that are off and come back: where each place is met once, nothing tells them from a spot.
fn readings_off(t: &Arc<Quantity>) -> Shape {
    let mut times = t.values.to_vec();
    times.sort_by(f64::total_cmp);
    let mut intervals: Vec<f64> = times.windows(2).map(|two| two[1] - two[0]).collect();
    let halves = HALF_A_BURST_ROWS.map(|rows| rows * median(&mut intervals)).to_vec();
    let off = call(Function::Abs, of(t) - unknown(0));
    shape("some readings on end off", "time", "a blow, dirt in the beam, a contact that fails")
        .unknown("at_s", &t.dimension, moments(t, PLACES_A_PASS))
        .unknown("half_s", &t.dimension, halves)
        .placed()
        .curve("size", call(Function::Step, unknown(1) - off))
}

/// Slopes and bows that come or settle in time as a screw, scale or bed warms, where a place is met at
/// several moments.
pub(super) fn warming(all: &Quantities) -> Vec<Shape> {
    if !(all.have_places() && all.tell_moments_from_places()) {
        return Vec::new();
    }
    let (x, t) = (&all.position, &all.time);
    let range = spread(&t.values);
    let constants = |points| by_factors(0.02 * range, 2.0 * range, points);
    let gone =
        |since: Expression, constant| call(Function::Exp, number(-1.0) * since / unknown(constant));
    let start = || from_start(t).0;
    let (middle, _) = about_middle(x);
    let bow = || Expression::Power(Box::new(middle.clone()), 2);
    let since = || ramp(of(t) - unknown(0));
    vec![
        shape("slope that settles in time", "time", "a screw, scale or bed that warms as it runs")
            .unknown("constant_s", &t.dimension, constants(16))
            .curve("slope", of(x))
            .curve("size", of(x) * gone(start(), 0)),
        shape("bow that settles in time", "time", "a bed or beam that is warmed from one side")
            .unknown("constant_s", &t.dimension, constants(16))
            .curve("level", of(t))
            .curve("slope", of(x))
            .curve("bow", bow())
            .curve("tilt", middle.clone() * gone(start(), 0))
            .curve("size", bow() * gone(start(), 0)),
        shape("bow that comes in time", "time", "a bed or beam that is warmed from one side")
            .unknown("constant_s", &t.dimension, constants(16))
            .curve("size", from_start(x).0 * to_end(x) * (number(1.0) - gone(start(), 0))),
        shape("slope from one moment on", "time", "coolant, sun or a heater on a scale or screw")
            .unknown("at_s", &t.dimension, moments(t, 40))
            .unknown("constant_s", &t.dimension, constants(6))
            .placed()
            .curve("slope", of(x))
            .curve("size", of(x) * (number(1.0) - gone(since(), 1))),
    ]
}

/// Powers along travel and time, and a decay in time.
pub(super) fn powers(all: &Quantities) -> Vec<Shape> {
    let mut shapes = Vec::new();
    if all.have_places() {
        let (start, _) = from_start(&all.position);
        shapes.extend([
            cube(&all.position, all.way()),
            shape("parabola", all.way(), "a bed that sags, a screw of steadily changing lead")
                .curve("slope", of(&all.position))
                .curve("size", Expression::Power(Box::new(start), 2)),
        ]);
    }
    if all.timed && 0.0 < spread(&all.time.values) {
        shapes.extend([cube(&all.time, "time"), decay(&all.time, "time", "constant_s")]);
    }
    shapes
}

fn cube(x: &Arc<Quantity>, along: &str) -> Shape {
    let (start, _) = from_start(x);
    let power = |n| Expression::Power(Box::new(start.clone()), n);
    shape("cube", along, "a bed bent by two supports")
        .curve("slope", of(x))
        .curve("square", power(2))
        .curve("size", power(3))
}

/// Play that is not taken up at once, where passes turn back inside.
pub(super) fn since_a_reversal(all: &Quantities) -> Option<Shape> {
    let longest = longest(&all.since_reversal.values);
    let (of_way, way) = (&all.since_reversal.dimension, &all.direction);
    let gone = number(-1.0) * of(&all.since_reversal) / unknown(0);
    (0.0 < longest).then(|| {
        shape(
            "taken up after a turn",
            "way since the reversal",
            "play or wind-up that is taken up over a way",
        )
        .unknown(
            all.in_unit("over_mm", "over_deg"),
            of_way,
            by_factors(0.005 * longest, 0.5 * longest, 12),
        )
        .curve("play", of(way))
        .curve("size", of(way) * call(Function::Exp, gone))
    })
}

/// What dies away each time the axis has come to stand.
pub(super) fn since_a_stop(all: &Quantities) -> Option<Shape> {
    let since = all.since_stop.as_ref().filter(|_| all.moves() && all.timed)?;
    let longest = longest(&since.values);
    let gone = || call(Function::Exp, number(-1.0) * of(since) / unknown(0));
    let settling = shape(
        "settles after each stop",
        "time since the stop",
        "a servo, a slide or a frame that comes to rest after the axis has stopped",
    )
    .unknown("constant_s", &since.dimension, by_factors(0.02 * longest, 2.0 * longest, 12))
    .curve("size", gone());
    let both_ways = 0.0 < spread(&all.direction.values);
    Some(if both_ways { settling.curve("each_way", of(&all.direction) * gone()) } else { settling })
}

/// A step at each turn that grows along the travel, and a start of each pass that dies away, where a
/// place is met more than once.
pub(super) fn of_each_pass(all: &Quantities) -> Vec<Shape> {
    let (x, way, since) = (&all.position, &all.direction, &all.travelled);
    let mut shapes = Vec::new();
    if 0.0 < spread(&way.values) {
        shapes.push(
            shape("each way its own line", "direction", "wind-up that grows with the length")
                .curve("play", of(way))
                .curve("slope", of(x))
                .curve("size", of(way) * of(x)),
        );
        let (middle, _) = about_middle(x);
        shapes.push(
            shape("each way its own bow", "direction", "a flexure or a carriage that gives way")
                .curve("play", of(way))
                .curve("slope", of(way) * middle.clone())
                .curve("size", of(way) * Expression::Power(Box::new(middle), 2)),
        );
        let off = (of(x) - unknown(0)) / unknown(1);
        let range = spread(&x.values);
        shapes.push(
            at_one_of(all, 24, "play that is larger at one place", "a nut or a screw worn there")
                .unknown(
                    all.in_unit("width_mm", "width_rev"),
                    &x.dimension,
                    by_factors(0.04 * range, 0.4 * range, 5),
                )
                .curve("play", of(way))
                .curve("size", of(way) * bell(off)),
        );
    }
    let longest = spread(&since.values);
    let over = || by_factors(0.005 * longest, 0.5 * longest, 12);
    let gone = || call(Function::Exp, number(-1.0) * of(since) / unknown(0));
    if 0.0 < longest && 0.0 < spread(&way.values) {
        shapes.push(
            shape(
                "taken up after each start",
                "way since the start",
                "play or wind-up that is taken up over a way, each pass the other way",
            )
            .unknown(all.in_unit("over_mm", "over_deg"), &since.dimension, over())
            .curve("play", of(way))
            .curve("size", of(way) * gone()),
        );
    }
    if 0.0 < longest && (1 < all.passes || 0.0 < spread(&way.values)) {
        shapes.push(
            shape(
                "settles after the start of a pass",
                "way since the start",
                "a table that runs in, oil that is pressed out",
            )
            .unknown(all.in_unit("over_mm", "over_deg"), &since.dimension, over())
            .curve("size", gone()),
        );
    }
    shapes
}

/// What is late by a time, where the speed of every sample is known, or is another one in other passes: one that
/// turns back at a single speed may as well have play.
pub(super) fn late(all: &Quantities) -> Option<Shape> {
    let turns_back = 0.0 < spread(&all.speed.values) && 0.0 < spread(&all.direction.values);
    let velocity = match &all.velocity {
        Some(velocity) => of(velocity),
        None => turns_back.then(|| of(&all.speed) * of(&all.direction))?,
    };
    let physics = "a sensor or a follower that is late by a time";
    Some(shape("late by a time", "speed", physics).curve("size", velocity))
}

/// What depends on how fast, which way, and which pass.
pub(super) fn of_the_way(all: &Quantities) -> Vec<Shape> {
    let (x, v, way) = (&all.position, &all.speed, &all.direction);
    let moves = all.moves();
    let mut shapes = Vec::new();
    if 0.0 < spread(&way.values) {
        shapes.push(
            shape("each way its own", "direction", "play, or friction that bends what carries")
                .curve("size", of(way)),
        );
    }
    if 0.0 < spread(&v.values) {
        let physics = "friction or heat that grows with speed";
        shapes.push(shape("by speed", "speed", physics).curve("size", of(v)));
        if moves {
            shapes.push(shape("slope by speed", "speed", physics).curve("size", of(v) * of(x)));
        }
    }
    if 0.0 < spread(&all.pass.values) && moves {
        let physics = "heat or wear from pass to pass";
        shapes.push(
            shape("slope by the pass", "passes", physics).curve("size", of(&all.pass) * of(x)),
        );
    }
    shapes
}
