//! Cases that do not know of each other: worked out all, or a part on one machine of many, into one
//! table, of which an interruption takes nothing.

mod journal;
mod parts;

use std::io::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;

use anyhow::{Context, anyhow, bail};
use helixlock_lab::fnv1a64;
use helixlock_traces::csv::write_csv;
use helixlock_traces::parquet::write_parquet;
use helixlock_traces::table::{Column, Table};

use self::journal::{Journal, path_beside};
use super::output::{apart, make_folder, write_whole};
use super::progress;

pub(crate) use self::journal::Row;
pub(crate) use self::parts::{PartName, Shard};

/// What a command makes of the table of its cases: the same of a table that was merged.
pub(crate) struct Campaign {
    /// What the cases are, as in `20 flips`.
    pub(crate) word: &'static str,
    /// Writes the table as CSV.
    pub(crate) write_csv: fn(&Table, &mut dyn Write) -> anyhow::Result<()>,
    /// Prints what it says.
    pub(crate) print: fn(&Table, &mut dyn Write) -> anyhow::Result<ExitCode>,
}

/// The cases of one run.
pub(crate) struct Cases {
    pub(crate) campaign: &'static Campaign,
    /// How many there are in all parts.
    pub(crate) number: u64,
    pub(crate) shard: Option<Shard>,
    /// Names of the cells of a row.
    pub(crate) columns: Vec<String>,
    /// All that has to agree for cases of equal number to be the same, but for the version.
    pub(crate) identity: String,
    /// What the command has read.
    pub(crate) inputs: Vec<PathBuf>,
}

/// Cases that were worked out.
pub(crate) struct Worked {
    pub(crate) rows: Vec<Row>,
    pub(crate) table: Table,
    /// The file of the table, and how many of its cases were there already.
    pub(crate) file: Option<(PathBuf, usize)>,
}

/// Takes a case, from any thread.
pub(crate) type Keep<'a> = &'a (dyn Fn(Row) -> anyhow::Result<()> + Sync);

impl Cases {
    /// Those of this part.
    pub(crate) fn range(&self) -> Range<u64> {
        self.shard.map_or(0..self.number, |shard| shard.cases(self.number))
    }

    /// Works out what the journal of the output lacks, and writes the table of all; without an
    /// output the table is in memory only.
    ///
    /// `work` gets the numbers of the cases that are missing, in order.
    pub(crate) fn work_out(
        &self,
        output: Option<&Path>,
        work: impl FnOnce(&[u64], Keep) -> anyhow::Result<()>,
    ) -> anyhow::Result<Worked> {
        let target = self.target(output)?;
        let journal = match &target {
            Some((path, _)) => Journal::open(path, &self.head(), self.columns.len())?,
            None => Journal::default(),
        };
        let done = journal.rows.len();
        let rows = self.run_missing(journal, work)?;
        let table = self.table(&rows);
        if let Some((path, format)) = &target {
            self.campaign.write(path, *format, self.inputs.clone(), &table)?;
        }
        Ok(Worked { rows, table, file: target.map(|(path, _)| (path, done)) })
    }

    fn run_missing(
        &self,
        journal: Journal,
        work: impl FnOnce(&[u64], Keep) -> anyhow::Result<()>,
    ) -> anyhow::Result<Vec<Row>> {
        let lost = || anyhow!("another case has failed");
        let range = self.range();
        let bar = progress::bar(range.end - range.start, self.campaign.word);
        bar.set_position(journal.rows.len() as u64);
        let missing: Vec<u64> = range.filter(|case| !journal.has(*case)).collect();
        let journal = Mutex::new(journal);
        work(&missing, &|row| {
            bar.inc(1);
            journal.lock().map_err(|_| lost())?.append(row)
        })?;
        bar.finish_and_clear();
        let mut rows = journal.into_inner().map_err(|_| lost())?.rows;
        rows.sort_by_key(|row| row.case);
        Ok(rows)
    }

