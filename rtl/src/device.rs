//! The device: all blocks joined, from two pulse trains to three phase drives.
//!
//! Figure 6 of document 1 (measuring) and figure 14 (correcting).
//!
//! ```text
//! grating ─ synchroniser ─ gate (m) ─ ÷A ─ ×1/×2 ─┬─► set   ┐
//!                                          └ standard ┐     ├ meter ─┬─ calibrator ─ T1, T2
//! laser ─── synchroniser ─ compensator ─── ÷B ─ ×1/×2 ──► clear ┘    │
//!                                                     └─ discriminator ─ Q ┐
//!                  step clock ─ selector (Q, panel, playback) ─ reset counter ─ ring ─ A, B, C
//! ```
//!
//! | port                  | dir | meaning                                                      |
//! |-----------------------|-----|--------------------------------------------------------------|
//! | `clock`               | in  | FPGA clock, rising edge                                      |
//! | `master_reset`        | in  | everything to its start; synchronous, four clocks or more    |
//! | `grating`             | in  | grating lines, asynchronous, rising edges count              |
//! | `laser`               | in  | interference fringes, likewise                               |
//! | `start`               | in  | level: select the initial phase, then measure                |
//! | `correct`             | in  | level: correct, else only measure                            |
//! | `playback`            | in  | level: steps back to zero ("reset" switch, fig. 17)          |
//! | `calibrate`           | in  | 0 off, 1 180°, 2 90°, 3 45°                                  |
//! | `manual_step`         | in  | rising edge: one step                                        |
//! | `manual_forward`      | in  | its direction                                                |
//! | `divide_a`            | in  | A, three BCD digits                                          |
//! | `divide_b`            | in  | B, three BCD digits                                          |
//! | `range_x2`            | in  | ×2 instead of ×1                                             |
//! | `initial_phase`       | in  | m, three BCD digits                                          |
//! | `compensation`        | in  | F/1000, four BCD digits; 0000 is off                         |
//! | `compensation_insert` | in  | insert instead of block                                      |
//! | `step_period`         | in  | clocks from step to step; 0 stops the step clock             |
//! | `t1`, `t2`            | out | meter and complement, or the calibration                     |
//! | `standard`            | out | standard square wave                                         |
//! | `cp1`, `cp2`          | out | clocks of the discriminator's flip-flop, active low          |
//! | `q`, `q_bar`          | out | that flip-flop: the loop wants forward, reverse              |
//! | `step`                | out | high for one clock: a step is taken                          |
//! | `forward`, `reverse`  | out | direction the motor is driven in, and its complement         |
//! | `phase_a` … `phase_c` | out | drives of the three windings                                 |
//! | `count`               | out | steps away from zero                                         |
//! | `count_forward`       | out | on which side                                                |
//! | `zero`                | out | the count is zero                                            |
//! | `fault`               | out | a step was refused at 4095                                   |
//! | `measuring`           | out | the initial phase is selected                                |
//! | `grating_divided`     | out | high for one clock: sets the meter, a comparison starts      |
//! | `laser_divided`       | out | high for one clock: clears the meter                         |
//!
//! # Sequence
//!
//! | inputs                         | what it does                                             |
//! |--------------------------------|----------------------------------------------------------|
//! | `start` low                    | dividers, gate and meter at rest; counter and ring keep  |
//! | `start` high                   | counts m laser pulses, the meter held low                |
//! | … m pulses later               | `measuring`: compares, T1 shows the phase, Q decides     |
//! | `correct`, first decision made | a step at every tick, in the direction of Q              |
//! | `correct` low                  | no steps, Q goes on deciding; manual steps are taken     |
//! | `playback` high                | a step at every tick towards zero, none from there       |
//! | `start` low again              | the loop stops stepping; the count waits for a playback  |
//!
//! A pin's edge is seen two clock edges later and reaches the meter after two more, the grating's
//! as the laser's, so the delay leaves the phase alone.
//!
//! # Waveform
//!
//! A = 4, B = 3, ×1, m = 1: the laser is late, so T1 outlasts the standard wave and the motor
//! steps forward. `divide_a` = 004, `divide_b` = 003, `initial_phase` = 001, `correct` = 1,
//! `step_period` = 5, after 9 clocks:
//!
//! ```text
//! start           ▁▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔
//! laser           ▁▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁
//! grating         ▁▁▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁▁▔▁
//! measuring       ▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔
//! grating_divided ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁
//! laser_divided   ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▔▁▁
//! t1              ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▁▁▁▁▔▔▔▔▔▔▔▔▁▁▁▁▔▔▔▔▔▔▔▔▁▁▁▁▔▔▔▔▔▔▔▔▁▁
//! standard        ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁
//! cp1             ▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▁▁▔▔▔▔▔▔▔▔▔▔▁▁▔▔▔▔▔▔▔▔▔▔▁▁▔▔▔▔▔▔▔▔▔▔▁▁▔▔
//! q               ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔
//! step            ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔▁▁▁▁▔
//! phase_a         ▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔
//! phase_b         ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔
//! ```
//!
//! # At the same time
//!
//! Playback wins over correcting, correcting over manual steps. `master_reset` wins over all and
//! forgets where the motor stands: play back first. `start` falling in the clock of a tick: that
//! step is still taken. A grating and a laser pulse in one clock leave the meter as it is.
//!
//! # Inferred
//!
//! Before the first decision of a pass nothing is stepped. A standing spindle brings no
//! decisions, and a correcting motor goes on in the last direction, as in the original, until
//! 4095 and `fault`. A = 1 at ×1 has no middle line: such a machine measures and does not
//! correct.
//!
//! The settings are thumb wheels: plain levels, to be changed only while `start` is low.

