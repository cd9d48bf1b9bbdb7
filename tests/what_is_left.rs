//! What is left beside noise is seen, and noise is not taken for anything.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Found, Verdict, compare, diagnose, discover};

use crate::support::diagnosed::names;
use crate::support::passes::{Passes, noise, white};
use crate::support::seeds::seeds;

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn noise_at_two_speeds_and_in_two_directions_is_noise() {
    for (seed, length) in [(1, 0.1), (2, 5.0), (3, 50.0), (4, 0.1), (5, 10.0)] {
        let compared = compare(&Passes::new(&|_, _, _| 0.0, &mut noise(seed, length)).problem());
        let clearest = &compared.along[0];
        assert!(compared.noise_only, "{length}: {} {}", clearest.along, clearest.p_value);
    }
}

/// It turns its sign with the direction and fades: no two passes show the same.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_smooth_error_of_each_pass_s_own_is_not_noise() {
    let turning = |time_s: f64, position_mm: f64, direction: f64| {
        let wave = libm::cos(position_mm / 450.0 * TAU);
        1.5 * direction * (1.0 - time_s / 4000.0) * wave
    };
    let diagnosis = diagnose(&Passes::few(&turning, &mut noise(7, 5.0)).problem());
    assert_eq!(diagnosis.verdict, Verdict::Unexplained);
}

/// 366 samples of one pass with a mistake in one of them.
fn with_a_mistake(error_um: &dyn Fn(f64) -> f64, row: u16, mistake_um: f64) -> Passes {
    let mut noise = noise(4, 0.1);
    Passes::of_rows((0..366_u16).map(|at| {
        let mistake = if at == row { mistake_um } else { 0.0 };
        let error = error_um(f64::from(at) / 366.0) + noise() + mistake;
        [1.0, f64::from(at), 0.37 * f64::from(at), 1.0, error]
    }))
}

/// A joint's error hardly changes within the pass, so that it is told from nothing. One wrong digit is
/// fifty times as large, and no reason to call the rest noise.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn one_wrong_reading_is_no_all_clear() {
    let waves = [(0.9, 0.5, 1.9), (0.3, 1.6, 0.3), (0.5, 1.7, 3.8)];
    let of_a_joint = |u: f64| {
        waves.iter().map(|(size, waves, phase)| size * libm::sin(waves * TAU * u + phase)).sum()
    };
    for mistake_um in [0.0, 60.0] {
        let passes = with_a_mistake(&of_a_joint, 180, mistake_um);
        let problem = passes.problem();
        let diagnosis = diagnose(&problem);
        let told = shows(&diagnosis, "position", "smooth curve, or noise");
        assert!(told, "{mistake_um}: {:?}", diagnosis.residual);
        assert!(!compare(&problem).noise_only, "{mistake_um}");
    }
}

/// One reading before anything has settled is no step that stays.
#[test]
fn a_first_reading_apart_is_no_step() {
    let found = discover(&with_a_mistake(&|_| 0.0, 0, 3.0).problem());
    assert_eq!((found.found, found.proposals.len()), (Found::Nothing, 0));
}

/// A kink, and a step at one place of every pass: a cubic with a bump follows the one, a slip in
/// each pass the other, both to within the noise.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn plain_shapes_are_not_named_after_effects_that_imitate_them() {
    let kink = |x: f64| 0.004 * (x - 410.0).max(0.0);
    let step = |x: f64| if x < 450.25 { 0.0 } else { 1.3 };
    let shapes: [(&str, &dyn Fn(f64) -> f64); 2] = [("kink", &kink), ("step", &step)];
    for (name, shape) in shapes {
        let passes = Passes::new(&|_, x, _| shape(x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.problem());
        assert_eq!(diagnosis.verdict, Verdict::Unexplained, "{name}");
        let shapes: Vec<&str> = diagnosis.residual.iter().map(|s| s.shape.as_str()).collect();
        assert!(shapes.iter().any(|shape| shape.starts_with(name)), "{name}: {shapes:?}");
    }
}

/// True when a diagnosis is `unexplained` by a shape of these words along something.
fn shows(diagnosis: &Diagnosis, along: &str, shape: &str) -> bool {
    let told = |one: &helixlock_lab::Structure| one.along == along && one.shape.starts_with(shape);
    diagnosis.verdict == Verdict::Unexplained && diagnosis.residual.iter().any(told)
}

