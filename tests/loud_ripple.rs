//! Long waves beside short ones that are loud from row to row, and waves that change on their way.

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// An encoder on the shaft of a stepper motor.
const ENCODER: &str = "output.rotary = true\nspindle.speed = '60 rpm'\n\
                       gear = [{ name = 'rotor teeth', order = 50 }]\n\
                       grating = { lines = 4096, diameter = '6 mm' }\n";

/// One turn of 3000 rows: the waves of the poles, which no order of their own is that of, and an error in arcsec.
fn turn(seed: u64, error_arcsec: impl Fn(f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 4.0);
    let mut columns = [const { Vec::new() }; 2];
    for row in 0..1500 {
        let rad = std::f64::consts::TAU * f64::from(row) / 1500.0;
        let of_poles = libm::sin(100.0 * rad + 2.0 * libm::sin(3.0 * rad + 0.4))
            + 0.6 * libm::sin(97.0 * rad + 1.5 * libm::sin(2.0 * rad));
        let cells = [f64::from(row) / 1500.0, error_arcsec(rad) + 130.0 * of_poles + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    diagnosed_on(ENCODER, ["angle_rev", "error_arcsec"].into_iter().zip(columns).collect())
}

/// From row to row the poles move the error ten times as far as a wave of two a turn, which is seven times as large.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_long_wave_is_found_under_a_loud_ripple() {
    for seed in seeds(1, 5) {
        let found = turn(seed, |rad| 880.0 * libm::sin(2.0 * rad + 0.45));
        assert_eq!(names(&found), ["grating-graduation"], "{seed}");
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: the poles are in no file");
        let nothing = turn(seed, |_| 0.0);
        assert!(names(&nothing).is_empty(), "{seed}: {:?}", names(&nothing));
    }
}

/// A mount that is turned to the other side of its pier after half of the night.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_worm_keeps_its_name_where_its_wave_changes() {
    let mount = "output.rotary = true\nspindle.speed = '0.000696346 rpm'\n\
                 gear = [{ name = 'worm', order = 180 }]\n";
    for seed in seeds(1, 8) {
        let mut noise = white(seed, 0.6);
        let mut columns = [const { Vec::new() }; 2];
        for row in 0..1400 {
            let time_s = 6.0 * f64::from(row);
            let (size, phase) = if row < 700 { (2.0, 1.85) } else { (1.4, 3.7) };
            let worm = size * libm::sin(std::f64::consts::TAU * time_s / 478.7 + phase);
            columns.iter_mut().zip([time_s, worm + noise()]).for_each(|(all, one)| all.push(one));
        }
        let table = ["time_s", "error_arcsec"].into_iter().zip(columns).collect();
        let found = diagnosed_on(mount, table);
        assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec!["gear-error"]));
    }
}
