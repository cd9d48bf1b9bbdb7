//! Board shell: the device with its wheels set, and the pins a builder wires.
//!
//! No figure. The presets come from the machine file as constants of the generated design; the
//! rest are pins. All inputs are active high.
//!
//! | pin                   | dir | wire it to                                               |
//! |-----------------------|-----|----------------------------------------------------------|
//! | `clock`               | in  | the board's oscillator                                   |
//! | `grating`             | in  | shaped grating signal, one rising edge a line            |
//! | `laser`               | in  | shaped interferometer signal, one rising edge a fringe   |
//! | `start`               | in  | switch: select the initial phase, then measure           |
//! | `correct`             | in  | switch: correct, else only measure                       |
//! | `playback`            | in  | switch "reset": steps back to zero                       |
//! | `calibrate[1:0]`      | in  | switch: off, 180°, 90°, 45°                              |
//! | `manual_step`         | in  | push button: one step                                    |
//! | `manual_forward`      | in  | switch: its direction                                    |
//! | `range_x2`            | in  | switch: ×2 instead of ×1                                 |
//! | `t1`, `t2`            | out | RC low-pass each, the difference to the recorder         |
//! | `phase_a` … `phase_c` | out | power stage of the three windings                        |
//! | `step`, `direction`   | out | … or a bought stepper driver                             |
//! | `zero`                | out | lamp: the motor stands where it began                    |
//! | `fault`               | out | lamp: out of steps, 4095 from zero                       |
//! | `measuring`           | out | lamp: the initial phase is selected                      |
//!
//! # Sequence
//!
//! | clocks since power-up | 0 … 14                   | 15 …            |
//! |-----------------------|--------------------------|-----------------|
//! | device                | in reset, ring at A      | runs            |
//!
//! # At the same time
//!
//! As in the [device](crate::device). Lamps and phases come from flip-flops; `t1` and `t2` pass
//! one gate behind theirs, which a filter does not notice.
//!
//! # Inferred
//!
//! All of it. The power-on reset is a counter that FPGAs start at zero. The range is a pin, as
//! on the original's panel, and the machine file's choice is for the builder to set.

use rust_hdl::prelude::*;

use crate::device::Device;
use crate::settings::{Settings, SettingsError};
use crate::step_driver::{PULSE_CLOCKS, StepDriver};

/// The device on a board; see the [module](self) for pins.
#[derive(Debug, LogicBlock)]
pub struct BoardShell {
    /// The board's oscillator.
    pub clock: Signal<In, Clock>,
    /// Grating lines.
    pub grating: Signal<In, Bit>,
    /// Interference fringes.
    pub laser: Signal<In, Bit>,
    /// Select the initial phase, then measure.
    pub start: Signal<In, Bit>,
    /// Correct, else only measure.
    pub correct: Signal<In, Bit>,
    /// Steps back to zero.
    pub playback: Signal<In, Bit>,
    /// 0 off, 1 180°, 2 90°, 3 45°.
    pub calibrate: Signal<In, Bits<2>>,
    /// Rising edge: one step.
    pub manual_step: Signal<In, Bit>,
    /// Its direction.
    pub manual_forward: Signal<In, Bit>,
    /// ×2 instead of ×1.
    pub range_x2: Signal<In, Bit>,
    /// Meter, or the calibration.
    pub t1: Signal<Out, Bit>,
    /// Its complement.
    pub t2: Signal<Out, Bit>,
    /// Drive of phase A.
    pub phase_a: Signal<Out, Bit>,
    /// Drive of phase B.
    pub phase_b: Signal<Out, Bit>,
    /// Drive of phase C.
    pub phase_c: Signal<Out, Bit>,
    /// Step pulse for a driver.
    pub step: Signal<Out, Bit>,
    /// Direction for a driver.
    pub direction: Signal<Out, Bit>,
    /// The motor stands where it began.
    pub zero: Signal<Out, Bit>,
    /// A step was refused.
    pub fault: Signal<Out, Bit>,
    /// The initial phase is selected.
    pub measuring: Signal<Out, Bit>,
    device: Device,
    step_driver: StepDriver,
    power_up: DFF<Bits<4>>,
    power_up_next: Signal<Local, Bits<4>>,
    reset: Signal<Local, Bit>,
    divide_a: Constant<Bits<12>>,
    divide_b: Constant<Bits<12>>,
    initial_phase: Constant<Bits<12>>,
    compensation: Constant<Bits<16>>,
    compensation_insert: Constant<Bit>,
    step_period: Constant<Bits<24>>,
}

