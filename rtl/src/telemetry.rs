//! Telemetry: a frame for every comparison, its bytes handed to a transmitter one by one.
//!
//! No figure: the recorder of 1977 took T1 and T2 as voltages.
//!
//! | port            | dir | meaning                                                           |
//! |-----------------|-----|-------------------------------------------------------------------|
//! | `clock`         | in  | FPGA clock, rising edge                                           |
//! | `clear`         | in  | no comparison begun, nothing to send                              |
//! | `measuring`     | in  | the initial phase is selected                                     |
//! | `opening`       | in  | high for one clock: a comparison ends and the next begins         |
//! | `meter`         | in  | T1                                                                |
//! | `forward`       | in  | the discriminator's Q                                             |
//! | `count`         | in  | steps away from zero                                              |
//! | `count_forward` | in  | on which side                                                     |
//! | `fault`         | in  | a step was refused                                                |
//! | `alarm`         | in  | the supervisor's                                                  |
//! | `ready`         | in  | the transmitter takes a byte                                      |
//! | `send`          | out | high for one clock: `data` is the next byte                       |
//! | `data`          | out | that byte                                                         |
//!
//! # Sequence
//!
//! A frame is 15 bytes, numbers with their low byte first; on the wire it is byte-stuffed (COBS), so
//! that a zero byte ends it and stands nowhere else: 17 bytes.
//!
//! | bytes   | what                                                                             |
//! |---------|----------------------------------------------------------------------------------|
//! | 0       | 1: a comparison                                                                  |
//! | 1, 2    | its number in the pass, modulo 65 536; a gap is a frame that was not sent        |
//! | 3 … 6   | width: clocks that T1 was high in it                                             |
//! | 7 … 10  | period: its clocks, from opening to opening; 2³¹ stands for that and more        |
//! | 11, 12  | steps from zero, 12 bits; then bit by bit: forward of zero, Q, fault, alarm      |
//! | 13, 14  | [check](crate::frame_check) of the bytes before                                  |
//!
//! # Waveform
//!
//! `measuring` = 1: the first opening begins, each further one ends a comparison and sends.
//!
//! ```text
//! opening ▁▔▁▁▁▔▁▁▁▁▁▁
//! meter   ▁▁▔▔▁▁▔▔▁▁▁▁
//! send    ▁▁▁▁▁▁▁▁▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! A comparison that ends while a frame is under way is counted and not sent. The clock of the
//! opening belongs to the comparison that begins with it.
//!
//! # Inferred
//!
//! All of it. The counts stop at 2³¹ clocks, three minutes at 12 MHz. Between frames everything but
//! the counts and the ring is zero, as it is at power-up.

use rust_hdl::prelude::*;

use crate::frame_check::FrameCheck;

