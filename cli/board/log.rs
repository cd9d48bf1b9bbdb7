//! Comparisons one after the other: their times, and with a machine file their places and errors.

use helixlock_plant::Machine;
use helixlock_sim::{Comparison, unwrap_um};
use helixlock_traces::{Column, Table};
use serde::Serialize;

use super::frame::Frame;

/// One comparison in plain numbers: a line of JSON, a row of the table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Row {
    /// The pass it belongs to, from 1: those that were heard.
    pub(super) pass: u64,
    /// Its number in the pass, from 0.
    pub(super) comparison: u64,
    /// What the machine file tells of it.
    #[serde(flatten)]
    pub(super) reading: Option<Reading>,
    /// Clocks that T1 was high.
    pub(super) width_clocks: u32,
    /// Clocks of the comparison.
    pub(super) period_clocks: u32,
    /// Net steps, forward positive.
    pub(super) steps: i32,
    /// The loop wants forward.
    pub(super) forward: bool,
    /// A step was refused.
    pub(super) fault: bool,
    /// A signal is missing, the meter wrapped, or stopped.
    pub(super) alarm: bool,
}

/// A comparison in units of the machine, taken where T1 fell, as a simulation's `trace.csv` does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Reading {
    /// Since the first opening that was heard of, s.
    pub(super) time_s: f64,
    /// Travel since the first opening of the pass, mm.
    pub(super) position_mm: f64,
    /// Recorder, µm, positive when the laser lags.
    pub(super) error_um: f64,
}

/// What the machine file adds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    pub(super) clock_hz: f64,
    /// Travel of a comparison, mm.
    pub(super) comparison_mm: f64,
    /// Travel of one turn of phase, µm.
    pub(super) full_scale_um: f64,
}

impl Scale {
    /// For a board whose bitstream was made for this machine and has this clock.
    pub(super) fn new(machine: &Machine, clock_hz: f64) -> Self {
        let lines = f64::from(machine.dividers.range.factor()) * f64::from(machine.dividers.a);
        let turns = lines / f64::from(machine.grating.lines);
        Self {
            clock_hz,
            comparison_mm: turns * machine.workpiece.lead.mm(),
            full_scale_um: machine.full_scale_um(),
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "clocks of a pass are far below 2⁵³")]
    fn reading(self, begin: u64, number: u64, frame: &Frame) -> Reading {
        let [width, period] = [frame.width, frame.period].map(u64::from);
        let comparison = Comparison { begin: 0, end: period, high: width };
        let part = width as f64 / period as f64;
        Reading {
            time_s: (begin + width) as f64 / self.clock_hz,
            position_mm: (number as f64 + part) * self.comparison_mm,
            error_um: comparison.error_um(self.full_scale_um),
        }
    }

    /// The rows as a measurement, and how often the recorder's pen jumped by its whole range: the
    /// table is drawn on past its edges.
    pub(super) fn table(self, rows: &[Row]) -> (Table, usize) {
        let readings: Vec<Reading> = rows.iter().filter_map(|row| row.reading).collect();
        let values = |of: fn(&Reading) -> f64| readings.iter().map(of).collect::<Vec<f64>>();
        let mut error_um = values(|reading| reading.error_um);
        let jumps = unwrap_um(&mut error_um, self.full_scale_um);
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        let table = Table::new(vec![
            column("time_s", values(|reading| reading.time_s)),
            column("position_mm", values(|reading| reading.position_mm)),
            column("error_um", error_um),
            column("steps", rows.iter().map(|row| f64::from(row.steps)).collect()),
        ]);
        (table, jumps)
    }
}

/// Counts what comes, and what does not.
#[derive(Clone, Debug)]
pub(super) struct Log {
    scale: Option<Scale>,
    pass: u64,
    /// Number of the last comparison of the pass.
    last: Option<u64>,
    /// Clocks of all comparisons so far.
    clocks: u64,
    /// Comparisons that no frame came of.
    pub(super) missed: u64,
    /// Frames that did not come over whole.
    pub(super) damaged: u64,
}

