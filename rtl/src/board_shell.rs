//! Board shell: the device with its wheels set, and the pins a builder wires.
//!
//! No figure. The presets come from the machine file as constants of the generated design; the
//! rest are pins. Pins marked * are left out of a design that does not ask for them.
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
//! | `range_x2`            | in  | * switch: ×2 instead of ×1                               |
//! | `enable`              | in  | * switch: steps are allowed                              |
//! | `emergency_stop`      | in  | * contact to ground that opens: high stops all steps     |
//! | `grating_b`           | in  | * second signal of the grating, a quarter of a line late |
//! | `laser_b`             | in  | * second signal of the laser, a quarter of a fringe late |
//! | `grating_index`       | in  | * index of the grating: a pass begins there              |
//! | `laser_index`         | in  | * index of a scale in the laser's place, likewise        |
//! | `rx`                  | in  | * serial port: settings from the computer                |
//! | `t1`, `t2`            | out | RC low-pass each, the difference to the recorder         |
//! | `phase_a` … `phase_c` | out | power stage of the three windings                        |
//! | `step`, `direction`   | out | … or a bought stepper driver                             |
//! | `zero`                | out | lamp: the motor stands where it began                    |
//! | `fault`               | out | lamp: out of steps, 4095 from zero                       |
//! | `measuring`           | out | lamp: the initial phase is selected                      |
//! | `alarm`               | out | lamp: a signal is missing, the meter wrapped, or a stop  |
//! | `tx`                  | out | serial port: a frame for every comparison                |
//!
//! # Sequence
//!
//! | clocks since power-up | 0 … 14                   | 15 …            |
//! |-----------------------|--------------------------|-----------------|
//! | device                | in reset, ring at A      | runs            |
//!
//! # At the same time
//!
//! As in the [device](crate::device) and the [supervisor](crate::supervisor). Lamps come from
//! flip-flops; `t1` and `t2`, and the phases, pass one gate behind theirs, which neither a filter
//! nor a winding notices. What the supervisor remembers it forgets when `start`, `correct` and
//! `playback` are all off, so that nothing moves because a stop was released.
//!
//! With a second signal lines that go back are owed, and a pass goes on where it went back. What is
//! owed is forgotten while `start` is off. More than 65 535 of them count as a stop.
//!
//! # Inferred
//!
//! All of it. The power-on reset is a counter that FPGAs start at zero. The range is a setting like
//! the others unless a switch is asked for, as on the original's panel.

use rust_hdl::prelude::*;

use crate::device::Device;
use crate::index_gate::IndexGate;
use crate::input_conditioner::InputConditioner;
use crate::input_synchroniser::InputSynchroniser;
use crate::level_synchroniser::LevelSynchroniser;
use crate::quadrature_decoder::QuadratureDecoder;
use crate::settings::{Conditioning, Settings, SettingsError};
use crate::settings_port::SettingsPort;
use crate::step_clock::StepClock;
use crate::step_driver::{PULSE_CLOCKS, StepDriver};
use crate::supervisor::Supervisor;
use crate::telemetry::Telemetry;
use crate::uart_receiver::UartReceiver;
use crate::uart_transmitter::UartTransmitter;

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
    /// Steps are allowed.
    pub enable: Signal<In, Bit>,
    /// High stops all steps.
    pub emergency_stop: Signal<In, Bit>,
    /// Second signal of the grating.
    pub grating_b: Signal<In, Bit>,
    /// Second signal of the laser.
    pub laser_b: Signal<In, Bit>,
    /// Index of the grating.
    pub grating_index: Signal<In, Bit>,
    /// Index in the place of the laser.
    pub laser_index: Signal<In, Bit>,
    /// Settings from the computer.
    pub rx: Signal<In, Bit>,
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
    /// A signal is missing, the meter wrapped, or a stop.
    pub alarm: Signal<Out, Bit>,
    /// A frame for every comparison.
    pub tx: Signal<Out, Bit>,
    device: Device,
    step_driver: StepDriver,
    milliseconds: StepClock,
    supervisor: Supervisor,
    telemetry: Telemetry,
    transmitter: UartTransmitter,
    receiver: UartReceiver,
    settings_port: SettingsPort,
    grating_input: InputConditioner,
    laser_input: InputConditioner,
    start_input: InputConditioner,
    correct_input: InputConditioner,
    playback_input: InputConditioner,
    manual_step_input: InputConditioner,
    range_input: InputConditioner,
    enable_input: InputConditioner,
    stop_input: LevelSynchroniser,
    grating_b_input: InputConditioner,
    laser_b_input: InputConditioner,
    grating_index_input: InputConditioner,
    laser_index_input: InputConditioner,
    grating_decoder: QuadratureDecoder,
    laser_decoder: QuadratureDecoder,
    grating_gate: IndexGate,
    laser_gate: IndexGate,
    lines: InputSynchroniser,
    fringes: InputSynchroniser,
    power_up: DFF<Bits<4>>,
    power_up_next: Signal<Local, Bits<4>>,
    reset: Signal<Local, Bit>,
    idle: Signal<Local, Bit>,
    at_rest: Signal<Local, Bit>,
    every_clock: Signal<Local, Bit>,
    nothing: Signal<Local, Bit>,
    divide_a: Constant<Bits<12>>,
    divide_b: Constant<Bits<12>>,
    initial_phase: Constant<Bits<12>>,
    compensation: Constant<Bits<16>>,
    compensation_insert: Constant<Bit>,
    step_period: Constant<Bits<24>>,
    range_set: Constant<Bit>,
    range_wired: Constant<Bit>,
    enable_wired: Constant<Bit>,
    grating_b_wired: Constant<Bit>,
    laser_b_wired: Constant<Bit>,
    grating_index_wired: Constant<Bit>,
    laser_index_wired: Constant<Bit>,
    glitch_clocks: Constant<Bits<4>>,
    debounce_ticks: Constant<Bits<4>>,
    tick_period: Constant<Bits<24>>,
    watchdog_ticks: Constant<Bits<12>>,
    active_low: Constant<Bit>,
    bit_clocks: Constant<Bits<12>>,
    calibrate_inverted: Constant<Bits<2>>,
}

