//! Runs that stand at their ends, that are passes of their own by one clock or by several, targets by turns; and how sure
//! the values are.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Structure, Verdict};

use crate::support::diagnosed::{columns, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::{cases, seeds};

/// An axis without a laser.
const AXIS: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";

/// Noise of a deviation that five rows share.
fn of_five_rows(seed: u64, deviation: f64) -> impl FnMut() -> f64 {
    let kept = libm::exp(-0.2);
    let mut fresh = white(seed, deviation * (1.0 - kept * kept).sqrt());
    let mut last = 0.0;
    move || {
        last = kept * last + fresh();
        last
    }
}

/// Nonlinear values of the effects that were found.
fn shapes(found: &Diagnosis) -> Vec<Vec<f64>> {
    let last = found.rounds.last().expect("there is always a round 0");
    last.effects.iter().map(|one| one.term.nonlinear()).collect()
}

/// Strokes of 300 mm that begin and end slowly, and so many rows at each end by an encoder that trembles: the first step
/// back is a thirtieth of the usual one, and play of 0.7 µm is taken up at once.
#[test]
fn an_axis_that_ends_slowly_turns_as_it_leaves() {
    let slow = |part: f64| {
        let ramp = |part: f64| 0.5 * part * part / 0.3;
        let whole = 0.7;
        let gone = if part < 0.3 {
            ramp(part)
        } else if part < 0.7 {
            part - 0.15
        } else {
            whole - ramp(1.0 - part)
        };
        300.0 * gone / whole
    };
    for (seed, stand) in seeds(1, 6).flat_map(|seed| [(seed, 2), (seed, 24)]) {
        let (mut noise, mut tremble) = (white(seed, 0.2), white(700 + seed, 0.000_01));
        let strokes = (0..6_u32).flat_map(|stroke| (0..60 + stand).map(move |row| (stroke, row)));
        let rows = strokes.enumerate().map(|(row, (stroke, inside))| {
            let gone_mm = slow(f64::from(inside.min(60)) / 60.0);
            let ahead = stroke % 2 == 0;
            let (mm, way) = if ahead { (gone_mm, 1.0) } else { (300.0 - gone_mm, -1.0) };
            // It leaves behind the stand of the stroke before.
            let way = if inside == 0 && 0 < stroke { -way } else { way };
            let time_s = 0.5 * f64::from(u32::try_from(row).expect("few rows"));
            [time_s, mm + tremble(), -0.35 * way + noise()]
        });
        let found = diagnosed_on(AXIS, columns(["time_s", "position_mm", "error_um"], rows));
        let told = (names(&found), shapes(&found));
        assert_eq!(told, (vec!["backlash"], vec![vec![0.0, 0.0]]), "{seed}, {stand}");
    }
}

/// Ten runs over 21 targets, there and back, each a pass, by one clock: vibration at 0.021 Hz, less than three waves a run.
#[test]
fn one_clock_through_all_runs_counts_the_waves_of_all() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 0.15);
        let runs = (0..10_u32).flat_map(|run| (0..21_u32).map(move |target| (run, target)));
        let rows = runs.map(|(run, target)| {
            let at = f64::from(if run % 2 == 0 { target } else { 20 - target });
            let since_s = 4.7 * f64::from(target) + 0.2 * libm::sin(7.0 * at);
            let time_s = 110.0 * f64::from(run) + since_s;
            let mm = 23.7 * at + 1.3 * libm::sin(3.0 * at);
            [f64::from(run), time_s, mm, 0.5 * libm::sin(TAU * 0.021 * time_s) + noise()]
        });
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(AXIS, columns(titles, rows));
        let told = (found.verdict, names(&found));
        assert_eq!(told, (Verdict::Explained, vec!["vibration"]), "{seed}");
    }
}

