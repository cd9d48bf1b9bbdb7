//! Waves by their order or their frequency, and play by the way that takes it up.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, FittedEffect, Found, Verdict, diagnose, discover};

use crate::support::diagnosed::{self, diagnosed, diagnosed_on, names, problem_of};
use crate::support::passes::{MACHINE, white};
use crate::support::seeds::seeds;

const TABLE: &str = "output.rotary = true\nspindle.speed = \"0.6 rpm\"\n\
                     gear = [{ name = \"worm\", order = 20 }]\n";

/// An axis without a laser.
const AXIS: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";

/// One turn of a table in 100 s, 300 rows; the error is of the turn, 0 to 1.
fn one_turn(machine: &str, seed: u64, noise: f64, error_arcsec: &dyn Fn(f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, noise);
    let turn = |row: u16| f64::from(row) / 300.0;
    let columns = vec![
        ("time_s", (0..300).map(|row| 100.0 * turn(row)).collect()),
        ("angle_rev", (0..300).map(turn).collect()),
        ("error_arcsec", (0..300).map(|row| error_arcsec(turn(row)) + noise()).collect()),
    ];
    diagnosed_on(machine, columns)
}

/// Effects of the last round.
fn last(found: &Diagnosis) -> &[FittedEffect] {
    found.rounds.last().map_or(&[], |round| &round.effects)
}

/// A table that seats on one of two faces: over one turn its square wave is no eccentricity and what the disc's
/// divisions add to it.
#[test]
fn a_square_wave_of_one_turn_is_no_waves_of_the_disc() {
    const DISC: &str = "output.rotary = true\nspindle.speed = \"0.6 rpm\"\n\
                        grating = { lines = 36000, diameter = \"150 mm\" }\n";
    for seed in seeds(1, 6) {
        let square = |turn: f64| if (turn + 0.13).fract() < 0.5 { 0.5 } else { -0.5 };
        let found = one_turn(DISC, seed, 0.3, &square);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
    }
}

/// A shaft that nobody listed repeats each turn too, and so does all of it together.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_keeps_its_name_beside_a_smaller_shape_of_each_turn() {
    const MOTOR: &str = "output.rotary = true\nspindle.speed = \"60 rpm\"\n\
                         gear = [{ name = \"pole pair\", order = 4 }]\n";
    let mut noise = white(1, 5.0);
    let turn = |row: u16| f64::from(row) / 100.0;
    let wave = |order: f64, phase: f64| move |turn: f64| libm::sin(TAU * order * turn + phase);
    let (listed, slower, third) = (wave(4.0, 1.0), wave(2.0, 2.0), wave(12.0, 0.0));
    let error = |turn| 220.0 * listed(turn) + 40.0 * slower(turn) + 49.0 * third(turn);
    let columns = vec![
        ("time_s", (0..2000).map(turn).collect()),
        ("error_arcsec", (0..2000).map(|row| error(turn(row)) + noise()).collect()),
    ];
    let found = diagnosed_on(MOTOR, columns);
    let order = |effect: &FittedEffect| effect.term.nonlinear()[0];
    assert!(last(&found).iter().any(|one| (order(one) - 4.0).abs() < 1e-9), "{:?}", names(&found));
    assert_eq!(found.verdict, Verdict::Unexplained);
}

/// One pass of an axis, 600 rows over 222 mm of a screw of 5 mm; the error is of the screw's turns.
fn of_the_screw(seed: u64, error_um: &dyn Fn(f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 1.0);
    let place = |row: u16| 0.37 * f64::from(row);
    let columns = vec![
        ("position_mm", (0..600).map(place).collect()),
        ("error_um", (0..600).map(|row| error_um(place(row) / 5.0) + noise()).collect()),
    ];
    diagnosed_on(AXIS, columns)
}

/// The second wave swelling with the turn, beside a first one, is the same three waves: it saves nothing.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn three_waves_of_a_screw_are_no_wave_that_swells() {
    for seed in seeds(1, 6) {
        let wave = |turn: f64, waves: f64, phase: f64| libm::sin(TAU * waves * turn + phase);
        let three =
            |turn| wave(turn, 1.0, 2.1) + 0.6 * wave(turn, 2.0, 0.4) + 0.5 * wave(turn, 3.0, 1.0);
        let found = of_the_screw(seed, &three);
        assert_eq!(names(&found), ["screw-periodic"; 3], "{seed}");
        assert_ne!(found.verdict, Verdict::Unexplained, "{seed}");
    }
}

