//! The `[[effect]]` tables of a machine file.

use std::sync::Arc;

use super::keys;
use super::parts::Chain;
use super::section::Section;
use crate::error::{EffectError, MachineError};
use crate::machine::Machine;
use crate::measured_curve::MeasuredCurve;
use crate::nearest::one_of;
use crate::term::{Formula, Term};
use crate::units::Dimension;
use crate::{CATALOGUE, Card, Columns, Context, Entry, Parameter, Search};

/// The effects; complaints about them do not wait for a machine that is whole.
pub(super) fn effects(
    root: &Section<'_>,
    chain: &Chain,
    machine: Option<&Machine>,
) -> Option<Vec<Term>> {
    let terms = root.sections(keys::EFFECT).into_iter().map(|section| {
        let reader = Reader { section, chain, machine };
        reader.effect()
    });
    // All of them, before the first that is wrong ends it.
    terms.collect::<Vec<_>>().into_iter().collect()
}

/// One `[[effect]]` under reading.
struct Reader<'a> {
    section: Section<'a>,
    chain: &'a Chain,
    machine: Option<&'a Machine>,
}

impl Reader<'_> {
    fn effect(&self) -> Option<Term> {
        let section = &self.section;
        if !section.has("kind") {
            return section.refuse(section.missing("kind", "kind = \"screw-periodic\""));
        }
        match section.text("kind")? {
            "custom" => custom(section),
            "measured-curve" => self.measured_curve(),
            kind => match Term::card(kind) {
                Some(card) => self.of_card(card),
                None => section.refuse(section.wrong("kind", &kinds(kind))),
            },
        }
    }

    fn of_card(&self, card: &'static Card) -> Option<Term> {
        let section = &self.section;
        let mut keys = vec!["kind"];
        keys.extend(card.parameters.iter().map(|parameter| parameter.name.as_ref()));
        let by_gear = |what: &Parameter| what.search == Search::GearOrder;
        if card.parameters.iter().any(by_gear) {
            keys.extend(["gear", "mesh"]);
        }
        section.only(&keys);
        let mut term = Term::candidate(card, self.chain.rotary);
        let read =
            |what| if by_gear(what) { self.gear_order(what) } else { value_of(section, what) };
        let values: Vec<Option<f64>> = term.parameters.iter().map(read).collect();
        term.values = values.into_iter().collect::<Option<_>>()?;
        let Some(machine) = self.machine else { return Some(term) };
        let columns = Columns::new(card.needs.iter().copied());
        match term.basis(&Context { machine, columns: &columns }) {
            Ok(_) => Some(term),
            Err(reason) => refused(section, "kind", reason),
        }
    }

    /// The order of a gear, named or as a number.
    fn gear_order(&self, parameter: &Parameter) -> Option<f64> {
        let section = &self.section;
        let mesh = section.flag("mesh").unwrap_or_default();
        let order = section.number("order", 1e-6..=1e9);
        if !section.has("gear") {
            return match order {
                Some(order) if !mesh => Some(order),
                Some(_) => {
                    section.refuse(section.conflict("mesh", "only a `gear` has teeth that mesh"))
                }
                None if section.has("order") => None,
                None => section.refuse(section.missing("gear", &example(parameter))),
            };
        }
        let name = section.text("gear")?;
        if section.has("order") {
            return section.refuse(section.conflict("order", "`gear` already says it"));
        }
        let Some(gear) = self.chain.gears.iter().find(|gear| gear.name == name) else {
            let names: Vec<_> = self.chain.gears.iter().map(|gear| gear.name.as_str()).collect();
            let expected = format!("the name of a [[gear]]: {}", names.join(", "));
            return section.refuse(section.wrong("gear", &expected));
        };
        if !mesh {
            return Some(gear.order);
        }
        let refuse = || section.refuse(section.conflict("mesh", "the gear has no `teeth`"));
        gear.mesh_order().or_else(refuse)
    }

    fn measured_curve(&self) -> Option<Term> {
        let section = &self.section;
        section.only(&["kind", "file", "scale"]);
        let scale = section.number("scale", -1e6..=1e6).unwrap_or(1.0);
        if !section.has("file") {
            return section.refuse(section.missing("file", "file = \"curve.csv\""));
        }
        let (file, machine) = (section.text("file")?, self.machine?);
        let folder = section.source.path.parent().unwrap_or_else(|| std::path::Path::new(""));
        match MeasuredCurve::read(folder, file, machine) {
            Ok(curve) => Some(Term {
                name: "measured-curve".into(),
                entry: Entry::Motion,
                parameters: vec![MeasuredCurve::SCALE],
                values: vec![scale],
                formula: Formula::Curve(Arc::new(curve)),
                instead_of: None,
            }),
            Err(message) => section.refuse(MachineError::Companion {
                at: section.value_at("file"),
                key: section.path_of("file").into(),
                found: file.into(),
                message: message.into(),
            }),
        }
    }
}

