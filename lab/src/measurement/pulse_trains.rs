//! Two captured pulse trains as measured samples: the phase of every comparison, from its edges.
//!
//! At every `range · A`-th grating line the theoretical helix has gone on by `range · B` fringes;
//! what the laser has counted less is the error of the comparison (figs. 3 and 6 of document 1):
//!
//! ```text
//! error_um = (range · B · k − n(t_k)) · λ/2        k-th comparison, at the instant t_k
//! ```
//!
//! `n` is the number of fringes since the first comparison, straight between two edges, so that
//! nothing wraps. A train that was captured behind the dividers has one pulse a comparison.

use std::path::PathBuf;

use helixlock_plant::{LowPass, Machine, Model};
use helixlock_traces::{Column, Table};

use super::error::LabError;
use crate::numerics::count;
use crate::policy::reading::{FEWEST_PULSES, MOST_OFF};

/// Rising edges of both references, and the steps of the corrector if they were captured.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PulseTrains {
    /// The file they came from.
    pub path: PathBuf,
    /// Grating lines, or pulses behind divider A, s.
    pub grating_s: Vec<f64>,
    /// Fringes, or pulses behind divider B, s.
    pub laser_s: Vec<f64>,
    /// Steps of the motor.
    pub steps: Option<Steps>,
}

/// Steps of the motor, in the order they were taken.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Steps {
    /// Instants, s.
    pub at_s: Vec<f64>,
    /// True for a step forward.
    pub forward: Vec<bool>,
}

/// Where in the device the trains were picked up.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tap {
    /// Grating pulses of one comparison.
    lines: usize,
    /// Laser pulses of one comparison.
    fringes: f64,
    /// Table travel of a laser pulse, µm.
    fringe_um: f64,
    /// True behind the dividers.
    divided: bool,
}

impl PulseTrains {
    /// One row a comparison: `time_s`, `angle_rev`, `position_mm`, `error_um`, and `steps` if they
    /// were captured; and what a user should know of how they were read.
    ///
    /// The recorder's filter and lags are applied, because a capture has not been through them.
    /// Travel counts from the first line of the capture, and the spindle is taken to run forward.
    ///
    /// # Errors
    ///
    /// Fewer than four pulses in a train, or trains whose ratio is not that of the machine.
    pub fn table(&self, machine: &Model) -> Result<(Table, Vec<String>), LabError> {
        for (train, pulses) in [("grating", &self.grating_s), ("laser", &self.laser_s)] {
            if pulses.len() < FEWEST_PULSES {
                let path = self.path.display().to_string();
                return Err(LabError::FewPulses {
                    path,
                    train,
                    found: pulses.len(),
                    expected: FEWEST_PULSES,
                });
            }
        }
        let tap = tap(machine, rate_hz(&self.grating_s));
        let found = rate_hz(&self.laser_s) / rate_hz(&self.grating_s);
        let expected = tap.fringes / count(tap.lines);
        if !(1.0 / MOST_OFF..=MOST_OFF).contains(&(found / expected)) {
            let path = self.path.display().to_string();
            return Err(LabError::PulseRatio { path, found, expected });
        }
        let turns_a_row = count(tap.lines_of(machine)) / f64::from(machine.grating.lines);
        let (instants, raw_um) = self.comparisons(machine, tap);
        let angle_rev: Vec<f64> = (0..instants.len()).map(|row| count(row) * turns_a_row).collect();
        let lead_mm = machine.workpiece.lead.mm();
        let column = |name: &str, values| Column { name: name.to_owned(), values };
        let mut columns = vec![
            column("position_mm", angle_rev.iter().map(|turns| turns * lead_mm).collect()),
            column("angle_rev", angle_rev),
            column("error_um", recorded(machine, &instants, raw_um)),
        ];
        columns.extend(self.steps.as_ref().map(|steps| column("steps", steps.net_at(&instants))));
        columns.push(column("time_s", instants));
        let mut table = Table::new(columns);
        table.path.clone_from(&self.path);
        Ok((table, self.notes(machine, tap)))
    }

    /// Instants and raw errors, µm, of the comparisons that lie within the laser's train.
    fn comparisons(&self, machine: &Machine, tap: Tap) -> (Vec<f64>, Vec<f64>) {
        let first = self.grating_s.partition_point(|at| *at < self.laser_s[0]);
        let mut counter = Counter { fringes_s: &self.laser_s, passed: 0 };
        let (mut instants, mut errors, mut start) = (Vec::new(), Vec::new(), None);
        for &at in self.grating_s[first..].iter().step_by(tap.lines) {
            let Some(passed) = counter.at(at) else { break };
            let passed = passed - *start.get_or_insert(passed);
            let due = tap.fringes * count(instants.len());
            instants.push(at);
            errors.push((due - passed + blocked(machine, tap, passed)) * tap.fringe_um);
        }
        (instants, errors)
    }

