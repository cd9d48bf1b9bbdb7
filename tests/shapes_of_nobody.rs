//! Shapes that no effect has are nobody's, however narrow they are and wherever they stand.
#![expect(clippy::cast_precision_loss, reason = "some hundred rows")]

use helixlock_lab::{Diagnosis, Found, Verdict, diagnose, discover};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{self, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

const COLUMNS: [&str; 4] = ["pass", "time_s", "position_mm", "error_um"];
const PASSES: usize = 3;
/// Rows of a pass.
const ROWS: usize = 250;
/// Deviation, µm.
const NOISE_UM: f64 = 0.05;

/// The diagnosis of three passes forward, with noise and a shape of pass and place, µm of mm.
fn with_shape(seed: u64, shape: &dyn Fn(usize, f64) -> f64) -> Diagnosis {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let (mut pass, mut time, mut place, mut error) = (vec![], vec![], vec![], vec![]);
    for nth in 0..PASSES {
        for row in 0..ROWS {
            let row = row as f64;
            let mm = 2.5 * row + chance.random_range(0.0..2.0);
            let noise: f64 = StandardNormal.sample(&mut chance);
            pass.push(nth as f64);
            time.push(400.0 * nth as f64 + mm / 4.0);
            place.push(mm);
            error.push(NOISE_UM * noise + shape(nth, mm));
        }
    }
    let columns = [pass, time, place, error];
    diagnosed::diagnosed(COLUMNS.into_iter().zip(columns).collect())
}

/// Nothing is named, and no all-clear given.
fn is_nobodys(shape: &dyn Fn(usize, f64) -> f64) {
    diagnosed::is_nobodys(|seed| with_shape(seed, shape));
}

fn bell(deviations: f64) -> f64 {
    libm::exp(-0.5 * deviations * deviations)
}

/// A chip under the slide in one pass of three, forty times the noise: no wear has it, for the
/// other passes lack it, and no all-clear may be given over it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_knock_in_one_pass_is_neither_wear_nor_noise() {
    is_nobodys(&|pass, mm| if pass == 1 { 2.0 * bell((mm - 230.0) / 12.0) } else { 0.0 });
}

/// Seven rows of one pass of three, lifted by sixty times the noise: the larger a spell is, the more it
/// looks like noise with a memory of seven rows.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_short_spell_in_one_pass_is_no_noise() {
    is_nobodys(&|pass, mm| if pass == 1 && (230.0..247.0).contains(&mm) { 3.0 } else { 0.0 });
}

/// Three humps of one size: a bump takes one, and what is left takes it as well.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn one_hump_of_three_is_no_wear() {
    is_nobodys(&|_, mm| [150.0, 320.0, 500.0].map(|at| 0.4 * bell((mm - at) / 20.0)).iter().sum());
}

/// Humps of several widths, heights and signs: the bump that one of them is has the shape of a part of
/// all, and is the smaller part.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_smaller_part_of_a_wavy_bed_is_no_wear() {
    let humps = [(150.0, 22.0, 0.13), (330.0, 40.0, -0.104), (560.0, 15.0, 0.169)];
    let bed = |_, mm| humps.iter().map(|(at, wide, um)| um * bell((mm - at) / wide)).sum();
    // With the noise of this seed the narrow hump pays its price beside a curve of all of them.
    let found = with_shape(10, &bed);
    assert_eq!((names(&found), found.verdict), (vec![], Verdict::Unexplained));
}

/// What warms up anew in every pass differs from the cubic that follows it by a fiftieth, and has fewer numbers.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_decay_of_each_pass_is_no_cubic() {
    is_nobodys(&|_, mm| 0.4 * libm::exp(-mm / 125.0));
}

/// The sun on one side of a bed: an arc that comes with the hours follows a screw of changing lead.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_bow_that_comes_in_time_is_nobodys() {
    is_nobodys(&|pass, mm| {
        let (x, hours) = (mm / 625.0, pass as f64 + mm / 1600.0);
        2.0 * x * (1.0 - x) * (1.0 - libm::exp(-hours))
    });
}

/// Coolant comes on: a scale shrinks from then on over all of its length.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_slope_from_one_moment_on_is_nobodys() {
    is_nobodys(&|pass, mm| {
        let since_s = (400.0 * pass as f64 + mm / 4.0 - 470.0).max(0.0);
        -1e-3 * mm * (1.0 - libm::exp(-since_s / 60.0))
    });
}

/// A spell of four fringes and a half, which are as far from whole lines, in fourteen rows: the whole
/// numbers on either side are none.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn half_a_fringe_is_no_slip() {
    let spell = |pass, mm| {
        let lifted = pass == 1 && (230.0..265.0).contains(&mm);
        if lifted { 4.5 * 0.316_409_915 } else { 0.0 }
    };
    for seed in seeds(1, 6) {
        assert_eq!(names(&with_shape(seed, &spell)), Vec::<&str>::new(), "{seed}");
    }
}

