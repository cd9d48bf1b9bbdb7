//! `helixlock sim`: grinds a workpiece without and with the correction.

mod page;
mod recorded;
mod summary;
mod table;
mod waveforms;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::Args;
use helixlock_plant::{At, Machine, Model};
use helixlock_sim::{Course, Error, Options, Simulation, View, Waveform, device, simulate};
use helixlock_traces::csv::write_csv;

use self::recorded::{Recorded, WaveFormat};
use self::summary::Summary;
use crate::shared::answer::{Answer, Answering};
use crate::shared::browser::open_page;
use crate::shared::input::machine_files;
use crate::shared::language::Reporter;
use crate::shared::next::Next;
use crate::shared::output::{Batch, REPORT, Written, print_json};
use crate::shared::progress;
use crate::shared::quantity::length_mm;

/// Name of the table in its folder.
const TRACE: &str = "trace.csv";

/// Grind a workpiece clock by clock, without and with the correction
///
/// Writes `trace.csv`, `wave.vcd` (or `.vcd.gz`, `.fst`), `wave.gtkw`, `summary.json` and
/// `report.html` into the folder.
#[derive(Debug, Args)]
pub(crate) struct Sim {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Folder for the results
    #[arg(short, long, value_name = "DIR", required = true)]
    output: Option<PathBuf>,
    /// What the waveform shows: `top`, `all`, an instance such as `phase_meter`, or a signal
    #[arg(long = "scope", value_name = "SCOPE", default_value = "top")]
    scopes: Vec<String>,
    /// Begin of the waveform, s [default: begin of the pass]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    from: Option<f64>,
    /// End of the waveform, s [default: five comparisons later]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    to: Option<f64>,
    /// How the waveform is written
    #[arg(long, value_enum, default_value = "vcd")]
    wave: WaveFormat,
    /// Grind only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = length_mm, allow_hyphen_values = true)]
    length: Option<f64>,
    /// Open the report in the browser
    #[arg(long)]
    open: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

impl Sim {
    /// Simulates, writes, and prints the summary.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let output = self.output.as_deref().context("no folder, expected `-o DIR`")?;
        let (machine, options) = (Model::read(&self.machine)?, self.options());
        let place = |error| in_file(&self.machine, error);
        let course = Course::new(&machine, &options).map_err(place)?;
        let probe = course.probe(&machine, &self.view()).map_err(place)?;
        let bar = progress::bar(course.clocks(), "clocks");
        let mut progress = |clocks| bar.set_position(clocks);
        let mut files =
            Batch::new(output, machine_files(&self.machine, &machine))?.in_language(out.language());
        let recorded = Recorded {
            model: &machine,
            options: &options,
            probe: &probe,
            shown: &Waveform::new(device().netlist(), &probe),
            clock_hz: course.clock_hz,
            format: self.wave,
        };
        let simulation = recorded.run(&mut files, &mut progress)?.map_err(place)?;
        bar.finish_and_clear();
        let summary = Summary::new(&self.machine, &machine, &simulation, &simulation.findings());
        let written = write_files(files, &machine, &simulation, &summary)?;
        if self.json {
            print_json(out, &summary)?;
        } else {
            summary.print(out)?;
            written.print(out)?;
            for other in self.wave.others_in(output) {
                writeln!(out, "note: {} is of an earlier run", other.display())?;
            }
            Next::command("compare").words([&self.machine, &output.join(TRACE)]).print(out)?;
        }
        if self.open {
            open_page(out, output.join(REPORT))?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn options(&self) -> Options {
        Options { length_mm: self.length }
    }

    fn view(&self) -> View {
        View { scopes: self.scopes.clone(), from_s: self.from, to_s: self.to }
    }
}

impl Answering for Sim {
    /// With the table `trace`.
    fn answer(&self) -> anyhow::Result<Answer> {
        let machine = Model::read(&self.machine)?;
        let simulation = simulate(&machine, &self.options(), &mut |_| ())
            .map_err(|error| in_file(&self.machine, error))?;
        let summary = Summary::new(&self.machine, &machine, &simulation, &simulation.findings());
        Ok(Answer::new(&summary)?.with_table("trace", table::table(&machine, &simulation)))
    }
}

/// Names the machine file where the fault is in it, and not in the words of the command.
fn in_file(file: &Path, error: Error) -> anyhow::Error {
    match error {
        Error::NoScope { .. } | Error::Window { .. } => error.into(),
        _ => anyhow::Error::new(error).context(At::file(file)),
    }
}

fn write_files(
    mut files: Batch,
    machine: &Machine,
    simulation: &Simulation,
    summary: &Summary,
) -> anyhow::Result<Written> {
    let page = page::page(machine, simulation, summary)?;
    let trace = table::table(machine, simulation);
    files.write(TRACE, |mut file| Ok(write_csv(&trace, &mut file)?))?;
    files.write_json("summary.json", summary)?;
    files.write_page(&page)?;
    files.kept()
}