/// Four runs of 120 rows at an uneven pace, each by a clock of its own that begins anywhere in the wave.
#[test]
fn a_wave_with_a_phase_of_each_runs_own_is_no_noise() {
    for seed in seeds(1, 4) {
        let (mut noise, mut chance) = (white(1 + seed, 0.2), white(801 + seed, 1.0));
        let mut rows = Vec::new();
        for run in 0..4_u32 {
            let begun_at = 9.0 * chance();
            for row in 0..120_u32 {
                let time_s = 0.166 * (f64::from(row) + 0.4 * libm::sin(2.0 * chance()));
                let wave_um = 0.26 * libm::sin(begun_at + TAU * 2.13 * time_s);
                rows.push([f64::from(run), time_s, 20.0 * time_s, wave_um + noise()]);
            }
        }
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(AXIS, columns(titles, rows.into_iter()));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
    }
}

/// The second of four passes there and back begins its clock anew just behind its turn, and the others go on by that.
#[test]
fn a_clock_that_begins_anew_behind_a_turn_is_told() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 0.2);
        let rows = (0..560_u32).map(|row| {
            let (pass, inside) = (row / 140, row % 140);
            let mm = 4.0 * f64::from(inside.min(140 - inside));
            let time_s = 0.5 * f64::from(if row < 215 { row } else { row - 213 });
            [f64::from(pass), time_s, mm, noise()]
        });
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(AXIS, columns(titles, rows));
        assert_eq!(found.verdict, Verdict::DoubtfulInput, "{seed}: {:?}", names(&found));
    }
}

/// Targets a turn apart, each a twentieth of a turn off, and those between on a second way, four times, each reached by a
/// move and a dwell: a wave of 1.037 a turn is seen once a row, and so is one of the frequencies far above the rate.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_of_the_travel_is_no_vibration_where_targets_are_visited_by_turns() {
    for seed in seeds(1, 4) {
        let (mut noise, mut off) = (white(seed, 0.2), white(900 + seed, 0.5));
        let mut places: Vec<f64> = (0..41).map(|at| 10.0 * f64::from(at)).collect();
        places.extend((0..40).map(|at| 5.0 + 10.0 * f64::from(at)));
        for mm in &mut places {
            *mm += off();
        }
        let (mut time_s, mut before_mm) = (0.0, 0.0);
        let runs = (0..4_u32).flat_map(|run| places.iter().map(move |mm| (run, *mm)));
        let rows = runs.map(|(run, mm)| {
            time_s += 2.0 + (mm - before_mm).abs() / 50.0;
            before_mm = mm;
            let wave_um = 0.43 * libm::sin(TAU * 1.037 * mm / 10.0);
            [f64::from(run), time_s, mm, wave_um + noise()]
        });
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let machine = AXIS.replace("5 mm", "10 mm");
        let found = diagnosed_on(&machine, columns(titles, rows));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(!names(&found).contains(&"vibration"), "{seed}: {:?}", names(&found));
    }
}

/// A slope of 25 of its own standard errors, there and back. What bow or S may stand beside it makes it less sure, but
/// they are not as likely as none: with both of them free it would have 15 times its own error.
#[test]
fn a_slope_is_as_sure_as_what_was_left_out_beside_it_is_unlikely() {
    let mut alone = 0;
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 0.5);
        let rows = (0..300_u32).map(|row| {
            let mm = 4.0 * f64::from(row.min(299 - row));
            [0.8 * f64::from(row), mm, -4.17 * mm / 1000.0 + noise()]
        });
        let found = diagnosed_on(AXIS, columns(["time_s", "position_mm", "error_um"], rows));
        let last = found.rounds.last().expect("there is always a round 0");
        let Some(slope) = last.effects.iter().find(|one| one.name == "screw-progressive") else {
            panic!("{seed}: {:?}", names(&found));
        };
        // Chance may ask for another size.
        let [linear] = &slope.parameters[..] else { continue };
        alone += 1;
        let stderr = linear.stderr.expect("a size has one");
        assert!((linear.value - 4.17).abs() < 2.0 * stderr, "{seed}: {} ± {stderr}", linear.value);
        assert!(4.0 * stderr < linear.value, "{seed}: {} ± {stderr}", linear.value);
    }
    assert!(0 < alone);
}

