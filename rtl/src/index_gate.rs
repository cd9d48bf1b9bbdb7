//! Index gate: a pass begins where the encoder says, and not where the switch was closed.
//!
//! No figure: the gratings of 1977 had no index. A screw that is ground in several passes, or with
//! several starts, begins each of them at the same line.
//!
//! | port      | dir | meaning                                                          |
//! |-----------|-----|------------------------------------------------------------------|
//! | `clock`   | in  | FPGA clock, rising edge                                          |
//! | `wired`   | in  | there is an index; otherwise the switch passes                   |
//! | `start`   | in  | the switch, as it comes                                          |
//! | `started` | in  | the same, synchronised                                           |
//! | `index`   | in  | the index, synchronised                                          |
//! | `open`    | out | the pass: from the first rise of `index` with `started` on       |
//!
//! # Waveform
//!
//! `wired` = 1, `start` = 1: an index before the switch is none, the second and third change nothing.
//!
//! ```text
//! started ▁▁▁▁▔▔▔▔▔▔▔▔▔▔▁▁▁▔▔▔
//! index   ▁▔▁▁▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▁
//! open    ▁▁▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! An index that rises in the clock in which `started` does counts; one that is high by then does
//! not. `started` off closes in the same clock.
//!
//! # Inferred
//!
//! All of it. Where both channels have an index, the pass waits for both.

use rust_hdl::prelude::*;

/// An edge and a flip-flop; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct IndexGate {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// There is an index.
    pub wired: Signal<In, Bit>,
    /// The switch.
    pub start: Signal<In, Bit>,
    /// The same, synchronised.
    pub started: Signal<In, Bit>,
    /// The index.
    pub index: Signal<In, Bit>,
    /// The pass.
    pub open: Signal<Out, Bit>,
    before: DFF<Bit>,
    passed: DFF<Bit>,
}

impl Logic for IndexGate {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, before, passed);
        self.before.d.next = self.index.val();
        if !self.started.val() {
            self.passed.d.next = false;
        } else if self.index.val() & !self.before.q.val() {
            self.passed.d.next = true;
        }

        if self.wired.val() {
            self.open.next = self.started.val() & self.passed.q.val();
        } else {
            self.open.next = self.start.val();
        }
    }
}
