mod files_and_logs;
mod one_pass;
mod places_and_names;

use std::path::Path;

use helixlock_plant::{Model, Role};
use helixlock_traces::{Column, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::measurement::{Measurement, Nominal};

const WAVES: &str = "[[effect]]\nkind = 'screw-periodic'\namplitude = '2 um'\nphase = '40 deg'\n\
                     [[effect]]\nkind = 'gear-error'\norder = 2.5\namplitude = '1.1 um'\n";

fn machine(b: u16, effects: &str) -> Model {
    let text = format!(
        "workpiece = {{ lead = '6 mm', length = '300 mm' }}\nspindle.speed = '6 rpm'\n\
         lead_screw.lead = '14 mm'\ngrating.lines = 13906\nlaser.wavelength = '0.63281983 um'\n\
         dividers = {{ a = 110, b = {b} }}\n\
         drive = {{ step = '0.0125 um', frequency = '160 Hz' }}\n{effects}"
    );
    Model::parse(&text, Path::new("machine.toml")).expect("a machine")
}

/// A pass of 300 mm at 6 rpm; air that swings by a kelvin about 21 °C.
fn table(error_um: &[f64]) -> Table {
    let column = |name: &str, values: Vec<f64>| Column { name: name.to_owned(), values };
    let place = |row: usize| 0.5 * crate::numerics::count(row);
    let rows = 0..error_um.len();
    let air = |row: usize| 21.0 + libm::sin(0.03 * place(row));
    Table::new(vec![
        column("position_mm", rows.clone().map(place).collect()),
        column("time_s", rows.clone().map(|row| place(row) / 0.6).collect()),
        column("air_temperature_c", rows.map(air).collect()),
        column("error_um", error_um.to_vec()),
    ])
}

fn problem(model: &Model, table: &Table) -> Problem {
    let measurement = Measurement::from_table(table, &Nominal::of(model)).expect("samples");
    Problem::new(model, &measurement).expect("no column is missing")
}

/// What the recorder shows of a machine, with noise of 0.05 µm.
fn measured(model: &Model) -> Table {
    let rows = 600;
    let clean = problem(model, &table(&vec![0.0; rows])).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let noise = |value: &f64| -> f64 {
        let fresh: f64 = StandardNormal.sample(&mut chance);
        value + 0.05 * fresh
    };
    table(&clean.iter().map(noise).collect::<Vec<_>>())
}

fn changed(mut table: Table, column: &str, mut change: impl FnMut(f64) -> f64) -> Table {
    let found = table.columns.iter_mut().find(|one| one.name == column).expect("the column");
    found.values.iter_mut().for_each(|value| *value = change(*value));
    table
}

/// What and how of the clearest doubt.
fn doubted(model: &Model, table: &Table) -> Option<(&'static str, String)> {
    doubts(&problem(model, table)).into_iter().next().map(|one| (one.what, one.mend))
}

#[test]
fn sound_data_are_not_doubted() {
    let known = machine(150, WAVES);
    assert_eq!(doubted(&known, &measured(&known)), None);
    let bare = machine(150, "");
    assert_eq!(doubted(&bare, &measured(&bare)), None);
    assert_eq!(doubted(&bare, &measured(&known)), None, "what is hidden is no mistake");
}

#[test]
fn a_sign_and_a_unit_are_told_by_what_the_file_predicts() {
    let known = machine(150, WAVES);
    let of = |factor: f64| {
        doubted(&known, &changed(measured(&known), "error_um", |value| factor * value))
    };
    let (what, mend) = of(-1.0).expect("a doubt");
    assert!(what == "sign" && mend.ends_with("sign = -1"), "{what} {mend}");
    let (what, mend) = of(1e-3).expect("a doubt");
    assert!(what == "unit" && mend.ends_with("unit = \"mm\""), "{what} {mend}");
    let (what, mend) = of(-1e3).expect("a doubt");
    assert!(what == "unit" && mend.ends_with("unit = \"nm\"\nsign = -1"), "{what} {mend}");
}

/// 600 rows there and back, the direction told as `way` on the way there.
fn there_and_back(error_um: &[f64], way: f64) -> Table {
    let mut table = table(error_um);
    let places = (0..600_u32).map(|row| 0.5 * f64::from(row.min(600 - row)));
    table.columns[0].values = places.collect();
    let directions = (0..600).map(|row| if row < 300 { way } else { -way });
    table.columns.push(Column { name: "direction".to_owned(), values: directions.collect() });
    table
}

/// Play as the machine has it, its direction told the other way round: a negative width would fit.
#[test]
fn a_direction_against_the_travel_is_doubted_whatever_fits() {
    let play = machine(150, &format!("{WAVES}[[effect]]\nkind = 'backlash'\nwidth = '4 um'\n"));
    let clean = problem(&play, &there_and_back(&[0.0; 600], 1.0)).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let shown: Vec<f64> = clean.iter().map(|value| value + 0.05 * noise()).collect();
    for known in [&play, &machine(150, WAVES)] {
        assert_eq!(doubted(known, &there_and_back(&shown, 1.0)), None);
        let (what, mend) = doubted(known, &there_and_back(&shown, -1.0)).expect("a doubt");
        assert!(what == "sign" && mend.contains("to = \"direction\"\nsign = -1"), "{what} {mend}");
    }
}

/// Two passes there and back, the direction of the second turned.
#[test]
fn a_direction_against_the_travel_of_one_pass_is_doubted() {
    let known = machine(150, "");
    let of = |second: f64| {
        let mut table = there_and_back(&[0.0; 600], 1.0);
        let pass = |row: u32| if row < 300 { 1.0 } else { 2.0 };
        table
            .columns
            .push(Column { name: "pass".to_owned(), values: (0..600).map(pass).collect() });
        let direction = table.columns.iter_mut().find(|one| one.name == "direction");
        let turned = direction.expect("a column").values.iter_mut().skip(300);
        turned.for_each(|value| *value *= second);
        doubted(&known, &table)
    };
    assert_eq!(of(1.0), None);
    assert_eq!(of(-1.0), Some(("sign", "turn `direction` in pass 2".to_owned())));
}

/// Without a clock, a way back may be listed as one likes.
#[test]
fn one_way_without_a_clock_denies_nothing() {
    let known = machine(150, "");
    let mut back = measured(&known);
    back.columns.retain(|column| column.name != "time_s");
    let rows = back.rows();
    back.columns.push(Column { name: "direction".to_owned(), values: vec![-1.0; rows] });
    assert_eq!(doubted(&known, &back), None);
}

/// A table of 0.5 mm a row at 6 rpm, whatever the file knows of its error.
#[test]
fn a_clock_in_another_unit_is_told_by_travel_and_speed() {
    let known = machine(150, "");
    let with_speed = |rpm: f64| {
        let mut table = measured(&known);
        let rows = table.rows();
        table.columns.push(Column { name: "speed_rpm".to_owned(), values: vec![rpm; rows] });
        table
    };
    for (unit, factor) in [("ms", 1e-3), ("min", 60.0), ("h", 3600.0)] {
        for table in [measured(&known), with_speed(6.0)] {
            let table = changed(table, "time_s", |time_s| time_s / factor);
            let (what, mend) = doubted(&known, &table).expect("a doubt");
            assert!(what == "unit" && mend.contains("to = \"time_s\""), "{what} {mend}");
            assert!(mend.ends_with(&format!("unit = \"{unit}\"")), "{mend}");
        }
    }
    // Rounded to a sixth of what passes between two rows.
    let rounded =
        changed(measured(&known), "time_s", |time_s| (600.0 * time_s / 60.0).round() / 600.0);
    let (_, mend) = doubted(&known, &rounded).expect("a doubt");
    assert!(mend.ends_with("unit = \"min\""), "{mend}");
    // A spindle that slips, so that the travel is not worked out from the clock.
    let slipping = changed(with_speed(0.1), "time_s", |time_s| 1.002 * time_s);
    let (_, mend) = doubted(&known, &slipping).expect("a doubt");
    assert!(mend.contains("to = \"speed_rpm\""), "{mend}");
}

/// A speed that is nominal only, an axis that dwells at targets, and one that moves as fast as told.
#[test]
fn a_clock_that_is_no_units_factor_off_is_not_doubted() {
    let known = machine(150, "");
    for factor in [1.0 / 50.0, 0.5, 10.0, 55.0, 900.0] {
        let other = changed(measured(&known), "time_s", |time_s| time_s * factor);
        assert_eq!(doubted(&known, &other), None, "{factor}");
    }
    let mut row = 0.0;
    let dwelling = changed(measured(&known), "time_s", |time_s| {
        row += 1.0;
        (time_s + 3.0 * row + 2.0 * libm::sin(row)) / 60.0
    });
    assert_eq!(doubted(&known, &dwelling), None);
}

/// Two readings at each target, between which the axis trembles: at no speed, and no clock is doubted.
#[test]
fn an_axis_that_trembles_at_its_targets_tells_no_speed() {
    let known = machine(150, "");
    for tremble_mm in [3e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3] {
        let mut row = -1.0_f64;
        let visits = changed(measured(&known), "position_mm", |_| {
            row += 1.0;
            let read = 3.0 * (0.5 * row).floor() + tremble_mm * libm::sin(37.0 * row * row);
            (1e5 * read).round() / 1e5
        });
        let mut row = -1.0_f64;
        let visits = changed(visits, "time_s", |_| {
            row += 1.0;
            2.0 * row + 2.5 * (0.5 * row).floor() + 0.3 * libm::sin(11.0 * row)
        });
        assert_eq!(doubted(&known, &visits), None, "{tremble_mm} mm");
    }
}

#[test]
fn a_slipped_decimal_point_is_told_where_every_effect_grew() {
    let known = machine(150, WAVES);
    let of = |model: &Model, factor: f64| {
        doubted(model, &changed(measured(model), "error_um", |value| factor * value))
    };
    let (what, mend) = of(&known, 0.1).expect("a doubt");
    assert!(what == "unit" && mend.ends_with("unit = \"10 um\""), "{what} {mend}");
    let (what, mend) = of(&known, 10.0).expect("a doubt");
    assert!(what == "unit" && mend.ends_with("unit = \"0.1 um\""), "{what} {mend}");
    for (factor, unit) in [(0.5, "2 um"), (2.0, "0.5 um")] {
        let (what, mend) = of(&known, factor).expect("a doubt");
        assert!(what == "unit" && mend.ends_with(&format!("\"{unit}\"")), "{what} {mend}");
    }
    let (one, _) = WAVES.split_at(WAVES.rfind("[[effect]]").expect("two effects"));
    assert_eq!(of(&machine(150, one), 0.1), None, "one effect may shrink");
}

#[test]
fn without_a_prediction_a_sign_is_not_told() {
    let bare = machine(150, "");
    let turned = changed(measured(&machine(150, WAVES)), "error_um", |value| -value);
    assert_eq!(doubted(&bare, &turned), None);
}

#[test]
fn fahrenheit_is_told_by_the_swing_and_by_the_shop() {
    let known = machine(150, "[[effect]]\nkind = 'air-temperature'\n");
    let hot = |value: f64| 1.8 * value + 32.0;
    for model in [&known, &machine(150, "")] {
        let table = changed(measured(&known), "air_temperature_c", hot);
        let (what, mend) = doubted(model, &table).expect("a doubt");
        assert!(what == "unit" && mend.contains("degf"), "{what} {mend}");
    }
}

/// A chamber that is heated from 22 to 95 °C: its median is usual in °F.
#[test]
fn what_is_heated_is_not_in_fahrenheit() {
    let mut row = 0.0;
    let heated = changed(measured(&machine(150, "")), "air_temperature_c", |_| {
        row += 1.0;
        22.0 + 73.0 * (1.0 - libm::exp(-row / 150.0))
    });
    assert_eq!(doubted(&machine(150, ""), &heated), None);
}

/// Weather in which a machine shows what it is known for is not doubted, and is in mmHg.
fn mercury_is_told(known: &Model, weather: Table, noise_um: f64) {
    let clean = problem(known, &weather).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(11);
    let mut row = 0;
    let sound = changed(weather, "error_um", |_| {
        row += 1;
        let fresh: f64 = StandardNormal.sample(&mut chance);
        clean[row - 1] + noise_um * fresh
    });
    assert_eq!(doubted(known, &sound), None);
    let mercury = changed(sound, "air_pressure_hpa", |hpa| hpa * 760.0 / 1013.25);
    let (what, mend) = doubted(known, &mercury).expect("a doubt");
    assert!(what == "unit" && mend.contains("mmhg"), "{what} {mend}");
}

/// A door that was opened and shut, logged by a clock that is a quarter of a minute fast or slow; a recorder's lag would
/// delay waves too.
#[test]
fn a_log_by_another_clock_is_told() {
    let known = machine(150, &format!("{WAVES}[[effect]]\nkind = 'air-temperature'\n"));
    let logged = |table: Table, rows: f64| {
        let mut row = -1.0;
        changed(table, "air_temperature_c", |_| {
            row += 1.0;
            let since = (row - rows - 250.0) / 60.0;
            21.0 + 4.0 * since * libm::exp(-since * since)
        })
    };
    let swinging = logged(table(&[0.0; 600]), 0.0);
    let clean = problem(&known, &swinging).predicted;
    let mut row = 0;
    let seen = changed(measured(&machine(150, "")), "error_um", |noise| {
        row += 1;
        noise + clean[row - 1]
    });
    assert_eq!(doubted(&known, &logged(seen.clone(), 0.0)), None);
    for (rows, mend) in [(18.0, "take 1"), (-18.0, "add 1")] {
        let (what, told) = doubted(&known, &logged(seen.clone(), rows)).expect(mend);
        assert!(what == "shift" && told.starts_with(mend) && told.contains("the clock"), "{told}");
    }
}

/// 1008 hPa swinging by two are 756 mmHg: a slope of 69 µm/m, which anything may have, and a little more.
#[test]
fn millimetres_of_mercury_are_told_by_the_slope_that_they_make() {
    let known = machine(150, "[[effect]]\nkind = 'air-pressure'\n");
    let mut weather = table(&vec![0.0; 600]);
    let hpa = (0..600).map(|row| 1008.0 + 2.0 * libm::sin(0.02 * crate::numerics::count(row)));
    weather.columns.push(Column { name: "air_pressure_hpa".to_owned(), values: hpa.collect() });
    mercury_is_told(&known, weather, 0.02);
}

/// A pressure that is steady: nothing but a slope, which the file's reference makes likely.
#[test]
fn millimetres_of_mercury_are_told_by_the_reference_of_the_file() {
    let known = machine(150, &format!("{WAVES}[[effect]]\nkind = 'air-pressure'\n"));
    let mut weather = table(&vec![0.0; 600]);
    let steady = |hpa: f64| Column { name: "air_pressure_hpa".to_owned(), values: vec![hpa; 600] };
    weather.columns.push(steady(1008.0));
    mercury_is_told(&known, weather, 0.1);
    let bare = machine(150, "");
    let mut high_up = measured(&bare);
    high_up.columns.push(steady(758.0));
    assert_eq!(doubted(&bare, &high_up), None, "a machine at 2400 m");
}

#[test]
fn another_zero_of_the_position_is_found() {
    let bump = "[[effect]]\nkind = 'screw-wear'\nheight = '2.5 um'\nposition = '140 mm'\n\
                width = '9 mm'\n";
    let known = machine(150, &format!("{WAVES}{bump}"));
    let shifted = changed(measured(&known), "position_mm", |place| place + 4.2);
    let (what, mend) = doubted(&known, &shifted).expect("a doubt");
    assert!(what == "shift" && mend.starts_with("take 4.2"), "{what} {mend}");
}

/// The rows of a table once more behind it, as another pass a while later.
fn twice(mut table: Table) -> Table {
    let rows = table.columns[0].values.len();
    for column in &mut table.columns {
        let later = if column.name == "time_s" { 700.0 } else { 0.0 };
        let again: Vec<f64> = column.values.iter().map(|value| value + later).collect();
        column.values.extend(again);
    }
    let passes = (0..2 * rows).map(|row| if row < rows { 1.0 } else { 2.0 });
    table.columns.push(Column { name: "pass".to_owned(), values: passes.collect() });
    table
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn another_zero_of_one_pass_is_found() {
    let bump = "[[effect]]\nkind = 'screw-wear'\nheight = '2.5 um'\nposition = '140 mm'\n\
                width = '9 mm'\n";
    let known = machine(150, &format!("{WAVES}{bump}"));
    let twice = twice(measured(&known));
    let rows = twice.rows() / 2;
    let mut chance = ChaCha8Rng::seed_from_u64(8);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let twice = changed(twice, "error_um", |value| value + 0.01 * noise());
    let mut number = 0;
    assert_eq!(doubted(&known, &twice), None);
    let second = changed(twice, "position_mm", |place| {
        number += 1;
        if rows < number { place + 4.2 } else { place }
    });
    let (what, mend) = doubted(&known, &second).expect("a doubt");
    assert!(what == "shift" && mend.starts_with("take 4.2"), "{what} {mend}");
    assert!(mend.ends_with("of pass 2"), "{mend}");
}

/// Three ways along the travel, the last at three times the speed, all 0.4 s late: 0.24 mm, and 0.72.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_recorder_that_lags_is_no_zero_of_the_faster_pass() {
    let (wave, _) = WAVES.split_at(WAVES.rfind("[[effect]]").expect("two effects"));
    let known = machine(150, wave);
    let lag = "[[effect]]\nkind = 'recorder-lag'\ntime_constant = '0.4 s'\n";
    let ways = |error_um: &[f64]| {
        let mut all = table(error_um);
        let pass = |row: u32| row / 600;
        let speed = |row: u32| if pass(row) < 2 { 6.0 } else { 18.0 };
        let along = |row: u32| 0.5 * f64::from(row % 600);
        let rows = || 0..1800_u32;
        all.columns[0].values = rows().map(along).collect();
        let time_s = |row| f64::from(pass(row)) * 700.0 + along(row) / 0.1 / speed(row);
        all.columns[1].values = rows().map(time_s).collect();
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        all.columns.push(column("speed_rpm", rows().map(speed).collect()));
        all.columns.push(column("pass", rows().map(|row| f64::from(pass(row) + 1)).collect()));
        all
    };
    let late = machine(150, &format!("{wave}{lag}"));
    let clean = problem(&late, &ways(&[0.0; 1800])).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let shown: Vec<f64> = clean.iter().map(|value| value + 0.05 * noise()).collect();
    assert_eq!(doubted(&known, &ways(&shown)), None);
}

/// What a clock shows at the start of a record is no part of it.
#[test]
fn the_zero_of_the_clock_is_none() {
    let shaken = machine(
        150,
        "[[effect]]\nkind = 'vibration'\nfrequency = '0.031 Hz'\namplitude = '1.1 um'\n",
    );
    let late = changed(measured(&shaken), "time_s", |time_s| time_s + 1.7e9);
    assert_eq!(doubted(&shaken, &late), None);
    let [late, sound] = [late, measured(&shaken)].map(|table| problem(&shaken, &table).residual());
    assert!(late.iter().zip(&sound).all(|(late, sound)| (late - sound).abs() < 1e-6));
}

/// A servo's position instead of its error, and one that counts the other way.
#[test]
fn a_position_in_place_of_the_error_is_told() {
    let bare = machine(150, "");
    let error = measured(&machine(150, WAVES));
    for (share, word) in [(1.0, "minus"), (2.0, "opposite"), (0.4, "0.6000 times")] {
        let mut table = error.clone();
        let place = table.column("position_mm").expect("a place").to_vec();
        let mut row = 0;
        table = changed(table, "error_um", |value| {
            row += 1;
            value + 1000.0 * share * place[row - 1]
        });
        let (what, mend) = doubted(&bare, &table).expect("a doubt");
        assert!(what == "position-for-error" && mend.contains(word), "{what} {mend}");
    }
}

/// A speed that follows from clock and travel stands in no column.
#[test]
fn a_speed_that_no_column_tells_is_not_doubted() {
    let slow = machine(150, "");
    let late = changed(measured(&slow), "time_s", |time_s| 60.0 * time_s);
    assert_eq!(doubted(&slow, &late).filter(|(_, mend)| mend.contains("speed_rpm")), None);
}

#[test]
fn dividers_of_another_lead_are_doubted_unless_the_data_show_them() {
    let right = machine(150, "");
    let wrong = machine(125, "");
    assert_eq!(doubted(&wrong, &measured(&right)), Some(("dividers", "b = 150".to_owned())));
    assert_eq!(doubted(&wrong, &measured(&wrong)), None);
    assert!(divider_doubt(&right).is_none());
    assert_eq!(divider_doubt(&wrong).expect("a doubt").mend, "b = 150");
}

#[test]
fn effects_that_the_data_show_nothing_of_belong_to_another_machine() {
    let doubt = doubted(&machine(150, WAVES), &measured(&machine(150, "")));
    assert_eq!(doubt.expect("a doubt").0, "another-machine");
}

/// A pressure that was read five times only says little of what the air did between.
#[test]
fn what_a_held_log_predicts_is_no_other_machine() {
    let air =
        machine(150, "[[effect]]\nkind = 'air-pressure'\n[[effect]]\nkind = 'air-temperature'\n");
    let mut held = changed(measured(&machine(150, "")), "air_temperature_c", |_| 20.0);
    let readings = [1004.0, 1011.0, 1001.0, 1012.0, 1003.0];
    let values = readings.iter().flat_map(|hpa| std::iter::repeat_n(*hpa, 120)).collect();
    held.columns.push(Column { name: "air_pressure_hpa".to_owned(), values });
    let holds = problem(&air, &held).measurement.holds("air_pressure_hpa");
    assert!(holds, "five readings settle no clock");
    assert_eq!(doubted(&air, &held), None);
}

#[test]
fn copies_are_told_and_what_was_measured_again_is_none() {
    let bare = machine(150, "");
    let copied = twice(measured(&bare));
    let (what, mend) = doubted(&bare, &copied).expect("a doubt");
    assert_eq!((what, mend.as_str()), ("copy", "leave pass 2 out"));
    let rows = measured(&bare).rows();
    let mut nth = 0;
    let and_a_constant = changed(copied.clone(), "error_um", |value| {
        nth += 1;
        if nth <= rows { value } else { value + 0.37 }
    });
    assert_eq!(doubted(&bare, &and_a_constant), Some((what, mend)));
    let mut half = copied.clone();
    half.columns.iter_mut().for_each(|column| column.values.truncate(rows + rows / 2));
    assert_eq!(doubted(&bare, &half).map(|(what, _)| what), Some("copy"));
    let mut row = 0;
    let again = changed(copied, "error_um", |value| {
        row += 1;
        value + 0.01 * libm::sin(f64::from(row))
    });
    assert_eq!(doubted(&bare, &again), None);
    let mut doubled = measured(&bare);
    for column in &mut doubled.columns {
        column.values = column.values.iter().flat_map(|value| [*value; 2]).collect();
    }
    assert_eq!(doubted(&bare, &doubled).expect("a doubt").0, "copy");
}

/// Five passes over sixteen targets, the last as the first, on a display of 0.5 µm.
#[test]
fn a_coarse_display_copies_nothing() {
    let bare = machine(150, "");
    let shown = |noise_um: f64| {
        let mut chance = ChaCha8Rng::seed_from_u64(3);
        let mut flickers = || -> f64 {
            let fresh: f64 = StandardNormal.sample(&mut chance);
            0.5 * libm::round(noise_um * fresh / 0.5)
        };
        let places: Vec<f64> = (0..16).map(|target| 20.0 * f64::from(target)).collect();
        let mut errors: Vec<f64> =
            (0..64).map(|row| 0.5 * f64::from(row % 16 * (row % 16) % 7) + flickers()).collect();
        errors.extend_from_within(..16);
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        Table::new(vec![
            column("pass", (0..80).map(|row| f64::from(row / 16 + 1)).collect()),
            column("time_s", (0..80).map(|row| 20.0 * f64::from(row)).collect()),
            column("position_mm", places.repeat(5)),
            column("error_um", errors),
        ])
    };
    let copied =
        |noise_um| doubted(&bare, &shown(noise_um)).is_some_and(|(what, _)| what == "copy");
    assert!(!copied(0.1), "hardly a reading flickers");
    assert!(copied(1.0), "one in five is as in the last pass");
}

/// An indicator that sticks for eight rows; one that is rounded, and one that rests while the axis trembles.
#[test]
fn a_sensor_that_sticks_is_told() {
    let known = machine(150, WAVES);
    let held = |step: f64, parked: bool| {
        let mut table = measured(&known);
        for row in 0..table.rows() {
            let from = if (200..208).contains(&row) { 200 } else { row };
            let error = table.columns[3].values[from];
            table.columns[3].values[row] = step * libm::round(error / step);
            if parked {
                let trembles = if row % 2 == 0 { 1e-4 } else { 0.0 };
                table.columns[0].values[row] = 0.5 * crate::numerics::count(from) + trembles;
            }
        }
        doubted(&known, &table)
    };
    let (what, mend) = held(1e-6, false).expect("a doubt");
    assert_eq!(what, "stuck");
    assert!(mend.starts_with("leave the rows with `time_s` from 166.6"), "{mend}");
    assert_eq!(held(1.0, false), None, "rounded");
    assert_eq!(held(1e-6, true), None, "parked");
}

/// A temperature that is held whenever the axis moves, which is at rest most of the time: what repeats while it moves
/// is held against the rows that it moves for.
#[test]
fn what_is_set_for_a_while_is_not_stuck() {
    let known = machine(150, "");
    let mut table = measured(&known);
    let moves = |row: usize| (120..180).contains(&row) || (480..510).contains(&row);
    let mut place = 0.0;
    for row in 0..table.rows() {
        place += if moves(row) { 3.0 } else { 0.0 };
        table.columns[0].values[row] = place;
    }
    let mut row = 0;
    let set = changed(table, "air_temperature_c", |_| {
        row += 1;
        if moves(row - 1) { 22.0 } else { 20.0 + 0.01 * f64::from(u8::from(row % 2 == 0)) }
    });
    assert_eq!(doubted(&known, &set), None);
}

/// A display of half a micrometre of slow noise of 0.2 µm shows nought nearly always, and where it does not it stays.
#[test]
fn a_coarse_display_about_nought_is_not_stuck() {
    let known = machine(150, "");
    let mut chance = ChaCha8Rng::seed_from_u64(5);
    let mut table = measured(&known);
    let mut slow = 0.0;
    for shown in &mut table.columns[3].values {
        let fresh: f64 = StandardNormal.sample(&mut chance);
        slow = 0.95 * slow + 0.062 * fresh;
        *shown = 0.5 * libm::round(slow / 0.5);
    }
    assert_eq!(doubted(&known, &table), None);
}

/// Play that the file has, and that is taken up a target late: a slipped row at the turns and nowhere else.
#[test]
fn play_that_is_taken_up_late_is_no_slipped_row() {
    let known = machine(150, "[[effect]]\nkind = 'backlash'\nwidth = '4 um'\n");
    let target = |row: i32| 20.0 * f64::from(if row % 32 < 16 { row % 32 } else { 31 - row % 32 });
    let column = |name: &str, of: &dyn Fn(i32) -> f64| Column {
        name: name.to_owned(),
        values: (0..160).map(of).collect(),
    };
    let mut table = Table::new(vec![
        column("pass", &|row| f64::from(row / 32 + 1)),
        column("time_s", &|row| 20.0 * f64::from(row)),
        column("position_mm", &target),
        column("direction", &|row| if row % 32 < 16 { 1.0 } else { -1.0 }),
        column("error_um", &|_| 0.0),
    ]);
    let clean = problem(&known, &table).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    for row in 0..160 {
        let late = if row % 32 == 16 { row - 1 } else { row };
        let fresh: f64 = StandardNormal.sample(&mut chance);
        table.columns[4].values[row] = clean[late] + 0.3 * fresh;
    }
    assert_eq!(doubted(&known, &table), None);
}

/// A column that was pasted three rows too low.
#[test]
fn a_slipped_column_is_told_by_its_rows() {
    let known = machine(150, WAVES);
    let mut slipped = measured(&known);
    for column in &mut slipped.columns {
        let back: Vec<f64> = column.values.iter().rev().copied().collect();
        column.values.extend(back);
    }
    let rows = slipped.rows();
    let mut passes = Vec::with_capacity(rows);
    for row in 0..rows {
        passes.push(if row < rows / 2 { 1.0 } else { 2.0 });
        slipped.columns[1].values[row] = crate::numerics::count(row);
    }
    slipped.columns[3].values.rotate_right(3);
    slipped.columns.push(Column { name: "pass".to_owned(), values: passes });
    let (what, mend) = doubted(&known, &slipped).expect("a doubt");
    assert_eq!((what, mend.as_str()), ("shift", "move `error_um` up by 3 rows in every pass"));
}

/// One wave and play, there and back at one speed: but for its turns, a column a row too low is a sine of each way its
/// own.
#[test]
fn a_slipped_column_is_told_where_the_axis_turns_back() {
    let wave = "[[effect]]\nkind = 'screw-periodic'\namplitude = '2 um'\nphase = '20 deg'\n";
    let play = "[[effect]]\nkind = 'backlash'\nwidth = '3 um'\n";
    let known = machine(150, &format!("{wave}{play}"));
    let place = |row: i32| if row % 400 < 200 { row % 400 } else { 399 - row % 400 };
    let column = |name: &str, of: &dyn Fn(i32) -> f64| Column {
        name: name.to_owned(),
        values: (0..800).map(of).collect(),
    };
    let mut table = Table::new(vec![
        column("pass", &|row| f64::from(row / 400 + 1)),
        column("time_s", &|row| 0.0754 * f64::from(row)),
        column("position_mm", &|row| 1.5075 * f64::from(place(row))),
        column("direction", &|row| if row % 400 < 200 { 1.0 } else { -1.0 }),
        column("error_um", &|_| 0.0),
    ]);
    let clean = problem(&known, &table).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    for (row, shown) in table.columns[4].values.iter_mut().enumerate() {
        let fresh: f64 = StandardNormal.sample(&mut chance);
        *shown = clean[row.saturating_sub(1)] + 0.15 * fresh;
    }
    let (what, mend) = doubted(&known, &table).expect("a doubt");
    assert_eq!((what, mend.as_str()), ("shift", "move `error_um` up by 1 row in every pass"));
}

/// A wave that ends at the instrument's range; one whose peaks the display rounds; runs that begin and end at zero.
#[test]
fn readings_cut_off_are_told_and_rounded_ones_are_none() {
    let known = machine(150, WAVES);
    let cut = changed(measured(&known), "error_um", |value| value.clamp(-5.0, 1.4));
    let (what, mend) = doubted(&known, &cut).expect("a doubt");
    assert!(what == "cut-off" && mend.ends_with("leave rows of 1.4 out"), "{what} {mend}");
    for step in [0.4, 0.2, 0.1, 0.05, 0.01] {
        let rounded = |value: f64| step * libm::round(value / step);
        assert_eq!(
            doubted(&known, &changed(measured(&known), "error_um", rounded)),
            None,
            "{step}"
        );
    }
    // Strokes of fifteen rows, each of which begins at the place where the readings are set to zero.
    let mut zeroed = measured(&known);
    let places: Vec<u32> = (0..600).map(|row| (row % 30).min(30 - row % 30)).collect();
    zeroed.columns[0].values = places.iter().map(|place| 0.5 * f64::from(*place)).collect();
    let mut places = places.into_iter();
    let at_zero = |value| if places.next() == Some(0) { -9.0 } else { value };
    let zeroed = problem(&known, &changed(zeroed, "error_um", at_zero));
    assert!(doubts(&zeroed).iter().all(|one| one.what != "cut-off"));
}

/// Noise of which the loudest tenth is cut off: hardly two readings on end are at the limit.
#[test]
fn single_readings_cut_off_are_told() {
    let known = machine(150, "");
    let mut chance = ChaCha8Rng::seed_from_u64(11);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let cut = table(&(0..600).map(|_| noise().min(1.28)).collect::<Vec<_>>());
    assert_eq!(doubted(&known, &cut).map(|(what, _)| what), Some("cut-off"));
}
