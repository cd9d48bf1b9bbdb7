//! `helixlock board compare`: a log of a board's pins against the model.

mod pins;
mod run;
mod told;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::Args;
use helixlock_gen::Board;
use helixlock_netlist::Netlist;
use helixlock_plant::Model;
use helixlock_sim::{Circuit, settings_for};
use helixlock_traces::read_capture;

use self::pins::PinLog;
use self::told::Told;
use super::log::Scale;
use crate::shared::board_design::Front;
use crate::shared::output::print_json;
use crate::shared::progress;

/// Find the first clock at which a board does not do what its logic says
///
/// The log is a value change dump that begins before the first clock of the FPGA, with signals named
/// like the pins. Lines, fringes and switches of it go into the model, whose outputs are held to
/// those of the log, clock by clock. A signal `clock` counts the clocks; without it the clock of the
/// board is taken as exact. Exit status 1 when they differ.
#[derive(Debug, Args)]
pub(super) struct Compare {
    /// Machine file the bitstream was made from
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Log of the pins
    #[arg(value_name = "LOG.vcd")]
    log: PathBuf,
    /// Board [default: that of the machine file]
    #[arg(long, value_name = "BOARD")]
    board: Option<String>,
    #[command(flatten)]
    front: Front,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Compare {
    /// Runs the model on the log and says where they part.
    pub(super) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let mut machine = Model::read(&self.machine)?.machine;
        let Some(name) = self.board.as_ref().or(machine.fpga.board.as_ref()) else {
            bail!(
                "no board: expected `--board NAME`, or `board` under `[fpga]` in the machine file"
            );
        };
        let board = Board::find(name)?;
        machine.fpga.clock_hz = 1e6 * f64::from(board.clock_mhz);
        let dialled = settings_for(&machine)?;
        let conditioning = self.front.conditioning(&board)?;
        let netlist = Netlist::new(&self.front.model(&dialled.settings, &conditioning)?)?;
        let capture = read_capture(&self.log)?;
        let log = PinLog::new(&capture, &netlist, &board, conditioning.active_low)?;
        let bar = progress::bar(log.clocks, "clocks");
        let outcome = run::compare(&Circuit::new(netlist), &log, |clock| bar.set_position(clock))
            .context("the model")?;
        bar.finish_and_clear();
        let scale = Scale::new(&machine, machine.fpga.clock_hz);
        let told = Told::new(&outcome, &log, &scale, machine.drive.step_um);
        if self.json {
            print_json(out, &told)?;
        } else {
            told.print(out)?;
        }
        Ok(if told.same { ExitCode::SUCCESS } else { ExitCode::from(1) })
    }
}
