//! The columns of one table, and one table after the other.

use helixlock_traces::{Column, Table};

use super::Built;
use super::figures::micro;
use crate::error::{ImportError, quoted};
use crate::rules::{COORDINATES, OBSERVED};

/// Order of our columns in the table; others follow.
const ORDER: [&str; 9] = [
    "time_s",
    "position_mm",
    "angle_rev",
    "error_um",
    "error_arcsec",
    "lead_error_um",
    "steps",
    "pass",
    "direction",
];

/// Ours in their order, then the others as in the file.
pub(super) fn in_order(mut columns: Vec<Column>) -> Vec<Column> {
    let place = |name: &str| ORDER.iter().position(|known| *known == name).unwrap_or(ORDER.len());
    columns.sort_by_key(|column| place(&column.name));
    columns
}

/// What the table cannot do without; `left_out` are columns that could have been it.
pub(crate) fn check(
    columns: &[Column],
    file: &str,
    left_out: &[String],
) -> Result<(), ImportError> {
    let has = |names: &[&str]| {
        columns.iter().any(|column| {
            names.contains(&column.name.as_str())
                && column.values.iter().any(|value| value.is_finite())
        })
    };
    let names: Vec<_> = columns.iter().map(|column| quoted(&column.name)).collect();
    let found = if names.is_empty() {
        "no columns".to_owned()
    } else {
        format!("the columns {}", names.join(", "))
    };
    for wanted in [&OBSERVED[..], &COORDINATES[..]] {
        if !has(wanted) {
            let place = crate::place::Place::file(file);
            let expected = format!("one of `{}`", wanted.join("`, `"));
            return Err(ImportError::found(place, found, expected).hinted(left_out.join("; ")));
        }
    }
    Ok(())
}

/// One table after the other: runs go on counting, times count from the first origin.
pub(crate) fn joined(parts: Vec<Built>) -> Table {
    let origin_s = parts.first().and_then(|part| part.origin_s);
    let several = 1 < parts.len();
    let mut columns: Vec<Column> = Vec::new();
    let (mut rows, mut passes) = (0, 0.0);
    for mut part in parts {
        let count = part.columns.first().map_or(0, |column| column.values.len());
        if several && !part.columns.iter().any(|column| column.name == "pass") {
            part.columns.push(Column { name: "pass".into(), values: vec![1.0; count] });
        }
        let later_s = origin_s.zip(part.origin_s).map_or(0.0, |(first, own)| own - first);
        let mut most = passes;
        for column in part.columns {
            let shift = match column.name.as_str() {
                "pass" => passes,
                "time_s" => later_s,
                _ => 0.0,
            };
            let at =
                columns.iter().position(|known| known.name == column.name).unwrap_or_else(|| {
                    columns
                        .push(Column { name: column.name.clone(), values: vec![f64::NAN; rows] });
                    columns.len() - 1
                });
            let exact = shift.abs() <= 0.0;
            columns[at].values.extend(
                column.values.iter().map(|value| if exact { *value } else { micro(value + shift) }),
            );
            if column.name == "pass" {
                most = columns[at]
                    .values
                    .iter()
                    .copied()
                    .filter(|value| value.is_finite())
                    .fold(most, f64::max);
            }
        }
        rows += count;
        passes = most;
        for column in &mut columns {
            column.values.resize(rows, f64::NAN);
        }
    }
    Table::new(in_order(columns))
}
