//! The machine, the passes and the instruments of a challenge.

use std::f64::consts::TAU;
use std::iter::repeat_n;
use std::path::Path;

use helixlock_plant::prediction::{Sensor, observe, predict};
use helixlock_plant::{Entry, Machine, MachineFile, Model, Record, Samples};
use helixlock_traces::{Column, Table};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::error::ChallengeError;
use super::recipe::Recipe;
use crate::numerics::{count, rms_about_means};

/// Leads with dividers that hold them (document 1: B/A = S·5/22), and the compensation.
const LEADS: [(&str, u32, u32, &str); 3] =
    [("6 mm", 110, 150, "0 um/m"), ("5 mm", 110, 125, "0 um/m"), ("10 mm", 66, 150, "0 um/m")];

/// The same with pulses added, F = 4000, 7000 and 10000, some of them behind a B-th one.
const ADDING: [(&str, u32, u32, &str); 3] = [
    ("6 mm", 22, 30, "-250 um/m"),
    ("6 mm", 22, 30, "-142.8571 um/m"),
    ("6 mm", 22, 30, "-100 um/m"),
];

/// A machine file with a screw, two gears and a length by chance.
pub(super) fn machine(
    recipe: &Recipe,
    chance: &mut ChaCha8Rng,
) -> Result<MachineFile, ChallengeError> {
    let leads = if recipe.adding { ADDING } else { LEADS };
    let (lead, a, b, compensation) = leads[chance.random_range(0..leads.len())];
    let length = [400, 600, 1000][chance.random_range(0..3)];
    let text = format!(
        r#"title = "A machine with a secret"

[workpiece]
lead = "{lead}"
length = "{length} mm"

[spindle]
speed = "6 rpm"

[lead_screw]
lead = "12 mm"

[[gear]]
name = "change gear 1"
order = 2.5
teeth = 48

[[gear]]
name = "change gear 2"
order = 0.8
teeth = 60

[grating]
lines = 13906
diameter = "200 mm"

[laser]
wavelength = "0.63281983 um"

[dividers]
a = {a}
b = {b}
range = 2
compensation = "{compensation}"

[drive]
step = "0.0125 um"
frequency = "160 Hz"
"#
    );
    Ok(MachineFile::parse(&text, Path::new("machine.toml"))?)
}

/// The samples of a recipe's passes, from any place and at uneven intervals.
pub(super) fn record(machine: &Machine, recipe: &Recipe, chance: &mut ChaCha8Rng) -> Record {
    let lead_mm = machine.workpiece.lead.mm();
    let length_mm = machine.workpiece.length_mm;
    let rows = [400, 600, 900][chance.random_range(0..3)];
    let even = chance.random_range(0..2) == 0;
    let mut samples = Vec::new();
    let mut now_s = 0.0;
    for pass in 0..recipe.passes {
        let (from, to) = (chance.random_range(0.0..0.1), chance.random_range(0.9..1.0));
        let rpm = machine.spindle.speed_rpm * recipe.speeds[pass % 2];
        let mut shares: Vec<f64> = (0..rows)
            .map(|i| if even { count(i) / count(rows - 1) } else { chance.random_range(0.0..1.0) })
            .collect();
        shares.sort_by(f64::total_cmp);
        for share in &shares {
            let way = if recipe.reversal { 1.0 - (2.0 * share - 1.0).abs() } else { *share };
            let place_mm = length_mm * (from + (to - from) * way);
            let gone_mm = length_mm * (to - from) * share * if recipe.reversal { 2.0 } else { 1.0 };
            let forward = !recipe.reversal || *share < 0.5;
            samples.push([
                now_s + 60.0 * gone_mm / lead_mm / rpm,
                place_mm,
                rpm,
                if forward { 1.0 } else { -1.0 },
                if recipe.reindexed { 90.0 * count(pass) } else { 0.0 },
            ]);
        }
        now_s =
            samples.last().map_or(0.0, |last: &[f64; 5]| last[0]) + chance.random_range(20.0..90.0);
    }
    let of = |index: usize| samples.iter().map(|sample| sample[index]).collect::<Vec<f64>>();
    let mut covariates = logs(&of(0), &of(1), recipe, chance);
    if recipe.reindexed {
        covariates.push(("grating_index_deg".to_owned(), of(4)));
    }
    let samples = Samples {
        time_s: of(0).into(),
        position_mm: of(1).into(),
        angle_rev: of(1).iter().map(|place_mm| place_mm / lead_mm).collect(),
        speed_rpm: of(2).into(),
        direction: of(3).into(),
        pass: (0..recipe.passes).flat_map(|pass| repeat_n(pass, rows)).collect(),
        covariates: covariates.into_iter().map(|(name, log)| (name, log.into())).collect(),
    };
    Record::new(machine, &samples)
}