/// A part that seats on one of two faces twice a turn has waves of the second and sixth order.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_square_wave_twice_a_turn_is_no_waves_of_the_screw() {
    for seed in seeds(1, 6) {
        let square = |turn: f64| if (2.0 * turn + 0.13).fract() < 0.5 { 0.8 } else { -0.8 };
        let found = of_the_screw(seed, &square);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}

/// The table's motion shows on the recorder and on the thread with opposite signs: the sum of both shows no
/// vibration that either shows alone.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_vibration_is_heard_on_recorder_and_thread_together() {
    const TABLE_MOTION: [f64; 2] = [-1.0, 1.0];
    for seed in seeds(1, 8) {
        let mut noise = white(seed, 1.0);
        let rows = || (0_u16..3).flat_map(|pass| (0_u16..133).map(move |row| (pass, row)));
        let time_s =
            |(pass, row): (u16, u16)| 25.0 * f64::from(pass * 133 + row) + 40.0 * f64::from(pass);
        let way = |row: u16| 15.0 * f64::from(row.min(132 - row));
        let wave = |at| libm::sin(TAU * time_s(at) * 0.007_68 + 1.0);
        let mut columns = vec![
            ("time_s", rows().map(time_s).collect()),
            ("pass", rows().map(|(pass, _)| f64::from(pass) + 1.0).collect()),
            ("position_mm", rows().map(|(_, row)| way(row)).collect()),
            ("direction", rows().map(|(_, row)| if row < 66 { 1.0 } else { -1.0 }).collect()),
        ];
        for (name, sign) in ["error_um", "lead_error_um"].into_iter().zip(TABLE_MOTION) {
            columns.push((name, rows().map(|at| sign * wave(at) + noise()).collect()));
        }
        let found = diagnosed_on(MACHINE, columns);
        assert_eq!(names(&found), ["vibration"], "{seed}");
        assert_eq!(found.verdict, Verdict::Explained, "{seed}");
    }
}

/// A screw that runs out of the meter's range three times; near the ends of the range it shows nothing. The width is
/// looked for between the places of a grid as well, where the curve only steps from row to row.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_dead_zone_has_its_width() {
    const RANGE_UM: f64 = 150.0 * 0.632_820_365_309_938_1 / 2.0;
    let screw =
        format!("{MACHINE}[[effect]]\nkind = \"screw-progressive\"\nlinear = \"-150 um/m\"\n");
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 0.3);
        let error_um = |row: u16| {
            let known_um = 0.225 * f64::from(row);
            let pulse_um = known_um.rem_euclid(RANGE_UM);
            let gap_um = RANGE_UM - pulse_um;
            let swallowed_um = match (pulse_um < 3.0, gap_um < 3.0) {
                (true, _) => -pulse_um,
                (_, true) => gap_um,
                _ => 0.0,
            };
            known_um + swallowed_um
        };
        let columns = vec![
            ("time_s", (0..600).map(|row| 2.5 * f64::from(row)).collect()),
            ("position_mm", (0..600).map(|row| 1.5 * f64::from(row)).collect()),
            ("initial_phase", vec![0.0; 600]),
            ("error_um", (0..600).map(|row| error_um(row) + noise()).collect()),
        ];
        let found = diagnosed_on(&screw, columns);
        assert_eq!(names(&found), ["meter-dead-zone"], "{seed}");
        let width = &last(&found)[0].parameters[0];
        let stderr = width.stderr.expect("an error");
        assert!((width.value - 3.0).abs() < 4.0 * stderr && stderr < 0.2, "{seed}: {width:?}");
    }
}

/// A row of three times there and back over 100 mm at one speed, a row each millimetre.
struct There {
    time_s: f64,
    mm: f64,
    pass: f64,
    way: f64,
    /// Way since the axis turned.
    since_mm: f64,
}

fn rows_there_and_back() -> impl Iterator<Item = There> {
    let rows = (0_u16..3).flat_map(|pass| (0..200_u16).map(move |row| (pass, row)));
    rows.map(|(pass, row)| {
        let gone = f64::from(row) + 0.5;
        let (way, mm, since_mm) =
            if row < 100 { (1.0, gone, f64::INFINITY) } else { (-1.0, 200.0 - gone, gone - 100.0) };
        let time_s = 0.25 * f64::from(row + 217 * pass);
        There { time_s, mm, pass: f64::from(pass) + 1.0, way, since_mm }
    })
}

