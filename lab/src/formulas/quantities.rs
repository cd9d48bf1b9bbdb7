//! What the samples of a problem know, by the names and units that formulas use.

use std::sync::Arc;

use helixlock_plant::Column;

use super::dimension::Dimension;
use super::expression::{Expression, Quantity, number};
use crate::model::{Problem, distinct};
use crate::numerics::{count, mean, spread};

/// Logged columns up to which every one is put together with others, for the time it takes.
const MOST_TOGETHER: usize = 12;

/// Coordinates and logged columns that vary.
#[derive(Debug)]
pub(crate) struct Quantities {
    /// Travel, or the angle of a rotary chain.
    pub(crate) position: Arc<Quantity>,
    /// True when it was measured: one that was made of the clock is a time.
    pub(crate) placed: bool,
    /// Where on it all samples lie, lowest first, if those places are few.
    pub(crate) targets: Vec<f64>,
    pub(crate) time: Arc<Quantity>,
    /// True when time was measured.
    pub(crate) timed: bool,
    pub(crate) turns: Arc<Quantity>,
    pub(crate) speed: Arc<Quantity>,
    pub(crate) direction: Arc<Quantity>,
    /// How fast it turns at every sample, where that was measured and is not always the same.
    pub(crate) velocity: Option<Arc<Quantity>>,
    pub(crate) since_reversal: Arc<Quantity>,
    /// Time since the axis came to stand, where it stands at times; infinite while it moves.
    pub(crate) since_stop: Option<Arc<Quantity>>,
    /// Way since the start of the pass.
    pub(crate) travelled: Arc<Quantity>,
    pub(crate) pass: Arc<Quantity>,
    /// How many passes there are.
    pub(crate) passes: usize,
    pub(crate) columns: Vec<Arc<Quantity>>,
}

impl Quantities {
    pub(crate) fn of(problem: &Problem) -> Self {
        let record = &problem.record;
        let quantity = |name: &str, unit: Dimension, values: Column| {
            Arc::new(Quantity { name: name.to_owned(), dimension: unit, values })
        };
        let unit = Dimension::unit;
        let covariates = problem.measurement.causes();
        // What the motor was told follows from the error, and is taken off.
        let columns = covariates
            .filter(|(name, values)| *name != "steps" && 0.0 < spread(values))
            .map(|(name, values)| quantity(name, Dimension::of_column(name), values.clone()));
        let position = if problem.model.rotary {
            quantity("angle_rev", Dimension::number(), record.turns().collect())
        } else {
            quantity("position_mm", unit("mm"), record.position_mm.clone())
        };
        let (travelled, since_reversal, way) = if problem.model.rotary {
            ("travelled_deg", "since_reversal_deg", unit("deg"))
        } else {
            ("travelled_mm", "since_reversal_mm", unit("mm"))
        };
        let targets = problem.places().map(|_| distinct(position.values.to_vec()));
        Self {
            targets: targets.unwrap_or_default(),
            position,
            placed: problem.measurement.placed,
            time: quantity("time_s", unit("s"), record.time_s.clone()),
            timed: problem.measurement.timed,
            turns: quantity("angle_rev", Dimension::number(), record.turns().collect()),
            speed: quantity("speed_rpm", unit("rpm"), record.speed_rpm.clone()),
            direction: quantity("direction", Dimension::number(), record.direction.clone()),
            velocity: problem
                .velocity_rpm()
                .map(|values| quantity("velocity_rpm", unit("rpm"), values.clone())),
            since_reversal: quantity(since_reversal, way.clone(), record.since_reversal_mm.clone()),
            since_stop: Some(&record.since_stop_s)
                .filter(|since_s| !since_s.is_empty())
                .map(|since_s| quantity("since_stop_s", unit("s"), since_s.clone())),
            travelled: quantity(travelled, way, record.travelled_mm.clone()),
            pass: quantity(
                "pass",
                Dimension::number(),
                record.pass.iter().map(|pass| count(*pass)).collect(),
            ),
            passes: record.passes().len(),
            columns: columns.collect(),
        }
    }

