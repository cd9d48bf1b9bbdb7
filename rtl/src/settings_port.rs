//! Settings port: the wheels, turned from a computer over a serial port while the device is at rest.
//!
//! No figure: the wheels of 1977 are turned by hand. Between telemetry and transmitter, whose line
//! its answers share, and between the bitstream's settings and the device.
//!
//! | port                        | dir | meaning                                                |
//! |-----------------------------|-----|--------------------------------------------------------|
//! | `clock`                     | in  | FPGA clock, rising edge                                |
//! | `clear`                     | in  | the bitstream's settings, nothing asked                |
//! | `at_rest`                   | in  | wheels may be turned                                   |
//! | `received`                  | in  | high for one clock: `received_byte` has come from the computer  |
//! | `received_byte`             | in  | that byte, steady for four clocks more                 |
//! | `telemetry_send`            | in  | the telemetry sends `telemetry_byte`                   |
//! | `telemetry_byte`            | in  | its byte                                               |
//! | `ready`                     | in  | the transmitter takes a byte                           |
//! | `tick_period`               | in  | clocks of a millisecond, for the identity              |
//! | `built_divide_a`            | in  | A of the bitstream, BCD                                |
//! | `built_divide_b`            | in  | B of the bitstream, BCD                                |
//! | `built_range_x2`            | in  | range of the bitstream                                 |
//! | `built_initial_phase`       | in  | m of the bitstream, BCD                                |
//! | `built_compensation`        | in  | F/1000 of the bitstream, BCD                           |
//! | `built_compensation_insert` | in  | insert, of the bitstream                               |
//! | `built_step_period`         | in  | step period of the bitstream                           |
//! | `divide_a`                  | out | A in BCD                                               |
//! | `divide_b`                  | out | B in BCD                                               |
//! | `range_x2`                  | out | ×2 instead of ×1                                       |
//! | `initial_phase`             | out | m in BCD                                               |
//! | `compensation`              | out | F/1000 in BCD                                          |
//! | `compensation_insert`       | out | insert instead of block                                |
//! | `step_period`               | out | clocks from step to step                               |
//! | `telemetry_ready`           | out | the transmitter takes a byte of the telemetry          |
//! | `send`                      | out | `data` goes out                                        |
//! | `data`                      | out | the byte                                               |
//!
//! # Sequence
//!
//! Requests and answers are frames of 27 bytes: 1A, then 25 digits, each a byte 30 to 3F whose low
//! half it is, then 00. That is byte stuffing (COBS) of content without a zero, and no frame of the
//! telemetry is as long. Numbers have their low digit first.
//!
//! | digits   | what, of a request or answer  | of an identity, the answer 1      |
//! |----------|-------------------------------|-----------------------------------|
//! | 0        | kind                          | 1                                 |
//! | 1 … 3    | A                             | 430, of the identifier 7430       |
//! | 4 … 6    | B                             | 7 of the identifier, version 1, 0 |
//! | 7 … 9    | m                             | 0                                 |
//! | 10 … 13  | F/1000                        | 0                                 |
//! | 14 … 19  | step period, clocks, binary   | clocks of a millisecond           |
//! | 20       | 1 for ×2, 2 more for insert   | 0                                 |
//! | 21 … 24  | [check](crate::frame_check) of the digits, four bits each | likewise |
//!
//! | request      | answer                                                              |
//! |--------------|---------------------------------------------------------------------|
//! | 1 identify   | 1 with the identity                                                 |
//! | 2 read       | 2 with the settings                                                 |
//! | 3 write      | 3 with the settings, now those of the request                       |
//! |              | 4 with the settings as they were: the device is not at rest         |
//! |              | 5 likewise: no wheel shows what was asked for                       |
//!
//! Wheels show decimal digits, A and B from 1, and 128 clocks from step to step or more, since a
//! pulse of the [step driver](crate::step_driver) takes as many. What is no such request, or did not
//! come over whole, is not answered; what comes while an answer is due or under way is not heard.
//!
//! # Waveform
//!
//! No byte has come: what the telemetry sends passes.
//!
//! ```text
//! telemetry_send  ▁▔▁▁▔▁▁▁
//! ready           ▔▔▁▁▔▁▔▔
//! send            ▁▔▁▁▔▁▁▁
//! telemetry_ready ▔▔▁▁▔▁▔▔
//! ```
//!
//! # At the same time
//!
//! An answer waits for the end of a frame that the telemetry has begun, and holds up the next one.
//! A write whose last byte comes in the clock in which `at_rest` ends is refused.
//!
//! # Inferred
//!
//! All of it. A flip-flop holds what differs from the bitstream's setting, so that one which wakes up
//! as zero wakes up with the bitstream's.

