//! Units of columns: told, not to be mistaken, or asked for.

use super::{Candidate, NONE, by_column};
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
    let mut runs = Vec::new();
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
        if target.kind == "fraction" && unit.is_some() && all_below_one(&candidate.samples.values) {
            ask_fraction(candidate, decisions);
            continue;
        }
        if let Some(doubt) = unit.and_then(|unit| Doubt::of(candidate, unit)) {
            ask_doubt(candidate, &doubt, decisions);
            continue;
        }
        match unit.map(ToOwned::to_owned).or_else(|| guessed(candidate, target)) {
            Some(unit) => candidate.rule.unit = Some(unit),
            None if candidate.rule.pass.is_some() => runs.push((candidate, target)),
            None => ask_unit(&mut [candidate], target, decisions),
        }
    }
    // Runs of one quantity are in one unit.
    for same in runs.chunk_by_mut(|(_, one), (_, other)| one.column == other.column) {
        let target = same[0].1;
        let mut columns: Vec<_> = same.iter_mut().map(|(candidate, _)| &mut **candidate).collect();
        ask_unit(&mut columns, target, decisions);
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
        "humidity_pct" if within(1.0, 100.0) && is_plain(candidate) => "%",
        _ => return None,
    };
    candidate.rule.reason.push_str("; the unit fits its values");
    Some(unit.to_owned())
}

/// True when the name is the word for the quantity, and nothing with it may be another unit or kind
/// of it: `absolute humidity`, `Humidity (g/m³)`, `Humidity (dew point °C)`.
fn is_plain(candidate: &Candidate<'_>) -> bool {
    let bare = candidate.header.bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let word = candidate.word.map_or("", |word| word.spelling);
    bare.trim().replace(['_', '-', '.'], " ").to_lowercase() == word
}

/// True where a fraction of so many per cent would be one of so many hundredths of a per cent.
fn all_below_one(values: &[f64]) -> bool {
    let finite = || values.iter().filter(|value| value.is_finite());
    finite().all(|value| (0.0..=1.0).contains(value)) && finite().any(|value| 0.0 < *value)
}

/// True for whole numbers, which may be counts.
fn is_whole(candidate: &Candidate<'_>) -> bool {
    let mut values = candidate.samples.values.iter().filter(|value| value.is_finite());
    values.all(|value| value.fract().abs() <= 0.0)
}

/// Steps of a motor, or what a scale or a comparator resolves.
fn length_of_a_count(candidate: &Candidate<'_>) -> Option<Answer> {
    let answer = unit_answers(&[&candidate.header.name], &["2.5 um"]).pop()?;
    let label = "counts, 2.5 um each".to_owned();
    is_whole(candidate).then_some(Answer { label, ..answer })
}

/// What moves may turn; whole numbers may be counts of an encoder.
fn angle_answers(candidate: &Candidate<'_>, target: Target) -> Vec<Answer> {
    let to = if target.column == "position_mm" { "angle_rev" } else { "error_arcsec" };
    let counts = is_whole(candidate);
    let units = [
        ("deg", "deg: an angle"),
        ("rad", "rad: an angle"),
        ("1/4096 rev", "counts, 4096 of them a turn"),
    ];
    let from = toml_edit::Value::from(candidate.header.name.as_str());
    let answer = |(unit, label): &(&str, &str)| Answer {
        label: (*label).to_owned(),
        recipe: format!("[[column]]\nfrom = {from}\nto = \"{to}\"\nunit = \"{unit}\""),
    };
    units[..if counts { 3 } else { 2 }].iter().map(answer).collect()
}

/// A workbook shows 0.45 as 45 % and keeps 0.45.
fn ask_fraction(candidate: &mut Candidate<'_>, decisions: &mut Decisions<'_>) {
    let name = &candidate.header.name;
    let text = format!("column {} is in %, and nowhere above 1", quoted(name));
    let answers = unit_answers(&[name], &["ratio", "%"]);
    decisions.question_at(&candidate.header.place, &text, answers);
    candidate.rule.unit = Some("ratio".to_owned());
    candidate.rule.reason.push_str("; its unit is not sure");
}

/// A unit that is told and may yet be another.
struct Doubt {
    text: String,
    units: Vec<String>,
}

