//! The ledger beside its machine file, and the two written together.

use helixlock_lab::fingerprint;
use helixlock_plant::MachineFile;
use serde_json::Value;

use super::folder::Folder;
use super::jobs::{Done, Job};
use super::refusal::Refusal;
use super::rounds::{Book, NewRound};
use crate::shared::angular::key_in;

/// A machine file and its ledger as they are on disk.
#[derive(Debug)]
pub(crate) struct Pair {
    /// Name of the machine file.
    pub(crate) name: String,
    /// Its text.
    pub(crate) machine: String,
    ledger_name: String,
    ledger: Option<String>,
}

impl Pair {
    /// Reads both; there may be no ledger yet.
    pub(crate) fn read(folder: &Folder, name: &str) -> anyhow::Result<Self> {
        let ledger_name = match name.strip_suffix(".toml") {
            Some("machine") | None => "ledger.json".to_owned(),
            Some(other) => format!("{other}.ledger.json"),
        };
        let machine = folder.text(name)?;
        let has = folder.has(&ledger_name);
        let ledger = if has { Some(folder.text(&ledger_name)?) } else { None };
        Ok(Self { name: name.to_owned(), machine, ledger_name, ledger })
    }

    /// What tells whether either has changed since a page was shown them.
    pub(crate) fn revision(&self) -> String {
        let ledger = self.ledger.as_deref().unwrap_or_default();
        fingerprint(format!("{}\0{}\0{ledger}", self.name, self.machine).as_bytes())
    }

    /// The ledger, if there is one.
    pub(crate) fn book(&self) -> anyhow::Result<Option<Book>> {
        self.ledger.as_ref().map(|text| Book::parse(text, &self.ledger_name)).transpose()
    }

    /// How many effects the machine file had before anything was learned.
    pub(crate) fn own_effects(&self, file: &MachineFile) -> usize {
        let now = file.model.effects.len();
        let book = self.book().ok().flatten();
        let first = book.as_ref().and_then(Book::first_machine).unwrap_or(&self.machine);
        let path = std::path::Path::new(&self.name);
        let first = MachineFile::parse(first, path).map(|first| first.model.effects.len());
        first.map_or(now, |first| first.min(now))
    }

    /// Writes both: the ledger first, which alone can restore the other.
    pub(crate) fn write(&self, folder: &Folder, book: &Book, machine: &str) -> anyhow::Result<()> {
        let text = book.text()?;
        folder.write(&[(&self.ledger_name, text.as_bytes()), (&self.name, machine.as_bytes())])
    }

    /// The ledger with the machine file as it is now for its last round, whoever has changed it.
    pub(crate) fn current(&self, seen: &Seen) -> Result<Book, Refusal> {
        let mut book = self
            .book()?
            .unwrap_or_else(|| Book::new(&seen.title, &seen.unit, &seen.data, &seen.data_hash));
        if book.machine() == Some(&self.machine) {
            book.size([seen.rms_um, seen.holdout_rms_um], &seen.data_hash);
        } else {
            book.push(NewRound {
                rms_um: seen.rms_um,
                holdout_rms_um: seen.holdout_rms_um,
                rms_before_um: seen.rms_um,
                holdout_rms_before_um: seen.holdout_rms_um,
                data_hash: seen.data_hash.clone(),
                machine: self.machine.clone(),
                ..NewRound::default()
            })?;
        }
        Ok(book)
    }
}

/// What a round is said to have seen.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    pub(crate) title: String,
    pub(crate) unit: String,
    pub(crate) data: String,
    pub(crate) data_hash: String,
    pub(crate) rms_um: Option<f64>,
    pub(crate) holdout_rms_um: Option<f64>,
}

/// The ledger and the machine file after the effect that a job has fitted.
pub(crate) fn with_fitted(
    pair: &Pair,
    (job, done): (&Job, &Done),
    seen: &Seen,
) -> Result<(Book, String), Refusal> {
    let added: Value = serde_json::from_slice(&done.said)?;
    let machine = std::fs::read_to_string(job.scratch.path().join("machine.toml"))?;
    let number = |key: &str| added[key_in(key, &seen.unit)].as_f64();
    let before = Seen {
        rms_um: number("rms_before_um"),
        holdout_rms_um: number("holdout_rms_before_um"),
        ..seen.clone()
    };
    let mut book = pair.current(&before)?;
    let last = added["effects"].as_array().and_then(|all| all.last()).cloned().unwrap_or_default();
    book.push(NewRound {
        added: job.effect.clone(),
        rms_um: number("rms_um"),
        holdout_rms_um: number("holdout_rms_um"),
        rms_before_um: before.rms_um,
        holdout_rms_before_um: before.holdout_rms_um,
        parameters: last["parameters"].clone(),
        model: added["effects"].clone(),
        data_hash: seen.data_hash.clone(),
        machine: machine.clone(),
        ..NewRound::default()
    })?;
    book.saw(&seen.data, &seen.data_hash);
    Ok((book, machine))
}

/// The same after a whole `learn`; nothing where that would not write the machine file itself.
pub(crate) fn with_learned(
    pair: &Pair,
    job: &Job,
    seen: &Seen,
) -> Result<Option<(Book, String)>, Refusal> {
    let read = |name: &str| std::fs::read_to_string(job.scratch.path().join(name));
    let learned = Book::parse(&read("ledger.json")?, "ledger.json")?;
    if learned.value()["accepted"] != true {
        return Ok(None);
    }
    let machine = read("machine.toml")?;
    if pair.book()?.is_none() {
        return Ok(Some((learned, machine)));
    }
    let first = learned.rounds().first();
    let number = |key: &str| first.and_then(|round| round[key_in(key, &seen.unit)].as_f64());
    let before =
        Seen { rms_um: number("rms_um"), holdout_rms_um: number("holdout_rms_um"), ..seen.clone() };
    let mut book = pair.current(&before)?;
    for round in learned.rounds().iter().skip(1) {
        book.push_value(round.clone());
    }
    book.saw(&seen.data, &seen.data_hash);
    Ok(Some((book, machine)))
}
