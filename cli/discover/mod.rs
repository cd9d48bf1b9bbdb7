//! `helixlock discover`: a formula where no name fits.

mod json;
mod page;
mod text;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::{Discovery, Found, Problem, compare, discover};
use helixlock_plant::MachineFile;
use helixlock_report::Page;

use self::json::DiscoveryJson;
use crate::shared::angular::in_unit;
use crate::shared::answer::{Answer, Answering};
use crate::shared::language::Reporter;
use crate::shared::measured::Files;
use crate::shared::next::Next;
use crate::shared::output::{apart, print_json, print_page, write_content, write_page};

/// Propose a formula for what no effect of the catalogue explains
#[derive(Debug, Args)]
pub(crate) struct Discover {
    #[command(flatten)]
    files: Files,
    /// New machine file with the proposed formulas, and the named effects beside them, in it
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// The same as a page
    #[arg(long, value_name = "FILE.html")]
    page: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Discover {
    /// Prints the proposals; exit status 1 when the input itself is doubted, or nothing was
    /// proposed that could be written.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        apart([("`-o`", self.output.as_deref()), ("`--page`", self.page.as_deref())])?;
        let (file, problem, discovery) = self.found()?;
        let written = match &self.output {
            Some(path) if !discovery.proposals.is_empty() => {
                let new = with_proposals(&file, &discovery)?;
                write_content(path, self.files.inputs(&file.model), new.text())?;
                true
            }
            Some(_) => false,
            None => true,
        };
        if let Some(path) = &self.page {
            let page = drawn(&file, &problem, &discovery)?;
            write_page(path, self.files.inputs(&file.model), &page, out.language())?;
        }
        let measurement = &problem.measurement;
        if self.json {
            let json = DiscoveryJson::new(&discovery, measurement);
            print_json(out, &in_unit(&json, measurement.unit_word())?)?;
        } else {
            text::print(out, &discovery, measurement)?;
            print_page(out, self.page.as_deref())?;
            if let Some(path) = self.output.as_ref().filter(|_| !written) {
                writeln!(out, "{}: not written, for nothing is proposed", path.display())?;
            }
            self.print_next(out, &discovery)?;
        }
        let doubted = discovery.found == Found::DoubtfulInput;
        Ok(if doubted || !written { ExitCode::from(1) } else { ExitCode::SUCCESS })
    }

    /// A proposal is written, and then held against the data; names are told with their evidence.
    fn print_next(&self, out: &mut impl Write, discovery: &Discovery) -> anyhow::Result<()> {
        let mut words = self.files.words();
        if discovery.proposals.is_empty() {
            let named = discovery.found == Found::Name;
            let next = named.then(|| Next::command("diagnose").words(words));
            return next.map_or(Ok(()), |next| next.print(out));
        }
        if let Some(path) = &self.output {
            words[0] = path.as_os_str();
            return Next::command("compare").words(words).print(out);
        }
        Next::command("discover").words(words).output("proposed.toml").print(out)
    }

    fn found(&self) -> anyhow::Result<(MachineFile, Problem, Discovery)> {
        let (file, problem) = self.files.read()?;
        let discovery = discover(&problem);
        Ok((file, problem, discovery))
    }
}

impl Answering for Discover {
    /// With the text `machine`, the proposals and the named effects beside them in it.
    fn answer(&self) -> anyhow::Result<Answer> {
        let (file, problem, discovery) = self.found()?;
        let json = DiscoveryJson::new(&discovery, &problem.measurement);
        let answer = Answer::in_unit(&json, problem.measurement.unit_word())?;
        Ok(answer.with_text("machine", with_proposals(&file, &discovery)?.text().clone()))
    }
}

/// The page, for which the residual is worked out before and after.
fn drawn(file: &MachineFile, problem: &Problem, found: &Discovery) -> anyhow::Result<Page> {
    let before = compare(problem);
    let after = if found.proposals.is_empty() {
        None
    } else {
        let new = with_proposals(file, found)?.model;
        Some(compare(&Problem::new(&new, &problem.measurement)?))
    };
    Ok(page::page(problem, found, &before, after.as_ref()))
}

fn with_proposals(file: &MachineFile, found: &Discovery) -> anyhow::Result<MachineFile> {
    let mut file = helixlock_lab::written(file, &found.effects)?;
    for proposal in &found.proposals {
        file = file.with_effect(&proposal.term)?;
    }
    Ok(file)
}