    /// True where the axis is known to move.
    pub(crate) fn moves(&self) -> bool {
        self.placed && 0.0 < spread(&self.position.values)
    }

    /// The same where a place is no moment. In one pass of a rotary chain that does not turn back an angle is a
    /// moment, and is looked for as such.
    pub(crate) fn have_places(&self) -> bool {
        let told = !self.is_rotary() || self.meet_places_again();
        told && self.moves()
    }

    /// True unless a moment is a place as well, as in one pass that does not turn back.
    pub(crate) fn tell_moments_from_places(&self) -> bool {
        self.meet_places_again() || !self.have_places()
    }

    fn meet_places_again(&self) -> bool {
        1 < self.passes || 0.0 < spread(&self.direction.values)
    }

    /// True where places are angles.
    pub(crate) fn is_rotary(&self) -> bool {
        self.position.dimension.is_number()
    }

    /// What places stand along, in words.
    pub(crate) fn way(&self) -> &'static str {
        if self.is_rotary() { "spindle angle" } else { "position" }
    }

    /// Name of an unknown in mm, or that in turns.
    pub(crate) fn in_unit(&self, mm: &'static str, rev: &'static str) -> &'static str {
        if self.is_rotary() { rev } else { mm }
    }

    /// Logged columns, if they are few enough to be put together with others.
    pub(crate) fn few_columns(&self) -> &[Arc<Quantity>] {
        if self.columns.len() <= MOST_TOGETHER { &self.columns } else { &[] }
    }
}

/// A quantity in a formula.
pub(crate) fn of(quantity: &Arc<Quantity>) -> Expression {
    Expression::Of(Arc::clone(quantity))
}

/// A quantity from its lowest value on, where that is far from 0 for its range.
pub(crate) fn from_start(quantity: &Arc<Quantity>) -> (Expression, f64) {
    let low = lowest(&quantity.values);
    if low.abs() < 0.1 * spread(&quantity.values) {
        return (of(quantity), 0.0);
    }
    let low = rounded(low);
    (less(of(quantity), quantity, low), low)
}

/// What is left of a quantity to the end of its range.
pub(crate) fn to_end(quantity: &Arc<Quantity>) -> Expression {
    let end = rounded(lowest(&quantity.values) + spread(&quantity.values));
    Expression::Number(-1.0, Dimension::number()) * less(of(quantity), quantity, end)
}

/// A quantity from the middle of its range on, and that range.
pub(crate) fn about_middle(quantity: &Arc<Quantity>) -> (Expression, f64) {
    let range = spread(&quantity.values);
    let middle = rounded(lowest(&quantity.values) + 0.5 * range);
    (less(of(quantity), quantity, middle), range)
}

/// A quantity about its mean.
pub(crate) fn about_mean(quantity: &Arc<Quantity>) -> Expression {
    less_mean(of(quantity), quantity)
}

/// What is made of a quantity, less that one's mean.
pub(crate) fn less_mean(made: Expression, quantity: &Arc<Quantity>) -> Expression {
    let mean = mean(&quantity.values);
    less(made, quantity, rounded(mean))
}

/// Something in a quantity's unit, less a number in that.
fn less(made: Expression, quantity: &Quantity, by: f64) -> Expression {
    let number = |value| Expression::Number(value, quantity.dimension.clone());
    if by < 0.0 { made + number(-by) } else { made - number(by) }
}

/// A shaft's turns.
pub(crate) fn shaft_turns(turns: &Arc<Quantity>, order: f64) -> Expression {
    if order.to_bits() == 1.0_f64.to_bits() { of(turns) } else { number(order) * of(turns) }
}

pub(crate) fn lowest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Five digits, so that a formula can be read.
fn rounded(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