/// A dent with the metal beside it: a bump follows one half.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_dent_with_its_rim_is_no_wear() {
    is_nobodys(&|_, mm| {
        let off = (mm - 410.0) / 5.0;
        0.4 * off * bell(off)
    });
}

/// A dent whose rim stands up on both sides, twelve standard errors: a bump follows the middle, and
/// explains nothing alone.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_dent_between_two_rims_is_no_wear() {
    let dent = |_, mm| {
        let off = (mm - 410.0) / 30.0;
        0.12 * (1.0 - off * off) * bell(off)
    };
    for seed in seeds(1, 6) {
        assert_eq!(with_shape(seed, &dent).verdict, Verdict::Unexplained, "{seed}");
    }
}

/// From four to eight waves: fifteen standard errors.
#[test]
fn a_wave_of_changing_length_is_seen() {
    is_nobodys(&|_, mm| {
        let share = mm / 640.0;
        0.04 * libm::sin(std::f64::consts::TAU * share * (4.0 + 2.0 * share))
    });
}

/// White noise that swells and sinks by a factor of two in some thirty readings: a step fits where
/// it is loud. Of sixteen records of six tenths of a micrometre, which are two fringes, one may
/// still get its name; of a few none.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn gusts_are_hardly_slips() {
    const PASSES: usize = 4;
    const ROWS: usize = 200;
    let asked = seeds(5, 16);
    let may_be = asked.end / 16;
    let named = asked.filter(|&seed| {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let mut columns = [vec![], vec![], vec![], vec![]];
        for pass in 0..PASSES {
            let mut swell = 0.0;
            for row in 0..ROWS {
                let [drawn, swelling]: [f64; 2] =
                    [0, 1].map(|_| StandardNormal.sample(&mut chance));
                swell = 0.97 * swell + 0.24 * swelling;
                let mm = 3.0 * row as f64;
                let error = 0.6 * drawn * libm::exp(0.8 * swell);
                let cells = [pass as f64, 400.0 * pass as f64 + mm / 4.0, mm, error];
                columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
            }
        }
        !names(&diagnosed::diagnosed(COLUMNS.into_iter().zip(columns).collect())).is_empty()
    });
    let named: Vec<u64> = named.collect();
    assert!(named.len() as u64 <= may_be, "{named:?}");
}

/// A piece of a scale that lies higher: a bump follows it roughly.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_flat_top_with_edges_is_no_wear() {
    is_nobodys(&|_, mm| if (180.0..290.0).contains(&mm) { 0.15 } else { 0.0 });
}

/// A scratch that a worm meets with every turn, five of them, is no wave of a shaft, and no slow noise.
#[test]
fn a_scratch_of_a_worm_is_told_by_its_turns() {
    let telescope = "output.rotary = true\nspindle.speed = '0.000696346 rpm'\n\
                     gear = [{ name = 'worm', order = 359 }]";
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 0.45);
        let times: Vec<f64> = (0..600).map(|row| 2.0 * f64::from(row)).collect();
        let scratched = times.iter().map(|time_s| {
            let turns = 0.000_696_346 * 359.0 / 60.0 * time_s;
            bell((turns - libm::floor(turns) - 0.4) / 0.05) + noise()
        });
        let columns = vec![("error_arcsec", scratched.collect()), ("time_s", times.clone())];
        let found = diagnosed_on(telescope, columns);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        let told = |along: &str| found.residual.iter().any(|one| one.along == along);
        assert!(told("angle of `worm`"), "{seed}: {:?}", found.residual);
    }
}

/// Two passes there and back over eight targets, at each of which the axis rests for six readings and its servo
/// settles: play that a vibration beside it makes fade, or a column pasted two rows too low, follow it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_settles_after_each_stop_is_no_play_and_no_slipped_column() {
    let mut noise = white(1, 0.2);
    let mut columns = [const { Vec::new() }; 5];
    for row in 0..192_u16 {
        let (stop, reading) = (row / 6, f64::from(row % 6));
        let (run, target) = (stop / 8, stop % 8);
        let (way, target) = if run % 2 == 0 { (1.0, target) } else { (-1.0, 7 - target) };
        let settling = -way * libm::exp(-0.7 * reading);
        let (mm, s) = (80.0 * f64::from(target), 10.0 * f64::from(stop) + 0.5 * reading);
        let values = [f64::from(run / 2), s, mm, way, settling + 0.003 * mm + noise()];
        columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }
    let names = ["pass", "time_s", "position_mm", "direction", "error_um"];
    let effect = "\n[[effect]]\nkind = \"screw-progressive\"\nlinear = \"3 um/m\"\n";
    let machine = format!("{}{effect}", diagnosed::MACHINE);
    let problem = diagnosed::problem_of(&machine, names.into_iter().zip(columns).collect());
    let found = discover(&problem);
    assert_eq!(found.found, Found::Formula);
    assert_eq!(found.proposals[0].shape, "settles after each stop");
    let search = diagnose(&problem);
    assert_eq!(search.verdict, Verdict::Unexplained, "{:?}", search.doubts);
}
