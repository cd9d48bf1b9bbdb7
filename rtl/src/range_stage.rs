//! Range stage: divides by a further two in the ×2 range, by one in ×1.
//!
//! Named in document 1 with the phase meter ("the ×2 range"), without a figure. One follows each
//! divider; both start alike, so that the two channels stay in step.
//!
//! | port       | dir | meaning                                              |
//! |------------|-----|------------------------------------------------------|
//! | `clock`    | in  | FPGA clock, rising edge                              |
//! | `clear`    | in  | the next pulse is a first one                        |
//! | `divided`  | in  | high for one clock per pulse of the divider          |
//! | `range_x2` | in  | ×2 instead of ×1                                     |
//! | `pulse`    | out | every pulse at ×1; the 1st, 3rd, 5th … at ×2         |
//!
//! # Waveform
//!
//! `range_x2` = 0:
//!
//! ```text
//! divided  ▁▔▁▔▁▔▁▔▁
//! pulse    ▁▔▁▔▁▔▁▔▁
//! ```
//!
//! `range_x2` = 1:
//!
//! ```text
//! divided  ▁▔▁▔▁▔▁▔▁
//! pulse    ▁▔▁▁▁▔▁▁▁
//! ```
//!
//! # At the same time
//!
//! `clear` and `divided`: the pulse passes, and the next one is a first one again.
//!
//! # Inferred
//!
//! That the first pulse passes and not the second. The ratio is all the text gives.

use rust_hdl::prelude::*;

/// One toggle flip-flop and a gate; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct RangeStage {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// The next pulse is a first one.
    pub clear: Signal<In, Bit>,
    /// High for one clock per pulse of the divider.
    pub divided: Signal<In, Bit>,
    /// ×2 instead of ×1.
    pub range_x2: Signal<In, Bit>,
    /// Pulses for the meter.
    pub pulse: Signal<Out, Bit>,
    second: DFF<Bit>,
}

impl Logic for RangeStage {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, second);
        if self.clear.val() {
            self.second.d.next = false;
        } else if self.divided.val() {
            self.second.d.next = !self.second.q.val();
        }
        self.pulse.next = self.divided.val() & !(self.second.q.val() & self.range_x2.val());
    }
}
