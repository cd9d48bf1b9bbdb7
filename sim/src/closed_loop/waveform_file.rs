//! A waveform in a file: bits under `device`, micrometres under `machine`.

use std::io::{self, Write};

use helixlock_traces::{Dump, Tick, Variable, VcdWriter};

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

/// Unit of time of the files.
pub const TICK: Tick = Tick::PICOSECOND;

/// A waveform on its way to a file, piece by piece; the time axis is that of the run.
#[derive(Debug)]
pub struct WaveformFile<D: Dump> {
    dump: D,
    /// The place of each signal among the variables.
    place: Vec<usize>,
    clock_hz: u64,
    begun: bool,
}

impl<D: Dump> WaveformFile<D> {
    /// Begins a file of what `shown` shows, of which only signals and window are looked at; `make`
    /// gets the variables.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub fn new(
        make: impl FnOnce(&[Variable]) -> io::Result<D>,
        shown: &Waveform,
        clock_hz: u64,
    ) -> io::Result<Self> {
        let (place, variables) = declare(shown);
        let mut dump = make(&variables)?;
        dump.begin_at(TICK.of_clock(shown.window.start, clock_hz))?;
        Ok(Self { dump, place, clock_hz, begun: false })
    }

    /// Writes the next piece.
    ///
    /// # Errors
    ///
    /// Those of the file.
    pub fn write(&mut self, piece: &Waveform) -> io::Result<()> {
        let mut changes = piece.changes.iter().peekable();
        let mut points = piece.analogue.iter().peekable();
        loop {
            let next = [changes.peek().map(|c| c.clock), points.peek().map(|p| p.clock)];
            let Some(clock) = next.into_iter().flatten().min() else { return Ok(()) };
            // What holds from the first instant are first values, not changes.
            if std::mem::replace(&mut self.begun, true) {
                self.dump.at(TICK.of_clock(clock, self.clock_hz))?;
            }
            while let Some(change) = changes.next_if(|change| change.clock == clock) {
                self.dump.bits(self.place[change.signal], change.value)?;
            }
            while let Some(point) = points.next_if(|point| point.clock == clock) {
                for (variable, value) in (self.place.len()..).zip(micrometres(point)) {
                    self.dump.real(variable, value)?;
                }
            }
        }
    }

    /// Marks the end of the record.
    ///
    /// # Errors
    ///
    /// Those of the file.
    pub fn finish(mut self, end_clock: u64) -> io::Result<()> {
        self.dump.finish(TICK.of_clock(end_clock, self.clock_hz))
    }
}

/// Writes a whole waveform as a value change dump; its first instant is that of the window.
///
/// # Errors
///
/// Those of `out`.
pub fn write_vcd(out: impl Write, waveform: &Waveform, clock_hz: u64) -> io::Result<()> {
    let make = |variables: &[Variable]| VcdWriter::new(out, TICK, variables);
    let mut file = WaveformFile::new(make, waveform, clock_hz)?;
    file.write(waveform)?;
    file.finish(waveform.window.end)
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
