//! A closed loop's own trace, compared with a machine file that lacks something.
//!
//! The runs are clock by clock, with hunting, lag and the meter's own zero; a recorder adds its
//! noise. What is known of them is the effect that was put in.

use std::path::Path;

use helixlock_lab::{Diagnosis, Measurement, Nominal, Problem, Verdict, diagnose};
use helixlock_plant::Model;
use helixlock_sim::{Options, simulate};
use helixlock_traces::{Column, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::support::seeds::cases;

/// 48 mm of the 6 mm screw; the drift of its own screw is known.
const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "48 mm", expansion = "11.5 ppm/K" }
spindle.speed = "6 rpm"
lead_screw.lead = "12 mm"
gear = [{ name = "change gear 1", order = 2.5, teeth = 48 }, { name = "change gear 2", order = 0.8 }]
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150, range = 2, initial_phase = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
filter.cutoff = "1 Hz"
loop.closed = true
[[effect]]
kind = "screw-progressive"
linear = "30 um/m"
"#;

/// Deviation of the noise of recorder and thread, µm.
const NOISE_UM: f64 = 0.02;

/// Comparisons in which the loop pulls in.
const PULLING_IN: usize = 20;

fn machine(more: &str) -> Model {
    Model::parse(&format!("{MACHINE}{more}"), Path::new("machine.toml")).expect("a machine")
}

/// Two passes at two speeds, on a day that grows warmer, with an effect in the machine.
fn passes(effect: &str, noise_um: f64) -> Table {
    let mut chance = ChaCha8Rng::seed_from_u64(1977);
    let noise = Normal::new(0.0, noise_um).expect("a deviation");
    let mut columns: Vec<(&str, Vec<f64>)> =
        ["pass", "time_s", "position_mm", "speed_rpm", "error_um", "steps", "lead_error_um"]
            .into_iter()
            .chain(["air_temperature_c", "workpiece_temperature_c"])
            .map(|name| (name, Vec::new()))
            .collect();
    for (pass, speed_rpm, air_c) in [(1.0, 6.0, 21.0), (2.0, 9.0, 29.0)] {
        let day = format!(
            "{effect}\n[environment]\nair_temperature = \"{air_c} degC\"\n\
             workpiece_temperature = \"{air_c} degC\"\n"
        );
        let mut model = machine(&day);
        model.machine.spindle.speed_rpm = speed_rpm;
        let run = simulate(&model, &Options::default(), &mut |_| {}).expect("a machine that runs");
        let trace = run.closed.trace;
        for row in PULLING_IN..trace.time_s.len() {
            let mut blurred = |value: f64| value + noise.sample(&mut chance);
            let cells = [
                pass,
                trace.time_s[row] + 1000.0 * pass,
                trace.position_mm[row],
                speed_rpm,
                blurred(trace.filtered_error_um[row]),
                counted(trace.steps[row]),
                blurred(trace.lead_error_um[row]),
                air_c,
                air_c,
            ];
            columns.iter_mut().zip(cells).for_each(|((_, column), cell)| column.push(cell));
        }
    }
    let named = |(name, values): (&str, Vec<f64>)| Column { name: name.to_owned(), values };
    Table::new(columns.into_iter().map(named).collect())
}

#[expect(clippy::cast_precision_loss, reason = "the counter holds 4095 steps")]
fn counted(steps: i64) -> f64 {
    steps as f64
}

/// The diagnosis of what is left of a table when some columns are not in the file.
fn diagnosis(table: &Table, without: &[&str]) -> Diagnosis {
    let kept = table.columns.iter().filter(|column| !without.contains(&column.name.as_str()));
    let table = Table::new(kept.cloned().collect());
    let machine = machine("");
    let measurement =
        Measurement::from_table(&table, &Nominal::of(&machine)).expect("a measurement");
    diagnose(&Problem::new(&machine, &measurement).expect("all columns are there"))
}

fn names(diagnosis: &Diagnosis) -> Vec<String> {
    let last = diagnosis.rounds.last().expect("there is always a round 0");
    last.effects.iter().map(|effect| effect.name.clone()).collect()
}

const HIDDEN: [(&str, &str); 5] = [
    ("gear-error", "amplitude = '0.8 um'\nphase = '40 deg'\norder = 0.8"),
    ("screw-periodic", "amplitude = '1.5 um'\nphase = '30 deg'"),
    ("air-temperature", ""),
    ("workpiece-expansion", ""),
    ("compensator-staircase", "rate = '20 um/m'"),
];

/// With the steps in the file, the loop hides nothing.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_a_closed_loop_has_corrected_is_named_from_its_trace() {
    for (kind, values) in cases(2, &HIDDEN) {
        let table = passes(&format!("[[effect]]\nkind = '{kind}'\n{values}\n"), NOISE_UM);
        let found = diagnosis(&table, &[]);
        assert_eq!(names(&found), [*kind]);
        assert_eq!(found.verdict, Verdict::Explained, "{kind}: {:?}", found.residual);
        assert!((found.noise_um - NOISE_UM).abs() < 0.2 * NOISE_UM, "{kind}: {}", found.noise_um);
    }
}

/// Whatever was kept of the run, its hunting is no missing effect.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_loop_that_lacks_nothing_lacks_nothing() {
    let table = passes("", NOISE_UM);
    let all: [&[&str]; 4] = [&[], &["steps"], &["steps", "error_um"], &["error_um"]];
    for without in cases(2, &all) {
        let found = diagnosis(&table, without);
        assert_eq!(
            found.verdict,
            Verdict::NothingMissing,
            "without {without:?}: {:?}",
            found.residual
        );
    }
}

/// A reading is made while the motor steps: what that leaves of a run without noise is no structure.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_run_without_noise_lacks_nothing() {
    let found = diagnosis(&passes("", 0.0), &[]);
    assert_eq!(found.verdict, Verdict::NothingMissing, "{:?}", found.residual);
}

/// Without the steps, what the loop has taken out is smaller than its hunting, and no name is safe.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_a_loop_hides_is_not_named_wrongly() {
    for (kind, values) in cases(1, &[HIDDEN[0], HIDDEN[3]]) {
        let table = passes(&format!("[[effect]]\nkind = '{kind}'\n{values}\n"), NOISE_UM);
        for without in [&["steps"][..], &["error_um"]] {
            let found = diagnosis(&table, without);
            let wrong = found.verdict == Verdict::Explained && names(&found) != [*kind];
            assert!(!wrong, "{kind} without {without:?}: {:?}", names(&found));
        }
    }
}
