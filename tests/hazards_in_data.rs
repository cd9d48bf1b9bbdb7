//! A hazard of the original's gates that reaches the recorder is found there under its name.

use std::path::Path;

use helixlock_lab::{Verdict, diagnose};
use helixlock_original::Corner;
use helixlock_plant::Model;
use helixlock_sim::{DelaySet, certify_gates};
use helixlock_traces::{Column, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::support::diagnosed::{names, problem};

/// One pulse is added every 4000 fringes, and one in 11 of them meets the clear of divider B.
const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "100 mm" }
spindle.speed = "6 rpm"
lead_screw.lead = "12 mm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 22, b = 30, range = 2, initial_phase = 30, compensation = "-250 um/m" }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

/// Deviation of the recorder's noise, µm.
const NOISE_UM: f64 = 0.03;

/// What the gates draw, every fourth comparison, and the noise.
fn recorded(model: &Model) -> Table {
    let typical = [DelaySet::Corner(Corner::Typical)];
    let gates = certify_gates(model, None, &typical).expect("gates that run").remove(0);
    let mut chance = ChaCha8Rng::seed_from_u64(1977);
    let noise = Normal::new(0.0, NOISE_UM).expect("a deviation");
    let kept = |values: &[f64]| values.iter().step_by(4).copied().collect::<Vec<f64>>();
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let error_um = kept(&gates.drawn.error_um);
    Table::new(vec![
        column("time_s", kept(&gates.drawn.time_s)),
        column("position_mm", kept(&gates.drawn.position_mm)),
        column("error_um", error_um.iter().map(|e| e + noise.sample(&mut chance)).collect()),
    ])
}

#[test]
fn pulses_that_the_gates_lose_are_named() {
    let model = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
    let found = diagnose(&problem(&model, &recorded(&model)));
    assert_eq!(found.verdict, Verdict::Explained);
    assert_eq!(names(&found), ["lost-added-pulses"]);
    let effects = &found.rounds.last().expect("a last round").effects;
    // Seven fringes in 100 mm; the gates lose them whole.
    let scale = &effects[0].parameters[0];
    let stderr = scale.stderr.expect("a standard error");
    assert!((scale.value - 1.0).abs() < 3.0 * stderr, "{scale:?}");
    // A comparison in which a fringe is lost, or a pulse added, shows a part of it.
    assert!((found.noise_um - NOISE_UM).abs() < 0.3 * NOISE_UM, "{}", found.noise_um);
}
