//! Two pulse trains from a file: a value change dump, or a table.

use std::path::Path;

use anyhow::{anyhow, bail};
use helixlock_metrology::transmission::Pulses;

use crate::shared::input::Input;
use crate::shared::refused::in_file;
use crate::shared::series::Series;

/// Names of the two signals or columns, when the user gave them.
pub(crate) struct Names<'a> {
    /// Input.
    pub(crate) input: Option<&'a str>,
    /// Output.
    pub(crate) output: Option<&'a str>,
}

/// Reads rising edges of both givers.
///
/// A dump: the two signals named, or the only two there are. A table: columns `input_s` and
/// `output_s` with an instant a row (one may be longer); or `time_s` and `channel` (1 input,
/// 2 output); or `time_s` and the levels `input` and `output`.
pub(crate) fn read_pulses(path: &Path, names: &Names<'_>) -> anyhow::Result<Pulses> {
    let input = Input::read(path)?;
    let (input_s, output_s) =
        if input.is_dump() { dump(path, input, names)? } else { table(input, names)? };
    Pulses::new(input_s, output_s).map_err(in_file(path))
}

fn dump(path: &Path, input: Input, names: &Names<'_>) -> anyhow::Result<(Vec<f64>, Vec<f64>)> {
    let capture = input.capture()?;
    let signal = |name: Option<&str>, place: usize, option: &str| match (name, &capture.signals[..])
    {
        (Some(name), _) => Ok(name.to_owned()),
        (None, two @ [_, _]) => Ok(two[place].path.clone()),
        (None, signals) => {
            let found: Vec<_> = signals.iter().take(12).map(|s| format!("`{}`", s.path)).collect();
            bail!(
                "{}: {} one-bit signals ({}), expected two or a choice\nhint: `{option}` with one of them",
                path.display(),
                signals.len(),
                found.join(", ")
            )
        }
    };
    let input = signal(names.input, 0, "--input-signal")?;
    let output = signal(names.output, 1, "--output-signal")?;
    Ok((capture.rising_s(&input)?, capture.rising_s(&output)?))
}

fn table(input: Input, names: &Names<'_>) -> anyhow::Result<(Vec<f64>, Vec<f64>)> {
    let series = Series::all_of(input)?;
    if let (Some(time), Some(channel)) = (series.optional("time_s")?, series.optional("channel")?) {
        return by_channel(&series, &time, &channel);
    }
    if let Some(time) = series.optional("time_s")? {
        let level = |name: Option<&str>, usual: &str| series.column(name.unwrap_or(usual));
        let (input, output) = (level(names.input, "input")?, level(names.output, "output")?);
        return Ok((rises(&time, &input), rises(&time, &output)));
    }
    let instants = |name: Option<&str>, usual: &str| -> anyhow::Result<Vec<f64>> {
        let column = series.column(name.unwrap_or(usual))?;
        Ok(column.into_iter().filter(|at| !at.is_nan()).collect())
    };
    Ok((instants(names.input, "input_s")?, instants(names.output, "output_s")?))
}

fn by_channel(
    series: &Series,
    time: &[f64],
    channel: &[f64],
) -> anyhow::Result<(Vec<f64>, Vec<f64>)> {
    let (mut input_s, mut output_s) = (Vec::new(), Vec::new());
    for (row, (&at, &channel)) in time.iter().zip(channel).enumerate() {
        match channel {
            1.0 => input_s.push(at),
            2.0 => output_s.push(at),
            _ => {
                let refused = anyhow!("channel {channel}, expected 1 (input) or 2 (output)");
                return Err(refused.context(series.place(row)));
            }
        }
    }
    Ok((input_s, output_s))
}

/// Instants at which a level passes from below one half to above it.
fn rises(time: &[f64], level: &[f64]) -> Vec<f64> {
    let pairs = level.windows(2).zip(&time[1..]);
    pairs.filter(|(pair, _)| pair[0] < 0.5 && 0.5 <= pair[1]).map(|(_, at)| *at).collect()
}
