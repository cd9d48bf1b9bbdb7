//! Causes that slow noise would swallow, and effects that only undo each other.

use helixlock_lab::{Diagnosis, Verdict};
use helixlock_plant::machine::Air;

use crate::support::diagnosed::{diagnosed, diagnosed_on, is_nobodys, names};
use crate::support::passes::{MACHINE, white};
use crate::support::seeds::seeds;

/// Six passes forward of 200 rows over 600 mm: noise of 0.2 µm and an error, µm, of pass and place, mm.
fn six_passes(seed: u64, error_um: &dyn Fn(usize, f64) -> f64) -> Diagnosis {
    six_passes_at(seed, &|_, row| 3.0 * row, error_um)
}

/// The same with rows at other places, mm, by pass and number.
fn six_passes_at(
    seed: u64,
    place_mm: &dyn Fn(usize, f64) -> f64,
    error_um: &dyn Fn(usize, f64) -> f64,
) -> Diagnosis {
    let mut noise = white(seed, 0.2);
    let mut columns = [const { Vec::new() }; 4];
    for (nth, pass) in (0..6).zip([0.0, 1.0, 2.0, 3.0, 4.0, 5.0]) {
        for row in 0..200 {
            let mm = place_mm(nth, f64::from(row));
            let cells = [pass, 40.0 * pass + mm / 20.0, mm, error_um(nth, mm) + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
    }
    let titles = ["pass", "time_s", "position_mm", "error_um"];
    diagnosed(titles.into_iter().zip(columns).collect())
}

/// Where each pass begins, mm: no place is met twice, as targets are.
const OFF_MM: [f64; 6] = [0.0, 0.4, 0.9, 0.2, 0.7, 1.1];

/// One pass of 300 rows at 2 mm: the error is of the row's place, mm.
fn one_pass(seed: u64, error_um: &dyn Fn(f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 0.2);
    let mut columns = [const { Vec::new() }; 3];
    for row in 0..300 {
        let mm = 2.0 * f64::from(row);
        let cells = [mm / 20.0, mm, error_um(mm) + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    diagnosed(["time_s", "position_mm", "error_um"].into_iter().zip(columns).collect())
}

/// Two worn places of opposite signs in one pass: slow noise takes up either while the other is missing, but none
/// that forgets is as smooth.
#[test]
fn two_places_of_opposite_signs_are_no_slow_noise() {
    let bell = |off: f64| libm::exp(-0.5 * off * off);
    for seed in seeds(2, 8) {
        let found =
            one_pass(seed, &|mm| 0.8 * (bell((mm - 180.0) / 30.0) - bell((mm - 420.0) / 30.0)));
        assert_ne!(found.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// A bed that is warmed from one side bends between its ends while six passes go over it: that is no lead of the
/// screw.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_bow_that_comes_in_time_is_no_screw() {
    is_nobodys(|seed| {
        six_passes(seed, &|pass, mm| {
            let time_s = 40.0 * f64::from(u8::try_from(pass).expect("few")) + mm / 20.0;
            let part = mm / 597.0;
            1.7 * part * (1.0 - part) * (1.0 - libm::exp(-time_s / 80.0))
        })
    });
}

/// A spindle that warms up and a fringe lost in one pass: slow noise takes up either while the other is missing.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn two_effects_are_found_at_once() {
    let both = |seed: &u64| {
        let mut noise = white(*seed, 0.12);
        let mut columns = [const { Vec::new() }; 3];
        for row in 0..700 {
            let time_s = 1.07 * f64::from(row);
            let lost_um = if 400.0 < time_s { 0.5 * 0.632_819_83 } else { 0.0 };
            let error_um = 0.8 * (1.0 - libm::exp(-time_s / 150.0)) - lost_um + noise();
            let cells = [time_s, time_s / 1.5, error_um];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["time_s", "position_mm", "error_um"];
        let found = diagnosed(titles.into_iter().zip(columns).collect());
        let mut names = names(&found);
        names.sort_unstable();
        names == ["fringe-slip", "headstock-growth"]
    };
    let asked = seeds(1, 5);
    let all = asked.end;
    let found = asked.filter(both).count() as u64;
    assert!(2 * all <= 5 * found, "{found} of {all}");
}

/// A table whose disc sits off its axis, and its play, in one pass there and back: noise so slow that the pass is
/// worth four samples takes up either while the other is missing.
#[test]
fn two_effects_are_found_in_one_pass_there_and_back() {
    const TABLE: &str = "[output]\nrotary = true\n[spindle]\nspeed = \"0.6 rpm\"\n[grating]\nlines = 18000\ndiameter = \"120 mm\"\n";
    for seed in seeds(1, 5) {
        let mut noise = white(seed, 1.2);
        let mut columns = [const { Vec::new() }; 4];
        for row in 0..430 {
            let way = if row < 215 { 1.0 } else { -1.0 };
            let turn = 0.5 + way * (f64::from(row) - 214.5) / 215.0;
            let of_disc = libm::sin(std::f64::consts::TAU * turn + 0.6);
            let error = of_disc - 0.7 * way + noise();
            let cells = [0.457 * f64::from(row), turn, way, error];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["time_s", "angle_rev", "direction", "error_arcsec"];
        let found = diagnosed_on(TABLE, titles.into_iter().zip(columns).collect());
        let mut names = names(&found);
        names.sort_unstable();
        assert_eq!(names, ["backlash", "grating-eccentricity"], "{seed}");
    }
}

/// Once round an encoder whose disc is off, tilted and squeezed: each wave alone leaves the others to slow noise,
/// and so do two of them.
#[test]
fn three_waves_of_one_turn_are_found_at_once() {
    const ENCODER: &str = "output.rotary = true\nspindle.speed = \"60 rpm\"\n\
                           grating = { lines = 4096, diameter = \"6 mm\" }\n";
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 40.0);
        let turn = |row: u16| f64::from(row) / 1024.0;
        let wave =
            |order: f64, turn: f64, phase| libm::sin(std::f64::consts::TAU * order * turn + phase);
        let error = |turn| {
            404.0 * wave(1.0, turn, 0.3)
                + 429.0 * wave(2.0, turn, 1.9)
                + 214.0 * wave(4.0, turn, -1.0)
        };
        let columns = vec![
            ("angle_rev", (0..1024).map(turn).collect()),
            ("error_arcsec", (0..1024).map(|row| error(turn(row)) + noise()).collect()),
        ];
        let found = diagnosed_on(ENCODER, columns);
        let mut names = names(&found);
        names.sort_unstable();
        assert_eq!(
            names,
            ["grating-eccentricity", "grating-graduation", "grating-graduation"],
            "{seed}"
        );
    }
}

/// One hump of a turn is a hump: three whole waves would only begin to draw it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_hump_of_a_turn_is_not_its_harmonics() {
    const ENCODER: &str =
        "output.rotary = true\nspindle.speed = \"10 rpm\"\ngrating.lines = 1024\n";
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 1.6);
        let turn = |row: u16| f64::from(row) / 2048.0;
        let hump = |turn: f64| 40.0 * libm::exp(-0.5 * ((turn - 0.355) / 0.076).powi(2));
        let columns = vec![
            ("angle_rev", (0..2048).map(turn).collect()),
            ("error_arcsec", (0..2048).map(|row| hump(turn(row)) + noise()).collect()),
        ];
        let found = diagnosed_on(ENCODER, columns);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}

/// True when something is left of which these words are said.
fn tells(found: &Diagnosis, words: &str) -> bool {
    found.residual.iter().any(|one| one.shape.contains(words))
}

/// A chip that lies under the table from the fourth pass on: a bump of 25 standard errors in three of
/// six passes, which noise of each pass's own would follow another way.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_half_of_the_passes_share_is_no_noise() {
    let bump = |mm: f64| libm::exp(-0.5 * ((mm - 250.0) / 25.0) * ((mm - 250.0) / 25.0));
    for seed in seeds(1, 4) {
        let later = six_passes(seed, &|pass, mm| if pass < 3 { 0.0 } else { 0.8 * bump(mm) });
        assert_eq!(later.verdict, Verdict::Unexplained, "{seed}");
        let by_turns = six_passes(seed, &|pass, mm| {
            let size = if pass % 2 == 0 { 0.5 } else { -0.5 };
            size * bump(mm)
        });
        assert_eq!(by_turns.verdict, Verdict::Unexplained, "{seed}");
    }
}

/// Noise as slow as a quarter of a pass, another in each.
#[test]
fn slow_noise_of_each_pass_has_nothing_in_common() {
    for seed in seeds(1, 4) {
        let mut fresh = white(seed + 20, 0.1);
        let slow: Vec<Vec<f64>> = (0..6)
            .map(|_| {
                let mut value = 0.0;
                let mut next = || {
                    value = 0.98 * value + fresh();
                    value
                };
                (0..200).map(|_| next()).collect()
            })
            .collect();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few hundred"
        )]
        let found = six_passes(seed, &|pass, mm| slow[pass][(mm / 3.0) as usize]);
        assert!(names(&found).is_empty(), "{seed}");
        let shapes: Vec<&str> = found.residual.iter().map(|one| one.shape.as_str()).collect();
        assert!(shapes.iter().all(|shape| !shape.contains("in common")), "{seed}: {shapes:?}");
    }
}

