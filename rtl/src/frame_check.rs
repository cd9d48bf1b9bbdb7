//! Frame check: the 16 bits by which a receiver knows that a frame came over whole.
//!
//! No figure: CRC-16/IBM-SDLC of ITU-T X.25, polynomial `x¹⁶ + x¹² + x⁵ + 1`, lowest bit first, from
//! all ones, the result inverted.
//!
//! | port    | dir | meaning                                                          |
//! |---------|-----|------------------------------------------------------------------|
//! | `clock` | in  | FPGA clock, rising edge                                          |
//! | `clear` | in  | a frame begins                                                   |
//! | `take`  | in  | high for one clock: `level` is the next bit                      |
//! | `level` | in  | that bit                                                         |
//! | `check` | out | the check of the bits so far, low byte to be sent first          |
//!
//! # Waveform
//!
//! ```text
//! clear ▔▁▁▁
//! take  ▁▔▁▁
//! level ▁▔▁▁
//! ```
//!
//! # At the same time
//!
//! `clear` wins over `take`.
//!
//! # Inferred
//!
//! All of it.

use rust_hdl::prelude::*;

/// Sixteen flip-flops and three gates; see the [module](self) for ports.
#[derive(Debug, Default, LogicBlock)]
pub struct FrameCheck {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// A frame begins.
    pub clear: Signal<In, Bit>,
    /// `level` is the next bit.
    pub take: Signal<In, Bit>,
    /// That bit.
    pub level: Signal<In, Bit>,
    /// The check so far.
    pub check: Signal<Out, Bits<16>>,
    // Inverted, so that a flip-flop that wakes up as zero is ready.
    inverse: DFF<Bits<16>>,
    shifted: Signal<Local, Bits<16>>,
    feedback: Signal<Local, Bit>,
}

impl Logic for FrameCheck {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, inverse);
        self.feedback.next = !self.inverse.q.val().get_bit(0) ^ self.level.val();
        // A one comes in at the top: a zero, inverted.
        self.shifted.next = (self.inverse.q.val() >> 1) | 0x8000;
        if self.clear.val() {
            self.inverse.d.next = 0.into();
        } else if self.take.val() & self.feedback.val() {
            self.inverse.d.next = self.shifted.val() ^ 0x8408;
        } else if self.take.val() {
            self.inverse.d.next = self.shifted.val();
        }
        self.check.next = self.inverse.q.val();
    }
}
