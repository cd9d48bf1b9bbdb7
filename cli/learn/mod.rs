//! `helixlock learn`: compare, name, add, until nothing significant is left.

mod closed_loop_check;
mod closed_loop_pictures;
mod json;
mod kept;
mod undone_page;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::Args;
use helixlock_lab::{Diagnosis, Ledger, Problem, Verdict, diagnose, fingerprint, ledger, written};
use helixlock_plant::MachineFile;
use helixlock_report::Page;
use helixlock_traces::{LONGEST_BYTES, read_bytes};
use serde_json::Value;

use self::closed_loop_check::Checked;
use self::closed_loop_pictures::closed_loop;
use self::json::{LearnJson, LedgerJson};
use self::kept::{edited_aside, is_taken_back, keep_aside};
use crate::shared::angular::in_unit;
use crate::shared::answer::{Answer, Answering};
use crate::shared::captured::Signals;
use crate::shared::effect_file::own_effects;
use crate::shared::input::{Input, machine_files};
use crate::shared::language::Reporter;
use crate::shared::next::Next;
use crate::shared::output::{self, Batch, Written, print_json};
use crate::shared::residual_table::residual_table;
use crate::shared::words::status;
use crate::shared::{diagnosis_page, diagnosis_text, measured};

/// Name of the ledger in its folder.
const LEDGER: &str = "ledger.json";
/// Name of the machine file in its folder.
const MACHINE: &str = "machine.toml";

/// Find what a machine file lacks and write the better file, its ledger and a report
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a switch of the command line")]
pub(crate) struct Learn {
    /// Machine file
    #[arg(required_unless_present = "undo")]
    machine: Option<PathBuf>,
    /// Measured data
    #[arg(required_unless_present = "undo")]
    data: Option<PathBuf>,
    /// Folder for `machine.toml`, `ledger.json` and `report.html`
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// TOML file with custom effects to try beside the catalogue
    #[arg(long = "with", visible_alias = "custom", value_name = "EFFECTS")]
    custom: Option<PathBuf>,
    /// Add what was found even if others explain it alike, or something is left that none accounts for
    #[arg(long)]
    accept: bool,
    /// Let the new machine file replace the old one
    #[arg(long, requires = "output")]
    force: bool,
    /// Take the last round in the folder's ledger back
    #[arg(long, requires = "output", conflicts_with_all = ["machine", "data"])]
    undo: bool,
    #[command(flatten)]
    signals: Signals,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Learn {
    /// Writes the folder; exit status 1 when the input itself is doubted, else 0.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        match (&self.machine, &self.data, &self.output) {
            (Some(machine), Some(data), folder) => {
                self.learn(machine, data, folder.as_deref(), out)
            }
            (_, _, Some(folder)) => undo(folder, out),
            _ => bail!("found no folder, expected `-o DIR`"),
        }
    }

    fn learn(
        &self,
        machine: &Path,
        data: &Path,
        folder: Option<&Path>,
        out: &mut impl Reporter,
    ) -> anyhow::Result<ExitCode> {
        let learned = self.learned(machine, data)?;
        let Learned { problem, diagnosis, check, book, .. } = &learned;
        let (mut kept, mut written) = (None, Written::default());
        if let Some(folder) = folder {
            let page = diagnosis_page::page(problem, diagnosis, closed_loop(check));
            let mut inputs = machine_files(machine, &learned.file.model);
            if self.force {
                inputs.remove(0);
            }
            inputs.extend(self.custom.iter().cloned().chain([data.to_owned()]));
            let mut files = Batch::new(folder, inputs)?.in_language(out.language());
            kept = keep_aside(&mut files, &[learned.machine(), &learned.text])?;
            written = write_folder(files, learned.machine(), &learned.ledger(data)?, &page)?;
        }
        if self.json {
            let json = LearnJson::new(diagnosis, book, check, problem);
            print_json(out, &in_unit(&json, problem.measurement.unit_word())?)?;
        } else {
            diagnosis_text::print(out, diagnosis, &problem.measurement)?;
            check.print(out)?;
            print_offer(out, book)?;
            written.print(out)?;
            write!(out, "{}", kept::note(kept.as_deref()))?;
            self.print_next([machine, data], &learned, out)?;
        }
        Ok(status(diagnosis.verdict))
    }

    /// What was written is held against the data; where no name fits, a formula may.
    fn print_next(
        &self,
        [machine, data]: [&Path; 2],
        learned: &Learned,
        out: &mut impl Write,
    ) -> anyhow::Result<()> {
        let better = self.output.as_ref().map(|folder| folder.join(MACHINE));
        let next = |command, machine| {
            Next::command(command).words([machine, data]).words(self.signals.words())
        };
        let offered = !learned.book.accepted;
        match (learned.diagnosis.verdict, &better) {
            (Verdict::NothingMissing | Verdict::DoubtfulInput, _) => Ok(()),
            (Verdict::Unexplained, _) if offered => {
                next("discover", machine).output("proposed.toml").print(out)
            }
            (Verdict::Ambiguous, _) if offered => {
                next("learn", machine).words(["--accept"]).output("learned").print(out)
            }
            (_, Some(better)) => next("compare", better.as_path()).print(out),
            (_, None) => next("learn", machine).output("learned").print(out),
        }
    }

    fn learned(&self, machine: &Path, data: &Path) -> anyhow::Result<Learned> {
        let (file, text) = MachineFile::read_with_text(machine)?;
        let input = Input::read(data)?;
        let data_hash = fingerprint(input.bytes());
        let mut problem = measured::problem(&file.model, data, input, &self.signals)?;
        if let Some(custom) = &self.custom {
            problem.extra = own_effects(&file, custom)?;
        }
        let diagnosis = diagnose(&problem);
        let check = checked(&file, &problem, &diagnosis)?;
        let book =
            Ledger { accepted: self.accepts(&diagnosis), ..ledger(&file, &diagnosis, data_hash)? };
        Ok(Learned { file, text, problem, diagnosis, check, book })
    }

    /// Whether what was found goes into the machine file: not where other effects explain it alike, nor
    /// beside something unexplained, unless the user says so, and never on doubtful input.
    fn accepts(&self, diagnosis: &Diagnosis) -> bool {
        match diagnosis.verdict {
            Verdict::Ambiguous | Verdict::Unexplained => self.accept,
            Verdict::DoubtfulInput => false,
            _ => true,
        }
    }
}

