//! Tables as people log them: targets in any order, positions that tremble, a clock in whole seconds, headers of their
//! own.

use std::f64::consts::TAU;
use std::path::Path;

use helixlock_lab::{Diagnosis, LabError, Measurement, Nominal, Verdict};
use helixlock_plant::Model;
use helixlock_traces::{Column, Table};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// An axis without a laser.
const AXIS: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";

/// Places that the axis goes to one after the other, six seconds apart; play of 3 µm is taken up at once.
fn visited(seed: u64, places_mm: &[f64]) -> Diagnosis {
    let mut noise = white(seed, 0.6);
    let mut way = 1.0;
    let mut error_um = Vec::new();
    for (row, place) in places_mm.iter().enumerate() {
        // A position trembles by less than a micrometre where the axis stands.
        if row > 0 && 0.1 < (place - places_mm[row - 1]).abs() {
            way = (place - places_mm[row - 1]).signum();
        }
        error_um.push(-1.5 * way + noise());
    }
    let time_s = (0_u32..).map(|row| 6.0 * f64::from(row)).take(places_mm.len()).collect();
    let columns = [("time_s", time_s), ("position_mm", places_mm.to_vec()), ("error_um", error_um)];
    diagnosed_on(AXIS, columns.into())
}

/// Targets in random order, as drift is told from place; and three ahead and one back.
#[test]
fn play_is_told_where_single_steps_go_to_and_fro() {
    for seed in seeds(1, 4) {
        let mut chance = white(100 + seed, 1.0);
        let anywhere: Vec<f64> =
            (0..100).map(|_| 400.0 * (0.5 + libm::atan(chance()) / TAU)).collect();
        let pilgrims: Vec<f64> =
            (0_u32..120).map(|row| 4.5 * f64::from(row / 4 * 2 + row % 4)).collect();
        for places_mm in [anywhere, pilgrims] {
            let found = visited(seed, &places_mm);
            let told = (found.verdict, names(&found));
            assert_eq!(told, (Verdict::Explained, vec!["backlash"]), "{seed}");
        }
    }
}

/// Thirteen rows ahead and ten back at an uneven pace, and a row at each turn: the axis has come there, and its play
/// is not taken up yet.
#[test]
fn play_at_once_takes_no_way_where_rows_are_at_the_turns() {
    for seed in seeds(1, 4) {
        let mut chance = white(500 + seed, 0.8);
        let way = |row: u32| if row % 23 < 13 { 1.0 } else { -1.0 };
        let places = (0..138).scan(0.0, |at_mm, row| {
            *at_mm += way(row) * (4.0 + chance());
            Some(*at_mm)
        });
        let found = visited(seed, &places.collect::<Vec<f64>>());
        let last = found.rounds.last().expect("there is always a round 0");
        let ways: Vec<Vec<f64>> = last.effects.iter().map(|one| one.term.nonlinear()).collect();
        assert_eq!((names(&found), ways), (vec!["backlash"], vec![vec![0.0, 0.0]]), "{seed}");
    }
}

/// Strokes of seven rows there and back, and six rows at each end by an encoder that trembles.
#[test]
fn play_is_told_where_a_swift_axis_stands_before_it_turns() {
    for seed in seeds(1, 4) {
        let mut tremble = white(300 + seed, 0.0001);
        let strokes = (0_u32..144).map(|row| (row / 12 % 2, (row % 12).min(7)));
        let targets = strokes.map(|(back, row)| if back == 0 { row } else { 7 - row });
        let places_mm: Vec<f64> = targets.map(|at| 15.0 * f64::from(at) + tremble()).collect();
        let found = visited(seed, &places_mm);
        let told = (found.verdict, names(&found));
        assert_eq!(told, (Verdict::Explained, vec!["backlash"]), "{seed}");
    }
}

