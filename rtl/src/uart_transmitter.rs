//! UART transmitter: bytes out on one wire, eight data bits, no parity, one stop bit.
//!
//! No figure.
//!
//! | port         | dir | meaning                                                        |
//! |--------------|-----|----------------------------------------------------------------|
//! | `clock`      | in  | FPGA clock, rising edge                                        |
//! | `clear`      | in  | line at rest                                                   |
//! | `bit_clocks` | in  | clocks of a bit, 2 or more                                     |
//! | `send`       | in  | high for one clock: `data` goes out                            |
//! | `data`       | in  | the byte, lowest bit first                                     |
//! | `line`       | out | the wire, high at rest                                         |
//! | `ready`      | out | a byte may be sent                                             |
//!
//! # Waveform
//!
//! `bit_clocks` = 002, `data` = 05:
//!
//! ```text
//! send  ▁▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
//! line  ▔▔▁▁▔▔▁▁▔▔▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔
//! ready ▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔
//! ```
//!
//! # At the same time
//!
//! `send` while a byte is under way is not heard.
//!
//! # Inferred
//!
//! All of it: the framing is that of every serial port.

use rust_hdl::prelude::*;

/// A shift register and two counters; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct UartTransmitter {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Line at rest.
    pub clear: Signal<In, Bit>,
    /// Clocks of a bit.
    pub bit_clocks: Signal<In, Bits<12>>,
    /// `data` goes out.
    pub send: Signal<In, Bit>,
    /// The byte.
    pub data: Signal<In, Bits<8>>,
    /// The wire.
    pub line: Signal<Out, Bit>,
    /// A byte may be sent.
    pub ready: Signal<Out, Bit>,
    shift: DFF<Bits<9>>,
    bits_left: DFF<Bits<4>>,
    clocks_left: DFF<Bits<12>>,
    inverted: Signal<Local, Bits<8>>,
    widened: Signal<Local, Bits<9>>,
    loaded: Signal<Local, Bits<9>>,
    shifted: Signal<Local, Bits<9>>,
    fewer_bits: Signal<Local, Bits<4>>,
    fewer_clocks: Signal<Local, Bits<12>>,
    idle: Signal<Local, Bit>,
    bit_ends: Signal<Local, Bit>,
}

impl Logic for UartTransmitter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, shift, bits_left, clocks_left);
        // The lowest bit is on the line, inverted: a flip-flop that wakes up as zero is at rest.
        self.inverted.next = !self.data.val();
        self.widened.next = bit_cast::<9, 8>(self.inverted.val());
        self.loaded.next = (self.widened.val() << 1) | 1;
        self.shifted.next = self.shift.q.val() >> 1;
        self.fewer_bits.next = self.bits_left.q.val() - 1;
        self.fewer_clocks.next = self.clocks_left.q.val() - 1;
        self.idle.next = self.bits_left.q.val() == 0;
        self.bit_ends.next = self.clocks_left.q.val() == 1;

        if self.clear.val() {
            self.shift.d.next = 0.into();
            self.bits_left.d.next = 0.into();
        } else if self.idle.val() & self.send.val() {
            self.shift.d.next = self.loaded.val();
            self.bits_left.d.next = 10.into();
            self.clocks_left.d.next = self.bit_clocks.val();
        } else if !self.idle.val() & self.bit_ends.val() {
            self.shift.d.next = self.shifted.val();
            self.bits_left.d.next = self.fewer_bits.val();
            self.clocks_left.d.next = self.bit_clocks.val();
        } else if !self.idle.val() {
            self.clocks_left.d.next = self.fewer_clocks.val();
        }

        self.line.next = !self.shift.q.val().get_bit(0);
        self.ready.next = self.idle.val();
    }
}