/// The diagnosis of these; the error, µm, is of time, s, of the direction, and of the way since the axis turned, mm.
fn there_and_back(seed: u64, error_um: &dyn Fn(f64, f64, f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 0.3);
    let mut columns = [const { Vec::new() }; 5];
    for There { time_s, mm, pass, way, since_mm } in rows_there_and_back() {
        let cells = [time_s, mm, pass, way, error_um(time_s, way, since_mm) + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let titles = ["time_s", "position_mm", "pass", "direction", "error_um"];
    diagnosed_on(MACHINE, titles.into_iter().zip(columns).collect())
}

/// Play that is taken up over 20 mm, and play that is taken up at once.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn play_has_the_way_that_takes_it_up() {
    for seed in seeds(1, 3) {
        let found = there_and_back(seed, &|_, way, since_mm| {
            -4.0 * way * ((since_mm / 20.0).min(1.0) - 0.5)
        });
        assert_eq!(found.verdict, Verdict::Explained, "{seed}");
        let [play] = last(&found) else { panic!("{:?}", names(&found)) };
        let [width, way] = [&play.parameters[0], &play.parameters[1]];
        assert!((width.value - 4.0).abs() < 0.3 && (way.value - 20.0).abs() < 4.0, "{play:?}");
        let found = there_and_back(seed, &|_, way, _| 2.0 * way);
        assert_eq!(names(&found), ["backlash"], "{seed}");
        assert!(last(&found)[0].term.nonlinear()[0].abs() < 1e-9, "{seed}");
    }
}

/// Force winds a drive up, and play is taken up evenly: alike but for the way back, of which a dozen rows a turn tell
/// one from the other by some 17 of evidence.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_winds_up_is_no_play_that_is_nearly_as_good() {
    let asked = seeds(4, 12);
    let all = asked.end;
    let mut named = 0;
    for seed in asked {
        let mut noise = white(seed, 0.4);
        let mut columns = [const { Vec::new() }; 6];
        for There { time_s, mm, pass, way, since_mm } in rows_there_and_back() {
            let error = way * (2.0 * libm::exp(-since_mm / 12.0) - 1.0) + noise();
            let cells = [pass, time_s, mm, way, 100.0, error];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "direction", "force_n", "error_um"];
        let found = diagnosed_on(AXIS, titles.into_iter().zip(columns).collect());
        let is_named = names(&found) == ["wind-up"] && found.verdict == Verdict::Explained;
        named += u64::from(is_named);
    }
    assert!(3 * all <= 4 * named, "{named} of {all}");
}

/// A play that the whole way back would not take up is no play that was seen: a slope of the way back does as much.
/// A line of each way contains both, for one number more that nobody needs.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_slope_and_play_are_no_line_of_each_way() {
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 0.2);
        let mut columns = [const { Vec::new() }; 4];
        for row in 0..400_u16 {
            let (pass, nth) = (f64::from(row / 200), f64::from(row % 200));
            let (way, mm) =
                if nth < 100.0 { (1.0, 4.0 * nth) } else { (-1.0, 4.0 * (199.0 - nth)) };
            let time_s = 300.0 * pass + nth;
            let cells = [pass, time_s, mm, 0.012 * mm - 0.5 * 1.5 * way + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(AXIS, titles.into_iter().zip(columns).collect());
        let mut both = names(&found);
        both.sort_unstable();
        assert_eq!(both, ["backlash", "screw-progressive"], "{seed}");
        assert_eq!(found.verdict, Verdict::Explained, "{seed}");
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_way_beyond_all_that_was_gone_is_no_play() {
    for seed in seeds(1, 3) {
        let found = there_and_back(seed, &|_, way, since_mm| {
            let gone = if since_mm.is_finite() { since_mm } else { 0.0 };
            if way < 0.0 { 0.02 * gone } else { 0.0 }
        });
        assert!(!names(&found).contains(&"backlash"), "{seed}: {:?}", last(&found));
        assert_ne!(found.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// A wave of the travel that no shaft has, under a clock that goes on while the place is looked at every tenth
/// reading: the clock draws it better than the places do, and is not what makes it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_of_the_travel_is_no_vibration_where_places_are_held() {
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 0.3);
        let mm = |row: u16| 0.12 * f64::from(row);
        let columns = vec![
            ("time_s", (0..1500).map(|row| 0.05 * f64::from(row)).collect()),
            ("position_mm", (0..1500).map(|row| mm(row / 10 * 10)).collect()),
            (
                "error_um",
                (0..1500).map(|row| 0.8 * libm::sin(TAU * mm(row) / 2.0) + noise()).collect(),
            ),
        ];
        let found = diagnosed_on(MACHINE, columns);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(!names(&found).contains(&"vibration"), "{seed}: {:?}", last(&found));
    }
}

/// At one speed an axis that turns back tells a frequency from an order, and one that does not tells none.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_vibration_is_told_where_the_axis_turns_back() {
    for seed in seeds(1, 3) {
        let shaken = |time_s: f64| 0.5 * libm::sin(TAU * 0.413 * time_s + 1.0);
        let found = there_and_back(seed, &|time_s, _, _| shaken(time_s));
        assert_eq!(names(&found), ["vibration"], "{seed}");
        let found = one_turn(TABLE, seed, 0.3, &|turn| shaken(100.0 * turn));
        assert_eq!(names(&found), Vec::<&str>::new(), "{seed}");
        assert_eq!(found.verdict, Verdict::Unexplained);
    }
}

/// The square of a screw grew; its slope, too small for this noise to tell, is what the file says, and not gone.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_changed_value_leaves_the_others_to_the_file() {
    let machine = format!(
        "{MACHINE}[[effect]]\nkind = \"screw-progressive\"\nlinear = \"0.9 um/m\"\nquadratic = \"20 um/m^2\"\n"
    );
    let mut noise = white(3, 0.3);
    let metre = |row: u16| f64::from(row) / 300.0;
    let error_um = |metre: f64| 0.9 * metre + 30.0 * metre * metre;
    let columns = vec![
        ("time_s", (0..300).map(|row| 100.0 * metre(row)).collect()),
        ("position_mm", (0..300).map(|row| 1000.0 * metre(row)).collect()),
        ("error_um", (0..300).map(|row| error_um(metre(row)) + noise()).collect()),
    ];
    let found = diagnosed_on(&machine, columns);
    let [screw] = last(&found) else { panic!("{:?}", names(&found)) };
    let told: Vec<&str> = screw.parameters.iter().map(|one| one.key.as_str()).collect();
    assert!(
        told.contains(&"linear_um_per_m") || (screw.term.values[0] - 0.9).abs() < 1e-9,
        "{screw:?}"
    );
}

