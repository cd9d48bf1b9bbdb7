//! What must not change a verdict: units, the order in which things are written, columns of noise.
//!
//! Few cases of small scenes, the same in every run; `PROPTEST_CASES` makes a campaign of them.

use std::path::Path;

use helixlock_lab::{Measurement, Nominal, Problem, Verdict, diagnose};
use helixlock_plant::prediction::{Sensor, predict};
use helixlock_plant::{Model, Record, Samples};
use helixlock_traces::{Column, Table};
use proptest::prelude::*;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::properties::few;
use crate::support::diagnosed::{columns, diagnosed_on};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// Standard deviation of every scene's noise, µm.
const NOISE_UM: f64 = 0.1;

/// A machine with something hidden or nothing, and how it was measured.
#[derive(Debug, Clone)]
struct Scene {
    /// Index into [`LEADS`].
    lead: usize,
    /// Lead of the machine's screw, mm.
    screw_mm: f64,
    /// Order of the gear in the file.
    gear: f64,
    hidden: Hidden,
    passes: u32,
    rows: usize,
    /// Autocorrelation of the noise from sample to sample.
    kept: f64,
    /// Seed of the noise and of the places of the samples.
    seed: u64,
}

#[derive(Debug, Clone)]
enum Hidden {
    Nothing,
    /// A wave that grows shorter along the travel, as no effect does: its amplitude, µm.
    Chirp(f64),
    /// An effect of the catalogue: its table in the machine file.
    Effect(String),
}

/// Lead, A and B.
const LEADS: [(f64, u32, u32); 3] = [(6.0, 110, 150), (5.0, 110, 125), (10.0, 66, 150)];

fn hidden() -> impl Strategy<Value = Hidden> {
    let size = (0.05_f64..0.8).prop_map(|um| (um * 1e4).round() / 1e4);
    let effect = |text: String| Hidden::Effect(format!("[[effect]]\n{text}\n"));
    prop_oneof![
        2 => Just(Hidden::Nothing),
        1 => size.clone().prop_map(Hidden::Chirp),
        3 => (size.clone(), -180..180).prop_map(move |(um, deg)| effect(format!(
            "kind = \"gear-error\"\ngear = \"wheel\"\namplitude = \"{um} um\"\nphase = \"{deg} deg\""
        ))),
        2 => (size.clone(), -180..180).prop_map(move |(um, deg)| effect(format!(
            "kind = \"screw-periodic\"\namplitude = \"{um} um\"\nphase = \"{deg} deg\""
        ))),
        2 => size.clone().prop_map(move |um| effect(format!(
            "kind = \"screw-progressive\"\nquadratic = \"{} um/m^2\"", 40.0 * um
        ))),
        2 => size.clone().prop_map(move |um| effect(format!(
            "kind = \"abbe\"\noffset = \"{} mm\"", 200.0 * um
        ))),
        1 => Just(effect("kind = \"air-temperature\"".to_owned())),
        1 => (1..5, 200..400).prop_map(move |(count, time)| effect(format!(
            "kind = \"fringe-slip\"\ncount = {count}\ntime = \"{time} s\""
        ))),
    ]
}

fn scene() -> impl Strategy<Value = Scene> {
    let kept = prop_oneof![Just(0.0), 0.3..0.9];
    let machine = (0..LEADS.len(), prop_oneof![Just(8.0), Just(12.0)], 0.6..2.8_f64);
    (machine, hidden(), 1..4_u32, 70..120_usize, kept, any::<u64>()).prop_map(
        |((lead, screw_mm, gear), hidden, passes, rows, kept, seed)| {
            let gear = (gear * 1e3).round() / 1e3;
            Scene { lead, screw_mm, gear, hidden, passes, rows, kept, seed }
        },
    )
}

impl Scene {
    fn machine(&self, with: &str) -> Model {
        let (lead, a, b) = LEADS[self.lead];
        let Self { screw_mm, gear, .. } = self;
        let text = format!(
            r#"
[workpiece]
lead = "{lead} mm"
length = "200 mm"
[spindle]
speed = "6 rpm"
[lead_screw]
lead = "{screw_mm} mm"
[[gear]]
name = "wheel"
order = {gear}
teeth = 48
[grating]
lines = 13906
diameter = "200 mm"
[laser]
wavelength = "0.63281983 um"
[dividers]
a = {a}
b = {b}
range = 2
[drive]
step = "0.0125 um"
frequency = "160 Hz"
{with}"#
        );
        Model::parse(&text, Path::new("machine.toml")).expect("a machine")
    }

