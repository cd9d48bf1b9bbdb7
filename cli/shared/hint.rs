//! What to try next where a file is of another kind than was expected.

use std::error::Error;
use std::path::Path;

use helixlock_lab::LabError;
use helixlock_plant::MachineError;
use helixlock_traces::TraceError;

use super::next::Next;

/// Columns that `helixlock import` finds in what an instrument wrote.
const MEASURED: [&str; 7] =
    ["position_mm", "time_s", "angle_rev", "error_um", "error_arcsec", "lead_error_um", "steps"];
/// Files that hold no table, by their endings.
const OTHERS: [&str; 2] = ["toml", "vcd"];

/// A hint on a line of its own, or nothing.
pub(crate) fn hint(error: &anyhow::Error) -> String {
    let mut machines = error.chain().filter_map(|cause| cause.downcast_ref::<MachineError>());
    let other = machines.find_map(MachineError::other_kind_of_file);
    if other.is_some_and(|path| path.extension().is_none_or(|tail| tail != "toml")) {
        return "\n\nhint: the machine file comes first, the data behind it; `helixlock init` writes a machine file".to_owned();
    }
    let path = error.chain().find_map(foreign_table).filter(|path| {
        let ending = path.extension().and_then(|ending| ending.to_str());
        ending.is_none_or(|ending| !OTHERS.contains(&ending))
    });
    let line = path.map(|path| Next::command("import").words([path]).output("measured.csv").line());
    line.and_then(Result::ok).map(|line| format!("\n\nhint: `{line}`")).unwrap_or_default()
}

/// A table that is an instrument's, by what it was refused for.
fn foreign_table<'a>(cause: &'a (dyn Error + 'static)) -> Option<&'a Path> {
    match cause.downcast_ref::<LabError>() {
        Some(
            LabError::NoObservation { path, .. }
            | LabError::NoCoordinate { path, .. }
            | LabError::NoPosition { path, .. },
        ) => return Some(Path::new(path)),
        Some(LabError::Trace(error)) => return foreign_trace(error),
        _ => {}
    }
    foreign_trace(cause.downcast_ref()?)
}

fn foreign_trace(error: &TraceError) -> Option<&Path> {
    match error {
        TraceError::Kind { path, found, .. } => {
            let kinds = ["a spreadsheet", "an HDF5", "an Arrow", "UTF-16", "binary data"];
            kinds.iter().any(|kind| found.starts_with(kind)).then_some(path)
        }
        TraceError::NoColumn { path, name, .. } => {
            MEASURED.contains(&name.as_str()).then_some(path)
        }
        TraceError::Cell { at, name, hint, .. } => {
            (hint.is_empty() && !MEASURED.contains(&name.as_str())).then_some(&at.path)
        }
        TraceError::Ragged { at, hint, .. } => hint.is_empty().then_some(&at.path),
        _ => None,
    }
    .map(AsRef::as_ref)
}
