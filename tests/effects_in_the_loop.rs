//! Every effect of the catalogue, put into the cycle-accurate run, comes out of recorder, counter
//! and thread as its closed form predicts.
//!
//! The two share the formula of δ and nothing else: one goes through fringes, flip-flops and motor
//! steps, the other through the sign table.

use std::collections::BTreeMap;
use std::path::Path;

use helixlock_plant::prediction::{Sensor, predict};
use helixlock_plant::{CATALOGUE, Model, Record, Samples};
use helixlock_sim::{Options, Simulation, Trace, simulate};

use crate::support::command::{put, scratch};

/// 30 mm of the 6 mm screw, 50 s; surroundings far from ordinary, so that all effects act.
const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "30 mm" }
spindle.speed = "6 rpm"
lead_screw.lead = "12 mm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150, range = 2, initial_phase = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
[environment]
air_temperature = "40 degC"
air_pressure = "1100 hPa"
humidity = "100 %"
workpiece_temperature = "40 degC"
bed_temperature = "25 degC"
bed_pitch = "5 arcsec"
force = "100 N"
[[effect]]
"#;

/// Each effect with values that show in 30 mm.
const EFFECTS: &[(&str, &str)] = &[
    ("screw-periodic", "amplitude = '1.5 um'\nphase = '30 deg'"),
    ("screw-progressive", "linear = '100 um/m'\nquadratic = '-900 um/m^2'"),
    ("screw-wear", "height = '3 um'\nposition = '15 mm'\nwidth = '4 mm'"),
    ("gear-error", "amplitude = '2 um'\norder = 0.4"),
    ("clamping-runout", "amplitude1 = '2 um'\namplitude2 = '1 um'"),
    ("backlash", "width = '4 um'"),
    ("wind-up", "compliance = '0.02 um/N'"),
    ("stick-slip", "jump = '2 um'\ncritical_speed = '7 rpm'"),
    ("air-temperature", ""),
    ("air-pressure", ""),
    ("air-humidity", ""),
    ("dead-path", "path = '0.3 m'"),
    ("laser-drift", "rate = '100 ppm/h'\nhop = '9 ppm'\nhop_time = '20 s'"),
    ("cosine", "angle = '20 mrad'"),
    ("abbe", "offset = '50 mm'"),
    ("turbulence", "strength = '5 um'"),
    ("fringe-nonlinearity", "mixing = 0.5"),
    ("compensator-staircase", "rate = '90 um/m'"),
    ("fringe-slip", "count = 3\ntime = '20 s'"),
    ("grating-slip", "count = 3\ntime = '20 s'"),
    ("grating-eccentricity", "eccentricity = '200 um'"),
    ("grating-graduation", "amplitude = '1 um'\nharmonic = 2"),
    ("workpiece-expansion", ""),
    ("grinding-force", "compliance = '0.02 um/N'"),
    ("wheel-wear", "rate = '90 um/m'"),
    ("steady-sag", "amplitude = '3 um'\nspacing = '20 mm'"),
    ("headstock-growth", "amplitude = '5 um'\ntime_constant = '10 s'"),
    ("phase-drift", "rate = '500 um/h'"),
    ("meter-dead-zone", "width = '5 um'"),
    ("vibration", "amplitude = '0.5 um'\nfrequency = '7 Hz'"),
    ("corrector-lost-motion", "width = '0.2 um'"),
    ("lost-steps", "count = 100\ntime = '20 s'"),
    ("lever-ratio", "gain = 0.9"),
    ("wrong-setting", "lines = 13905"),
    (
        "custom",
        "entry = 'angle-reference'\nformula = 'a*sin(2*pi*time_s/T)'\nparameters = { a = 2.0, T = 25.0 }",
    ),
    ("measured-curve", "file = 'curve.csv'"),
];

/// Motion error, mm and µm: straight from point to point.
const CURVE: &str = "position_mm,lead_error_um\n0,0\n10,4\n20,-1\n30,2\n";