/// Every kind there is, as a list for a message, the nearest to what was found first.
fn kinds(found: &str) -> String {
    one_of(found, &CATALOGUE.iter().map(|card| card.kind).collect::<Vec<_>>())
}

fn refused<T>(section: &Section<'_>, key: &str, reason: EffectError) -> Option<T> {
    section.refuse(MachineError::Effect { at: section.value_at(key), reason: Box::new(reason) })
}

fn value_of(section: &Section<'_>, parameter: &Parameter) -> Option<f64> {
    let name = parameter.name.as_ref();
    // Plausible ranges bound a search; what a user states is only held to be a finite number, and a width,
    // a frequency or a time above 0, as there is none below.
    let finite = -1e12..=1e12;
    let whole = parameter.is_whole();
    let found = match parameter.unit.dimension {
        Dimension::Number if whole => section.number(name, parameter.range.clone()),
        Dimension::Number => section.number(name, finite),
        _ => section.quantity(name, &parameter.unit, finite),
    };
    if whole && found.is_some_and(|value| value.fract() != 0.0) {
        return section.refuse(section.wrong(name, "a whole number"));
    }
    if 0.0 < *parameter.range.start() && found.is_some_and(|value| value <= 0.0) {
        return section.refuse(section.wrong(name, "more than 0"));
    }
    if section.has(name) {
        return found;
    }
    parameter.default.or_else(|| section.refuse(section.missing(name, &example(parameter))))
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

fn custom(section: &Section<'_>) -> Option<Term> {
    section.only(&["kind", "name", "entry", "formula", "parameters"]);
    let name = section.text("name").unwrap_or("custom");
    let (entry, parameters) = (entry(section), custom_parameters(section));
    if !section.has("formula") {
        let example = "formula = \"a*sin(2*pi*time_s/period)\"";
        return section.refuse(section.missing("formula", example));
    }
    let (formula, (parameters, values)) = (section.text("formula")?, parameters?);
    match Term::custom(name, entry?, formula, parameters, values) {
        Ok(term) => Some(term),
        Err(reason) => refused(section, "formula", reason),
    }
}

fn entry(section: &Section<'_>) -> Option<Entry> {
    if !section.has("entry") {
        return section.refuse(section.missing("entry", "entry = \"motion\""));
    }
    let found = section.text("entry")?;
    let entry = Entry::ALL.into_iter().find(|entry| entry.word() == found);
    entry.or_else(|| {
        section.refuse(section.wrong("entry", &one_of(found, &Entry::ALL.map(Entry::word))))
    })
}

fn custom_parameters(section: &Section<'_>) -> Option<(Vec<Parameter>, Vec<f64>)> {
    if !section.has("parameters") {
        return Some((Vec::new(), Vec::new()));
    }
    let (mut parameters, mut values) = (Vec::new(), Vec::new());
    let table = section.section("parameters")?;
    for key in table.keys() {
        let value = table.number(key, -1e12..=1e12);
        parameters.push(Parameter::of_formula(key.into(), value.unwrap_or_default()));
        values.push(value);
    }
    Some((parameters, values.into_iter().collect::<Option<_>>()?))
}
