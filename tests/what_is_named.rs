//! Effects are named where the data hold them, whatever lies beside them, and not otherwise.

use std::f64::consts::TAU;

use helixlock_lab::{Verdict, diagnose};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StudentT};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::{Passes, noise, white};
use crate::support::seeds::cases;

/// Half the wavelength of the machine's laser.
const FRINGE_UM: f64 = 0.316_410_182_654_969;

/// Slow noise of 0.1 µm with heavy tails (Student's law of three degrees of freedom).
fn heavy_noise(seed: u64, kept: f64) -> impl FnMut() -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let law = StudentT::new(3.0).expect("three degrees of freedom");
    let mut slow = 0.0;
    move || {
        slow = kept * slow + (1.0 - kept * kept).sqrt() * law.sample(&mut chance) / f64::sqrt(3.0);
        0.1 * slow
    }
}

/// A heavy sample of slow noise looks like a slip for a while; in Gaussian noise, what these
/// records hold would be beyond doubt.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn heavy_tails_of_slow_noise_are_no_slips() {
    for seed in cases(1, &[4, 25, 37]) {
        let passes = Passes::new(&|_, _, _| 0.0, &mut heavy_noise(*seed, 0.98));
        let found = diagnose(&passes.problem());
        assert!(names(&found).is_empty(), "seed {seed}: {:?}", names(&found));
    }
}

/// One fringe lost between two samples, in noise that swings as far and forgets over 50 samples:
/// a few samples beside its place, nothing of it is to be seen.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_slip_in_slow_noise_is_found_at_its_sample() {
    for &lost_at in cases(1, &[2601.0, 211.0]) {
        let slipped = |t: f64, _: f64, _: f64| if t < lost_at { 0.0 } else { FRINGE_UM };
        let mut chance = ChaCha8Rng::seed_from_u64(3);
        let mut slow = 0.0;
        let mut noise = || {
            let fresh: f64 = StandardNormal.sample(&mut chance);
            slow = 0.98 * slow + 0.04 * fresh;
            slow
        };
        let diagnosis = diagnose(&Passes::new(&slipped, &mut noise).problem());
        assert_eq!(names(&diagnosis), ["fringe-slip"], "at {lost_at} s");
        let slip = &diagnosis.rounds[diagnosis.rounds.len() - 1].effects;
        let value = |key: &str| slip[0].parameters.iter().find(|p| p.key == key).unwrap().value;
        assert!((value("count").abs() - 1.0).abs() < 0.01);
        assert!((value("time_s") - lost_at).abs() < 2.5, "{} for {lost_at} s", value("time_s"));
    }
}

/// A step of no whole number of fringes or lines, once and for good: a slip and a hop of the
/// laser make it together, but so would anything.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_step_of_any_size_is_no_slip() {
    for &(size_um, moment_s) in cases(1, &[(0.52, 700.0), (1.15, 4400.0)]) {
        let step = |t: f64, _: f64, _: f64| if t < moment_s { 0.0 } else { size_um };
        let diagnosis = diagnose(&Passes::new(&step, &mut noise(11, 1.0)).problem());
        assert_eq!(diagnosis.verdict, Verdict::Unexplained, "{:?}", names(&diagnosis));
    }
}

/// A machine that stands twelve fringes off for the first five rows of a pass pulls in; for the first
/// fifty it has lost them.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_pass_that_begins_elsewhere_has_lost_no_fringe() {
    for (rows, named) in [(5.0, &[][..]), (50.0, &["fringe-slip"][..])] {
        let late = |t: f64, _: f64, _: f64| if t < 2.5 * rows { 12.0 * FRINGE_UM } else { 0.0 };
        let found = diagnose(&Passes::new(&late, &mut noise(5, 1.0)).problem());
        assert_eq!(names(&found), named, "{rows} rows");
        assert_ne!(found.verdict, Verdict::NothingMissing);
    }
}

/// Slow and large by itself, what no effect explains is no noise for the gear.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_gear_is_found_under_a_slow_error_ten_times_its_size() {
    let error = |t: f64, x: f64, direction: f64| {
        let slow = 4.0 * direction * (1.0 - t / 4000.0) * libm::cos(x / 450.0 * TAU);
        0.2 * libm::sin(TAU * 2.3 * x / 6.0) + slow
    };
    let diagnosis = diagnose(&Passes::new(&error, &mut noise(12, 1.0)).problem());
    assert!(names(&diagnosis).contains(&"gear-error"), "{:?}", names(&diagnosis));
}