use rust_hdl::prelude::*;

use crate::calibrator::Calibrator;
use crate::cumulative_compensator::CumulativeCompensator;
use crate::direction_discriminator::DirectionDiscriminator;
use crate::initial_phase_selector::InitialPhaseSelector;
use crate::input_synchroniser::InputSynchroniser;
use crate::level_synchroniser::LevelSynchroniser;
use crate::phase_meter::PhaseMeter;
use crate::programmable_divider::ProgrammableDivider;
use crate::range_stage::RangeStage;
use crate::reset_counter::ResetCounter;
use crate::ring_distributor::RingDistributor;
use crate::standard_wave::StandardWave;
use crate::step_clock::StepClock;
use crate::step_selector::StepSelector;

/// Everything between the photocells and the motor; see the [module](self) for ports.
#[derive(Debug, Default, LogicBlock)]
pub struct Device {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Everything to its start.
    pub master_reset: Signal<In, Bit>,
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
    /// A in BCD.
    pub divide_a: Signal<In, Bits<12>>,
    /// B in BCD.
    pub divide_b: Signal<In, Bits<12>>,
    /// ×2 instead of ×1.
    pub range_x2: Signal<In, Bit>,
    /// m in BCD.
    pub initial_phase: Signal<In, Bits<12>>,
    /// F/1000 in BCD, 0000 for off.
    pub compensation: Signal<In, Bits<16>>,
    /// Insert instead of block.
    pub compensation_insert: Signal<In, Bit>,
    /// Clocks from step to step.
    pub step_period: Signal<In, Bits<24>>,
    /// Meter, or the calibration.
    pub t1: Signal<Out, Bit>,
    /// Its complement.
    pub t2: Signal<Out, Bit>,
    /// Standard square wave.
    pub standard: Signal<Out, Bit>,
    /// Sets Q, active low.
    pub cp1: Signal<Out, Bit>,
    /// Clears Q, active low.
    pub cp2: Signal<Out, Bit>,
    /// The loop wants forward.
    pub q: Signal<Out, Bit>,
    /// The loop wants reverse.
    pub q_bar: Signal<Out, Bit>,
    /// A step is taken.
    pub step: Signal<Out, Bit>,
    /// Direction the motor is driven in.
    pub forward: Signal<Out, Bit>,
    /// Its complement.
    pub reverse: Signal<Out, Bit>,
    /// Drive of phase A.
    pub phase_a: Signal<Out, Bit>,
    /// Drive of phase B.
    pub phase_b: Signal<Out, Bit>,
    /// Drive of phase C.
    pub phase_c: Signal<Out, Bit>,
    /// Steps away from zero.
    pub count: Signal<Out, Bits<12>>,
    /// On which side.
    pub count_forward: Signal<Out, Bit>,
    /// The count is zero.
    pub zero: Signal<Out, Bit>,
    /// A step was refused.
    pub fault: Signal<Out, Bit>,
    /// The initial phase is selected.
    pub measuring: Signal<Out, Bit>,
    /// Sets the meter.
    pub grating_divided: Signal<Out, Bit>,
    /// Clears the meter.
    pub laser_divided: Signal<Out, Bit>,
    grating_input: InputSynchroniser,
    laser_input: InputSynchroniser,
    start_input: LevelSynchroniser,
    correct_input: LevelSynchroniser,
    playback_input: LevelSynchroniser,
    calibrate_low_input: LevelSynchroniser,
    calibrate_high_input: LevelSynchroniser,
    manual_step_input: InputSynchroniser,
    manual_forward_input: LevelSynchroniser,
    compensator: CumulativeCompensator,
    selector: InitialPhaseSelector,
    divider_a: ProgrammableDivider,
    divider_b: ProgrammableDivider,
    grating_range: RangeStage,
    laser_range: RangeStage,
    standard_wave: StandardWave,
    phase_meter: PhaseMeter,
    calibrator: Calibrator,
    discriminator: DirectionDiscriminator,
    step_clock: StepClock,
    step_selector: StepSelector,
    reset_counter: ResetCounter,
    ring: RingDistributor,
    rest: Signal<Local, Bit>,
    calibration: Signal<Local, Bits<2>>,
    no_middle: Signal<Local, Bit>,
}

