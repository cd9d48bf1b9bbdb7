//! Exported compensation tables, read and applied as the controls' manuals say, take the errors of
//! the example's scale away instead of doubling them.
//!
//! - LinuxCNC, integrator's manual, `COMP_FILE`: triplets nominal, forward, reverse, ascending, at
//!   most 256; the joint goes to nominal plus (nominal less forward or reverse), linear between rows.
//! - SINUMERIK 840D sl, function manual "Extended Functions", K3 4.4.2: `$AA_ENC_COMP` in mm at
//!   `MIN + n·STEP` up to `MAX`, linear between them, added to the actual position: a positive value
//!   moves the axis backwards.

use std::collections::BTreeMap;

use crate::support::command::{helixlock, scratch, word};

const EXAMPLE: &str = "examples/inductosyn-scale";

/// One sample of the check run: position in mm, error in µm, +1 or −1.
struct Sample {
    position_mm: f64,
    error_um: f64,
    direction: f64,
}

fn numbers(line: &str, between: char) -> Vec<f64> {
    line.split(between).map(|cell| cell.trim().parse().expect("a number")).collect()
}

fn check_run() -> Vec<Sample> {
    let path = format!("{}/{EXAMPLE}/check.csv", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the example");
    let sample = |line| match numbers(line, ',')[..] {
        [position_mm, error_um, direction] => Sample { position_mm, error_um, direction },
        _ => panic!("three columns"),
    };
    text.lines().skip(1).map(sample).collect()
}

/// The example's table in a control's format.
fn exported(format: &str) -> String {
    let folder = scratch();
    let (_, image) = word(&folder, "table.hex");
    let (path, file) = word(&folder, "table");
    let data = format!("{EXAMPLE}/table.csv");
    let built = helixlock(&["scale", "build", &data, "-o", &image, "--joint-zone", "8 mm"]);
    assert_eq!(built.status, 0, "{}", built.stderr);
    let export =
        helixlock(&["scale", "export", &image, "--format", format, "--axis", "X1", "-o", &file]);
    assert_eq!(export.status, 0, "{}", export.stderr);
    std::fs::read_to_string(path).expect("the table")
}

/// Linear between rows of ascending position; the ends hold beyond.
fn between(rows: &[(f64, f64)], position_mm: f64) -> f64 {
    let after = rows.partition_point(|row| row.0 < position_mm).clamp(1, rows.len() - 1);
    let ((x0, y0), (x1, y1)) = (rows[after - 1], rows[after]);
    y0 + (y1 - y0) * ((position_mm - x0) / (x1 - x0)).clamp(0.0, 1.0)
}

/// Largest and root-mean-square error that is left, µm; `added_mm` is what the control adds to the
/// actual position.
fn left_um(added_mm: impl Fn(&Sample) -> f64) -> (f64, f64) {
    let left: Vec<f64> =
        check_run().iter().map(|sample| sample.error_um + 1000.0 * added_mm(sample)).collect();
    let count: f64 = left.iter().map(|_| 1.0).sum();
    let mean_square = left.iter().map(|one| one * one).sum::<f64>() / count;
    (left.iter().fold(0.0, |most, one| one.abs().max(most)), mean_square.sqrt())
}

#[test]
fn linuxcnc_takes_the_errors_off() {
    let rows: Vec<Vec<f64>> = exported("linuxcnc").lines().map(|row| numbers(row, ' ')).collect();
    assert!((2..=256).contains(&rows.len()), "{}", rows.len());
    assert!(rows.windows(2).all(|pair| pair[0][0] < pair[1][0]), "ascending");
    // The trim nominal less position is added to the command; the feedback loses it again.
    let trims = |column: usize| -> Vec<(f64, f64)> {
        rows.iter().map(|row| (row[0], row[0] - row[column])).collect()
    };
    let (forward, reverse) = (trims(1), trims(2));
    let (largest, rms) = left_um(|sample| {
        let table = if 0.0 < sample.direction { &forward } else { &reverse };
        -between(table, sample.position_mm)
    });
    assert!(largest < 1.5 && rms < 0.5, "±{largest} µm, rms {rms} µm left of ±5.57 µm");
}

#[test]
fn siemens_takes_the_mean_error_of_both_ways_off() {
    let text = exported("siemens");
    assert!(text.starts_with("%_N_AX_EEC_INI\nCHANDATA(1)\n") && text.ends_with("\nM17\n"));
    let values: BTreeMap<&str, f64> = text
        .lines()
        .filter_map(|line| line.split_once('='))
        .map(|(name, value)| (name, value.parse().expect("a number")))
        .collect();
    let [step, first, last] =
        ["_STEP", "_MIN", "_MAX"].map(|name| values[format!("$AA_ENC_COMP{name}[0,X1]").as_str()]);
    let rows: Vec<(f64, f64)> = (0_u16..)
        .map_while(|n| values.get(format!("$AA_ENC_COMP[0,{n},X1]").as_str()).map(|v| (n, *v)))
        .map(|(n, value)| (first + f64::from(n) * step, value))
        .collect();
    assert!((rows.last().expect("rows").0 - last).abs() < 1e-9, "no gap in the points");
    let (largest, rms) = left_um(|sample| between(&rows, sample.position_mm));
    assert!(largest < 1.5 && rms < 0.6, "±{largest} µm, rms {rms} µm left of ±5.57 µm");
}
