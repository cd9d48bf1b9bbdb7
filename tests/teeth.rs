//! A tooth of a few rows is no wear, though a bell follows it but for readings at its edge.

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{diagnosed, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

const ROWS: u32 = 400;

/// One pass of 400 mm with noise of 0.2 µm and a shape, µm of mm.
fn with_shape(seed: u64, shape: &dyn Fn(f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 0.2);
    let mut columns = [const { Vec::new() }; 3];
    for mm in (0..ROWS).map(f64::from) {
        let cells = [mm / 2.0, mm, shape(mm) + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    diagnosed(["time_s", "position_mm", "error_um"].into_iter().zip(columns).collect())
}

/// A chip lifts the slide over nine rows until it drops.
#[test]
fn a_tooth_is_no_wear() {
    for seed in seeds(2, 12) {
        let tooth = |mm: f64| if (200.0..210.0).contains(&mm) { 0.35 * (mm - 200.0) } else { 0.0 };
        let found = with_shape(seed, &tooth);
        assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec![]), "{seed}");
    }
}

/// A wild reading on the flank of a worn place leaves it its name.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn wear_with_a_wild_reading_is_wear() {
    for seed in seeds(2, 12) {
        let worn = |mm: f64| {
            let deviations = (mm - 205.0) / 6.0;
            let wild = if (mm - 212.0).abs() < 0.5 { 3.0 } else { 0.0 };
            2.0 * libm::exp(-0.5 * deviations * deviations) + wild
        };
        let found = with_shape(seed, &worn);
        assert_eq!(names(&found), ["screw-wear"], "{seed}");
    }
}
