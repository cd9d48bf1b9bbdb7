//! Every column that a measurement may have, once: its names, units and limits.
//!
//! What reads files, what effects need and what a machine file may say of its surroundings all
//! look here.

mod header_units;

use std::ops::RangeInclusive;

use super::Covariate;
use crate::units::{ARCSEC, DEG, DEG_C, HPA, N, PCT, Unit};
use header_units::{
    ARCSECONDS, CELSIUS, HECTOPASCALS, MICROMETRES, MILLIMETRES, NEWTONS, PER_CENT, SECONDS, TURNS,
    TURNS_A_MINUTE,
};

/// A unit as headers write it, in lower case, and value · factor + offset in that of the column.
pub type HeaderUnit = (&'static str, f64, f64);

/// A column of a measurement.
#[derive(Debug)]
pub struct LoggedColumn {
    /// Name with its unit.
    pub name: &'static str,
    /// True for what a sensor of the error shows.
    pub observed: bool,
    /// The quantity that effects know it by; none for coordinates and for the errors.
    pub covariate: Option<Covariate>,
    /// Names that instruments give it, in lower case and without unit.
    pub headers: &'static [&'static str],
    /// Units these come with; none for a number that has no unit.
    pub units: &'static [HeaderUnit],
    /// What its sensor can read at all, its unit taken at its word, and that in words.
    pub readable: Option<(RangeInclusive<f64>, &'static str)>,
    /// What a machine file may say of it in `[environment]`.
    pub setting: Option<Setting>,
    /// How a log that was rounded to steps is bridged.
    pub bridging: Bridging,
}

/// A key of the machine file's `[environment]`.
#[derive(Debug)]
pub struct Setting {
    /// The key.
    pub key: &'static str,
    /// Unit of the column, into which the value is converted.
    pub unit: Unit,
    /// Plausible values in that unit.
    pub range: RangeInclusive<f64>,
}

impl Setting {
    /// True for a quantity whose sign is a convention: it goes as far either way.
    #[must_use]
    pub fn has_either_sign(&self) -> bool {
        (self.range.start() + self.range.end()).abs() <= 0.0
    }
}

/// Where a rounded quantity changes so steadily that a curve goes through its steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bridging {
    /// Nowhere: a setting, a count, or what may jump.
    Never,
    /// Within a pass; the next one begins anew.
    WithinPasses,
    /// From pass to pass.
    Throughout,
}

const TEMPERATURE: Option<(RangeInclusive<f64>, &str)> =
    Some((-273.15..=f64::MAX, "a temperature in °C, above −273.15"));
const PRESSURE: Option<(RangeInclusive<f64>, &str)> =
    Some((f64::MIN_POSITIVE..=f64::MAX, "a pressure in hPa, above 0"));
/// A hygrometer's own error may take it a little past its ends.
const HUMIDITY: Option<(RangeInclusive<f64>, &str)> =
    Some((-2.0..=102.0, "a relative humidity in %, 0 to 100"));

/// Every column, coordinates first.
pub const LOGGED_COLUMNS: &[LoggedColumn] = &[
    coordinate("time_s", &["time", "t", "elapsed time"], SECONDS),
    coordinate("position_mm", &["position", "pos", "travel", "nominal position"], MILLIMETRES),
    coordinate("angle_rev", &["angle", "spindle angle", "rotation"], TURNS),
    coordinate("speed_rpm", &["speed", "spindle speed"], TURNS_A_MINUTE),
    coordinate("direction", &["direction"], &[]),
    coordinate("pass", &["pass", "pass no", "pass number", "run", "run no", "run number"], &[]),
    observed("error_um", &["error", "recorder error"], MICROMETRES),
    observed("error_arcsec", &["error", "angular error"], ARCSECONDS),
    observed("lead_error_um", &["lead error", "lead deviation", "travel deviation"], MICROMETRES),
    LoggedColumn {
        readable: TEMPERATURE,
        setting: Some(setting("air_temperature", DEG_C, -40.0..=100.0)),
        bridging: Bridging::Throughout,
        ..log(Covariate::AirTemperature, "air_temperature_c", &["air temperature"], CELSIUS)
    },
    LoggedColumn {
        readable: PRESSURE,
        setting: Some(setting("air_pressure", HPA, 500.0..=1200.0)),
        bridging: Bridging::Throughout,
        ..log(
            Covariate::AirPressure,
            "air_pressure_hpa",
            &["air pressure", "pressure"],
            HECTOPASCALS,
        )
    },
    LoggedColumn {
        readable: HUMIDITY,
        setting: Some(setting("humidity", PCT, 0.0..=100.0)),
        bridging: Bridging::Throughout,
        ..log(
            Covariate::Humidity,
            "humidity_pct",
            &["humidity", "air humidity", "relative humidity", "rh"],
            PER_CENT,
        )
    },
    LoggedColumn {
        readable: TEMPERATURE,
        setting: Some(setting("workpiece_temperature", DEG_C, -40.0..=200.0)),
        bridging: Bridging::Throughout,
        ..log(
            Covariate::WorkpieceTemperature,
            "workpiece_temperature_c",
            &["workpiece temperature", "part temperature", "sample temperature"],
            CELSIUS,
        )
    },
    LoggedColumn {
        readable: TEMPERATURE,
        setting: Some(setting("bed_temperature", DEG_C, -40.0..=200.0)),
        bridging: Bridging::Throughout,
        ..log(Covariate::BedTemperature, "bed_temperature_c", &["bed temperature"], CELSIUS)
    },
    LoggedColumn {
        setting: Some(setting("bed_pitch", ARCSEC, -3600.0..=3600.0)),
        bridging: Bridging::WithinPasses,
        ..log(Covariate::BedPitch, "bed_pitch_arcsec", &["bed pitch", "pitch"], ARCSECONDS)
    },
    LoggedColumn {
        setting: Some(setting("force", N, -1e5..=1e5)),
        bridging: Bridging::WithinPasses,
        ..log(Covariate::Force, "force_n", &["force", "grinding force"], NEWTONS)
    },
    log(Covariate::InitialPhase, "initial_phase", &[], &[]),
    LoggedColumn {
        setting: Some(setting("grating_index", DEG, -360.0..=360.0)),
        ..log(Covariate::GratingIndex, "grating_index_deg", &[], &[])
    },
    LoggedColumn {
        setting: Some(setting("clamping_index", DEG, -360.0..=360.0)),
        ..log(Covariate::ClampingIndex, "clamping_index_deg", &[], &[])
    },
    // A sensor of a closed loop, and where the moves are known a cause like any other.
    LoggedColumn { observed: true, ..log(Covariate::Steps, "steps", &["steps"], &[]) },
];