/// Humps of five deviations and eight rows that come and go, at other places in every pass.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn humps_of_no_place_are_no_slow_noise() {
    for seed in seeds(1, 4) {
        let found = six_passes(seed, &|pass, mm| {
            let nth = libm::floor(mm / 67.0);
            let lies = 67.0 * nth
                + 20.0
                + 27.0 * (1.0 + libm::sin(7.0 * nth + [0.3, 1.9, 4.1, 2.2, 5.3, 0.9][pass]));
            libm::exp(-0.5 * ((mm - lies) / 6.0) * ((mm - lies) / 6.0))
        });
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "humps, levels or teeth, more regular than noise"), "{seed}");
    }
}

/// Coolant that goes on and off as the operator likes, six deviations of noise apart: noise as slow as that
/// comes to any value between.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_switches_between_two_levels_is_no_slow_noise() {
    // At no phase that a clock would give each pass.
    let is_on = |pass: usize, mm: f64| {
        let turn = [0.3, 5.1, 2.2, 0.9, 3.9, 4.7][pass];
        0.0 < libm::sin(mm / 9.0 + 2.5 * libm::sin(mm / 47.0 + turn) + turn)
    };
    for seed in seeds(1, 4) {
        let found = six_passes(seed, &|pass, mm| if is_on(pass, mm) { 1.2 } else { 0.0 });
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "switches between levels"), "{seed}: {:?}", found.residual);
    }
}

