//! Column names as instruments write them, such as `Position [m]`, in the names and units used here.
//!
//! Only what is unambiguous is taken: a known quantity **and** a known unit. A name that is already
//! one of ours is left alone.

use helixlock_traces::Table;

/// A unit in lower case, and value · factor + offset in that of the column.
type Unit = (&'static str, f64, f64);

/// A quantity under the names it goes by.
struct Quantity {
    names: &'static [&'static str],
    column: &'static str,
    units: &'static [Unit],
}

const SECONDS: &[Unit] = &[
    ("s", 1.0, 0.0),
    ("sec", 1.0, 0.0),
    ("seconds", 1.0, 0.0),
    ("ms", 1e-3, 0.0),
    ("us", 1e-6, 0.0),
    ("min", 60.0, 0.0),
    ("h", 3600.0, 0.0),
];
const MILLIMETRES: &[Unit] = &[
    ("mm", 1.0, 0.0),
    ("m", 1e3, 0.0),
    ("cm", 10.0, 0.0),
    ("um", 1e-3, 0.0),
    ("in", 25.4, 0.0),
    ("inch", 25.4, 0.0),
];
const MICROMETRES: &[Unit] =
    &[("um", 1.0, 0.0), ("nm", 1e-3, 0.0), ("mm", 1e3, 0.0), ("m", 1e6, 0.0)];
const TURNS: &[Unit] = &[
    ("rev", 1.0, 0.0),
    ("turns", 1.0, 0.0),
    ("deg", 1.0 / 360.0, 0.0),
    ("rad", 1.0 / std::f64::consts::TAU, 0.0),
];
const ARCSECONDS: &[Unit] = &[
    ("arcsec", 1.0, 0.0),
    ("arcmin", 60.0, 0.0),
    ("deg", 3600.0, 0.0),
    ("rad", 648_000.0 / std::f64::consts::PI, 0.0),
    ("mrad", 648.0 / std::f64::consts::PI, 0.0),
    ("urad", 0.648 / std::f64::consts::PI, 0.0),
];
const TURNS_A_MINUTE: &[Unit] = &[("rpm", 1.0, 0.0), ("1/min", 1.0, 0.0), ("1/s", 60.0, 0.0)];
const CELSIUS: &[Unit] =
    &[("c", 1.0, 0.0), ("degc", 1.0, 0.0), ("k", 1.0, -273.15), ("degf", 5.0 / 9.0, -160.0 / 9.0)];
const HECTOPASCALS: &[Unit] = &[
    ("hpa", 1.0, 0.0),
    ("mbar", 1.0, 0.0),
    ("pa", 1e-2, 0.0),
    ("kpa", 10.0, 0.0),
    ("bar", 1e3, 0.0),
    ("mmhg", 1.333_223_874, 0.0),
];
const PER_CENT: &[Unit] = &[("%", 1.0, 0.0), ("pct", 1.0, 0.0), ("%rh", 1.0, 0.0)];
const NEWTONS: &[Unit] = &[("n", 1.0, 0.0), ("kn", 1e3, 0.0)];

const fn quantity(
    names: &'static [&'static str],
    column: &'static str,
    units: &'static [Unit],
) -> Quantity {
    Quantity { names, column, units }
}

/// Every quantity; a name may come twice where the unit decides.
const QUANTITIES: &[Quantity] = &[
    quantity(&["time", "t", "elapsed time"], "time_s", SECONDS),
    quantity(&["position", "pos", "travel", "nominal position"], "position_mm", MILLIMETRES),
    quantity(&["angle", "spindle angle", "rotation"], "angle_rev", TURNS),
    quantity(&["error", "recorder error"], "error_um", MICROMETRES),
    quantity(&["error", "angular error"], "error_arcsec", ARCSECONDS),
    quantity(&["lead error", "lead deviation", "travel deviation"], "lead_error_um", MICROMETRES),
    quantity(&["speed", "spindle speed"], "speed_rpm", TURNS_A_MINUTE),
    quantity(&["air temperature"], "air_temperature_c", CELSIUS),
    quantity(&["air pressure", "pressure"], "air_pressure_hpa", HECTOPASCALS),
    quantity(&["humidity", "air humidity", "relative humidity", "rh"], "humidity_pct", PER_CENT),
    quantity(
        &["workpiece temperature", "part temperature", "sample temperature"],
        "workpiece_temperature_c",
        CELSIUS,
    ),
    quantity(&["bed temperature"], "bed_temperature_c", CELSIUS),
    quantity(&["bed pitch", "pitch"], "bed_pitch_arcsec", ARCSECONDS),
    quantity(&["force", "grinding force"], "force_n", NEWTONS),
];

/// Names that have no unit, in any case.
const BARE: &[&str] = &["pass", "direction", "steps"];

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
    is_ours(name) || meaning(name).is_some()
}

fn is_ours(name: &str) -> bool {
    helixlock_plant::COVARIATES.contains(&name) || super::samples::NOT_COVARIATES.contains(&name)
}

/// Our name for a column, with factor and offset.
fn meaning(name: &str) -> Option<(&'static str, f64, f64)> {
    if is_ours(name) {
        return None;
    }
    let lower = name.trim().to_lowercase();
    if let Some(bare) = BARE.iter().find(|bare| **bare == lower) {
        return Some((bare, 1.0, 0.0));
    }
    let (quantity, unit) = split(&lower)?;
    let quantity = quantity.replace('_', " ");
    QUANTITIES.iter().filter(|known| known.names.contains(&quantity.trim())).find_map(|known| {
        let (_, factor, offset) = known.units.iter().find(|(name, ..)| *name == unit)?;
        Some((known.column, *factor, *offset))
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
