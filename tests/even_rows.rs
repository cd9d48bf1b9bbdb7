//! Rows at the same places in every pass, and passes between long pauses.
#![expect(clippy::cast_precision_loss, reason = "some hundred rows")]

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// Deviation, µm.
const NOISE_UM: f64 = 0.05;

/// Passes forward at 4 mm/s with a row every so many millimetres, one beginning every so many seconds.
struct Run {
    passes: usize,
    rows: usize,
    step_mm: f64,
    every_s: f64,
}

impl Run {
    /// The diagnosis of it with noise and a shape of pass and place, µm of mm.
    fn with_shape(&self, seed: u64, shape: &dyn Fn(usize, f64) -> f64) -> Diagnosis {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let mut columns = [const { Vec::new() }; 4];
        for pass in 0..self.passes {
            for row in 0..self.rows {
                let noise: f64 = StandardNormal.sample(&mut chance);
                let mm = self.step_mm * (row as f64 + 0.5);
                let time_s = self.every_s * pass as f64 + mm / 4.0;
                let error_um = NOISE_UM * noise + shape(pass, mm);
                let cells = [pass as f64, time_s, mm, error_um];
                columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
            }
        }
        let names = ["pass", "time_s", "position_mm", "error_um"];
        diagnosed(names.into_iter().zip(columns).collect())
    }
}

/// An axis that passes its places does not stop there: what it shows at each is no target's own
/// error. With nine rows a turn the eighth harmonic is the first over again.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_met_at_the_same_angles_is_the_slowest_of_its_like() {
    let run = Run { passes: 6, rows: 540, step_mm: 10.0 / 9.0, every_s: 300.0 };
    for seed in seeds(1, 4) {
        let found = run.with_shape(seed, &|_, mm| 0.05 * libm::sin(TAU * mm / 10.0 + 0.5));
        assert_eq!(names(&found), ["screw-periodic"], "{seed}: {:?}", found.verdict);
        let last = found.rounds.last().expect("a round");
        let harmonic = last.effects[0].parameters.iter().find(|one| one.key == "harmonic");
        assert!(harmonic.is_some_and(|one| one.value.to_bits() == 1.0_f64.to_bits()), "{seed}");
    }
}

/// Three fringes lost shortly before a pass ends: a step at any moment pays for the moments at which
/// there are samples, not for those of the pauses.
#[test]
fn a_slip_between_long_pauses_is_a_slip() {
    let fringe_um = 0.5 * 0.632_819_83;
    let run = Run { passes: 3, rows: 92, step_mm: 6.5, every_s: 4000.0 };
    let slip = |pass: usize, mm: f64| match pass {
        0 => 0.0,
        1 if mm < 540.0 => 0.0,
        _ => 3.0 * fringe_um,
    };
    for seed in seeds(1, 4) {
        let found = run.with_shape(seed, &slip);
        assert_eq!(found.verdict, Verdict::Explained, "{seed}");
        assert_eq!(names(&found), ["fringe-slip"], "{seed}");
    }
}

/// An arc that lacks a twentieth of a turn shows what comes with every turn; one that lacks a fifth does not.
#[test]
fn nine_tenths_of_a_turn_show_what_comes_with_every_turn() {
    let table = "output.rotary = true\nspindle.speed = '1 rpm'\n\
                 grating = { lines = 36000, diameter = '150 mm' }";
    let of = |arc: f64| {
        let mut noise = white(5, 1.0);
        let turns: Vec<f64> = (0..400).map(|row| arc / 400.0 * f64::from(row)).collect();
        let error = turns.iter().map(|turn| 8.0 * libm::sin(TAU * turn + 0.4) + noise());
        diagnosed_on(table, vec![("error_arcsec", error.collect()), ("angle_rev", turns.clone())])
    };
    let (long, short) = (of(0.95), of(0.8));
    assert_eq!((long.verdict, names(&long)), (Verdict::Explained, vec!["grating-eccentricity"]));
    assert_eq!((short.verdict, names(&short)), (Verdict::Unexplained, vec![]));
}

/// Rows every 4 mm meet the second harmonic of a screw of 10 mm as a wave of 20 mm, the belt's; uneven ones
/// tell the two apart.
#[test]
fn a_wave_too_swift_for_even_rows_is_a_rival_of_a_slow_one() {
    let machine = "spindle.speed = '30 rpm'\nlead_screw.lead = '10 mm'\nworkpiece.lead = '10 mm'\n\
                   gear = [{ name = 'belt', order = 0.5 }]";
    let of = |off: f64| {
        let mut noise = white(7, 1.0);
        let mut columns = [const { Vec::new() }; 2];
        for row in 0..200 {
            let mm = 4.0 * f64::from(row) + off * libm::sin(2.4 * f64::from(row * row));
            let error_um = 1.5 * libm::sin(TAU * mm / 20.0 + 0.3) + noise();
            columns.iter_mut().zip([mm, error_um]).for_each(|(column, cell)| column.push(cell));
        }
        diagnosed_on(machine, ["position_mm", "error_um"].into_iter().zip(columns).collect())
    };
    let (even, uneven) = (of(0.0), of(1.0));
    assert_eq!((even.verdict, names(&even)), (Verdict::Ambiguous, vec!["gear-error"]));
    assert_eq!((uneven.verdict, names(&uneven)), (Verdict::Explained, vec!["gear-error"]));
}

/// A grinder whose table shaft meshes 48.1 times a turn, which rows each half turn draw as a wave and a third.
#[test]
fn a_mesh_too_quick_for_the_rows_is_no_slow_curve() {
    const GRINDER: &str = "spindle.speed = \"6 rpm\"\nworkpiece.lead = \"6 mm\"\nlead_screw.lead = \"8 mm\"\n\
                           [[gear]]\nname = \"table shaft\"\norder = 1.3\nteeth = 37\n";
    let mut noise = white(3, 0.2);
    let places: Vec<f64> = (0..188).map(|row| 2.994_652 * f64::from(row)).collect();
    let mut columns = [const { Vec::new() }; 3];
    for (pass, mm) in
        [0.0, 1.0, 2.0].iter().flat_map(|pass| places.iter().map(move |mm| (*pass, *mm)))
    {
        let error_um = 20.0 * libm::sin(TAU * mm / 420.0 - 1.0) + noise();
        let cells = [pass, mm, error_um];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let names_of = ["pass", "position_mm", "error_um"];
    let found = diagnosed_on(GRINDER, names_of.into_iter().zip(columns).collect());
    assert!(!names(&found).contains(&"gear-error"), "{:?}", names(&found));
}

/// Six passes over the same three hundred places, without a clock: no table of targets, each with an error of its own,
/// which took half a minute.
#[test]
fn hundreds_of_places_are_no_targets() {
    let mut noise = white(5, 0.2);
    let mut own = white(6, 0.8);
    let places: Vec<(f64, f64)> = (0..300).map(|row| (0.5 * f64::from(row), own())).collect();
    let mut columns = [const { Vec::new() }; 3];
    for (pass, (mm, own_um)) in (0..6).flat_map(|pass| places.iter().map(move |one| (pass, *one))) {
        let cells = [f64::from(pass), mm, own_um + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let names_of = ["pass", "position_mm", "error_um"];
    let found = diagnosed(names_of.into_iter().zip(columns).collect());
    assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec![]));
    let shapes: Vec<_> = found.residual.iter().map(|one| one.shape.as_str()).collect();
    assert!(shapes.iter().all(|shape| !shape.contains("own error of each target")), "{shapes:?}");
}
