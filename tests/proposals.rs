//! What `discover` proposes where a reading, a clock or a ripple could pass for a cause.

use std::f64::consts::TAU;

use helixlock_lab::{Discovery, Found, discover};

use crate::support::diagnosed::{diagnosed_on, names, problem_of};
use crate::support::passes::{MACHINE, white};
use crate::support::seeds::seeds;

/// An instrument at rest: what moves it is a lead and a speed of the machine file only.
const AT_REST: &str = "spindle.speed = '60 rpm'\nlead_screw.lead = '8 mm'\n";

/// An encoder on the shaft of a stepper motor.
const ENCODER: &str = "output.rotary = true\nspindle.speed = '60 rpm'\n\
                       gear = [{ name = 'rotor teeth', order = 50 }]\n\
                       grating = { lines = 4096, diameter = '6 mm' }\n";

type Table = Vec<(&'static str, Vec<f64>)>;

fn discovered(machine: &str, columns: &Table) -> Discovery {
    discover(&problem_of(machine, columns.clone()))
}

/// What each proposal stands along.
fn along(found: &Discovery) -> Vec<&str> {
    found.proposals.iter().map(|proposal| proposal.along.as_str()).collect()
}

/// Minutes of an air temperature that swings in two periods, one of them with flat tops.
fn air(rows: u32) -> (Vec<f64>, Vec<f64>) {
    let time_s: Vec<f64> = (0..rows).map(|row| 60.0 * f64::from(row)).collect();
    let heated = |time_s: f64| (3.0 * libm::sin(time_s / 5200.0)).clamp(-1.0, 1.0);
    let air_c = time_s.iter().map(|t| 23.0 + 2.0 * libm::sin(t / 8000.0) + 1.5 * heated(*t));
    let air_c = air_c.collect();
    (time_s, air_c)
}

/// A grinder logs its error and its thread, and one of them alone shows the teeth of a rack: no motion of the
/// table does, which either shows, but the laser, or the thread itself.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_one_of_two_sensors_shows_enters_there() {
    for shows in [[4.0, 0.0], [0.0, 4.0]] {
        let mut noise = white(3, 1.0);
        let place = |row: u16| 2.4 * f64::from(row);
        let mut table = vec![("position_mm", (0..360).map(place).collect())];
        for (name, size_um) in ["error_um", "lead_error_um"].into_iter().zip(shows) {
            let tooth = |row| size_um * (place(row) / 130.0).fract();
            table.push((name, (0..360).map(|row| tooth(row) + noise()).collect()));
        }
        let found = discovered(MACHINE, &table);
        assert_eq!(along(&found), ["position"], "{shows:?}");
        assert_eq!(found.found, Found::Formula, "{shows:?}");
    }
}

/// A camera's pixels and what was worked out of them, to three digits.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_reading_does_not_explain_itself() {
    for name in ["x_pixel", "where_mm", "air_temperature_c"] {
        let mut noise = white(1, 1.0);
        let mut place = 0.0;
        let pixel = |_| {
            place += 0.3 * noise();
            (100.0 * (1278.0 + place + noise())).round() / 100.0
        };
        let pixels: Vec<f64> = (0..300).map(pixel).collect();
        let error_um =
            pixels.iter().map(|pixel| (3086.4 * (pixel - 1278.0)).round() / 1000.0).collect();
        let time_s = (0..300).map(|row| 600.0 * f64::from(row)).collect();
        let table = vec![("time_s", time_s), (name, pixels), ("error_um", error_um)];
        let found = discovered(AT_REST, &table);
        assert!(!along(&found).contains(&name), "{name}: {:?}", found.proposals);
        let named = diagnosed_on(AT_REST, table);
        assert!(names(&named).is_empty(), "{name}: {:?}", names(&named));
        assert!(named.residual.iter().all(|left| left.along != name), "{name}: {named:?}");
    }
}

