//! Laser calibration text in sections, as Renishaw's and compatible lasers write it (`.rtl`).
//!
//! `TARGET DATA::` lists the targets, in mm or degrees; `DEVIATIONS::` has a line a reading: run,
//! target and deviation, in µm or arc seconds. Runs of one direction take the odd numbers and the way
//! back the even ones, when the flags or the order of the targets say so. A deviation is actual minus target
//! (ISO 230-2:2014, 3.1), `error_um` is positive when the table is behind: the sign turns.

use std::collections::BTreeMap;

use helixlock_traces::Column;

use crate::build::Built;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::number::number;
use crate::place::Place;

/// What the sections say.
#[derive(Default)]
struct Sections {
    targets: Vec<f64>,
    /// Line, and what stands there.
    target_count: Option<(usize, usize)>,
    run_count: Option<(usize, usize)>,
    angular: bool,
    /// Line, run, target (both from 1) and deviation.
    readings: Vec<(usize, usize, usize, f64)>,
    /// Readings of the air and the material, run by run.
    environment: BTreeMap<&'static str, Vec<f64>>,
}

/// Names of lines of `ENVIRONMENT::`, and our columns.
const ENVIRONMENT: [(&str, &str, std::ops::RangeInclusive<f64>); 4] = [
    ("air temp", "air_temperature_c", -20.0..=60.0),
    ("air press", "air_pressure_hpa", 500.0..=1200.0),
    ("air humid", "humidity_pct", 0.0..=100.0),
    ("mat temp 1", "workpiece_temperature_c", -20.0..=100.0),
];

/// Reads the sections and lays runs one after the other.
pub(crate) fn read(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let file = decisions.file();
    let sections = Sections::read(file, lines)?;
    sections.check(file)?;
    let sign = decisions.text("calibration", "deviation", || {
        (
            "actual-minus-target".into(),
            "what ISO 230-2 calls a deviation; the error is positive when the table is behind"
                .into(),
        )
    });
    let sign = if sign == "actual-minus-target" { -1.0 } else { 1.0 };
    let back = sections.goes_back();
    let runs = decisions.text("calibration", "runs", || {
        if back {
            (
                "there-and-back".into(),
                "every other run goes through the targets from the last to the first".into(),
            )
        } else {
            (
                "one-way".into(),
                "every run goes through the targets from the first to the last".into(),
            )
        }
    });
    Ok(sections.build(sign, runs == "there-and-back"))
}

impl Sections {
    fn read(file: &str, lines: &[&str]) -> Result<Self, ImportError> {
        let mut sections = Self::default();
        let (mut section, mut list) = (String::new(), false);
        for (index, line) in lines.iter().enumerate() {
            let text = line.trim();
            if let Some(name) = text.split("::").next().filter(|_| text.contains("::")) {
                section = name.trim().to_uppercase();
                list = false;
                continue;
            }
            let (key, value) =
                text.split_once(':').map_or(("", text), |(key, value)| (key.trim(), value.trim()));
            let key = key.to_lowercase();
            match (section.as_str(), key.as_str()) {
                ("TARGET DATA", "targets") => {
                    list = true;
                    sections.targets(file, index, line, value)?;
                }
                ("TARGET DATA", "") if list => sections.targets(file, index, line, text)?,
                ("TARGET DATA", "filetype" | "file type") => {
                    sections.angular = value.to_uppercase().contains("ANGULAR");
                }
                ("TARGET DATA", "target-count") => {
                    sections.target_count = value.parse().ok().map(|count| (index + 1, count));
                }
                ("RUNS", "run-count") => {
                    sections.run_count = value.parse().ok().map(|count| (index + 1, count));
                }
                ("DEVIATIONS", "run target data") => list = true,
                ("DEVIATIONS", "") if list && !text.is_empty() => {
                    sections.reading(file, index, line)?;
                }
                ("ENVIRONMENT", _) => sections.environment(&key, value),
                _ => list = list && key.is_empty(),
            }
        }
        Ok(sections)
    }

    fn targets(
        &mut self,
        file: &str,
        index: usize,
        line: &str,
        text: &str,
    ) -> Result<(), ImportError> {
        for word in text.split_whitespace() {
            match number(word, '.') {
                Some(target) => self.targets.push(target),
                None => {
                    return Err(ImportError::found(
                        Place::word(file, index + 1, line, word),
                        quoted(word),
                        "a target position",
                    ));
                }
            }
        }
        Ok(())
    }

