//! The `[[effect]]` tables of a machine file.

use std::borrow::Cow;
use std::sync::Arc;

use super::section::Section;
use crate::custom::Custom;
use crate::error::{EffectError, MachineError};
use crate::machine::Machine;
use crate::measured_curve::MeasuredCurve;
use crate::term::{Formula, Term};
use crate::units::{Dimension, NUMBER};
use crate::{CATALOGUE, Card, Columns, Context, Entry, Parameter, Search};

type Result<T> = std::result::Result<T, MachineError>;

pub(super) fn effects(root: &Section<'_>, machine: &Machine) -> Result<Vec<Term>> {
    root.sections("effect")?.iter().map(|section| effect(section, machine)).collect()
}

fn effect(section: &Section<'_>, machine: &Machine) -> Result<Term> {
    let example = "kind = \"screw-periodic\"";
    match section.text("kind")?.ok_or_else(|| section.missing("kind", example))? {
        "custom" => custom(section),
        "measured-curve" => measured_curve(section, machine),
        kind => match Term::card(kind) {
            Some(card) => from_card(section, machine, card),
            None => Err(section.wrong("kind", &kinds())),
        },
    }
}

/// Every kind there is, as a list for a message.
fn kinds() -> String {
    let kinds: Vec<_> = CATALOGUE.iter().map(|card| card.kind).collect();
    format!("one of {}", kinds.join(", "))
}

fn from_card(section: &Section<'_>, machine: &Machine, card: &'static Card) -> Result<Term> {
    let mut keys = vec!["kind"];
    keys.extend(card.parameters.iter().map(|parameter| parameter.name.as_ref()));
    let by_gear = card.parameters.iter().any(|parameter| parameter.search == Search::GearOrder);
    if by_gear {
        keys.extend(["gear", "mesh"]);
    }
    section.only(&keys)?;
    let mut term = Term::candidate(card);
    for (value, parameter) in term.values.iter_mut().zip(&mut term.parameters) {
        if machine.rotary {
            parameter.unit = parameter.unit.on_rotary_chain();
        }
        *value = if by_gear && parameter.search == Search::GearOrder {
            gear_order(section, machine, parameter)?
        } else {
            value_of(section, parameter)?
        };
    }
    let columns = Columns::new(card.needs.iter().copied());
    term.basis(&Context { machine, columns: &columns })
        .map_err(|reason| refused(section, "kind", reason))?;
    Ok(term)
}

fn refused(section: &Section<'_>, key: &str, reason: EffectError) -> MachineError {
    MachineError::Effect { at: section.value_at(key), reason: Box::new(reason) }
}

fn value_of(section: &Section<'_>, parameter: &Parameter) -> Result<f64> {
    let name = parameter.name.as_ref();
    // Plausible ranges bound a search; what a user states is only held to be a finite number.
    let finite = -1e12..=1e12;
    let whole = parameter.search == Search::Whole;
    let found = match parameter.unit.dimension {
        Dimension::Number if whole => section.number(name, parameter.range.clone())?,
        Dimension::Number => section.number(name, finite)?,
        _ => section.quantity(name, &parameter.unit, finite)?,
    };
    if whole && found.is_some_and(|value| value.fract() != 0.0) {
        return Err(section.wrong(name, "a whole number"));
    }
    found.or(parameter.default).ok_or_else(|| section.missing(name, &example(parameter)))
}

/// A line that sets a parameter to a value from its range.
fn example(parameter: &Parameter) -> String {
    let (low, high) = (*parameter.range.start(), *parameter.range.end());
    let value = if low < 1.0 && 1.0 < high { 1.0 } else { high };
    match parameter.unit.symbol {
        "" => format!("{} = {value}", parameter.name),
        symbol => format!("{} = \"{value} {symbol}\"", parameter.name),
    }
}