/// Names of the columns that effects know; the place in this list is the index of the column.
pub const COVARIATES: &[&str] = &covariates();

const fn covariates() -> [&'static str; Covariate::Steps as usize + 1] {
    let mut names = [""; Covariate::Steps as usize + 1];
    let mut row = 0;
    while row < LOGGED_COLUMNS.len() {
        if let Some(which) = LOGGED_COLUMNS[row].covariate {
            names[which as usize] = LOGGED_COLUMNS[row].name;
        }
        row += 1;
    }
    names
}

impl LoggedColumn {
    /// The column of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        LOGGED_COLUMNS.iter().find(|column| column.name == name)
    }

    /// True for a column that is no coordinate and no sensor.
    #[must_use]
    pub fn is_log(&self) -> bool {
        self.covariate.is_some() && !self.observed
    }
}

const fn coordinate(
    name: &'static str,
    headers: &'static [&'static str],
    units: &'static [HeaderUnit],
) -> LoggedColumn {
    LoggedColumn {
        name,
        observed: false,
        covariate: None,
        headers,
        units,
        readable: None,
        setting: None,
        bridging: Bridging::Never,
    }
}

const fn observed(
    name: &'static str,
    headers: &'static [&'static str],
    units: &'static [HeaderUnit],
) -> LoggedColumn {
    let mut column = coordinate(name, headers, units);
    column.observed = true;
    column
}

const fn log(
    covariate: Covariate,
    name: &'static str,
    headers: &'static [&'static str],
    units: &'static [HeaderUnit],
) -> LoggedColumn {
    let mut column = coordinate(name, headers, units);
    column.covariate = Some(covariate);
    column
}

const fn setting(key: &'static str, unit: Unit, range: RangeInclusive<f64>) -> Setting {
    Setting { key, unit, range }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_covariate_has_one_column() {
        assert!(COVARIATES.iter().all(|name| !name.is_empty()));
        let logs = LOGGED_COLUMNS.iter().filter(|column| column.covariate.is_some());
        assert_eq!(logs.count(), COVARIATES.len());
    }

    /// One header with one unit means one column.
    #[test]
    fn headers_are_unambiguous() {
        for (row, column) in LOGGED_COLUMNS.iter().enumerate() {
            for other in &LOGGED_COLUMNS[row + 1..] {
                assert_ne!(column.name, other.name);
                let shared = column.headers.iter().any(|name| other.headers.contains(name));
                let alike = |(unit, ..): &HeaderUnit| other.units.iter().any(|u| u.0 == *unit);
                assert!(!shared || !column.units.iter().any(alike), "{}", column.name);
            }
        }
    }

    /// What a machine file may say of its surroundings can be read by their sensor.
    #[test]
    fn settings_can_be_read() {
        for column in LOGGED_COLUMNS {
            let (Some(setting), Some((readable, _))) = (&column.setting, &column.readable) else {
                continue;
            };
            assert!(readable.contains(setting.range.start()), "{}", column.name);
            assert!(readable.contains(setting.range.end()), "{}", column.name);
        }
    }
}
