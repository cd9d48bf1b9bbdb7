//! The device of the print around its comparison cell: dividers that count the very instants.
//!
//! Counting is exact and has no clock; only instants of divided pulses remain, which the cell then
//! takes in the order of time.

use helixlock_rtl::settings::{Range, Settings};

use super::cell::{Change, Delays, HistoricCell, Pulse};

/// Dividers, phase selection and compensation, counting lines and fringes as they come.
#[derive(Clone, Debug)]
pub(crate) struct HistoricDevice {
    settings: Settings,
    /// A line this soon after the gate opens does not pass, as in the synchronous device.
    gate_s: f64,
    opened_s: Option<f64>,
    fringes: u64,
    /// Fringes after compensation.
    pulses: u64,
    lines: u64,
    pulses_in: Vec<(f64, Pulse)>,
}

/// One comparison as the cell sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HistoricComparison {
    /// How long the meter was high, s.
    pub(crate) high_s: f64,
    /// How long it lasted, s.
    pub(crate) period_s: f64,
    /// When it ended, s.
    pub(crate) ended_s: f64,
    /// How far the laser's edge was behind the middle, s, when it had one.
    pub(crate) behind_middle_s: Option<f64>,
    /// How near a laser's edge, of this or a neighbour, came to its beginning or end, s.
    pub(crate) from_ends_s: f64,
    /// Q at its end.
    pub(crate) forward: bool,
}

impl HistoricDevice {
    /// The device with its wheels set; its grating gate takes `gate_s` to open.
    pub(crate) fn new(settings: Settings, gate_s: f64) -> Self {
        let (fringes, pulses, lines) = (0, 0, 0);
        let opened_s = (settings.initial_phase == 0).then_some(0.0);
        Self { settings, gate_s, opened_s, fringes, pulses, lines, pulses_in: Vec::new() }
    }

    /// A grating line at this instant.
    pub(crate) fn line(&mut self, time_s: f64) {
        if self.opened_s.is_none_or(|opened_s| time_s < opened_s + self.gate_s) {
            return;
        }
        self.lines += 1;
        let a = u64::from(self.settings.a);
        let (period, half) = match self.settings.range {
            Range::X1 => (a, a / 2),
            Range::X2 => (2 * a, a),
        };
        // The first divided pulse begins a comparison, at x2 as at x1.
        let place = (self.lines + period - a) % period;
        if place == 0 {
            self.pulses_in.push((time_s, Pulse::Grating));
        } else if place == half && a <= self.lines {
            self.pulses_in.push((time_s, Pulse::Half));
        }
    }

    /// A fringe at this instant.
    pub(crate) fn fringe(&mut self, time_s: f64) {
        self.fringes += 1;
        let f = u64::from(self.settings.compensation_f);
        let corrected = 0 < f && self.fringes.is_multiple_of(f);
        // The pulse behind the F-th is blocked, one is added to the F-th.
        let blocked = 0 < f && !self.settings.insert && 1 < self.fringes && self.fringes % f == 1;
        if !blocked {
            self.count(time_s);
        }
        if corrected && self.settings.insert {
            self.count(time_s);
        }
    }

    fn count(&mut self, time_s: f64) {
        self.pulses += 1;
        if self.pulses == u64::from(self.settings.initial_phase) {
            self.opened_s = Some(time_s);
        }
        let b = u64::from(self.settings.b);
        let period = b * u64::from(self.settings.range.factor());
        if (self.pulses + period - b).is_multiple_of(period) {
            self.pulses_in.push((time_s, Pulse::Laser));
        }
    }

    /// Pulses since this was last asked, in the order in which they were counted.
    pub(crate) fn take_pulses(&mut self) -> Vec<(f64, Pulse)> {
        std::mem::take(&mut self.pulses_in)
    }

    /// What the cell makes of all pulses so far.
    pub(crate) fn comparisons(&self, delays: Delays) -> (Vec<HistoricComparison>, u64) {
        let mut pulses = self.pulses_in.clone();
        pulses.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut cell = WatchedCell::new(delays);
        for (time_s, pulse) in pulses {
            cell.pulse(time_s, pulse);
        }
        (cell.reading.comparisons, cell.cell.runts)
    }
}

/// The cell from the first comparison on, and what is read off it.
#[derive(Debug)]
pub(crate) struct WatchedCell {
    delays: Delays,
    cell: HistoricCell,
    reading: Reading,
    begun: bool,
}

