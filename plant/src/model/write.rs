//! A machine file as text that can be changed without losing its comments and its order.

use std::path::{Path, PathBuf};

use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value, value};

use super::Model;
use super::section::Source;
use helixlock_traces::{At, read_bytes};

use crate::error::MachineError;
use crate::machine::Machine;
use crate::term::{Formula, Term};

/// A model together with the text it came from.
///
/// Every change is made in the text and read again, so that [`Self::model`] is always what the
/// text says.
#[derive(Clone, Debug)]
pub struct MachineFile {
    /// What the text says.
    pub model: Model,
    path: PathBuf,
    document: DocumentMut,
}

/// Longest machine file, bytes; those of the examples have a thousand.
const LONGEST_BYTES: u64 = 8 << 20;

impl MachineFile {
    /// Reads a machine file.
    ///
    /// # Errors
    ///
    /// [`MachineError`] with the place of everything that is wrong.
    pub fn read(path: &Path) -> Result<Self, MachineError> {
        Self::read_with_text(path).map(|(file, _)| file)
    }

    /// Reads a machine file, and gives its text as it stood there.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn read_with_text(path: &Path) -> Result<(Self, String), MachineError> {
        let bytes = read_bytes(path, LONGEST_BYTES)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + good.iter().fold(0, |lines, byte| lines + usize::from(*byte == b'\n'));
            MachineError::Encoding { path: path.into(), line }
        })?;
        Ok((Self::parse(text.strip_prefix('\u{feff}').unwrap_or(&text), path)?, text))
    }

    /// Reads the text of a machine file; see [`Model::parse`].
    ///
    /// # Errors
    ///
    /// [`MachineError`] with the place of everything that is wrong.
    pub fn parse(text: &str, path: &Path) -> Result<Self, MachineError> {
        Self::parse_source(Source { path, text, behind: None })
    }

    fn parse_source(source: Source<'_>) -> Result<Self, MachineError> {
        let model = Model::parse_source(source)?;
        let document = source.text.parse().map_err(|error: toml_edit::TomlError| {
            MachineError::Syntax { at: source.at(error.span()), message: error.message().into() }
        })?;
        Ok(Self { model, path: source.path.into(), document })
    }

    /// The text, as it would be written to a file.
    #[must_use]
    pub fn text(&self) -> String {
        self.document.to_string()
    }

    /// The file with one more effect at its end, or with one in the place of another.
    ///
    /// # Errors
    ///
    /// [`MachineError`] when the machine cannot carry the effect.
    pub fn with_effect(&self, term: &Term) -> Result<Self, MachineError> {
        if let Some(place) = term.instead_of {
            return self.with_values(place, term);
        }
        let mut document = self.document.clone();
        effect_tables(&mut document).push(effect_table(&self.model, term));
        self.reread(document)
    }

    /// The file with the tables of another one behind it, such as a user's own `[[effect]]`.
    ///
    /// # Errors
    ///
    /// [`MachineError`] with its place in the file that is wrong.
    pub fn with_text(&self, toml: &str, path: &Path) -> Result<Self, MachineError> {
        let mut document = self.document.clone();
        if document.contains_key("effect") {
            effect_tables(&mut document);
        }
        let own = format!("{document}\n");
        let text = format!("{own}{toml}");
        let behind = Some((own.len(), path));
        Self::parse_source(Source { path: &self.path, text: &text, behind })
    }

    /// The file with other values in one of its effects, counted from 0.
    ///
    /// Comments stay; a gear that was named keeps its name while its order is the same.
    ///
    /// # Errors
    ///
    /// [`MachineError::NoSuchEffect`] when there are fewer effects.
    pub fn with_values(&self, index: usize, term: &Term) -> Result<Self, MachineError> {
        let before = self.model.effects.get(index).ok_or_else(|| self.no_such_effect(index))?;
        let mut document = self.document.clone();
        let table = effect_tables(&mut document)
            .get_mut(index)
            .ok_or_else(|| self.no_such_effect(index))?;
        set_values(table, before, term);
        self.reread(document)
    }

    /// The file without one of its effects, counted from 0.
    ///
    /// # Errors
    ///
    /// [`MachineError::NoSuchEffect`] when there are fewer effects.
    pub fn without_effect(&self, index: usize) -> Result<Self, MachineError> {
        if self.model.effects.len() <= index {
            return Err(self.no_such_effect(index));
        }
        let mut document = self.document.clone();
        effect_tables(&mut document).remove(index);
        self.reread(document)
    }

    /// The file with another value for a key such as `spindle.speed`; the value is TOML text.
    ///
    /// Effects and gears are counted from 0: `effect.1.amplitude`. A section that is not there is
    /// made.
    ///
    /// # Errors
    ///
    /// [`MachineError`] when there is no such place, or the new text is no longer a machine file.
    pub fn with_setting(&self, key: &str, toml: &str) -> Result<Self, MachineError> {
        let new: Value =
            toml.parse().map_err(|error: toml_edit::TomlError| MachineError::Value {
                at: At::file(&self.path),
                key: key.into(),
                found: format!("`{toml}`").into(),
                expected: format!("a TOML value ({})", error.message()).into(),
            })?;
        let mut document = self.document.clone();
        let mut item: &mut Item = document.as_item_mut();
        for word in key.split('.') {
            item = below(item, word).ok_or_else(|| MachineError::NoSuchKey {
                path: self.path.clone(),
                key: key.into(),
                word: word.into(),
            })?;
        }
        replace_value(item, new);
        self.reread(document)
    }

    fn reread(&self, document: DocumentMut) -> Result<Self, MachineError> {
        let model = Model::parse(&document.to_string(), &self.path)?;
        Ok(Self { model, path: self.path.clone(), document })
    }

    fn no_such_effect(&self, index: usize) -> MachineError {
        MachineError::NoSuchEffect {
            path: self.path.clone(),
            index: index + 1,
            count: self.model.effects.len(),
        }
    }
}

