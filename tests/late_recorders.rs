//! A recorder that lags: a log may begin while it stands at rest, or while it follows the machine already.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, FittedEffect, Problem, Verdict, compare, diagnose};

use crate::support::diagnosed::{names, problem_of};
use crate::support::passes::white;
use crate::support::seeds::seeds;

const SCREW: &str = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n\
                     [[effect]]\nkind = \"screw-periodic\"\namplitude = \"2 um\"\nphase = \"40 deg\"\n";

/// Time constant of the recorder, s; deviation of its readings, µm.
const LAG_S: f64 = 0.15;
const NOISE_UM: f64 = 0.1;

/// A wave of the table: µm, waves a turn of the screw, phase in radians.
type Wave = (f64, f64, f64);

/// That of the file.
const KNOWN: Wave = (2.0, 1.0, 40.0 * TAU / 360.0);

/// Where the recorder stands at the first row of a pass.
#[derive(Clone, Copy)]
enum Start {
    /// Where the error is.
    AtRest,
    /// Behind it, as it is all the way.
    InMotion,
    /// It is quick; an oil film gives way behind each start.
    OnAFilm,
}

/// What a film lifts the table by at the start of the first pass, µm, and its time constant, s.
const FILM: (f64, f64) = (0.9, 0.4);

/// A pass at each of some speeds, turns of the screw a second, 400 rows in ten turns; what a recorder shows of
/// some waves.
fn run(machine: &str, seed: u64, (speeds, waves): (&[f64], &[Wave]), start: Start) -> Problem {
    let mut noise = white(seed, NOISE_UM);
    let mut columns = [const { Vec::new() }; 4];
    let mut pass = 0.0;
    for speed in speeds {
        pass += 1.0;
        let shown = |after_s: f64| {
            let shown = |time_s: f64, lag_s: f64| -> f64 {
                waves.iter().map(|wave| late(*wave, *speed, time_s, lag_s)).sum()
            };
            let behind = shown(0.0, 0.0) - shown(0.0, LAG_S);
            match start {
                Start::AtRest => shown(after_s, LAG_S) + behind * libm::exp(-after_s / LAG_S),
                Start::InMotion => shown(after_s, LAG_S),
                Start::OnAFilm => {
                    shown(after_s, 0.0) + pass * FILM.0 * libm::exp(-after_s / FILM.1)
                }
            }
        };
        for row in 0..400_u16 {
            let turns = f64::from(row) / 40.0;
            let after_s = turns / speed;
            let cells = [1000.0 * pass + after_s, 5.0 * turns, pass, shown(after_s) + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
    }
    let titles = ["time_s", "position_mm", "pass", "error_um"];
    problem_of(machine, titles.into_iter().zip(columns).collect())
}

/// What a recorder that has followed a wave for long shows of it: `−a·sin(ωt + φ − arctan ωτ)/√(1 + ω²τ²)`.
fn late((size_um, order, phase): Wave, speed: f64, time_s: f64, lag_s: f64) -> f64 {
    let rate = TAU * order * speed;
    let lag = rate * lag_s;
    -size_um * libm::sin(rate * time_s + phase - libm::atan(lag)) / libm::hypot(1.0, lag)
}

/// The final model.
fn last(found: &Diagnosis) -> &[FittedEffect] {
    found.rounds.last().map_or(&[], |round| &round.effects)
}

/// A machine file that has the lag.
fn with_lag() -> String {
    format!("{SCREW}[[effect]]\nkind = \"recorder-lag\"\ntime_constant = \"{LAG_S} s\"\n")
}

/// True for an effect's first number within four of its errors.
fn is_near(one: &FittedEffect, value: f64) -> bool {
    let found = &one.parameters[0];
    (found.value - value).abs() < 4.0 * found.stderr.unwrap_or(0.0)
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_lag_is_told_whether_or_not_the_recorder_followed_before_the_first_row() {
    for start in [Start::AtRest, Start::InMotion] {
        for seed in seeds(1, 3) {
            let found = diagnose(&run(SCREW, seed, (&[1.0, 1.0 / 3.0], &[KNOWN]), start));
            assert_eq!(found.verdict, Verdict::Explained, "{seed}");
            let [lag] = last(&found) else { panic!("{seed}: {:?}", names(&found)) };
            assert_eq!(
                lag.parameters.len(),
                1,
                "what a pass began with is no number of the machine"
            );
            assert!(lag.name == "recorder-lag" && is_near(lag, LAG_S), "{seed}: {lag:?}");
            assert_eq!(lag.term.values.len(), 1, "nor of its file");
        }
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_beside_a_lag_keeps_its_size_in_a_log_that_begins_in_motion() {
    let hidden = (0.6, 3.0, 1.7);
    for seed in seeds(1, 3) {
        let seen = (&[1.0, 1.0 / 3.0][..], &[KNOWN, hidden][..]);
        let found = diagnose(&run(SCREW, seed, seen, Start::InMotion));
        assert_eq!(found.verdict, Verdict::Explained, "{seed}: {:?}", names(&found));
        let named = |name: &str| last(&found).iter().find(|one| one.name == name);
        let (lag, wave) = (named("recorder-lag"), named("screw-periodic"));
        assert!(lag.is_some_and(|lag| is_near(lag, LAG_S)), "{seed}: {lag:?}");
        assert!(wave.is_some_and(|wave| is_near(wave, 0.6)), "{seed}: {wave:?}");
    }
}

/// At one speed a lag makes a wave smaller and later, as another size and phase of it would.
#[test]
fn one_speed_that_begins_in_motion_does_not_tell_a_lag_from_another_wave() {
    for seed in seeds(1, 3) {
        let found = diagnose(&run(SCREW, seed, (&[1.0], &[KNOWN]), Start::InMotion));
        let is_told = names(&found) == ["recorder-lag"];
        assert!(is_told || found.verdict == Verdict::Ambiguous, "{seed}: {:?}", names(&found));
    }
}

/// It dies away as what a recorder began with does, which alone speaks for no lag.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_film_that_gives_way_behind_each_start_is_no_lag() {
    for seed in seeds(1, 3) {
        let found = diagnose(&run(SCREW, seed, (&[1.0, 1.0 / 3.0], &[KNOWN]), Start::OnAFilm));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}: {:?}", names(&found));
        assert!(!names(&found).contains(&"recorder-lag"), "{seed}: {:?}", names(&found));
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_file_with_the_lag_leaves_noise_however_the_log_begins() {
    let hidden = (0.6, 3.0, 1.7);
    for start in [Start::AtRest, Start::InMotion] {
        for seed in seeds(1, 3) {
            let known = run(&with_lag(), seed, (&[1.0, 1.0 / 3.0], &[KNOWN]), start);
            let compared = compare(&known);
            assert!(compared.noise_only && compared.doubts.is_empty(), "{seed}");
            assert!(compared.sensors[0].rms_um < 1.1 * NOISE_UM, "{seed}");
            assert_eq!(diagnose(&known).verdict, Verdict::NothingMissing, "{seed}");
            let seen = (&[1.0, 1.0 / 3.0][..], &[KNOWN, hidden][..]);
            let found = diagnose(&run(&with_lag(), seed, seen, start));
            assert_eq!(found.verdict, Verdict::Explained, "{seed}");
            let [wave] = last(&found) else { panic!("{seed}: {:?}", names(&found)) };
            assert!(is_near(wave, 0.6), "{seed}: {wave:?}");
        }
    }
}