#[expect(clippy::too_many_lines, reason = "a wiring list: one line a wire, nothing to nest")]
impl Logic for Device {
    #[hdl_gen]
    fn update(&mut self) {
        // Panel and photocells.
        self.grating_input.clock.next = self.clock.val();
        self.grating_input.pin.next = self.grating.val();
        self.laser_input.clock.next = self.clock.val();
        self.laser_input.pin.next = self.laser.val();
        self.start_input.clock.next = self.clock.val();
        self.start_input.pin.next = self.start.val();
        self.correct_input.clock.next = self.clock.val();
        self.correct_input.pin.next = self.correct.val();
        self.playback_input.clock.next = self.clock.val();
        self.playback_input.pin.next = self.playback.val();
        self.calibrate_low_input.clock.next = self.clock.val();
        self.calibrate_low_input.pin.next = self.calibrate.val().get_bit(0);
        self.calibrate_high_input.clock.next = self.clock.val();
        self.calibrate_high_input.pin.next = self.calibrate.val().get_bit(1);
        self.manual_step_input.clock.next = self.clock.val();
        self.manual_step_input.pin.next = self.manual_step.val();
        self.manual_forward_input.clock.next = self.clock.val();
        self.manual_forward_input.pin.next = self.manual_forward.val();
        self.rest.next = self.master_reset.val() | !self.start_input.level.val();

        // Laser channel.
        self.compensator.clock.next = self.clock.val();
        self.compensator.clear.next = self.rest.val();
        self.compensator.laser.next = self.laser_input.rising.val();
        self.compensator.preset.next = self.compensation.val();
        self.compensator.insert.next = self.compensation_insert.val();
        self.divider_b.clock.next = self.clock.val();
        self.divider_b.clear.next = self.rest.val();
        self.divider_b.pulse.next = self.compensator.pulse.val();
        self.divider_b.preset.next = self.divide_b.val();
        self.laser_range.clock.next = self.clock.val();
        self.laser_range.clear.next = self.rest.val();
        self.laser_range.divided.next = self.divider_b.divided.val();
        self.laser_range.range_x2.next = self.range_x2.val();

        // Grating channel.
        self.selector.clock.next = self.clock.val();
        self.selector.clear.next = self.rest.val();
        self.selector.laser.next = self.compensator.pulse.val();
        self.selector.grating.next = self.grating_input.rising.val();
        self.selector.preset.next = self.initial_phase.val();
        self.divider_a.clock.next = self.clock.val();
        self.divider_a.clear.next = self.rest.val();
        self.divider_a.pulse.next = self.selector.line.val();
        self.divider_a.preset.next = self.divide_a.val();
        self.grating_range.clock.next = self.clock.val();
        self.grating_range.clear.next = self.rest.val();
        self.grating_range.divided.next = self.divider_a.divided.val();
        self.grating_range.range_x2.next = self.range_x2.val();
        self.standard_wave.clock.next = self.clock.val();
        self.standard_wave.clear.next = self.rest.val();
        self.standard_wave.divided.next = self.divider_a.divided.val();
        self.standard_wave.start.next = self.grating_range.pulse.val();
        self.standard_wave.half.next = self.divider_a.half.val();
        self.standard_wave.range_x2.next = self.range_x2.val();

        // Comparison.
        self.phase_meter.clock.next = self.clock.val();
        self.phase_meter.hold.next = self.rest.val() | !self.selector.open.val();
        self.phase_meter.grating.next = self.grating_range.pulse.val();
        self.phase_meter.laser.next = self.laser_range.pulse.val();
        if self.calibrate_high_input.level.val() & self.calibrate_low_input.level.val() {
            self.calibration.next = 3.into();
        } else if self.calibrate_high_input.level.val() {
            self.calibration.next = 2.into();
        } else if self.calibrate_low_input.level.val() {
            self.calibration.next = 1.into();
        } else {
            self.calibration.next = 0.into();
        }
        self.calibrator.clock.next = self.clock.val();
        self.calibrator.clear.next = self.master_reset.val();
        self.calibrator.line.next = self.grating_input.rising.val();
        self.calibrator.meter.next = self.phase_meter.meter.val();
        self.calibrator.calibrate.next = self.calibration.val();
        self.no_middle.next = (self.divide_a.val() == 1) & !self.range_x2.val();
        self.discriminator.clock.next = self.clock.val();
        self.discriminator.clear.next = self.master_reset.val();
        self.discriminator.hold.next =
            self.rest.val() | !self.selector.open.val() | self.no_middle.val();
        self.discriminator.meter.next = self.phase_meter.meter.val();
        self.discriminator.standard.next = self.standard_wave.standard.val();

        // Correction.
        self.step_clock.clock.next = self.clock.val();
        self.step_clock.clear.next = self.master_reset.val();
        self.step_clock.period.next = self.step_period.val();
        self.step_selector.clock.next = self.clock.val();
        self.step_selector.clear.next = self.master_reset.val();
        self.step_selector.tick.next = self.step_clock.tick.val();
        self.step_selector.correcting.next = self.correct_input.level.val()
            & self.selector.open.val()
            & self.discriminator.decided.val();
        self.step_selector.automatic_forward.next = self.discriminator.q.val();
        self.step_selector.manual_enable.next = !self.correct_input.level.val();
        self.step_selector.manual_step.next = self.manual_step_input.rising.val();
        self.step_selector.manual_forward.next = self.manual_forward_input.level.val();
        self.step_selector.playback.next = self.playback_input.level.val();
        self.reset_counter.clock.next = self.clock.val();
        self.reset_counter.clear.next = self.master_reset.val();
        self.reset_counter.request.next = self.step_selector.request.val();
        self.reset_counter.forward.next = self.step_selector.forward.val();
        self.reset_counter.playback.next = self.playback_input.level.val();
        self.ring.clock.next = self.clock.val();
        self.ring.clear.next = self.master_reset.val();
        self.ring.step.next = self.reset_counter.step.val();
        self.ring.forward.next = self.reset_counter.drive_forward.val();

        self.t1.next = self.calibrator.t1.val();
        self.t2.next = self.calibrator.t2.val();
        self.standard.next = self.standard_wave.standard.val();
        self.cp1.next = self.discriminator.cp1.val();
        self.cp2.next = self.discriminator.cp2.val();
        self.q.next = self.discriminator.q.val();
        self.q_bar.next = self.discriminator.q_bar.val();
        self.step.next = self.reset_counter.step.val();
        self.forward.next = self.reset_counter.drive_forward.val();
        self.reverse.next = !self.reset_counter.drive_forward.val();
        self.phase_a.next = self.ring.phase_a.val();
        self.phase_b.next = self.ring.phase_b.val();
        self.phase_c.next = self.ring.phase_c.val();
        self.count.next = self.reset_counter.count.val();
        self.count_forward.next = self.reset_counter.count_forward.val();
        self.zero.next = self.reset_counter.zero.val();
        self.fault.next = self.reset_counter.fault.val();
        self.measuring.next = self.selector.open.val();
        self.grating_divided.next = self.grating_range.pulse.val();
        self.laser_divided.next = self.laser_range.pulse.val();
    }
}