    /// The machine as its file has it.
    fn known(&self) -> Model {
        self.machine("")
    }

    /// What the recorder measured.
    fn table(&self) -> Table {
        self.measured(&[(Sensor::Recorder, "error_um")])
    }

    /// What was measured: places at uneven distances, slow waves in the logs.
    fn measured(&self, sensors: &[(Sensor, &str)]) -> Table {
        let mut chance = ChaCha8Rng::seed_from_u64(self.seed);
        let with = match &self.hidden {
            Hidden::Effect(text) => text,
            Hidden::Nothing | Hidden::Chirp(_) => "",
        };
        let truth = self.machine(with);
        let [mut time_s, mut position_mm, mut pass] = [const { Vec::new() }; 3];
        let mut start_s = 0.0;
        for number in 1..=self.passes {
            let mut places: Vec<f64> =
                (0..self.rows).map(|_| chance.random_range(0.0..200.0)).collect();
            places.sort_by(f64::total_cmp);
            for place in places {
                let place = (place * 1e3).round() / 1e3;
                time_s.push(start_s + ((place / LEADS[self.lead].0 * 10.0) * 1e3).round() / 1e3);
                position_mm.push(place);
                pass.push(f64::from(number));
            }
            start_s = time_s[time_s.len() - 1] + 30.0;
        }
        let wave = |of: &[f64], length: f64, mean: f64, swing: f64| -> Vec<f64> {
            of.iter().map(|at| mean + swing * libm::sin(at / length)).collect()
        };
        let covariates = vec![
            ("air_temperature_c".to_owned(), wave(&time_s, 150.0, 20.5, 2.0)),
            ("bed_pitch_arcsec".to_owned(), wave(&position_mm, 13.0, 0.0, 1.0)),
        ];
        let samples = Samples {
            time_s: time_s.clone().into(),
            pass: (0..).zip(0..self.passes).flat_map(|(pass, _)| vec![pass; self.rows]).collect(),
            covariates: covariates
                .iter()
                .map(|(name, log)| (name.clone(), log.clone().into()))
                .collect(),
            ..Samples::forward(&truth, position_mm.clone())
        };
        let record = Record::new(&truth, &samples);
        let shown = predict(&truth, &record).expect("all columns");
        let chirp_um = if let Hidden::Chirp(um) = self.hidden { um } else { 0.0 };
        let mut seen = Vec::new();
        for (sensor, name) in sensors {
            let noise = noise(&mut chance, time_s.len(), self.kept);
            let values = shown.of(*sensor).iter().zip(noise).zip(&position_mm);
            let values = values.map(|((shown, noise), x_mm)| {
                shown + NOISE_UM * noise + chirp_um * libm::sin(x_mm * x_mm / 400.0)
            });
            seen.push(((*name).to_owned(), values.collect()));
        }
        let own = [("time_s", time_s), ("position_mm", position_mm), ("pass", pass)];
        let own = own.into_iter().map(|(name, values)| (name.to_owned(), values));
        let all = own.chain(covariates).chain(seen);
        Table::new(all.map(|(name, values)| Column { name, values }).collect())
    }
}

/// Noise of variance 1 that forgets by the sample.
fn noise(chance: &mut ChaCha8Rng, rows: usize, kept: f64) -> Vec<f64> {
    let mut slow: f64 = StandardNormal.sample(chance);
    let mut next = || {
        let fresh: f64 = StandardNormal.sample(chance);
        slow = kept * slow + (1.0 - kept * kept).sqrt() * fresh;
        slow
    };
    (0..rows).map(|_| next()).collect()
}

