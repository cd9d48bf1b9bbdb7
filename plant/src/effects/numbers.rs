//! Every formula against a number worked out by hand.

use std::path::Path;

use super::tests::{LOGS, MACHINE, delta_um, machine, now};
use crate::air::edlen;
use crate::machine::Air;
use crate::prediction::{Sensor, predict};
use crate::{CATALOGUE, Columns, Effect, Instant, Machine, Model, Record, Samples, Term};

/// At 500 mm, 600 s, 6 rpm, forward, on the day of `tests::LOGS`: θ is 83⅓ turns.
const TABLE: &[(&str, &[f64], f64)] = &[
    ("screw-periodic", &[1.5, 30.0, 1.0], -1.5), // 41⅔ turns of the screw and 30°: 270°
    ("screw-progressive", &[35.0, -50.0, 10.0], 17.5 - 12.5 + 1.25),
    ("screw-wear", &[2.0, 470.0, 30.0], 1.213_061_319_425_267), // 2·e^−½
    ("gear-error", &[0.3, 0.0, 2.5], 0.259_807_621_135_331_6),  // 208⅓ turns: 120°
    ("clamping-runout", &[1.0, 0.0, 0.5, 90.0], 0.616_025_403_784_438_6), // √¾ − ¼
    ("backlash", &[4.0, 0.0, 0.0], 2.0),
    ("wind-up", &[0.01, 1.0, 0.0], 0.450_212_931_632_136), // ½·(1 − 2·e^−3)
    ("stick-slip", &[2.0, 12.0], 0.5),
    ("stick-slip", &[2.0, 5.9], 0.0),
    ("laser-drift", &[0.1, 0.2, 300.0], 0.5 * (0.1 / 6.0 + 0.2)),
    ("laser-drift", &[0.1, 0.2, 0.0], 0.5 * 0.1 / 6.0),
    ("cosine", &[1.0], 0.25),
    ("abbe", &[50.0], 0.484_813_681_109_536), // π/648000·10⁶·50 mm·2″
    ("fringe-nonlinearity", &[0.1, 0.0], -0.001_612_103_252_53),
    ("fringe-nonlinearity", &[0.1, 30.0], 0.000_989_281_589_58),
    ("compensator-staircase", &[10.0], 15.0 * 0.316_409_915), // 500 000/31 641 = 15.8
    ("compensator-staircase", &[-10.0], -15.0 * 0.316_409_915),
    ("fringe-slip", &[3.0, 500.0], 3.0 * 0.316_409_915),
    ("fringe-slip", &[3.0, 601.0], 0.0),
    ("grating-slip", &[1.0, 500.0], 6000.0 / 13_906.0),
    // 120° and the disc turned by 90°: sin 210°.
    ("grating-eccentricity", &[1.0, 0.0], -0.5 * 0.009_549_296_585_513_72),
    ("grating-graduation", &[0.05, 0.0, 2.0], 0.043_301_270_189_221_93), // sin 420°
    ("workpiece-expansion", &[1.0], -11.5),
    ("grinding-force", &[0.01], 0.5),
    ("wheel-wear", &[3.0], -1.5),
    ("steady-sag", &[1.0, 2000.0], 0.5),
    ("headstock-growth", &[2.0, 600.0], 1.264_241_117_657_115_4), // 2·(1 − 1/e)
    ("phase-drift", &[0.6], 0.1),
    ("meter-dead-zone", &[20.0], 0.0),
    ("meter-dead-zone", &[50.0], -47.761_487_25), // 150·λ/2 + 0.3, shorter than 50
    ("vibration", &[1.0, 0.0, 0.001_25], -1.0),   // three quarters of a turn
    ("lost-steps", &[40.0, 500.0], 0.5),
    ("lever-ratio", &[0.95], 0.25), // 400 steps are 5 µm
    ("wrong-setting", &[0.0, 0.0, 13_000.0, 0.0, 0.0], -0.5e6 * 906.0 / 13_906.0),
    ("wrong-setting", &[0.0, 149.0, 0.0, 0.0, 0.0], -0.5e6 / 149.0),
    ("wrong-setting", &[111.0, 0.0, 0.0, 0.0, 0.0], -0.5e6 / 111.0),
    ("rationalisation", &[], 0.0),
];