/// A pump that speeds up in every pass, from another angle each time: no line, and no narrow band.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_swings_at_no_one_frequency_is_no_noise() {
    for seed in seeds(1, 4) {
        let found = six_passes(seed, &|pass, mm| {
            let (row, turn) = (mm / 3.0, f64::from(u8::try_from(pass).expect("six")));
            0.35 * libm::sin(1.9 * turn + 0.9 * row + 0.003 * row * row)
        });
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "swings there and back"), "{seed}: {:?}", found.residual);
    }
}

/// From ten waves a record to nearly sixty, through all six passes.
#[test]
fn waves_whose_frequency_changes_evenly_are_no_noise() {
    let speeding_up = |nth: usize, mm: f64| {
        let gone_by = ([0.0, 1.0, 2.0, 3.0, 4.0, 5.0][nth] + mm / 800.0) / 6.0;
        0.13 * libm::sin(std::f64::consts::TAU * (10.0 + 24.0 * gone_by) * gone_by)
    };
    for seed in seeds(1, 4) {
        let found = six_passes_at(seed, &|nth, row| OFF_MM[nth] + 3.0 * row, &speeding_up);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "frequency changes evenly"), "{seed}: {:?}", found.residual);
    }
}

/// Chatter over 70 mm of 600, in each pass from another phase: of the whole it is a hundredth.
#[test]
fn waves_in_one_stretch_are_no_noise() {
    let chatter = |nth: usize, mm: f64| {
        let turn = [0.3, 2.1, 4.4, 1.2, 5.6, 3.3][nth];
        if (250.0..320.0).contains(&mm) { 0.45 * libm::sin(0.31 * mm + turn) } else { 0.0 }
    };
    for seed in seeds(1, 4) {
        let found = six_passes(seed, &chatter);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "waves in one stretch"), "{seed}: {:?}", found.residual.len());
    }
}