    fn notes(&self, machine: &Machine, tap: Tap) -> Vec<String> {
        let place = if tap.divided { "behind the dividers" } else { "before the dividers" };
        let mut notes = vec![format!(
            "{} grating and {} laser pulses, captured {place}",
            self.grating_s.len(),
            self.laser_s.len()
        )];
        if machine.loop_closed && self.steps.is_none() {
            notes.push(
                "the loop is closed and its steps are not captured: the error is what it leaves"
                    .to_owned(),
            );
        }
        notes
    }
}

impl Tap {
    /// Grating lines of one comparison, wherever the train was picked up.
    fn lines_of(self, machine: &Machine) -> usize {
        if self.divided { lines_a_comparison(machine) } else { self.lines }
    }
}

impl Steps {
    /// Net steps since the beginning, forward positive, at each of some rising instants.
    fn net_at(&self, instants: &[f64]) -> Vec<f64> {
        let mut steps = self.at_s.iter().zip(&self.forward).peekable();
        let mut net = 0.0;
        let mut at = |instant: f64| {
            while let Some((_, forward)) = steps.next_if(|(at, _)| **at <= instant) {
                net += if *forward { 1.0 } else { -1.0 };
            }
            net
        };
        instants.iter().map(|instant| at(*instant)).collect()
    }
}

/// Fringes passed, straight between two edges; asked for at rising instants.
struct Counter<'a> {
    fringes_s: &'a [f64],
    passed: usize,
}

impl Counter<'_> {
    /// Number at an instant, or `None` outside the train.
    fn at(&mut self, instant: f64) -> Option<f64> {
        while self.fringes_s.get(self.passed + 1).is_some_and(|next| *next <= instant) {
            self.passed += 1;
        }
        let (from, to) = (self.fringes_s[self.passed], *self.fringes_s.get(self.passed + 1)?);
        (from <= instant).then(|| count(self.passed) + (instant - from) / (to - from))
    }
}

/// Pulses a second from the first to the last.
fn rate_hz(pulses_s: &[f64]) -> f64 {
    let span_s = pulses_s[pulses_s.len() - 1] - pulses_s[0];
    count(pulses_s.len() - 1) / span_s.max(f64::MIN_POSITIVE)
}

fn lines_a_comparison(machine: &Machine) -> usize {
    usize::from(machine.dividers.a) * usize::from(machine.dividers.range.factor())
}

/// Before or behind the dividers, whichever rate is nearer to that of the machine's speed.
fn tap(machine: &Machine, grating_hz: f64) -> Tap {
    let lines = lines_a_comparison(machine);
    let raw_hz = f64::from(machine.grating.lines) * machine.spindle.speed_rpm / 60.0;
    let off = |expected_hz: f64| libm::log(grating_hz / expected_hz).abs();
    let fringes = f64::from(machine.dividers.b) * f64::from(machine.dividers.range.factor());
    if off(raw_hz / count(lines)) < off(raw_hz) {
        let fringe_um = machine.full_scale_um();
        return Tap { lines: 1, fringes: 1.0, fringe_um, divided: true };
    }
    Tap { lines, fringes, fringe_um: machine.fringe_um(), divided: false }
}

/// How many of the fringes passed the cumulative compensator has blocked; negative when it inserts
/// some. It is taken to count from the first comparison of the capture, as the model does.
fn blocked(machine: &Machine, tap: Tap, passed: f64) -> f64 {
    let cycle = machine.dividers.compensation_cycle().filter(|_| !tap.divided);
    cycle.map_or(0.0, |cycle| {
        // Behind the F-th fringe, as in the model's stairs.
        let cycles = ((passed - 0.5) / f64::from(cycle)).floor().max(0.0);
        libm::copysign(cycles, machine.dividers.compensation_um_per_m)
    })
}

