//! Units of logged columns and of the coordinates.

use helixlock_plant::{
    CATALOGUE, Card, Columns, HeaderUnit, LOGGED_COLUMNS, LoggedColumn, Role, Setting, Term,
};

use super::doubt::{of_pass_read, recipe};
use super::hypothesis::{Hypothesis, Words};
use super::law::{follows_from_clock, usualness};
use crate::measurement::Measurement;
use crate::model::Problem;

const TIME: &str = "time_s";
const POSITION: &str = "position_mm";
const ANGLE: &str = "angle_rev";

/// Places that are counted in other steps than one thinks: a mirror that is passed twice, a decimal point.
pub(super) const STEPS: [f64; 4] = [10.0, 0.1, 2.0, 0.5];

/// Another unit of a column.
struct Other {
    /// What is said of the column, behind its name.
    says: String,
    /// As a recipe writes it.
    unit: String,
    /// Value · factor + zero is that in the column's own.
    factor: f64,
    zero: f64,
}

/// Every unit that a column of the data may have been written in, all of it or the odd pass.
pub(super) fn units(problem: &Problem, odd: Option<usize>) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for column in LOGGED_COLUMNS.iter().filter(|column| is_there(problem, column)) {
        let known = known_units(column);
        for unit in known.iter().chain(&steps(column)) {
            all.extend(hypotheses(problem, column, unit));
        }
        // A clock that runs on has no unit of a pass.
        for pass in odd.into_iter().filter(|_| column.name != TIME) {
            all.extend(known.iter().filter_map(|unit| in_a_pass(problem, column, unit, pass)));
        }
    }
    all
}

fn known_units(column: &'static LoggedColumn) -> Vec<Other> {
    let unit = |(word, factor, zero): &HeaderUnit| {
        let says = format!("is in {word}, not in {}", column.units[0].0);
        Other { says, unit: (*word).to_owned(), factor: *factor, zero: *zero }
    };
    others(column).into_iter().map(unit).collect()
}

fn steps(column: &LoggedColumn) -> Vec<Other> {
    let step = |step: &f64| {
        let unit = format!("{step} {}", column.units[0].0);
        let or = format!("or the leads and gears of the file are {step} times the true ones");
        let says = format!("is written in units of {unit}, {or}");
        Other { says, unit, factor: *step, zero: 0.0 }
    };
    STEPS.iter().filter(|_| is_place(column)).map(step).collect()
}

/// Columns whose sign is a convention and may be the other one, in all or in the odd pass.
pub(super) fn signs(problem: &Problem, odd: Option<usize>) -> Vec<Hypothesis> {
    let logged = LOGGED_COLUMNS.iter().filter(|column| is_there(problem, column));
    let of = |column: &&LoggedColumn| {
        is_place(column) || column.setting.as_ref().is_some_and(Setting::has_either_sign)
    };
    let turned = logged.filter(of).flat_map(|column| {
        let says = format!("`{}` has the opposite sign", column.name);
        let measurement = &problem.measurement;
        let mended = match column.name {
            POSITION | ANGLE => measurement.turned(),
            name => converted(problem, name, |value| -value),
        };
        let mend = recipe(column.name, "sign = -1");
        let of_pass = odd.and_then(|pass| {
            let name = measurement.pass_names[pass];
            let says = format!("`{}` of pass {name} has the opposite sign", column.name);
            let mend = of_pass_read(column.name, name, "sign = -1");
            of_a_pass(problem, mended.clone(), pass, ("sign", says, mend))
        });
        let of_all = Hypothesis::of_measurement(problem, &mended, ("sign", says, mend));
        of_all.into_iter().chain(of_pass)
    });
    turned.collect()
}

/// A mistake in one pass of a measurement that is mended in all.
fn of_a_pass(
    problem: &Problem,
    mended: Measurement,
    pass: usize,
    words: Words,
) -> Option<Hypothesis> {
    let own: Vec<bool> = problem.measurement.pass.iter().map(|of| *of == pass).collect();
    let alone = |measurement: &Measurement| {
        let mut alone = measurement.clone();
        alone.keep(&own);
        usualness(&alone, &problem.model)
    };
    // Rows that come to weigh less in a median make no other pass more usual.
    let usual = alone(&mended) - alone(&problem.measurement);
    let mixed = problem.measurement.with_pass_of(mended, pass);
    let one = Hypothesis::of_measurement(problem, &mixed, words)?;
    Some(Hypothesis { pass: Some(pass), usual, ..one })
}

