//! Decade counter: one decimal digit with carry and clear.
//!
//! Figure 7 of document 1 shows three of them in a row as boxes.
//!
//! | port    | dir | meaning                                              |
//! |---------|-----|------------------------------------------------------|
//! | `clock` | in  | FPGA clock, rising edge                              |
//! | `clear` | in  | to zero                                              |
//! | `count` | in  | high for one clock: one up                           |
//! | `digit` | out | 0 to 9, BCD                                          |
//! | `carry` | out | high while this count takes the digit from 9 to 0    |
//!
//! # Truth table
//!
//! | clear | count | next digit         | carry        |
//! |-------|-------|--------------------|--------------|
//! | 0     | 0     | digit              | 0            |
//! | 0     | 1     | digit + 1, 0 for 9 | digit is 9   |
//! | 1     | 0     | 0                  | 0            |
//! | 1     | 1     | 1                  | 0            |
//!
//! # Waveform
//!
//! ```text
//! count    ▁▔▔▔▔▔▔▔▔▔▔▁▁▔▁
//! carry    ▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁
//! digit    001234567890001
//! ```
//!
//! # At the same time
//!
//! `clear` and `count`: cleared first, then counted, so that a divider that clears itself loses
//! no pulse. Nothing is carried then.
//!
//! # Inferred
//!
//! Digits 10 to 15 occur only after an upset; they carry and go to 0 like 9, so one count is
//! the longest such a digit lives.

use rust_hdl::prelude::*;

/// One decimal digit; see the [module](self) for ports and truth table.
#[derive(Debug, Default, LogicBlock)]
pub struct DecadeCounter {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// To zero.
    pub clear: Signal<In, Bit>,
    /// High for one clock per count.
    pub count: Signal<In, Bit>,
    /// 0 to 9.
    pub digit: Signal<Out, Bits<4>>,
    /// High while a count overflows.
    pub carry: Signal<Out, Bit>,
    state: DFF<Bits<4>>,
    one_more: Signal<Local, Bits<4>>,
    full: Signal<Local, Bit>,
    wrap: Signal<Local, Bit>,
}

impl Logic for DecadeCounter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.one_more.next = self.state.q.val() + 1;
        self.full.next = self.state.q.val() >= 9;

        self.wrap.next = self.count.val() & self.full.val() & !self.clear.val();

        if self.clear.val() & self.count.val() {
            self.state.d.next = 1.into();
        } else if self.clear.val() | self.wrap.val() {
            self.state.d.next = 0.into();
        } else if self.count.val() {
            self.state.d.next = self.one_more.val();
        }

        self.digit.next = self.state.q.val();
        self.carry.next = self.wrap.val();
    }
}