/// Verdict and names, sorted.
fn answer(machine: &Model, table: &Table) -> (Verdict, Vec<String>) {
    let measurement = Measurement::from_table(table, &Nominal::of(machine)).expect("a measurement");
    let diagnosis = diagnose(&Problem::new(machine, &measurement).expect("all columns are there"));
    let effects = &diagnosis.rounds.last().expect("there is always a round 0").effects;
    let mut names: Vec<String> = effects.iter().map(|effect| effect.name.clone()).collect();
    names.sort_unstable();
    (diagnosis.verdict, names)
}

/// Bed pitch in steps of 0.2″, four times the noise: the steps are the instrument's, not the bed's.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_rounded_log_leaves_nothing_unexplained() {
    let abbe = "[[effect]]\nkind = \"abbe\"\noffset = \"400 mm\"\n";
    for seed in seeds(1, 3) {
        for hidden in [Hidden::Effect(abbe.to_owned()), Hidden::Nothing] {
            let expected = match hidden {
                Hidden::Effect(_) => (Verdict::Explained, vec!["abbe".to_owned()]),
                _ => (Verdict::NothingMissing, Vec::new()),
            };
            let (lead, screw_mm, gear, passes, rows, kept) = (0, 12.0, 2.5, 2, 900, 0.0);
            let scene = Scene { lead, screw_mm, gear, hidden, passes, rows, kept, seed };
            let mut table = scene.table();
            for column in table.columns.iter_mut().filter(|column| column.name.contains("pitch")) {
                column.values.iter_mut().for_each(|value| *value = (*value / 0.2).round() * 0.2);
            }
            assert_eq!(answer(&scene.known(), &table), expected, "seed {seed}");
        }
    }
}

/// An axis without a prediction of its own, one pass of which is louder, and a wave of its screw: no sign is special.
#[test]
fn the_sign_of_all_errors_leaves_every_figure_alone() {
    for seed in seeds(2, 24) {
        let (mut noise, mut slow) = (white(seed, 0.3), white(600 + seed, 0.2));
        let mut level = 0.0;
        let rows = (0..200_u32).map(|row| {
            let (pass, mm) = (row / 40, 1.7 * f64::from(row % 40));
            level = 0.9 * level + slow();
            let loudness = if pass == 2 { 3.0 } else { 1.0 };
            let wave = 0.3 * libm::sin(std::f64::consts::TAU * mm / 5.0);
            [f64::from(pass), 0.5 * f64::from(row), mm, wave + level + loudness * noise()]
        });
        let table = columns(["pass", "time_s", "position_mm", "error_um"], rows);
        let mut turned = table.clone();
        turned[3].1.iter_mut().for_each(|error| *error = -*error);
        let told = |table| {
            let found =
                diagnosed_on("spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n", table);
            let rms: Vec<u64> = found.rounds.iter().map(|round| round.rms_um.to_bits()).collect();
            (found.verdict, rms, found.samples_a_pass.to_bits())
        };
        assert_eq!(told(turned), told(table), "{seed}");
    }
}

/// A unit that a column may be written in: old name, new name, values in the new one.
type Rewritten = (&'static str, &'static str, fn(f64) -> f64);

const UNITS: [Rewritten; 13] = [
    ("error_um", "Error [nm]", |um| um * 1e3),
    ("error_um", "error (mm)", |um| um / 1e3),
    ("error_um", "error / m", |um| um / 1e6),
    ("position_mm", "Position [m]", |mm| mm / 1e3),
    ("position_mm", "position (inch)", |mm| mm / 25.4),
    ("position_mm", "travel_um", |mm| mm * 1e3),
    ("time_s", "Time [ms]", |s| s * 1e3),
    ("time_s", "t / min", |s| s / 60.0),
    ("air_temperature_c", "Air temperature [K]", |c| c + 273.15),
    ("air_temperature_c", "air temperature (°F)", |c| c * 1.8 + 32.0),
    ("air_temperature_c", "air_temperature_f", |c| c * 1.8 + 32.0),
    ("bed_pitch_arcsec", "pitch [µrad]", |arcsec| arcsec * std::f64::consts::PI / 0.648),
    ("bed_pitch_arcsec", "bed pitch (arcmin)", |arcsec| arcsec / 60.0),
];

