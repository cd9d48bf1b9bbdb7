//! Input synchroniser: one pulse of one clock for each rising edge of an asynchronous input.
//!
//! No figure: the print shapes the photocell signals and lets them clock the decades. Here two
//! flip-flops synchronise, a third remembers, and the difference is the edge.
//!
//! | port     | dir | meaning                                                        |
//! |----------|-----|----------------------------------------------------------------|
//! | `clock`  | in  | FPGA clock, rising edge                                        |
//! | `pin`    | in  | grating lines, laser fringes or a push button, at any time     |
//! | `rising` | out | high for one clock, two rising clock edges after `pin` rose    |
//!
//! # Waveform
//!
//! ```text
//! pin      ▁▁▔▔▔▁▁▁▁▔▁▔▁▁▁▁
//! rising   ▁▁▁▁▔▁▁▁▁▁▁▔▁▔▁▁
//! ```
//!
//! # At the same time
//!
//! High and low must each last a clock to be seen, so pulses are at least two clocks apart.
//! An input that is high at power-up counts as one edge.
//!
//! # Inferred
//!
//! All of it. The instant is rounded up to the clock: 1.5 mm/s at 12 MHz makes 0.13 nm of it.

use rust_hdl::prelude::*;

/// Two flip-flops and an edge; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct InputSynchroniser {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// The asynchronous input.
    pub pin: Signal<In, Bit>,
    /// High for one clock per rising edge.
    pub rising: Signal<Out, Bit>,
    first: DFF<Bit>,
    second: DFF<Bit>,
    before: DFF<Bit>,
}

impl Logic for InputSynchroniser {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, first, second, before);
        self.first.d.next = self.pin.val();
        self.second.d.next = self.first.q.val();
        self.before.d.next = self.second.q.val();
        self.rising.next = self.second.q.val() & !self.before.q.val();
    }
}
