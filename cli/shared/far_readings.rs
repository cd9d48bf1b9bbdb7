//! Readings that lie far from the rest, and loud passes, as notes and JSON say them.

use helixlock_lab::{FarReading, FarReadings, LoudPass, Measurement, sensor_column};

use super::keys::keys;

keys! {
    FarReadingsJson(found: &FarReadings, measurement: &Measurement) {
        readings: usize = found.readings,
        of: usize = found.of,
        rms_without_them_um: f64 = found.rest_um,
        first: FarReadingJson = FarReadingJson::new(&found.first, measurement),
    }

    FarReadingJson(one: &FarReading, measurement: &Measurement) {
        sensor: &'static str = sensor_column(one.sensor, measurement.rotary),
        pass: f64 = one.pass,
        time_s: Option<f64> = measurement.timed.then_some(one.time_s),
        position_mm: Option<f64> = (!measurement.rotary).then_some(one.position_mm),
        angle_rev: f64 = one.angle_rev,
        off_um: f64 = one.off_um,
    }
}

/// How data were read, and which readings weigh little.
pub(crate) fn notes(
    measurement: &Measurement,
    far: Option<&FarReadings>,
    loud: &[LoudPass],
) -> Vec<String> {
    let weigh_little = far.map(|far| weigh_little(far, measurement));
    let weighs_less = |one: &LoudPass| weighs_less(one, measurement.rotary);
    let notes = measurement.notes.iter().cloned().chain(weigh_little);
    notes.chain(loud.iter().map(weighs_less)).collect()
}

fn weighs_less(LoudPass { sensor, pass, times }: &LoudPass, rotary: bool) -> String {
    let column = sensor_column(*sensor, rotary);
    format!(
        "`{column}` is {times:.1} times as loud in pass {pass} as in the others, and weighs less there"
    )
}

fn weigh_little(far: &FarReadings, measurement: &Measurement) -> String {
    let FarReadings { readings, of, rest_um, first } = far;
    let unit = measurement.unit();
    let place = format!("pass {}, {}", first.pass, place(first, measurement));
    let off = format!("{:.4} {unit} off", first.off_um);
    let rest = format!("{rest_um:.4} {unit} rms without");
    match readings {
        1 => format!(
            "1 of {of} readings lies far from the rest and weighs little ({place}, {off}): {rest} it"
        ),
        _ => format!(
            "{readings} of {of} readings lie far from the rest and weigh little (first: {place}, {off}): {rest} them"
        ),
    }
}

/// When it was read, or else where.
fn place(one: &FarReading, measurement: &Measurement) -> String {
    match (measurement.timed, measurement.rotary) {
        (true, _) => format!("{:.3} s", one.time_s),
        (false, true) => format!("{:.4} turns", one.angle_rev),
        (false, false) => format!("{:.3} mm", one.position_mm),
    }
}
