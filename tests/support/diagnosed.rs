//! What a diagnosis of a measurement made in memory has found.

use std::path::Path;

use helixlock_lab::{Diagnosis, Measurement, Nominal, Problem, Verdict, diagnose};
use helixlock_plant::Model;
use helixlock_traces::{Column, Table};

use super::seeds::seeds;

/// A machine that cuts a screw of 8 mm lead, 4 mm a second.
pub(crate) const MACHINE: &str = r#"
workpiece = { lead = "8 mm", length = "640 mm" }
spindle.speed = "30 rpm"
lead_screw.lead = "10 mm"
gear = [{ name = "change gear 1", order = 2.5, teeth = 48 }]
grating.lines = 13906
laser.wavelength = "0.63281983 um"
"#;

/// A table as the measurement of a machine.
pub(crate) fn problem(machine: &Model, table: &Table) -> Problem {
    let measurement = Measurement::from_table(table, &Nominal::of(machine));
    Problem::new(machine, &measurement.expect("a measurement")).expect("all columns are there")
}

/// The diagnosis of some columns of [`MACHINE`].
pub(crate) fn diagnosed(columns: Vec<(&str, Vec<f64>)>) -> Diagnosis {
    diagnosed_on(MACHINE, columns)
}

/// The same of another machine.
pub(crate) fn diagnosed_on(machine: &str, columns: Vec<(&str, Vec<f64>)>) -> Diagnosis {
    diagnose(&problem_of(machine, columns))
}

/// Some columns as the measurement of a machine.
pub(crate) fn problem_of(machine: &str, columns: Vec<(&str, Vec<f64>)>) -> Problem {
    let machine = Model::parse(machine, Path::new("machine.toml")).expect("a machine");
    let column = |(name, values): (&str, Vec<f64>)| Column { name: name.to_owned(), values };
    problem(&machine, &Table::new(columns.into_iter().map(column).collect()))
}

/// Rows under their titles.
pub(crate) fn columns<const N: usize>(
    titles: [&'static str; N],
    rows: impl Iterator<Item = [f64; N]>,
) -> Vec<(&'static str, Vec<f64>)> {
    let mut columns = titles.map(|title| (title, Vec::new()));
    rows.for_each(|row| columns.iter_mut().zip(row).for_each(|((_, all), one)| all.push(one)));
    columns.into()
}

/// Names of the effects of the final model.
pub(crate) fn names(diagnosis: &Diagnosis) -> Vec<&str> {
    let last = diagnosis.rounds.last().expect("there is always a round 0");
    last.effects.iter().map(|effect| effect.name.as_str()).collect()
}

/// Nothing is named in the diagnosis of any seed, and no all-clear given.
pub(crate) fn is_nobodys(diagnosed: impl Fn(u64) -> Diagnosis) {
    for seed in seeds(1, 6) {
        let found = diagnosed(seed);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}
