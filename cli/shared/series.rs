//! Columns of a file for the metrology commands, and the places of what they refuse.

use std::path::Path;

use anyhow::{Error as Refusal, anyhow};
use helixlock_metrology::Error;
use helixlock_traces::{At, Table, read_table};

use super::input::Input;

/// A table and the rows of it that count.
pub(crate) struct Series {
    table: Table,
    rows: Vec<usize>,
}

impl Series {
    /// Reads a file; with `pass`, the rows of that pass only.
    ///
    /// Several passes without a choice are refused: each has its own zero.
    pub(crate) fn read(path: &Path, pass: Option<f64>) -> anyhow::Result<Self> {
        let table = read_table(path)?;
        let rows = rows_of_pass(&table, pass)?;
        Ok(Self { table, rows })
    }

    /// Reads a file with all its rows.
    pub(crate) fn read_all(path: &Path) -> anyhow::Result<Self> {
        Self::all_of(Input::read(path)?)
    }

    /// All rows of a file.
    pub(crate) fn all_of(input: Input) -> anyhow::Result<Self> {
        let table = input.table()?;
        let rows = (0..table.rows()).collect();
        Ok(Self { table, rows })
    }

    /// A column that has to be there.
    pub(crate) fn column(&self, name: &str) -> anyhow::Result<Vec<f64>> {
        let values = self.table.require(name)?;
        Ok(self.rows.iter().map(|row| values[*row]).collect())
    }

    /// A column that may be there; one that is, and holds words, is refused with the first of them: what
    /// it says would be lost.
    pub(crate) fn optional(&self, name: &str) -> anyhow::Result<Option<Vec<f64>>> {
        if let Some(text) = self.table.text.iter().find(|text| text.name == name) {
            return Err(text.refused().into());
        }
        let Some(values) = self.table.column(name) else { return Ok(None) };
        Ok(Some(self.rows.iter().map(|row| values[*row]).collect()))
    }

    /// Names of all columns.
    pub(crate) fn names(&self) -> String {
        self.table.listed()
    }

    /// The file and line of a row.
    pub(crate) fn place(&self, row: usize) -> At {
        self.rows.get(row).map_or_else(|| At::file(&self.table.path), |row| self.table.at(*row))
    }

    /// What a library refused, with the file and the line it means.
    pub(crate) fn refused(&self, error: Error) -> Refusal {
        let row = match &error {
            Error::NotFinite { row, .. } | Error::TravelTurns { row, .. } => *row,
            _ => usize::MAX,
        };
        Refusal::new(error).context(self.place(row))
    }
}

fn rows_of_pass(table: &Table, pass: Option<f64>) -> anyhow::Result<Vec<usize>> {
    let refused = |why: Refusal| Err(why.context(At::file(&table.path)));
    if let Some(text) = table.text.iter().find(|text| text.name == "pass") {
        return Err(text.refused().into());
    }
    let Some(passes) = table.column("pass") else {
        return match pass {
            None => Ok((0..table.rows()).collect()),
            Some(_) => refused(anyhow!("no column `pass`, expected one to choose a pass from")),
        };
    };
    let mut known: Vec<f64> = passes.iter().copied().filter(|pass| !pass.is_nan()).collect();
    known.sort_by(f64::total_cmp);
    known.dedup();
    let list = || known.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    let wanted = match (pass, known.as_slice()) {
        (Some(pass), _) if known.contains(&pass) => pass,
        (Some(pass), _) => return refused(anyhow!("no pass {pass}, expected one of {}", list())),
        (None, [only]) => *only,
        (None, _) => {
            return refused(anyhow!(
                "{} passes, each with its own zero, expected a choice\nhint: `--pass` with one of {}",
                known.len(),
                list()
            ));
        }
    };
    let chosen = passes.iter().enumerate().filter(|(_, pass)| **pass <= wanted && wanted <= **pass);
    Ok(chosen.map(|(row, _)| row).collect())
}