/// Two counters and a ring of bytes; see the [module](self) for ports and the frame.
#[derive(Debug, Default, LogicBlock)]
pub struct Telemetry {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Nothing begun, nothing to send.
    pub clear: Signal<In, Bit>,
    /// The initial phase is selected.
    pub measuring: Signal<In, Bit>,
    /// A comparison ends and the next begins.
    pub opening: Signal<In, Bit>,
    /// T1.
    pub meter: Signal<In, Bit>,
    /// The discriminator's Q.
    pub forward: Signal<In, Bit>,
    /// Steps away from zero.
    pub count: Signal<In, Bits<12>>,
    /// On which side.
    pub count_forward: Signal<In, Bit>,
    /// A step was refused.
    pub fault: Signal<In, Bit>,
    /// The supervisor's.
    pub alarm: Signal<In, Bit>,
    /// The transmitter takes a byte.
    pub ready: Signal<In, Bit>,
    /// `data` is the next byte.
    pub send: Signal<Out, Bit>,
    /// That byte.
    pub data: Signal<Out, Bits<8>>,
    remainder: FrameCheck,
    begun: DFF<Bit>,
    since: DFF<Bits<32>>,
    high: DFF<Bits<32>>,
    number: DFF<Bits<16>>,
    low: DFF<Bits<56>>,
    upper: DFF<Bits<64>>,
    phase: DFF<Bits<3>>,
    turns: DFF<Bits<7>>,
    place: DFF<Bits<4>>,
    sent: DFF<Bits<4>>,
    run: DFF<Bits<4>>,
    found: DFF<Bit>,
    at_zero: DFF<Bit>,
    since_more: Signal<Local, Bits<32>>,
    high_more: Signal<Local, Bits<32>>,
    full: Signal<Local, Bit>,
    number_more: Signal<Local, Bits<16>>,
    ends: Signal<Local, Bit>,
    forward_bit: Signal<Local, Bits<16>>,
    decision_bit: Signal<Local, Bits<16>>,
    fault_bit: Signal<Local, Bits<16>>,
    alarm_bit: Signal<Local, Bits<16>>,
    state: Signal<Local, Bits<16>>,
    state_wide: Signal<Local, Bits<64>>,
    fresh_low: Signal<Local, Bits<56>>,
    fresh_upper: Signal<Local, Bits<64>>,
    number_wide: Signal<Local, Bits<56>>,
    width_wide: Signal<Local, Bits<56>>,
    period_wide: Signal<Local, Bits<64>>,
    count_wide: Signal<Local, Bits<16>>,
    check_wide: Signal<Local, Bits<56>>,
    turned_low: Signal<Local, Bits<56>>,
    turned_upper: Signal<Local, Bits<64>>,
    turns_less: Signal<Local, Bits<7>>,
    place_more: Signal<Local, Bits<4>>,
    sent_more: Signal<Local, Bits<4>>,
    left: Signal<Local, Bits<4>>,
    run_more: Signal<Local, Bits<4>>,
    run_less: Signal<Local, Bits<4>>,
    run_wide: Signal<Local, Bits<8>>,
    code: Signal<Local, Bits<8>>,
    still: Signal<Local, Bit>,
    remains: Signal<Local, Bit>,
    zero: Signal<Local, Bit>,
}

