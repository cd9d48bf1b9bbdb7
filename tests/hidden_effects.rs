//! Hidden effects are found, and nothing is named that is not there.

use std::path::{Path, PathBuf};

use helixlock_lab::{
    Measurement, Nominal, Outcome, Problem, Verdict, challenge, compare, diagnose, judge,
};
use helixlock_plant::{MachineFile, Model};
use helixlock_traces::{Column, Table, read_table};

use crate::support::diagnosed::names;
use crate::support::seeds::seeds;

fn example(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(file)
}

fn problem(machine: &Model, table: &Table) -> Problem {
    let measurement = Measurement::from_table(table, &Nominal::of(machine)).expect("a measurement");
    Problem::new(machine, &measurement).expect("all columns are there")
}

fn of_example(folder: &str) -> (Model, Table) {
    let machine = Model::read(&example(&format!("{folder}/machine.toml"))).expect("a machine");
    let table = read_table(&example(&format!("{folder}/data.csv"))).expect("a table");
    (machine, table)
}

/// An example's data, which come from a generator that shares no code with this program, have a verdict and names.
fn tells(folder: &str, verdict: Verdict, expected: &[&str]) {
    let (machine, table) = of_example(folder);
    let diagnosis = diagnose(&problem(&machine, &table));
    assert_eq!(diagnosis.verdict, verdict, "{folder}: {:?}", names(&diagnosis));
    let mut found = names(&diagnosis);
    found.sort_unstable();
    assert_eq!(found, expected, "{folder}");
}

#[test]
fn examples_tell_their_stories() {
    tells("hidden-gear", Verdict::Explained, &["gear-error"]);
    tells("outside-the-catalogue", Verdict::Unexplained, &[]);
    tells("encoder-1000-1024", Verdict::Explained, &["wrong-setting"]);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn examples_of_two_effects_tell_their_stories() {
    tells("thermal-day", Verdict::Explained, &["air-pressure", "air-temperature"]);
    tells("recorder-and-screw", Verdict::Explained, &["screw-periodic", "workpiece-expansion"]);
}

/// Worm periods from mount tables: 481 s, 382.95 s, 382.95 s, 239.34 s; see the example's README.
#[test]
fn worm_periods_come_out_of_real_logs_untold() {
    let folder = "real-worm-drive";
    let machine = Model::read(&example(&format!("{folder}/machine.toml"))).expect("a machine");
    for (log, period_s) in [
        ("dataset01", 481.0),
        ("performance_dataset03", 382.95),
        ("performance_dataset04", 382.95),
        ("performance_dataset07", 239.34),
    ] {
        let table = read_table(&example(&format!("{folder}/{log}.csv"))).expect("a table");
        let lines = compare(&problem(&machine, &table)).lines;
        let found = lines.iter().take(3).find(|line| {
            (line.period_s - period_s).abs() < 3.0 * line.period_stderr_s
                && line.period_stderr_s < 0.02 * period_s
        });
        let periods: Vec<f64> = lines.iter().map(|line| line.period_s).collect();
        assert!(found.is_some(), "{log}: {periods:?}");
    }
}

#[test]
fn challenges_are_named_rightly_or_not_at_all() {
    let (mut right, seeds) = (0, seeds(2, 30));
    for seed in seeds.clone().map(|nth| 9000 + nth) {
        let task = challenge(seed).expect("a recipe that fits");
        let diagnosis = diagnose(&problem(&task.machine.model, &task.table));
        let names: Vec<String> = names(&diagnosis).into_iter().map(str::to_owned).collect();
        let outcome = judge(&task.hidden, diagnosis.verdict, &names);
        assert_ne!(outcome, Outcome::FalselyNamed, "seed {seed}: {:?}, not {names:?}", task.hidden);
        right += u64::from(outcome != Outcome::Missed);
    }
    assert!(5 * seeds.end <= 6 * right, "{right} of {}", seeds.end);
}

/// Every third sample of an example.
fn few_of_example(folder: &str) -> (Model, Table) {
    let (machine, table) = of_example(folder);
    let few = |column: &Column| Column {
        name: column.name.clone(),
        values: column.values.iter().copied().step_by(3).collect(),
    };
    (machine, Table::new(table.columns.iter().map(few).collect()))
}

/// The same file in nanometres, with its passes in another order.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn neither_units_nor_the_order_of_passes_change_the_verdict() {
    let (machine, table) = few_of_example("hidden-gear");
    let rows = table.rows();
    let order: Vec<usize> = (rows / 2..rows).chain(0..rows / 2).collect();
    let moved = table.columns.iter().map(|column| Column {
        name: column.name.clone(),
        values: order.iter().map(|&row| column.values[row]).collect(),
    });
    let diagnosis = diagnose(&problem(&machine, &Table::new(moved.collect())));
    assert_eq!(names(&diagnosis), ["gear-error"]);

    let bare = MachineFile::read(&example("hidden-gear/machine.toml")).expect("a machine");
    let bare = bare.without_effect(0).and_then(|file| file.without_effect(0)).expect("two effects");
    let verdict = |factor: f64| {
        let mut scaled = Table::new(table.columns.clone());
        for column in scaled.columns.iter_mut().filter(|column| column.name == "error_um") {
            column.values.iter_mut().for_each(|value| *value *= factor);
        }
        let diagnosis = diagnose(&problem(&bare.model, &scaled));
        names(&diagnosis).iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(verdict(1.0), verdict(2.0));
}

#[test]
fn a_column_of_noise_is_never_named() {
    let (machine, table) = few_of_example("hidden-gear");
    let mut columns = table.columns.clone();
    for name in ["bed_pitch_arcsec", "air_temperature_c", "force_n"] {
        let noise = |row: usize| {
            let whole = u32::try_from(row).expect("few rows").wrapping_mul(2_654_435_761);
            f64::from(whole.wrapping_add(u32::from(name.as_bytes()[0]) * 7919) >> 8) / 1e7
        };
        let values = (0..table.rows()).map(noise).collect();
        columns.push(Column { name: name.to_owned(), values });
    }
    let diagnosis = diagnose(&problem(&machine, &Table::new(columns)));
    assert_eq!(names(&diagnosis), ["gear-error"]);
}