/// A screw's first and third harmonics follow a square wave, a headstock that warms up a
/// rise and fall, drifts of the phase and of the laser a parabola.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn shapes_of_turns_and_time_are_told_and_not_named() {
    type Shape<'a> = &'a dyn Fn(f64, f64) -> f64;
    type Record = fn(&dyn Fn(f64, f64, f64) -> f64, &mut dyn FnMut() -> f64) -> Passes;
    let square = |_: f64, x: f64| 0.1 * libm::sin(x / 12.0 * TAU + 0.3).signum();
    let risen = |t: f64, _: f64| 2.0 * t / 900.0 * libm::exp(1.0 - t / 900.0);
    let parabola = |t: f64, _: f64| 2.5 * (t / 5000.0) * (t / 5000.0);
    let shapes: [(&str, &str, Shape<'_>, Record); 3] = [
        ("machine screw angle", "square wave each turn", &square, Passes::new),
        ("time", "rise and fall", &risen, Passes::few),
        ("time", "parabola", &parabola, Passes::few),
    ];
    for (along, shape, error, record) in shapes {
        let passes = record(&|t, x, _| error(t, x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.problem());
        assert!(shows(&diagnosis, along, shape), "{shape}: {:?}", diagnosis.residual);
    }
}

/// What follows a logged column that no effect needs: through the travel, late, by a relay.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn relations_to_a_column_are_told_and_not_named() {
    type Shape<'a> = &'a dyn Fn(f64, f64) -> f64;
    let oil = |t: f64| 24.0 + libm::sin(t / 3000.0 * TAU);
    let bent = |t: f64, x: f64| x / 900.0 * (oil(t) - 24.0);
    let late = |t: f64, _: f64| 0.7 * libm::sin((t - 500.0) / 3000.0 * TAU);
    let cooled = |t: f64, _: f64| 0.4 * f64::from(u8::from(24.3 < oil(t)));
    let shapes: [(&str, Shape<'_>); 3] = [
        ("straight relation times the travel", &bent),
        ("late relation", &late),
        ("relay", &cooled),
    ];
    for (shape, error) in shapes {
        let passes = Passes::new(&|t, x, _| error(t, x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.logging("oil_c", &oil).problem());
        assert!(shows(&diagnosis, "oil_c", shape), "{shape}: {:?}", diagnosis.residual);
    }
}

/// A rack's joints, and a chipped tooth of a wheel that the file does not list.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_comes_back_at_a_distance_of_its_own_is_no_noise() {
    let joints = |x: f64| 0.3 * (x / 43.7).fract();
    let knocks = |x: f64| {
        let off = ((x / 41.0).fract() - 0.5) / 0.07;
        0.25 * libm::exp(-0.5 * off * off)
    };
    let shapes: [(&str, &dyn Fn(f64) -> f64); 2] =
        [("sawtooth", &joints), ("knocks at even distances", &knocks)];
    for (shape, error) in shapes {
        let passes = Passes::new(&|_, x, _| error(x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.problem());
        assert_eq!(diagnosis.verdict, Verdict::Unexplained, "{shape}: {:?}", diagnosis.residual);
    }
}

/// Two passes that turn back inside: where the reversal is smooth, it is one of play that is taken up over a way.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn play_that_is_taken_up_over_a_way_is_play() {
    let mut noise = noise(4, 1.0);
    let rows = (0..1200_u32).map(|row| {
        let (pass, nth) = (row / 600, f64::from(row % 600));
        let way = 1.2 * (nth - 300.0);
        let (direction, position_mm) =
            if way < 0.0 { (1.0, 360.0 + way) } else { (-1.0, 360.0 - way) };
        let gone = if way < 0.0 { 0.0 } else { libm::exp(-way / 9.0) };
        let time_s = 2000.0 * f64::from(pass) + 2.0 * nth;
        let error_um = 0.5 * direction * (1.0 - 2.0 * gone) + noise();
        [f64::from(pass + 1), time_s, position_mm, direction, error_um]
    });
    let diagnosis = diagnose(&Passes::of_rows(rows).problem());
    assert_eq!(names(&diagnosis), ["backlash"]);
    let last = &diagnosis.rounds[diagnosis.rounds.len() - 1];
    let way_mm = last.effects[0].term.nonlinear()[0];
    assert!((9.0..27.0).contains(&way_mm), "{way_mm}: as far as two of three e-folds");
}

/// Forward, back and forward at one speed, and 50 s between two passes.
fn at_one_speed(error_um: &dyn Fn(f64) -> f64) -> Passes {
    let mut noise = noise(3, 1.0);
    Passes::of_rows((0..1500_u32).map(|row| {
        let (pass, nth) = (row / 500, f64::from(row % 500));
        let forward = pass != 1;
        let time_s = f64::from(pass) * 1550.0 + 3.0 * nth;
        let position_mm = if forward { 1.8 * nth } else { 898.2 - 1.8 * nth };
        let direction = if forward { 1.0 } else { -1.0 };
        [f64::from(pass + 1), time_s, position_mm, direction, error_um(time_s) + noise()]
    }))
}

/// At one speed, a frequency in time is an order of the spindle too, until the axis turns back.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_at_one_speed_is_told_and_not_named() {
    let shaken = |t: f64| 0.15 * libm::sin(0.0731 * TAU * t);
    let there_and_back = at_one_speed(&shaken);
    assert_eq!(names(&diagnose(&there_and_back.problem())), ["vibration"]);
    let mut noise = noise(3, 1.0);
    let rows = (0..1500_u32).map(|row| {
        let time_s = 3.0 * f64::from(row);
        [1.0, time_s, 0.6 * time_s, 1.0, shaken(time_s) + noise()]
    });
    let diagnosis = diagnose(&Passes::of_rows(rows).problem());
    assert_eq!(names(&diagnosis), Vec::<&str>::new());
    assert_eq!(diagnosis.verdict, Verdict::Unexplained);
}

