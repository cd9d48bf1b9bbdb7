//! Cumulative compensator: blocks or inserts one laser pulse in F.
//!
//! Figure 9 of document 1: divider F watches the laser pulses; for ΔS > 0 a gate blocks one
//! pulse each time, for ΔS < 0 an or gate adds one, ahead of divider B. It takes out what is
//! proportional to travel: air, expansion of the workpiece, the rationalised ratio.
//!
//! | port     | dir | meaning                                                      |
//! |----------|-----|--------------------------------------------------------------|
//! | `clock`  | in  | FPGA clock, rising edge                                      |
//! | `clear`  | in  | divider to zero, nothing owed                                |
//! | `laser`  | in  | high for one clock per fringe                                |
//! | `preset` | in  | F/1000, four BCD digits; 0000 is off                         |
//! | `insert` | in  | insert (ΔS < 0) instead of block (ΔS > 0)                    |
//! | `pulse`  | out | the compensated train, for divider B and the phase selector  |
//!
//! # Waveform
//!
//! `preset` = 0001, after 999 pulses on `laser`, with `insert` = 0 the pulse behind the thousandth
//! is blocked:
//!
//! ```text
//! laser    ▁▔▁▁▁▔▁▁▁▔▁▁
//! pulse    ▁▔▁▁▁▁▁▁▁▔▁▁
//! ```
//!
//! `preset` = 0001, after 999 pulses on `laser`, with `insert` = 1 one is added to it:
//!
//! ```text
//! laser    ▁▔▁▁▁▔▁▁▁▔▁▁
//! pulse    ▁▔▔▁▁▔▁▁▁▔▁▁
//! ```
//!
//! # At the same time
//!
//! An insertion due in the clock of a real pulse waits in one flip-flop, `owed`, until a clock
//! without one: the real pulse passes, the inserted one follows. Real pulses are two clocks
//! apart at least, so it waits one clock. Blocking waits for the next real pulse. F is at
//! least 1000 pulses, so a second correction never finds the first still owed.
//!
//! # Inferred
//!
//! The blocked pulse is the one after the F-th, not the F-th itself; blocked pulses are counted
//! by F, inserted ones are not. The switch thrown while a correction is owed decides how that
//! one is paid.

use rust_hdl::prelude::*;

use crate::compensation_divider::CompensationDivider;

/// Divider F and its two gates; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct CumulativeCompensator {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Divider to zero, nothing owed.
    pub clear: Signal<In, Bit>,
    /// High for one clock per fringe.
    pub laser: Signal<In, Bit>,
    /// F/1000 in BCD, 0000 for off.
    pub preset: Signal<In, Bits<16>>,
    /// Insert instead of block.
    pub insert: Signal<In, Bit>,
    /// The compensated train.
    pub pulse: Signal<Out, Bit>,
    divider: CompensationDivider,
    owed: DFF<Bit>,
    pending: Signal<Local, Bit>,
    payable: Signal<Local, Bit>,
}

impl Logic for CumulativeCompensator {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, owed);
        self.divider.clock.next = self.clock.val();
        self.divider.clear.next = self.clear.val();
        self.divider.pulse.next = self.laser.val();
        self.divider.preset.next = self.preset.val();
        self.pending.next = self.divider.due.val() | self.owed.q.val();
        // An insertion needs a clock without a real pulse, a blockage one with.
        self.payable.next = self.laser.val() ^ self.insert.val();

        if self.clear.val() {
            self.owed.d.next = false;
        } else {
            self.owed.d.next = self.pending.val() & !self.payable.val();
        }

        self.pulse.next = self.laser.val() ^ (self.pending.val() & self.payable.val());
    }
}
