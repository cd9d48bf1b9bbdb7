//! `helixlock merge`: one table of the parts that many machines worked out.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, anyhow, bail, ensure};
use clap::Args;
use helixlock_traces::read_table;
use helixlock_traces::table::Table;

use crate::shared::cases::{Campaign, Format, PartName, Shard};

/// Most places a message names.
const NAMED: usize = 10;

/// Join the parts that `sweep`, `challenge`, `faults` or `certify` with `--shard` have written
///
/// All parts have to be there, of one run: of the same version, machine file, values and options,
/// cut into as many parts. The result is what a single run writes, byte by byte, and what it prints.
/// Exit status 1: some cases could not be run, as for a single one.
#[derive(Debug, Args)]
pub(crate) struct Merge {
    /// Folder of the parts
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// Results, one row a case: `.csv` or `.parquet`
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Merge {
    /// Checks the parts, joins them, writes the table, and prints what it says to a command that
    /// works out `campaigns` in parts.
    pub(crate) fn run(
        self,
        campaigns: &[&'static Campaign],
        out: &mut impl Write,
    ) -> anyhow::Result<ExitCode> {
        let format = Format::of(&self.output)?;
        let (parts, campaign) = parts(&self.folder, campaigns)?;
        let paths = || parts.iter().map(|part| self.folder.join(part.to_string()));
        let mut whole: Option<Table> = None;
        for (part, path) in parts.iter().zip(paths()) {
            let table = read_part(part, &path)?;
            match &mut whole {
                Some(whole) => append(whole, table)?,
                None => whole = Some(table),
            }
        }
        let whole = whole.context("a run has one part or more")?;
        campaign.write(&self.output, format, paths(), &whole)?;
        writeln!(
            out,
            "{}: {} {} of {} parts",
            self.output.display(),
            whole.rows(),
            campaign.word,
            parts.len()
        )?;
        (campaign.print)(&whole, out)
    }
}

/// The parts of a folder, in order, none missing and all of one run.
fn parts(
    folder: &Path,
    campaigns: &[&'static Campaign],
) -> anyhow::Result<(Vec<PartName>, &'static Campaign)> {
    let entries = folder.read_dir().with_context(|| folder.display().to_string())?;
    let mut parts = Vec::new();
    for entry in entries {
        parts.extend(entry?.file_name().to_str().and_then(PartName::read));
    }
    let campaign =
        |part: &PartName| campaigns.iter().copied().find(|campaign| campaign.word == part.word);
    parts.retain(|part| campaign(part).is_some());
    parts.sort_by_key(|part| (part.shard.number, part.to_string()));
    let first = parts.first().ok_or_else(|| {
        anyhow!(
            "{}: holds no part, expected those of `helixlock sweep --shard 1/8 -o {0}` and so on",
            folder.display()
        )
    })?;
    if let Some(other) = parts.iter().find(|part| !part.belongs_to(first)) {
        bail!("{}: `{first}` and `{other}` are of two runs, expected one", folder.display());
    }
    let campaign = campaign(first).context("parts are of a campaign")?;
    let there = |number: &u64| parts.iter().any(|part| part.shard.number == *number);
    let missing: Vec<u64> = (1..=first.shard.of).filter(|number| !there(number)).collect();
    if !missing.is_empty() {
        let named: Vec<String> = missing.iter().take(NAMED).map(u64::to_string).collect();
        let more = if NAMED < missing.len() { " …" } else { "" };
        bail!(
            "{}: {} of {} parts are missing: {}{more}",
            folder.display(),
            missing.len(),
            first.shard.of,
            named.join(", ")
        );
    }
    Ok((parts, campaign))
}

/// A part, which holds the cases that its name says.
#[expect(clippy::cast_precision_loss, reason = "fewer than 2⁵³ cases")]
fn read_part(part: &PartName, path: &Path) -> anyhow::Result<Table> {
    let table = read_table(path)?;
    let Shard { number, of } = part.shard;
    let expected = part.shard.cases(part.cases);
    let cases = table.require("case")?;
    ensure!(
        expected.clone().map(|case| case as f64).eq(cases.iter().copied()),
        "{}: does not hold the cases of part {number} of {of}, expected {} to {}",
        path.display(),
        expected.start,
        expected.end.saturating_sub(1)
    );
    Ok(table)
}

fn append(whole: &mut Table, part: Table) -> anyhow::Result<()> {
    ensure!(
        whole.names().eq(part.names()),
        "{}: other columns than the first part",
        part.path.display()
    );
    for (column, more) in whole.columns.iter_mut().zip(part.columns) {
        column.values.extend(more.values);
    }
    Ok(())
}