use rust_hdl::prelude::*;

use crate::frame_check::FrameCheck;

/// A design without the block: an output, and the input that stands in its place.
pub const PASSED: [(&str, &str); 10] = [
    ("divide_a", "built_divide_a"),
    ("divide_b", "built_divide_b"),
    ("range_x2", "built_range_x2"),
    ("initial_phase", "built_initial_phase"),
    ("compensation", "built_compensation"),
    ("compensation_insert", "built_compensation_insert"),
    ("step_period", "built_step_period"),
    ("telemetry_ready", "ready"),
    ("send", "telemetry_send"),
    ("data", "telemetry_byte"),
];

/// A shift register, settings and a check; see the [module](self) for ports and frames.
#[derive(Debug, Default, LogicBlock)]
pub struct SettingsPort {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// The bitstream's settings.
    pub clear: Signal<In, Bit>,
    /// Wheels may be turned.
    pub at_rest: Signal<In, Bit>,
    /// `received_byte` has come.
    pub received: Signal<In, Bit>,
    /// That byte.
    pub received_byte: Signal<In, Bits<8>>,
    /// The telemetry sends.
    pub telemetry_send: Signal<In, Bit>,
    /// Its byte.
    pub telemetry_byte: Signal<In, Bits<8>>,
    /// The transmitter takes a byte.
    pub ready: Signal<In, Bit>,
    /// Clocks of a millisecond.
    pub tick_period: Signal<In, Bits<24>>,
    /// A of the bitstream.
    pub built_divide_a: Signal<In, Bits<12>>,
    /// B of the bitstream.
    pub built_divide_b: Signal<In, Bits<12>>,
    /// Its range.
    pub built_range_x2: Signal<In, Bit>,
    /// Its m.
    pub built_initial_phase: Signal<In, Bits<12>>,
    /// Its F/1000.
    pub built_compensation: Signal<In, Bits<16>>,
    /// Its way of compensating.
    pub built_compensation_insert: Signal<In, Bit>,
    /// Its step period.
    pub built_step_period: Signal<In, Bits<24>>,
    /// A.
    pub divide_a: Signal<Out, Bits<12>>,
    /// B.
    pub divide_b: Signal<Out, Bits<12>>,
    /// ×2 instead of ×1.
    pub range_x2: Signal<Out, Bit>,
    /// m.
    pub initial_phase: Signal<Out, Bits<12>>,
    /// F/1000.
    pub compensation: Signal<Out, Bits<16>>,
    /// Insert instead of block.
    pub compensation_insert: Signal<Out, Bit>,
    /// Clocks from step to step.
    pub step_period: Signal<Out, Bits<24>>,
    /// The transmitter takes a byte of the telemetry.
    pub telemetry_ready: Signal<Out, Bit>,
    /// `data` goes out.
    pub send: Signal<Out, Bit>,
    /// The byte.
    pub data: Signal<Out, Bits<8>>,
    remainder: FrameCheck,
    // Digits of a frame but its check, the first lowest: coming or going.
    low: DFF<Bits<40>>,
    high: DFF<Bits<44>>,
    // What differs from the bitstream's settings: A, B and m; the others.
    low_changed: DFF<Bits<36>>,
    high_changed: DFF<Bits<42>>,
    // Of a frame's bytes, which is the next; and bits of its digit still to be passed.
    place: DFF<Bits<5>>,
    turns: DFF<Bits<3>>,
    pending: DFF<Bit>,
    answering: DFF<Bit>,
    telemetry_busy: DFF<Bit>,
    built_a_wide: Signal<Local, Bits<36>>,
    built_b_wide: Signal<Local, Bits<36>>,
    built_m_wide: Signal<Local, Bits<36>>,
    built_f_wide: Signal<Local, Bits<42>>,
    built_period_wide: Signal<Local, Bits<42>>,
    built_range_wide: Signal<Local, Bits<42>>,
    built_insert_wide: Signal<Local, Bits<42>>,
    low_built: Signal<Local, Bits<36>>,
    high_built: Signal<Local, Bits<42>>,
    low_set: Signal<Local, Bits<36>>,
    high_set: Signal<Local, Bits<42>>,
    low_asked: Signal<Local, Bits<36>>,
    high_asked: Signal<Local, Bits<42>>,
    low_over: Signal<Local, Bits<36>>,
    high_over: Signal<Local, Bits<42>>,
    period_asked: Signal<Local, Bits<24>>,
    shown: Signal<Local, Bit>,
    kind: Signal<Local, Bits<4>>,
    outcome: Signal<Local, Bits<40>>,
    turning: Signal<Local, Bit>,
    in_content: Signal<Local, Bit>,
    place_more: Signal<Local, Bits<5>>,
    turns_less: Signal<Local, Bits<3>>,
    coming: Signal<Local, Bit>,
    passing: Signal<Local, Bit>,
    low_turned: Signal<Local, Bits<40>>,
    high_turned: Signal<Local, Bits<44>>,
    tick_wide: Signal<Local, Bits<44>>,
    low_wide: Signal<Local, Bits<40>>,
    low_told: Signal<Local, Bits<40>>,
    high_told: Signal<Local, Bits<44>>,
    told: Signal<Local, Bits<40>>,
    heard: Signal<Local, Bit>,
    begins: Signal<Local, Bit>,
    digit: Signal<Local, Bit>,
    asked: Signal<Local, Bit>,
    answers: Signal<Local, Bit>,
    writes: Signal<Local, Bit>,
    claims: Signal<Local, Bit>,
    sends: Signal<Local, Bit>,
    low_digit: Signal<Local, Bits<8>>,
    check_digit: Signal<Local, Bits<8>>,
}