/// A slope of 12 of its own standard errors. A square and a cube that undo each other at the end stand for it nearly as
/// well, and what is left of all three sizes without the slope needs both of them.
#[test]
fn a_slope_is_no_square_and_cube_that_undo_each_other() {
    for &seed in cases(2, &[3, 4, 18, 25, 29, 32, 36]) {
        let mut noise = white(seed, 0.5);
        let rows = (0..300_u32).map(|row| {
            let mm = 12.0 * f64::from((row % 100).min(99 - row % 100));
            [2.4 * f64::from(row), mm, -2.0 * mm / 1000.0 + noise()]
        });
        let found = diagnosed_on(AXIS, columns(["time_s", "position_mm", "error_um"], rows));
        let last = found.rounds.last().expect("there is always a round 0");
        let keys: Vec<_> =
            last.effects.iter().flat_map(|one| &one.parameters).map(|one| &one.key).collect();
        assert_eq!(keys, ["linear_um_per_m"], "{seed}");
    }
}

/// An axis that stands for six rows in the middle of each stroke and trembles there, over noise that five rows share: its
/// way is that of the stroke.
#[test]
fn an_axis_that_trembles_where_it_stands_goes_on() {
    for seed in seeds(2, 8) {
        let (mut noise, mut tremble) = (of_five_rows(seed, 0.5), white(seed + 100, 0.002));
        let rows = (0..240_u32).map(|row| {
            let (stroke, at) = (row / 40, row % 40);
            let (gone, stands) = (at.min(15) + at.max(21) - 21, (15..=21).contains(&at));
            let is_there = stroke % 2 == 0;
            let mm = 10.0 * f64::from(if is_there { gone } else { 33 - gone });
            let play = if is_there { 1.2 } else { -1.2 };
            let off = if stands { tremble() } else { 0.0 };
            [0.5 * f64::from(row), mm + off, play + noise()]
        });
        let found = diagnosed_on(AXIS, columns(["time_s", "position_mm", "error_um"], rows));
        assert_eq!(names(&found), ["backlash"], "{seed}: {:?}", found.verdict);
        assert_eq!(found.verdict, Verdict::Explained, "{seed}");
    }
}

/// Ten targets of three readings each, the last read from either side: the axis has gone on and come back meanwhile, which
/// took as long as a move.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn readings_of_the_last_target_come_from_either_side() {
    for seed in seeds(2, 8) {
        let mut noise = of_five_rows(seed, 0.5);
        let rows = (0..240_u32).map(|row| {
            let (visit, reading) = (row / 3, f64::from(row % 3));
            let (run, at) = (visit / 10, visit % 10);
            let is_there = run % 2 == 0;
            let mm = 23.0 * f64::from(if is_there { at } else { 9 - at });
            let play = if is_there { 1.2 } else { -1.2 };
            [5.0 * f64::from(visit) + 0.5 * reading, mm, play + noise()]
        });
        let found = diagnosed_on(AXIS, columns(["time_s", "position_mm", "error_um"], rows));
        assert_eq!(names(&found), ["backlash"], "{seed}: {:?}", found.verdict);
    }
}

/// Two waves and a half in each of six passes, each with a phase of its own: by a clock that begins anew they have no
/// common one, and the noise, as slow as they are, must not swallow them.
#[test]
fn waves_with_a_phase_of_each_passs_own_are_no_slow_noise() {
    for seed in seeds(2, 8) {
        let (mut noise, mut phase) = (white(seed, 1.0), white(seed + 100, 2.0));
        let rows = (0..6_u32).flat_map(|pass| {
            let phase = phase();
            let rows = (0..60_u32).map(|row| {
                let s = f64::from(row);
                [
                    f64::from(pass),
                    s,
                    5.0 * s,
                    1.1 * libm::sin(TAU * 2.5 * s / 60.0 + phase) + noise(),
                ]
            });
            rows.collect::<Vec<_>>()
        });
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(AXIS, columns(titles, rows));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        let phases = |one: &Structure| one.shape.contains("a phase of each pass's own");
        assert!(found.residual.iter().any(phases), "{seed}");
    }
}

