//! `helixlock board watch`: every comparison as it comes.

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::Args;
use helixlock_gen::Board;
use helixlock_plant::Model;
use helixlock_sim::settings_for;
use helixlock_traces::csv::write_csv;

use super::frame::{Decoder, Received};
use super::log::{Log, Row, Scale};
use super::port::Source;
use crate::shared::output::write_whole;

/// Show every comparison of a board as it comes
///
/// A line for each: its number in the pass, phase, steps. With a machine file it has its time, place
/// and error too, and `--csv` writes a table of one pass that `compare`, `diagnose` and `learn` read.
/// It ends with the port, after `--count` comparisons, or with Ctrl-C. Exit status 1 when comparisons
/// were missed or frames damaged, or none came.
#[derive(Debug, Args)]
pub(super) struct Watch {
    /// Serial port of the board, or a file of what came from one
    #[arg(value_name = "PORT")]
    port: PathBuf,
    /// Machine file the bitstream was made from
    #[arg(long, value_name = "MACHINE.toml")]
    machine: Option<PathBuf>,
    /// Board, whose clock counts [default: that of the machine file]
    #[arg(long, value_name = "BOARD", requires = "machine")]
    board: Option<String>,
    /// End after so many comparisons
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    count: Option<u64>,
    /// New table of the first pass heard, written at the end of it; on a port `--count` says when
    #[arg(long, value_name = "DATA.csv", requires = "machine")]
    csv: Option<PathBuf>,
    /// Print a JSON object a line
    #[arg(long)]
    json: bool,
}

impl Watch {
    /// Reads until there is no more, or enough.
    pub(super) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let scale = self.scale()?;
        let mut source = Source::open(&self.port)?;
        self.check_table(&source)?;
        let mut log = Log::new(scale);
        let mut rows = Vec::new();
        let heard = self.listen(&mut source, &mut log, |row| {
            if self.csv.is_some() {
                rows.push(*row);
            }
            self.print(row, out)
        })?;
        let jumps = match scale {
            Some(scale) => self.write_table(scale, &rows)?,
            None => 0,
        };
        Self::say(heard, jumps, &log)
    }

    /// A table of one pass can be kept, and nothing is in its place: a pass is not run again for it.
    fn check_table(&self, source: &Source) -> anyhow::Result<()> {
        let Some(path) = &self.csv else { return Ok(()) };
        if path.exists() {
            bail!("{}: is there already, expected a new file", path.display());
        }
        if self.count.is_none() && matches!(source, Source::Port(_)) {
            bail!("`--csv` on a port, expected `--count N` that says when the table is whole");
        }
        Ok(())
    }

    /// Hands on every row, and gives their number.
    fn listen(
        &self,
        source: &mut Source,
        log: &mut Log,
        mut take: impl FnMut(&Row) -> anyhow::Result<()>,
    ) -> anyhow::Result<u64> {
        let mut decoder = Decoder::default();
        let mut heard = 0;
        let mut bytes = [0; 256];
        loop {
            let got = source.read(&mut bytes).with_context(|| self.port.display().to_string())?;
            if got == 0 {
                return Ok(heard);
            }
            for received in bytes[..got].iter().filter_map(|byte| decoder.take(*byte)) {
                let frame = match received {
                    Received::Whole(frame) => frame,
                    // Settings were read while it measured.
                    Received::Answer(_) => continue,
                    Received::Damaged => {
                        log.damaged += 1;
                        continue;
                    }
                };
                let row = log.row(&frame);
                if self.csv.is_some() && row.pass > 1 {
                    return Ok(heard);
                }
                take(&row)?;
                heard += 1;
                if self.count == Some(heard) {
                    return Ok(heard);
                }
            }
        }
    }

    fn scale(&self) -> anyhow::Result<Option<Scale>> {
        let Some(path) = &self.machine else { return Ok(None) };
        let machine = Model::read(path)?.machine;
        // A machine without the parts of a device has no scale.
        settings_for(&machine)?;
        let clock_hz = match &self.board {
            Some(name) => 1e6 * f64::from(Board::find(name)?.clock_mhz),
            None => machine.fpga.clock_hz,
        };
        Ok(Some(Scale::new(&machine, clock_hz)))
    }

    fn print(&self, row: &Row, out: &mut impl Write) -> anyhow::Result<()> {
        if self.json {
            writeln!(out, "{}", serde_json::to_string(row)?)?;
            return Ok(out.flush()?);
        }
        let phase_deg = 360.0 * f64::from(row.width_clocks) / f64::from(row.period_clocks);
        write!(out, "{:7}  {phase_deg:8.3}°  {:+5} steps", row.comparison, row.steps)?;
        if let Some(reading) = row.reading {
            let (time_s, position_mm) = (reading.time_s, reading.position_mm);
            write!(out, "  {time_s:10.3} s  {position_mm:10.4} mm  {:+9.4} µm", reading.error_um)?;
        }
        let words = [("forward", row.forward), ("FAULT", row.fault), ("ALARM", row.alarm)];
        for (word, _) in words.iter().filter(|(_, said)| *said) {
            write!(out, "  {word}")?;
        }
        writeln!(out)?;
        Ok(out.flush()?)
    }

    /// The table, whole or not at all; how often the recorder jumped in it.
    fn write_table(&self, scale: Scale, rows: &[Row]) -> anyhow::Result<usize> {
        let Some(path) = self.csv.as_ref().filter(|_| !rows.is_empty()) else { return Ok(0) };
        let (table, jumps) = scale.table(rows);
        let read = [Some(&self.port), self.machine.as_ref()].into_iter().flatten().cloned();
        write_whole(path, read, |mut file| Ok(write_csv(&table, &mut file)?))?;
        Ok(jumps)
    }

    /// What was not heard, on the standard error; silence when all is well.
    fn say(heard: u64, jumps: usize, log: &Log) -> anyhow::Result<ExitCode> {
        let mut errors = io::stderr();
        if jumps > 0 {
            writeln!(errors, "helixlock: the phase went over the edge of its range {jumps} times")?;
        }
        if log.missed + log.damaged == 0 && heard > 0 {
            return Ok(ExitCode::SUCCESS);
        }
        let (missed, damaged) = (log.missed, log.damaged);
        writeln!(
            errors,
            "helixlock: {heard} comparisons heard, {missed} missed, {damaged} frames damaged"
        )?;
        Ok(ExitCode::from(1))
    }
}
