//! The waveform of a run, written while it goes on, so that no window is too long for memory.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::ValueEnum;
use flate2::Compression;
use flate2::write::GzEncoder;
use helixlock_plant::Model;
use helixlock_sim::{
    Error, Options, Probe, Simulation, TICK, Watch, Waveform, WaveformFile, simulate_watched,
};
use helixlock_traces::{Dump, FstWriter, Variable, VcdWriter};

use super::table::gtkwave_view;
use crate::shared::output::{Batch, Output};

/// How a waveform is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum WaveFormat {
    /// A value change dump, text
    #[value(name = "vcd")]
    Vcd,
    /// The same, compressed by gzip
    #[value(name = "vcd.gz")]
    Compressed,
    /// The packed form of GTKWave
    #[value(name = "fst")]
    Fst,
}

impl WaveFormat {
    /// Name of the file.
    pub(super) fn file_name(self) -> &'static str {
        match self {
            Self::Vcd => "wave.vcd",
            Self::Compressed => "wave.vcd.gz",
            Self::Fst => "wave.fst",
        }
    }

    /// Waveforms in a folder that another run has left in another form.
    pub(super) fn others_in(self, folder: &Path) -> Vec<PathBuf> {
        let others = Self::value_variants().iter().filter(|other| **other != self);
        let files = others.map(|other| folder.join(other.file_name()));
        files.filter(|file| file.is_file()).collect()
    }
}

/// A run whose waveform goes into a file.
pub(super) struct Recorded<'a> {
    pub(super) model: &'a Model,
    pub(super) options: &'a Options,
    pub(super) probe: &'a Probe,
    /// What the probe shows, nothing of it seen yet.
    pub(super) shown: &'a Waveform,
    pub(super) clock_hz: u64,
    pub(super) format: WaveFormat,
}

impl Recorded<'_> {
    /// Simulates, and writes the waveform with GTKWave's view of it.
    pub(super) fn run(
        &self,
        files: &mut Batch,
        progress: &mut dyn FnMut(u64),
    ) -> anyhow::Result<Result<Simulation, Error>> {
        let mut simulated = None;
        files.write(self.format.file_name(), |file| {
            match self.simulate(file, progress) {
                // What the disk says is about the file, everything else about the run.
                Err(Error::NotTaken(disk)) => return Err(disk.into()),
                result => simulated = Some(result),
            }
            Ok(())
        })?;
        let view = gtkwave_view(self.format.file_name(), self.shown);
        files.write_content("wave.gtkw", view)?;
        simulated.context("the run has no end")
    }

    fn simulate(
        &self,
        file: &mut dyn Output,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Simulation, Error> {
        match self.format {
            WaveFormat::Vcd => {
                self.simulate_into(|variables| VcdWriter::new(file, TICK, variables), progress)
            }
            WaveFormat::Fst => {
                self.simulate_into(|variables| FstWriter::new(file, TICK, variables), progress)
            }
            WaveFormat::Compressed => {
                let mut packed = BufWriter::new(GzEncoder::new(file, Compression::default()));
                let out = &mut packed;
                let make = |variables: &[Variable]| VcdWriter::new(out, TICK, variables);
                let simulation = self.simulate_into(make, progress)?;
                let packed = packed.into_inner().map_err(io::IntoInnerError::into_error);
                packed.and_then(GzEncoder::finish).map_err(Error::NotTaken)?;
                Ok(simulation)
            }
        }
    }

    fn simulate_into<D: Dump>(
        &self,
        make: impl FnOnce(&[Variable]) -> io::Result<D>,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Simulation, Error> {
        let mut file =
            WaveformFile::new(make, self.shown, self.clock_hz).map_err(Error::NotTaken)?;
        let watch = Watch { probe: self.probe, seen: &mut |piece| file.write(piece) };
        let simulation = simulate_watched(self.model, self.options, Some(watch), progress)?;
        file.finish(self.probe.window.end).map_err(Error::NotTaken)?;
        Ok(simulation)
    }
}
