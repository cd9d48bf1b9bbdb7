//! Level synchroniser: brings a panel switch into the clock domain.
//!
//! No figure: the print is asynchronous throughout. Two flip-flops in a row give a metastable
//! first one a whole clock to settle.
//!
//! | port    | dir | meaning                                         |
//! |---------|-----|-------------------------------------------------|
//! | `clock` | in  | FPGA clock, rising edge                         |
//! | `pin`   | in  | the switch, at any time                         |
//! | `level` | out | the same level, two rising edges later          |
//!
//! # Waveform
//!
//! ```text
//! pin      ▁▁▔▔▔▔▔▁▁▁▁▁
//! level    ▁▁▁▁▔▔▔▔▔▁▁▁
//! ```
//!
//! # At the same time
//!
//! A level shorter than a clock may be missed. Two switches thrown together may arrive one
//! clock apart.
//!
//! # Inferred
//!
//! All of it; switches are not debounced here, see the
//! [input conditioner](crate::input_conditioner).

use rust_hdl::prelude::*;

/// Two flip-flops in a row; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct LevelSynchroniser {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// The asynchronous level.
    pub pin: Signal<In, Bit>,
    /// The synchronous level.
    pub level: Signal<Out, Bit>,
    first: DFF<Bit>,
    second: DFF<Bit>,
}

impl Logic for LevelSynchroniser {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, first, second);
        self.first.d.next = self.pin.val();
        self.second.d.next = self.first.q.val();
        self.level.next = self.second.q.val();
    }
}