#[expect(clippy::too_many_lines, reason = "settings, request and answer, few lines each")]
#[expect(clippy::if_not_else, reason = "the telemetry has the line, but for an answer")]
impl Logic for SettingsPort {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            low,
            high,
            low_changed,
            high_changed,
            place,
            turns,
            pending,
            answering,
            telemetry_busy
        );

        // Settings.
        self.built_a_wide.next = bit_cast::<36, 12>(self.built_divide_a.val());
        self.built_b_wide.next = bit_cast::<36, 12>(self.built_divide_b.val());
        self.built_m_wide.next = bit_cast::<36, 12>(self.built_initial_phase.val());
        self.built_f_wide.next = bit_cast::<42, 16>(self.built_compensation.val());
        self.built_period_wide.next = bit_cast::<42, 24>(self.built_step_period.val());
        self.built_range_wide.next = 0.into();
        if self.built_range_x2.val() {
            self.built_range_wide.next = 0x100_0000_0000_u64.into();
        }
        self.built_insert_wide.next = 0.into();
        if self.built_compensation_insert.val() {
            self.built_insert_wide.next = 0x200_0000_0000_u64.into();
        }
        self.low_built.next = self.built_a_wide.val()
            | (self.built_b_wide.val() << 12)
            | (self.built_m_wide.val() << 24);
        self.high_built.next = self.built_f_wide.val()
            | (self.built_period_wide.val() << 16)
            | self.built_range_wide.val()
            | self.built_insert_wide.val();
        self.low_set.next = self.low_built.val() ^ self.low_changed.q.val();
        self.high_set.next = self.high_built.val() ^ self.high_changed.q.val();
        self.divide_a.next = self.low_set.val().get_bits::<12>(0);
        self.divide_b.next = self.low_set.val().get_bits::<12>(12);
        self.initial_phase.next = self.low_set.val().get_bits::<12>(24);
        self.compensation.next = self.high_set.val().get_bits::<16>(0);
        self.step_period.next = self.high_set.val().get_bits::<24>(16);
        self.range_x2.next = self.high_set.val().get_bit(40);
        self.compensation_insert.next = self.high_set.val().get_bit(41);

        // What is asked for, and whether wheels show it: a digit with 8 has neither 4 nor 2.
        self.kind.next = self.low.q.val().get_bits::<4>(0);
        self.low_asked.next = self.low.q.val().get_bits::<36>(4);
        self.high_asked.next = self.high.q.val().get_bits::<42>(0);
        self.low_over.next = self.low_asked.val()
            & ((self.low_asked.val() << 1) | (self.low_asked.val() << 2))
            & 0x8_8888_8888_u64;
        self.high_over.next = self.high_asked.val()
            & ((self.high_asked.val() << 1) | (self.high_asked.val() << 2))
            & 0x8888;
        self.period_asked.next = self.high_asked.val().get_bits::<24>(16);
        self.shown.next = !self.low_over.val().any()
            & !self.high_over.val().any()
            & self.low_asked.val().get_bits::<12>(0).any()
            & self.low_asked.val().get_bits::<12>(12).any()
            & (self.period_asked.val() >= 128)
            & !self.high.q.val().get_bit(42)
            & !self.high.q.val().get_bit(43);

        // A digit passes bit by bit: into the register or out of it, and into the check.
        self.turning.next = self.turns.q.val().any();
        self.turns_less.next = self.turns.q.val() - 1;
        self.place_more.next = self.place.q.val() + 1;
        self.in_content.next = self.place.q.val() < 22;
        if self.turns.q.val() == 4 {
            self.coming.next = self.received_byte.val().get_bit(0);
        } else if self.turns.q.val() == 3 {
            self.coming.next = self.received_byte.val().get_bit(1);
        } else if self.turns.q.val() == 2 {
            self.coming.next = self.received_byte.val().get_bit(2);
        } else {
            self.coming.next = self.received_byte.val().get_bit(3);
        }
        if !self.answering.q.val() {
            self.passing.next = self.coming.val();
        } else if self.in_content.val() {
            self.passing.next = self.low.q.val().get_bit(0);
        } else {
            // By its own last bit the check is only shifted.
            self.passing.next = !self.remainder.check.val().get_bit(0);
        }
        self.low_turned.next = self.low.q.val() >> 1;
        if self.high.q.val().get_bit(0) {
            self.low_turned.next = (self.low.q.val() >> 1) | 0x80_0000_0000_u64;
        }
        self.high_turned.next = self.high.q.val() >> 1;
        if self.coming.val() {
            self.high_turned.next = (self.high.q.val() >> 1) | 0x800_0000_0000_u64;
        }

        // A request.
        self.heard.next = self.received.val()
            & !self.turning.val()
            & !self.pending.q.val()
            & !self.answering.q.val();
        self.begins.next = self.heard.val() & (self.received_byte.val() == 0x1a);
        self.remainder.clock.next = self.clock.val();
        self.remainder.clear.next = (self.place.q.val() == 0) | self.begins.val();
        self.remainder.take.next = self.turning.val();
        self.remainder.level.next = self.passing.val();
        self.digit.next = self.heard.val()
            & (self.received_byte.val().get_bits::<4>(4) == 3)
            & (self.place.q.val() != 0)
            & (self.place.q.val() != 26);
        self.asked.next = self.heard.val()
            & (self.received_byte.val() == 0)
            & (self.place.q.val() == 26)
            & (self.remainder.check.val() == 0x0f47);
        self.answers.next = self.asked.val()
            & ((self.kind.val() == 1) | (self.kind.val() == 2) | (self.kind.val() == 3));
        self.writes.next =
            self.asked.val() & (self.kind.val() == 3) & self.at_rest.val() & self.shown.val();
        self.outcome.next = self.low.q.val();
        if (self.kind.val() == 3) & !self.at_rest.val() {
            self.outcome.next = 4.into();
        } else if (self.kind.val() == 3) & !self.shown.val() {
            self.outcome.next = 5.into();
        }

        // Its answer.
        self.claims.next =
            self.pending.q.val() & !self.telemetry_busy.q.val() & !self.telemetry_send.val();
        self.sends.next = self.answering.q.val() & self.ready.val() & !self.turning.val();
        self.tick_wide.next = bit_cast::<44, 24>(self.tick_period.val());
        self.low_wide.next = bit_cast::<40, 36>(self.low_set.val());
        if self.kind.val() == 1 {
            self.low_told.next = 0x17_4300.into();
            self.high_told.next = self.tick_wide.val() << 16;
        } else {
            self.low_told.next = self.low_wide.val() << 4;
            self.high_told.next = bit_cast::<44, 42>(self.high_set.val());
        }
        self.told.next = bit_cast::<40, 4>(self.kind.val());

        if self.turning.val() {
            self.turns.d.next = self.turns_less.val();
            if self.turns.q.val() == 1 {
                self.place.d.next = self.place_more.val();
            }
            if self.in_content.val() {
                self.low.d.next = self.low_turned.val();
                self.high.d.next = self.high_turned.val();
            }
        } else if self.begins.val() {
            self.place.d.next = 1.into();
        } else if self.digit.val() {
            self.turns.d.next = 4.into();
        } else if self.heard.val() {
            self.place.d.next = 0.into();
            if self.answers.val() {
                self.pending.d.next = true;
                self.low.d.next = self.outcome.val();
            }
        } else if self.claims.val() {
            self.pending.d.next = false;
            self.answering.d.next = true;
            self.low.d.next = self.low_told.val() | self.told.val();
            self.high.d.next = self.high_told.val();
        } else if self.sends.val() & (self.place.q.val() == 0) {
            self.place.d.next = 1.into();
        } else if self.sends.val() & (self.place.q.val() == 26) {
            self.place.d.next = 0.into();
            self.answering.d.next = false;
        } else if self.sends.val() {
            self.turns.d.next = 4.into();
        }
        if self.writes.val() {
            self.low_changed.d.next = self.low_asked.val() ^ self.low_built.val();
            self.high_changed.d.next = self.high_asked.val() ^ self.high_built.val();
        }
        if self.telemetry_send.val() {
            self.telemetry_busy.d.next = self.telemetry_byte.val().any();
        }
        if self.clear.val() {
            self.low_changed.d.next = 0.into();
            self.high_changed.d.next = 0.into();
            self.place.d.next = 0.into();
            self.turns.d.next = 0.into();
            self.pending.d.next = false;
            self.answering.d.next = false;
            self.telemetry_busy.d.next = false;
        }

        // The line: an answer's byte, or the telemetry's.
        self.low_digit.next = bit_cast::<8, 4>(self.kind.val());
        self.check_digit.next = bit_cast::<8, 16>(self.remainder.check.val()) & 0x0f;
        self.telemetry_ready.next = self.ready.val() & !self.answering.q.val();
        if !self.answering.q.val() {
            self.send.next = self.telemetry_send.val();
            self.data.next = self.telemetry_byte.val();
        } else {
            self.send.next = self.sends.val();
            if self.place.q.val() == 0 {
                self.data.next = 0x1a.into();
            } else if self.place.q.val() == 26 {
                self.data.next = 0.into();
            } else if self.in_content.val() {
                self.data.next = self.low_digit.val() | 0x30;
            } else {
                self.data.next = self.check_digit.val() | 0x30;
            }
        }
    }
}
