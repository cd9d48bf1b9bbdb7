//! Two standard errors hold the true value as often in slow noise, which may be too faint to be seen.

use helixlock_lab::add;
use helixlock_plant::Term;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{MACHINE, problem_of};

const ROWS: u32 = 100;
const RECORDS: u64 = 100;
/// Deviation of the white part, µm.
const NOISE_UM: f64 = 0.05;
const DRIFT_UM_PER_H: f64 = 4.0;

/// Records whose true drift lies within two standard errors of the fitted one, when a random walk gains
/// so many white deviations a pass.
fn holding(walk: f64) -> usize {
    (0..RECORDS).filter(|seed| holds(*seed, walk)).count()
}

fn holds(seed: u64, walk: f64) -> bool {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn = || -> f64 { StandardNormal.sample(&mut chance) };
    let time_s: Vec<f64> = (0..ROWS).map(|row| 2.0 * f64::from(row)).collect();
    let mut slow = 0.0;
    let error_um = time_s.iter().map(|time| {
        slow += walk / f64::from(ROWS).sqrt() * drawn();
        DRIFT_UM_PER_H * time / 3600.0 + NOISE_UM * (drawn() + slow)
    });
    let error_um = error_um.collect();
    let position_mm = time_s.iter().map(|time| 3.0 * time).collect();
    let columns = vec![("time_s", time_s), ("position_mm", position_mm), ("error_um", error_um)];
    let card = Term::card("phase-drift").expect("an effect of the catalogue");
    let term = Term::new(card, &[1.0]).expect("one value");
    let added = add(&problem_of(MACHINE, columns), &[], &term);
    let added = added.expect("all columns are there").expect("a drift shows");
    let rate = &added.effects[0].parameters[0];
    (rate.value - DRIFT_UM_PER_H).abs() < 2.0 * rate.stderr.expect("an error")
}

/// With the noise taken for known 94, 57 and 50 hold.
#[test]
fn a_drift_beside_a_random_walk_is_told_with_its_error() {
    let [white, fainter, walking] = [0.0, 0.8, 1.5].map(holding);
    let all = format!("{white}, {fainter} and {walking} of {RECORDS}");
    assert!(93 <= white && 73 <= fainter && 68 <= walking, "{all}");
}
