//! `trace.csv` and GTKWave's view of the waveform.

use std::fmt::Write;

use helixlock_plant::Machine;
use helixlock_sim::{ANALOGUE, SHOWN_FIRST, Simulation, Trace, Waveform};
use helixlock_traces::{Column, Table};

use crate::shared::trace_column::trace_column;

/// One row a comparison: the run as the machine file has it, then the other one with a prefix.
///
/// `error_um` is what the recorder draws, so behind its filter.
pub(crate) fn table(machine: &Machine, simulation: &Simulation) -> Table {
    let (open, closed) = (&simulation.open.trace, &simulation.closed.trace);
    let (main, other, prefix) =
        if machine.loop_closed { (closed, open, "open_") } else { (open, closed, "closed_") };
    let rows = main.time_s.len().min(other.time_s.len());
    let mut columns = columns_of(main, "", rows);
    columns.extend(columns_of(other, prefix, rows));
    Table::new(columns)
}

fn columns_of(trace: &Trace, prefix: &str, rows: usize) -> Vec<Column> {
    let column =
        |name: &str, values: &[f64]| trace_column(format!("{prefix}{name}"), &values[..rows]);
    #[expect(clippy::cast_precision_loss, reason = "the counter holds 4095 steps")]
    let steps: Vec<f64> = trace.steps.iter().map(|steps| *steps as f64).collect();
    vec![
        column("time_s", &trace.time_s),
        column("position_mm", &trace.position_mm),
        column("error_um", &trace.filtered_error_um),
        column("raw_error_um", &trace.error_um),
        column("steps", &steps),
        column("lead_error_um", &trace.lead_error_um),
    ]
}

/// A save file for GTKWave: what a person looks for, the micrometres drawn as curves.
pub(crate) fn gtkwave_view(file: &str, waveform: &Waveform) -> String {
    /// Flags of the format: hexadecimal and right-aligned; with them, a curve.
    const BITS: &str = "@22";
    const BIT: &str = "@28";
    const CURVE: &str = "@88022";
    const BLANK: &str = "@20000\n-\n-\n-";
    let mut view = format!("[dumpfile] \"{file}\"\n");
    let known = |path: &&str| waveform.signals.iter().find(|(known, _)| known == path);
    for (path, width) in SHOWN_FIRST.iter().filter_map(known) {
        let range = if *width == 1 { String::new() } else { format!("[{}:0]", width - 1) };
        let flags = if *width == 1 { BIT } else { BITS };
        // Writing to a string cannot fail.
        let _ = writeln!(view, "{flags}\ndevice.{path}{range}");
    }
    for path in ANALOGUE {
        let _ = writeln!(view, "{CURVE}\n{path}\n{BLANK}");
    }
    view
}