/// So many numbers before 65 536 and behind it are taken for a pass that goes on.
const MARGIN: u16 = 256;

impl Log {
    pub(super) fn new(scale: Option<Scale>) -> Self {
        Self { scale, pass: 1, last: None, clocks: 0, missed: 0, damaged: 0 }
    }

    /// The row of the next frame.
    ///
    /// Comparisons that were not heard of are taken to have lasted as long as this one.
    pub(super) fn row(&mut self, frame: &Frame) -> Row {
        let period = u64::from(frame.period);
        let number = match self.last {
            None => u64::from(frame.number),
            Some(last) if begins_a_pass(low_bits(last), frame.number) => {
                self.pass += 1;
                self.miss(u64::from(frame.number), period);
                u64::from(frame.number)
            }
            Some(last) => {
                let ahead = u64::from(frame.number.wrapping_sub(low_bits(last)).wrapping_sub(1));
                self.miss(ahead, period);
                last + 1 + ahead
            }
        };
        let reading = self.scale.map(|scale| scale.reading(self.clocks, number, frame));
        self.last = Some(number);
        self.clocks += period;
        Row {
            pass: self.pass,
            comparison: number,
            reading,
            width_clocks: frame.width,
            period_clocks: frame.period,
            steps: frame.steps,
            forward: frame.forward,
            fault: frame.fault,
            alarm: frame.alarm,
        }
    }

    fn miss(&mut self, comparisons: u64, period: u64) {
        self.missed += comparisons;
        self.clocks += period * comparisons;
    }
}

/// True when the number goes back, but not over the end of its sixteen bits.
fn begins_a_pass(last: u16, number: u16) -> bool {
    let over_the_end = last >= u16::MAX - MARGIN && number < MARGIN;
    number <= last && !over_the_end
}

fn low_bits(number: u64) -> u16 {
    u16::try_from(number & 0xffff).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u16) -> Frame {
        let (width, period) = (3, 4);
        Frame { number, width, period, steps: -5, forward: false, fault: false, alarm: false }
    }

    #[test]
    fn gaps_are_counted_over_the_end_of_sixteen_bits() {
        let mut log = Log::new(None);
        let numbers = [65_534, 65_535, 2, 3].map(|number| log.row(&frame(number)).comparison);
        assert_eq!(numbers, [65_534, 65_535, 65_538, 65_539]);
        assert_eq!(log.missed, 2);
    }

    #[test]
    fn a_number_that_goes_back_begins_a_pass() {
        let mut log = Log::new(None);
        let rows = [40_000, 40_001, 2, 3].map(|number| log.row(&frame(number)));
        let told = rows.map(|row| (row.pass, row.comparison));
        assert_eq!(told, [(1, 40_000), (1, 40_001), (2, 2), (2, 3)]);
        assert_eq!(log.missed, 2, "the first two of the second pass");
    }

    const SCALE: Scale = Scale { clock_hz: 2.0, comparison_mm: 0.5, full_scale_um: 100.0 };

    #[test]
    fn a_scale_makes_seconds_millimetres_and_micrometres() {
        let mut log = Log::new(Some(SCALE));
        log.row(&frame(0));
        let reading = log.row(&frame(1)).reading.expect("there is a scale");
        assert_eq!(reading, Reading { time_s: 3.5, position_mm: 0.875, error_um: 25.0 });
    }

    #[test]
    fn the_table_is_drawn_on_past_the_edges_of_the_range() {
        let mut log = Log::new(Some(SCALE));
        let widths = [95, 5].into_iter().zip(0..);
        let rows: Vec<_> = widths
            .map(|(width, number)| log.row(&Frame { width, period: 100, ..frame(number) }))
            .collect();
        let (table, jumps) = SCALE.table(&rows);
        let errors = table.column("error_um").expect("it is there");
        assert!((errors[0] - 45.0).abs() < 1e-9 && (errors[1] - 55.0).abs() < 1e-9, "{errors:?}");
        assert_eq!(jumps, 1);
    }
}
