//! What a run has done so far, line by line, so that it can go on after an interruption and is not
//! done twice.
//!
//! The first line says of which run it is; every other is a case. A line cut off in the middle does
//! not count.

use std::fs::{File, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

use super::super::output::open_to_append;

/// Stands before the reason of a case that could not be run.
const FAILURE: &str = " # ";

/// One case.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) case: u64,
    pub(crate) cells: Vec<f64>,
    /// Why it could not be run.
    pub(crate) failure: Option<String>,
}

/// The file beside the results, if they go to one, and the rows in it.
#[derive(Debug, Default)]
pub(super) struct Journal {
    file: Option<(File, PathBuf)>,
    pub(super) rows: Vec<Row>,
}

impl Journal {
    /// Opens the journal of the results `output`, or begins one; `head` tells runs apart.
    pub(super) fn open(output: &Path, head: &str, width: usize) -> anyhow::Result<Self> {
        let path = path_beside(output);
        let mut file = open_to_append(&path)?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            bail!("{}: another run is writing it, expected one at a time", path.display());
        }
        let mut text = String::new();
        file.read_to_string(&mut text).with_context(|| path.display().to_string())?;
        let head = format!("# helixlock {head}\n");
        // A head cut off in the middle is that of a run which has done nothing.
        let whole = text.rfind('\n').map_or(0, |end| end + 1);
        if whole != 0 && !text.starts_with(&head) {
            bail!(
                "{}: is of another machine file or other values, expected those of this run\n\
                 remove it to begin anew, or choose another output",
                path.display()
            );
        }
        file.set_len(whole as u64).with_context(|| path.display().to_string())?;
        let mut journal = Self { file: Some((file, path)), rows: Vec::new() };
        if whole == 0 {
            journal.write(&head)?;
        }
        journal.rows = text[..whole].lines().skip(1).filter_map(|line| row(line, width)).collect();
        journal.rows.sort_by_key(|row| row.case);
        journal.rows.dedup_by_key(|row| row.case);
        Ok(journal)
    }

    /// True when a case of those found at opening is done.
    pub(super) fn has(&self, case: u64) -> bool {
        self.rows.binary_search_by_key(&case, |row| row.case).is_ok()
    }

    /// Adds a case, on disk first.
    pub(super) fn append(&mut self, row: Row) -> anyhow::Result<()> {
        let cells: Vec<String> = row.cells.iter().map(f64::to_string).collect();
        let failure = match &row.failure {
            Some(reason) => format!("{FAILURE}{}", serde_json::to_string(reason)?),
            None => String::new(),
        };
        self.write(&format!("{},{}{failure}\n", row.case, cells.join(",")))?;
        self.rows.push(row);
        Ok(())
    }

    fn write(&mut self, line: &str) -> anyhow::Result<()> {
        let Some((file, path)) = &mut self.file else {
            return Ok(());
        };
        let write = file.write_all(line.as_bytes()).and_then(|()| file.flush());
        write.with_context(|| format!("{}: cannot be written", path.display()))
    }
}

/// Name of the journal of some results.
pub(super) fn path_beside(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".journal");
    name.into()
}

fn row(line: &str, width: usize) -> Option<Row> {
    let (line, failure) = match line.split_once(FAILURE) {
        Some((line, text)) => (line, Some(serde_json::from_str(text).ok()?)),
        None => (line, None),
    };
    let (case, cells) = line.split_once(',')?;
    let cells: Vec<f64> = cells.split(',').map(|cell| cell.parse().ok()).collect::<Option<_>>()?;
    (cells.len() == width).then_some(Row { case: case.parse().ok()?, cells, failure })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(case: u64) -> Row {
        Row { case, cells: vec![0.1, f64::NAN], failure: Some("no\nway".into()) }
    }

    #[test]
    fn a_cut_line_is_run_again_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("out.csv");
        let mut journal = Journal::open(&output, "cases 1", 2).unwrap();
        journal.append(row(3)).unwrap();
        journal.append(row(1)).unwrap();
        journal.write("2,0.1").unwrap();
        drop(journal);
        let mut journal = Journal::open(&output, "cases 1", 2).unwrap();
        assert_eq!([1, 2, 3].map(|case| journal.has(case)), [true, false, true]);
        journal.append(row(2)).unwrap();
        drop(journal);
        let journal = Journal::open(&output, "cases 1", 2).unwrap();
        assert_eq!(journal.rows.iter().map(|row| row.case).collect::<Vec<_>>(), [1, 2, 3]);
        assert!(journal.rows.iter().all(|row| row.cells[1].is_nan()));
        assert!(journal.rows.iter().all(|row| row.failure.as_deref() == Some("no\nway")));
    }

    #[test]
    fn another_run_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("out.csv");
        drop(Journal::open(&output, "cases 1", 2).unwrap());
        let error = Journal::open(&output, "cases 2", 2).unwrap_err().to_string();
        assert!(error.contains("is of another machine file"), "{error}");
    }
}
