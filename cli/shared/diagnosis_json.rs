//! The keys of `diagnose --json` and `learn --json`; they do not change.

use helixlock_lab::{
    Diagnosis, FittedEffect, FittedParameter, Ledger, LedgerEntry, Measurement, Ranked, Round,
    Structure,
};
use serde_json::{Map, Value, json};
use std::path::Path;

/// A whole diagnosis.
pub(crate) fn diagnosis(diagnosis: &Diagnosis, measurement: &Measurement) -> Value {
    json!({
        "verdict": diagnosis.verdict.word(),
        "unit": measurement.unit_word(),
        "noise_um": diagnosis.noise_um,
        "rounds": diagnosis.rounds.iter().map(round).collect::<Vec<_>>(),
        "effects": diagnosis.rounds.last().map(|r| effects(&r.effects)),
        "candidates": diagnosis.candidates.iter().map(candidate).collect::<Vec<_>>(),
        "residual": diagnosis.residual.iter().map(structure).collect::<Vec<_>>(),
        "experiments": diagnosis.experiments.iter().take(5).map(|advice| json!({
            "action": advice.action,
            "between": [advice.between.0, advice.between.1],
            "separation_um": advice.separation_um,
        })).collect::<Vec<_>>(),
        "notes": measurement.notes,
    })
}

/// One round; `parameters` are those of the effect it added.
pub(crate) fn round(round: &Round) -> Value {
    let own = round
        .added
        .as_ref()
        .and_then(|added| round.effects.iter().rev().find(|effect| effect.name == *added));
    json!({
        "round": round.round,
        "added": round.added,
        "dropped": round.dropped,
        "rms_um": round.rms_um,
        "holdout_rms_um": round.holdout_rms_um,
        "p_value": round.p_value,
        "parameters": own.map_or_else(|| json!({}), |effect| parameters(&effect.parameters)),
        "model": effects(&round.effects),
        "rejected": round.rejected.iter().map(|(effect, reason)| json!({
            "effect": effect, "reason": reason,
        })).collect::<Vec<_>>(),
    })
}

/// The ledger: every round with the machine file after it, so that each can be gone back to.
pub(crate) fn ledger(ledger: &Ledger, diagnosis: &Diagnosis, data: &Path) -> Value {
    let entry = |entry: &LedgerEntry| {
        let mut value = round(&entry.round);
        value["rms_before_um"] = json!(entry.rms_before_um);
        value["holdout_rms_before_um"] = json!(entry.holdout_rms_before_um);
        value["data_hash"] = json!(ledger.data_hash);
        value["taken_back"] = json!(false);
        value["machine"] = json!(entry.machine);
        value
    };
    json!({
        "data": data.display().to_string(),
        "data_hash": ledger.data_hash,
        "verdict": diagnosis.verdict.word(),
        "rounds": ledger.entries.iter().map(entry).collect::<Vec<_>>(),
    })
}

fn effects(effects: &[FittedEffect]) -> Value {
    let of = |effect: &FittedEffect| json!({ "effect": effect.name, "parameters": parameters(&effect.parameters) });
    effects.iter().map(of).collect()
}

/// Parameters by their keys, each with its value and standard error.
pub(crate) fn parameters(parameters: &[FittedParameter]) -> Value {
    let mut map = Map::new();
    for parameter in parameters {
        let mut entry = json!({ "value": parameter.value, "stderr": parameter.stderr });
        if let Some(warning) = parameter.warning {
            entry["warning"] = json!(warning);
        }
        map.insert(parameter.key.clone(), entry);
    }
    Value::Object(map)
}

fn candidate(candidate: &Ranked) -> Value {
    json!({
        "effect": candidate.name,
        "accepted": candidate.accepted,
        "rms_um": candidate.rms_um,
        "holdout_rms_um": candidate.holdout_rms_um,
        "p_value": candidate.p_value,
        "evidence_behind": candidate.behind,
        "confounded_with": candidate.confounded_with,
        "separate_by": candidate.separate_by,
    })
}

/// Something a model leaves.
pub(crate) fn structure(structure: &Structure) -> Value {
    json!({
        "along": structure.along,
        "shape": structure.shape,
        "rms_um": structure.rms_um,
        "p_value": structure.p_value,
        "at": structure.at,
        "at_stderr": structure.at_stderr,
        "line": structure.line.as_ref().map(|line| json!({
            "frequency": line.frequency,
            "frequency_stderr": line.frequency_stderr,
            "amplitude_um": line.amplitude,
            "amplitude_stderr_um": line.amplitude_stderr,
        })),
    })
}
