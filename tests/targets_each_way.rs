//! Tables of targets that show one way what they do not the other, as a carriage that tilts with its motion makes.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{columns, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// An axis without a laser.
const AXIS: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"160 mm\"\n";

const EACH_WAY: &str = "own error of each target, another each way";

/// Four runs there and back past 11 to 19 uneven targets, each with an error of its own and of 1 µm each way, beside
/// play, in noise of 0.15 µm; the moves take as long each time.
fn runs(seed: u64, play_um: f64) -> Diagnosis {
    let targets = 11 + 2 * u32::try_from(seed % 5).expect("few");
    let (mut own, mut noise) = (white(700 + seed, 1.0), white(seed, 0.15));
    let errors: Vec<[f64; 2]> = (0..targets).map(|_| [5.0 * own(), own()]).collect();
    let rows = (0..4 * 2 * targets).map(|visit| {
        let (run, visit_of_run) = (visit / (2 * targets), visit % (2 * targets));
        let is_there = visit_of_run < targets;
        let target = if is_there { visit_of_run } else { 2 * targets - 1 - visit_of_run };
        let way = if is_there { 1.0 } else { -1.0 };
        let place_mm = 81.7 * f64::from(target) + 9.0 * libm::sin(TAU * 0.37 * f64::from(target));
        let [always, each_way] = errors[usize::try_from(target).expect("few")];
        let error_um = always + way * (each_way - 0.5 * play_um) + noise();
        [f64::from(run), 6.2 * f64::from(visit), place_mm, way, error_um]
    });
    let titles = ["pass", "time_s", "position_mm", "direction", "error_um"];
    diagnosed_on(AXIS, columns(titles, rows))
}

#[test]
fn what_targets_show_each_way_has_no_name() {
    for seed in seeds(3, 10) {
        let found = runs(seed, 0.0);
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
        let told: Vec<&str> = found.residual.iter().map(|left| left.shape.as_str()).collect();
        assert_eq!((found.verdict, told), (Verdict::Unexplained, vec![EACH_WAY]), "{seed}");
    }
}

/// Its ± is the scatter of the targets, and not how well visits agree.
#[test]
fn a_reversal_is_told_by_the_scatter_of_targets() {
    for seed in seeds(2, 10) {
        let found = runs(seed, 8.0);
        assert_eq!(names(&found), ["backlash"], "{seed}");
        let [width] = &found.rounds.last().expect("a round").effects[0].parameters[..] else {
            panic!("{seed}: a value of what cannot be told")
        };
        let error = width.stderr.expect("an error");
        assert!((0.2..1.0).contains(&error), "{seed}: {width:?}");
        assert!((width.value - 8.0).abs() < 3.0 * error, "{seed}: {width:?}");
    }
}

/// Play of twenty standard errors beside a bow of eight, five runs there and back past 31 targets: a way as long as the
/// travel, in which the play is taken up, follows both, and is no play.
#[test]
fn play_beside_a_bow_keeps_its_name() {
    let axis = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"10 mm\"\nlaser.wavelength = \"0.6328 um\"\n";
    for seed in seeds(4, 12) {
        let mut noise = white(2005 + seed, 3.0);
        let rows = (0..5 * 62_u16).map(|visit| {
            let (run, of_run) = (visit / 62, visit % 62);
            let (target, way) = if of_run < 31 { (of_run, 1.0) } else { (61 - of_run, -1.0) };
            let place_mm = 500.0 / 30.0 * f64::from(target);
            let bow_um = 20e-6 * place_mm * place_mm;
            [f64::from(run), place_mm, way, bow_um - 3.5 * way + noise()]
        });
        let found =
            diagnosed_on(axis, columns(["pass", "position_mm", "direction", "error_um"], rows));
        assert!(names(&found).contains(&"backlash"), "{seed}: {:?}", names(&found));
    }
}
