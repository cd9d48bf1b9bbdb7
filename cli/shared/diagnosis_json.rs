//! The keys of `diagnose --json` and `learn --json`; they do not change.

use helixlock_lab::{
    Advice, Diagnosis, Doubt, FittedEffect, FittedParameter, Line, Measurement, Ranked, Round,
    Structure,
};
use serde::Serializer;

use super::far_readings::{FarReadingsJson, notes};
use super::keys::keys;

keys! {
    /// A whole diagnosis.
    DiagnosisJson<'a>(found: &'a Diagnosis, measurement: &'a Measurement) {
        verdict: &'static str = found.verdict.word(),
        doubts: Vec<DoubtJson<'a>> = found.doubts.iter().map(DoubtJson::new).collect(),
        unit: &'static str = measurement.unit_word(),
        noise_um: f64 = found.noise_um,
        samples_a_pass: f64 = found.samples_a_pass,
        rounds: Vec<RoundJson<'a>> = found.rounds.iter().map(RoundJson::new).collect(),
        effects: Option<Vec<EffectJson<'a>>> = found.rounds.last().map(|last| effects(&last.effects)),
        candidates: Vec<CandidateJson<'a>> =
            found.candidates.iter().map(CandidateJson::new).collect(),
        residual: Vec<StructureJson<'a>> = found.residual.iter().map(StructureJson::new).collect(),
        experiments: Vec<ExperimentJson<'a>> =
            found.experiments.iter().take(5).map(ExperimentJson::new).collect(),
        far_readings: Option<FarReadingsJson> =
            found.far_readings.as_ref().map(|far| FarReadingsJson::new(far, measurement)),
        notes: Vec<String> = notes(measurement, found.far_readings.as_ref(), &found.loud_passes),
    }

    /// Something that looks mistaken.
    DoubtJson<'a>(one: &'a Doubt) {
        what: &'static str = one.what,
        evidence: f64 = one.evidence,
        says: &'a str = &one.says,
        mend: &'a str = &one.mend,
    }

    /// One round; `parameters` are those of the effect it added.
    RoundJson<'a>(one: &'a Round) {
        round: usize = one.round,
        added: Option<&'a str> = one.added.as_deref(),
        dropped: &'a [String] = &one.dropped,
        rms_um: f64 = one.rms_um,
        holdout_rms_um: f64 = one.holdout_rms_um,
        p_value: Option<f64> = one.p_value,
        #[serde(serialize_with = "by_key")]
        parameters: &'a [FittedParameter] = own_parameters(one),
        model: Vec<EffectJson<'a>> = effects(&one.effects),
        rejected: Vec<RejectedJson<'a>> = one.rejected.iter().map(RejectedJson::new).collect(),
    }

    RejectedJson<'a>(one: &'a (String, String)) {
        effect: &'a str = &one.0,
        reason: &'a str = &one.1,
    }

    /// An effect with its parameters by their keys.
    EffectJson<'a>(one: &'a FittedEffect) {
        effect: &'a str = &one.name,
        #[serde(serialize_with = "by_key")]
        parameters: &'a [FittedParameter] = &one.parameters,
    }

    ParameterJson(one: &FittedParameter) {
        value: f64 = one.value,
        stderr: Option<f64> = one.stderr,
        #[serde(skip_serializing_if = "Option::is_none")]
        warning: Option<&'static str> = one.warning,
        #[serde(skip_serializing_if = "Option::is_none")]
        file_says: Option<f64> = one.file_says,
    }

    CandidateJson<'a>(one: &'a Ranked) {
        effect: &'a str = &one.name,
        accepted: bool = one.accepted,
        rms_um: f64 = one.rms_um,
        holdout_rms_um: f64 = one.holdout_rms_um,
        p_value: f64 = one.p_value,
        evidence_behind: f64 = one.behind,
        confounded_with: &'a [String] = &one.confounded_with,
        separate_by: Option<&'a str> = one.separate_by.as_deref(),
    }

    /// Something a model leaves.
    StructureJson<'a>(one: &'a Structure) {
        along: &'a str = &one.along,
        shape: &'a str = &one.shape,
        rms_um: f64 = one.rms_um,
        p_value: f64 = one.p_value,
        at: Option<f64> = one.at,
        at_stderr: Option<f64> = one.at_stderr,
        line: Option<LineJson> = one.line.as_ref().map(LineJson::new),
    }

    LineJson(line: &Line) {
        frequency: f64 = line.frequency,
        frequency_stderr: f64 = line.frequency_stderr,
        amplitude_um: f64 = line.amplitude,
        amplitude_stderr_um: f64 = line.amplitude_stderr,
    }

    ExperimentJson<'a>(advice: &'a Advice) {
        action: &'a str = &advice.action,
        between: &'a (String, String) = &advice.between,
        evidence: Option<f64> = advice.is_a_run().then_some(advice.evidence),
        separation_um: Option<f64> = advice.is_a_run().then_some(advice.separation_um),
    }
}

/// Each effect with its parameters.
pub(crate) fn effects(effects: &[FittedEffect]) -> Vec<EffectJson<'_>> {
    effects.iter().map(EffectJson::new).collect()
}

fn own_parameters(round: &Round) -> &[FittedParameter] {
    let own = |added: &String| round.effects.iter().rev().find(|effect| effect.name == *added);
    round.added.as_ref().and_then(own).map_or(&[], |effect| &effect.parameters)
}

fn by_key<S: Serializer>(parameters: &[FittedParameter], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|one| (&one.key, ParameterJson::new(one))))
}