/// What the recorder would have drawn of raw errors.
fn recorded(machine: &Model, instants: &[f64], raw_um: Vec<f64>) -> Vec<f64> {
    let filters = machine.filter_cutoff_hz.map(LowPass::with_cutoff).into_iter();
    let lags = machine.recorder_lags_s().into_iter().map(LowPass::new);
    filters.chain(lags).fold(raw_um, |values, filter| filter.pass(instants, &values))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use helixlock_plant::prediction::predict;
    use helixlock_plant::{Record, Samples};

    use super::*;

    /// The 6 mm lead of document 1, a 0.25 mm piece of it, at 0.6 mm/s.
    fn machine(more: &str) -> Model {
        let text = format!(
            "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\ngrating.lines = 13906\n\
             laser.wavelength = '0.63281983 um'\ndrive.step = '0.0125 um'\n\
             drive.frequency = '100 Hz'\ndividers = {{ a = 110, b = 150, range = 1, {more} }}\n"
        );
        Model::parse(&text, Path::new("machine.toml")).expect("a machine")
    }

    /// Pulses at a rate, from an instant on.
    fn train(hz: f64, from_s: f64, to_s: f64) -> Vec<f64> {
        let mut at = from_s;
        let mut pulses = Vec::new();
        while at < to_s {
            pulses.push(at);
            at = from_s + count(pulses.len()) / hz;
        }
        pulses
    }

    const LINES_HZ: f64 = 1390.6;

    fn error_um(trains: &PulseTrains, machine: &Model) -> Vec<f64> {
        let (table, _) = trains.table(machine).expect("two good trains");
        table.column("error_um").expect("it is made").to_vec()
    }

    /// A table that follows the lead exactly leaves the slope of the rationalisation, −0.846 µm/m
    /// after document 1, and the compensator's stairs; the model derives both in another way.
    #[test]
    fn a_perfect_lead_leaves_what_the_machine_file_implies() {
        for compensation in ["", "compensation = '6.4 um/m'", "compensation = '-6.4 um/m'"] {
            let machine = machine(compensation);
            let fringes_hz = 600.0 / machine.fringe_um();
            let trains = PulseTrains {
                grating_s: train(LINES_HZ, 0.5, 100.0),
                laser_s: train(fringes_hz, 0.4, 100.0),
                ..PulseTrains::default()
            };
            let (table, _) = trains.table(&machine).expect("two good trains");
            let places_mm = table.column("position_mm").expect("it is made").to_vec();
            let record = Record::new(&machine, &Samples::forward(&machine, places_mm));
            let implied = predict(&machine, &record).expect("no effects").error_um;
            for (error, implied) in
                table.column("error_um").expect("it is made").iter().zip(implied)
            {
                assert!((error - implied).abs() < 1e-4, "{compensation}: {error}, not {implied}");
            }
        }
    }

    /// One fringe too few is half a wavelength behind the helix: positive, the laser lags.
    #[test]
    fn a_missing_fringe_is_half_a_wavelength() {
        let machine = machine("");
        let mut laser_s = train(LINES_HZ * 150.0 / 110.0, 0.0, 20.0);
        laser_s.remove(10_000);
        let trains = PulseTrains {
            grating_s: train(LINES_HZ, 0.0, 20.0),
            laser_s,
            ..PulseTrains::default()
        };
        let errors = error_um(&trains, &machine);
        assert!(errors[1].abs() < 1e-9);
        assert!((errors[errors.len() - 1] - 0.316_409_915).abs() < 1e-9);
    }

    /// Divided trains of the same machine, the laser a tenth of a comparison late.
    #[test]
    fn divided_trains_give_the_phase_of_their_pulses() {
        let machine = machine("");
        let comparisons_hz = LINES_HZ / 110.0;
        let mut laser_s = train(comparisons_hz, 0.0, 20.0);
        laser_s[100..].iter_mut().for_each(|at| *at += 0.1 / comparisons_hz);
        let trains = PulseTrains {
            grating_s: train(comparisons_hz, 0.0, 20.0),
            laser_s,
            ..PulseTrains::default()
        };
        let errors = error_um(&trains, &machine);
        // 360° are B·λ/2 = 47.46 µm: document 1, the range of ×1.
        assert!((errors[150] - 4.746_148_725).abs() < 1e-9, "{}", errors[150]);
    }

    #[test]
    fn steps_are_counted_with_their_sign() {
        let steps =
            Steps { at_s: vec![0.1, 0.2, 0.3, 0.9], forward: vec![true, true, false, true] };
        assert_eq!(steps.net_at(&[0.0, 0.2, 0.5, 1.0]), [0.0, 2.0, 1.0, 2.0]);
    }

    #[test]
    fn exchanged_trains_are_refused() {
        let trains = PulseTrains {
            path: "two.vcd".into(),
            grating_s: train(LINES_HZ * 150.0 / 110.0, 0.0, 5.0),
            laser_s: train(LINES_HZ, 0.0, 5.0),
            steps: None,
        };
        let message = trains.table(&machine("")).unwrap_err().to_string();
        assert!(message.starts_with("two.vcd: found 0.7333 laser pulses a grating"), "{message}");
    }
}
