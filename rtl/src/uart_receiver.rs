//! UART receiver: bytes in from one wire, eight data bits, no parity, one stop bit.
//!
//! No figure.
//!
//! | port         | dir | meaning                                                        |
//! |--------------|-----|----------------------------------------------------------------|
//! | `clock`      | in  | FPGA clock, rising edge                                        |
//! | `clear`      | in  | no byte under way                                              |
//! | `bit_clocks` | in  | clocks of a bit, 2 or more                                     |
//! | `line`       | in  | the wire, high at rest                                         |
//! | `received`   | out | high for one clock: `data` is a byte that came over whole      |
//! | `data`       | out | that byte, until the first bit of the next one                 |
//!
//! # Waveform
//!
//! `bit_clocks` = 002, and a byte 05:
//!
//! ```text
//! line     ▔▔▁▁▔▔▁▁▔▔▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔
//! received ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁▁
//! ```
//!
//! # At the same time
//!
//! A start bit that is over before its middle is none. A byte without its stop bit is none either,
//! and a line that stays low is such bytes for as long as it does.
//!
//! # Inferred
//!
//! All of it: the framing is that of every serial port. Each bit is looked at once, in its middle,
//! so the two clocks may differ by four parts in a hundred.

use rust_hdl::prelude::*;

use crate::level_synchroniser::LevelSynchroniser;

/// A shift register and two counters; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct UartReceiver {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// No byte under way.
    pub clear: Signal<In, Bit>,
    /// Clocks of a bit.
    pub bit_clocks: Signal<In, Bits<12>>,
    /// The wire.
    pub line: Signal<In, Bit>,
    /// `data` is a byte that came over whole.
    pub received: Signal<Out, Bit>,
    /// That byte.
    pub data: Signal<Out, Bits<8>>,
    // Of the wire inverted: flip-flops that wake up as zero are at rest.
    synchroniser: LevelSynchroniser,
    shift: DFF<Bits<8>>,
    bits_left: DFF<Bits<4>>,
    clocks_left: DFF<Bits<12>>,
    shifted: Signal<Local, Bits<8>>,
    half_bit: Signal<Local, Bits<12>>,
    fewer_bits: Signal<Local, Bits<4>>,
    fewer_clocks: Signal<Local, Bits<12>>,
    low: Signal<Local, Bit>,
    idle: Signal<Local, Bit>,
    middle: Signal<Local, Bit>,
    starting: Signal<Local, Bit>,
    stopping: Signal<Local, Bit>,
}

impl Logic for UartReceiver {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, shift, bits_left, clocks_left);
        self.synchroniser.clock.next = self.clock.val();
        self.synchroniser.pin.next = !self.line.val();
        self.low.next = self.synchroniser.level.val();
        self.half_bit.next = self.bit_clocks.val() >> 1;
        self.fewer_bits.next = self.bits_left.q.val() - 1;
        self.fewer_clocks.next = self.clocks_left.q.val() - 1;
        self.idle.next = self.bits_left.q.val() == 0;
        self.middle.next = self.clocks_left.q.val() == 1;
        self.starting.next = self.bits_left.q.val() == 10;
        self.stopping.next = self.bits_left.q.val() == 1;
        self.shifted.next = self.shift.q.val() >> 1;
        if !self.low.val() {
            self.shifted.next = (self.shift.q.val() >> 1) | 0x80;
        }

        if self.clear.val() | (self.starting.val() & self.middle.val() & !self.low.val()) {
            self.bits_left.d.next = 0.into();
        } else if self.idle.val() & self.low.val() {
            self.bits_left.d.next = 10.into();
            self.clocks_left.d.next = self.half_bit.val();
        } else if !self.idle.val() & self.middle.val() {
            self.bits_left.d.next = self.fewer_bits.val();
            self.clocks_left.d.next = self.bit_clocks.val();
            // What the start bit has put in falls out again.
            if !self.stopping.val() {
                self.shift.d.next = self.shifted.val();
            }
        } else if !self.idle.val() {
            self.clocks_left.d.next = self.fewer_clocks.val();
        }

        self.received.next = self.stopping.val() & self.middle.val() & !self.low.val();
        self.data.next = self.shift.q.val();
    }
}
