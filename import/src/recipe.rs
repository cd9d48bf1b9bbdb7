//! A recipe: every decision about how a file is read, each with its reason.

mod parse;
mod render;

use std::collections::BTreeMap;

use crate::place::Place;

/// A value of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A word.
    Text(String),
    /// A count.
    Whole(i64),
    /// A quantity; the key has its unit.
    Number(f64),
    /// Words.
    List(Vec<String>),
}

/// What kind of value a key takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One of the words listed; any word when the list is empty.
    Text(&'static [&'static str]),
    /// A count between bounds.
    Whole(i64, i64),
    /// A finite number.
    Number,
    /// Words.
    List,
}

/// A key that a recipe may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// The section, such as `text`.
    pub section: &'static str,
    /// The key in it.
    pub name: &'static str,
    /// What it takes.
    pub kind: Kind,
    /// What it decides.
    pub meaning: &'static str,
}

/// Formats that are read.
pub(crate) const FORMATS: &[&str] = &[
    "table",
    "spreadsheet",
    "parquet",
    "npy",
    "npz",
    "arrow",
    "matlab",
    "hdf5",
    "phd2",
    "phd2-debug",
    "eqmod",
    "sigrok",
    "renishaw",
    "iso230",
    "linuxcnc-comp",
    "halsampler",
    "camonitor",
    "twincat",
    "markdown",
];

const fn key(section: &'static str, name: &'static str, kind: Kind, meaning: &'static str) -> Key {
    Key { section, name, kind, meaning }
}

/// Every key, in the order in which recipes are written.
pub const KEYS: &[Key] = &[
    key("file", "format", Kind::Text(FORMATS), "what wrote the file"),
    key("text", "encoding", Kind::Text(&[]), "how bytes become characters (WHATWG names)"),
    key(
        "text",
        "delimiter",
        Kind::Text(&[]),
        "what stands between cells: a character, `tab`, or `blanks`",
    ),
    key("text", "decimal", Kind::Text(&[".", ","]), "the decimal sign"),
    key("sheet", "name", Kind::Text(&[]), "the sheet of the workbook"),
    key(
        "arrays",
        "rows",
        Kind::Whole(2, 1 << 30),
        "how many numbers the arrays have that are columns",
    ),
    key(
        "arrays",
        "unpacked",
        Kind::List,
        "arrays of HDF5 that are multiplied by their `scale_factor`, with `add_offset` added",
    ),
    key("phd2", "axis", Kind::Text(&["ra", "dec"]), "the axis"),
    key(
        "phd2",
        "error",
        Kind::Text(&["unguided", "raw"]),
        "`unguided`: with all pushes before; `raw`: the reading",
    ),
    key(
        "phd2",
        "scale_arcsec",
        Kind::Number,
        "arc seconds of a pixel, where the log is wrong or silent",
    ),
    key("sigrok", "step", Kind::Text(&[]), "the channel whose rising edges are steps"),
    key("sigrok", "direction", Kind::Text(&[]), "the channel that is high forward, or `none`"),
    key("calibration", "unit", Kind::Text(&[]), "the unit of positions"),
    key(
        "calibration",
        "values",
        Kind::Text(&["positions", "trims"]),
        "what stands behind the nominal position",
    ),
    key(
        "calibration",
        "deviation",
        Kind::Text(&["actual-minus-target", "target-minus-actual"]),
        "the sign of a deviation",
    ),
    key(
        "calibration",
        "runs",
        Kind::Text(&["one-way", "there-and-back"]),
        "whether every other run is the way back",
    ),
    key("channels", "clock", Kind::Text(&[]), "the channel whose times count"),
    key("channels", "latency_s", Kind::Number, "how much later the other channel comes"),
    key("markdown", "header", Kind::Text(&[]), "the line of names of the tables that are read"),
    key("halsampler", "period_s", Kind::Number, "from sample to sample: the period of the thread"),
    key("fringes", "wavelength_um", Kind::Number, "wavelength of the light in that air, µm"),
    key("fringes", "second_um", Kind::Number, "wavelength on the second detector, µm"),
    key(
        "fringes",
        "mm_a_unit",
        Kind::Number,
        "travel of one unit of the commanded position or of time, mm",
    ),
    key("table", "preamble", Kind::Whole(0, 1_000_000), "lines above the header that are left out"),
    key("table", "header", Kind::Whole(0, 3), "rows of names and units"),
    key("table", "missing", Kind::List, "words that stand for a missing value"),
    key(
        "table",
        "parentheses",
        Kind::Text(&["negative", "missing"]),
        "what a number in parentheses is",
    ),
    key("table", "period_s", Kind::Number, "from row to row, where no column tells the time"),
    key("table", "date_order", Kind::Text(&["day", "month", "year"]), "what a date begins with"),
    key(
        "table",
        "clock",
        Kind::Text(&["hours", "minutes"]),
        "what a time with one colon begins with",
    ),
    key("table", "zone", Kind::Text(&[]), "the zone of times that name none, such as `+02:00`"),
    key(
        "table",
        "runs",
        Kind::Text(&["one", "columns", "blocks", "sweeps"]),
        "where runs are: `one` table, `columns` side by side, `blocks` one below the other, `sweeps` there and back",
    ),
];

