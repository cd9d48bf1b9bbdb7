//! What a page may ask, and who answers it.

use std::sync::{Arc, Mutex};

use anyhow::{Context, anyhow};
use helixlock_lab::fingerprint;
use helixlock_plant::MachineFile;
use helixlock_workbench::{Answer, Ask, Kind};
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};

use super::edit::{self, Setting, Text};
use super::folder::Folder;
use super::jobs::{Done, Job, Jobs, Order, held};
use super::ledger::{Pair, Seen, with_fitted, with_learned};
use super::measurement::{self, Dropped, Said};
use super::opened::{Cache, Opened, series};
use super::orders::{Subject, line, words};
use super::refusal::{Answered, Refusal, json};
use super::state::state;
use super::trial::{Moved, trial};
use super::{axes, said, spectrum, waves};
use crate::shared::output::recover;

/// Everything the pages work on.
#[derive(Debug)]
pub(crate) struct Workbench {
    folder: Folder,
    jobs: Jobs,
    cache: Cache,
    dropped: Dropped,
    /// Whoever changes files does so alone.
    writing: Mutex<()>,
}

#[derive(Deserialize)]
struct Refused {
    effect: String,
    reason: String,
}

#[derive(Deserialize)]
struct Mend {
    /// Lines of a recipe, or of the machine file's dividers.
    mend: String,
}

impl Workbench {
    /// A workbench over a folder, in which what was interrupted there is finished first.
    pub(crate) fn new(folder: Folder) -> anyhow::Result<Self> {
        folder.names().context("the folder cannot be read")?;
        recover(folder.root())?;
        let (jobs, cache, dropped) = (Jobs::default(), Cache::default(), Dropped::default());
        Ok(Self { folder, jobs, cache, dropped, writing: Mutex::default() })
    }

    /// Answers one ask.
    pub(crate) fn answer(&self, ask: &Ask) -> Answer {
        let answered = if ask.writes { self.write(ask) } else { self.read(ask) };
        answered.unwrap_or_else(Answer::from)
    }

    fn read(&self, ask: &Ask) -> Answered {
        match ask.what.as_str() {
            "state" => state(&self.folder, ask.words.get("machine").map(String::as_str)),
            "series" => series(&*self.opened(ask)?),
            "axes" => axes::strips(&*self.opened(ask)?, sensor(ask), &without(ask)),
            "axis" => {
                axes::curve(&*self.opened(ask)?, word(ask, "key")?, sensor(ask), &without(ask))
            }
            "spectrum" => spectrum::spectrum(&*self.opened(ask)?, sensor(ask)),
            "faster" => spectrum::faster(&self.opened(ask)?.problem),
            "templates" => edit::templates(),
            "catalogue" => said::catalogue(said::language(ask)),
            "trace" => waves::trace(&self.folder),
            "drafted" => waves::drafted(&self.done(ask)?.0),
            "waves" => waves::waves(&self.folder),
            "job" => self.job(ask).and_then(|(number, job)| json(&job.json(number))),
            "result" => self.done(ask).and_then(|(_, done)| printed(done)),
            other => Err(Refusal::Unknown(other.to_owned())),
        }
    }

    fn write(&self, ask: &Ask) -> Answered {
        match ask.what.as_str() {
            "begin" => self.begin(ask),
            "stop" => self.job(ask).and_then(|(number, job)| {
                job.stop();
                json(&job.json(number))
            }),
            "trial" => self.trial(ask),
            "said" => said::said(said::language(ask), &body(ask)?),
            "check" => edit::check(&self.folder, word(ask, "machine")?, &body::<Text>(ask)?.text),
            "dividers" => {
                edit::dividers(&self.folder, word(ask, "machine")?, &body::<Text>(ask)?.text)
            }
            "setting" => edit::set(&self.folder, word(ask, "machine")?, &body::<Setting>(ask)?),
            "drop" => self.dropped.take(word(ask, "name")?, ask.body.clone()),
            "reread" => self.dropped.read(&body::<Said>(ask)?),
            _ => {
                let alone = held(&self.writing);
                let answered = self.change(ask);
                drop(alone);
                answered
            }
        }
    }