#[test]
fn formulas_give_the_numbers_worked_by_hand() {
    for (kind, values, expected_um) in TABLE {
        let delta_um = delta_um(kind, values, &now());
        let off_um = (delta_um - expected_um).abs();
        assert!(off_um < 1e-9 * expected_um.abs().max(1.0), "{kind}: {delta_um} {expected_um}");
    }
}

#[test]
fn no_formula_is_left_out() {
    let elsewhere = [
        "air-temperature",
        "air-pressure",
        "air-humidity",
        "dead-path",
        "lost-added-pulses",
        "turbulence",
        "recorder-lag",
        "corrector-lost-motion",
        "custom",
        "measured-curve",
    ];
    for card in CATALOGUE {
        let tested = TABLE.iter().any(|(kind, ..)| *kind == card.kind);
        assert!(tested != elsewhere.contains(&card.kind), "{}", card.kind);
    }
}

/// Against the other equation for the air, at the wavelength as printed: each quantity beside those that go before it,
/// and all of them together, at the sea and in the mountains.
#[test]
fn air_effects_follow_the_index() {
    let reference = Air { temperature_c: 20.0, pressure_hpa: 1013.25, humidity_pct: 50.0 };
    let index = |air: Air| edlen(0.632_819_83, &air);
    let short_um = |before: Air, air: Air| 0.5e6 * (index(before) - index(air)) / index(reference);
    for pressure_hpa in [1015.0, 780.0] {
        let dense = Air { pressure_hpa, ..reference };
        let warm = Air { temperature_c: 22.0, ..dense };
        let moist = Air { humidity_pct: 60.0, ..warm };
        let logs = day(22.0, pressure_hpa);
        let now = Instant { covariates: &logs, ..now() };
        let mut sum_um = 0.0;
        for (kind, before, air) in [
            ("air-pressure", reference, dense),
            ("air-temperature", dense, warm),
            ("air-humidity", warm, moist),
        ] {
            let (shown_um, expected_um) = (delta_um(kind, &[1.0], &now), short_um(before, air));
            assert!((shown_um - expected_um).abs() < 3e-3, "{kind}: {shown_um} {expected_um}");
            sum_um += shown_um;
        }
        let beam_um = delta_um("dead-path", &[0.5], &now);
        assert!((beam_um - sum_um).abs() < 1e-9, "{pressure_hpa} hPa: {beam_um} {sum_um}");
    }
    // The catalogue's round numbers, per metre and unit.
    let at_reference =
        |kind| delta_um(kind, &[1.0], &Instant { covariates: &day(20.0, 1013.25), ..now() });
    assert!((delta_um("air-temperature", &[1.0], &now()) - 0.93).abs() < 0.03);
    assert!((delta_um("air-pressure", &[1.0], &now()) + 0.268 * 0.875).abs() < 0.002);
    assert!((at_reference("air-humidity") - 0.0085 * 5.0).abs() < 0.002);
}

/// The ordinary day at another temperature and pressure of the air.
fn day(temperature_c: f64, pressure_hpa: f64) -> [f64; LOGS.len()] {
    let mut logs = LOGS;
    logs[..2].copy_from_slice(&[temperature_c, pressure_hpa]);
    logs
}

