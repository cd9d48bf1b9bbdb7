//! Tolerance tables as data: limits by grade, with their source and how far it can be trusted.

use toml_edit::{DocumentMut, Item, Table};

use crate::Error;

/// How far a limit can be trusted; worse is greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Alike in more than one independent place.
    Verified,
    /// One source.
    Medium,
    /// Nothing at hand confirms it.
    Unverified,
}

/// One limit of one grade.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Grade it belongs to.
    pub grade: String,
    /// What it limits: `ep`, `vup`, `v300p`, `v2pip`, `helix-25` …
    pub quantity: String,
    /// How far it can be trusted.
    pub status: Status,
    /// Where it is from.
    pub source: String,
    value: Value,
}

/// A limit's dependence on the useful travel.
#[derive(Clone, Debug, PartialEq)]
enum Value {
    Any(f64),
    ByTravel(Vec<f64>),
    Proportional(f64),
}

/// The limits of one standard.
#[derive(Clone, Debug, PartialEq)]
pub struct ToleranceTable {
    /// Name of the standard.
    pub standard: String,
    /// Grades, the best first.
    pub grades: Vec<String>,
    /// Every limit.
    pub limits: Vec<Limit>,
    up_to_mm: Vec<f64>,
}

/// The table shipped for `iso3408-3` or `jbt2886`.
///
/// # Errors
///
/// When no table has that name.
pub fn built_in_table(standard: &str) -> Result<ToleranceTable, Error> {
    match standard {
        "iso3408-3" => ToleranceTable::parse(include_str!("../../tables/iso3408-3.toml")),
        "jbt2886" => ToleranceTable::parse(include_str!("../../tables/jbt2886.toml")),
        _ => Err(Error::UnknownStandard { found: standard.into() }),
    }
}

impl Status {
    /// As it is written in a table.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::Medium => "medium",
            Self::Unverified => "unverified",
        }
    }
}

impl ToleranceTable {
    /// Reads a table; `tables/iso3408-3.toml` shows and explains the format.
    ///
    /// # Errors
    ///
    /// When the text is not TOML, a key is missing or has the wrong type, a limit names a grade
    /// that is not listed, or limits get tighter towards worse grades.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let document: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| {
            wrong(error.to_string().trim_end().to_owned())
        })?;
        let table = Self {
            standard: string(&document, "standard")?,
            grades: strings(&document, "grades")?,
            up_to_mm: numbers(&document, "useful_travel_up_to_mm")?,
            limits: limits(&document)?,
        };
        table.check_grades()?;
        table.check_order()?;
        Ok(table)
    }

    /// The limit of a quantity for a grade, if the table has a row for it.
    #[must_use]
    pub fn limit(&self, grade: &str, quantity: &str) -> Option<&Limit> {
        self.limits.iter().find(|limit| limit.grade == grade && limit.quantity == quantity)
    }

    /// What a limit allows over a useful travel, µm; `None` beyond the end of its list.
    #[must_use]
    pub fn allowed_um(&self, limit: &Limit, useful_travel_mm: f64) -> Option<f64> {
        match &limit.value {
            Value::Any(um) => Some(*um),
            Value::Proportional(um_per_300_mm) => Some(um_per_300_mm * useful_travel_mm / 300.0),
            Value::ByTravel(um) => {
                let long_enough = |&up_to: &f64| useful_travel_mm <= up_to + super::WINDOW_SLACK_MM;
                um.get(self.up_to_mm.iter().position(long_enough)?).copied()
            }
        }
    }

    /// Refuses a limit of a grade nobody listed.
    fn check_grades(&self) -> Result<(), Error> {
        match self.limits.iter().find(|limit| !self.grades.contains(&limit.grade)) {
            None => Ok(()),
            Some(limit) => Err(Error::UnknownGrade {
                found: limit.grade.clone(),
                expected: self.grades.join(", "),
            }),
        }
    }

    /// Refuses limits that get tighter towards worse grades: grading would not be monotone.
    fn check_order(&self) -> Result<(), Error> {
        let rank = |limit: &Limit| self.grades.iter().position(|grade| *grade == limit.grade);
        for better in &self.limits {
            for worse in self.limits.iter().filter(|worse| worse.quantity == better.quantity) {
                if rank(better) < rank(worse) && self.tighter(worse, better) {
                    return Err(wrong(format!(
                        "`{}` of grade {} is tighter than that of grade {}, expected wider",
                        worse.quantity, worse.grade, better.grade
                    )));
                }
            }
        }
        Ok(())
    }

    fn tighter(&self, worse: &Limit, better: &Limit) -> bool {
        let mut places = self.up_to_mm.iter().map(|&up_to| {
            let (worse, better) = (self.allowed_um(worse, up_to), self.allowed_um(better, up_to));
            worse.zip(better).is_some_and(|(worse, better)| worse < better)
        });
        places.any(|is_tighter| is_tighter)
    }
}

