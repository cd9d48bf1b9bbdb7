//! A machine file and a data file, read together for the commands that compare them.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use helixlock_lab::{Measurement, Nominal, Problem};
use helixlock_plant::{MachineFile, Model};
use helixlock_traces::read_table;

use super::captured::{Signals, is_dump};

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
        let problem = problem(&file.model, &self.data, &self.signals)?;
        Ok((file, problem))
    }
}

/// Reads measured data and lays them out against a machine.
pub(crate) fn problem(machine: &Model, data: &Path, signals: &Signals) -> anyhow::Result<Problem> {
    let measurement = if is_dump(data)? {
        captured(machine, data, signals)?
    } else if signals.named() {
        bail!("{}: found a table, expected a VCD capture with the named signals", data.display());
    } else {
        let table = read_table(data)?;
        Measurement::from_table(&table, &Nominal::of(machine))?
    };
    Problem::new(machine, &measurement)
        .with_context(|| format!("{}: does not carry the machine's effects", data.display()))
}

/// The samples of a capture.
fn captured(machine: &Model, data: &Path, signals: &Signals) -> anyhow::Result<Measurement> {
    let (table, notes) = signals.read(machine, data)?.table(machine)?;
    let mut measurement = Measurement::from_table(&table, &Nominal::of(machine))?;
    measurement.notes.splice(0..0, notes);
    Ok(measurement)
}