    /// Where the table goes, and how.
    fn target(&self, output: Option<&Path>) -> anyhow::Result<Option<(PathBuf, Format)>> {
        match (output, self.shard) {
            (Some(output), None) => Ok(Some((output.to_owned(), Format::of(output)?))),
            (Some(folder), Some(shard)) => {
                if self.number < shard.of {
                    let Self { number, campaign: Campaign { word, .. }, .. } = self;
                    bail!(
                        "`--shard`: {} parts of {number} {word}, expected one for each part at \
                         least",
                        shard.of
                    );
                }
                make_folder(folder)?;
                let word = self.campaign.word.to_owned();
                let (cases, fingerprint) = (self.number, self.fingerprint());
                let part = PartName { shard, cases, word, fingerprint };
                Ok(Some((folder.join(part.to_string()), Format::Parquet)))
            }
            (None, Some(_)) => bail!("`--shard`: no folder of the parts, expected `-o DIR`"),
            (None, None) => Ok(None),
        }
    }

    fn head(&self) -> String {
        format!("{} {:016x}", self.campaign.word, self.fingerprint())
    }

    /// Of the version and the identity.
    fn fingerprint(&self) -> u64 {
        fnv1a64(format!("{}\n{}", env!("CARGO_PKG_VERSION"), self.identity).as_bytes())
    }

    #[expect(clippy::cast_precision_loss, reason = "fewer than 2⁵³ cases")]
    fn table(&self, rows: &[Row]) -> Table {
        let numbers = rows.iter().map(|row| row.case as f64).collect();
        let cells = self.columns.iter().enumerate().map(|(place, name)| {
            Column::new(name.clone(), rows.iter().map(|row| row.cells[place]).collect())
        });
        Table::new(std::iter::once(Column::new("case", numbers)).chain(cells).collect())
    }
}

/// Refuses outputs of a command that would replace its table of cases, the journal of that, or one
/// another.
pub(crate) fn apart_from_cases<const N: usize>(
    table: Option<&Path>,
    others: [(&str, Option<&Path>); N],
) -> anyhow::Result<()> {
    let known =
        [("`-o`", table.map(Path::to_owned)), ("the journal of `-o`", table.map(path_beside))];
    let others = others.map(|(option, path)| (option, path.map(Path::to_owned)));
    apart(known.into_iter().chain(others))
}

impl Worked {
    /// Says where the table is and how much of it was worked out now.
    pub(crate) fn print(&self, campaign: &Campaign, out: &mut dyn Write) -> anyhow::Result<()> {
        if let Some((path, resumed)) = &self.file {
            let (cases, word) = (self.rows.len(), campaign.word);
            let done = cases - resumed;
            writeln!(out, "{}: {cases} {word}, {done} of them run now", path.display())?;
        }
        Ok(())
    }
}

/// Cells of every row of a table of cases, without the number of the case.
pub(crate) fn cells(table: &Table) -> impl Iterator<Item = Vec<f64>> {
    let columns = table.columns.get(1..).unwrap_or_default();
    (0..table.rows()).map(move |row| columns.iter().map(|column| column.values[row]).collect())
}

/// The CSV of cases that are nothing but numbers.
pub(crate) fn write_numbers(table: &Table, mut file: &mut dyn Write) -> anyhow::Result<()> {
    Ok(write_csv(table, &mut file)?)
}

/// What a name's ending asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Csv,
    Parquet,
}

impl Format {
    /// By the ending of a name.
    pub(crate) fn of(path: &Path) -> anyhow::Result<Self> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("csv") => Ok(Self::Csv),
            Some("parquet") => Ok(Self::Parquet),
            _ => bail!("{}: expected a name in .csv or .parquet", path.display()),
        }
    }
}

impl Campaign {
    /// Writes the table of the cases; `inputs` is what the command has read.
    pub(crate) fn write(
        &self,
        path: &Path,
        format: Format,
        inputs: impl IntoIterator<Item = PathBuf>,
        table: &Table,
    ) -> anyhow::Result<()> {
        write_whole(path, inputs, |file| match format {
            Format::Csv => (self.write_csv)(table, file),
            Format::Parquet => {
                let mut bytes = Vec::new();
                write_parquet(table, &mut bytes)?;
                file.write_all(&bytes).context("cannot be written")
            }
        })
    }
}