fn wrong(reason: String) -> Error {
    Error::ToleranceTable { reason }
}

fn limits(document: &DocumentMut) -> Result<Vec<Limit>, Error> {
    let rows = document.get("limit").and_then(Item::as_array_of_tables);
    let rows = rows.ok_or_else(|| wrong("no `[[limit]]`, expected one a limit".into()))?;
    rows.iter()
        .enumerate()
        .map(|(index, row)| {
            limit(row).map_err(|error| wrong(format!("`[[limit]]` number {}: {error}", index + 1)))
        })
        .collect()
}

fn limit(row: &Table) -> Result<Limit, Error> {
    let status = match string(row, "status")?.as_str() {
        "verified" => Status::Verified,
        "medium" => Status::Medium,
        "unverified" => Status::Unverified,
        other => {
            return Err(wrong(format!(
                "status `{other}`, expected `verified`, `medium` or `unverified`"
            )));
        }
    };
    let value = if let Some(um) = row.get("um").and_then(positive) {
        Value::Any(um)
    } else if let Some(um) = row.get("um_per_300_mm").and_then(positive) {
        Value::Proportional(um)
    } else {
        Value::ByTravel(numbers(row, "um")?)
    };
    let (grade, quantity) = (string(row, "grade")?, string(row, "quantity")?);
    Ok(Limit { grade, quantity, status, source: string(row, "source")?, value })
}

#[expect(clippy::cast_precision_loss, reason = "limits in µm and lengths in mm are small")]
fn positive(item: &Item) -> Option<f64> {
    item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64)).filter(|x| 0.0 < *x)
}

fn string(table: &Table, key: &str) -> Result<String, Error> {
    let found = table.get(key).and_then(Item::as_str);
    found.map(String::from).ok_or_else(|| wrong(format!("no `{key}`, expected a string")))
}

fn list<'a>(table: &'a Table, key: &str) -> Result<&'a toml_edit::Array, Error> {
    let found = table.get(key).and_then(Item::as_array);
    found.ok_or_else(|| wrong(format!("no `{key}`, expected a list")))
}

fn strings(table: &Table, key: &str) -> Result<Vec<String>, Error> {
    let string = |value: &toml_edit::Value| value.as_str().map(String::from);
    let strings: Option<Vec<String>> = list(table, key)?.iter().map(string).collect();
    strings.ok_or_else(|| wrong(format!("`{key}` holds something else, expected strings")))
}

fn numbers(table: &Table, key: &str) -> Result<Vec<f64>, Error> {
    let element = |value: &toml_edit::Value| positive(&Item::Value(value.clone()));
    let numbers: Option<Vec<f64>> = list(table, key)?.iter().map(element).collect();
    numbers.ok_or_else(|| wrong(format!("`{key}` holds something else, expected numbers above 0")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_tables_are_complete_and_ordered() {
        for standard in ["iso3408-3", "jbt2886"] {
            let table = built_in_table(standard).unwrap();
            for grade in &table.grades {
                assert!(
                    table.limits.iter().any(|limit| limit.grade == *grade),
                    "{standard} {grade}"
                );
            }
        }
    }

    #[test]
    fn travel_picks_its_row() {
        let table = built_in_table("iso3408-3").unwrap();
        let vup = table.limit("3", "vup").unwrap();
        let allowed = |travel_mm| table.allowed_um(vup, travel_mm);
        assert_eq!(
            [allowed(100.0), allowed(315.0), allowed(400.5)],
            [Some(12.0), Some(12.0), Some(13.0)]
        );
        assert_eq!(allowed(4000.1), None);
        let transport = table.limit("7", "ep").unwrap();
        assert_eq!(table.allowed_um(transport, 600.0), Some(208.0));
    }

    #[test]
    fn a_tighter_worse_grade_is_refused() {
        let text = include_str!("../../tables/jbt2886.toml").replace("um = 1.5", "um = 0.5");
        let error = ToleranceTable::parse(&text).unwrap_err().to_string();
        assert!(error.contains("`helix-2pi` of grade 4 is tighter"), "{error}");
    }

    /// Row 1000 mm of the two tables as printed in a maker's catalogue.
    #[test]
    fn one_metre_of_the_ball_screw_table() {
        let table = built_in_table("iso3408-3").unwrap();
        let allowed =
            |grade, quantity| table.allowed_um(table.limit(grade, quantity).unwrap(), 1000.0);
        assert_eq!(
            [allowed("1", "ep"), allowed("3", "ep"), allowed("5", "ep")],
            [Some(11.0), Some(21.0), Some(40.0)]
        );
        assert_eq!(
            [allowed("1", "vup"), allowed("3", "vup"), allowed("5", "vup")],
            [Some(9.0), Some(17.0), Some(34.0)]
        );
    }
}
