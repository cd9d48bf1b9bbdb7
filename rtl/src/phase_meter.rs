//! Phase meter: high from a grating pulse to the next laser pulse.
//!
//! Figures 3 and 6 of document 1: "a trigger with two inputs". The share of the period it is
//! high is the phase; a laser that lags makes it wider.
//!
//! | port      | dir | meaning                                                     |
//! |-----------|-----|-------------------------------------------------------------|
//! | `clock`   | in  | FPGA clock, rising edge                                     |
//! | `hold`    | in  | low, whatever comes: the initial phase is being selected    |
//! | `grating` | in  | high for one clock: sets                                    |
//! | `laser`   | in  | high for one clock: clears                                  |
//! | `meter`   | out | the pulse whose width is the phase, registered              |
//!
//! # Truth table
//!
//! | hold | grating | laser | next meter |
//! |------|---------|-------|------------|
//! | 0    | 0       | 0     | meter      |
//! | 0    | 1       | 0     | 1          |
//! | 0    | 0       | 1     | 0          |
//! | 0    | 1       | 1     | meter      |
//! | 1    | any     | any   | 0          |
//!
//! # Waveform
//!
//! Figure 3: the second laser pulse is late, the third early.
//!
//! ```text
//! grating  ▁▔▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▔▁▁▁▁▁▁
//! laser    ▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▔▁▁▁▔▁▁▁▁
//! meter    ▁▁▔▔▔▔▁▁▁▁▔▔▔▔▔▔▁▁▔▔▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! Both pulses: the meter keeps its state. The asynchronous original takes them one after the
//! other and returns to where it was, so phases just above 0° and just below 360° both stay
//! where they are; a toggling JK would be wrong by a whole period here.
//!
//! # Inferred
//!
//! Low while held: the first edge of a pass is then always the grating's, and a laser pulse
//! before it changes nothing.

use rust_hdl::prelude::*;

/// A set-clear flip-flop; see the [module](self) for ports and truth table.
#[derive(Debug, Default, LogicBlock)]
pub struct PhaseMeter {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Low, whatever comes.
    pub hold: Signal<In, Bit>,
    /// High for one clock: sets.
    pub grating: Signal<In, Bit>,
    /// High for one clock: clears.
    pub laser: Signal<In, Bit>,
    /// The pulse whose width is the phase.
    pub meter: Signal<Out, Bit>,
    state: DFF<Bit>,
}

impl Logic for PhaseMeter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        if self.hold.val() {
            self.state.d.next = false;
        } else if self.grating.val() & !self.laser.val() {
            self.state.d.next = true;
        } else if self.laser.val() & !self.grating.val() {
            self.state.d.next = false;
        }
        self.meter.next = self.state.q.val();
    }
}