/// A table that its drive moves with 40 µm of play, to and fro over some strokes, again and again; the play is carried
/// over a turn that comes before it is taken up.
fn to_and_fro(strokes_um: &[u32]) -> Diagnosis {
    const PLAY_UM: f64 = 40.0;
    let mut noise = white(5, 4.0);
    let (mut drive_um, mut table_um, mut way) = (10_000.0, 10_000.0 - 0.5 * PLAY_UM, 1.0);
    let mut columns = [const { Vec::new() }; 3];
    for stroke_um in strokes_um.iter().cycle().take(24) {
        for _ in 0..stroke_um / 2 {
            drive_um += 2.0 * way;
            table_um = f64::clamp(table_um, drive_um - 0.5 * PLAY_UM, drive_um + 0.5 * PLAY_UM);
            let time_s = 0.1 * f64::from(u32::try_from(columns[0].len()).expect("few rows"));
            let cells = [time_s, 1e-3 * drive_um, table_um - drive_um + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        way = -way;
    }
    let names = ["time_s", "position_mm", "error_um"];
    diagnosed_on(AXIS, names.into_iter().zip(columns).collect())
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn play_that_half_of_the_strokes_do_not_take_up_gets_no_width() {
    let found = to_and_fro(&[60, 80, 48, 66, 90, 52, 70]);
    assert_eq!((found.verdict, names(&found)), (Verdict::Explained, vec!["backlash"]));
    let width = &last(&found)[0].parameters[0];
    let off_um = (width.value.abs() - 40.0).abs();
    assert!(off_um < 3.0 * width.stderr.expect("an error"), "{} µm", width.value);
    let found = to_and_fro(&[90, 24, 50, 22, 110, 30, 26]);
    assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec![]));
}

/// A nut that is worn in the middle, six strokes to and fro in one pass: its play looks slow from stroke to stroke,
/// and no bow of each way leaves noise.
#[test]
fn play_that_is_larger_in_the_middle_is_no_slow_noise() {
    let mut noise = white(3, 1.0);
    let mut columns = [const { Vec::new() }; 3];
    for row in 0..210_u16 {
        let (stroke, gone) = (row / 35, f64::from(row % 35) + 0.5);
        let (way, mm) =
            if stroke % 2 == 0 { (1.0, gone / 0.35) } else { (-1.0, 100.0 - gone / 0.35) };
        let worn = libm::exp(-0.5 * ((mm - 45.0) / 15.0).powi(2));
        let cells = [f64::from(row), mm, 2.2 * way * worn + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let names = ["time_s", "position_mm", "error_um"];
    let found = diagnosed_on(AXIS, names.into_iter().zip(columns).collect());
    let shapes: Vec<&str> = found.residual.iter().map(|one| one.shape.as_str()).collect();
    assert_eq!(found.verdict, Verdict::Unexplained);
    assert!(shapes.iter().any(|shape| shape.starts_with("play that is larger")), "{shapes:?}");
}

/// A valve that is open for four seconds and shut for as long: waves in time at one, three and five times its
/// frequency, each of which would be a vibration.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_switches_at_even_times_is_no_vibrations() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 1.0);
        let mut columns =
            ["time_s", "pass", "position_mm", "error_um"].map(|name| (name, Vec::new()));
        for (row, pass) in (0..350_u32).map(|row| (row, 0.0)).chain((0..350).map(|row| (row, 1.0)))
        {
            let (begun_s, mm_a_second) = if pass > 0.0 { (70.0, 2.7) } else { (0.0, 4.0) };
            let since_s = 0.17 * f64::from(row);
            let time_s: f64 = begun_s + since_s;
            let high = if (time_s / 8.0 + 0.3).fract() < 0.5 { 0.9 } else { -0.9 };
            let row = [time_s, pass, mm_a_second * since_s, high + noise()];
            columns.iter_mut().zip(row).for_each(|((_, values), value)| values.push(value));
        }
        let found = diagnosed(columns.into());
        assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec![]), "{seed}");
        let told = found.residual.iter().any(|one| one.shape.contains("square wave in time"));
        assert!(told, "{seed}");
    }
}

