//! `helixlock import`: measured data from what an instrument wrote.

mod ask;
mod summary;

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, anyhow, bail};
use clap::Args;
use helixlock_import::{Proposal, Recipe, Source, propose};
use helixlock_traces::csv::write_csv;
use helixlock_traces::parquet::write_parquet;
use helixlock_traces::{LONGEST_BYTES, read_bytes};

use crate::shared::cases::Format;
use crate::shared::next::Next;
use crate::shared::output::{Batch, print_json};

/// Name of measured data where the user has given none.
const MEASURED: &str = "measured.csv";

/// Read what an instrument wrote, and write it as measured data
///
/// Finds out encoding, delimiter, decimal sign, header, units, columns and runs, and writes every
/// decision with its reason into a recipe beside the data. What cannot be found out is asked for on a
/// terminal; elsewhere it is refused with the lines of a recipe that would answer it. Without `-o`
/// nothing is written.
#[derive(Debug, Args)]
pub(crate) struct Import {
    /// Files of one kind; their runs are counted through
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// A recipe: the whole of it, or only what is to be read otherwise
    #[arg(long, value_name = "TOML")]
    recipe: Option<PathBuf>,
    /// Measured data to write: `.csv` or `.parquet`; the recipe goes beside it as NAME.recipe.toml
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the decisions as JSON
    #[arg(long)]
    json: bool,
}

impl Import {
    /// Reads, asks, writes and prints.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        // Before anything is asked: answers would be lost.
        let format = self.output.as_deref().map(Format::of).transpose()?;
        let given = self.recipe.as_deref().map(read_recipe).transpose()?.unwrap_or_default();
        let files = self.files.iter().map(|path| read(path)).collect::<Result<Vec<_>, _>>()?;
        let sources: Vec<Source<'_>> =
            files.iter().map(|(name, bytes)| Source { name, bytes }).collect();
        let proposal = answered(&sources, given, out)?;
        if let Some((output, format)) = self.output.as_deref().zip(format) {
            self.write(output, format, &proposal)?;
        }
        if self.json {
            print_json(out, &summary::json(&proposal))?;
        } else {
            summary::print(out, &proposal, self.output.as_deref())?;
            self.print_next(out)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// What was read is written, and then held against a machine; beside none, one is begun.
    fn print_next(&self, out: &mut impl Write) -> anyhow::Result<()> {
        let Some(data) = &self.output else {
            let mut next = Next::command("import").words(&self.files);
            if let Some(recipe) = &self.recipe {
                next = next.words(["--recipe"]).words([recipe]);
            }
            return next.output(MEASURED).print(out);
        };
        let machine = data.with_file_name("machine.toml");
        if machine.is_file() {
            return Next::command("compare").words([&machine, data]).print(out);
        }
        Next::command("init").print(out)
    }

    fn write(&self, output: &Path, format: Format, proposal: &Proposal) -> anyhow::Result<()> {
        let recipe = recipe_path(output)?;
        let text = proposal.recipe.to_string();
        let replayed = self.recipe.as_deref() == Some(recipe.as_path());
        let other = std::fs::read_to_string(&recipe).is_ok_and(|known| known != text);
        if other && !replayed {
            bail!(
                "{}: found another recipe, expected none or the same\n\nhint: `--recipe {}` reads the file by it; remove it to begin anew",
                recipe.display(),
                recipe.display()
            );
        }
        let folder = output.parent().filter(|folder| !folder.as_os_str().is_empty());
        let given = self.recipe.clone().filter(|_| !replayed);
        let inputs = self.files.iter().cloned().chain(given);
        let mut batch = Batch::new(folder.unwrap_or(Path::new(".")), inputs)?;
        batch.write(name_of(output)?, |file| {
            let mut buffer = Vec::new();
            match format {
                Format::Csv => write_csv(&proposal.table, &mut buffer)?,
                Format::Parquet => write_parquet(&proposal.table, &mut buffer)?,
            }
            Ok(file.write_all(&buffer)?)
        })?;
        if !replayed || !other {
            batch.write_content(name_of(&recipe)?, text)?;
        }
        batch.keep()
    }
}

/// The proposal without an open question: asks on a terminal, refuses elsewhere.
fn answered(
    sources: &[Source<'_>],
    mut given: Recipe,
    out: &mut impl Write,
) -> anyhow::Result<Proposal> {
    loop {
        let proposal = propose(sources, &given).map_err(|error| anyhow!("{error}"))?;
        let Some(question) = proposal.questions.first() else { return Ok(proposal) };
        if !io::stdin().is_terminal() {
            let texts: Vec<_> = proposal.questions.iter().map(ToString::to_string).collect();
            bail!("{}", texts.join("\n\n"));
        }
        let answer = ask::ask(question, &mut io::stdin().lock(), out)?;
        let more = Recipe::parse(&answer.recipe, "answer").map_err(|error| anyhow!("{error}"))?;
        given = given.with(&more);
    }
}

fn read(path: &Path) -> anyhow::Result<(String, Vec<u8>)> {
    Ok((path.display().to_string(), read_bytes(path, LONGEST_BYTES)?))
}

fn read_recipe(path: &Path) -> anyhow::Result<Recipe> {
    let text = std::fs::read_to_string(path)
        .with_context(|| format!("{}: cannot be read", path.display()))?;
    Recipe::parse(&text, &path.display().to_string()).map_err(|error| anyhow!("{error}"))
}

/// `data.csv` has its recipe in `data.recipe.toml`.
fn recipe_path(output: &Path) -> anyhow::Result<PathBuf> {
    let stem = output.file_stem().and_then(|stem| stem.to_str());
    let stem = stem.with_context(|| format!("{}: no name for a file", output.display()))?;
    Ok(output.with_file_name(format!("{stem}.recipe.toml")))
}

fn name_of(path: &Path) -> anyhow::Result<&str> {
    let name = path.file_name().and_then(|name| name.to_str());
    name.with_context(|| format!("{}: no name for a file", path.display()))
}