/// Not tried, and why.
const LEFT_OUT: &[(&str, &str)] = &[
    ("rationalisation", "follows from the machine file: it is in every run of this table"),
    ("lost-added-pulses", "lies behind the compensator: run gate by gate in `hazards_in_data`"),
    ("recorder-lag", "lies behind the recorder, which the loop does not see"),
];

/// Faster than the comparisons can follow: what a closed loop makes of it is an alias.
const TOO_FAST_FOR_THE_LOOP: &[&str] = &["vibration", "stick-slip", "turbulence"];

/// Open, the motor takes no step that could be lost; the closed form speaks of a motor in use.
const CLOSED_ONLY: &[&str] = &["lost-steps"];

/// Open: a clock is 0.05 nm, and what the spindle travels in [`JUMP_S`] is 12 nm.
const OPEN_TOLERANCE_UM: f64 = 0.015;

/// Closed: the swing of 0.32 µm either way, and what the error moves in one comparison.
const CLOSED_TOLERANCE_UM: f64 = 0.5;

/// 6 rpm of 6 mm.
const TRAVEL_MM_S: f64 = 0.6;

/// Where δ jumps, the fringes owed come 1 µs apart, and a row may fall among them.
const JUMP_S: f64 = 2e-5;

/// After a jump the motor is under way for this time; all jumps of the table are at 20 s.
const UNDER_WAY_S: std::ops::Range<f64> = 20.0..22.0;

fn machine(kind: &str, values: &str) -> Model {
    let text = format!("{MACHINE}kind = \"{kind}\"\n{values}\n");
    let folder = scratch();
    put(&folder.path().join("curve.csv"), CURVE);
    Model::parse(&text, &folder.path().join("machine.toml")).expect("a machine file")
}

fn run(machine: &Model) -> Simulation {
    simulate(machine, &Options::default(), &mut |_| {}).expect("a machine that runs")
}

/// What a sensor should have shown, a moment early or late; the record begins with the pass.
fn predicted(machine: &Model, trace: &Trace, sensor: Sensor, shift_s: f64) -> Vec<f64> {
    let from_start = |values: &[f64], shift: f64| {
        std::iter::once(0.0).chain(values.iter().map(|value| value + shift)).collect::<Vec<f64>>()
    };
    let rows = trace.time_s.len() + 1;
    let constants = machine.environment.readings.iter();
    let mut covariates: BTreeMap<_, _> =
        constants.map(|(name, value)| (name.clone(), vec![*value; rows].into())).collect();
    covariates.insert("initial_phase".into(), vec![150.0; rows].into());
    covariates.insert("steps".into(), from_start(&steps(trace), 0.0).into());
    let places_mm = from_start(&trace.position_mm, TRAVEL_MM_S * shift_s);
    let samples = Samples {
        time_s: from_start(&trace.time_s, shift_s).into(),
        covariates,
        ..Samples::forward(machine, places_mm)
    };
    let record = Record::new(machine, &samples);
    predict(machine, &record).expect("every column there").of(sensor)[1..].to_vec()
}

#[expect(clippy::cast_precision_loss, reason = "the counter holds 4095 steps")]
fn steps(trace: &Trace) -> Vec<f64> {
    trace.steps.iter().map(|steps| *steps as f64).collect()
}

/// Largest distance of what was shown from what was predicted, apart from the constant that suits
/// best: the grating starts up to one line late.
fn worst(machine: &Model, trace: &Trace, sensor: Sensor, shown: &[f64]) -> f64 {
    let [early, late] = [-JUMP_S, JUMP_S].map(|shift_s| predicted(machine, trace, sensor, shift_s));
    let (mut above, mut below) = (f64::NEG_INFINITY, f64::INFINITY);
    for (shown, (early, late)) in shown.iter().zip(early.iter().zip(&late)) {
        above = above.max(shown - early.max(*late));
        below = below.min(shown - early.min(*late));
    }
    ((above - below) / 2.0).max(0.0)
}