/// The order of a gear, named or as a number.
fn gear_order(section: &Section<'_>, machine: &Machine, parameter: &Parameter) -> Result<f64> {
    let mesh = section.flag("mesh")?.unwrap_or_default();
    let Some(name) = section.text("gear")? else {
        return match section.number("order", 1e-6..=1e9)? {
            Some(order) if !mesh => Ok(order),
            Some(_) => Err(section.conflict("mesh", "only a `gear` has teeth that mesh")),
            None => Err(section.missing("gear", &example(parameter))),
        };
    };
    if section.number("order", 1e-6..=1e9)?.is_some() {
        return Err(section.conflict("order", "`gear` already says it"));
    }
    let Some(gear) = machine.gears.iter().find(|gear| gear.name == name) else {
        let names: Vec<_> = machine.gears.iter().map(|gear| gear.name.as_str()).collect();
        return Err(section.wrong("gear", &format!("the name of a [[gear]]: {}", names.join(", "))));
    };
    if !mesh {
        return Ok(gear.order);
    }
    gear.mesh_order().ok_or_else(|| section.conflict("mesh", "the gear has no `teeth`"))
}

fn custom(section: &Section<'_>) -> Result<Term> {
    section.only(&["kind", "name", "entry", "formula", "parameters"])?;
    let name = section.text("name")?.unwrap_or("custom");
    let formula = section.text("formula")?;
    let formula = formula
        .ok_or_else(|| section.missing("formula", "formula = \"a*sin(2*pi*time_s/period)\""))?;
    let (parameters, values) = custom_parameters(section)?;
    let names: Vec<_> = parameters.iter().map(|parameter| parameter.name.to_string()).collect();
    let refuse = |reason| refused(section, "formula", reason);
    let custom = Custom::new(name, formula, &names).map_err(refuse)?;
    let parameters = custom.with_roles(parameters);
    Ok(Term {
        name: name.into(),
        entry: entry(section)?,
        parameters,
        values,
        formula: Formula::Custom(Arc::new(custom)),
    })
}

fn entry(section: &Section<'_>) -> Result<Entry> {
    let words = Entry::ALL.map(Entry::word).join(", ");
    let found =
        section.text("entry")?.ok_or_else(|| section.missing("entry", "entry = \"motion\""))?;
    Entry::ALL
        .into_iter()
        .find(|entry| entry.word() == found)
        .ok_or_else(|| section.wrong("entry", &format!("one of {words}")))
}

fn custom_parameters(section: &Section<'_>) -> Result<(Vec<Parameter>, Vec<f64>)> {
    let Some(table) = section.section("parameters")? else { return Ok((Vec::new(), Vec::new())) };
    let mut parameters = Vec::new();
    let mut values = Vec::new();
    for key in table.keys() {
        let value = table.number(key, -1e12..=1e12)?.unwrap_or_default();
        let reach = 10.0 * value.abs().max(1e-6);
        let mut parameter =
            Parameter::nonlinear("", NUMBER, Search::Linear, "of the user's formula")
                .within(-reach..=reach);
        parameter.name = Cow::Owned(key.into());
        parameters.push(parameter);
        values.push(value);
    }
    Ok((parameters, values))
}

fn measured_curve(section: &Section<'_>, machine: &Machine) -> Result<Term> {
    section.only(&["kind", "file", "scale"])?;
    let file =
        section.text("file")?.ok_or_else(|| section.missing("file", "file = \"curve.csv\""))?;
    let folder = section.source.path.parent().unwrap_or_else(|| std::path::Path::new(""));
    let curve = MeasuredCurve::read(&folder.join(file), file, machine).map_err(|message| {
        MachineError::Companion {
            at: section.value_at("file"),
            key: section.path_of("file").into(),
            found: file.into(),
            message: message.into(),
        }
    })?;
    let scale = section.number("scale", -1e6..=1e6)?.unwrap_or(1.0);
    Ok(Term {
        name: "measured-curve".into(),
        entry: Entry::Motion,
        parameters: vec![MeasuredCurve::SCALE],
        values: vec![scale],
        formula: Formula::Curve(Arc::new(curve)),
    })
}
