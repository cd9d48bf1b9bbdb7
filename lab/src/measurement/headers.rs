//! Column names as instruments write them, such as `Position [m]`, in the names and units used here.
//!
//! Only what is unambiguous is taken: a known quantity **and** a known unit. A name that is already
//! one of ours is left alone.

use helixlock_plant::{HeaderUnit, LOGGED_COLUMNS, LoggedColumn};
use helixlock_traces::Table;

use crate::numerics::spread;

/// The table with the columns it can be sure of renamed and converted, and a note on each; `None`
/// when there are none.
pub(super) fn understood(table: &Table) -> Option<(Table, Vec<String>)> {
    let mut changed: Option<(Table, Vec<String>)> = None;
    for index in 0..table.columns.len() {
        let present = changed.as_ref().map_or(table, |(table, _)| table);
        let name = &present.columns[index].name;
        let Some((column, factor, offset)) = meaning(name) else { continue };
        if present.column(column).is_some() {
            continue;
        }
        let note = match (factor.to_bits() == 1.0_f64.to_bits(), offset < 0.0) {
            (true, false) => format!("column `{name}` is read as `{column}`"),
            _ => format!("column `{name}` is read as `{column}`, converted"),
        };
        let (table, notes) = changed.get_or_insert_with(|| (table.clone(), Vec::new()));
        notes.push(note);
        let column_read = &mut table.columns[index];
        column.clone_into(&mut column_read.name);
        column_read.values.iter_mut().for_each(|value| *value = *value * factor + offset);
    }
    changed
}

/// True for a column that has one of our names, or can be given one.
pub(super) fn is_known(name: &str) -> bool {
    LoggedColumn::named(name).is_some() || meaning(name).is_some()
}

/// Columns in a unit of machines' travels whose names say nothing to us, and how far they go, mm.
pub(super) fn lengths(table: &Table) -> impl Iterator<Item = (&str, f64)> {
    let unknown = table.columns.iter().filter(|column| !is_known(&column.name));
    unknown.filter_map(|column| {
        let (_, unit) = split(&column.name.to_lowercase())?;
        let units = LoggedColumn::named("position_mm")?.units.iter();
        let (_, factor, _) =
            units.filter(|(_, factor, _)| 1.0 <= *factor).find(|(name, ..)| *name == unit)?;
        Some((column.name.as_str(), factor * spread(&column.values)))
    })
}

/// Our name for a column, with factor and offset.
fn meaning(name: &str) -> Option<(&'static str, f64, f64)> {
    if LoggedColumn::named(name).is_some() {
        return None;
    }
    let lower = name.trim().to_lowercase();
    let called =
        |name: &str, known: &LoggedColumn| known.headers.contains(&name.trim_end_matches('.'));
    let bare = |known: &&LoggedColumn| known.units.is_empty() && called(&lower, known);
    if let Some(bare) = LOGGED_COLUMNS.iter().find(bare) {
        return Some((bare.name, 1.0, 0.0));
    }
    let (quantity, unit) = split(&lower)?;
    let quantity = quantity.replace('_', " ");
    LOGGED_COLUMNS.iter().filter(|known| called(quantity.trim(), known)).find_map(|known| {
        let is_unit = |(name, ..): &&HeaderUnit| *name == unit;
        let (_, factor, offset) = known.units.iter().find(is_unit)?;
        Some((known.name, *factor, *offset))
    })
}

/// Quantity and unit of `error [µm]`, `error (µm)`, `error / µm`, or `error_um`.
fn split(name: &str) -> Option<(&str, String)> {
    let bracketed = |open: char, close: char| name.strip_suffix(close)?.rsplit_once(open);
    let (quantity, unit) = bracketed('[', ']')
        .or_else(|| bracketed('(', ')'))
        .or_else(|| name.split_once(" / "))
        .or_else(|| name.rsplit_once('_'))?;
    let plain = unit.trim().replace(['µ', 'μ'], "u").replace('°', "deg");
    let unit = match plain.as_str() {
        "\"" | "\u{2033}" => "arcsec".to_owned(),
        _ => plain,
    };
    Some((quantity.trim(), unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_are_known_by_name_and_unit() {
        for (name, column, one) in [
            ("Position [m]", "position_mm", 1000.0),
            ("Time / ms", "time_s", 0.001),
            ("error (nm)", "error_um", 0.001),
            ("error_mrad", "error_arcsec", 206.264_806_247),
            ("Angle (°)", "angle_rev", 1.0 / 360.0),
            ("pressure (Pa)", "air_pressure_hpa", 0.01),
            ("Air temperature [K]", "air_temperature_c", -272.15),
            ("Part temperature (°F)", "workpiece_temperature_c", -17.222_222_222),
            ("humidity (%)", "humidity_pct", 1.0),
            ("Pass", "pass", 1.0),
            ("Run No.", "pass", 1.0),
            ("Pos. / mm", "position_mm", 1.0),
        ] {
            let (found, factor, offset) = meaning(name).expect(name);
            assert_eq!(found, column, "{name}");
            assert!((factor + offset - one).abs() < 1e-8, "{name}: {}", factor + offset);
        }
    }

    #[test]
    fn what_would_be_a_guess_is_left_alone() {
        for name in
            ["error", "temperature [°C]", "error [px]", "deviation [um]", "x [mm]", "time_s"]
        {
            assert!(meaning(name).is_none(), "{name}");
        }
    }
}
