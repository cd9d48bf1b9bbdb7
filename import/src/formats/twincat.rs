//! What the scope of `TwinCAT` exports as text: a header, then a time and a value for each channel.
//!
//! Beckhoff Information System, `TE13xx`, "Export to csv": every channel has a column of times of its own, or
//! channels in a row share one ("Timelines"), or there is none, and the sample time counts the rows. Files of
//! different settings are described by what reads them elsewhere, among it the Python package `pytcs`.

mod blanks;
mod clock;
mod layout;
mod rows;

use super::channels;
use crate::decide::Decisions;
use crate::delimited;
use crate::error::ImportError;
use crate::grid::Grid;
use layout::Layout;
use rows::Rows;

/// What shows, with every error, how the file was taken, and how it can be taken otherwise.
const READ_AS: &str = "read as `twincat`, the export of a TwinCAT scope; a recipe with `[file] format = \"table\"` reads it as any table";

/// True for the header of a scope.
pub(crate) fn fits(lines: &[&str]) -> bool {
    const MARKS: [&str; 5] =
        ["SampleTime", "Sample Time", "StartRecord", "Start of Export", "Starttime of export"];
    let begins = |word: &str| {
        lines.iter().take(60).any(|line| line.trim_start_matches('"').starts_with(word))
    };
    begins("Name") && MARKS.into_iter().any(begins)
}

/// Channels side by side, on the clock of the busiest one, and the second since 1970 from which it counts.
pub(crate) fn grid(
    lines: &[&str],
    decisions: &mut Decisions<'_>,
) -> Result<(Grid, Option<f64>), ImportError> {
    let quoted = blanks::quoted(lines);
    let quoted: Option<Vec<&str>> =
        quoted.as_ref().map(|lines| lines.iter().map(String::as_str).collect());
    side_by_side(quoted.as_deref().unwrap_or(lines), decisions).map_err(|error| match &error {
        ImportError::Found { hint, .. } if hint.is_empty() => error.hinted(READ_AS),
        _ => error,
    })
}

fn side_by_side(
    lines: &[&str],
    decisions: &mut Decisions<'_>,
) -> Result<(Grid, Option<f64>), ImportError> {
    if let Some((delimiter, line)) = layout::delimiter(lines)
        && decisions.given("text", "delimiter").is_none()
    {
        let reason = format!("it stands behind `Name` in line {line}");
        decisions.text("text", "delimiter", || (delimiter.name(), reason));
    }
    let cells = delimited::grid(lines, decisions)?;
    let decimal = decisions.text("text", "decimal", || (".".into(), String::new()));
    let decimal = if decimal == "," { ',' } else { '.' };
    let layout = Layout::find(&cells, decimal)?;
    layout.tell(decisions);
    let (channels, origin_s) = Rows::new(&cells, decimal, &layout).read()?;
    Ok((channels::grid(channels, decisions)?, origin_s))
}