/// 500 mm are 1580.2 times a thousand fringes, and 143 times eleven of these.
#[test]
fn one_in_eleven_added_pulses_is_lost_at_30() {
    let lost_um = |wheels: &str| {
        let text = MACHINE.replace("a = 110, b = 150", wheels);
        let machine = Model::parse(&text, Path::new("machine.toml")).expect("a machine");
        let term = Term::new(Term::card("lost-added-pulses").expect("a card"), &[1.0]);
        let term = term.expect("one value");
        term.effect(&machine, &Columns::default()).expect("an effect").delta_um(&now())
    };
    let adding = lost_um("a = 22, b = 30, compensation = '-1000 um/m'");
    assert!((adding - 143.0 * 0.316_409_915).abs() < 1e-9, "{adding}");
    // Every one where B divides F; none where pulses are blocked, or where B and F + 1 share 3.
    let every = lost_um("a = 110, b = 125, compensation = '-1000 um/m'");
    assert!((every - 1580.0 * 0.316_409_915).abs() < 1e-9, "{every}");
    for none in ["a = 22, b = 30, compensation = '1000 um/m'", "a = 22, b = 30"] {
        assert!(lost_um(none).abs() < 1e-9, "{none}");
    }
    assert!(lost_um("a = 22, b = 30, compensation = '-500 um/m'").abs() < 1e-9);
}

/// Its size is the strength, it grows with the travel, and the seed decides its course.
#[test]
fn turbulence_is_noise_of_the_size_it_says() {
    let at = |seed: f64, time_s: f64, position_mm: f64| {
        delta_um("turbulence", &[0.05, seed], &Instant { time_s, position_mm, ..now() })
    };
    let power: f64 = (0..20_000).map(|i| at(7.0, 1.37 * f64::from(i), 1000.0)).map(|d| d * d).sum();
    let rms_um = (power / 20_000.0).sqrt();
    assert!((rms_um - 0.05).abs() < 0.003, "{rms_um}");
    let ratio = at(7.0, 5.0, 500.0) / at(7.0, 5.0, 1000.0);
    assert!((ratio - 0.535_886_731_268_146_6).abs() < 1e-12, "{ratio}"); // ½^0.9
    assert!(1e-4 < (at(7.0, 5.0, 1000.0) - at(8.0, 5.0, 1000.0)).abs());
}

/// 200 s at 0.6 mm/s.
fn ramp(machine: &Machine, steps: Option<Vec<f64>>) -> Record {
    let places_mm = (0..200).map(|second| 0.6 * f64::from(second)).collect();
    let covariates = steps.map(|steps| ("steps".to_owned(), steps.into())).into_iter().collect();
    Record::new(machine, &Samples { covariates, ..Samples::forward(machine, places_mm) })
}

fn with(kind: &str, values: &[f64]) -> Model {
    let mut machine = machine();
    let term = Term::new(Term::card(kind).expect(kind), values).expect(kind);
    machine.effects.push(term);
    machine
}

/// A drift of 0.1 µm/s through 2 s reads 0.2 µm behind.
#[test]
fn the_recorder_lags_behind_a_ramp() {
    let mut machine = with("phase-drift", &[360.0]);
    machine.effects.extend(with("recorder-lag", &[2.0]).effects);
    let shown = predict(&machine, &ramp(&machine, None)).expect("a prediction").error_um;
    let slope_um_s = 0.1 + crate::rationalisation::implied_um_per_m(&machine) * 0.6e-3;
    assert!((shown[199] - slope_um_s * 197.0).abs() < 1e-9, "{}", shown[199]);
}

/// Ten steps out and ten back, with a play of eight: the table comes back late.
#[test]
fn lost_motion_shows_after_a_reversal() {
    let steps = (0..200).map(|i| f64::from(if i < 100 { i } else { 200 - i })).collect();
    let machine = with("corrector-lost-motion", &[0.1]);
    let thread = predict(&machine, &ramp(&machine, Some(steps))).expect("a prediction");
    let thread_um = thread.of(Sensor::Thread);
    // Out: 50 steps less half the play. Back: the play has to be taken up first.
    assert!((thread_um[50] - (0.625 - 0.05)).abs() < 1e-12, "{}", thread_um[50]);
    assert!((thread_um[150] - (0.625 + 0.05)).abs() < 1e-12, "{}", thread_um[150]);
}