proptest! {
    #![proptest_config(few(4, 8))]

    #[test]
    #[ignore = "long: `cargo xtask campaign` runs it"]
    fn units_leave_verdict_and_names_alone(
        scene in scene(),
        chosen in prop::sample::subsequence(UNITS.to_vec(), 1..=5),
    ) {
        let (machine, table) = (scene.known(), scene.table());
        let mut other = table.clone();
        for (old, new, convert) in chosen {
            let Some(column) = other.columns.iter_mut().find(|column| column.name == old) else {
                continue; // written in another unit already
            };
            new.clone_into(&mut column.name);
            column.values.iter_mut().for_each(|value| *value = convert(*value));
        }
        prop_assert_eq!(answer(&machine, &other), answer(&machine, &table));
    }

    #[test]
    fn order_of_passes_rows_and_columns_leaves_verdict_and_names_alone(
        scene in scene(),
        seed in any::<u64>(),
    ) {
        let (machine, table) = (scene.known(), scene.table());
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let mut order: Vec<usize> = (0..table.rows()).collect();
        order.shuffle(&mut chance);
        let old: Vec<f64> = (1..=scene.passes).map(f64::from).collect();
        let mut new = old.clone();
        new.shuffle(&mut chance);
        let renamed = |pass: f64| old.iter().position(|old| old.to_bits() == pass.to_bits());
        let moved = table.columns.iter().map(|column| {
            let value = |&row: &usize| match column.name.as_str() {
                "pass" => new[renamed(column.values[row]).expect("one of the passes")],
                _ => column.values[row],
            };
            Column { name: column.name.clone(), values: order.iter().map(value).collect() }
        });
        let mut columns: Vec<Column> = moved.collect();
        columns.shuffle(&mut chance);
        prop_assert_eq!(answer(&machine, &Table::new(columns)), answer(&machine, &table));
    }

    #[test]
    #[ignore = "long: `cargo xtask campaign` runs it"]
    fn columns_of_noise_create_no_name(scene in scene(), kind in 0..3_u8, seed in any::<u64>()) {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let sensors = [(Sensor::Recorder, "error_um"), (Sensor::Thread, "lead_error_um")];
        let mut table = scene.measured(&sensors);
        let abbe = matches!(&scene.hidden, Hidden::Effect(text) if text.contains("abbe"));
        table.columns.retain(|column| abbe || column.name != "bed_pitch_arcsec");
        for (name, mean, swing) in NOISE_COLUMNS.into_iter().skip(usize::from(abbe)) {
            let values = wandering(&mut chance, table.rows(), kind);
            let values = values.into_iter().map(|value| mean + swing * value).collect();
            table.columns.push(Column { name: name.to_owned(), values });
        }
        let (verdict, names) = answer(&scene.known(), &table);
        let made_of_noise = |name: &String| {
            LIVING_ON_THEM.contains(&name.as_str()) && !(abbe && name == "abbe")
        };
        prop_assert!(!names.iter().any(made_of_noise), "{:?} {:?}", verdict, names);
    }
}

/// Columns of noise: name, mean, and a swing with which their effects would be worth the noise.
const NOISE_COLUMNS: [(&str, f64, f64); 4] = [
    ("bed_pitch_arcsec", 0.0, 1.0),
    ("force_n", 40.0, 5.0),
    ("workpiece_temperature_c", 20.0, 0.5),
    ("vibration_mm_s", 0.0, 1.0),
];

/// Effects that are worked out from those columns.
const LIVING_ON_THEM: [&str; 4] = ["abbe", "grinding-force", "wind-up", "workpiece-expansion"];

/// White noise, a random walk, or noise that swings like a wave, each up to 2.5.
fn wandering(chance: &mut ChaCha8Rng, rows: usize, kind: u8) -> Vec<f64> {
    let fresh = noise(chance, rows, 0.0);
    let (a, b) = match kind {
        0 => (0.0, 0.0),
        1 => (1.0, 0.0),
        _ => (2.0 * 0.99 * libm::cos(0.4), -0.99 * 0.99),
    };
    let mut values: Vec<f64> = Vec::with_capacity(rows);
    for value in fresh {
        let before = |back: usize| values.len().checked_sub(back).map_or(0.0, |at| values[at]);
        values.push(value + a * before(1) + b * before(2));
    }
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    values.iter().map(|value| 2.5 * value / largest).collect()
}
