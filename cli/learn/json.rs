//! What `helixlock learn` prints with `--json`, and its ledger; the keys do not change.

use std::path::Path;

use helixlock_lab::{
    Diagnosis, FinalCheck, Ledger, LedgerEntry, Problem, SensorCheck, sensor_column,
};
use serde::Serialize;

use super::closed_loop_check::Checked;
use crate::shared::diagnosis_json::{DiagnosisJson, RoundJson};
use crate::shared::keys::keys;

keys! {
    /// What is printed.
    LearnJson<'a>(found: &'a Diagnosis, book: &'a Ledger, check: &'a Checked, problem: &'a Problem) {
        #[serde(flatten)]
        diagnosis: DiagnosisJson<'a> = DiagnosisJson::new(found, &problem.measurement),
        data_hash: &'a str = &book.data_hash,
        accepted: bool = book.accepted,
        final_check: Option<CheckJson<'a>> = check_json(check),
    }

    /// Every round with the machine file after it, so that each can be gone back to.
    LedgerJson<'a>(
        data: &'a Path, found: &'a Diagnosis, book: &'a Ledger, check: &'a Checked,
        problem: &'a Problem
    ) {
        data: String = data.display().to_string(),
        data_hash: &'a str = &book.data_hash,
        verdict: &'static str = found.verdict.word(),
        accepted: bool = book.accepted,
        rounds: Vec<EntryJson<'a>> =
            book.entries.iter().map(|entry| EntryJson::new(entry, book)).collect(),
        final_check: Option<CheckJson<'a>> = check_json(check),
        title: &'a str = &problem.model.title,
        unit: &'static str = problem.measurement.unit_word(),
    }

    EntryJson<'a>(entry: &'a LedgerEntry, book: &'a Ledger) {
        #[serde(flatten)]
        round: RoundJson<'a> = RoundJson::new(&entry.round),
        rms_before_um: f64 = entry.rms_before_um,
        holdout_rms_before_um: f64 = entry.holdout_rms_before_um,
        data_hash: &'a str = &book.data_hash,
        taken_back: bool = !book.accepted && 0 < entry.round.round,
        machine: &'a str = &entry.machine,
    }

    NotRunJson<'a>(why: &'a str) {
        not_run: &'a str = why,
    }

    DoneJson<'a>(check: &'a FinalCheck) {
        pass: f64 = check.pass,
        hunting_um: f64 = check.hunting_um,
        left_out: &'a [String] = &check.left_out,
        sensors: Vec<SensorJson> = check.sensors.iter().map(SensorJson::new).collect(),
    }

    SensorJson(one: &SensorCheck) {
        sensor: &'static str = sensor_column(one.sensor, false),
        samples: usize = one.samples,
        rms_before_um: f64 = one.before_um,
        rms_um: f64 = one.after_um,
    }
}

/// What became of the check in the closed loop.
#[derive(Serialize)]
#[serde(untagged)]
pub(crate) enum CheckJson<'a> {
    NotRun(NotRunJson<'a>),
    Done(DoneJson<'a>),
}

/// `None` where it was not asked for.
fn check_json(check: &Checked) -> Option<CheckJson<'_>> {
    match check {
        Checked::NotAsked => None,
        Checked::Impossible(why) => Some(CheckJson::NotRun(NotRunJson::new(why))),
        Checked::Done(check) => Some(CheckJson::Done(DoneJson::new(check))),
    }
}
