use std::path::Path;

use helixlock_plant::Model;
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

fn changed(mut table: Table, column: &str, change: impl Fn(f64) -> f64) -> Table {
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

#[test]
fn another_zero_of_the_position_is_found() {
    let bump = "[[effect]]\nkind = 'screw-wear'\nheight = '2.5 um'\nposition = '140 mm'\n\
                width = '9 mm'\n";
    let known = machine(150, &format!("{WAVES}{bump}"));
    let shifted = changed(measured(&known), "position_mm", |place| place + 4.2);
    let (what, mend) = doubted(&known, &shifted).expect("a doubt");
    assert!(what == "shift" && mend.starts_with("take 4.2"), "{what} {mend}");
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
