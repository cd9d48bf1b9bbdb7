//! A machine file and a data file, read together for the commands that compare them.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use helixlock_lab::{Measurement, Nominal, Problem, PulseTrains};
use helixlock_plant::{At, MachineFile, Model};

use super::captured::Signals;
use super::input::{Input, machine_files};

/// The two files every comparison begins with.
#[derive(Debug, Args)]
pub(crate) struct Files {
    /// Machine file
    pub(crate) machine: PathBuf,
    /// Measured data: CSV or Parquet with `error_um`, `lead_error_um`, `steps` or `error_arcsec`
    /// over `position_mm`, `time_s` or `angle_rev`; or a VCD capture of grating and laser
    pub(crate) data: PathBuf,
    #[command(flatten)]
    signals: Signals,
}

impl Files {
    /// Reads both and lays the data out against the machine.
    pub(crate) fn read(&self) -> anyhow::Result<(MachineFile, Problem)> {
        let file = MachineFile::read(&self.machine)?;
        let data = Input::read(&self.data)?;
        let problem = problem(&file.model, &self.data, data, &self.signals)?;
        Ok((file, problem))
    }

    /// The words that a further command about them takes.
    pub(crate) fn words(&self) -> Vec<&OsStr> {
        let files = [self.machine.as_os_str(), self.data.as_os_str()];
        files.into_iter().chain(self.signals.words()).collect()
    }

    /// What was read, for outputs to spare.
    pub(crate) fn inputs(&self, model: &Model) -> Vec<PathBuf> {
        let mut files = machine_files(&self.machine, model);
        files.push(self.data.clone());
        files
    }
}

/// Reads measured data and lays them out against a machine.
pub(crate) fn problem(
    machine: &Model,
    data: &Path,
    input: Input,
    signals: &Signals,
) -> anyhow::Result<Problem> {
    let measurement = if input.is_dump() {
        captured(machine, &signals.read(machine, data, input)?)?
    } else if signals.named() {
        bail!("{}: found a table, expected a VCD capture with the named signals", data.display());
    } else {
        let table = input.table()?;
        Measurement::from_table(&table, &Nominal::of(machine))?
    };
    Problem::new(machine, &measurement)
        .context("does not carry the machine's effects")
        .context(At::file(data))
}

/// The samples of a capture.
fn captured(machine: &Model, trains: &PulseTrains) -> anyhow::Result<Measurement> {
    let (table, notes) = trains.table(machine)?;
    let mut measurement = Measurement::from_table(&table, &Nominal::of(machine))?;
    measurement.notes.splice(0..0, notes);
    Ok(measurement)
}
