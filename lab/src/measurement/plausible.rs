//! Readings that no sensor in its own unit can show.

use helixlock_plant::{LOGGED_COLUMNS, LoggedColumn};
use helixlock_traces::Table;

use super::error::LabError;
use crate::policy::reading::KELVIN;

const KELVIN_HINT: &str = "\n\nhint: if these are kelvin, name the column so, as in \
                           `air temperature [K]`, or take 273.15 off";

/// Refuses the first impossible reading, and temperatures that look like kelvin.
pub(super) fn check(table: &Table) -> Result<(), LabError> {
    let limited = LOGGED_COLUMNS.iter().filter_map(|of| Some((of, of.readable.as_ref()?)));
    for (LoggedColumn { name, .. }, (possible, expected)) in limited {
        let Some(values) = table.column(name) else { continue };
        let there = || values.iter().enumerate().filter(|(_, value)| value.is_finite());
        let refused = |(row, value): (usize, &f64), expected, hint| {
            Err(LabError::Cell {
                at: Box::new(table.at(row)),
                row: row + 1,
                column: (*name).to_owned(),
                found: *value,
                expected,
                hint,
            })
        };
        if let Some(cell) = there().find(|(_, value)| !possible.contains(*value)) {
            return refused(cell, expected, "");
        }
        let kelvin = name.ends_with("_c") && there().all(|(_, value)| KELVIN.contains(value));
        if let Some(cell) = there().next().filter(|_| kelvin) {
            return refused(cell, "a temperature in °C", KELVIN_HINT);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use helixlock_traces::csv::read_csv;

    use super::*;

    fn message(column: &str, values: &[f64]) -> Option<String> {
        let rows: Vec<String> = values.iter().map(|value| format!("0,{value}\n")).collect();
        let text = format!("# a log\ntime_s,{column}\n{}", rows.concat());
        let table = read_csv(text.as_bytes(), Path::new("data.csv")).expect("a table");
        check(&table).err().map(|error| error.to_string())
    }

    #[test]
    fn what_no_sensor_can_show_is_refused_with_its_place() {
        let cold = "data.csv:4: column `air_temperature_c`: found `-300`, expected a temperature \
                    in °C, above −273.15";
        assert_eq!(message("air_temperature_c", &[20.0, -300.0]).as_deref(), Some(cold));
        let vacuum =
            "data.csv:3: column `air_pressure_hpa`: found `0`, expected a pressure in hPa, above 0";
        assert_eq!(message("air_pressure_hpa", &[0.0, 1013.0]).as_deref(), Some(vacuum));
        let wet = "data.csv:4: column `humidity_pct`: found `120`, expected a relative humidity \
                   in %, 0 to 100";
        assert_eq!(message("humidity_pct", &[50.0, 120.0]).as_deref(), Some(wet));
    }

    #[test]
    fn kelvin_is_guessed_only_where_nothing_else_is_left() {
        let refused = message("workpiece_temperature_c", &[293.1, 294.0]).expect("kelvin");
        let start = "data.csv:3: column `workpiece_temperature_c`: found `293.1`, expected a \
                     temperature in °C\n\nhint: if these are kelvin";
        assert!(refused.starts_with(start), "{refused}");
        assert_eq!(message("workpiece_temperature_c", &[20.0, 294.0]), None);
        assert_eq!(message("humidity_pct", &[100.4, -0.3]), None);
        assert_eq!(message("air_temperature_c", &[-273.15, 20.0]), None);
    }

    #[test]
    fn a_file_without_lines_has_rows() {
        let values = vec![20.0, -400.0];
        let column = helixlock_traces::Column { name: "bed_temperature_c".to_owned(), values };
        let mut table = Table::new(vec![column]);
        table.path = "data.parquet".into();
        let message = check(&table).expect_err("too cold").to_string();
        assert!(message.starts_with("data.parquet: row 2: column `bed_temp"), "{message}");
    }
}