impl Doubt {
    /// Of a unit with two meanings, and of a name with a factor in it, as `Error x10 [µm]`.
    fn of(candidate: &Candidate<'_>, unit: &str) -> Option<Self> {
        let name = quoted(&candidate.header.name);
        if data::is_doubtful(unit) {
            let text = format!("`{unit}` of column {name} is degree or gon");
            return Some(Self { text, units: vec!["deg".to_owned(), "gon".to_owned()] });
        }
        let factor = factor_in(&candidate.header.bare)?;
        let text = format!("the name of column {name} has a factor in it, {factor}");
        let units = [format!("1/{factor} {unit}"), format!("{factor} {unit}"), unit.to_owned()];
        Some(Self { text, units: units.into() })
    }
}

/// The power of ten of `x10`, `×1000` or `100x` in a name; `x1` is an axis.
fn factor_in(bare: &str) -> Option<&str> {
    let tokens = bare.split(|c: char| !c.is_alphanumeric() && !"×*".contains(c));
    let power = |digits: &&str| {
        digits
            .strip_prefix('1')
            .is_some_and(|zeros| !zeros.is_empty() && zeros.bytes().all(|byte| byte == b'0'))
    };
    let marks = ['x', 'X', '×', '*'];
    let mut factors = tokens.filter_map(|token| {
        token
            .rsplit_once(['×', '*'])
            .map(|(_, digits)| digits)
            .or_else(|| token.strip_prefix(marks))
            .or_else(|| token.strip_suffix(marks))
    });
    factors.find(power)
}

fn ask_doubt(candidate: &mut Candidate<'_>, doubt: &Doubt, decisions: &mut Decisions<'_>) {
    let units: Vec<&str> = doubt.units.iter().map(String::as_str).collect();
    let answers = unit_answers(&[&candidate.header.name], &units);
    decisions.question_at(&candidate.header.place, &doubt.text, answers);
    candidate.rule.unit = Some(units[0].to_owned());
    candidate.rule.reason.push_str("; its unit is not sure");
}

/// Asks once for all columns that share their unit.
fn ask_unit(columns: &mut [&mut Candidate<'_>], target: Target, decisions: &mut Decisions<'_>) {
    let units: &[&str] = match target.kind {
        "length" if target.column == "position_mm" => &["mm", "m", "um", "inch"],
        "length" => &["um", "mm", "nm", "inch"],
        "angle" => &["arcsec", "deg", "rad", "rev", "gon"],
        "time" => &["s", "ms", "us", "min"],
        "temperature" => &["°C", "°F", "K"],
        "pressure" => &["hpa", "pa", "kpa", "mmhg"],
        "turning" => &["rpm", "1/s", "deg/s"],
        "force" => &["n", "kn"],
        _ => &["%", "ratio"],
    };
    let names: Vec<&str> = columns.iter().map(|column| column.header.name.as_str()).collect();
    let text = match names[..] {
        [name] => format!("the unit of column {} is not told", quoted(name)),
        _ => format!(
            "the unit of {} runs is not told, from column {}",
            names.len(),
            quoted(names[0])
        ),
    };
    let mut answers = unit_answers(&names, units);
    let first = &*columns[0];
    if let ("length", [_]) = (target.kind, &names[..]) {
        answers.extend(length_of_a_count(first));
    }
    if target.kind == "length" && ["target", "actual", "position"].contains(&first.meaning()) {
        answers.extend(angle_answers(first, target));
    }
    if target.kind == "fraction" {
        answers.push(Answer {
            label: "another quantity: left out".to_owned(),
            recipe: format!(
                "[[column]]\nfrom = {}\nto = \"{NONE}\"",
                toml_edit::Value::from(names[0])
            ),
        });
    }
    decisions.question_at(&first.header.place, &text, answers);
    for column in columns {
        column.rule.unit = Some(units[0].to_owned());
        column.rule.reason.push_str("; its unit is not sure");
    }
}

fn unit_answers(names: &[&str], units: &[&str]) -> Vec<Answer> {
    let rule = |name: &&str, unit: &str| {
        format!("[[column]]\nfrom = {}\nunit = \"{unit}\"", toml_edit::Value::from(*name))
    };
    let answer = |unit: &&str| Answer {
        label: (*unit).to_owned(),
        recipe: names.iter().map(|name| rule(name, unit)).collect::<Vec<_>>().join("\n"),
    };
    units.iter().map(answer).collect()
}