/// A guide that tilts by nearly as much as it goes on, met by an arm, and a slope: the two have a number less
/// than the cubic of a screw, and draw the same.
#[test]
fn a_tilted_guide_beside_a_slope_is_a_rival_of_a_cubic() {
    let mut noise = white(6, 0.05);
    let mm: Vec<f64> = (0..480).map(|row| 1.3 * f64::from(row)).collect();
    let tilt = |mm: f64| 1.5 * libm::sin(mm / 420.0) - 0.4;
    let error = mm.iter().map(|&mm| tilt(mm) - 0.002 * mm + noise());
    let found = diagnosed(vec![
        ("error_um", error.collect()),
        ("bed_pitch_arcsec", mm.iter().map(|mm| tilt(*mm)).collect()),
        ("position_mm", mm.clone()),
    ]);
    assert_ne!(found.verdict, Verdict::Explained, "{:?}", names(&found));
    let rivals = found.candidates.iter().filter(|one| one.accepted);
    let told = |name: &String| name == "abbe";
    assert!(rivals.flat_map(|one| &one.confounded_with).any(told), "{:?}", found.candidates);
}

/// A slope over two passes on a day that grows warmer: a hop of the laser has three numbers, and draws roughly what
/// the slope and the air draw with one.
#[test]
fn two_effects_of_few_numbers_stand_before_one_that_bends() {
    let mut noise = white(0, 0.05);
    let mut columns = [const { Vec::new() }; 5];
    for row in 0..400_u16 {
        let (pass, nth) = (f64::from(row / 200), f64::from(row % 200));
        let mm = 3.0 * (nth + 0.5);
        let time_s = 400.0 * pass + mm / 4.0;
        let air_c = 20.0 + 0.6 * pass + 0.8 * libm::sin(time_s / 300.0);
        let error_um = 0.93e-3 * (air_c - 20.0) * mm + 1.2e-3 * mm + noise();
        let cells = [pass, time_s, mm, air_c, error_um];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let heads = ["pass", "time_s", "position_mm", "air_temperature_c", "error_um"];
    let found = diagnosed(heads.into_iter().zip(columns).collect());
    assert_eq!(found.verdict, Verdict::Ambiguous, "{:?}", names(&found));
    assert!(names(&found).contains(&"air-temperature"), "{:?}", names(&found));
}

/// Whole waves of a turn come in numbers: a resolver shows six of its own and more.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn five_waves_of_a_turn_are_five_names() {
    let waves =
        [(1.0, 1.0, 0.3), (3.0, 0.7, 2.0), (5.0, 0.5, -1.1), (7.0, 0.35, 0.9), (9.0, 0.25, 2.8)];
    let mut noise = noise(7, 0.5);
    let rows = (0..700_u16).map(|row| {
        let x = 0.37 * f64::from(row);
        let sum: f64 =
            waves.iter().map(|(k, size, phase)| size * libm::sin(TAU * k * x / 12.0 + phase)).sum();
        [1.0, x, x, 1.0, sum + noise()]
    });
    let found = diagnose(&Passes::of_rows(rows).problem());
    assert_eq!(names(&found), ["screw-periodic"; 5]);
}

/// A slope speaks through all samples a little, through none of them alone.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_slope_in_slow_noise_is_found() {
    let over_travel = |_: f64, x: f64, _: f64| 0.8 * x / 900.0;
    let over_time = |t: f64, _: f64, _: f64| 1.6 * t / 5000.0;
    let slopes: [&dyn Fn(f64, f64, f64) -> f64; 2] = [&over_travel, &over_time];
    for (name, slope) in ["cosine", "phase-drift"].into_iter().zip(slopes) {
        let diagnosis = diagnose(&Passes::new(slope, &mut noise(1, 4.0)).problem());
        assert_eq!(names(&diagnosis), [name]);
    }
}

/// A motor of 31.7 Hz, seen at some of the comparisons of 6 and of 8.22 turns a minute: each speed
/// alone shows one of its aliases.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn shaking_far_above_the_comparisons_is_unfolded_by_two_speeds() {
    let mut noise = noise(3, 1.0);
    // Comparisons a second: 13906 lines over a = 110, at 6 rpm.
    let rate_hz = |pass: u32| 13906.0 / 110.0 / 10.0 * if pass == 0 { 1.0 } else { 1.37 };
    let rows = (0..1600_u32).map(|row| {
        let (pass, nth) = (row / 800, row % 800);
        // Every 13th comparison, and the one before or after it.
        let comparison = f64::from(13 * nth + nth * nth % 3);
        let time_s = f64::from(pass) * 1000.0 + comparison / rate_hz(pass);
        let travel_mm = comparison / (13906.0 / 110.0) * 6.0;
        let (position_mm, direction) =
            if pass == 0 { (travel_mm, 1.0) } else { (500.0 - travel_mm, -1.0) };
        let error = 0.1 * libm::sin(31.7 * TAU * time_s) + noise();
        [f64::from(pass + 1), time_s, position_mm, direction, error]
    });
    let speed = |time_s: f64| if time_s < 1000.0 { 6.0 } else { 8.22 };
    let diagnosis = diagnose(&Passes::of_rows(rows).logging("speed_rpm", &speed).problem());
    assert_eq!(names(&diagnosis), ["vibration"]);
    let effects = &diagnosis.rounds[diagnosis.rounds.len() - 1].effects;
    let frequency = effects[0].parameters.iter().find(|p| p.key == "frequency_hz").unwrap();
    assert!((frequency.value - 31.7).abs() < 1e-3, "{}", frequency.value);
}