impl BoardShell {
    /// The shell with these presets.
    ///
    /// # Errors
    ///
    /// A value no wheel can show or no counter hold, or a step clock faster than the step pin's
    /// pulses.
    #[expect(clippy::too_many_lines, reason = "fields, each of a line")]
    pub fn new(settings: &Settings, conditioning: &Conditioning) -> Result<Self, SettingsError> {
        let wheels = settings.wheels()?;
        conditioning.check()?;
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
            enable: Signal::default(),
            emergency_stop: Signal::default(),
            grating_b: Signal::default(),
            laser_b: Signal::default(),
            grating_index: Signal::default(),
            laser_index: Signal::default(),
            rx: Signal::default(),
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
            alarm: Signal::default(),
            tx: Signal::default(),
            device: Device::default(),
            step_driver: StepDriver::default(),
            milliseconds: StepClock::default(),
            supervisor: Supervisor::default(),
            telemetry: Telemetry::default(),
            transmitter: UartTransmitter::default(),
            receiver: UartReceiver::default(),
            settings_port: SettingsPort::default(),
            grating_input: InputConditioner::default(),
            laser_input: InputConditioner::default(),
            start_input: InputConditioner::default(),
            correct_input: InputConditioner::default(),
            playback_input: InputConditioner::default(),
            manual_step_input: InputConditioner::default(),
            range_input: InputConditioner::default(),
            enable_input: InputConditioner::default(),
            stop_input: LevelSynchroniser::default(),
            grating_b_input: InputConditioner::default(),
            laser_b_input: InputConditioner::default(),
            grating_index_input: InputConditioner::default(),
            laser_index_input: InputConditioner::default(),
            grating_decoder: QuadratureDecoder::default(),
            laser_decoder: QuadratureDecoder::default(),
            grating_gate: IndexGate::default(),
            laser_gate: IndexGate::default(),
            lines: InputSynchroniser::default(),
            fringes: InputSynchroniser::default(),
            power_up: DFF::default(),
            power_up_next: Signal::default(),
            reset: Signal::default(),
            idle: Signal::default(),
            at_rest: Signal::default(),
            every_clock: Signal::default(),
            nothing: Signal::default(),
            divide_a: Constant::new(wheels.divide_a.into()),
            divide_b: Constant::new(wheels.divide_b.into()),
            initial_phase: Constant::new(wheels.initial_phase.into()),
            compensation: Constant::new(wheels.compensation.into()),
            compensation_insert: Constant::new(wheels.compensation_insert == 1),
            step_period: Constant::new(wheels.step_period.into()),
            range_set: Constant::new(!conditioning.range_pin && wheels.range_x2 == 1),
            range_wired: Constant::new(conditioning.range_pin),
            enable_wired: Constant::new(conditioning.enable_pin),
            grating_b_wired: Constant::new(conditioning.grating.quadrature),
            laser_b_wired: Constant::new(conditioning.laser.quadrature),
            grating_index_wired: Constant::new(conditioning.grating.index),
            laser_index_wired: Constant::new(conditioning.laser.index),
            glitch_clocks: Constant::new(u64::from(conditioning.glitch_clocks).into()),
            debounce_ticks: Constant::new(u64::from(conditioning.debounce_ticks).into()),
            tick_period: Constant::new(u64::from(conditioning.tick_period).into()),
            watchdog_ticks: Constant::new(u64::from(conditioning.watchdog_ticks).into()),
            active_low: Constant::new(conditioning.active_low),
            bit_clocks: Constant::new(u64::from(conditioning.bit_clocks).into()),
            calibrate_inverted: Constant::new(if conditioning.active_low { 3 } else { 0 }.into()),
        })
    }

    /// The same with its input pins connected, ready to be elaborated or simulated.
    ///
    /// # Errors
    ///
    /// As [`BoardShell::new`].
    pub fn connected(
        settings: &Settings,
        conditioning: &Conditioning,
    ) -> Result<Self, SettingsError> {
        let mut shell = Self::new(settings, conditioning)?;
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
        shell.enable.connect();
        shell.emergency_stop.connect();
        shell.grating_b.connect();
        shell.laser_b.connect();
        shell.grating_index.connect();
        shell.laser_index.connect();
        shell.rx.connect();
        shell.connect_all();
        Ok(shell)
    }
}

