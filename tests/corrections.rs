//! Effects of the machine file that are no longer what the file says.

use std::path::Path;

use helixlock_lab::{Diagnosis, Verdict, compare, diagnose, written};
use helixlock_plant::MachineFile;
use helixlock_traces::{Column, Table};

use crate::support::diagnosed::{MACHINE, names, problem};
use crate::support::passes::white;

/// Rows of a measurement.
const ROWS: u32 = 900;

/// Two waves of a screw and a headstock that warms up.
fn machine(first_um: f64, second_um: f64, [growth_um, constant_s]: [f64; 2]) -> MachineFile {
    let effects = format!(
        "[[effect]]\nkind = 'screw-periodic'\namplitude = '{first_um} um'\nphase = '40 deg'\n\
         [[effect]]\nkind = 'headstock-growth'\namplitude = '{growth_um} um'\n\
         time_constant = '{constant_s} s'\n\
         [[effect]]\nkind = 'screw-periodic'\nharmonic = 2\namplitude = '{second_um} um'\n"
    );
    MachineFile::parse(&format!("{MACHINE}{effects}"), Path::new("machine.toml")).expect("a file")
}

/// Three passes of 300 rows over 300 mm with some errors, µm.
fn table(error_um: Vec<f64>) -> Table {
    let pass = |row: u32| f64::from(row / 300);
    let place = |row: u32| f64::from(row % 300);
    let column = |name: &str, values: Vec<f64>| Column { name: name.to_owned(), values };
    Table::new(vec![
        column("pass", (0..ROWS).map(pass).collect()),
        column("time_s", (0..ROWS).map(|row| 90.0 * pass(row) + place(row) / 4.0).collect()),
        column("position_mm", (0..ROWS).map(place).collect()),
        column("error_um", error_um),
    ])
}

/// The diagnosis, with one machine's file, of what another one shows in noise of 0.05 µm.
fn measured(file: &MachineFile, true_one: &MachineFile) -> Diagnosis {
    let nothing = compare(&problem(&true_one.model, &table(vec![0.0; ROWS as usize])));
    let mut noise = white(11, 0.05);
    let shown = nothing.residual.iter().map(|left| noise() - left).collect();
    diagnose(&problem(&file.model, &table(shown)))
}

/// Value, standard error and what the file says of a parameter of the only effect that is found.
fn only(found: &Diagnosis, kind: &str, key: &str) -> (f64, f64, f64) {
    assert_eq!((names(found), found.verdict), (vec![kind], Verdict::Explained));
    let effects = &found.rounds.last().expect("a round").effects;
    let one = effects[0].parameters.iter().find(|one| one.key == key).expect("the parameter");
    (one.value, one.stderr.expect("an error"), one.file_says.expect("it is in the file"))
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_of_another_size_takes_the_place_of_the_files_own() {
    let file = machine(1.5, 0.4, [2.0, 20.0]);
    let found = measured(&file, &machine(1.62, 0.4, [2.0, 20.0]));
    let (value, stderr, before) = only(&found, "screw-periodic", "amplitude_um");
    assert!((value - 1.62).abs() < 3.0 * stderr && stderr < 0.01, "{value} ± {stderr}");
    assert_eq!(before.to_bits(), 1.5_f64.to_bits());
    let effects = &found.rounds.last().expect("a round").effects;
    let learned = written(&file, effects).expect("a machine");
    assert_eq!(learned.model.effects.len(), 3);
    assert_eq!(learned.model.effects[0].values[0].to_bits(), value.to_bits());
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_time_that_enters_in_no_proportion_is_found_too() {
    let file = machine(1.5, 0.4, [2.0, 40.0]);
    let found = measured(&file, &machine(1.5, 0.4, [2.0, 20.0]));
    let (value, stderr, before) = only(&found, "headstock-growth", "time_constant_s");
    assert!((value - 20.0).abs() < 3.0 * stderr && stderr < 2.0, "{value} ± {stderr}");
    assert_eq!(before.to_bits(), 40.0_f64.to_bits());
}

/// What the file says and the data do not show is found to be nothing, which is no useless answer.
#[test]
fn an_effect_that_has_gone_is_found_to_be_nothing() {
    let found = measured(&machine(1.5, 0.4, [2.0, 20.0]), &machine(1.5, 0.0, [2.0, 20.0]));
    let (value, stderr, before) = only(&found, "screw-periodic", "amplitude_um");
    assert!(value < 4.0 * stderr && stderr < 0.01, "{value} ± {stderr}");
    assert_eq!(before.to_bits(), 0.4_f64.to_bits());
}
