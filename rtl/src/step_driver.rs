//! Step driver: the pulse and direction a bought stepper driver wants.
//!
//! No figure: the original drives its windings from the ring. Today's drivers take a step pin
//! and a direction pin, need the direction before the edge, and pulses of microseconds.
//!
//! | port            | dir | meaning                                                  |
//! |-----------------|-----|----------------------------------------------------------|
//! | `clock`         | in  | FPGA clock, rising edge                                  |
//! | `clear`         | in  | pulse away                                               |
//! | `step`          | in  | high for one clock: a step is taken                      |
//! | `forward`       | in  | its direction                                            |
//! | `step_pin`      | out | low for 64 clocks after that, then high for 64           |
//! | `direction_pin` | out | that direction, until the next step                      |
//!
//! # Sequence
//!
//! | clocks after `step` | 1 … 64   | 65 … 128 | 129 …  |
//! |---------------------|----------|----------|--------|
//! | `step_pin`          | 0        | 1        | 0      |
//! | `direction_pin`     | forward  | forward  | forward|
//!
//! At 12 MHz that is 5.3 µs of set-up and 5.3 µs of pulse; common drivers ask for 2.5 µs.
//!
//! # At the same time
//!
//! A step within 128 clocks of the last starts the sequence over and costs the pin a pulse;
//! [`BoardShell::new`](crate::board_shell::BoardShell::new) refuses a step clock that fast.
//!
//! # Inferred
//!
//! All of it.

use rust_hdl::prelude::*;

/// Clocks from a step to the end of its pulse.
pub const PULSE_CLOCKS: u32 = 128;

/// A counter that runs down, and a direction kept; see the [module](self) for ports.
#[derive(Debug, Default, LogicBlock)]
pub struct StepDriver {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Pulse away.
    pub clear: Signal<In, Bit>,
    /// A step is taken.
    pub step: Signal<In, Bit>,
    /// Its direction.
    pub forward: Signal<In, Bit>,
    /// The pulse.
    pub step_pin: Signal<Out, Bit>,
    /// The direction.
    pub direction_pin: Signal<Out, Bit>,
    left: DFF<Bits<8>>,
    pulse: DFF<Bit>,
    direction: DFF<Bit>,
    one_less: Signal<Local, Bits<8>>,
    idle: Signal<Local, Bit>,
}

impl Logic for StepDriver {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left, pulse, direction);
        self.one_less.next = self.left.q.val() - 1;
        self.idle.next = self.left.q.val() == 0;

        if self.clear.val() {
            self.left.d.next = 0.into();
            self.direction.d.next = false;
        } else if self.step.val() {
            self.left.d.next = 128.into();
            self.direction.d.next = self.forward.val();
        } else if !self.idle.val() {
            self.left.d.next = self.one_less.val();
        }

        if self.clear.val() | self.step.val() {
            self.pulse.d.next = false;
        } else {
            self.pulse.d.next = (self.left.q.val() >= 2) & (self.left.q.val() <= 65);
        }

        self.step_pin.next = self.pulse.q.val();
        self.direction_pin.next = self.direction.q.val();
    }
}