/// A temperature, and a humidity beside it that hardly matters: of laws that cannot be told apart the one of the
/// fewest numbers is told, and none of its sizes is lost in its error.
#[test]
fn of_laws_alike_the_one_of_fewest_numbers_is_told() {
    for seed in seeds(1, 8) {
        let (time_s, air_c) = air(600);
        let damp_pct: Vec<f64> =
            time_s.iter().map(|t| 40.0 + 5.0 * libm::sin(t / 7000.0 + 2.0)).collect();
        let mut noise = white(seed, 0.35);
        let error = air_c.iter().zip(&damp_pct);
        let error = error.map(|(air, damp)| 0.3 * air + 0.028 * damp + noise()).collect();
        let table =
            vec![("time_s", time_s), ("air_c", air_c), ("damp_pct", damp_pct), ("error_um", error)];
        let found = discovered(AT_REST, &table);
        assert!(!found.proposals.is_empty(), "{seed}");
        for proposal in &found.proposals {
            for what in proposal.parameters.iter().filter(|what| !what.name.ends_with("_s")) {
                let stderr = what.stderr.expect("an error");
                assert!(2.0 * stderr < what.value.abs(), "{seed}: {proposal:?}");
            }
            let rivals = proposal.runners_up.iter().filter(|one| one.alike);
            let mut rivals = rivals.filter(|one| one.instead_of == proposal.instead_of);
            let fewer = rivals.find(|one| one.numbers < proposal.parameters.len());
            assert!(fewer.is_none(), "{seed}: {fewer:?} for {proposal:?}");
        }
    }
}

/// Poles whose waves swell within a turn, five times as loud from row to row as what is seven times as large: its
/// names are in the model, and a sideband is no wheel of its own.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_is_named_under_a_ripple_stays_beside_a_formula() {
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 6.0);
        let mut columns = [const { Vec::new() }; 2];
        for row in 0..1500 {
            let rad = TAU * f64::from(row) / 1500.0;
            let of_poles = 300.0 * libm::sin(100.0 * rad + 1.2 * libm::sin(2.0 * rad + 0.4))
                + 120.0 * libm::sin(50.0 * rad + 0.8 * libm::sin(rad));
            let long = 900.0 * libm::sin(2.0 * rad + 0.45) + 450.0 * libm::sin(rad + 1.0);
            let cells = [f64::from(row) / 1500.0, long + of_poles + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let table = ["angle_rev", "error_arcsec"].into_iter().zip(columns).collect();
        let found = discovered(ENCODER, &table);
        let of = |name: &str| found.effects.iter().any(|effect| effect.name == name);
        assert!(of("grating-eccentricity") && of("grating-graduation"), "{seed}: {found:?}");
        assert!(found.rms_um[1] < 0.2 * found.rms_um[0], "{seed}: {:?}", found.rms_um);
        assert!(!found.proposals.is_empty(), "{seed}");
        for proposal in &found.proposals {
            assert!(!proposal.physics.contains("does not list"), "{seed}: {proposal:?}");
        }
    }
}

/// A meter that shows a part of what the air has changed by and it has not followed yet: no travel is in it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_a_column_has_not_been_followed_in_is_a_law_of_its_own() {
    for (seed, follows) in [(1, 0.0), (2, 0.1)] {
        let (time_s, air_c) = air(900);
        let mut noise = white(seed, 0.1);
        let mut late = air_c[0];
        let error = air_c.iter().map(|air| {
            late += (air - late) * (1.0 - libm::exp(-60.0 / 800.0));
            follows * air + 1.5 * (air - late) + noise()
        });
        let error = error.collect();
        let table = vec![("time_s", time_s), ("air_c", air_c), ("error_um", error)];
        let found = discovered(AT_REST, &table);
        assert_eq!((found.found, found.proposals.len()), (Found::Formula, 1), "{found:?}");
        let proposal = &found.proposals[0];
        let slope = if follows == 0.0 { "" } else { "slope*air_c + " };
        let formula = format!("{slope}size*(air_c - lag(air_c, late_s))");
        assert_eq!(proposal.formula, formula);
        let late = proposal.parameters.last().expect("a time constant");
        let stderr = late.stderr.expect("an error");
        assert!((late.value - 800.0).abs() < 3.0 * stderr, "{late:?}");
    }
}

/// Ground that sinks ever more slowly, by the clock alone: nothing along a travel that was made of it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_travel_made_of_the_clock_has_no_laws() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 0.3);
        let time_s: Vec<f64> = (0..500).map(|row| 60.0 * f64::from(row)).collect();
        let error = time_s.iter().map(|t| {
            let share = t / 30_000.0;
            20.0 * libm::exp(-t / 7000.0) + 12.0 * share * share + noise()
        });
        let error = error.collect();
        let table = vec![("time_s", time_s), ("error_um", error)];
        let found = discovered(AT_REST, &table);
        let of_travel = ["position", "spindle angle", "way since the start"];
        assert!(along(&found).iter().all(|along| !of_travel.contains(along)), "{seed}: {found:?}");
    }
}
