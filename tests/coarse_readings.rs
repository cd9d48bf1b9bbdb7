//! Readings rounded to several times their noise: the digits stand still, and it is no structure.

use helixlock_lab::Verdict;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

const ROWS: u32 = 400;
const PASSES: u32 = 3;

/// Noise of a fifth of the last digit, and of a third.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn digits_that_stand_still_are_no_structure() {
    for (step_um, noise_um) in [(0.25, 0.05), (0.25, 0.08)] {
        for seed in seeds(1, 4) {
            let mut chance = ChaCha8Rng::seed_from_u64(seed);
            let mut columns = [const { Vec::new() }; 4];
            for (pass, row) in (0..PASSES).flat_map(|pass| (0..ROWS).map(move |row| (pass, row))) {
                let noise: f64 = StandardNormal.sample(&mut chance);
                let mm = 1.5 * f64::from(row);
                let reading = (noise_um * noise / step_um).round() * step_um;
                let values = [f64::from(pass), 200.0 * f64::from(pass) + mm / 4.0, mm, reading];
                columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
            }
            let names = ["pass", "time_s", "position_mm", "error_um"];
            let found = diagnosed(names.into_iter().zip(columns).collect());
            assert_eq!(found.verdict, Verdict::NothingMissing, "{step_um} {noise_um} {seed}");
            for candidate in &found.candidates {
                let said = format!("{step_um} {noise_um} {seed}: {candidate:?}");
                assert!(candidate.rms_um.is_finite() && 1e-6 < candidate.p_value, "{said}");
            }
        }
    }
}

/// A slope that the machine file knows, over positions rounded to whole millimetres: a lag of the recorder
/// would smooth the steps that this puts into the prediction, and is none.
#[test]
fn a_rounded_position_is_no_lag() {
    let machine = r#"
spindle.speed = "120 rpm"
lead_screw.lead = "10 mm"
laser.wavelength = "0.632991 um"
[[effect]]
kind = "screw-progressive"
linear = "60 um/m"
"#;
    for seed in seeds(1, 4) {
        let (mut noise, mut uneven) = (white(seed, 0.1), white(seed + 50, 0.3));
        let mut columns = [const { Vec::new() }; 4];
        for (pass, row) in (0..2).flat_map(|pass| (0..400).map(move |row| (pass, row))) {
            let mm = 1.25 * (f64::from(row) + uneven());
            let (time_s, error_um) = (f64::from(pass) * 40.0 + mm / 20.0, -0.06 * mm + noise());
            let values = [f64::from(pass), time_s, mm.round(), error_um];
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
        let columns = ["pass", "time_s", "position_mm", "error_um"].into_iter().zip(columns);
        let found = diagnosed_on(machine, columns.collect());
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}
