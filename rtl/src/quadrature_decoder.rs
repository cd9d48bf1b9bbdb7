//! Quadrature decoder: pulses of an encoder that may go back, one for each line that was never
//! passed before.
//!
//! Figure 6 of document 1 draws the same for the laser and says that it was not used: two photocells
//! see the fringes a quarter apart, and an edge of the one while the other is low is a fringe
//! forward when it rises, a fringe back when it falls. Here a counter keeps what was gone back, and
//! lines forward are pulses again only when that is made up for.
//!
//! | port     | dir | meaning                                                           |
//! |----------|-----|-------------------------------------------------------------------|
//! | `clock`  | in  | FPGA clock, rising edge                                           |
//! | `clear`  | in  | nothing was gone back; each line forward is a pulse               |
//! | `a`      | in  | the one photocell, synchronised                                   |
//! | `b`      | in  | the other, a quarter of a line behind it when going forward       |
//! | `pulse`  | out | high for one clock: a line further than ever since `clear`        |
//! | `behind` | out | lines gone back that are not made up for                          |
//! | `lost`   | out | more of them than `behind` can hold: the count is not true        |
//!
//! # Waveform
//!
//! Two lines forward, two back, and on: the third pulse is the third line.
//!
//! ```text
//! a      ▁▔▔▁▁▔▁▁▔▔▁▁▔▔▁▁▔▔▁▁▔▔▁
//! b      ▁▁▔▔▁▁▁▔▔▁▁▁▁▔▔▁▁▔▔▁▁▔▔
//! pulse  ▁▁▔▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁
//! ```
//!
//! # At the same time
//!
//! Dither about one edge is a line forward and one back, for ever: one pulse, the first time. Both
//! inputs changing in one clock is what the edge of `a` says, with `b` as it is behind the edge; an
//! encoder has a quarter of a line between them. Pulses are at least two clocks apart.
//!
//! # Inferred
//!
//! The counter and what it is for. At 65 535 lines back it stands still and `lost` is set until
//! `clear`.

use rust_hdl::prelude::*;

/// An edge and a counter of what is owed; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct QuadratureDecoder {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Nothing was gone back.
    pub clear: Signal<In, Bit>,
    /// The one photocell.
    pub a: Signal<In, Bit>,
    /// The other.
    pub b: Signal<In, Bit>,
    /// A line further than ever.
    pub pulse: Signal<Out, Bit>,
    /// Lines gone back.
    pub behind: Signal<Out, Bits<16>>,
    /// The count is not true.
    pub lost: Signal<Out, Bit>,
    before: DFF<Bit>,
    further: DFF<Bit>,
    owed: DFF<Bits<16>>,
    overrun: DFF<Bit>,
    up: Signal<Local, Bit>,
    down: Signal<Local, Bit>,
    none_owed: Signal<Local, Bit>,
    one_more: Signal<Local, Bits<16>>,
    one_less: Signal<Local, Bits<16>>,
}

impl Logic for QuadratureDecoder {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, before, further, owed, overrun);
        self.before.d.next = self.a.val();
        self.up.next = self.a.val() & !self.before.q.val() & !self.b.val();
        self.down.next = !self.a.val() & self.before.q.val() & !self.b.val();
        self.none_owed.next = !self.owed.q.val().any();
        self.one_more.next = self.owed.q.val() + 1;
        self.one_less.next = self.owed.q.val() - 1;
        self.further.d.next = self.up.val() & (self.none_owed.val() | self.clear.val());

        if self.clear.val() {
            self.owed.d.next = 0.into();
            self.overrun.d.next = false;
        } else if self.down.val() & self.owed.q.val().all() {
            self.overrun.d.next = true;
        } else if self.down.val() {
            self.owed.d.next = self.one_more.val();
        } else if self.up.val() & !self.none_owed.val() {
            self.owed.d.next = self.one_less.val();
        }

        self.pulse.next = self.further.q.val();
        self.behind.next = self.owed.q.val();
        self.lost.next = self.overrun.q.val();
    }
}
