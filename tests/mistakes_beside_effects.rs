//! Mistakes of input that effects of the catalogue explain as well, with more numbers.

use std::path::Path;

use helixlock_lab::{Diagnosis, Verdict, compare, diagnose};
use helixlock_plant::Model;
use helixlock_traces::{Column, Table};

use crate::support::diagnosed::{MACHINE, diagnosed_on, names, problem};
use crate::support::passes::white;

/// A machine of two waves, and of a carriage that tips.
fn known() -> Model {
    let effects = "[[effect]]\nkind = 'screw-periodic'\namplitude = '2 um'\nphase = '40 deg'\n\
                   [[effect]]\nkind = 'gear-error'\norder = 2.5\namplitude = '1.1 um'\n\
                   [[effect]]\nkind = 'abbe'\noffset = '60 mm'\n";
    Model::parse(&format!("{MACHINE}{effects}"), Path::new("machine.toml")).expect("a machine")
}

/// One pass of 600 rows over 300 mm at the machine's speed.
fn table(error_um: Vec<f64>) -> Table {
    let place = |row: u32| 0.5 * f64::from(row);
    let column = |name: &str, value: &dyn Fn(u32) -> f64| Column {
        name: name.to_owned(),
        values: (0..600).map(value).collect(),
    };
    let error = Column { name: "error_um".to_owned(), values: error_um };
    Table::new(vec![
        column("time_s", &|row| place(row) / 4.0),
        column("position_mm", &place),
        column("bed_pitch_arcsec", &|row| 2.0 * libm::sin(0.02 * place(row))),
        error,
    ])
}

/// What is found where `machine` shows its effects, something more and noise of 0.05 µm, and one column was
/// written otherwise.
fn mistaken(more_um: impl Fn(f64) -> f64, column: &str, change: impl Fn(f64) -> f64) -> Diagnosis {
    let machine = known();
    let nothing = compare(&problem(&machine, &table(vec![0.0; 600])));
    let mut noise = white(7, 0.05);
    let rows = (0..600_u32).zip(&nothing.residual);
    let shown = rows.map(|(row, left)| more_um(0.5 * f64::from(row)) - left + noise());
    let mut table = table(shown.collect());
    let found = table.columns.iter_mut().find(|one| one.name == column).expect("the column");
    found.values.iter_mut().for_each(|value| *value = change(*value));
    diagnose(&problem(&machine, &table))
}

fn doubted(found: &Diagnosis) -> String {
    assert_eq!(found.verdict, Verdict::DoubtfulInput, "{:?}", names(found));
    found.doubts[0].says.clone()
}

/// A shifted zero beside a worn place, whose own effect stays where it is found.
#[test]
fn a_shift_beside_an_effect_is_doubted() {
    let wear = |mm: f64| -0.6 * libm::exp(-0.5 * ((mm - 140.0) / 12.0).powi(2));
    let says = doubted(&mistaken(wear, "position_mm", |mm| mm + 1.7));
    let lies = says.split("lies ").nth(1).and_then(|rest| rest.split(' ').next());
    let shift_mm: f64 = lies.expect("a shift").parse().expect("a number");
    assert!((shift_mm - 1.7).abs() < 0.01, "{says}");
    let sound = mistaken(wear, "position_mm", |mm| mm);
    assert_eq!((names(&sound), sound.verdict), (vec!["screw-wear"], Verdict::Explained));
}

/// A position that counts the other way, from the same zero and from its far end.
#[test]
fn a_position_that_counts_the_other_way_is_doubted() {
    let says = doubted(&mistaken(|_| 0.0, "position_mm", |mm| -mm));
    assert!(says.contains("`position_mm` has the opposite sign"), "{says}");
    let says = doubted(&mistaken(|_| 0.0, "position_mm", |mm| 299.5 - mm));
    assert!(says.contains("the other way, from 299.5"), "{says}");
}

/// An inclinometer that was mounted the other way round: the arm would be −60 mm.
#[test]
fn a_logged_column_of_the_other_sign_is_doubted() {
    let says = doubted(&mistaken(|_| 0.0, "bed_pitch_arcsec", |arcsec| -arcsec));
    assert!(says.contains("`bed_pitch_arcsec` has the opposite sign"), "{says}");
}

/// A wave of twice the order of the file's, larger than that one and of its phase, is not the file's on places of
/// half the length: that one is there as well.
#[test]
fn a_larger_second_harmonic_of_the_screw_is_no_unit_of_the_position() {
    let machine = "spindle.speed = '60 rpm'\nlead_screw.lead = '6 mm'\n\
                   effect = [{ kind = 'screw-periodic', amplitude = '2 um', phase = '-36 deg' }]\n";
    let phase = (-36_f64).to_radians();
    for seed in 1..4 {
        let (mut noise, mut uneven) = (white(seed, 2.0), white(seed + 100, 0.8));
        let mut columns = [const { Vec::new() }; 3];
        for row in 0..400_u32 {
            let (pass, nth) = (row / 100, row % 100);
            let nth = if pass % 2 == 0 { nth } else { 99 - nth };
            let mm = 2.5 * f64::from(nth) + uneven();
            let angle = std::f64::consts::TAU * mm / 6.0;
            let error_um = -2.0 * libm::sin(angle + phase) - 3.3 * libm::sin(2.0 * angle + phase);
            let cells = [f64::from(pass), mm, error_um + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "position_mm", "error_um"];
        let found = diagnosed_on(machine, titles.into_iter().zip(columns).collect());
        assert!(found.doubts.is_empty(), "{seed}: {:?}", found.doubts[0].says);
        assert_eq!(names(&found), ["screw-periodic"], "{seed}");
    }
}

/// The error under the position's name and the other way round, in a log that has a clock.
#[test]
fn an_exchange_of_position_and_error_is_doubted() {
    let machine = known();
    let mut table = table((0..600).map(|row| 3.0 * libm::sin(0.37 * f64::from(row))).collect());
    for column in &mut table.columns {
        let other = match column.name.as_str() {
            "position_mm" => "error_um",
            "error_um" => "position_mm",
            _ => continue,
        };
        other.clone_into(&mut column.name);
    }
    let says = doubted(&diagnose(&problem(&machine, &table)));
    assert!(says.contains("`error_um` and `position_mm` are exchanged"), "{says}");
}

/// A recorder that lags takes the screw's wave nearly away from the error and not from the thread's: no unit does.
#[test]
fn a_wave_that_one_sensor_sees_otherwise_is_in_no_other_unit() {
    let wave = "[[effect]]\nkind = 'screw-periodic'\namplitude = '2 um'\nphase = '40 deg'\n";
    let machine = Model::parse(&format!("{MACHINE}{wave}"), Path::new("machine.toml"));
    let machine = machine.expect("a machine");
    let thread = Column { name: "lead_error_um".to_owned(), values: vec![0.0; 600] };
    let mut both = table(vec![0.0; 600]);
    both.columns.push(thread);
    let nothing = compare(&problem(&machine, &both));
    let (mut noise, mut late) = (white(5, 0.3), 0.0);
    let shown: Vec<f64> = nothing.residual.iter().map(|left| -left).collect();
    for row in 0..600 {
        late += (shown[row] - late) * (1.0 - libm::exp(-0.125 / 4.0));
        both.columns[3].values[row] = late + noise();
        both.columns[4].values[row] = shown[600 + row] + noise();
    }
    let found = diagnose(&problem(&machine, &both));
    assert!(found.doubts.is_empty(), "{:?}", found.doubts);
    assert_eq!(names(&found), ["recorder-lag"]);
}
