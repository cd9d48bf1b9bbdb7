//! `helixlock gen`: the device on an FPGA board.

mod bench;
mod device_vectors;
mod summary;
mod vectors;
mod written;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_gen::{Bench, Board, Project, Synthesis, prefix, project, synthesise};
use helixlock_netlist::{Design, Netlist};
use helixlock_plant::{Machine, Model};
use helixlock_rtl::settings::{Conditioning, Settings};
use helixlock_sim::settings_for;

use self::device_vectors::device_vectors;
use self::summary::Summary;
use self::vectors::vectors;
use self::written::Written;
use crate::shared::analyser::with_memory;
use crate::shared::board_design::{Front, TOP};
use crate::shared::output::{Batch, print_json};

/// Verilog, constraints, test bench and Makefile for an FPGA board
///
/// Dividers, range, initial phase, compensation and step clock of the machine file become constants
/// of the design; inputs, switches and drives become pins. With `--synth` the bitstream is built too.
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
    /// Run yosys, nextpnr and the packer of the FPGA's family; exit 1 if the clock is too fast for it
    #[arg(long)]
    synth: bool,
    /// Name all modules with this before their name, for use in a larger design
    #[arg(long, value_name = "PREFIX", default_value = "")]
    prefix: String,
    #[command(flatten)]
    front: Front,
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
        let conditioning = self.front.conditioning(&board)?;
        let mut design = self.front.design(&dialled.settings, &conditioning)?;
        describe(&mut design, &machine, &board);
        let netlist = Netlist::new(&design)?;
        if self.front.has_analyser() {
            with_memory(&mut design)?;
        }
        prefix(&mut design, &self.prefix);
        let benches = [
            Bench {
                module: format!("{}{TOP}", self.prefix),
                vectors: vectors(netlist, &dialled.settings, &conditioning),
                constants: self.constants(&dialled.settings, &conditioning)?,
            },
            Bench {
                module: format!("{}device", self.prefix),
                vectors: device_vectors()?,
                constants: vec![],
            },
        ];
        let project = project(&design, &board, &benches)?;
        let synthesis = self.build(&project, &board)?;
        let summary = Summary::new(
            &project,
            &board,
            &board.pins_of(design.top()),
            (&dialled, file_clock_hz),
            synthesis.as_ref(),
        );
        if self.json {
            print_json(out, &summary)?;
        } else {
            summary.print(&self.output, out)?;
        }
        Ok(if summary.is_fast_enough() { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }

    /// Levels of the device's settings for ever, but of a range that is a switch; none where a
    /// computer may turn them.
    fn constants(
        &self,
        settings: &Settings,
        conditioning: &Conditioning,
    ) -> anyhow::Result<Vec<(String, u64)>> {
        if self.front.is_set_from_outside() {
            return Ok(vec![]);
        }
        let levels = settings.wheels()?.named().into_iter();
        let fixed = levels.filter(|(name, _)| *name != "range_x2" || !conditioning.range_pin);
        Ok(fixed.map(|(name, level)| (format!("device.{name}"), level)).collect())
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
fn describe(design: &mut Design, machine: &Machine, board: &Board) {
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