/// Every second reading is twenty times as uncertain, and the file says so: what it says weighs.
///
/// The best that can be had of a wave of known length in N rows of σ is σ·√(2/N); the uncertain
/// rows add next to nothing.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_the_file_tells_of_its_readings_weighs() {
    const SURE_UM: f64 = 0.02;
    const SIZE_UM: f64 = 0.1;
    let told = |time_s: f64| SURE_UM * if time_s % 2.0 < 1.0 { 1.0 } else { 20.0 };
    let best_um = SURE_UM * f64::sqrt(2.0 / 900.0);
    for seed in 20..23 {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let rows: Vec<[f64; 5]> = (0..1800_u16)
            .map(|row| {
                let (time_s, x) = (f64::from(row), 0.37 * f64::from(row));
                let fresh: f64 = StandardNormal.sample(&mut chance);
                let wave = SIZE_UM * libm::sin(TAU * x / 12.0 + 0.7);
                [1.0, time_s, x, 1.0, wave + told(time_s) * fresh]
            })
            .collect();
        let passes = Passes::of_rows(rows.into_iter()).logging("error_um_sd", &told);
        let diagnosis = diagnose(&passes.problem());
        assert_eq!(names(&diagnosis), ["screw-periodic"], "seed {seed}");
        let wave = &diagnosis.rounds[diagnosis.rounds.len() - 1].effects[0];
        let size = wave.parameters.iter().find(|what| what.key == "amplitude_um").unwrap();
        let stderr = size.stderr.expect("a standard error");
        assert!((0.8..1.25).contains(&(stderr / best_um)), "seed {seed}: {stderr}, best {best_um}");
        assert!((size.value - SIZE_UM).abs() < 4.0 * best_um, "seed {seed}: {}", size.value);
    }
}

/// A slit whose resolver has four poles, 20 µm and an overtone over eight turns, and what `more` adds.
fn resolver(seed: u64, more: impl Fn(f64) -> f64) -> helixlock_lab::Diagnosis {
    const SLIT: &str = r#"
spindle.speed = "15 rpm"
lead_screw.lead = "1 mm"
gear = [{ name = "resolver", order = 1, teeth = 4 }]
"#;
    let mut noise = white(seed, 0.05);
    let mut columns = ["time_s", "position_mm", "error_um"].map(|name| (name, Vec::new()));
    for turns in (0..600_u16).map(|row| f64::from(row) / 75.0) {
        let poles = 20.0 * libm::sin(TAU * 4.0 * turns + 0.3);
        let overtone = 1.5 * libm::sin(TAU * 8.0 * turns + 1.0);
        let row = [4.0 * turns, turns, poles + overtone + more(turns) + noise()];
        columns.iter_mut().zip(row).for_each(|((_, values), value)| values.push(value));
    }
    diagnosed_on(SLIT, columns.into())
}

/// A knock of a hundredth once a turn, or a size that grows by a hundredth: neither made the wave, though what
/// knocks each turn can draw it, and a wave that grows is more probable than one that does not.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_large_wave_keeps_its_name_beside_what_hardly_differs() {
    let knock = |turns: f64| if turns.fract() < 0.06 { 0.3 } else { 0.0 };
    let grows = |turns: f64| 0.1 * (turns - 4.0) * libm::sin(TAU * 4.0 * turns + 0.3);
    let all: [&dyn Fn(f64) -> f64; 2] = [&knock, &grows];
    for (which, more) in all.into_iter().enumerate() {
        let found = resolver(1, more);
        assert_eq!(found.verdict, Verdict::Unexplained, "{which}");
        let last = &found.rounds[found.rounds.len() - 1].effects;
        let sizes =
            last.iter().flat_map(|one| &one.parameters).filter(|one| one.key == "amplitude_um");
        let largest = sizes.map(|one| one.value).fold(0.0, f64::max);
        assert!((largest - 20.0).abs() < 0.1, "{which}: {largest}");
    }
}
