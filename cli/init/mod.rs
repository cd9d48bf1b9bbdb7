//! `helixlock init`: a machine file to begin with, and data that it can be tried on.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use comfy_table::{Table, presets};
use helixlock_plant::nearest::one_of;

use crate::shared::next::Next;
use crate::shared::output::Batch;
use crate::shared::templates::{TEMPLATES, Template};

/// Write a machine file for a kind of machine, with comments that teach, and data to try it on
///
/// Without `--template` it shows the kinds there are. The data are made, not measured: they hold an
/// effect that the machine file does not have, for `helixlock diagnose` to find.
#[derive(Debug, Args)]
pub(crate) struct Init {
    /// Kind of machine
    #[arg(long, value_name = "NAME", requires = "output")]
    template: Option<String>,
    /// Folder for `machine.toml` and `data.csv`
    #[arg(short, long, requires = "template")]
    output: Option<PathBuf>,
}

impl Init {
    /// Writes the two files, or shows what there is.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let (Some(name), Some(folder)) = (&self.template, &self.output) else {
            writeln!(out, "{}", overview())?;

            let first = TEMPLATES[0].name;
            Next::command("init").words(["--template", first]).output(first).print(out)?;
            return Ok(ExitCode::SUCCESS);
        };
        let template = named(name)?;
        write_folder(template, folder)?;
        next_steps(out, template, folder)?;
        Ok(ExitCode::SUCCESS)
    }
}

fn overview() -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(["template", "for", "has"]);
    for template in TEMPLATES {
        table.add_row([template.name, template.about, template.has]);
    }
    table
}

fn named(name: &str) -> anyhow::Result<&'static Template> {
    let names: Vec<_> = TEMPLATES.iter().map(|template| template.name).collect();
    let Some(template) = TEMPLATES.iter().find(|template| template.name == name) else {
        bail!("template `{name}` is unknown, expected {}", one_of(name, &names));
    };
    Ok(template)
}

/// Both files, where neither is yet.
fn write_folder(template: &Template, folder: &Path) -> anyhow::Result<()> {
    let files = [("machine.toml", template.machine), ("data.csv", template.data)];
    for (name, _) in files {
        let path = folder.join(name);
        if path.exists() {
            bail!("{}: is there already, expected a folder without it", path.display());
        }
    }
    let mut batch = Batch::new(folder, [])?;
    for (name, content) in files {
        batch.write_content(name, content)?;
    }
    batch.keep()
}

fn next_steps(out: &mut impl Write, template: &Template, folder: &Path) -> anyhow::Result<()> {
    let [machine, data, sim] = ["machine.toml", "data.csv", "sim"].map(|name| folder.join(name));
    writeln!(out, "{} and {} written", machine.display(), data.display())?;
    writeln!(out, "put your own numbers into the one, and your own data in place of the other")?;
    if template.simulates {
        return Next::command("sim").words([machine]).output(sim).print(out);
    }
    Next::command("diagnose").words([machine, data]).print(out)
}
