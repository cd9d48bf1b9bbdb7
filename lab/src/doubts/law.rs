//! How usual readings are: evidence that needs no prediction.

use helixlock_plant::{Machine, Part};

use crate::measurement::Measurement;
use crate::numerics::{count, median, spread};
use crate::policy::mistakes::{
    HIGH_UP, OTHERWISE, OTHERWISE_DEVIATION, SAME_SPEED, SAME_TRAVEL, USUAL, USUAL_SIZE,
    WEATHER_HPA,
};

/// Twice the log probability of what a measurement says of its workshop, but for a constant.
pub(super) fn usualness(measurement: &Measurement, machine: &Machine) -> f64 {
    readings(measurement)
        + weather(measurement, machine)
        + speeds(measurement, machine)
        + travel(measurement, machine, 1.0)
}

/// The same of what columns mostly show, or of what they show first: a bed that is heated begins with the hall.
fn readings(measurement: &Measurement) -> f64 {
    let of = |&(column, usual, deviation): &(&str, f64, f64)| {
        let values = measurement.covariates.get(column)?;
        let first = values.iter().copied().find(|value| value.is_finite())?;
        let off = |value: f64| ((value - usual) / deviation).powi(2);
        Some(-off(median(&mut values.clone())).min(off(first)))
    };
    USUAL.iter().filter_map(of).sum()
}

/// The same of an air pressure that is the machine file's own reference, but for the weather.
fn weather(measurement: &Measurement, machine: &Machine) -> f64 {
    let reference = machine.laser.reference.pressure_hpa;
    let pressure = measurement.covariates.get("air_pressure_hpa");
    let off = pressure.map(|values| (median(&mut values.clone()) - reference).abs());
    if off.is_some_and(|off| off < WEATHER_HPA) { -2.0 * libm::log(HIGH_UP) } else { 0.0 }
}

/// The same of the size of an error column times a factor.
pub(super) fn size_of_error(values: &[f64], factor: f64) -> f64 {
    let mut sizes: Vec<f64> =
        values.iter().filter(|value| value.is_finite()).map(|value| value.abs()).collect();
    let usual = factor * median(&mut sizes);
    if usual <= 0.0 {
        return 0.0;
    }
    let (centre, deviation) = USUAL_SIZE;
    -((libm::log10(usual) - centre) / deviation).powi(2)
}

/// Speed by the clock, by its column, and by the machine file.
fn speeds(measurement: &Measurement, machine: &Machine) -> f64 {
    let told = measurement.over_the_way(|row, _| measurement.speed_rpm[row]);
    let clocked = measurement.over_the_way(|_, rpm| rpm);
    let nominal = machine.spindle.speed_rpm;
    let pairs = [(told, clocked), (told, nominal)];
    let of = |(one, other): (f64, f64)| {
        if 0.0 < one && 0.0 < other { same(libm::log(one / other), SAME_SPEED) } else { 0.0 }
    };
    pairs.into_iter().map(of).sum()
}

/// The same of the travel times a factor.
pub(super) fn travel(measurement: &Measurement, machine: &Machine, factor: f64) -> f64 {
    let way_mm = factor * spread(&measurement.position_mm);
    if machine.lacks(&[Part::Table, Part::Workpiece]).is_some() || way_mm <= 0.0 {
        return 0.0;
    }
    same(libm::log(way_mm / machine.workpiece.length_mm), SAME_TRAVEL)
}

/// Twice the log density of a difference of logarithms: mostly that of equal ones, else wide.
fn same(difference: f64, deviation: f64) -> f64 {
    let normal = |deviation: f64| libm::exp(-0.5 * (difference / deviation).powi(2)) / deviation;
    let density = (1.0 - OTHERWISE) * normal(deviation) + OTHERWISE * normal(OTHERWISE_DEVIATION);
    2.0 * libm::log(density.max(f64::MIN_POSITIVE))
}

/// True where the way follows from a clock that was read; where none was, the clock follows from the way.
pub(super) fn follows_from_clock(measurement: &Measurement, machine: &Machine) -> bool {
    let turns_per_second = machine.spindle.speed_rpm / 60.0;
    let off = measurement.angle_rev.iter().zip(&measurement.time_s);
    let off = off.map(|(angle, time)| (angle - time * turns_per_second).abs());
    measurement.timed && off.fold(0.0, f64::max) < 1e-9 * count(measurement.len())
}
