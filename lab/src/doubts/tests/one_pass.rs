//! Mistakes of one pass among others that are sound.

use super::*;

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
