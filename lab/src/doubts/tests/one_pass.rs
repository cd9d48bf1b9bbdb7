//! Mistakes of one pass among others that are sound.

use super::*;
use crate::challenge::challenge;

/// Two passes, noise of 0.05 µm in each.
fn two_passes(known: &Model) -> Table {
    let table = twice(measured(known));
    let mut chance = ChaCha8Rng::seed_from_u64(8);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    changed(table, "error_um", |value| value + 0.01 * noise())
}

/// The second pass of a column changed.
fn second(table: Table, column: &str, change: impl Fn(f64) -> f64) -> Table {
    let rows = table.rows() / 2;
    let mut number = 0;
    changed(table, column, |value| {
        number += 1;
        if rows < number { change(value) } else { value }
    })
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_sign_and_a_unit_of_one_pass_are_told() {
    let known = machine(150, WAVES);
    let of = |factor: f64| {
        let table = second(two_passes(&known), "error_um", |value| factor * value);
        doubted(&known, &table).expect("a doubt")
    };
    assert_eq!(of(-1.0), ("sign", "read `error_um` of pass 2 with sign = -1".to_owned()));
    for (factor, unit) in [(1e-3, "mm"), (1e3, "nm"), (1.0 / 25.4, "mil")] {
        let mend = format!("read `error_um` of pass 2 with unit = \"{unit}\"");
        assert_eq!(of(factor), ("unit", mend));
    }
}

/// A recorder that was not on, and one that showed its noise only.
#[test]
fn a_pass_that_shows_nothing_is_in_no_other_unit() {
    let known = machine(150, WAVES);
    assert_eq!(doubted(&known, &two_passes(&known)), None);
    for noise_um in [0.0, 0.05] {
        let mut row = 0.0_f64;
        let silent = second(two_passes(&known), "error_um", |_| f64::NAN);
        let silent = changed(silent, "error_um", |value| {
            row += 1.0;
            if value.is_nan() { noise_um * libm::sin(37.0 * row * row) } else { value }
        });
        let doubt = doubted(&known, &silent);
        assert_eq!(doubt.filter(|(what, _)| *what == "unit"), None, "{noise_um}");
    }
}

#[test]
fn degrees_of_fahrenheit_in_one_pass_are_told() {
    let known = machine(150, "[[effect]]\nkind = 'air-temperature'\n");
    let hot = second(two_passes(&known), "air_temperature_c", |value| 1.8 * value + 32.0);
    let mend = "read `air_temperature_c` of pass 2 with unit = \"degf\"".to_owned();
    assert_eq!(doubted(&known, &hot), Some(("unit", mend)));
}

/// A bed that leans, whose pitch the log of one pass has with the other sign.
#[test]
fn the_sign_of_a_log_in_one_pass_is_told() {
    let known = machine(150, "[[effect]]\nkind = 'abbe'\noffset = '60 mm'\n");
    let pitch = (0..600).map(|row| 3.0 * libm::sin(0.02 * crate::numerics::count(row)));
    let mut leaning = measured(&machine(150, ""));
    leaning.columns.push(Column { name: "bed_pitch_arcsec".to_owned(), values: pitch.collect() });
    let clean = problem(&known, &leaning).predicted;
    let mut row = 0;
    let leaning = changed(leaning, "error_um", |value| {
        row += 1;
        value + clean[row - 1]
    });
    let twice = changed(twice(leaning), "error_um", {
        let mut chance = ChaCha8Rng::seed_from_u64(8);
        move |value| -> f64 {
            let fresh: f64 = StandardNormal.sample(&mut chance);
            value + 0.01 * fresh
        }
    });
    assert_eq!(doubted(&known, &twice), None);
    let turned = second(twice, "bed_pitch_arcsec", |value| -value);
    let mend = "read `bed_pitch_arcsec` of pass 2 with sign = -1".to_owned();
    assert_eq!(doubted(&known, &turned), Some(("sign", mend)));
}

/// One of two effects twice as large in one pass: no factor of the pass leaves it as sound as the other.
#[test]
fn an_effect_that_grew_in_one_pass_is_no_mistake_of_it() {
    let (wave, _) = WAVES.split_at(WAVES.rfind("[[effect]]").expect("two effects"));
    let known = machine(150, WAVES);
    let more = problem(&machine(150, wave), &table(&[0.0; 600])).predicted;
    let mut row = 0;
    let grown = changed(two_passes(&known), "error_um", |value| {
        row += 1;
        if row <= 600 { value } else { value + more[row - 601] }
    });
    assert_eq!(doubted(&known, &grown), None);
}

/// Something that grew while the first pass went on bends it as its place with the other sign would.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_grows_in_one_pass_is_no_sign_of_its_place() {
    let grown = challenge(1_712_418).expect("a machine and its data");
    assert_eq!(doubted(&grown.machine.model, &grown.table), None);
}

/// A way back that was written down as a way out; what is the same either way tells nothing.
#[test]
fn a_pass_that_is_told_backwards_is_told() {
    let known = machine(150, WAVES);
    let sound = two_passes(&known);
    let mut turned = sound.clone();
    let rows = turned.rows() / 2;
    let errors = turned.columns.iter_mut().find(|column| column.name == "error_um");
    errors.expect("errors").values[rows..].reverse();
    let mend = "turn the order of the readings of pass 2, or its position".to_owned();
    assert_eq!(doubted(&known, &turned), Some(("reversed", mend)));
    assert_eq!(doubted(&known, &sound), None);
}

/// Rows of a pass in another order, as a table that was sorted by one column alone.
#[test]
fn a_pass_whose_rows_changed_places_is_told() {
    let known = machine(150, WAVES);
    let mut mixed = two_passes(&known);
    let rows = mixed.rows() / 2;
    let errors = mixed.columns.iter_mut().find(|column| column.name == "error_um");
    let values = &mut errors.expect("errors").values[rows..];
    (0..rows).for_each(|row| values.swap(row, 257 * row % rows));
    let mend = "leave pass 2 out, or put its rows in order".to_owned();
    assert_eq!(doubted(&known, &mixed), Some(("another-machine", mend)));
}