/// What a word of a key names: an entry of an array by its number, else a key, made when missing.
fn below<'i>(item: &'i mut Item, word: &str) -> Option<&'i mut Item> {
    if let Ok(index) = word.parse::<usize>() {
        return item.get_mut(index);
    }
    if item.is_none() {
        *item = Item::Table(Table::new());
    }
    Some(item.as_table_like_mut()?.entry(word).or_insert(Item::None))
}

/// The array `[[effect]]`, made when there is none; an inline array becomes tables.
fn effect_tables(document: &mut DocumentMut) -> &mut ArrayOfTables {
    if let Some((mut key, item)) = document.get_key_value_mut("effect")
        && !item.is_array_of_tables()
    {
        key.leaf_decor_mut().clear();
        let taken = std::mem::take(item);
        *item = taken.into_array_of_tables().map_or_else(|other| other, Item::ArrayOfTables);
    }
    let item =
        document.entry("effect").or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    match item {
        Item::ArrayOfTables(tables) => tables,
        _ => unreachable!("reading refused an `effect` that is no array of tables"),
    }
}

/// A new `[[effect]]`.
fn effect_table(machine: &Machine, term: &Term) -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    table["kind"] = value(term.kind());
    match &term.formula {
        Formula::Custom(custom) => {
            table["name"] = value(&term.name);
            table["entry"] = value(term.entry.word());
            table["formula"] = value(custom.formula());
            let pairs = term.parameters.iter().zip(&term.values);
            let parameters: InlineTable =
                pairs.map(|(parameter, number)| (parameter.name.as_ref(), *number)).collect();
            table["parameters"] = value(parameters);
        }
        Formula::Curve(curve) => {
            table["file"] = value(curve.file());
            table["scale"] = value(term.values[0]);
        }
        Formula::Card(_) => write_card_values(machine, term, &mut table),
    }
    table
}

/// Parameters of a catalogue effect; an order that belongs to a gear is written as the gear.
fn write_card_values(machine: &Machine, term: &Term, table: &mut Table) {
    for (parameter, number) in term.parameters.iter().zip(&term.values) {
        let by_gear = parameter.search == crate::Search::GearOrder;
        if let Some((gear, mesh)) = gear_of(machine, *number).filter(|_| by_gear) {
            table["gear"] = value(gear);
            if mesh {
                table["mesh"] = value(true);
            }
            continue;
        }
        table[parameter.name.as_ref()] = quantity(&parameter.unit, *number);
    }
}

/// The gear whose shaft or mesh has exactly this order.
fn gear_of(machine: &Machine, order: f64) -> Option<(&str, bool)> {
    let same = |other: f64| other.to_bits() == order.to_bits();
    machine.gears.iter().find_map(|gear| {
        let mesh = gear.mesh_order().is_some_and(same);
        (same(gear.order) || mesh).then_some((gear.name.as_str(), mesh && !same(gear.order)))
    })
}

/// Writes the values that have changed.
fn set_values(table: &mut Table, before: &Term, after: &Term) {
    for (index, parameter) in after.parameters.iter().enumerate() {
        let number = after.values[index];
        if before.values[index].to_bits() == number.to_bits() {
            continue;
        }
        let name = parameter.name.as_ref();
        if matches!(after.formula, Formula::Custom(_)) {
            replace_value(&mut table["parameters"][name], Value::from(number));
            continue;
        }
        if parameter.search == crate::Search::GearOrder {
            table.remove("gear");
            table.remove("mesh");
        }
        if let Ok(new) = quantity(&parameter.unit, number).into_value() {
            replace_value(&mut table[name], new);
        }
    }
}

/// Puts another value where one stands, with the comment and spaces around it.
fn replace_value(item: &mut Item, mut new: Value) {
    if let Some(old) = item.as_value() {
        *new.decor_mut() = old.decor().clone();
    }
    *item = Item::Value(new);
}

/// A number with its unit, as a machine file writes it.
fn quantity(unit: &crate::units::Unit, number: f64) -> Item {
    #[expect(clippy::cast_possible_truncation, reason = "only whole numbers of moderate size")]
    match unit.symbol {
        "" if number.fract() == 0.0 && number.abs() < 1e15 => value(number as i64),
        "" => value(number),
        symbol => value(format!("{number} {symbol}")),
    }
}