/// Three days in one pass, a hall that warms by noon: noise of three waves' slowness draws it.
#[test]
fn what_comes_back_each_day_is_no_slow_noise() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 0.4);
        let mut columns = [const { Vec::new() }; 3];
        for row in 0..360 {
            let time_s = 720.0 * f64::from(row);
            let noon = libm::sin(std::f64::consts::TAU * time_s / 86_400.0).max(0.0);
            let cells = [time_s, f64::from(row), 1.6 * noon + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["time_s", "position_mm", "error_um"];
        let found = diagnosed(titles.into_iter().zip(columns).collect());
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "repeats each day"), "{seed}: {:?}", found.residual.len());
    }
}

/// Samples that a scratch lifts by forty deviations, one in eleven: an outlier weighs little, but these
/// all stand at one angle. As many at any angle are bad readings.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_scratch_of_the_grating_is_no_bad_reading() {
    let phase = |turns: f64| turns - libm::floor(turns);
    let places = |pass: usize, row: f64| 1.3 * row + OFF_MM[pass];
    for seed in seeds(1, 4) {
        let notch = |_: usize, mm: f64| if phase(mm / 6.0) < 0.09 { 8.0 } else { 0.0 };
        let scratch = six_passes_at(seed, &places, &notch);
        assert_eq!(scratch.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&scratch, "at one angle"), "{seed}");
        let lot = |mm: f64| phase(43.7 * libm::sin(12.9 * mm));
        let knock = |_: usize, mm: f64| if lot(mm) < 0.03 { 8.0 } else { 0.0 };
        let bad = six_passes_at(seed, &places, &knock);
        assert_eq!(bad.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// A burst of swing in every pass, of forty deviations from sample to sample and nothing on the mean.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_burst_of_swing_is_no_bad_reading() {
    let places = |pass: usize, row: f64| 3.0 * row + OFF_MM[pass];
    for seed in seeds(1, 4) {
        let found = six_passes_at(seed, &places, &|pass, mm| {
            let off = (mm - [250.0, 262.0, 241.0, 255.0, 238.0, 259.0][pass]) / 15.0;
            8.0 * libm::sin(1.9 * mm) * libm::exp(-0.5 * off * off)
        });
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(tells(&found, "several together"), "{seed}");
    }
}

