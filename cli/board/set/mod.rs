//! `helixlock board set`: a machine's settings onto a board, and back from it.

mod dialogue;
mod told;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::bail;
use clap::Args;
use helixlock_gen::Board;
use helixlock_plant::Model;
use helixlock_rtl::settings::{SettingsError, Wheels};
use helixlock_rtl::step_driver::PULSE_CLOCKS;
use helixlock_sim::{Dialled, settings_for};

use self::dialogue::Dialogue;
use self::told::Told;
use super::message::{Answer, IDENTIFIER, Identity, Request, VERSION};
use crate::shared::output::print_json;

/// Turn a board's wheels from here: a machine's settings go onto it and are read back
///
/// For a bitstream made with `gen --pins rx`. The board takes settings while `start`, `correct` and
/// `playback` are off, and keeps them until it is switched off; then it wakes up with those of its
/// bitstream.
#[derive(Debug, Args)]
pub(super) struct Set {
    /// Machine file whose settings the board is to have
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Serial port of the board
    #[arg(long, value_name = "PORT")]
    port: PathBuf,
    /// Board, whose clock counts [default: that of the machine file]
    #[arg(long, value_name = "BOARD")]
    board: Option<String>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Set {
    /// Asks the board what it is, writes, reads back and compares.
    pub(super) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let (dialled, clock_mhz) = self.dialled()?;
        let wheels = dialled.settings.wheels()?;
        let mut board = Dialogue::open(&self.port)?;
        self.check_identity(board.ask(&Request::Identify)?, clock_mhz)?;
        self.check_written(board.ask(&Request::Write(wheels))?)?;
        self.check_read(board.ask(&Request::Read)?, &wheels)?;
        let told = Told::new(&self.port, clock_mhz, &dialled);
        if self.json {
            print_json(out, &told)?;
        } else {
            told.print(out)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    /// The machine's settings by the clock of the board, and that clock, MHz.
    fn dialled(&self) -> anyhow::Result<(Dialled, u32)> {
        let mut machine = Model::read(&self.machine)?.machine;
        let Some(name) = self.board.as_ref().or(machine.fpga.board.as_ref()) else {
            bail!(
                "no board: expected `--board NAME`, or `board` under `[fpga]` in the machine file"
            );
        };
        let clock_mhz = Board::find(name)?.clock_mhz;
        machine.fpga.clock_hz = 1e6 * f64::from(clock_mhz);
        let dialled = settings_for(&machine)?;
        if dialled.settings.step_period < PULSE_CLOCKS {
            return Err(SettingsError::StepTooFast {
                found: dialled.settings.step_period,
                least: PULSE_CLOCKS,
            }
            .into());
        }
        Ok((dialled, clock_mhz))
    }

    /// It is a board of ours, its messages are these, and its clock is the one counted by.
    fn check_identity(&self, answer: Answer, clock_mhz: u32) -> anyhow::Result<()> {
        let port = self.port.display();
        let Answer::Identity(Identity { identifier, version, clocks_a_millisecond }) = answer
        else {
            bail!("{port}: found settings, expected what the board is");
        };
        if (identifier, version) != (IDENTIFIER, VERSION) {
            bail!(
                "{port}: found a settings port {identifier} of version {version}, expected \
                 {IDENTIFIER} of version {VERSION}\n\
                 hint: make the bitstream anew, with the `helixlock gen` of this version"
            );
        }
        if clocks_a_millisecond != 1000 * clock_mhz {
            bail!(
                "{port}: found a board at {} MHz, expected {clock_mhz} MHz\n\
                 hint: `--board NAME` says which board it is",
                f64::from(clocks_a_millisecond) / 1000.0,
            );
        }
        Ok(())
    }

    fn check_written(&self, answer: Answer) -> anyhow::Result<()> {
        let port = self.port.display();
        match answer {
            Answer::Written(_) => Ok(()),
            Answer::NotAtRest(_) => bail!(
                "{port}: the board is not at rest, and keeps its settings\n\
                 hint: switch `start`, `correct` and `playback` off, then once more"
            ),
            _ => bail!("{port}: the board has no wheels for these settings, and keeps its own"),
        }
    }

    /// What the board has now is what it was to have.
    fn check_read(&self, answer: Answer, wheels: &Wheels) -> anyhow::Result<()> {
        let port = self.port.display();
        let Answer::Settings(found) = answer else {
            bail!("{port}: found another answer, expected the settings of the board");
        };
        let pairs = found.named().into_iter().zip(wheels.named());
        for ((name, found), (_, expected)) in pairs {
            if found != expected {
                bail!("{port}: `{name}` is {found:#x} on the board, expected {expected:#x}");
            }
        }
        Ok(())
    }
}
