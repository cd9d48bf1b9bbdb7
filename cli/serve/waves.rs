//! What a simulated run has left in the folder: its trace, and its bits and micrometres.

use std::io::BufReader;
use std::path::Path;

use anyhow::Context;
use helixlock_traces::vcd::{Bit, Value, VcdReader};
use helixlock_traces::{read_table, vcd::Signal};
use serde::Serialize;

use super::folder::Folder;
use super::frame::Frame;
use super::jobs::Job;
use super::orders::DRAFTED;
use super::refusal::{Answered, json};

/// Where `helixlock sim` writes.
pub(crate) const SIMULATION: &str = "simulation";

/// Most changes of one signal that are shown.
const MOST: usize = 20_000;

#[derive(Serialize)]
struct TraceJson {
    rows: usize,
}

#[derive(Serialize)]
struct WavesJson {
    begin_s: f64,
    end_s: f64,
    signals: Vec<SignalJson>,
}

/// One row of the picture.
#[derive(Serialize)]
struct SignalJson {
    path: String,
    width: u32,
    real: bool,
    /// Second and value; bits that are not known have none.
    changes: Vec<(f64, Option<f64>)>,
    /// True when there are more than are shown.
    cut: bool,
}

/// Columns of the trace, one row a comparison.
pub(crate) fn trace(folder: &Folder) -> Answered {
    columns(&folder.path(SIMULATION)?)
}

/// The same of a machine file that is not saved.
pub(crate) fn drafted(job: &Job) -> Answered {
    columns(&job.scratch.path().join(DRAFTED))
}

fn columns(run: &Path) -> Answered {
    let table = read_table(&run.join("trace.csv"))?;
    let mut frame = Frame::default();
    for column in &table.columns {
        if matches!(column.name.as_str(), "time_s" | "position_mm") {
            frame.push_f64(&column.name, &column.values);
        } else {
            frame.push_f32(&column.name, &column.values);
        }
    }
    frame.answer(&TraceJson { rows: table.rows() })
}

/// Every signal of the waveform that changes, and how.
pub(crate) fn waves(folder: &Folder) -> Answered {
    let path = folder.path(&format!("{SIMULATION}/wave.vcd"))?;
    let file = std::fs::File::open(&path).context("there is no waveform yet")?;
    let mut reader = VcdReader::new(BufReader::new(file), &path)?;
    let tick = reader.tick();
    let mut signals: Vec<(usize, SignalJson)> = reader.signals().iter().map(row).collect();
    let (mut begin, mut seen) = (0, false);
    while let Some(change) = reader.next().transpose()? {
        if !seen {
            (begin, seen) = (change.ticks, true);
        }
        let at_s = tick.seconds(change.ticks);
        let value = number(&change.value);
        for (_, signal) in signals.iter_mut().filter(|(channel, _)| *channel == change.channel) {
            if signal.changes.len() < MOST {
                signal.changes.push((at_s, value));
            } else {
                signal.cut = true;
            }
        }
    }
    let end_s = tick.seconds(reader.ticks());
    let signals = signals.into_iter().map(|(_, signal)| signal);
    let signals = signals.filter(|signal| 1 < signal.changes.len()).collect();
    json(&WavesJson { begin_s: tick.seconds(begin), end_s, signals })
}

fn row(signal: &Signal) -> (usize, SignalJson) {
    let Signal { path, width, real, channel } = signal.clone();
    (channel, SignalJson { path, width, real, changes: Vec::new(), cut: false })
}

/// A value as a number.
fn number(value: &Value) -> Option<f64> {
    let bit = |bit: &Bit| match bit {
        Bit::V0 => Some(0.0),
        Bit::V1 => Some(1.0),
        _ => None,
    };
    match value {
        Value::Bit(one) => bit(one),
        Value::Vector(bits) => bits.iter().try_fold(0.0, |sum, one| Some(2.0 * sum + bit(one)?)),
        Value::Real(number) => Some(*number).filter(|number| number.is_finite()),
        Value::Text(_) => None,
    }
}
