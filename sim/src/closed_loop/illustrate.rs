//! Two short runs of the device for pictures: figures 3 and 16, and figure 12 of document 1.

use helixlock_plant::Machine;

use super::feedback::ClosedLoop;
use super::pass::reset;
use super::pins::clock_of;
use super::probe::{Probe, Waveform};
use super::simulate::{Course, ready};
use super::swing::{Progress, Swing};
use crate::Error;
use crate::device::DeviceEngine;
use crate::engine::Engine;

/// Comparisons shown, and of one swing of the table.
const COMPARISONS: f64 = 5.0;

/// Swing of the table: this part of the range either way, an eighth of a turn of phase.
const SWING: f64 = 0.125;

/// Comparisons from the end of the selection to the picture.
const BEFORE: f64 = 1.4;

/// Calibration periods of eight lines shown, for each of its two phases.
const CALIBRATIONS: f64 = 3.0;

/// `calibrate` input: 180° and 135°.
const HALF_TURN: u64 = 1;
const EIGHTH_BELOW: u64 = 3;

/// What the device shows of a machine whose error can be seen by eye.
#[derive(Clone, Debug)]
pub struct Illustrations {
    /// Comparisons with the loop closed and a table that swings by an eighth of the range.
    pub comparison: Waveform,
    /// Calibration: 180°, then 45° below it.
    pub calibration: Waveform,
}

/// Runs the device, set as for `machine`, on a table that swings.
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine.
pub fn illustrate(machine: &Machine, course: &Course) -> Result<Illustrations, Error> {
    Ok(Illustrations {
        comparison: comparison(machine, course)?,
        calibration: calibration(machine, course)?,
    })
}

fn comparison(machine: &Machine, course: &Course) -> Result<Waveform, Error> {
    let period_s = 1.0 / course.comparison_hz;
    let selecting_s = f64::from(machine.dividers.initial_phase) * machine.fringe_um()
        / (1000.0 * machine.travel_mm_per_s());
    // The comparison after the selection is still even; the picture begins just before the next.
    let begin_s = selecting_s + BEFORE * period_s;
    let swing = Swing {
        amplitude_um: SWING * course.full_scale_um,
        period_s: COMPARISONS * period_s,
        begin_s,
        ..still(machine)
    };
    let end_s = begin_s + COMPARISONS * period_s;
    let mut device = joined(course, swing)?;
    let pins = device.pins();
    device.engine().set_input(pins.correct, 1);
    device.set_moving()?;
    record(&mut device, course, &[begin_s, end_s], COMPARISON, |_, _| {})
}

fn calibration(machine: &Machine, course: &Course) -> Result<Waveform, Error> {
    let swing = still(machine);
    let period_s = 8.0 * swing.line_um / swing.speed_um_per_s;
    let mut device = joined(course, swing)?;
    let pins = device.pins();
    device.engine().set_input(pins.calibrate, HALF_TURN);
    device.set_moving()?;
    // The clamp lets go with the first line; the picture begins a period later.
    let marks = [1.0, 1.0 + CALIBRATIONS, 1.0 + 2.0 * CALIBRATIONS].map(|n| (n + 0.05) * period_s);
    record(&mut device, course, &marks, CALIBRATION, |device, mark| {
        if mark == 1 {
            let pins = device.pins();
            device.engine().set_input(pins.calibrate, EIGHTH_BELOW);
        }
    })
}

/// Signals of figures 3 and 16.
const COMPARISON: &[&str] = &[
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
];

/// Signals of figure 12.
const CALIBRATION: &[&str] = &["grating", "calibrate", "t1", "t2"];

type Device = ClosedLoop<DeviceEngine, Swing>;

/// A table without error: lines and fringes fit together exactly.
fn still(machine: &Machine) -> Swing {
    let lead_um = 1000.0 * machine.workpiece.lead.mm();
    let line_um = lead_um / f64::from(machine.grating.lines);
    let dividers = &machine.dividers;
    Swing {
        speed_um_per_s: 1000.0 * machine.travel_mm_per_s(),
        line_um,
        fringe_um: line_um * f64::from(dividers.a) / f64::from(dividers.b),
        amplitude_um: 0.0,
        period_s: 1.0,
        step_um: machine.drive.step_um,
        begin_s: 0.0,
        progress: Progress::START,
    }
}

/// A device that has been reset and started.
fn joined(course: &Course, swing: Swing) -> Result<Device, Error> {
    let mut device =
        ClosedLoop::new(ready(course)?, swing, course.clock_hz(), course.full_scale_um)?;
    reset(&mut device)?;
    Ok(device)
}

/// Runs to each mark in turn and records from the first to the last.
fn record(
    device: &mut Device,
    course: &Course,
    marks_s: &[f64],
    names: &[&str],
    mut at_mark: impl FnMut(&mut Device, usize),
) -> Result<Waveform, Error> {
    let clock = |time_s: f64| clock_of(time_s, course.clock_hz());
    let netlist = device.engine().netlist();
    let signals = names.iter().filter_map(|name| netlist.find(name)).collect();
    let ends = [marks_s.first(), marks_s.last()].map(|end| end.map_or(0, |&end_s| clock(end_s)));
    let mut probe = Some(Probe { signals, window: ends[0]..ends[1] });
    for (mark, &time_s) in marks_s.iter().enumerate() {
        device.run_until(clock(time_s), |_| false)?;
        if let Some(probe) = probe.take() {
            device.begin_recording(probe);
        }
        at_mark(device, mark);
    }
    Ok(device.end_recording().unwrap_or_default())
}