    /// What writes files: only over those that the page was shown.
    fn change(&self, ask: &Ask) -> Answered {
        let shown = ask.words.get("revision").map_or("", String::as_str);
        let machine = ask.words.get("machine").map(String::as_str).filter(|name| !name.is_empty());
        let pair = machine.filter(|name| self.folder.has(name));
        let pair = pair.map(|name| Pair::read(&self.folder, name)).transpose()?;
        if pair.as_ref().map(Pair::revision).unwrap_or_default() != shown {
            return Err(Refusal::Changed);
        }
        match (ask.what.as_str(), pair) {
            ("save", _) => return self.dropped.save(&self.folder, &body(ask)?),
            ("machine", _) => {
                edit::write(&self.folder, word(ask, "machine")?, &body::<Text>(ask)?.text)?;
            }
            ("mend", Some(pair)) => return self.mend(ask, &pair),
            ("take", Some(pair)) => self.take(ask, &pair)?,
            ("undo", Some(pair)) => self.turn(&pair, super::rounds::Book::undo)?,
            ("redo", Some(pair)) => self.turn(&pair, super::rounds::Book::redo)?,
            ("refuse", Some(pair)) => {
                let Refused { effect, reason } = body(ask)?;
                let mut book = pair.current(&self.seen(ask)?)?;
                book.refuse(&effect, &reason);
                pair.write(&self.folder, &book, &pair.machine)?;
            }
            (other, _) => return Err(Refusal::Unknown(other.to_owned())),
        }
        state(&self.folder, machine)
    }

    fn opened(&self, ask: &Ask) -> Result<Arc<Opened>, Refusal> {
        self.cache.open(&self.folder, word(ask, "machine")?, word(ask, "data")?)
    }

    fn job(&self, ask: &Ask) -> Result<(u64, Arc<Job>), Refusal> {
        let name = word(ask, "job")?;
        let job = name.parse().ok().and_then(|number| Some((number, self.jobs.get(number)?)));
        job.ok_or_else(|| Refusal::Unknown(name.to_owned()))
    }

    fn done(&self, ask: &Ask) -> Result<(Arc<Job>, Done), Refusal> {
        let (_, job) = self.job(ask)?;
        let done = job.done().ok_or_else(|| anyhow!("this has not come to an end"))?;
        Ok((job, done))
    }

    /// Begins one of the commands that take long.
    fn begin(&self, ask: &Ask) -> Answered {
        let (command, machine) = (word(ask, "command")?, word(ask, "machine")?);
        let pair = Pair::read(&self.folder, machine)?;
        let simulates = matches!(command, "sim" | "draft");
        let data = if simulates { "" } else { word(ask, "data")? };
        if !data.is_empty() {
            self.folder.path(data)?;
        }
        let effect = if command == "add" { word(ask, "effect")? } else { "" };
        let file = MachineFile::parse(&pair.machine, &self.folder.path(machine)?)?;
        let keep = pair.own_effects(&file);
        let told = |name: &str| ask.words.get(name).map_or("", String::as_str);
        let (window, language) = (["from", "to"].map(told), told("language"));
        let subject = Subject { machine, data, effect, keep, window, language };
        let words = words(command, &subject)?;
        let draft = (command == "draft").then(|| body::<Text>(ask)).transpose()?;
        let line = line(&words, machine);
        let effect = Some(effect).filter(|effect| !effect.is_empty()).map(str::to_owned);
        let draft = draft.map(|draft| draft.text);
        let (machine, revision) = (machine.to_owned(), pair.revision());
        let order = Order { words, line, effect, revision, draft, machine };
        json(&self.jobs.begin(self.folder.root(), order)?)
    }

    /// The data after an effect that a job has fitted, its values moved or not.
    fn trial(&self, ask: &Ask) -> Answered {
        let (job, _) = self.done(ask)?;
        let path = job.scratch.path().join("machine.toml");
        trial(&*self.opened(ask)?, &MachineFile::read(&path)?, &body::<Moved>(ask)?)
    }

