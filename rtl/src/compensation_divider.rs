//! Compensation divider: one pulse for every F, F = 1000 to 9 999 000 in thousands.
//!
//! Figure 9 of document 1: "seven decades, the first four of which can be set at will". One
//! pulse in F is 10⁶/F µm per metre of travel, whatever the wavelength.
//!
//! | port     | dir | meaning                                                   |
//! |----------|-----|-----------------------------------------------------------|
//! | `clock`  | in  | FPGA clock, rising edge                                   |
//! | `clear`  | in  | back to zero; pulses are not counted meanwhile            |
//! | `pulse`  | in  | high for one clock per laser pulse                        |
//! | `preset` | in  | F/1000, four BCD digits, millions on top; 0000 is off     |
//! | `due`    | out | high for one clock, the clock after every F-th pulse      |
//!
//! # Sequence
//!
//! | pulses counted | 1 … F−1 | F                | F+1 … 2F−1 | 2F               |
//! |----------------|---------|------------------|------------|------------------|
//! | `due`          | 0       | 1 for one clock  | 0          | 1 for one clock  |
//!
//! # Waveform
//!
//! `preset` = 0001, after 999 pulses on `pulse`:
//!
//! ```text
//! pulse    ▁▔▁▁▔▁
//! due      ▁▁▔▁▁▁
//! ```
//!
//! # At the same time
//!
//! A pulse in the clock of `due` is the first of the next F. `clear` and `pulse`: the pulse is
//! lost.
//!
//! # Inferred
//!
//! The line marked 123 in the figure makes the gate fit one pulse: it is read as "the lower
//! three decades show 000". Off at 0000 is ours: without it F would be nothing at all.

use rust_hdl::prelude::*;

use crate::decade_counter::DecadeCounter;

/// Seven decades, four of them set; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct CompensationDivider {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Back to zero.
    pub clear: Signal<In, Bit>,
    /// High for one clock per laser pulse.
    pub pulse: Signal<In, Bit>,
    /// F/1000 in BCD, 0000 for off.
    pub preset: Signal<In, Bits<16>>,
    /// High for one clock after every F-th pulse.
    pub due: Signal<Out, Bit>,
    units: DecadeCounter,
    tens: DecadeCounter,
    hundreds: DecadeCounter,
    thousands: DecadeCounter,
    ten_thousands: DecadeCounter,
    hundred_thousands: DecadeCounter,
    millions: DecadeCounter,
    enabled: Signal<Local, Bit>,
    line_123: Signal<Local, Bit>,
    coincidence: Signal<Local, Bit>,
    restart: Signal<Local, Bit>,
}

impl Logic for CompensationDivider {
    #[hdl_gen]
    fn update(&mut self) {
        self.units.clock.next = self.clock.val();
        self.tens.clock.next = self.clock.val();
        self.hundreds.clock.next = self.clock.val();
        self.thousands.clock.next = self.clock.val();
        self.ten_thousands.clock.next = self.clock.val();
        self.hundred_thousands.clock.next = self.clock.val();
        self.millions.clock.next = self.clock.val();

        self.enabled.next = self.preset.val().any();
        self.line_123.next = (self.units.digit.val() == 0)
            & (self.tens.digit.val() == 0)
            & (self.hundreds.digit.val() == 0);
        self.coincidence.next = (self.thousands.digit.val() == self.preset.val().get_bits::<4>(0))
            & (self.ten_thousands.digit.val() == self.preset.val().get_bits::<4>(4))
            & (self.hundred_thousands.digit.val() == self.preset.val().get_bits::<4>(8))
            & (self.millions.digit.val() == self.preset.val().get_bits::<4>(12))
            & self.line_123.val()
            & self.enabled.val();
        self.restart.next = self.coincidence.val() | self.clear.val() | !self.enabled.val();

        self.units.clear.next = self.restart.val();
        self.tens.clear.next = self.restart.val();
        self.hundreds.clear.next = self.restart.val();
        self.thousands.clear.next = self.restart.val();
        self.ten_thousands.clear.next = self.restart.val();
        self.hundred_thousands.clear.next = self.restart.val();
        self.millions.clear.next = self.restart.val();
        self.units.count.next = self.pulse.val() & self.enabled.val() & !self.clear.val();
        self.tens.count.next = self.units.carry.val();
        self.hundreds.count.next = self.tens.carry.val();
        self.thousands.count.next = self.hundreds.carry.val();
        self.ten_thousands.count.next = self.thousands.carry.val();
        self.hundred_thousands.count.next = self.ten_thousands.carry.val();
        self.millions.count.next = self.hundred_thousands.carry.val();

        self.due.next = self.coincidence.val();
    }
}
