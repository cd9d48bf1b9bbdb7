//! The keys of `transmission --json`; they do not change.

use helixlock_metrology::transmission::{Cost, Limits, Peak, Sample, ShaftLine};

use super::evaluation::{ARCSEC, Evaluation, Found, MethodResult};
use crate::shared::keys::keys;

keys! {
    /// A whole evaluation; the samples are in it when one method was asked for.
    TransmissionJson<'a>(all: &'a Evaluation) {
        input_pulses: usize = all.pulses.input_s().len(),
        output_pulses: usize = all.pulses.output_s().len(),
        input_lines: u64 = all.setup.gearing.input_lines,
        output_lines: u64 = all.setup.gearing.output_lines,
        ratio: (u64, u64) = all.setup.gearing.ratio,
        input_pulses_per_output_pulse: (u64, u64) = all.setup.gearing.pulses_per_pulse(),
        clock_hz: f64 = all.setup.clock_hz,
        range_divider: u64 = all.setup.range_divider,
        recorder_s: f64 = all.setup.recorder_s,
        limit_arcsec: Option<f64> = all.limit_arcsec,
        holds: Option<bool> = all.limit_arcsec.map(|_| all.holds()),
        methods: Vec<MethodJson<'a>> = all.results.iter().map(MethodJson::new).collect(),
        #[serde(skip_serializing_if = "Vec::is_empty")]
        notes: Vec<String> = all.notes(),
        #[serde(skip_serializing_if = "Option::is_none")]
        samples: Option<SamplesJson> = match all.results.as_slice() {
            [MethodResult { found: Ok(found), .. }] => {
                Some(SamplesJson::new(&found.reading.samples))
            }
            _ => None,
        },
    }

    SamplesJson(samples: &[Sample]) {
        time_s: Vec<f64> = samples.iter().map(|one| one.time_s).collect(),
        output_turns: Vec<f64> = samples.iter().map(|one| one.output_turns).collect(),
        delta_arcsec: Vec<f64> = samples.iter().map(|one| one.error_rad * ARCSEC).collect(),
    }

    /// A method with what it found, or why it cannot work here.
    MethodJson<'a>(result: &'a MethodResult) {
        method: &'static str = result.method.name(),
        #[serde(flatten)]
        found: Option<FoundJson<'a>> = result.found.as_ref().ok().map(FoundJson::new),
        #[serde(skip_serializing_if = "Option::is_none")]
        cannot: Option<&'a str> = result.found.as_ref().err().map(String::as_str),
    }

    FoundJson<'a>(found: &'a Found) {
        samples: usize = found.reading.samples.len(),
        peak_to_peak_arcsec: f64 = found.reading.peak_to_peak_rad() * ARCSEC,
        slope_arcsec_per_turn: Option<f64> =
            found.spectrum.as_ref().and_then(|found| Some(found.slope_rad_per_turn? * ARCSEC)),
        limits: LimitsJson = LimitsJson::new(&found.reading.limits),
        cost_per_sample: CostJson = CostJson::new(found.reading.cost),
        against_truth: Option<TruthJson> = found.against_truth.map(TruthJson::new),
        peaks: Vec<PeakJson<'a>> = found.peaks.iter().map(PeakJson::new).collect(),
        shafts: Vec<ShaftJson<'a>> =
            found.spectrum.iter().flat_map(|s| &s.shafts).map(ShaftJson::new).collect(),
    }

    LimitsJson(limits: &Limits) {
        resolution_arcsec: f64 = limits.resolution_rad * ARCSEC,
        range_arcsec: Option<f64> = limits.range_rad.map(|range| range * ARCSEC),
        step_arcsec: Option<f64> = limits.step_rad.map(|step| step * ARCSEC),
        samples_per_turn: f64 = limits.samples_per_turn,
        bound_arcsec: f64 = limits.bound_rad * ARCSEC,
        in_words: &'static str = limits.in_words,
    }

    CostJson(cost: Cost) {
        counters: u32 = cost.counters,
        multiplications: u32 = cost.multiplications,
        analog_part: bool = cost.analog,
    }

    TruthJson(largest_and_rms_rad: (f64, f64)) {
        largest_arcsec: f64 = largest_and_rms_rad.0 * ARCSEC,
        rms_arcsec: f64 = largest_and_rms_rad.1 * ARCSEC,
    }

    PeakJson<'a>(peak: &'a Peak) {
        order: f64 = peak.line.order,
        amplitude_arcsec: f64 = peak.line.amplitude_rad * ARCSEC,
        shafts: &'a [String] = &peak.shafts,
    }

    ShaftJson<'a>(line: &'a ShaftLine) {
        name: &'a str = &line.shaft.name,
        order: f64 = line.shaft.order,
        amplitude_arcsec: f64 = line.amplitude_rad * ARCSEC,
        phase_deg: f64 = line.phase_rad.to_degrees(),
    }
}
