//! `helixlock gen`: the device on an FPGA board.

mod summary;
mod vectors;
mod written;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_gen::{Board, Project, Synthesis, project, synthesise};
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_plant::{Machine, Model};
use helixlock_rtl::BLOCKS;
use helixlock_rtl::board_shell::BoardShell;
use helixlock_sim::settings_for;

use self::summary::Summary;
use self::vectors::vectors;
use self::written::Written;
use crate::shared::output::{Batch, print_json};

/// Name of the top module.
const TOP: &str = "board_shell";

/// Verilog, constraints, test bench and Makefile for an FPGA board
///
/// Dividers, initial phase, compensation and step clock of the machine file become constants of
/// the design; inputs, switches and drives become pins. With `--synth` the bitstream is built too.
#[derive(Debug, Args)]
pub(crate) struct Gen {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    #[arg(long, help = boards())]
    board: Option<String>,
    /// Folder for the files
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Replace files that `gen` has not written, or that were changed since
    #[arg(long)]
    force: bool,
    /// Run yosys, nextpnr-ice40, icetime and icepack; exit 1 if the clock is too fast for it
    #[arg(long)]
    synth: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// The boards there are constraints for, as a help text.
fn boards() -> String {
    let boards = Board::all().unwrap_or_default();
    let names: Vec<&str> = boards.iter().map(|board| board.name.as_str()).collect();
    let names = match names.as_slice() {
        [others @ .., last] if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        names => names.concat(),
    };
    format!("{names} [default: that of the machine file]")
}

impl Gen {
    /// Writes the project, builds it if asked to, and prints what it is.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let mut machine = Model::read(&self.machine)?.machine;
        let board = self.board_for(&machine)?;
        let file_clock_hz = machine.fpga.clock_hz;
        machine.fpga.clock_hz = 1e6 * f64::from(board.clock_mhz);
        let dialled = settings_for(&machine)?;
        let shell = BoardShell::connected(&dialled.settings)?;
        let library = BLOCKS.iter().fold(Library::new(), |library, card| {
            library.with(card.name, card.summary, (card.build)())
        });
        let mut design = elaborate(TOP, &shell, &library)?;
        describe(&mut design, &machine, &board);
        let vectors = vectors(Netlist::new(&design)?, &dialled.settings);
        let project = project(&design, &board, &vectors)?;
        let synthesis = self.build(&project, &board)?;
        let summary = Summary::new(&project, &board, &dialled, file_clock_hz, synthesis.as_ref());
        if self.json {
            print_json(out, &summary)?;
        } else {
            summary.print(&self.output, out)?;
        }
        Ok(if summary.is_fast_enough() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// The board asked for; its clock must be the one the machine file was written for.
    fn board_for(&self, machine: &Machine) -> anyhow::Result<Board> {
        let named = self.board.as_ref().or(machine.fpga.board.as_ref());
        let Some(name) = named else {
            bail!(
                "no board: expected `--board NAME`, or `board` under `[fpga]` in the machine file"
            );
        };
        let board = Board::find(name)?;
        let board_hz = 1e6 * f64::from(board.clock_mhz);
        let for_another = machine.fpga.board.as_ref().is_some_and(|written| written != name);
        let same = (machine.fpga.clock_hz - board_hz).abs() < 0.5;
        if same || for_another {
            return Ok(board);
        }
        bail!(
            "{}: fpga.clock is {} MHz, but the board `{}` runs at {} MHz\n\
             hint: write `clock = \"{} MHz\"` and `board = \"{}\"` under `[fpga]`",
            self.machine.display(),
            machine.fpga.clock_hz / 1e6,
            board.name,
            board.clock_mhz,
            board.clock_mhz,
            board.name,
        )
    }

    /// Writes the files; with `--synth` the products as well, all or none of them.
    fn build(&self, project: &Project, board: &Board) -> anyhow::Result<Option<Synthesis>> {
        let products = tempfile::tempdir()?;
        let synthesis = if self.synth {
            let mut files = Batch::new(products.path(), [])?;
            add_project(&mut files, project)?;
            files.keep()?;
            Some(synthesise(products.path(), project, board)?)
        } else {
            None
        };
        let mut files = Batch::new(&self.output, [self.machine.clone()])?;
        if !self.force {
            Written::read(&self.output).spare_others(&self.output, project)?;
        }
        add_project(&mut files, project)?;
        Written::of(project).write(&mut files)?;
        for name in synthesis.iter().flat_map(|synthesis| &synthesis.products) {
            files.write_content(name, std::fs::read(products.path().join(name))?)?;
        }
        files.keep()?;
        Ok(synthesis)
    }
}

/// Says in the top module's comment which machine and board it is for.
fn describe(design: &mut helixlock_netlist::Design, machine: &Machine, board: &Board) {
    if let Some(top) = design.modules.last_mut() {
        top.comment = format!(
            "Correction device for \"{}\" on the {}.\nThe device with its wheels set, and the pins \
             a builder wires.\nWritten by helixlock {}; change the machine file, not this.",
            machine.title,
            board.title,
            env!("CARGO_PKG_VERSION"),
        );
    }
}

fn add_project(files: &mut Batch, project: &Project) -> anyhow::Result<()> {
    project.files.iter().try_for_each(|(name, text)| files.write_content(name, text))
}