/// A thrust bearing moves the table once a turn, which recorder and thread show with opposite signs: the grating and
/// the workpiece would have to do that between them.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_moves_the_table_is_no_two_waves_that_undo_each_other() {
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 1.0);
        let place = |row: u16| 1.7 * f64::from(row);
        let mut table = vec![("position_mm", (0..360).map(place).collect())];
        for (name, sign) in [("error_um", -1.0), ("lead_error_um", 1.0)] {
            let ahead = |row| libm::sin(TAU * place(row) / 8.0 + 0.3);
            table.push((name, (0..360).map(|row| sign * ahead(row) + noise()).collect()));
        }
        let problem = problem_of(diagnosed::MACHINE, table);
        let found = diagnose(&problem);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
        let along: Vec<&str> = found.residual.iter().map(|one| one.along.as_str()).collect();
        assert_eq!(along, ["motion"], "{seed}");
        let proposed = discover(&problem);
        assert_eq!(proposed.found, Found::Formula, "{seed}");
        assert!(proposed.effects.is_empty(), "{seed}");
    }
}

/// A shaft that no file lists goes 0.4 times less into the travel than the screw's second harmonic: three quarters of
/// it are that harmonic, and the rest would be a line beside it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_shaft_beside_a_harmonic_of_the_screw_is_not_that_harmonic() {
    for seed in seeds(1, 6) {
        let mut noise = white(seed, 1.0);
        let turn = |row: u16| 34.0 * f64::from(row) / 1200.0;
        let error = |turn: f64| 0.8 * libm::sin(TAU * (2.0 - 0.4 / 34.0) * turn + 1.0);
        let columns = vec![
            ("time_s", (0..1200).map(turn).collect()),
            ("position_mm", (0..1200).map(|row| 5.0 * turn(row)).collect()),
            ("error_um", (0..1200).map(|row| error(turn(row)) + noise()).collect()),
        ];
        let found = diagnosed_on(AXIS, columns);
        assert_eq!((found.verdict, names(&found)), (Verdict::Unexplained, vec![]), "{seed}");
    }
}

/// A wheel of another ratio and a drift are one curve where all passes go one way at one speed; not where they come back.
#[test]
fn a_drift_over_an_angle_is_sure_where_the_axis_comes_back() {
    const CIRCLE: &str = "output.rotary = true\nspindle.speed = '1 rpm'\n";
    let drifted = |returns: bool| {
        let mut noise = white(4, 0.3);
        let mut columns = [const { Vec::new() }; 4];
        for row in 0..400_u32 {
            let (pass, gone) = (row / 100, f64::from(row % 100) / 400.0);
            let back = returns && pass % 2 == 1;
            let turns = if back { 0.2475 - gone } else { gone };
            let time_s = 80.0 * f64::from(pass) + 60.0 * gone;
            let cells = [f64::from(pass), time_s, turns, 0.05 * time_s + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let names_of = ["pass", "time_s", "angle_rev", "error_arcsec"];
        diagnosed_on(CIRCLE, names_of.into_iter().zip(columns).collect())
    };
    let [there, both] = [false, true].map(drifted);
    assert_eq!((both.verdict, names(&both)), (Verdict::Explained, vec!["phase-drift"]));
    assert_eq!((there.verdict, names(&there)), (Verdict::Ambiguous, vec!["phase-drift"]));
}