/// Units with another factor or zero than that of the column, each once.
pub(super) fn others(column: &'static LoggedColumn) -> Vec<&'static HeaderUnit> {
    let mut others: Vec<&HeaderUnit> = Vec::new();
    let alike = |one: &HeaderUnit, other: &HeaderUnit| {
        one.1.to_bits() == other.1.to_bits() && one.2.to_bits() == other.2.to_bits()
    };
    for unit in column.units.iter().filter(|unit| !alike(unit, &column.units[0])) {
        if !others.iter().any(|known| alike(known, unit)) {
            others.push(unit);
        }
    }
    others
}

fn is_place(column: &LoggedColumn) -> bool {
    matches!(column.name, POSITION | ANGLE)
}

/// True for a log, and for a coordinate that does not follow from another one.
fn is_there(problem: &Problem, column: &LoggedColumn) -> bool {
    let measurement = &problem.measurement;
    let derived = follows_from_clock(measurement, &problem.model);
    match column.name {
        TIME => measurement.timed,
        POSITION => !measurement.rotary && !derived,
        ANGLE => measurement.rotary && !derived,
        "speed_rpm" => measurement.told.speed && measurement.timed && !derived,
        name => measurement.covariates.contains_key(name),
    }
}

fn hypotheses(problem: &Problem, column: &'static LoggedColumn, unit: &Other) -> Vec<Hypothesis> {
    let says = format!("`{}` {}", column.name, unit.says);
    let mend = recipe(column.name, &unit.how());
    let mended = converted(problem, column.name, |value| unit.factor * value + unit.zero);
    let sets = std::iter::once(Vec::new()).chain(physics(problem, &[column.name]));
    sets.filter_map(|more| {
        Hypothesis::with(problem, &mended, &more, ("unit", says.clone(), mend.clone()))
    })
    .collect()
}

/// The mistake in one pass of a column.
fn in_a_pass(
    problem: &Problem,
    column: &'static LoggedColumn,
    unit: &Other,
    pass: usize,
) -> Option<Hypothesis> {
    let all = converted(problem, column.name, |value| unit.factor * value + unit.zero);
    let name = problem.measurement.pass_names[pass];
    let says = format!("`{}` of pass {name} {}", column.name, unit.says);
    let mend = of_pass_read(column.name, name, &unit.how());
    of_a_pass(problem, all, pass, ("unit", says, mend))
}

impl Other {
    fn how(&self) -> String {
        format!("unit = \"{}\"", self.unit)
    }
}

fn converted(problem: &Problem, column: &str, by: impl Fn(f64) -> f64) -> Measurement {
    let mut mended = problem.measurement.clone();
    let samples = &mut mended.samples;
    let convert = |values: &mut Vec<f64>| {
        for value in values {
            *value = by(*value);
        }
    };
    match column {
        "speed_rpm" => convert(&mut samples.speed_rpm),
        TIME if !follows_from_clock(&problem.measurement, &problem.model) => {
            convert(&mut samples.time_s);
        }
        TIME | POSITION | ANGLE => {
            if column == TIME {
                convert(&mut samples.time_s);
            }
            convert(&mut samples.position_mm);
            convert(&mut samples.angle_rev);
        }
        name => samples.covariates.get_mut(name).into_iter().for_each(|values| convert(values)),
    }
    mended
}

/// Effects of known size that a file does not know yet and some columns would have: all together,
/// and those of one column alone where others are logged too.
pub(super) fn physics(problem: &Problem, columns: &[&str]) -> Vec<Vec<Term>> {
    let all = all_physics(problem);
    let own = |term: &&Term| term.needs().iter().any(|need| columns.contains(need));
    let alone: Vec<Term> = all.iter().filter(own).cloned().collect();
    if alone.is_empty() {
        return Vec::new();
    }
    let more = (alone.len() < all.len()).then_some(all);
    std::iter::once(alone).chain(more).collect()
}

/// Every effect of known size that the data would show and the file does not have.
pub(super) fn all_physics(problem: &Problem) -> Vec<Term> {
    let cards = CATALOGUE.iter().filter(|card| known(problem, card));
    cards.map(|card| Term::candidate(card, problem.model.rotary)).collect()
}

fn known(problem: &Problem, card: &'static Card) -> bool {
    let record: &Columns = &problem.record.columns;
    card.candidate
        && card.parameters.iter().any(|what| matches!(what.role, Role::Known { .. }))
        && card.needs.iter().all(|need| record.has(need))
        && problem.sees(card.entry)
        && problem.model.lacks(card.parts).is_none()
        && problem.model.effects.iter().all(|term| term.kind() != card.kind)
}
