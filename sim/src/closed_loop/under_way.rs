//! A pass that is run on from instant to instant, for whoever shares its time with other simulations.

use helixlock_plant::Model;

use super::feedback::ClosedLoop;
use super::grinder::Grinder;
use super::pass::{measuring, reset};
use super::pins::clock_of;
use super::simulate::{Course, Options, ready};
use crate::Error;
use crate::device::DeviceEngine;
use crate::engine::Engine;

/// Device and machine in the middle of a pass.
#[derive(Debug)]
pub struct UnderWay {
    /// What was fixed before the first clock.
    pub course: Course,
    device: ClosedLoop<DeviceEngine, Grinder>,
    correct: bool,
}

impl UnderWay {
    /// A machine that begins to move, behind the device's reset.
    ///
    /// # Errors
    ///
    /// [`Error`] when the device cannot serve the machine.
    pub fn new(model: &Model, options: &Options) -> Result<Self, Error> {
        let course = Course::new(model, options)?;
        let grinder = Grinder::new(model, course.length_mm)?;
        let (clock_hz, full_scale_um) = (course.clock_hz(), course.full_scale_um);
        let mut device = ClosedLoop::new(ready(&course)?, grinder, clock_hz, full_scale_um)?;
        reset(&mut device)?;
        device.set_moving()?;
        Ok(Self { course, device, correct: false })
    }

    /// The switches: to correct, which waits for the initial phase, and to play steps back.
    pub fn set_switches(&mut self, correct: bool, playback: bool) {
        let pins = self.device.pins();
        self.correct = correct;
        if !correct {
            self.device.engine().set_input(pins.correct, 0);
        }
        self.device.engine().set_input(pins.playback, u64::from(playback));
    }

    /// Runs on to an instant, s since the start; where the pass ends the machine stands.
    ///
    /// # Errors
    ///
    /// As [`ClosedLoop::run_until`].
    pub fn run_to(&mut self, time_s: f64) -> Result<(), Error> {
        let pins = self.device.pins();
        let clock = clock_of(time_s, self.course.clock_hz());
        let end = clock_of(self.course.duration_s, self.course.clock_hz());
        if self.correct && self.device.engine().value(pins.correct) == 0 {
            let selected = |engine: &mut DeviceEngine| measuring(engine, pins);
            if !selected(self.device.engine()) {
                self.device.run_until(clock.min(end), selected)?;
            }
            if selected(self.device.engine()) {
                self.device.engine().set_input(pins.correct, 1);
            }
        }
        self.device.run_until(clock.min(end), |_| false)?;
        if end <= clock {
            self.device.hold();
        }
        self.device.run_until(clock, |_| false)
    }

    /// Device and machine as they are now.
    pub fn device(&mut self) -> &mut ClosedLoop<DeviceEngine, Grinder> {
        &mut self.device
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::closed_loop::simulate;

    /// In pieces of any length the pass is the one that is run at once, and so is the way home.
    #[test]
    fn pieces_are_the_whole() {
        let path = Path::new("../examples/sg7430-6mm/machine.toml");
        let model = Model::read(path).unwrap();
        let options = Options { length_mm: Some(10.0) };
        let whole = simulate(&model, &options, &mut |_| {}).unwrap();
        let end_s = whole.course.duration_s;
        for pieces in [3, 400] {
            let mut pass = UnderWay::new(&model, &options).unwrap();
            pass.set_switches(true, false);
            for piece in 1..=pieces {
                pass.run_to(end_s * f64::from(piece) / f64::from(pieces)).unwrap();
            }
            let device = pass.device();
            let times_s: Vec<f64> = device.samples.iter().map(|sample| sample.time_s).collect();
            assert_eq!(times_s, whole.closed.trace.time_s);
            assert_eq!(device.steps, whole.closed.steps_net);
            assert_eq!(device.steps_taken, whole.closed.steps_taken);
            pass.set_switches(false, true);
            pass.run_to(end_s + 10.0).unwrap();
            let home = whole.closed.playback.unwrap();
            assert_ne!(home.steps, 0);
            assert_eq!(pass.device().steps, 0);
            assert_eq!(pass.device().steps_taken, whole.closed.steps_taken + home.steps);
        }
    }
}
