//! Units of logged columns and of the coordinates.

use helixlock_plant::{
    CATALOGUE, Card, Columns, HeaderUnit, LOGGED_COLUMNS, LoggedColumn, Role, Setting, Term,
};

use super::doubt::recipe;
use super::hypothesis::Hypothesis;
use super::law::follows_from_clock;
use crate::measurement::Measurement;
use crate::model::Problem;

const POSITION: &str = "position_mm";

/// Every unit that a column of the data may have been written in.
pub(super) fn units(problem: &Problem) -> Vec<Hypothesis> {
    let logged = LOGGED_COLUMNS.iter().filter(|column| is_there(problem, column));
    let of = |column: &'static LoggedColumn| {
        let others = others(column);
        others.into_iter().flat_map(move |unit| hypotheses(problem, column, unit))
    };
    logged.flat_map(of).collect()
}

/// Columns whose sign is a convention and may be the other one.
pub(super) fn signs(problem: &Problem) -> Vec<Hypothesis> {
    let logged = LOGGED_COLUMNS.iter().filter(|column| is_there(problem, column));
    let of = |column: &&LoggedColumn| {
        column.name == POSITION || column.setting.as_ref().is_some_and(Setting::has_either_sign)
    };
    let turned = logged.filter(of).filter_map(|column| {
        let says = format!("`{}` has the opposite sign", column.name);
        let measurement = &problem.measurement;
        let mended = match column.name {
            POSITION => measurement.turned(),
            name => converted(measurement, name, &("", -1.0, 0.0)),
        };
        let mend = recipe(column.name, "sign = -1");
        Hypothesis::of_measurement(problem, &mended, ("sign", says, mend))
    });
    turned.collect()
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

/// True for a log, and for a coordinate that does not follow from another one.
fn is_there(problem: &Problem, column: &LoggedColumn) -> bool {
    let measurement = &problem.measurement;
    let derived = follows_from_clock(measurement, &problem.model);
    match column.name {
        "time_s" => measurement.timed,
        POSITION => !measurement.rotary && !derived,
        "speed_rpm" => measurement.told.speed && measurement.timed && !derived,
        name => measurement.covariates.contains_key(name),
    }
}

fn hypotheses(
    problem: &Problem,
    column: &'static LoggedColumn,
    unit: &HeaderUnit,
) -> Vec<Hypothesis> {
    let (word, ..) = unit;
    let says = format!("`{}` is in {word}, not in {}", column.name, column.units[0].0);
    let mend = recipe(column.name, &format!("unit = \"{word}\""));
    let mended = converted(&problem.measurement, column.name, unit);
    let sets = std::iter::once(Vec::new()).chain(physics(problem, &[column.name]));
    sets.filter_map(|more| {
        Hypothesis::with(problem, &mended, &more, ("unit", says.clone(), mend.clone()))
    })
    .collect()
}

fn converted(measurement: &Measurement, column: &str, unit: &HeaderUnit) -> Measurement {
    let (_, factor, offset) = unit;
    let mut mended = measurement.clone();
    let samples = &mut mended.samples;
    let convert = |values: &mut Vec<f64>| {
        for value in values {
            *value = factor * *value + offset;
        }
    };
    match column {
        "speed_rpm" => convert(&mut samples.speed_rpm),
        "time_s" => convert(&mut samples.time_s),
        POSITION => {
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