impl WatchedCell {
    /// A cell at rest.
    pub(crate) fn new(delays: Delays) -> Self {
        let (cell, reading) = (HistoricCell::new(delays), Reading::default());
        Self { delays, cell, reading, begun: false }
    }

    /// A pulse comes, not before those that have come.
    pub(crate) fn pulse(&mut self, time_s: f64, pulse: Pulse) {
        self.begun |= pulse == Pulse::Grating;
        if self.begun {
            let mut changes = Vec::new();
            self.cell.pulse(time_s, pulse, &mut changes);
            self.read(changes);
            self.reading.pulse(time_s, pulse, self.delays.flip_flop_s);
        }
    }

    /// Lets time pass.
    pub(crate) fn advance(&mut self, time_s: f64) {
        let mut changes = Vec::new();
        self.cell.advance(time_s, &mut changes);
        self.read(changes);
    }

    /// Where the motor goes, once something has been decided.
    pub(crate) fn decision(&self) -> Option<bool> {
        self.cell.decided.then_some(self.reading.forward)
    }

    /// Comparisons that have ended.
    pub(crate) fn comparisons(&self) -> &[HistoricComparison] {
        &self.reading.comparisons
    }

    fn read(&mut self, changes: Vec<(f64, Change)>) {
        for (at_s, change) in changes {
            self.reading.change(at_s, change);
        }
    }
}

/// Sums up comparisons from pulses and changes.
#[derive(Debug, Default)]
pub(super) struct Reading {
    pub(super) comparisons: Vec<HistoricComparison>,
    /// Its grating pulse, s.
    begun_s: Option<f64>,
    /// The laser's edge before that, s.
    laser_before_s: Option<f64>,
    middle_s: Option<f64>,
    /// First and last edge of the laser since, s.
    lasers_s: Option<(f64, f64)>,
    high_s: f64,
    risen_s: Option<f64>,
    forward: bool,
}

impl Reading {
    pub(super) fn change(&mut self, at_s: f64, change: Change) {
        match change {
            Change::Q(level) => self.forward = level,
            Change::Meter(true) => self.risen_s = Some(at_s),
            Change::Meter(false) => {
                self.high_s += self.risen_s.take().map_or(0.0, |risen_s| at_s - risen_s);
            }
        }
    }

    pub(super) fn pulse(&mut self, time_s: f64, pulse: Pulse, delay_s: f64) {
        match pulse {
            Pulse::Half => self.middle_s = Some(time_s),
            Pulse::Laser => self.laser(time_s),
            Pulse::Grating => self.begin(time_s, delay_s),
        }
    }

    fn laser(&mut self, time_s: f64) {
        let first_s = self.lasers_s.map_or(time_s, |(first_s, _)| first_s);
        self.lasers_s = Some((first_s, time_s));
        if let Some((before, begun_s)) = self.comparisons.last_mut().zip(self.begun_s) {
            before.from_ends_s = before.from_ends_s.min(time_s - begun_s);
        }
    }

    /// Ends a comparison where the next begins, at the meter's output.
    fn begin(&mut self, time_s: f64, delay_s: f64) {
        let end_s = time_s + delay_s;
        if let Some(risen_s) = self.risen_s.as_mut().filter(|risen_s| **risen_s < end_s) {
            self.high_s += end_s - std::mem::replace(risen_s, end_s);
        }
        let high_s = std::mem::take(&mut self.high_s);
        let (middle_s, edges_s) = (self.middle_s.take(), self.lasers_s.take());
        let last_s = edges_s.map(|(_, last_s)| last_s);
        if let Some(begun_s) = self.begun_s.replace(time_s) {
            let near_s = [
                self.laser_before_s.map(|before_s| begun_s - before_s),
                edges_s.map(|(first_s, _)| first_s - begun_s),
                last_s.map(|last_s| time_s - last_s),
            ];
            self.comparisons.push(HistoricComparison {
                high_s,
                period_s: time_s - begun_s,
                ended_s: time_s,
                behind_middle_s: middle_s.zip(last_s).map(|(middle_s, last_s)| last_s - middle_s),
                from_ends_s: near_s.into_iter().flatten().fold(f64::INFINITY, f64::min),
                forward: self.forward,
            });
        }
        self.laser_before_s = last_s.or(self.laser_before_s);
    }
}
