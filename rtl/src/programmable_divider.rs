//! Programmable divider: one pulse for every N, N = 1 to 999 on three thumb wheels.
//!
//! Figure 7 of document 1: three decades, a gate that opens when they show the preset, "outputs
//! one pulse and clears the counter". One divides the grating lines by A, one the laser pulses
//! by B.
//!
//! | port      | dir | meaning                                                          |
//! |-----------|-----|------------------------------------------------------------------|
//! | `clock`   | in  | FPGA clock, rising edge                                          |
//! | `clear`   | in  | back to zero; pulses are not counted meanwhile                   |
//! | `pulse`   | in  | high for one clock per pulse to count                            |
//! | `preset`  | in  | N, three BCD digits, hundreds on top                             |
//! | `divided` | out | high for one clock, the clock after every N-th pulse             |
//! | `half`    | out | high while the count is ⌊N/2⌋                                    |
//!
//! # Waveform
//!
//! `preset` = 003:
//!
//! ```text
//! pulse    ▁▔▁▔▁▔▁▔▁▔▁▔▁▁
//! half     ▁▁▔▔▁▁▁▁▔▔▁▁▁▁
//! divided  ▁▁▁▁▁▁▔▁▁▁▁▁▔▁
//! ```
//!
//! # At the same time
//!
//! A pulse in the clock of `divided` is the first of the next N: dividers take a pulse in every
//! clock, which the compensator's inserted ones need. `clear` and `pulse`: the pulse is lost.
//!
//! # Inferred
//!
//! `half` is ours; the print does not say how the standard square wave gets its 50 % when it is
//! not the output of a binary stage. Half a BCD number is each digit halved, plus five if the
//! digit above is odd. For odd N the half is half a line early.
//!
//! Preset 000 is outside the wheels' meaning and refused by [`Settings`](crate::settings): the
//! gate would never close. A preset turned below the count in mid-run is met after the wrap at
//! 999.

use rust_hdl::prelude::*;

use crate::decade_counter::DecadeCounter;

/// Three decades and their coincidence; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct ProgrammableDivider {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Back to zero.
    pub clear: Signal<In, Bit>,
    /// High for one clock per pulse.
    pub pulse: Signal<In, Bit>,
    /// N in BCD.
    pub preset: Signal<In, Bits<12>>,
    /// High for one clock after every N-th pulse.
    pub divided: Signal<Out, Bit>,
    /// The count is ⌊N/2⌋.
    pub half: Signal<Out, Bit>,
    units: DecadeCounter,
    tens: DecadeCounter,
    hundreds: DecadeCounter,
    coincidence: Signal<Local, Bit>,
    restart: Signal<Local, Bit>,
    tens_halved: Signal<Local, Bits<4>>,
    units_halved: Signal<Local, Bits<4>>,
    half_hundreds: Signal<Local, Bits<4>>,
    half_tens: Signal<Local, Bits<4>>,
    half_units: Signal<Local, Bits<4>>,
}

impl Logic for ProgrammableDivider {
    #[hdl_gen]
    fn update(&mut self) {
        self.units.clock.next = self.clock.val();
        self.tens.clock.next = self.clock.val();
        self.hundreds.clock.next = self.clock.val();

        self.coincidence.next = (self.units.digit.val() == self.preset.val().get_bits::<4>(0))
            & (self.tens.digit.val() == self.preset.val().get_bits::<4>(4))
            & (self.hundreds.digit.val() == self.preset.val().get_bits::<4>(8));
        self.restart.next = self.coincidence.val() | self.clear.val();

        self.units.clear.next = self.restart.val();
        self.tens.clear.next = self.restart.val();
        self.hundreds.clear.next = self.restart.val();
        self.units.count.next = self.pulse.val() & !self.clear.val();
        self.tens.count.next = self.units.carry.val();
        self.hundreds.count.next = self.tens.carry.val();

        self.half_hundreds.next = self.preset.val().get_bits::<4>(8) >> 1;
        self.tens_halved.next = self.preset.val().get_bits::<4>(4) >> 1;
        self.units_halved.next = self.preset.val().get_bits::<4>(0) >> 1;
        if self.preset.val().get_bit(8) {
            self.half_tens.next = self.tens_halved.val() + 5;
        } else {
            self.half_tens.next = self.tens_halved.val();
        }
        if self.preset.val().get_bit(4) {
            self.half_units.next = self.units_halved.val() + 5;
        } else {
            self.half_units.next = self.units_halved.val();
        }

        self.half.next = (self.units.digit.val() == self.half_units.val())
            & (self.tens.digit.val() == self.half_tens.val())
            & (self.hundreds.digit.val() == self.half_hundreds.val());
        self.divided.next = self.coincidence.val();
    }
}