impl BoardShell {
    /// The shell with these presets; the range is a pin and not taken from them.
    ///
    /// # Errors
    ///
    /// A value no wheel can show, or a step clock faster than the step pin's pulses.
    pub fn new(settings: &Settings) -> Result<Self, SettingsError> {
        let wheels = settings.wheels()?;
        if settings.step_period < PULSE_CLOCKS {
            return Err(SettingsError::StepTooFast {
                found: settings.step_period,
                least: PULSE_CLOCKS,
            });
        }
        Ok(Self {
            clock: Signal::default(),
            grating: Signal::default(),
            laser: Signal::default(),
            start: Signal::default(),
            correct: Signal::default(),
            playback: Signal::default(),
            calibrate: Signal::default(),
            manual_step: Signal::default(),
            manual_forward: Signal::default(),
            range_x2: Signal::default(),
            t1: Signal::default(),
            t2: Signal::default(),
            phase_a: Signal::default(),
            phase_b: Signal::default(),
            phase_c: Signal::default(),
            step: Signal::default(),
            direction: Signal::default(),
            zero: Signal::default(),
            fault: Signal::default(),
            measuring: Signal::default(),
            device: Device::default(),
            step_driver: StepDriver::default(),
            power_up: DFF::default(),
            power_up_next: Signal::default(),
            reset: Signal::default(),
            divide_a: Constant::new(wheels.divide_a.into()),
            divide_b: Constant::new(wheels.divide_b.into()),
            initial_phase: Constant::new(wheels.initial_phase.into()),
            compensation: Constant::new(wheels.compensation.into()),
            compensation_insert: Constant::new(wheels.compensation_insert == 1),
            step_period: Constant::new(wheels.step_period.into()),
        })
    }

    /// The same with its input pins connected, ready to be elaborated or simulated.
    ///
    /// # Errors
    ///
    /// As [`BoardShell::new`].
    pub fn connected(settings: &Settings) -> Result<Self, SettingsError> {
        let mut shell = Self::new(settings)?;
        shell.clock.connect();
        shell.grating.connect();
        shell.laser.connect();
        shell.start.connect();
        shell.correct.connect();
        shell.playback.connect();
        shell.calibrate.connect();
        shell.manual_step.connect();
        shell.manual_forward.connect();
        shell.range_x2.connect();
        shell.connect_all();
        Ok(shell)
    }
}

impl Logic for BoardShell {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, power_up);
        self.power_up_next.next = self.power_up.q.val() + 1;
        self.reset.next = !self.power_up.q.val().all();
        if self.reset.val() {
            self.power_up.d.next = self.power_up_next.val();
        }

        self.device.clock.next = self.clock.val();
        self.device.master_reset.next = self.reset.val();
        self.device.grating.next = self.grating.val();
        self.device.laser.next = self.laser.val();
        self.device.start.next = self.start.val();
        self.device.correct.next = self.correct.val();
        self.device.playback.next = self.playback.val();
        self.device.calibrate.next = self.calibrate.val();
        self.device.manual_step.next = self.manual_step.val();
        self.device.manual_forward.next = self.manual_forward.val();
        self.device.divide_a.next = self.divide_a.val();
        self.device.divide_b.next = self.divide_b.val();
        self.device.range_x2.next = self.range_x2.val();
        self.device.initial_phase.next = self.initial_phase.val();
        self.device.compensation.next = self.compensation.val();
        self.device.compensation_insert.next = self.compensation_insert.val();
        self.device.step_period.next = self.step_period.val();
        self.step_driver.clock.next = self.clock.val();
        self.step_driver.clear.next = self.reset.val();
        self.step_driver.step.next = self.device.step.val();
        self.step_driver.forward.next = self.device.forward.val();

        self.t1.next = self.device.t1.val();
        self.t2.next = self.device.t2.val();
        self.phase_a.next = self.device.phase_a.val();
        self.phase_b.next = self.device.phase_b.val();
        self.phase_c.next = self.device.phase_c.val();
        self.step.next = self.step_driver.step_pin.val();
        self.direction.next = self.step_driver.direction_pin.val();
        self.zero.next = self.device.zero.val();
        self.fault.next = self.device.fault.val();
        self.measuring.next = self.device.measuring.val();
    }
}
