//! A machine file and a data file, read together for the commands that compare them.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use helixlock_lab::measurement::{Measurement, Nominal};
use helixlock_lab::problem::Problem;
use helixlock_plant::{Machine, MachineFile};
use helixlock_traces::read_table;

/// The two files every comparison begins with.
#[derive(Debug, Args)]
pub(crate) struct Files {
    /// Machine file
    pub(crate) machine: PathBuf,
    /// Measured data, CSV or Parquet: `error_um`, `lead_error_um`, `steps` or `error_arcsec` over
    /// `position_mm`, `time_s` or `angle_rev`
    pub(crate) data: PathBuf,
}

impl Files {
    /// Reads both.
    pub(crate) fn read(&self) -> anyhow::Result<(MachineFile, Measurement)> {
        let file = MachineFile::read(&self.machine)?;
        let measurement = measurement(&file.machine, &self.data)?;
        Ok((file, measurement))
    }
}

/// Reads measured data for a machine.
pub(crate) fn measurement(machine: &Machine, data: &Path) -> anyhow::Result<Measurement> {
    let table = read_table(data)?;
    Ok(Measurement::from_table(&table, &Nominal::from(machine))?)
}

/// Lays a measurement out against a machine.
pub(crate) fn problem(
    machine: &Machine,
    measurement: &Measurement,
    data: &Path,
) -> anyhow::Result<Problem> {
    Problem::new(machine, measurement)
        .with_context(|| format!("{}: does not carry the machine's effects", data.display()))
}