/// Five runs there and back to targets, over a screw of 12 mm whose error has `harmonic` waves a
/// turn; the names found.
fn at_targets(targets_mm: &[f64], harmonic: f64) -> Vec<String> {
    let mut noise = noise(3, 1.0);
    let rows = (0..10_u32).flat_map(|run| {
        let there = (0..targets_mm.len()).map(move |nth| {
            let back = run % 2 == 1;
            if back { (-1.0, targets_mm.len() - 1 - nth) } else { (1.0, nth) }
        });
        there.map(move |(direction, place)| (run, direction, place))
    });
    let rows = rows.enumerate().map(|(row, (run, direction, place))| {
        let position_mm = targets_mm[place];
        let error = 0.4 * libm::sin(harmonic * position_mm / 12.0 * TAU) + noise();
        let time_s = 10.0 * f64::from(u32::try_from(row).expect("few rows"));
        [f64::from(run / 2 + 1), time_s, position_mm, direction, error]
    });
    let diagnosis = diagnose(&Passes::of_rows(rows).problem());
    let last = &diagnosis.rounds[diagnosis.rounds.len() - 1];
    last.effects.iter().map(|effect| effect.name.clone()).collect()
}

/// Targets 25 mm apart: a screw of 12 mm cannot be seen there.
#[test]
fn targets_name_no_wave_shorter_than_two_of_their_distances() {
    let even: Vec<f64> = (0..21).map(|place| 25.0 * f64::from(place)).collect();
    assert!(at_targets(&even, 1.0).iter().all(|name| name != "screw-periodic"));
}

/// Targets up to 10 mm off those places tell even three waves a turn from all that is slower; two
/// would be a wave of the spindle too.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn uneven_targets_name_waves_far_shorter_than_their_distances() {
    let place = |place: u32| 25.0 * f64::from(place) + f64::from(place * place * 13 % 41) - 20.0;
    let uneven: Vec<f64> = (1..=41).map(|nth| place(nth) * 0.5 + 12.5 * f64::from(nth)).collect();
    for harmonic in [1.0, 3.0] {
        assert_eq!(at_targets(&uneven, harmonic), ["screw-periodic"], "{harmonic} waves a turn");
    }
}

/// A stage that rests in either of two places: slow noise would follow it, but for its steps.
#[test]
fn two_levels_at_odd_moments_are_no_noise() {
    for seed in seeds(1, 3).map(|nth| 11 + nth) {
        let mut noise = white(seed, 0.05);
        let rows = (0..400_u16).map(|row| {
            let t = 4.5 * f64::from(row);
            let phase = t / 130.0 + 1.7 * libm::sin(t / 211.0) + 0.9 * libm::sin(t / 67.0);
            let level = if libm::sin(phase * TAU) < 0.2 { 0.0 } else { 0.8 };
            [0.0, t, 0.8 * f64::from(row), 1.0, level + noise()]
        });
        let found = diagnose(&Passes::of_rows(rows).problem());
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", found.residual);
    }
}

/// A wave in noise of five rows' length is known as well as it is told to be: noise that is fitted with
/// the wave inside is larger just there, and its errors were told twice as large.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_line_under_slow_noise_is_as_sure_as_it_is_told() {
    let (order, size) = (1.7, 0.1);
    let asked = seeds(16, 40);
    let records = f64::from(u8::try_from(asked.end).expect("few"));
    let squares = asked.map(|seed| {
        let mut new = white(seed, 0.05);
        let mut slow = 0.0;
        let mut noise = || {
            slow = libm::exp(-0.2) * slow + 0.57 * new();
            slow
        };
        let rows = (0..800_u16).map(|row| {
            let x = f64::from(row % 400);
            let wave = size * libm::sin(TAU * order * x / 6.0);
            [f64::from(row / 400), f64::from(row), x, 1.0, wave + noise()]
        });
        let found = compare(&Passes::of_rows(rows).problem());
        let line = &found.lines.first().expect("a line").line;
        let off = [
            (line.frequency - order) / line.frequency_stderr,
            (line.amplitude - size) / line.amplitude_stderr,
        ];
        off.map(|off| off * off)
    });
    let sums = squares.fold([0.0; 2], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
    for square in sums.map(|sum| sum / records) {
        assert!((0.5..1.7).contains(&square), "{square}");
    }
}
