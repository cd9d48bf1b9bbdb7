//! A waveform as a value change dump: bits under `device`, micrometres under `machine`.

use std::io::{self, Write};

use helixlock_traces::{Tick, Variable, VcdWriter};

use super::probe::{Analogue, Waveform};

/// What a person looks for first, in this order; the other signals follow in the netlist's.
pub const SHOWN_FIRST: &[&str] = &[
    "grating",
    "laser",
    "grating_divided",
    "laser_divided",
    "t1",
    "t2",
    "standard",
    "cp1",
    "cp2",
    "q",
    "q_bar",
    "step",
    "forward",
    "phase_a",
    "phase_b",
    "phase_c",
    "count",
    "count_forward",
    "zero",
    "fault",
    "measuring",
];

/// Names of the micrometres, in the order they are written.
pub const ANALOGUE: [&str; 4] = [
    "machine.recorder_error_um",
    "machine.lead_error_um",
    "machine.correction_um",
    "machine.position_mm",
];

/// Writes a waveform; its time axis is that of the run, its first instant that of the window.
///
/// # Errors
///
/// Those of `out`.
pub fn write_vcd(out: impl Write, waveform: &Waveform, clock_hz: u64) -> io::Result<()> {
    let tick = |clock| Tick::PICOSECOND.of_clock(clock, clock_hz);
    let (place, variables) = declare(waveform);
    let mut dump = VcdWriter::new(out, Tick::PICOSECOND, &variables)?;
    dump.begin_at(tick(waveform.window.start));
    let mut changes = waveform.changes.iter().peekable();
    let mut points = waveform.analogue.iter().peekable();
    let mut begun = false;
    loop {
        let next = [changes.peek().map(|c| c.clock), points.peek().map(|p| p.clock)];
        let Some(clock) = next.into_iter().flatten().min() else { break };
        // What holds from the first instant are first values, not changes.
        if std::mem::replace(&mut begun, true) {
            dump.at(tick(clock))?;
        }
        while let Some(change) = changes.next_if(|change| change.clock == clock) {
            dump.bits(place[change.signal], change.value)?;
        }
        while let Some(point) = points.next_if(|point| point.clock == clock) {
            for (variable, value) in (place.len()..).zip(micrometres(point)) {
                dump.real(variable, value)?;
            }
        }
    }
    dump.finish(tick(waveform.window.end))
}

/// In the order of [`ANALOGUE`].
fn micrometres(point: &Analogue) -> [f64; 4] {
    [point.error_um, point.lead_error_um, point.correction_um, point.position_mm]
}

/// The place of each signal among the variables, and the variables.
fn declare(waveform: &Waveform) -> (Vec<usize>, Vec<Variable>) {
    let rank = |path: &str| SHOWN_FIRST.iter().position(|first| *first == path);
    let mut signals: Vec<usize> = (0..waveform.signals.len()).collect();
    signals.sort_by_key(|&signal| rank(&waveform.signals[signal].0).unwrap_or(usize::MAX));
    let mut place = vec![0; signals.len()];
    let mut variables = Vec::with_capacity(signals.len() + ANALOGUE.len());
    for (variable, &signal) in signals.iter().enumerate() {
        let (path, width) = &waveform.signals[signal];
        place[signal] = variable;
        variables.push(Variable::bits(format!("device.{path}"), *width));
    }
    variables.extend(ANALOGUE.iter().map(|path| Variable::real(*path)));
    (place, variables)
}
