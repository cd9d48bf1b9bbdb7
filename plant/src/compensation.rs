//! What one laser pulse blocked or inserted in every F leaves: stairs, not a slope.
//!
//! Divider F is cleared while the device rests and counts the fringes from the start of a pass, so
//! that the first stair comes a whole cycle after it. A blocked pulse lets the laser lag by λ/2.

use crate::{Machine, Part, Record};

/// Rate that the wheels show, µm/m: positive blocks pulses; 0 without wheels.
pub(crate) fn dialled_um_per_m(machine: &Machine) -> f64 {
    if !machine.has(Part::Dividers) {
        return 0.0;
    }
    let dividers = &machine.dividers;
    dividers
        .compensation_cycle()
        .map_or(0.0, |cycle| libm::copysign(1e6 / f64::from(cycle), dividers.compensation_um_per_m))
}

/// Stairs of λ/2 over a way, µm: rising where pulses are blocked (rate in µm/m above 0).
pub(crate) fn stairs_um(rate_um_per_m: f64, fringe_um: f64, way_mm: f64) -> f64 {
    if rate_um_per_m == 0.0 {
        return 0.0;
    }
    let cycle_mm = fringe_um * 1000.0 / rate_um_per_m.abs();
    libm::copysign(fringe_um, rate_um_per_m) * (way_mm / cycle_mm).floor()
}

/// What the compensation of the machine file adds to the recorder at each sample, µm.
///
/// The divider counts on when the table turns; a pulse that is missing on the way back is the
/// laser's lag in the other direction.
pub(crate) fn compensation_um(machine: &Machine, record: &Record) -> Vec<f64> {
    let rate_um_per_m = dialled_um_per_m(machine);
    if rate_um_per_m == 0.0 {
        return vec![0.0; record.len()];
    }
    let fringe_um = machine.fringe_um();
    // The pulse behind the F-th is blocked, one is added to the F-th itself: between the two.
    let late_mm = fringe_um / 2000.0;
    let of = |row: usize| {
        stairs_um(rate_um_per_m, fringe_um, (record.travelled_mm[row] - late_mm).max(0.0))
    };
    let mut shown = Vec::with_capacity(record.len());
    for rows in record.passes() {
        let mut lag_um = 0.0;
        for row in rows.clone() {
            let before = row.saturating_sub(1).max(rows.start);
            lag_um += record.direction[row] * (of(row) - of(before));
            shown.push(lag_um);
        }
    }
    shown
}