/// All that was learned of a machine.
struct Learned {
    file: MachineFile,
    /// The machine file as it was.
    text: String,
    problem: Problem,
    diagnosis: Diagnosis,
    check: Checked,
    book: Ledger,
}

impl Learned {
    /// The machine file as it is to be.
    fn machine(&self) -> &str {
        let last = self.book.entries.last().filter(|_| self.book.accepted);
        last.map_or(&self.text, |last| &last.machine)
    }

    fn ledger(&self, data: &Path) -> anyhow::Result<Value> {
        let json = LedgerJson::new(data, &self.diagnosis, &self.book, &self.check, &self.problem);
        in_unit(&json, self.problem.measurement.unit_word())
    }
}

impl Answering for Learn {
    /// With the texts `machine` and `ledger`, and the table `residual` of before and after.
    fn answer(&self) -> anyhow::Result<Answer> {
        let (Some(machine), Some(data)) = (&self.machine, &self.data) else {
            bail!("found no machine file and data, expected both");
        };
        let learned = self.learned(machine, data)?;
        let Learned { problem, diagnosis, check, book, .. } = &learned;
        let json = LearnJson::new(diagnosis, book, check, problem);
        let residual =
            residual_table(problem, &[("before", &diagnosis.before), ("after", &diagnosis.left)]);
        Ok(Answer::in_unit(&json, problem.measurement.unit_word())?
            .with_table("residual", residual)
            .with_text("machine", learned.machine().to_owned())
            .with_text("ledger", serde_json::to_string_pretty(&learned.ledger(data)?)? + "\n"))
    }
}

/// Effects that were found and not added.
fn print_offer(out: &mut impl Write, book: &Ledger) -> anyhow::Result<()> {
    let last = book.entries.last().filter(|_| !book.accepted);
    let effects = last.map_or(&[][..], |last| &last.round.effects);
    let names: Vec<&str> = effects.iter().map(|effect| effect.name.as_str()).collect();
    if !names.is_empty() {
        writeln!(out, "offered, not added: {} (`--accept` adds them)", names.join(", "))?;
    }
    Ok(())
}

fn write_folder(
    mut files: Batch,
    learned: &str,
    json: &Value,
    page: &Page,
) -> anyhow::Result<Written> {
    files.write_json(LEDGER, json)?;
    files.write_content(MACHINE, learned)?;
    files.write_page(page)?;
    files.kept()
}

/// The learned machine in the closed loop, where the machine file says that the loop is closed.
fn checked(
    file: &MachineFile,
    problem: &Problem,
    diagnosis: &Diagnosis,
) -> anyhow::Result<Checked> {
    let learned = match diagnosis.rounds.last() {
        Some(last) => written(file, &last.effects)?,
        None => file.clone(),
    };
    Ok(Checked::run(problem, &file.model, &learned.model))
}

fn read_ledger(path: &Path) -> anyhow::Result<Value> {
    let bytes = read_bytes(path, LONGEST_BYTES)?;
    serde_json::from_slice(&bytes)
        .with_context(|| format!("{}: found no ledger, expected one of `learn`", path.display()))
}

/// Goes back to the machine file before the last round that still stands.
fn undo(folder: &Path, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
    output::recover(folder)?;
    let path = folder.join(LEDGER);
    let mut book = read_ledger(&path)?;
    let Some(rounds) = book.get_mut("rounds").and_then(Value::as_array_mut) else {
        bail!("{}: found no `rounds`, expected a ledger of `learn`", path.display());
    };
    let mut left: Vec<&mut Value> =
        rounds.iter_mut().filter(|round| !is_taken_back(round)).collect();
    let (Some(last), Some(before)) = (left.pop(), left.pop()) else {
        writeln!(out, "no round is left to take back")?;
        return Ok(ExitCode::from(1));
    };
    let Some(machine) = before.get("machine").and_then(Value::as_str).map(str::to_owned) else {
        bail!("{}: found a round without `machine`, expected its machine file", path.display());
    };
    last["taken_back"] = Value::from(true);
    let added = last["added"].as_str().unwrap_or("nothing").to_owned();
    let mut files = Batch::new(folder, [])?.in_language(out.language());
    let kept = edited_aside(&mut files)?;
    files.write_json(LEDGER, &book)?;
    files.write_content(MACHINE, machine)?;
    files.write_page(&undone_page::page(&book))?;
    files.keep()?;
    write!(out, "{}", kept::note(kept.as_deref()))?;
    writeln!(out, "{added} taken back")?;
    if let Some(data) = book.get("data").and_then(Value::as_str) {
        let machine = folder.join(MACHINE);

        Next::command("diagnose").words([machine.as_path(), data.as_ref()]).print(out)?;
    }
    Ok(ExitCode::SUCCESS)
}
