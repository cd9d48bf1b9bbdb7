//! Ring distributor: turns step pulses into the three phase drives of the motor.
//!
//! Figure 14 of document 1 shows it as a box, "three phases, six steps", with three AND gates
//! that clear an illegal state so that it works on. Its gates are not printed; see *Inferred*.
//!
//! | port                  | dir | meaning                                              |
//! |-----------------------|-----|------------------------------------------------------|
//! | `clock`               | in  | FPGA clock, rising edge                              |
//! | `clear`               | in  | to phase A alone                                     |
//! | `step`                | in  | high for one clock: one step, 0.0125 µm at the table |
//! | `forward`             | in  | direction of that step                               |
//! | `phase_a` … `phase_c` | out | drives of the three windings, registered             |
//!
//! # Sequence
//!
//! Forward, each phase takes the inverse of the next one; in reverse, of the one before. The two
//! states outside the ring would exchange places for ever, so they are cleared.
//!
//! | state ABC   | 100 | 110 | 010 | 011 | 001 | 101 | 000, 111                 |
//! |-------------|-----|-----|-----|-----|-----|-----|--------------------------|
//! | forward     | 110 | 010 | 011 | 001 | 101 | 100 | 100, at the next clock   |
//! | reverse     | 101 | 100 | 110 | 010 | 011 | 001 | 100, at the next clock   |
//!
//! # Waveform
//!
//! `forward` = 1, from phase A on:
//!
//! ```text
//! step     ▁▔▁▔▁▔▁▔▁▔▁▔▁▁
//! phase_a  ▔▔▔▔▁▁▁▁▁▁▔▔▔▔
//! phase_b  ▁▁▔▔▔▔▔▔▁▁▁▁▁▁
//! phase_c  ▁▁▁▁▁▁▔▔▔▔▔▔▁▁
//! ```
//!
//! # At the same time
//!
//! An illegal state and `step`: the state is cleared and the step is lost to the motor. `clear`
//! wins over `step`. Power-up is 000, so the first clock after it clears the ring.
//!
//! # Inferred
//!
//! "Clear" is read as phase A alone: all phases off would itself be illegal.

use rust_hdl::prelude::*;

/// Three-phase, six-step ring with recovery; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct RingDistributor {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// To phase A alone.
    pub clear: Signal<In, Bit>,
    /// High for one clock per step.
    pub step: Signal<In, Bit>,
    /// Direction of the step.
    pub forward: Signal<In, Bit>,
    /// Drive of phase A.
    pub phase_a: Signal<Out, Bit>,
    /// Drive of phase B.
    pub phase_b: Signal<Out, Bit>,
    /// Drive of phase C.
    pub phase_c: Signal<Out, Bit>,
    a: DFF<Bit>,
    b: DFF<Bit>,
    c: DFF<Bit>,
    illegal: Signal<Local, Bit>,
}

impl Logic for RingDistributor {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, a, b, c);
        self.illegal.next = (self.a.q.val() == self.b.q.val()) & (self.b.q.val() == self.c.q.val());

        if self.clear.val() | self.illegal.val() {
            self.a.d.next = true;
            self.b.d.next = false;
            self.c.d.next = false;
        } else if self.step.val() & self.forward.val() {
            self.a.d.next = !self.b.q.val();
            self.b.d.next = !self.c.q.val();
            self.c.d.next = !self.a.q.val();
        } else if self.step.val() {
            self.a.d.next = !self.c.q.val();
            self.b.d.next = !self.a.q.val();
            self.c.d.next = !self.b.q.val();
        }

        self.phase_a.next = self.a.q.val();
        self.phase_b.next = self.b.q.val();
        self.phase_c.next = self.c.q.val();
    }
}