#[expect(clippy::too_many_lines, reason = "counters, ring and byte stuffing, few lines each")]
impl Logic for Telemetry {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self, clock, begun, since, high, number, low, upper, phase, turns, place, sent, run,
            found, at_zero
        );

        // The comparison that runs.
        self.since_more.next = self.since.q.val() + 1;
        self.high_more.next = self.high.q.val() + 1;
        self.full.next = self.since.q.val().get_bit(31);
        if self.opening.val() {
            self.since.d.next = 1.into();
        } else if !self.full.val() {
            self.since.d.next = self.since_more.val();
        }
        if self.opening.val() & self.meter.val() {
            self.high.d.next = 1.into();
        } else if self.opening.val() {
            self.high.d.next = 0.into();
        } else if self.meter.val() & !self.full.val() {
            self.high.d.next = self.high_more.val();
        }
        self.number_more.next = self.number.q.val() + 1;
        self.ends.next = self.begun.q.val() & self.opening.val();
        if self.clear.val() | !self.measuring.val() {
            self.begun.d.next = false;
        } else if self.opening.val() {
            self.begun.d.next = true;
        }
        if self.clear.val() | !self.measuring.val() {
            self.number.d.next = 0.into();
        } else if self.ends.val() {
            self.number.d.next = self.number_more.val();
        }

        // Its frame, the check still zero.
        self.forward_bit.next = 0.into();
        self.decision_bit.next = 0.into();
        self.fault_bit.next = 0.into();
        self.alarm_bit.next = 0.into();
        if self.count_forward.val() {
            self.forward_bit.next = 0x1000.into();
        }
        if self.forward.val() {
            self.decision_bit.next = 0x2000.into();
        }
        if self.fault.val() {
            self.fault_bit.next = 0x4000.into();
        }
        if self.alarm.val() {
            self.alarm_bit.next = 0x8000.into();
        }
        self.count_wide.next = bit_cast::<16, 12>(self.count.val());
        self.state.next = self.count_wide.val()
            | self.forward_bit.val()
            | self.decision_bit.val()
            | self.fault_bit.val()
            | self.alarm_bit.val();
        self.state_wide.next = bit_cast::<64, 16>(self.state.val());
        self.number_wide.next = bit_cast::<56, 16>(self.number.q.val());
        self.width_wide.next = bit_cast::<56, 32>(self.high.q.val());
        self.period_wide.next = bit_cast::<64, 32>(self.since.q.val());
        self.fresh_low.next = (self.number_wide.val() << 8) | (self.width_wide.val() << 24) | 1;
        self.fresh_upper.next = self.period_wide.val() | (self.state_wide.val() << 32);

        // The ring, a bit at a time.
        self.turned_low.next = self.low.q.val() >> 1;
        if self.upper.q.val().get_bit(0) {
            self.turned_low.next = (self.low.q.val() >> 1) | 0x80_0000_0000_0000_u64;
        }
        self.turned_upper.next = self.upper.q.val() >> 1;
        if self.low.q.val().get_bit(0) {
            self.turned_upper.next = (self.upper.q.val() >> 1) | 0x8000_0000_0000_0000_u64;
        }
        self.check_wide.next = bit_cast::<56, 16>(self.remainder.check.val());
        self.still.next = self.turns.q.val() == 0;
        self.turns_less.next = self.turns.q.val() - 1;
        self.place_more.next = self.place.q.val() + 1;
        // Of fifteen bytes; the end of the frame is the sixteenth, and the count is zero again.
        self.sent_more.next = self.sent.q.val() + 1;
        self.left.next = !self.sent.q.val();
        self.run_more.next = self.run.q.val() + 1;
        self.run_less.next = self.run.q.val() - 1;
        self.remains.next = self.place.q.val() < self.left.val();
        self.zero.next = self.low.q.val().get_bits::<8>(0) == 0;
        self.run_wide.next = bit_cast::<8, 4>(self.run.q.val());
        // Sixteen when no byte of a frame is zero.
        self.code.next = self.run_wide.val() + 1;
        self.data.next = self.low.q.val().get_bits::<8>(0);
        self.send.next = false;
        self.remainder.clock.next = self.clock.val();
        self.remainder.clear.next = self.phase.q.val() == 0;
        // Further turns of the ring come when the check has been taken.
        self.remainder.take.next = !self.still.val();
        self.remainder.level.next = self.low.q.val().get_bit(0);
        if !self.still.val() {
            self.low.d.next = self.turned_low.val();
            self.upper.d.next = self.turned_upper.val();
            self.turns.d.next = self.turns_less.val();
        } else if (self.phase.q.val() == 0) & self.ends.val() {
            // Thirteen bytes pass the check.
            self.low.d.next = self.fresh_low.val();
            self.upper.d.next = self.fresh_upper.val();
            self.turns.d.next = 104.into();
            self.phase.d.next = 1.into();
        } else if self.phase.q.val() == 1 {
            self.low.d.next = self.low.q.val() ^ self.check_wide.val();
            self.turns.d.next = 16.into();
            self.phase.d.next = 2.into();
        } else if self.phase.q.val() == 2 {
            // Once round: how many bytes to the next zero, or to the end.
            self.place.d.next = self.place_more.val();
            if self.place.q.val() == 15 {
                self.found.d.next = false;
                self.phase.d.next = 3.into();
            } else {
                self.turns.d.next = 8.into();
                if self.remains.val() & !self.zero.val() & !self.found.q.val() {
                    self.run.d.next = self.run_more.val();
                } else if !self.found.q.val() {
                    self.found.d.next = true;
                    self.at_zero.d.next = self.remains.val();
                }
            }
        } else if (self.phase.q.val() == 3) & self.ready.val() {
            self.data.next = self.code.val();
            self.send.next = true;
            self.phase.d.next = 4.into();
        } else if (self.phase.q.val() == 4) & self.run.q.val().any() {
            if self.ready.val() {
                self.send.next = true;
                self.run.d.next = self.run_less.val();
                self.sent.d.next = self.sent_more.val();
                self.turns.d.next = 8.into();
            }
        } else if (self.phase.q.val() == 4) & self.at_zero.q.val() {
            // The zero itself is not sent.
            self.sent.d.next = self.sent_more.val();
            self.turns.d.next = 8.into();
            self.phase.d.next = 2.into();
        } else if self.phase.q.val() == 4 {
            self.phase.d.next = 5.into();
        } else if (self.phase.q.val() == 5) & self.ready.val() {
            self.data.next = 0.into();
            self.send.next = true;
            self.sent.d.next = self.sent_more.val();
            self.phase.d.next = 0.into();
        }
        if self.clear.val() {
            self.phase.d.next = 0.into();
            self.turns.d.next = 0.into();
            self.place.d.next = 0.into();
            self.sent.d.next = 0.into();
            self.run.d.next = 0.into();
            self.found.d.next = false;
            self.at_zero.d.next = false;
        }
    }
}
