//! Long work: the command itself, run in the folder, which can be watched and stopped.
//!
//! What a page shows of it is therefore what the command line prints, to the byte.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Instant;

use anyhow::Context;
use serde::Serialize;
use tempfile::TempDir;

use super::orders::{DRAFT, SCRATCH};
use crate::shared::output::write_content;

/// All work that was begun.
#[derive(Debug, Default)]
pub(crate) struct Jobs {
    all: Mutex<BTreeMap<u64, Arc<Job>>>,
}

/// One piece of work.
#[derive(Debug)]
pub(crate) struct Job {
    /// What would be typed to do the same.
    line: String,
    /// The effect that it fits, if it does.
    pub(crate) effect: Option<String>,
    /// State of the files when it began.
    pub(crate) revision: String,
    /// What it writes goes here, until it is taken.
    pub(crate) scratch: TempDir,
    begun: Instant,
    child: Mutex<Child>,
    done: Mutex<Option<Done>>,
}

/// How it ended.
#[derive(Clone, Debug)]
pub(crate) struct Done {
    status: Option<i32>,
    seconds: f64,
    /// What it printed.
    pub(crate) said: Vec<u8>,
    wrong: String,
}

/// What to run.
#[derive(Debug)]
pub(crate) struct Order {
    /// Words behind `helixlock`; `SCRATCH` stands for a folder that is thrown away.
    pub(crate) words: Vec<String>,
    /// What a user would type.
    pub(crate) line: String,
    /// See [`Job`].
    pub(crate) effect: Option<String>,
    /// See [`Job`].
    pub(crate) revision: String,
    /// Text of a machine file that is not saved: `DRAFT` in the folder that is thrown away.
    pub(crate) draft: Option<String>,
    /// Name of that machine file in the folder.
    pub(crate) machine: String,
}

/// How a job stands.
#[derive(Serialize)]
pub(crate) struct JobJson {
    job: u64,
    line: String,
    running: bool,
    seconds: f64,
    status: Option<i32>,
    error: Option<String>,
}

/// Work that is not looked at any more is forgotten, oldest first.
const KEPT: usize = 24;

impl Jobs {
    /// Begins.
    pub(crate) fn begin(&self, root: &Path, order: Order) -> anyhow::Result<JobJson> {
        let scratch = tempfile::tempdir().context("no folder for temporary files")?;
        if let Some(draft) = &order.draft {
            write_content(&scratch.path().join(DRAFT), [], draft)?;
        }
        let place = scratch.path().display().to_string();
        let words = order.words.iter().map(|word| word.replace(SCRATCH, &place));
        let mut child = Command::new(std::env::current_exe()?)
            .args(words)
            .current_dir(root)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .context("the command cannot be started")?;
        let (said, wrong) = (reader(child.stdout.take()), reader(child.stderr.take()));
        let Order { line, effect, revision, machine, .. } = order;
        let draft = scratch.path().join(DRAFT).display().to_string();
        let (begun, done) = (Instant::now(), Mutex::default());
        let child = Mutex::new(child);
        let job = Arc::new(Job { line, effect, revision, scratch, begun, child, done });
        std::thread::spawn({
            let job = Arc::clone(&job);
            move || job.finish(said, wrong, |text| text.replace(&draft, &machine))
        });
        let mut all = held(&self.all);
        let number = all.keys().last().map_or(1, |last| last + 1);
        all.insert(number, job);
        while KEPT < all.len() {
            all.pop_first().inspect(|(_, job)| job.stop());
        }
        let job = Arc::clone(&all[&number]);
        Ok(job.json(number))
    }

    /// The job of a number.
    pub(crate) fn get(&self, number: u64) -> Option<Arc<Job>> {
        held(&self.all).get(&number).cloned()
    }
}

impl Job {
    /// Waits for the end; `named` gives files the names that users know.
    fn finish(
        &self,
        said: JoinHandle<Vec<u8>>,
        wrong: JoinHandle<Vec<u8>>,
        named: impl Fn(&str) -> String,
    ) {
        let said = said.join().unwrap_or_default();
        let wrong = wrong.join().unwrap_or_default();
        let status = held(&self.child).wait().ok().and_then(|status| status.code());
        let wrong = named(String::from_utf8_lossy(&wrong).trim());
        let seconds = self.begun.elapsed().as_secs_f64();
        *held(&self.done) = Some(Done { status, seconds, said, wrong });
    }

    /// Ends it at once.
    pub(crate) fn stop(&self) {
        // One that has ended cannot be killed, and need not be.
        let _ = held(&self.child).kill();
    }

    /// What came out, once it has ended with an answer: status 0, or 1 where the answer is no.
    pub(crate) fn done(&self) -> Option<Done> {
        held(&self.done).clone().filter(|done| matches!(done.status, Some(0 | 1)))
    }

    /// How it stands.
    pub(crate) fn json(&self, job: u64) -> JobJson {
        let done = held(&self.done).clone();
        let error = done.as_ref().and_then(|done| match done.status {
            Some(0 | 1) => None,
            None => Some("stopped".to_owned()),
            Some(_) => Some(done.wrong.clone()),
        });
        JobJson {
            job,
            line: self.line.clone(),
            running: done.is_none(),
            seconds: done
                .as_ref()
                .map_or_else(|| self.begun.elapsed().as_secs_f64(), |d| d.seconds),
            status: done.and_then(|done| done.status),
            error,
        }
    }
}

impl Drop for Job {
    fn drop(&mut self) {
        self.stop();
    }
}

/// Reads a pipe to its end beside everything else, so that the child never waits for us.
fn reader(pipe: Option<impl Read + Send + 'static>) -> JoinHandle<Vec<u8>> {
    std::thread::spawn(move || {
        let mut bytes = Vec::new();
        // A pipe that breaks has said what it had to say.
        let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut bytes));
        bytes
    })
}

/// A lock, also after a thread that held it has panicked: what it guards is whole at any moment.
pub(crate) fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}