/// A force that comes and goes turns a drive about at once, with direction told: no way is so short that the row behind a
/// turn has any left.
#[test]
fn what_winds_up_at_once_winds_up() {
    for &seed in cases(2, &[13, 20, 27]) {
        let (mut noise, mut place) = (of_five_rows(seed, 0.1), white(seed + 100, 0.2));
        let mut force = of_five_rows(seed + 200, 20.0);
        let rows = (0..600_u32).map(|row| {
            let (stroke, at) = (row / 100, row % 100);
            let there = stroke % 2 == 0;
            let way = if there { 1.0 } else { -1.0 };
            let mm = 15.0 * (f64::from(if there { at } else { 99 - at }) + place());
            let newton = 110.0 + force();
            let s = f64::from(row) + 4.0 * f64::from(stroke);
            [s, mm, way, newton, -0.0016 * way * newton + noise()]
        });
        let titles = ["time_s", "position_mm", "direction", "force_n", "error_um"];
        let found = diagnosed_on(AXIS, columns(titles, rows));
        assert_eq!(names(&found), ["wind-up"], "{seed}: {:?}", found.verdict);
    }
}

/// A step of a hundred fringes, in noise of a sixth of one and of a dozen: there the count is as sure as the step is.
#[test]
fn a_count_that_nothing_tells_has_an_error() {
    const LASER: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n\
                         laser.wavelength = \"0.6329908 um\"\n";
    for (deviation, is_sure) in [(0.05, true), (4.0, false)] {
        let mut noise = white(1, deviation);
        let rows = (0..300_u32).map(|row| {
            let slipped = if row < 140 { 0.0 } else { 100.0 * 0.5 * 0.632_990_8 };
            [0.5 * f64::from(row), 2.0 * f64::from(row), slipped + noise()]
        });
        let found = diagnosed_on(LASER, columns(["time_s", "position_mm", "error_um"], rows));
        let last = found.rounds.last().expect("there is always a round 0");
        let counts = last.effects.iter().flat_map(|one| &one.parameters);
        let counts: Vec<_> = counts.filter(|one| one.key == "count").collect();
        let [count] = counts[..] else { panic!("{deviation}: {:?}", names(&found)) };
        assert_eq!(count.stderr.is_none(), is_sure, "{count:?}");
        let stderr = count.stderr.unwrap_or(0.01);
        assert!((count.value.abs() - 100.0).abs() < 3.0 * stderr, "{count:?}");
    }
}

/// Thirteen waves round a circle that is seen at its 24 faces are eleven as well; at 50 places they are thirteen.
#[test]
fn even_places_do_not_tell_which_of_two_numbers_of_waves() {
    const CIRCLE: &str = "output = { rotary = true }\nspindle.speed = \"1 rpm\"\n\
                          grating = { lines = 18000, diameter = \"200 mm\" }\n";
    for (faces, is_one_of_two) in [(24.0, true), (50.0, false)] {
        let mut noise = white(1, 0.2);
        let rows = (0..200_u32).map(|row| {
            let turn = f64::from(row) / faces;
            [10.0 * f64::from(row), turn, 0.6 * libm::sin(TAU * 13.0 * turn) + noise()]
        });
        let found = diagnosed_on(CIRCLE, columns(["time_s", "angle_rev", "error_arcsec"], rows));
        let last = found.rounds.last().expect("there is always a round 0");
        let all = last.effects.iter().flat_map(|one| &one.parameters);
        let warnings: Vec<bool> =
            all.filter(|one| one.key == "harmonic").map(|one| one.warning.is_some()).collect();
        assert_eq!(warnings, [is_one_of_two], "{faces}: {:?}", names(&found));
    }
}