/// What the sensors around the machine say: slow waves in time, or in place for the pitch.
fn logs(
    time_s: &[f64],
    position_mm: &[f64],
    recipe: &Recipe,
    chance: &mut ChaCha8Rng,
) -> Vec<(String, Vec<f64>)> {
    let end_s = time_s.last().copied().unwrap_or(1.0);
    let end_mm = position_mm.iter().copied().fold(1.0, f64::max);
    recipe
        .logs
        .iter()
        .map(|name| {
            let (centre, swing) = match *name {
                "air_pressure_hpa" => (1013.25, 6.0),
                "humidity_pct" => (50.0, 10.0),
                "bed_pitch_arcsec" => (0.0, 2.0),
                _ => (20.0, 1.5),
            };
            let (waves, phase) = (chance.random_range(0.6..1.9), chance.random_range(0.0..TAU));
            let wave = |share: f64| centre + swing * libm::sin(TAU * waves * share + phase);
            let values = if *name == "bed_pitch_arcsec" {
                position_mm.iter().map(|x| wave(x / end_mm)).collect()
            } else {
                time_s.iter().map(|t| wave(t / end_s)).collect()
            };
            ((*name).to_owned(), values)
        })
        .collect()
}

/// The data file of a true machine, and how large the hidden part is on its clearest sensor.
#[expect(clippy::too_many_arguments, reason = "one caller, and each is a thing of its own")]
pub(super) fn measured(
    known: &Model,
    truth: &Model,
    record: &Record,
    recipe: &Recipe,
    extra: &[f64],
    noise_um: f64,
    chance: &mut ChaCha8Rng,
) -> Result<(Table, f64), ChallengeError> {
    let (shown, expected) = (predict(truth, record)?, predict(known, record)?);
    let mut columns = vec![
        column("position_mm", record.position_mm.to_vec()),
        column("time_s", record.time_s.to_vec()),
        column("pass", record.pass.iter().map(|&pass| count(pass + 1)).collect()),
        column("direction", record.direction.to_vec()),
        column("speed_rpm", record.speed_rpm.to_vec()),
    ];
    for name in record.columns.present() {
        columns.extend(record.column(name).map(|values| column(name, values)));
    }
    let mut hidden_um: f64 = 0.0;
    for (sensor, name, on) in [
        (Sensor::Recorder, "error_um", recipe.recorder),
        (Sensor::Thread, "lead_error_um", recipe.thread),
    ] {
        if on {
            let more = observe(known, record, Entry::Motion, sensor, extra);
            let clean: Vec<f64> = shown.of(sensor).iter().zip(&more).map(|(a, b)| a + b).collect();
            let hidden: Vec<f64> =
                clean.iter().zip(expected.of(sensor)).map(|(a, b)| a - b).collect();
            hidden_um = hidden_um.max(rms_about_means(record.passes(), &hidden));
            columns.push(column(name, noisy(record, &clean, noise_um, chance)));
        }
    }
    shuffle(&mut columns, chance);
    Ok((Table::new(columns), hidden_um))
}

/// Values with noise of one colour, each pass from its own zero.
fn noisy(record: &Record, clean: &[f64], noise_um: f64, chance: &mut ChaCha8Rng) -> Vec<f64> {
    let kept: f64 =
        if chance.random_range(0..2) == 0 { 0.0 } else { chance.random_range(0.3..0.9) };
    let mut noisy = Vec::with_capacity(clean.len());
    for rows in record.passes() {
        let mut slow: f64 = StandardNormal.sample(chance);
        let start = noisy.len();
        for row in rows {
            let fresh: f64 = StandardNormal.sample(chance);
            slow = kept * slow + (1.0 - kept * kept).sqrt() * fresh;
            noisy.push(clean[row] + noise_um * slow);
        }
        let zero = noisy[start];
        noisy[start..].iter_mut().for_each(|value: &mut f64| *value -= zero);
    }
    noisy
}

fn shuffle(columns: &mut [Column], chance: &mut ChaCha8Rng) {
    for last in (1..columns.len()).rev() {
        columns.swap(last, chance.random_range(0..=last));
    }
}

/// A column of a table.
fn column(name: &str, values: Vec<f64>) -> Column {
    Column { name: name.to_owned(), values }
}
