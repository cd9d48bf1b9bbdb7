//! The keys of `compare --json`; they do not change.

use helixlock_lab::{
    Comparison, Measurement, NamedLine, NoiseSize, PassSize, SensorResidual, SlowSize,
    sensor_column,
};

use crate::shared::diagnosis_json::{DoubtJson, StructureJson};
use crate::shared::far_readings::{FarReadingsJson, notes};
use crate::shared::keys::keys;

keys! {
    /// A whole comparison.
    ComparisonJson<'a>(found: &'a Comparison, measurement: &'a Measurement) {
        unit: &'static str = measurement.unit_word(),
        doubts: Vec<DoubtJson<'a>> = found.doubts.iter().map(DoubtJson::new).collect(),
        noise_only: bool = found.noise_only,
        noise_p_value: f64 = found.noise_p_value,
        sensors: Vec<SensorJson> =
            found.sensors.iter().map(|one| SensorJson::new(one, measurement.rotary)).collect(),
        along: Vec<StructureJson<'a>> = found.along.iter().map(StructureJson::new).collect(),
        lines: Vec<LineJson<'a>> =
            found.lines.iter().map(|one| LineJson::new(one, found, measurement.rotary)).collect(),
        far_readings: Option<FarReadingsJson> =
            found.far_readings.as_ref().map(|far| FarReadingsJson::new(far, measurement)),
        notes: Vec<String> = notes(measurement, found.far_readings.as_ref(), &found.loud_passes),
    }

    SensorJson(one: &SensorResidual, rotary: bool) {
        sensor: &'static str = sensor_column(one.sensor, rotary),
        samples: usize = one.samples,
        effective_samples: f64 = one.effective_samples,
        samples_looked_at: usize = one.looked_at,
        rms_um: f64 = one.rms_um,
        peak_to_peak_um: f64 = one.peak_to_peak_um,
        outliers: usize = one.outliers,
        noise: NoiseJson = NoiseJson::new(&one.noise),
        passes: Vec<PassJson> = one.passes.iter().map(PassJson::new).collect(),
    }

    NoiseJson(noise: &NoiseSize) {
        white_um: f64 = noise.white_um,
        slow: Vec<SlowJson> = noise.slow.iter().map(SlowJson::new).collect(),
    }

    SlowJson(part: &SlowSize) {
        rms_um: f64 = part.rms_um,
        correlation_s: f64 = part.correlation_s,
    }

    PassJson(one: &PassSize) {
        pass: f64 = one.pass,
        samples: usize = one.samples,
        rms_um: f64 = one.rms_um,
        peak_to_peak_um: f64 = one.peak_to_peak_um,
    }

    LineJson<'a>(one: &'a NamedLine, found: &'a Comparison, rotary: bool) {
        sensor: &'static str = sensor_column(found.sensors[one.sensor].sensor, rotary),
        order: f64 = one.line.frequency,
        order_stderr: f64 = one.line.frequency_stderr,
        period_s: f64 = one.period_s,
        period_stderr_s: f64 = one.period_stderr_s,
        period_mm: Option<f64> = one.period_mm,
        amplitude_um: f64 = one.line.amplitude,
        amplitude_stderr_um: f64 = one.line.amplitude_stderr,
        p_value: f64 = one.line.p_value,
        name: Option<&'a str> = one.name.as_deref(),
        harmonic: Option<u32> = one.harmonic_of.map(|(number, _)| number),
        of_order: Option<f64> = one.harmonic_of.map(|(_, order)| order),
    }
}
