//! Step clock: one tick every `period` clocks, free-running.
//!
//! Figure 14 of document 1: an oscillator of its own feeds the ring; its frequency is the speed
//! of correction. Here it is the FPGA clock, divided.
//!
//! | port     | dir | meaning                                                  |
//! |----------|-----|----------------------------------------------------------|
//! | `clock`  | in  | FPGA clock, rising edge                                  |
//! | `clear`  | in  | a whole period from now to the next tick                 |
//! | `period` | in  | clocks from tick to tick, 1 to 16 777 215; 0 stops it    |
//! | `tick`   | out | high for one clock                                       |
//!
//! # Waveform
//!
//! `period` = 4, in clocks:
//!
//! ```text
//! clear    ▔▁▁▁▁▁▁▁▁▁▁▁▁▁
//! tick     ▁▁▁▁▔▁▁▁▔▁▁▁▔▁
//! ```
//!
//! # At the same time
//!
//! A changed `period` holds from the next tick on. `clear` in the clock of a tick: the tick is
//! out, and the next is a period away.
//!
//! # Inferred
//!
//! The counter runs down, so that a shorter period is never missed, and rests at 0 when it is
//! stopped or has just been powered up.

use rust_hdl::prelude::*;

/// A counter that runs down; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct StepClock {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// A whole period to the next tick.
    pub clear: Signal<In, Bit>,
    /// Clocks from tick to tick.
    pub period: Signal<In, Bits<24>>,
    /// High for one clock per period.
    pub tick: Signal<Out, Bit>,
    left: DFF<Bits<24>>,
    one_less: Signal<Local, Bits<24>>,
    last: Signal<Local, Bit>,
    stopped: Signal<Local, Bit>,
}

impl Logic for StepClock {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, left);
        self.one_less.next = self.left.q.val() - 1;
        self.last.next = self.left.q.val() == 1;
        self.stopped.next = self.left.q.val() == 0;

        if self.clear.val() | self.last.val() | self.stopped.val() {
            self.left.d.next = self.period.val();
        } else {
            self.left.d.next = self.one_less.val();
        }

        self.tick.next = self.last.val();
    }
}
