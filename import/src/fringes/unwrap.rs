//! From phase to travel: whole fringes counted along the way, over stretches where they faded.

use std::f64::consts::TAU;

use super::quadrature::wrapped;
use super::{Reading, Travel};

/// Standard deviation, rad, from which on a phase says nothing: a quarter of a fringe is two of them.
const FADED: f64 = 0.8;
/// Readings before a gap that say how the travel goes on.
const BEHIND: usize = 8;

/// The travel of every reading that says something, and over how many gaps the fringes were counted on by the way before.
pub(super) fn unwrapped(readings: &[Reading], carrier: f64, um_a_rad: f64) -> (Vec<Travel>, usize) {
    let told: Vec<&Reading> = readings.iter().filter(|reading| reading.deviation < FADED).collect();
    let (mut phases, mut gaps): (Vec<f64>, usize) = (Vec::new(), 0);
    for (index, reading) in told.iter().enumerate() {
        let Some(last) = index.checked_sub(1) else {
            phases.push(reading.phase);
            continue;
        };
        let distance = reading.way - told[last].way;
        gaps += usize::from(1.5 * TAU / carrier < distance);
        let expected = phases[last] + rate(&told, &phases, carrier) * distance;
        phases.push(expected + wrapped(reading.phase - expected));
    }
    let row = |(reading, phase): (&&Reading, f64)| Travel {
        way: reading.way,
        moved_um: um_a_rad * phase,
        deviation_um: um_a_rad * reading.deviation,
    };
    (told.iter().zip(phases).map(row).collect(), gaps)
}

/// Phase in a unit of the way over the last readings; the carrier, before there are some.
fn rate(told: &[&Reading], phases: &[f64], carrier: f64) -> f64 {
    let Some(back) = phases.len().checked_sub(1 + BEHIND) else { return carrier };
    let distance = told[phases.len() - 1].way - told[back].way;
    (phases[phases.len() - 1] - phases[back]) / distance
}

/// Puts the travel of two wavelengths together: where they part by a whole fringe, the one whose
/// fringes faded skipped it. Gives the number of such places.
pub(super) fn agreed(rows: &mut [Travel], other: &[Travel], lambda_um: [f64; 2]) -> usize {
    let (mut zero, mut skipped) = (None, 0);
    let (mut shift_um, mut other_shift_um) = (0.0, 0.0);
    for row in rows {
        row.moved_um += shift_um;
        let Ok(at) = other.binary_search_by(|twin| twin.way.total_cmp(&row.way)) else { continue };
        let twin = &other[at];
        let apart_um = twin.moved_um + other_shift_um - row.moved_um;
        let parted_um = apart_um - *zero.get_or_insert(apart_um);
        let own = twin.deviation_um < row.deviation_um;
        let fringe_um = lambda_um[usize::from(!own)] / 2.0;
        let slip_um = fringe_um * libm::round(parted_um / fringe_um);
        if slip_um != 0.0 {
            skipped += 1;
            if own {
                row.moved_um += slip_um;
                shift_um += slip_um;
            } else {
                other_shift_um -= slip_um;
            }
        }
        let twin_um = twin.moved_um + other_shift_um - zero.unwrap_or_default();
        let weights = [row.weight(), twin.weight()];
        let both = weights[0] + weights[1];
        row.moved_um = (weights[0] * row.moved_um + weights[1] * twin_um) / both;
        row.deviation_um = 1.0 / both.sqrt();
    }
    skipped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(way: f64, phase: f64, deviation: f64) -> Reading {
        Reading { way, phase: wrapped(phase), deviation }
    }

    /// Five fringes are gone; the way before says how many there were.
    #[test]
    fn fringes_are_counted_on_where_they_are_gone() {
        let gone = |n: usize| (40..45).contains(&n);
        let readings: Vec<Reading> = (0..100_u32)
            .map(|n| {
                reading(f64::from(n), 6.4 * f64::from(n), if gone(n as usize) { 3.0 } else { 0.1 })
            })
            .collect();
        let (rows, gaps) = unwrapped(&readings, TAU, 1.0);
        assert_eq!((rows.len(), gaps), (95, 1));
        assert!(rows.iter().all(|row| (row.moved_um - 6.4 * row.way).abs() < 1e-9));
    }

    /// One wavelength skips a fringe where it is faint; the other one tells.
    #[test]
    fn a_skipped_fringe_is_found_by_the_other_wavelength() {
        let row = |n: u32, skipped: f64, deviation_um: f64| Travel {
            way: f64::from(n),
            moved_um: f64::from(n) + skipped,
            deviation_um,
        };
        let mut rows: Vec<Travel> = (0..60)
            .map(|n| row(n, if n < 30 { 0.0 } else { 0.3 }, if n == 30 { 0.05 } else { 0.001 }))
            .collect();
        let other: Vec<Travel> = (0..60).map(|n| row(n, 5.0, 0.002)).collect();
        assert_eq!(agreed(&mut rows, &other, [0.6, 0.5]), 1);
        assert!(rows.iter().all(|row| (row.moved_um - row.way).abs() < 1e-9));
    }
}