/// A drift of eleven standard errors in one long pass: the noise is slow only without it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_drift_is_no_slow_noise() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 3.0);
        let mut columns = [const { Vec::new() }; 4];
        for row in 0..1200 {
            let hours = f64::from(row) / 800.0;
            let cells = [1.0, 3600.0 * hours, f64::from(row % 150), 2.5 * hours + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(MACHINE, titles.into_iter().zip(columns).collect());
        assert_ne!(found.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// A wheel that runs in and out, at both ends of a thread: a bow of the screw and the sag of a bed, each a
/// hundred times as large, would leave nearly as much.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn effects_that_undo_each_other_are_not_named_together() {
    for seed in seeds(1, 4) {
        let mut noise = white(seed, 0.28);
        let mut columns = [const { Vec::new() }; 4];
        for (pass, row) in
            [0.0, 1.0, 2.0, 3.0].into_iter().flat_map(|pass| (0..300).map(move |row| (pass, row)))
        {
            let mm = 500.0 * f64::from(row) / 299.0;
            let ends = libm::exp(-mm / 18.0) - libm::exp(-(500.0 - mm) / 18.0);
            let cells = [pass, 900.0 * pass + mm / 0.6, mm, 0.8 * ends + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "lead_error_um"];
        let found = diagnosed(titles.into_iter().zip(columns).collect());
        let named = names(&found);
        assert!(!named.contains(&"steady-sag"), "{seed}: {named:?}");
    }
}

/// Play of twice the noise there and back, and a drift of twelve standard errors: noise so slow that a pass
/// is worth two samples is as probable as a drift beside noise that is white.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_drift_beside_play_is_not_called_noise() {
    for seed in seeds(2, 6) {
        let mut noise = white(seed, 0.06);
        let names_of = ["pass", "time_s", "position_mm", "direction", "error_um"];
        let mut columns = names_of.map(|name| (name, Vec::new()));
        for (number, (stroke, row)) in
            (0..6_u8).flat_map(|stroke| (0..100_u8).map(move |row| (stroke, row))).enumerate()
        {
            let way = if stroke % 2 == 0 { 1.0 } else { -1.0 };
            let mm = 150.0 + way * (3.0 * f64::from(row) - 148.5);
            let time_s = 5.0 * f64::from(u16::try_from(number).expect("600 rows"));
            let error = 0.12 * time_s / 3600.0 - 0.06 * way + noise();
            let cells = [1.0, time_s, mm, way, error];
            columns.iter_mut().zip(cells).for_each(|((_, column), cell)| column.push(cell));
        }
        let found = diagnosed(columns.into());
        assert!(names(&found).contains(&"backlash"), "{seed}: {:?}", names(&found));
        let told = names(&found).len() == 2 || found.verdict == Verdict::Unexplained;
        assert!(told, "{seed}: {:?}", names(&found));
    }
}

/// What is known of the pauses between passes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Clock {
    None,
    /// It begins anew with every pass.
    OfPasses,
    Through,
}

/// A headstock that warms up through four passes a quarter of an hour apart: where no clock ran through them they seem
/// to follow each other, or to begin at once.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn no_drift_runs_on_through_pauses_that_nobody_logged() {
    let clocks = [Clock::None, Clock::OfPasses, Clock::Through];
    for (seed, clock) in seeds(1, 5).flat_map(|seed| clocks.map(|clock| (seed, clock))) {
        let mut noise = white(seed, 0.1);
        let mut columns = [const { Vec::new() }; 4];
        for pass in [0.0, 1.0, 2.0, 3.0] {
            for row in 0..150 {
                let mm = 4.0 * f64::from(row);
                let time_s = 900.0 * pass + mm / 4.0;
                let grown_um = 3.0 * (1.0 - libm::exp(-time_s / 1500.0));
                let shown_s = if clock == Clock::Through { time_s } else { mm / 4.0 };
                let cells = [pass, mm, grown_um + noise(), shown_s];
                columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
            }
        }
        let titles = ["pass", "position_mm", "error_um", "time_s"].into_iter().zip(columns);
        let found = diagnosed(titles.take(if clock == Clock::None { 3 } else { 4 }).collect());
        let is_named = names(&found) == ["headstock-growth"];
        assert_eq!(is_named, clock == Clock::Through, "{seed}, {clock:?}: {:?}", names(&found));
        assert_ne!(found.verdict, Verdict::NothingMissing, "{seed}, {clock:?}");
    }
}

/// A laser in the mountains, whose file knows all of its air: a kelvin is less there than at the sea.
#[test]
fn thin_air_is_no_error_of_the_air() {
    const IN_AIR: &str = "spindle.speed = \"30 rpm\"\nworkpiece.lead = \"8 mm\"\n\
                          lead_screw.lead = \"8 mm\"\nlaser.wavelength = \"0.63281983 um\"\n\
                          [[effect]]\nkind = \"air-temperature\"\n\
                          [[effect]]\nkind = \"air-pressure\"\n";
    let index = |temperature_c, pressure_hpa| {
        helixlock_plant::air::edlen(
            0.632_819_83,
            &Air { temperature_c, pressure_hpa, humidity_pct: 50.0 },
        )
    };
    let reference = index(20.0, 1013.25);
    for (seed, sea_hpa) in seeds(1, 4).flat_map(|seed| [(seed, 780.0), (seed, 970.0)]) {
        let mut noise = white(seed, 0.05);
        let mut columns = [const { Vec::new() }; 5];
        for row in 0..400 {
            let (time_s, mm) = (60.0 * f64::from(row), 3.0 * f64::from(row));
            let air_c = 22.0 + 1.5 * libm::sin(time_s / 3000.0);
            let air_hpa = sea_hpa + 4.0 * libm::sin(time_s / 7000.0);
            let short_um = 1e3 * mm * (reference - index(air_c, air_hpa)) / reference;
            let cells = [time_s, mm, air_c, air_hpa, short_um + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["time_s", "position_mm", "air_temperature_c", "air_pressure_hpa", "error_um"];
        let found = diagnosed_on(IN_AIR, titles.into_iter().zip(columns).collect());
        assert_eq!(found.verdict, Verdict::NothingMissing, "{seed}: {sea_hpa} hPa");
    }
}