/// A wave that goes 0.4 times more into the travel than a listed wheel turns, at 200 targets in random order.
#[test]
fn an_order_beside_a_wheels_is_not_its_own_at_targets_in_random_order() {
    let machine = format!("{AXIS}gear = [{{ name = \"wheel\", order = 2.5 }}]\n");
    for seed in seeds(1, 4) {
        let (mut chance, mut noise) = (white(400 + seed, 1.0), white(seed, 1.0));
        let places_mm: Vec<f64> =
            (0..200).map(|_| 400.0 * (0.5 + libm::atan(chance()) / TAU)).collect();
        let order = 2.5 + 0.4 * 5.0 / 200.0;
        let wave_um = |mm: &f64| 1.6 * libm::sin(TAU * order * mm / 5.0);
        let columns = vec![
            ("time_s", (0_u32..200).map(|row| 6.0 * f64::from(row)).collect()),
            ("error_um", places_mm.iter().map(|mm| wave_um(mm) + noise()).collect()),
            ("position_mm", places_mm),
        ];
        let found = diagnosed_on(&machine, columns);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}

/// Five readings at each target there and back, by an encoder that trembles.
#[test]
fn play_is_told_where_positions_tremble_at_rest() {
    for seed in seeds(1, 4) {
        let mut tremble = white(200 + seed, 0.0006);
        let targets = (0_i32..9).chain((0..8).rev());
        let readings = targets.flat_map(|target| [40.0 * f64::from(target); 5]);
        let places_mm: Vec<f64> = readings.map(|target| target + tremble()).collect();
        let found = visited(seed, &places_mm);
        let told = (found.verdict, names(&found));
        assert_eq!(told, (Verdict::Explained, vec!["backlash"]), "{seed}");
    }
}

/// Thirty rows a second by a clock in whole seconds, in noise that forgets within ten rows.
#[test]
fn a_clock_in_whole_seconds_leaves_noise_as_slow_as_it_is() {
    for seed in seeds(1, 4) {
        let (mut fresh, mut last) = (white(seed, 1.0), 0.0);
        let mut noise = || {
            last = 0.9 * last + fresh();
            last
        };
        let columns = vec![
            ("time_s", (0..900_u32).map(|row| f64::from(row / 30)).collect()),
            ("position_mm", (0..900).map(|row| 0.4 * f64::from(row)).collect()),
            ("error_um", (0..900).map(|_| noise()).collect()),
        ];
        assert_eq!(diagnosed(columns).verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// In one pass a slope is a drift as well, though nobody has met one of 2000 µm an hour.
#[test]
fn a_rival_of_no_plausible_size_is_a_rival() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 1.0);
        let mm = |row: u32| 0.5 * f64::from(row);
        let columns = vec![
            ("time_s", (0..600).map(|row| mm(row) / 5.0).collect()),
            ("position_mm", (0..600).map(mm).collect()),
            ("error_um", (0..600).map(|row| 33.0 * mm(row) / 300.0 + noise()).collect()),
        ];
        let found = diagnosed_on(AXIS, columns);
        assert_eq!(found.verdict, Verdict::Ambiguous, "{seed}: {:?}", names(&found));
    }
}

/// Two runs over 76 mm or less, their places under a name.
fn read(name: &str, factor: f64) -> Result<Measurement, LabError> {
    let rows = || (0..40_u32).map(f64::from);
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let table = Table::new(vec![
        column("Run No.", rows().map(|row| (row / 20.0).floor()).collect()),
        column("Time (s)", rows().collect()),
        column(name, rows().map(|row| factor * (row % 20.0)).collect()),
        column("error_um", rows().map(|row| row % 3.0).collect()),
    ]);
    let machine = Model::parse(AXIS, Path::new("machine.toml")).expect("a machine");
    Measurement::from_table(&table, &Nominal::of(&machine))
}

#[test]
fn a_travel_under_a_name_of_its_own_is_read_or_refused() {
    let known = read("Pos. / mm", 4.0).expect("a position");
    assert_eq!((known.position_mm[19], known.pass_names.len()), (76.0, 2));
    let message = read("X1 (mm)", 4.0).expect_err("where was the axis?").to_string();
    assert!(message.contains("found `X1 (mm)`, which moves as far as the axis"), "{message}");
    read("gap (mm)", 0.004).expect("a log");
    read("gap (um)", 4.0).expect("a log");
}
