//! Play and wind-up as a pass begins: taken up, as the pass before left them, or as behind a turn; and tables of so few
//! targets that names have a number for each.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{columns, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::{cases, seeds};

/// An axis without a laser.
const AXIS: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";

/// How far a part that is carried with play over some way lags behind, −1/2 to 1/2, from such a lag on.
fn lags(places_mm: &[f64], way_mm: f64, begun: f64) -> Vec<f64> {
    let mut lag = begun;
    let mut before = places_mm[0];
    let of = |&mm: &f64| {
        lag = (lag + (mm - before) / way_mm).clamp(-0.5, 0.5);
        before = mm;
        lag
    };
    places_mm.iter().map(of).collect()
}

/// The place of a row of strokes over so many rows of 2 mm there and back.
fn there_and_back_mm(row: u32, rows: u32) -> f64 {
    let inside = row % (2 * rows);
    2.0 * f64::from(inside.min(2 * rows - inside))
}

/// Places of strokes of 160 rows there and back.
fn places_mm() -> Vec<f64> {
    (0..960).map(|row| there_and_back_mm(row, 160)).collect()
}

/// What shows at these places, in passes of so many rows, with a column beside it.
fn strokes(
    (seed, rows_a_pass): (u64, u32),
    error_um: &[f64],
    logged: Option<(&'static str, Vec<f64>)>,
) -> Diagnosis {
    let mut noise = white(seed, 0.3);
    let rows = (0..960_u32).zip(places_mm()).zip(error_um).map(|((row, mm), error)| {
        [f64::from(row / rows_a_pass), 0.4 * f64::from(row), mm, error + noise()]
    });
    let mut table = columns(["pass", "time_s", "position_mm", "error_um"], rows);
    table.extend(logged);
    diagnosed_on(AXIS, table)
}

/// Play of 1.2 µm that is taken up over some way, from such a lag on.
fn play_um(way_mm: f64, begun: f64) -> Vec<f64> {
    lags(&places_mm(), way_mm, begun).iter().map(|lag| -1.2 * lag).collect()
}

/// The way of the one effect that is named, if it is this one and nothing is left.
fn way_mm(found: &Diagnosis, name: &str) -> Option<f64> {
    let [one] = &found.rounds.last()?.effects[..] else { return None };
    (found.verdict == Verdict::Explained && one.name == name).then(|| one.term.nonlinear()[0])
}

/// A log that begins as the axis has come back, and as it goes on.
#[test]
fn play_that_a_log_begins_with_is_no_other_cause() {
    for (seed, begun) in seeds(1, 4).flat_map(|seed| [(seed, -0.5), (seed, 0.5)]) {
        let found = strokes((seed, 960), &play_um(24.0, begun), None);
        let way_mm = way_mm(&found, "backlash");
        assert!(
            way_mm.is_some_and(|way_mm| (way_mm - 24.0).abs() < 5.0),
            "{seed}, {begun}: {:?}, {:?}, {way_mm:?}",
            found.verdict,
            names(&found)
        );
    }
}

/// Passes there, and back, that follow on one another: each begins with the play as it was left.
#[test]
fn a_pass_goes_on_from_the_one_before() {
    let passes = [160, 320];
    for (seed, &rows) in
        seeds(1, 4).flat_map(|seed| cases(1, &passes).iter().map(move |rows| (seed, rows)))
    {
        let found = strokes((seed, rows), &play_um(16.0, 0.5), None);
        let way_mm = way_mm(&found, "backlash");
        assert!(
            way_mm.is_some_and(|way_mm| (way_mm - 16.0).abs() < 5.0),
            "{seed}, {rows}: {:?}, {:?}, {way_mm:?}",
            found.verdict,
            names(&found)
        );
    }
}

/// The same of a drive that a force winds up.
#[test]
fn a_drive_that_was_wound_up_stays_so_from_pass_to_pass() {
    for seed in seeds(1, 4) {
        let force_n: Vec<f64> =
            (0..960).map(|row| 80.0 + 30.0 * libm::sin(0.021 * f64::from(row))).collect();
        let (mut wound, mut before) = (1.0, 0.0);
        let of = |(mm, force): (f64, &f64)| {
            let (way, ahead) = (f64::abs(mm - before), if mm < before { -1.0 } else { 1.0 });
            wound = ahead + (wound - ahead) * libm::exp(-way / 12.0);
            before = mm;
            -0.008 * force * wound
        };
        let error_um: Vec<f64> = places_mm().into_iter().zip(&force_n).map(of).collect();
        let found = strokes((seed, 320), &error_um, Some(("force_n", force_n)));
        let way_mm = way_mm(&found, "wind-up");
        assert!(
            way_mm.is_some_and(|way_mm| (way_mm - 12.0).abs() < 4.0),
            "{seed}: {:?}, {:?}, {way_mm:?}",
            found.verdict,
            names(&found)
        );
    }
}

/// The loop of a piezo, which bends over a quarter of the stroke, and on over the rest.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_loop_over_the_stroke_is_no_play() {
    for seed in seeds(2, 6) {
        let (mut lag, mut before) = (0.0, 0.0);
        let of = |mm: f64| {
            let moved = (mm - before) / 320.0;
            (lag, before) = (lag + moved - 4.0 * f64::abs(moved) * lag, mm);
            1.2 * lag
        };
        let loops_um: Vec<f64> = places_mm().into_iter().map(of).collect();
        let found = strokes((seed, 320), &loops_um, None);
        assert_ne!(found.verdict, Verdict::Explained, "{seed}: {:?}", names(&found));
    }
}

/// Errors of their own at seven to ten targets, three runs each way, forty times the noise: names have nearly as many
/// numbers.
#[test]
fn names_with_a_number_for_each_target_are_not_told() {
    let targets = [7_u32, 8, 9, 10];
    for (seed, &targets) in
        seeds(1, 6).flat_map(|seed| cases(2, &targets).iter().map(move |one| (seed, one)))
    {
        let (mut noise, mut own) = (white(seed, 0.1), white(400 + seed, 2.0));
        let own_um: Vec<f64> = (0..targets).map(|_| own()).collect();
        let mut rows = Vec::new();
        for (run, at) in (0..6_u32).flat_map(|run| (0..targets).map(move |at| (run, at))) {
            let (target, way) = if run % 2 == 0 { (at, 1.0) } else { (targets - 1 - at, -1.0) };
            let time_s = 12.0 * f64::from(run * targets + at);
            let mm = 41.3 * f64::from(target) + 3.0 * libm::sin(TAU * 0.37 * f64::from(target));
            let error = own_um[usize::try_from(target).expect("few")] + noise();
            rows.push([f64::from(run / 2), time_s, mm, way, error]);
        }
        let titles = ["pass", "time_s", "position_mm", "direction", "error_um"];
        let gears = format!("{AXIS}gear = [{{ name = \"motor\", order = 3.0, teeth = 25 }}]\n");
        let found = diagnosed_on(&gears, columns(titles, rows.into_iter()));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}, {targets}: {:?}", names(&found));
    }
}