    fn reading(&mut self, file: &str, index: usize, line: &str) -> Result<(), ImportError> {
        let words: Vec<&str> = line.split_whitespace().collect();
        let &[run, target, deviation] = words.as_slice() else {
            let found = format!("{} words", words.len());
            return Err(ImportError::found(
                Place::line(file, index + 1),
                found,
                "run, target and deviation",
            ));
        };
        let (run_at, target_at) = (run, target);
        let count = |word: &str, expected: &str| {
            let parsed = word.parse::<usize>().ok().filter(|count| (1..=1_000_000).contains(count));
            parsed.ok_or_else(|| {
                ImportError::found(Place::word(file, index + 1, line, word), quoted(word), expected)
            })
        };
        let (run, target) = (count(run, "a run from 1")?, count(target, "a target from 1")?);
        let Some(deviation) = number(deviation, '.') else {
            return Err(ImportError::found(
                Place::word(file, index + 1, line, deviation),
                quoted(deviation),
                "a deviation",
            ));
        };
        if self.targets.len() < target {
            let found = format!("target {target}");
            let expected = format!("one of the {} targets", self.targets.len());
            let place = Place::word(file, index + 1, line, target_at);
            return Err(ImportError::found(place, found, expected));
        }
        if self.readings.iter().any(|(_, r, t, _)| (*r, *t) == (run, target)) {
            let found = format!("run {run}, target {target} again");
            let place = Place::word(file, index + 1, line, run_at);
            return Err(ImportError::found(place, found, "one reading each"));
        }
        self.readings.push((index + 1, run, target, deviation));
        Ok(())
    }

    fn environment(&mut self, key: &str, value: &str) {
        let Some((_, column, range)) = ENVIRONMENT.iter().find(|(name, ..)| key == *name) else {
            return;
        };
        let values: Option<Vec<f64>> =
            value.split_whitespace().map(|word| number(word, '.')).collect();
        if let Some(values) = values
            .filter(|values| !values.is_empty() && values.iter().all(|value| range.contains(value)))
        {
            self.environment.insert(column, values);
        }
    }

    fn check(&self, file: &str) -> Result<(), ImportError> {
        let refuse =
            |place, found: &str, expected: &str| Err(ImportError::found(place, found, expected));
        if self.targets.is_empty() {
            return refuse(Place::file(file), "no targets", "positions behind `Targets :`");
        }
        if self.readings.is_empty() {
            return refuse(Place::file(file), "no readings", "lines below `Run Target Data:`");
        }
        let counted = [
            (self.target_count, self.targets.len(), "targets", "Target-count"),
            (self.run_count, self.runs(), "runs", "Run-count"),
        ];
        for (told, count, what, name) in counted {
            if let Some((line, told)) = told.filter(|(_, told)| *told != count) {
                let expected = format!("{told} as `{name}` says");
                return refuse(Place::line(file, line), &format!("{count} {what}"), &expected);
            }
        }
        Ok(())
    }

    fn runs(&self) -> usize {
        self.readings
            .iter()
            .map(|reading| reading.1)
            .collect::<std::collections::BTreeSet<_>>()
            .len()
    }

    /// True when even runs list their targets downwards.
    fn goes_back(&self) -> bool {
        let falls = |run: usize| {
            let targets: Vec<usize> =
                self.readings.iter().filter(|r| r.1 == run).map(|r| r.2).collect();
            1 < targets.len() && targets.windows(2).all(|pair| pair[1] < pair[0])
        };
        let even: Vec<usize> =
            self.readings.iter().map(|r| r.1).filter(|run| run.is_multiple_of(2)).collect();
        !even.is_empty() && even.iter().all(|run| falls(*run)) && !falls(1)
    }

    fn build(&self, sign: f64, back: bool) -> Built {
        let names =
            if self.angular { ["angle_rev", "error_arcsec"] } else { ["position_mm", "error_um"] };
        let per_unit = if self.angular { 360.0 } else { 1.0 };
        let mut columns: Vec<Column> = names.iter().map(|name| column(name)).collect();
        columns.push(column("pass"));
        if back {
            columns.push(column("direction"));
        }
        columns.extend(self.environment.keys().map(|name| column(name)));
        #[expect(clippy::cast_precision_loss, reason = "runs are few")]
        for (_, run, target, deviation) in &self.readings {
            let pass = if back { run.div_ceil(2) } else { *run };
            let mut row =
                vec![self.targets[target - 1] / per_unit, 0.0 + sign * deviation, pass as f64];
            if back {
                row.push(if run.is_multiple_of(2) { -1.0 } else { 1.0 });
            }
            row.extend(
                self.environment.values().map(|values| values[(run - 1).min(values.len() - 1)]),
            );
            columns.iter_mut().zip(row).for_each(|(column, value)| column.values.push(value));
        }
        Built { columns, origin_s: None }
    }
}

fn column(name: &str) -> Column {
    Column { name: name.to_owned(), values: Vec::new() }
}
