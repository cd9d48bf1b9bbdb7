//! Direction discriminator: a meter pulse wider than half a period asks for steps forward, a
//! narrower one for steps back.
//!
//! Figures 15 and 16 of document 1: three NAND gates and a JK flip-flop with two clock inputs.
//!
//! ```text
//! NAND3 = ¬standard
//! CP1   = ¬(meter ∧ NAND3)         low while the meter outlasts the standard: laser lags
//! CP2   = ¬(¬meter ∧ standard)     low while the standard outlasts the meter: laser leads
//! ```
//!
//! | port       | dir | meaning                                                      |
//! |------------|-----|--------------------------------------------------------------|
//! | `clock`    | in  | FPGA clock, rising edge                                      |
//! | `clear`    | in  | Q low, nothing decided                                       |
//! | `hold`     | in  | no pulses, nothing decided; Q stays                          |
//! | `meter`    | in  | the measured pulse                                           |
//! | `standard` | in  | the standard square wave                                     |
//! | `cp1`      | out | clock that sets Q, active low (point 5 of the figure)        |
//! | `cp2`      | out | clock that clears Q, active low (point 6)                    |
//! | `q`        | out | motor forward, negative correction                           |
//! | `q_bar`    | out | motor reverse, positive correction                           |
//! | `decided`  | out | Q is a decision of this pass                                 |
//!
//! # Waveform
//!
//! Figure 16: wider, wider, narrower, equal.
//!
//! ```text
//! standard ▁▔▔▔▁▁▁▔▔▔▁▁▁▔▔▔▁▁▁▔▔▔▁▁▁
//! meter    ▁▔▔▔▔▁▁▔▔▔▔▔▁▔▔▁▁▁▁▔▔▔▁▁▁
//! cp1      ▔▔▔▔▁▔▔▔▔▔▁▁▔▔▔▔▔▔▔▔▔▔▔▔▔
//! cp2      ▔▔▔▔▔▔▔▔▔▔▔▔▔▔▔▁▔▔▔▔▔▔▔▔▔
//! q        ▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! CP1 and CP2 exclude each other. Equal widths give neither, and Q keeps the last decision.
//! `clear` wins over both; while `hold` is high both are high.
//!
//! # Inferred
//!
//! The drawing is lost; the gates are those its description needs. Q changes at the first
//! rising clock edge of a low CP, the leading edge of the print's pulse: how far the widths
//! differ does not matter. `decided` is ours: before the first decision the motor has no
//! direction to go.

use rust_hdl::prelude::*;

/// Three gates and a flip-flop; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct DirectionDiscriminator {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Q low, nothing decided.
    pub clear: Signal<In, Bit>,
    /// No pulses, nothing decided.
    pub hold: Signal<In, Bit>,
    /// The measured pulse.
    pub meter: Signal<In, Bit>,
    /// The standard square wave.
    pub standard: Signal<In, Bit>,
    /// Sets Q, active low.
    pub cp1: Signal<Out, Bit>,
    /// Clears Q, active low.
    pub cp2: Signal<Out, Bit>,
    /// Motor forward.
    pub q: Signal<Out, Bit>,
    /// Motor reverse.
    pub q_bar: Signal<Out, Bit>,
    /// Q is a decision of this pass.
    pub decided: Signal<Out, Bit>,
    jk: DFF<Bit>,
    decision: DFF<Bit>,
    nand1: Signal<Local, Bit>,
    nand2: Signal<Local, Bit>,
    nand3: Signal<Local, Bit>,
}

impl Logic for DirectionDiscriminator {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, jk, decision);
        self.nand3.next = !self.standard.val();
        self.nand1.next = !(self.meter.val() & self.nand3.val() & !self.hold.val());
        self.nand2.next = !(!self.meter.val() & self.standard.val() & !self.hold.val());

        if self.clear.val() {
            self.jk.d.next = false;
        } else if !self.nand1.val() {
            self.jk.d.next = true;
        } else if !self.nand2.val() {
            self.jk.d.next = false;
        }

        if self.clear.val() | self.hold.val() {
            self.decision.d.next = false;
        } else if !(self.nand1.val() & self.nand2.val()) {
            self.decision.d.next = true;
        }

        self.cp1.next = self.nand1.val();
        self.cp2.next = self.nand2.val();
        self.q.next = self.jk.q.val();
        self.q_bar.next = !self.jk.q.val();
        self.decided.next = self.decision.q.val();
    }
}
