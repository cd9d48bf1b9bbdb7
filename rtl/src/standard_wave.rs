//! Standard wave: high for the first half of every comparison period.
//!
//! Figure 16 of document 1 draws it; the text calls it the "standard square wave", the grating
//! signal "divided once". It begins with the meter pulse, so a meter pulse that ends with it
//! stands at 180°.
//!
//! | port       | dir | meaning                                                       |
//! |------------|-----|---------------------------------------------------------------|
//! | `clock`    | in  | FPGA clock, rising edge                                       |
//! | `clear`    | in  | low, until the next period starts                             |
//! | `divided`  | in  | grating pulses ÷A                                             |
//! | `start`    | in  | those of them that start a comparison period, as the meter's  |
//! | `half`     | in  | divider A has counted ⌊A/2⌋                                   |
//! | `range_x2` | in  | ×2 instead of ×1                                              |
//! | `standard` | out | the square wave, registered                                   |
//!
//! # Waveform
//!
//! `range_x2` = 1, where the divided pulse between two starts is the middle:
//!
//! ```text
//! divided  ▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁
//! start    ▁▔▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁
//! standard ▁▁▔▔▔▔▁▁▁▁▔▔▔▔▁▁▁
//! ```
//!
//! `range_x2` = 0, where the divider's `half` is:
//!
//! ```text
//! half     ▁▁▁▔▁▁▁▔▁▁▁▔▁
//! start    ▁▔▁▁▁▔▁▁▁▔▁▁▁
//! standard ▁▁▔▔▁▁▔▔▁▁▔▔▁
//! ```
//!
//! # At the same time
//!
//! `start` wins over `half`, which only A = 1 at ×1 could bring together: that period has no
//! middle, and the [device](crate::device) decides nothing in it.
//!
//! # Inferred
//!
//! "Divided once" is taken as the ÷2 of the ×2 range, exact to the line. At ×1 the middle is the
//! ⌊A/2⌋-th line: for odd A half a line early, a shift of S/2M (0.2 µm at 6 mm) that is constant
//! over a pass.

use rust_hdl::prelude::*;

/// One flip-flop; see the [module](self) for ports and waveforms.
#[derive(Debug, Default, LogicBlock)]
pub struct StandardWave {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Low until the next period.
    pub clear: Signal<In, Bit>,
    /// Grating pulses ÷A.
    pub divided: Signal<In, Bit>,
    /// Those that start a comparison period.
    pub start: Signal<In, Bit>,
    /// Divider A has counted ⌊A/2⌋.
    pub half: Signal<In, Bit>,
    /// ×2 instead of ×1.
    pub range_x2: Signal<In, Bit>,
    /// The square wave.
    pub standard: Signal<Out, Bit>,
    wave: DFF<Bit>,
    middle: Signal<Local, Bit>,
}

impl Logic for StandardWave {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, wave);
        if self.range_x2.val() {
            self.middle.next = self.divided.val();
        } else {
            self.middle.next = self.half.val();
        }

        if self.clear.val() {
            self.wave.d.next = false;
        } else if self.start.val() {
            self.wave.d.next = true;
        } else if self.middle.val() {
            self.wave.d.next = false;
        }

        self.standard.next = self.wave.q.val();
    }
}