    /// What a round is said to have seen.
    fn seen(&self, ask: &Ask) -> Result<Seen, Refusal> {
        let data = word(ask, "data")?;
        let opened = self.opened(ask)?;
        Ok(Seen {
            title: opened.problem.model.title.clone(),
            unit: opened.problem.measurement.unit_word().to_owned(),
            data: data.to_owned(),
            data_hash: fingerprint(&self.folder.read(data)?),
            ..Seen::default()
        })
    }

    /// Puts what a job has found into the machine file and the ledger.
    fn take(&self, ask: &Ask, pair: &Pair) -> Result<(), Refusal> {
        let (job, done) = self.done(ask)?;
        if job.revision != pair.revision() {
            return Err(Refusal::Changed);
        }
        let seen = self.seen(ask)?;
        let found = match &job.effect {
            Some(_) => Some(with_fitted(pair, (&job, &done), &seen)?),
            None => with_learned(pair, &job, &seen)?,
        };
        if let Some((book, machine)) = found {
            pair.write(&self.folder, &book, &machine)?;
        }
        Ok(())
    }

    /// Back or forth by a round.
    fn turn(
        &self,
        pair: &Pair,
        turn: fn(&mut super::rounds::Book) -> Option<String>,
    ) -> Result<(), Refusal> {
        let mut book = pair.book()?.ok_or_else(|| anyhow!("there is no ledger yet"))?;
        if book.machine() != Some(&pair.machine) && book.can_undo() {
            book = pair.current(&Seen::default())?;
        }
        let machine = turn(&mut book).ok_or_else(|| anyhow!("no round is left for that"))?;
        Ok(pair.write(&self.folder, &book, &machine)?)
    }

    /// Puts right what looked mistaken: a column of the data, or dividers of the machine.
    fn mend(&self, ask: &Ask, pair: &Pair) -> Answered {
        let Mend { mend } = body(ask)?;
        if mend.starts_with("[[column]]") {
            return measurement::mend(&self.folder, word(ask, "data")?, &mend);
        }
        let setting = |line: &str| {
            let (key, value) = line.split_once(" = ")?;
            matches!(key, "a" | "b").then(|| (format!("dividers.{key}"), value.to_owned()))
        };
        let settings: Option<Vec<_>> = mend.lines().map(setting).collect();
        let settings = settings.ok_or_else(|| anyhow!("this mend is done by hand: {mend}"))?;
        let text = edit::with_settings(&self.folder, &pair.name, &settings)?;
        edit::write(&self.folder, &pair.name, &text)?;
        state(&self.folder, Some(&pair.name))
    }
}

/// A result as the command printed it; one that only says why there is none is a refusal.
fn printed(done: Done) -> Answered {
    if serde_json::from_slice::<IgnoredAny>(&done.said).is_err() {
        return Err(anyhow!("{}", String::from_utf8_lossy(&done.said).trim()).into());
    }
    Ok(Answer { status: 200, kind: Kind::Json, body: done.said })
}

fn word<'a>(ask: &'a Ask, name: &str) -> Result<&'a str, Refusal> {
    let word = ask.words.get(name).filter(|word| !word.is_empty() && !word.starts_with('-'));
    Ok(word.map(String::as_str).ok_or_else(|| anyhow!("found no `{name}`"))?)
}

fn body<T: DeserializeOwned>(ask: &Ask) -> Result<T, Refusal> {
    Ok(serde_json::from_slice(&ask.body).context("found no such JSON as expected")?)
}

fn sensor(ask: &Ask) -> usize {
    ask.words.get("sensor").and_then(|word| word.parse().ok()).unwrap_or(0)
}

/// Passes that are switched off.
fn without(ask: &Ask) -> Vec<f64> {
    let list = ask.words.get("without").map_or("", String::as_str);
    list.split(',').filter_map(|pass| pass.parse().ok()).collect()
}