#[expect(clippy::too_many_lines, reason = "wires, each of a line")]
impl Logic for BoardShell {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, power_up);
        self.power_up_next.next = self.power_up.q.val() + 1;
        self.reset.next = !self.power_up.q.val().all();
        if self.reset.val() {
            self.power_up.d.next = self.power_up_next.val();
        }
        self.every_clock.next = true;
        self.nothing.next = false;

        // Pins.
        self.milliseconds.clock.next = self.clock.val();
        self.milliseconds.clear.next = self.reset.val();
        self.milliseconds.period.next = self.tick_period.val();
        self.grating_input.clock.next = self.clock.val();
        self.grating_input.pin.next = self.grating.val();
        self.grating_input.active_low.next = self.nothing.val();
        self.grating_input.tick.next = self.every_clock.val();
        self.grating_input.ticks.next = self.glitch_clocks.val();
        self.laser_input.clock.next = self.clock.val();
        self.laser_input.pin.next = self.laser.val();
        self.laser_input.active_low.next = self.nothing.val();
        self.laser_input.tick.next = self.every_clock.val();
        self.laser_input.ticks.next = self.glitch_clocks.val();
        self.start_input.clock.next = self.clock.val();
        self.start_input.pin.next = self.start.val();
        self.start_input.active_low.next = self.active_low.val();
        self.start_input.tick.next = self.milliseconds.tick.val();
        self.start_input.ticks.next = self.debounce_ticks.val();
        self.correct_input.clock.next = self.clock.val();
        self.correct_input.pin.next = self.correct.val();
        self.correct_input.active_low.next = self.active_low.val();
        self.correct_input.tick.next = self.milliseconds.tick.val();
        self.correct_input.ticks.next = self.debounce_ticks.val();
        self.playback_input.clock.next = self.clock.val();
        self.playback_input.pin.next = self.playback.val();
        self.playback_input.active_low.next = self.active_low.val();
        self.playback_input.tick.next = self.milliseconds.tick.val();
        self.playback_input.ticks.next = self.debounce_ticks.val();
        self.manual_step_input.clock.next = self.clock.val();
        self.manual_step_input.pin.next = self.manual_step.val();
        self.manual_step_input.active_low.next = self.active_low.val();
        self.manual_step_input.tick.next = self.milliseconds.tick.val();
        self.manual_step_input.ticks.next = self.debounce_ticks.val();
        self.range_input.clock.next = self.clock.val();
        self.range_input.pin.next = self.range_x2.val();
        self.range_input.active_low.next = self.active_low.val();
        self.range_input.tick.next = self.milliseconds.tick.val();
        self.range_input.ticks.next = self.debounce_ticks.val();
        self.enable_input.clock.next = self.clock.val();
        self.enable_input.pin.next = self.enable.val();
        self.enable_input.active_low.next = self.active_low.val();
        self.enable_input.tick.next = self.milliseconds.tick.val();
        self.enable_input.ticks.next = self.debounce_ticks.val();
        self.stop_input.clock.next = self.clock.val();
        self.stop_input.pin.next = self.emergency_stop.val();
        self.grating_b_input.clock.next = self.clock.val();
        self.grating_b_input.pin.next = self.grating_b.val();
        self.grating_b_input.active_low.next = self.nothing.val();
        self.grating_b_input.tick.next = self.every_clock.val();
        self.grating_b_input.ticks.next = self.glitch_clocks.val();
        self.laser_b_input.clock.next = self.clock.val();
        self.laser_b_input.pin.next = self.laser_b.val();
        self.laser_b_input.active_low.next = self.nothing.val();
        self.laser_b_input.tick.next = self.every_clock.val();
        self.laser_b_input.ticks.next = self.glitch_clocks.val();
        self.grating_index_input.clock.next = self.clock.val();
        self.grating_index_input.pin.next = self.grating_index.val();
        self.grating_index_input.active_low.next = self.nothing.val();
        self.grating_index_input.tick.next = self.every_clock.val();
        self.grating_index_input.ticks.next = self.glitch_clocks.val();
        self.laser_index_input.clock.next = self.clock.val();
        self.laser_index_input.pin.next = self.laser_index.val();
        self.laser_index_input.active_low.next = self.nothing.val();
        self.laser_index_input.tick.next = self.every_clock.val();
        self.laser_index_input.ticks.next = self.glitch_clocks.val();

        // Encoders.
        self.at_rest.next = self.reset.val() | !self.start_input.steady.val();
        self.grating_decoder.clock.next = self.clock.val();
        self.grating_decoder.clear.next = self.at_rest.val();
        self.grating_decoder.a.next = self.grating_input.steady.val();
        self.grating_decoder.b.next = self.grating_b_input.steady.val();
        self.grating_gate.clock.next = self.clock.val();
        self.grating_gate.wired.next = self.grating_index_wired.val();
        self.grating_gate.start.next = self.start_input.level.val();
        self.grating_gate.started.next = self.start_input.steady.val();
        self.grating_gate.index.next = self.grating_index_input.steady.val();
        self.laser_decoder.clock.next = self.clock.val();
        self.laser_decoder.clear.next = self.at_rest.val();
        self.laser_decoder.a.next = self.laser_input.steady.val();
        self.laser_decoder.b.next = self.laser_b_input.steady.val();
        self.laser_gate.clock.next = self.clock.val();
        self.laser_gate.wired.next = self.laser_index_wired.val();
        self.laser_gate.start.next = self.start_input.level.val();
        self.laser_gate.started.next = self.start_input.steady.val();
        self.laser_gate.index.next = self.laser_index_input.steady.val();

        // Supervisor.
        self.lines.clock.next = self.clock.val();
        self.lines.pin.next = self.grating_input.steady.val();
        self.fringes.clock.next = self.clock.val();
        self.fringes.pin.next = self.laser_input.steady.val();
        self.idle.next = !self.start_input.steady.val()
            & !self.correct_input.steady.val()
            & !self.playback_input.steady.val();
        self.supervisor.clock.next = self.clock.val();
        self.supervisor.clear.next = self.reset.val() | self.idle.val();
        self.supervisor.tick.next = self.milliseconds.tick.val();
        self.supervisor.limit.next = self.watchdog_ticks.val();
        self.supervisor.wrap_watched.next =
            self.correct_input.steady.val() & self.watchdog_ticks.val().any();
        self.supervisor.measuring.next = self.device.measuring.val();
        self.supervisor.line.next = self.lines.rising.val();
        self.supervisor.fringe.next = self.fringes.rising.val();
        self.supervisor.opening.next = self.device.grating_divided.val();
        self.supervisor.shutting.next = self.device.laser_divided.val();
        self.supervisor.enable.next = self.enable_input.steady.val() | !self.enable_wired.val();
        self.supervisor.stop.next = self.stop_input.level.val()
            | (self.grating_decoder.lost.val() & self.grating_b_wired.val())
            | (self.laser_decoder.lost.val() & self.laser_b_wired.val());

        // The device.
        self.device.clock.next = self.clock.val();
        self.device.master_reset.next = self.reset.val();
        if self.grating_b_wired.val() {
            self.device.grating.next = self.grating_decoder.pulse.val();
        } else {
            self.device.grating.next = self.grating_input.level.val();
        }
        if self.laser_b_wired.val() {
            self.device.laser.next = self.laser_decoder.pulse.val();
        } else {
            self.device.laser.next = self.laser_input.level.val();
        }
        self.device.start.next = self.grating_gate.open.val() & self.laser_gate.open.val();
        self.device.correct.next =
            self.correct_input.level.val() & self.supervisor.may_correct.val();
        self.device.playback.next =
            self.playback_input.level.val() & self.supervisor.may_step.val();
        self.device.calibrate.next = self.calibrate.val() ^ self.calibrate_inverted.val();
        self.device.manual_step.next =
            self.manual_step_input.level.val() & self.supervisor.may_step.val();
        self.device.manual_forward.next = self.manual_forward.val() ^ self.active_low.val();
        self.device.divide_a.next = self.settings_port.divide_a.val();
        self.device.divide_b.next = self.settings_port.divide_b.val();
        self.device.range_x2.next = self.settings_port.range_x2.val()
            | (self.range_input.steady.val() & self.range_wired.val());
        self.device.initial_phase.next = self.settings_port.initial_phase.val();
        self.device.compensation.next = self.settings_port.compensation.val();
        self.device.compensation_insert.next = self.settings_port.compensation_insert.val();
        self.device.step_period.next = self.settings_port.step_period.val();
        self.step_driver.clock.next = self.clock.val();
        self.step_driver.clear.next = self.reset.val();
        self.step_driver.step.next = self.device.step.val();
        self.step_driver.forward.next = self.device.forward.val();

        // Telemetry.
        self.telemetry.clock.next = self.clock.val();
        self.telemetry.clear.next = self.reset.val();
        self.telemetry.measuring.next = self.device.measuring.val();
        self.telemetry.opening.next = self.device.grating_divided.val();
        self.telemetry.meter.next = self.device.t1.val();
        self.telemetry.forward.next = self.device.q.val();
        self.telemetry.count.next = self.device.count.val();
        self.telemetry.count_forward.next = self.device.count_forward.val();
        self.telemetry.fault.next = self.device.fault.val();
        self.telemetry.alarm.next = self.supervisor.alarm.val();
        self.telemetry.ready.next = self.settings_port.telemetry_ready.val();
        self.transmitter.clock.next = self.clock.val();
        self.transmitter.clear.next = self.reset.val();
        self.transmitter.bit_clocks.next = self.bit_clocks.val();
        self.transmitter.send.next = self.settings_port.send.val();
        self.transmitter.data.next = self.settings_port.data.val();
        self.tx.next = self.transmitter.line.val();

        // Settings from the computer.
        self.receiver.clock.next = self.clock.val();
        self.receiver.clear.next = self.reset.val();
        self.receiver.bit_clocks.next = self.bit_clocks.val();
        self.receiver.line.next = self.rx.val();
        self.settings_port.clock.next = self.clock.val();
        self.settings_port.clear.next = self.reset.val();
        self.settings_port.at_rest.next = self.idle.val() & !self.device.measuring.val();
        self.settings_port.received.next = self.receiver.received.val();
        self.settings_port.received_byte.next = self.receiver.data.val();
        self.settings_port.telemetry_send.next = self.telemetry.send.val();
        self.settings_port.telemetry_byte.next = self.telemetry.data.val();
        self.settings_port.ready.next = self.transmitter.ready.val();
        self.settings_port.tick_period.next = self.tick_period.val();
        self.settings_port.built_divide_a.next = self.divide_a.val();
        self.settings_port.built_divide_b.next = self.divide_b.val();
        self.settings_port.built_range_x2.next = self.range_set.val();
        self.settings_port.built_initial_phase.next = self.initial_phase.val();
        self.settings_port.built_compensation.next = self.compensation.val();
        self.settings_port.built_compensation_insert.next = self.compensation_insert.val();
        self.settings_port.built_step_period.next = self.step_period.val();

        self.t1.next = self.device.t1.val();
        self.t2.next = self.device.t2.val();
        self.phase_a.next = self.device.phase_a.val() & !self.supervisor.stopped.val();
        self.phase_b.next = self.device.phase_b.val() & !self.supervisor.stopped.val();
        self.phase_c.next = self.device.phase_c.val() & !self.supervisor.stopped.val();
        self.step.next = self.step_driver.step_pin.val();
        self.direction.next = self.step_driver.direction_pin.val();
        self.zero.next = self.device.zero.val();
        self.fault.next = self.device.fault.val();
        self.measuring.next = self.device.measuring.val();
        self.alarm.next = self.supervisor.alarm.val();
    }
}
