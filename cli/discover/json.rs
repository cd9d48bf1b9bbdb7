//! The keys of `discover --json`; they do not change.

use std::collections::BTreeMap;

use helixlock_lab::{Discovery, FormulaParameter, Measurement, Proposal, RunnerUp};

use crate::shared::diagnosis_json::{
    DoubtJson, EffectJson, ExperimentJson, StructureJson, effects,
};
use crate::shared::far_readings::{FarReadingsJson, notes};
use crate::shared::keys::keys;

keys! {
    DiscoveryJson<'a>(found: &'a Discovery, measurement: &'a Measurement) {
        verdict: &'static str = found.found.word(),
        doubts: Vec<DoubtJson<'a>> = found.doubts.iter().map(DoubtJson::new).collect(),
        unit: &'static str = measurement.unit_word(),
        proposals: Vec<ProposalJson<'a>> = found.proposals.iter().map(ProposalJson::new).collect(),
        effects: Vec<EffectJson<'a>> = effects(&found.effects),
        rms_before_um: f64 = found.rms_um[0],
        rms_um: f64 = found.rms_um[1],
        holdout_rms_before_um: f64 = found.holdout_rms_um[0],
        holdout_rms_um: f64 = found.holdout_rms_um[1],
        samples_a_pass: f64 = found.samples_a_pass,
        residual: Vec<StructureJson<'a>> = found.residual.iter().map(StructureJson::new).collect(),
        experiments: Vec<ExperimentJson<'a>> =
            found.experiments.iter().take(5).map(ExperimentJson::new).collect(),
        far_readings: Option<FarReadingsJson> =
            found.far_readings.as_ref().map(|far| FarReadingsJson::new(far, measurement)),
        notes: Vec<String> = notes(measurement, found.far_readings.as_ref(), &found.loud_passes),
    }

    ProposalJson<'a>(one: &'a Proposal) {
        shape: &'static str = one.shape,
        along: &'a str = &one.along,
        physics: &'static str = one.physics,
        formula: &'a str = &one.formula,
        entry: &'static str = one.entry.word(),
        parameters: BTreeMap<&'a str, NumberJson<'a>> =
            one.parameters.iter().map(|what| (what.name.as_str(), NumberJson::new(what))).collect(),
        instead_of: &'a [String] = &one.instead_of,
        evidence: f64 = one.evidence,
        p_value: f64 = one.p_value,
        runners_up: Vec<RunnerUpJson<'a>> = one.runners_up.iter().map(RunnerUpJson::new).collect(),
    }

    NumberJson<'a>(one: &'a FormulaParameter) {
        value: f64 = one.value,
        stderr: Option<f64> = one.stderr,
        unit: &'a str = &one.unit,
    }

    RunnerUpJson<'a>(one: &'a RunnerUp) {
        shape: &'static str = one.shape,
        along: &'a str = &one.along,
        formula: &'a str = &one.formula,
        instead_of: &'a [String] = &one.instead_of,
        evidence_behind: f64 = one.behind,
        alike: bool = one.alike,
        refused: Option<&'a str> = one.refused,
    }
}
