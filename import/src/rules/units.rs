//! Units of columns: told, not to be mistaken, or asked for.

use super::{Candidate, by_column};
use crate::data::{self, Target};
use crate::decide::Decisions;
use crate::error::quoted;
use crate::question::Answer;
use crate::samples::Holds;

/// Units, or the question what they are.
pub(super) fn units(
    candidates: &mut [Candidate<'_>],
    preamble_unit: Option<&str>,
    decisions: &mut Decisions<'_>,
) {
    for candidate in candidates.iter_mut() {
        let Some(target) = candidate.rule.to.as_deref().and_then(by_column) else { continue };
        if target.kind.is_empty()
            || candidate.rule.unit.is_some()
            || candidate.samples.holds == Holds::Instants
        {
            continue;
        }
        let own = candidate.header.name == target.column;
        let fits = |unit: &&str| data::unit(unit, target.kind).is_some();
        let named = candidate.header.unit.as_deref().filter(fits);
        let unit = named
            .or(preamble_unit.filter(fits))
            .or((own || target.kind == "count").then_some(target.unit));
        match unit.map(ToOwned::to_owned).or_else(|| guessed(candidate, target)) {
            Some(unit) => candidate.rule.unit = Some(unit),
            None => ask_unit(candidate, target, decisions),
        }
    }
}

/// A unit that the values leave no doubt about.
fn guessed(candidate: &mut Candidate<'_>, target: Target) -> Option<String> {
    let finite = || candidate.samples.values.iter().copied().filter(|value| value.is_finite());
    let within = |low: f64, high: f64| finite().all(|value| (low..=high).contains(&value));
    let unit = match target.column {
        "time_s" if within(1e9, 4e9) => "s",
        "time_s" if within(1e12, 4e12) => "ms",
        "time_s" if within(1e15, 4e15) => "us",
        "air_pressure_hpa" if within(850.0, 1100.0) => "hpa",
        "air_pressure_hpa" if within(85e3, 110e3) => "pa",
        "air_pressure_hpa" if within(85.0, 110.0) => "kpa",
        "air_pressure_hpa" if within(640.0, 820.0) => "mmhg",
        "air_temperature_c" | "workpiece_temperature_c" | "bed_temperature_c"
            if within(10.0, 40.0) =>
        {
            "°C"
        }
        "air_temperature_c" | "workpiece_temperature_c" | "bed_temperature_c"
            if within(50.0, 104.0) =>
        {
            "°F"
        }
        "humidity_pct" if within(1.0, 100.0) => "%",
        _ => return None,
    };
    candidate.rule.reason.push_str("; the unit fits its values");
    Some(unit.to_owned())
}

fn ask_unit(candidate: &mut Candidate<'_>, target: Target, decisions: &mut Decisions<'_>) {
    let units: &[&str] = match target.kind {
        "length" if target.column == "position_mm" => &["mm", "m", "um", "inch"],
        "length" => &["um", "mm", "nm", "inch"],
        "angle" => &["arcsec", "deg", "rad", "rev"],
        "time" => &["s", "ms", "us", "min"],
        "temperature" => &["°C", "°F", "K"],
        "pressure" => &["hpa", "pa", "kpa", "mmhg"],
        "turning" => &["rpm", "1/s", "deg/s"],
        "force" => &["n", "kn"],
        _ => &["%"],
    };
    let name = &candidate.header.name;
    let answer = |unit: &&str| Answer {
        label: (*unit).to_owned(),
        recipe: format!(
            "[[column]]\nfrom = {}\nunit = \"{unit}\"",
            toml_edit::Value::from(name.as_str())
        ),
    };
    let text = format!("the unit of column {} is not told", quoted(name));
    decisions.question(&text, units.iter().map(answer).collect());
    candidate.rule.unit = Some(units[0].to_owned());
    candidate.rule.reason.push_str("; its unit is not sure");
}
