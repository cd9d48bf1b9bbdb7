//! Compensation tables in the formats machine controls take.

use std::fmt::Write;

use super::table::{CorrectionTable, Direction, LookUp};

/// Rows a LinuxCNC compensation file may have for each joint.
pub const LINUXCNC_ROWS: usize = 256;

/// A compensation file for LinuxCNC, and what its few rows lose.
#[derive(Clone, Debug, PartialEq)]
pub struct LinuxCnc {
    /// The file.
    pub text: String,
    /// How many places make a row.
    pub every: usize,
    /// Largest difference at a place left out between its correction and the line between rows, µm.
    pub lost_um: f64,
}

/// LinuxCNC compensation file of `COMP_FILE_TYPE = 0`: nominal position, then where the joint
/// really is moving forward and moving backward, in mm, ascending.
///
/// LinuxCNC takes 256 rows and interpolates between them, so a longer table is thinned to every
/// second, third … place, the last one kept.
#[must_use]
pub fn linuxcnc_file(table: &CorrectionTable) -> LinuxCnc {
    let places: Vec<f64> = table.places_mm().collect();
    let every = places.len().saturating_sub(1).div_ceil(LINUXCNC_ROWS - 1).max(1);
    let mut text = String::new();
    let last = places.len().saturating_sub(1);
    let rows: Vec<usize> = (0..last).step_by(every).chain(std::iter::once(last)).collect();
    for place in rows.iter().filter_map(|index| places.get(*index)) {
        let [forward, backward] = actual_mm(table, *place);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{place:.4} {forward:.6} {backward:.6}");
    }
    let corrections: Vec<[f64; 2]> =
        places.iter().map(|place| corrections_um(table, *place)).collect();
    LinuxCnc { text, every, lost_um: lost_um(&corrections, &rows) }
}

/// Largest difference between corrections and straight lines between those of some rows, µm.
#[expect(clippy::cast_precision_loss, reason = "an image holds some two thousand places")]
fn lost_um(corrections: &[[f64; 2]], rows: &[usize]) -> f64 {
    let mut lost_um = 0.0_f64;
    for (&from, &to) in rows.iter().zip(rows.iter().skip(1)) {
        for place in from..to {
            let share = (place - from) as f64 / (to - from) as f64;
            let ends = corrections[from].iter().zip(&corrections[to]);
            for (correction, (begin, end)) in corrections[place].iter().zip(ends) {
                let line = begin * (1.0 - share) + end * share;
                lost_um = lost_um.max((correction - line).abs());
            }
        }
    }
    lost_um
}

/// Nominal and actual positions as CSV: what Heidenhain's and Siemens' dialogs ask for.
///
/// It is in their style, not a file either control loads: columns `nominal_mm`,
/// `actual_forward_mm`, `actual_backward_mm`, `correction_forward_um`, `correction_backward_um`.
#[must_use]
pub fn nominal_actual_csv(table: &CorrectionTable) -> String {
    let mut text = String::from(
        "# compensation table in the style of Heidenhain and Siemens: enter it by their dialogs\n\
         nominal_mm,actual_forward_mm,actual_backward_mm,correction_forward_um,correction_backward_um\n",
    );
    for place in table.places_mm() {
        let [forward, backward] = actual_mm(table, place);
        let [ahead_um, back_um] = corrections_um(table, place);
        let _ = writeln!(text, "{place:.4},{forward:.6},{backward:.6},{ahead_um:.3},{back_um:.3}");
    }
    text
}

/// Siemens encoder compensation (EEC) as an archive program for one axis.
///
/// The control takes one value a place for both ways, added to the actual position: the mean of
/// both directions is written, in mm; the reversal belongs into the axis' backlash.
#[must_use]
pub fn siemens_file(table: &CorrectionTable, axis: &str) -> String {
    let places: Vec<f64> = table.places_mm().collect();
    let mut text = String::from("%_N_AX_EEC_INI\nCHANDATA(1)\n");
    for (index, place) in places.iter().enumerate() {
        let [forward_um, backward_um] = corrections_um(table, *place);
        let mean_mm = f64::midpoint(forward_um, backward_um) / 1000.0;
        let _ = writeln!(text, "$AA_ENC_COMP[0,{index},{axis}]={mean_mm:.6}");
    }
    let (first, last) = (places.first().copied(), places.last().copied());
    let _ = writeln!(text, "$AA_ENC_COMP_STEP[0,{axis}]={:.4}", table.step_mm);
    let _ = writeln!(text, "$AA_ENC_COMP_MIN[0,{axis}]={:.4}", first.unwrap_or(0.0));
    let _ = writeln!(text, "$AA_ENC_COMP_MAX[0,{axis}]={:.4}", last.unwrap_or(0.0));
    let _ = writeln!(text, "$AA_ENC_COMP_IS_MODULO[0,{axis}]=0\nM17");
    text
}

/// Corrections forward and backward at a place of the table, µm.
fn corrections_um(table: &CorrectionTable, place_mm: f64) -> [f64; 2] {
    [Direction::Forward, Direction::Backward]
        .map(|direction| table.correction_um(place_mm, direction, LookUp::Nearest).unwrap_or(0.0))
}

/// Where the machine really is when its scale shows a place, forward and backward, mm: what it
/// shows less its error, and the correction is minus the error.
fn actual_mm(table: &CorrectionTable, place_mm: f64) -> [f64; 2] {
    corrections_um(table, place_mm).map(|correction_um| place_mm + correction_um / 1000.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(places: usize) -> CorrectionTable {
        CorrectionTable {
            start_mm: 0.0,
            step_mm: 1.0,
            lsb_um: 0.1,
            forward: vec![10; places],
            backward: vec![-20; places],
        }
    }

    #[test]
    fn linuxcnc_triplets() {
        let LinuxCnc { text, every, lost_um } = linuxcnc_file(&table(3));
        assert!(every == 1 && lost_um.abs() < 1e-12);
        assert_eq!(text.lines().nth(1), Some("1.0000 1.001000 0.998000"));
    }

    #[test]
    fn linuxcnc_takes_256_rows() {
        let mut long = table(1001);
        long.forward[2] = 30; // 3 µm between rows of 1 µm
        let LinuxCnc { text, every, lost_um } = linuxcnc_file(&long);
        assert_eq!(every, 4);
        assert!((lost_um - 2.0).abs() < 1e-12, "{lost_um}");
        assert!(text.lines().count() <= LINUXCNC_ROWS);
        assert!(text.lines().last().unwrap().starts_with("1000.0000"));
    }

    #[test]
    fn siemens_has_the_mean_in_millimetres() {
        let text = siemens_file(&table(2), "AX1");
        assert!(text.contains("$AA_ENC_COMP[0,1,AX1]=-0.000500\n"), "{text}");
        assert!(text.contains("$AA_ENC_COMP_MAX[0,AX1]=1.0000\n"), "{text}");
    }
}
