//! Mistakes of input that effects of the catalogue explain as well, with more numbers.

use std::path::Path;

use helixlock_lab::{Diagnosis, Verdict, compare, diagnose};
use helixlock_plant::Model;
use helixlock_traces::{Column, Table};

use crate::support::diagnosed::{MACHINE, diagnosed_on, names, problem};
use crate::support::passes::white;
use crate::support::seeds::seeds;

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
#[ignore = "long: `cargo xtask campaign` runs it"]
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
#[ignore = "long: `cargo xtask campaign` runs it"]
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
#[ignore = "long: `cargo xtask campaign` runs it"]
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
#[ignore = "long: `cargo xtask campaign` runs it"]
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

/// A stage that a laser measures through air that the file knows; rows of time, pass, place, direction, what is shown
/// beside the air and the bed's pitch there.
fn on_a_stage(rows: impl Iterator<Item = [f64; 6]>) -> Diagnosis {
    const STAGE: &str = "spindle.speed = '120 rpm'\nlead_screw.lead = '4 mm'\n\
                         laser.wavelength = '0.63281983 um'\n\
                         effect = [{ kind = 'air-temperature' }, { kind = 'air-pressure' }]\n";
    let machine = Model::parse(STAGE, Path::new("machine.toml")).expect("a machine");
    let names = ["time_s", "pass", "position_mm", "direction", "error_um", "bed_pitch_arcsec"];
    let mut columns = names.map(|name| Column { name: name.to_owned(), values: Vec::new() });
    for row in rows {
        columns.iter_mut().zip(row).for_each(|(column, cell)| column.values.push(cell));
    }
    let time_s = columns[0].values.clone();
    let air = |name: &str, of: &dyn Fn(f64) -> f64| Column {
        name: name.to_owned(),
        values: time_s.iter().map(|time_s| of(*time_s)).collect(),
    };
    let warmer = air("air_temperature_c", &|time_s| 21.3 - time_s / 1300.0);
    let heavier = air("air_pressure_hpa", &|time_s| 1015.25 - time_s / 800.0);
    let mut table = Table::new(columns.into_iter().chain([warmer, heavier]).collect());
    let of_the_air = compare(&problem(&machine, &table)).residual;
    // What is predicted is what was read less what that leaves.
    for (value, left) in table.columns[4].values.iter_mut().zip(&of_the_air) {
        *value += *value - left;
    }
    diagnose(&problem(&machine, &table))
}

/// Pass, place and direction of a row, each pass there and back over so many places.
fn there_and_back(row: u32, places: u32, apart_mm: f64) -> [f64; 3] {
    let (pass, nth) = (row / (2 * places), row % (2 * places));
    let (place, direction) = if nth < places { (nth, 1.0) } else { (2 * places - 1 - nth, -1.0) };
    [f64::from(pass), apart_mm * f64::from(place), direction]
}

/// A bed that leans: its pitch, read as the air's temperature, would be a slope and what leans beside it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_bed_that_leans_is_no_exchange_with_the_air() {
    for seed in seeds(1, 8) {
        let mut noise = white(seed, 0.15);
        let rows = (0..372_u32).map(|row| {
            let [pass, place_mm, direction] = there_and_back(row, 93, 4.3);
            let time_s = 0.73 * f64::from(row % 186) + 432.0 * pass;
            let pitch_arcsec = 2.0 * libm::sin(0.022 * place_mm - 0.8);
            let leans_um = 50.0 * 4.848e-3 * pitch_arcsec;
            [time_s, pass, place_mm, direction, leans_um + noise(), pitch_arcsec]
        });
        let found = on_a_stage(rows);
        assert!(found.doubts.is_empty(), "{seed}: {:?}", found.doubts[0].says);
        assert_eq!(names(&found), ["abbe"], "{seed}");
    }
}

/// Eleven targets there and back in five runs: a slip of the laser in one of them is no other unit of its errors.
#[test]
fn a_slip_in_one_run_is_no_unit_of_it() {
    for seed in seeds(1, 8) {
        let mut noise = white(seed, 0.12);
        let rows = (0..110_u32).map(|row| {
            let [run, place_mm, direction] = there_and_back(row, 11, 81.4);
            let time_s = 13.7 * f64::from(row) + 40.0 * run;
            let slipped_um = if row < 96 { 0.0 } else { 7.0 * 0.316_41 };
            [time_s, run, place_mm, direction, slipped_um + noise(), 0.0]
        });
        let found = on_a_stage(rows);
        assert!(found.doubts.is_empty(), "{seed}: {:?}", found.doubts[0].says);
        assert_eq!(names(&found), ["fringe-slip"], "{seed}");
    }
}