#[test]
fn every_effect_of_the_catalogue_is_tried() {
    let mut tried: Vec<_> = EFFECTS.iter().chain(LEFT_OUT).map(|(kind, _)| *kind).collect();
    let mut catalogue: Vec<_> = CATALOGUE.iter().map(|card| card.kind).collect();
    tried.sort_unstable();
    catalogue.sort_unstable();
    assert_eq!(tried, catalogue);
}

#[test]
fn open_loop_shows_what_the_closed_form_says() {
    let mut wrong = Vec::new();
    for (kind, values) in EFFECTS.iter().filter(|(kind, _)| !CLOSED_ONLY.contains(kind)) {
        let machine = machine(kind, values);
        let mut trace = run(&machine).open.trace;
        if *kind == "grating-slip" {
            // The comparison in which it slips is shorter, and a mean over it larger.
            trace = rows(&trace, |row| !(20.0..20.3).contains(&trace.time_s[row]));
        }
        assert!(trace.time_s.len() > 300, "{kind}: {} rows", trace.time_s.len());
        let recorder = worst(&machine, &trace, Sensor::Recorder, &trace.error_um);
        let thread = worst(&machine, &trace, Sensor::Thread, &trace.lead_error_um);
        if !(recorder < OPEN_TOLERANCE_UM && thread < OPEN_TOLERANCE_UM) {
            wrong.push(format!("{kind}: recorder off by {recorder} µm, thread by {thread} µm"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn closed_loop_grinds_and_counts_what_the_closed_form_says() {
    let mut wrong = Vec::new();
    for (kind, values) in EFFECTS.iter().filter(|(kind, _)| !TOO_FAST_FOR_THE_LOOP.contains(kind)) {
        let mut model = machine(kind, values);
        model.machine.loop_closed = true;
        let trace = settled(&run(&model).closed.trace);
        let thread = worst(&model, &trace, Sensor::Thread, &trace.lead_error_um);
        let counter = worst(&model, &trace, Sensor::Counter, &steps(&trace));
        let counter_um = counter * model.drive.step_um;
        if !(thread < CLOSED_TOLERANCE_UM && counter_um < CLOSED_TOLERANCE_UM) {
            wrong.push(format!("{kind}: thread off by {thread} µm, counter by {counter_um} µm"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Eight stairs of λ/2, by divider F and its gates, and by the closed form.
#[test]
fn a_compensation_of_the_machine_file_is_stairs() {
    for rate in ["90 um/m", "-90 um/m"] {
        let text = MACHINE.replace("[[effect]]", "").replace(
            "initial_phase = 150",
            &format!("initial_phase = 150, compensation = \"{rate}\""),
        );
        let mut model = Model::parse(&text, Path::new("machine.toml")).expect("a machine");
        let trace = run(&model).open.trace;
        let recorder = worst(&model, &trace, Sensor::Recorder, &trace.error_um);
        assert!(recorder < OPEN_TOLERANCE_UM, "{rate}: recorder off by {recorder} µm");
        model.machine.loop_closed = true;
        let trace = settled(&run(&model).closed.trace);
        let thread = worst(&model, &trace, Sensor::Thread, &trace.lead_error_um);
        assert!(thread < CLOSED_TOLERANCE_UM, "{rate}: thread off by {thread} µm");
    }
}

/// The rows after the first pull to the middle of the meter, without those of the way after a jump.
fn settled(trace: &Trace) -> Trace {
    rows(trace, |row| 10 <= row && !UNDER_WAY_S.contains(&trace.time_s[row]))
}

fn rows(trace: &Trace, keep: impl Fn(usize) -> bool) -> Trace {
    let kept: Vec<usize> = (0..trace.time_s.len()).filter(|&row| keep(row)).collect();
    let column = |values: &[f64]| kept.iter().map(|&row| values[row]).collect();
    Trace {
        time_s: column(&trace.time_s),
        position_mm: column(&trace.position_mm),
        error_um: column(&trace.error_um),
        filtered_error_um: column(&trace.filtered_error_um),
        steps: kept.iter().map(|&row| trace.steps[row]).collect(),
        lead_error_um: column(&trace.lead_error_um),
    }
}