/// A value with the reason for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// What was decided.
    pub value: Value,
    /// Why; empty when a person did.
    pub reason: String,
}

/// What becomes of one column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColumnRule {
    /// Its name in the file.
    pub from: String,
    /// Our name; `none` leaves it out.
    pub to: Option<String>,
    /// Its unit in the file.
    pub unit: Option<String>,
    /// −1 turns the sign.
    pub sign: Option<i64>,
    /// A column subtracted from it first, such as the target: in the unit and with the sign of its own rule.
    pub minus: Option<String>,
    /// A column with the time of day that belongs to a date.
    pub with: Option<String>,
    /// The run it holds, from 1.
    pub pass: Option<i64>,
    /// The direction of that run, +1 or −1.
    pub direction: Option<i64>,
    /// Why.
    pub reason: String,
    /// Where a recipe says so; nowhere when it was found out.
    pub place: Place,
}

/// Every decision about a file; what is not said is found out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recipe {
    /// Settings by section and key.
    pub settings: BTreeMap<(String, String), Setting>,
    /// Columns, in the order of the file.
    pub columns: Vec<ColumnRule>,
}

impl Recipe {
    /// The value of a setting.
    #[must_use]
    pub fn get(&self, section: &str, name: &str) -> Option<&Value> {
        self.settings.get(&(section.to_owned(), name.to_owned())).map(|setting| &setting.value)
    }

    /// Decides a setting.
    pub fn set(&mut self, section: &str, name: &str, value: Value, reason: impl Into<String>) {
        let setting = Setting { value, reason: reason.into() };
        self.settings.insert((section.to_owned(), name.to_owned()), setting);
    }

    /// The rule for a column of the file.
    #[must_use]
    pub fn column(&self, from: &str) -> Option<&ColumnRule> {
        self.columns.iter().find(|rule| rule.from == from)
    }

    /// This recipe with what another one says besides; `other` wins.
    #[must_use]
    pub fn with(mut self, other: &Self) -> Self {
        self.settings.extend(other.settings.clone());
        for rule in &other.columns {
            match self.columns.iter_mut().find(|known| known.from == rule.from) {
                Some(known) => known.take_from(rule),
                None => self.columns.push(rule.clone()),
            }
        }
        self
    }
}

impl ColumnRule {
    /// Takes over whatever another rule for the same column says.
    pub(crate) fn take_from(&mut self, other: &Self) {
        fn take<T: Clone>(mine: &mut Option<T>, other: Option<&T>) {
            if let Some(other) = other {
                *mine = Some(other.clone());
            }
        }
        take(&mut self.to, other.to.as_ref());
        take(&mut self.unit, other.unit.as_ref());
        take(&mut self.sign, other.sign.as_ref());
        take(&mut self.minus, other.minus.as_ref());
        take(&mut self.with, other.with.as_ref());
        take(&mut self.pass, other.pass.as_ref());
        take(&mut self.direction, other.direction.as_ref());
        if !other.reason.is_empty() {
            self.reason.clone_from(&other.reason);
        }
    }
}
