//! Logic analyser: what eight signals of the board did, told to the programs that people have for it.
//!
//! No figure. It speaks SUMP, the protocol of the Openbench Logic Sniffer, which `sigrok-cli` and
//! `PulseView` read; in a design with it the [telemetry](crate::telemetry) gives it the serial port.
//! Its samples are kept in a memory beside it, 4096 bytes, which an FPGA has as block RAM.
//!
//! | port             | dir | meaning                                                          |
//! |------------------|-----|------------------------------------------------------------------|
//! | `clock`          | in  | FPGA clock, rising edge                                          |
//! | `clear`          | in  | nothing captured, nothing told                                   |
//! | `probes`         | in  | the signals                                                      |
//! | `received`       | in  | high for one clock: `received_byte` has come from the computer   |
//! | `received_byte`  | in  | that byte                                                        |
//! | `ready`          | in  | the transmitter takes a byte                                     |
//! | `rate`           | in  | clocks a second, as it tells the computer                        |
//! | `megahertz`      | in  | the same in MHz                                                  |
//! | `ticks`          | in  | whole ticks of 10 ns in a clock, 100/MHz                         |
//! | `ticks_rest`     | in  | what that division leaves                                        |
//! | `memory_data`    | in  | the byte that stood at `memory_address` one clock ago            |
//! | `memory_address` | out | place of the next sample, or of the one that is told             |
//! | `memory_write`   | out | `memory_sample` is put there                                     |
//! | `memory_sample`  | out | the signals, two clocks late                                     |
//! | `send`           | out | high for one clock: `data` goes out                              |
//! | `data`           | out | the byte                                                         |
//!
//! # Sequence
//!
//! A command is a byte, and with its highest bit set four more follow, the low one first.
//!
//! | command       | what                                                                     |
//! |---------------|--------------------------------------------------------------------------|
//! | 00 reset      | ends what it does; what was set stays                                    |
//! | 01 run        | captures, then tells the samples, the last one first                     |
//! | 02 identify   | tells `1ALS`                                                             |
//! | 04 metadata   | tells name, bytes of memory, highest rate, signals and protocol          |
//! | 80 divider    | 24 bits: a sample every so many ticks of 10 ns, and one                  |
//! | 81 counts     | 16 bits each: of all samples to tell, of those behind the trigger; (n + 1)·4 |
//! | C0 mask       | the signals that a trigger looks at; none: the first sample is it        |
//! | C1 value      | their levels                                                             |
//! | others        | nothing: flow control, further stages, flags                             |
//!
//! A sample belongs to the clock in which its tick falls, so that its time is right to a clock for
//! ever. Of a rate that is too high every clock is taken. The trigger is not looked for before there
//! are as many samples as are to be told of the time before it.
//!
//! # Waveform
//!
//! `ticks` = 8, `megahertz` = 0c, `ticks_rest` = 4, `ready` = 1: nothing is set, it runs, captures a
//! sample that is the trigger and four more, and tells these.
//!
//! ```text
//! received      ▁▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
//! received_byte 011111111111111111111
//! memory_write  ▁▁▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁
//! send          ▁▁▁▁▁▁▁▁▁▔▁▁▔▁▁▔▁▁▔▁▁
//! ```
//!
//! # At the same time
//!
//! An answer that is asked for while samples are told comes between two of them. `clear` forgets what
//! was set as well. A run begun while one is under way begins anew.
//!
//! # Inferred
//!
//! The commands are those that libsigrok sends. Counts are heard up to the memory, 10 bits of each.

use rust_hdl::prelude::*;

/// Bytes of the memory beside it.
pub const SAMPLES: usize = 4096;

/// Commands, a capture and answers; see the [module](self) for ports and protocol.
#[derive(Debug, Default, LogicBlock)]
pub struct LogicAnalyser {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Nothing captured, nothing told.
    pub clear: Signal<In, Bit>,
    /// The signals.
    pub probes: Signal<In, Bits<8>>,
    /// `received_byte` has come.
    pub received: Signal<In, Bit>,
    /// That byte.
    pub received_byte: Signal<In, Bits<8>>,
    /// The transmitter takes a byte.
    pub ready: Signal<In, Bit>,
    /// Clocks a second.
    pub rate: Signal<In, Bits<32>>,
    /// The same in MHz.
    pub megahertz: Signal<In, Bits<7>>,
    /// Whole ticks of 10 ns in a clock.
    pub ticks: Signal<In, Bits<4>>,
    /// What that division leaves.
    pub ticks_rest: Signal<In, Bits<7>>,
    /// The byte of a clock ago.
    pub memory_data: Signal<In, Bits<8>>,
    /// Place of a sample.
    pub memory_address: Signal<Out, Bits<12>>,
    /// A sample is put there.
    pub memory_write: Signal<Out, Bit>,
    /// That sample.
    pub memory_sample: Signal<Out, Bits<8>>,
    /// `data` goes out.
    pub send: Signal<Out, Bit>,
    /// The byte.
    pub data: Signal<Out, Bits<8>>,
    early: DFF<Bits<8>>,
    seen: DFF<Bits<8>>,
    // A command's byte, those of the four behind it that have come, and how many have not.
    command: DFF<Bits<8>>,
    arguments: DFF<Bits<32>>,
    missing: DFF<Bits<3>>,
    // What was set.
    divider: DFF<Bits<24>>,
    total: DFF<Bits<10>>,
    after: DFF<Bits<10>>,
    mask: DFF<Bits<8>>,
    value: DFF<Bits<8>>,
    // 0 at rest, 1 before the trigger, 2 behind it; then for every byte 3 a place back, 4 the memory
    // finds it, 5 it is told.
    phase: DFF<Bits<3>>,
    samples_left: DFF<Bits<13>>,
    address: DFF<Bits<12>>,
    ticks_left: DFF<Bits<24>>,
    fraction: DFF<Bits<7>>,
    // An answer and its next byte.
    telling: DFF<Bit>,
    place: DFF<Bits<5>>,
    heard: Signal<Local, Bit>,
    is_short: Signal<Local, Bit>,
    last_argument: Signal<Local, Bit>,
    byte_wide: Signal<Local, Bits<32>>,
    arrived: Signal<Local, Bits<32>>,
    missing_less: Signal<Local, Bits<3>>,
    resets: Signal<Local, Bit>,
    runs: Signal<Local, Bit>,
    fraction_wide: Signal<Local, Bits<8>>,
    rest_wide: Signal<Local, Bits<8>>,
    megahertz_wide: Signal<Local, Bits<8>>,
    fraction_sum: Signal<Local, Bits<8>>,
    fraction_over: Signal<Local, Bits<8>>,
    whole: Signal<Local, Bit>,
    ticks_wide: Signal<Local, Bits<25>>,
    ticks_now: Signal<Local, Bits<25>>,
    left_wide: Signal<Local, Bits<25>>,
    divider_wide: Signal<Local, Bits<25>>,
    left_less: Signal<Local, Bits<25>>,
    left_again: Signal<Local, Bits<25>>,
    running: Signal<Local, Bit>,
    due: Signal<Local, Bit>,
    fits: Signal<Local, Bit>,
    ahead: Signal<Local, Bits<10>>,
    ahead_wide: Signal<Local, Bits<13>>,
    after_wide: Signal<Local, Bits<13>>,
    total_wide: Signal<Local, Bits<13>>,
    after_count: Signal<Local, Bits<13>>,
    total_count: Signal<Local, Bits<13>>,
    samples_less: Signal<Local, Bits<13>>,
    last_sample: Signal<Local, Bit>,
    address_more: Signal<Local, Bits<12>>,
    address_less: Signal<Local, Bits<12>>,
    place_more: Signal<Local, Bits<5>>,
    tells: Signal<Local, Bit>,
    gives: Signal<Local, Bit>,
    answer: Signal<Local, Bits<8>>,
}

#[expect(clippy::too_many_lines, reason = "commands, capture and answers, few lines each")]
#[expect(clippy::match_same_arms, reason = "a text may have a letter twice")]
impl Logic for LogicAnalyser {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            early,
            seen,
            command,
            arguments,
            missing,
            divider,
            total,
            after,
            mask,
            value,
            phase,
            samples_left,
            address,
            ticks_left,
            fraction,
            telling,
            place
        );
        self.early.d.next = self.probes.val();
        self.seen.d.next = self.early.q.val();

        // Commands.
        self.heard.next = self.received.val() & (self.missing.q.val() == 0);
        self.is_short.next = self.heard.val() & !self.received_byte.val().get_bit(7);
        self.last_argument.next = self.received.val() & (self.missing.q.val() == 1);
        self.byte_wide.next = bit_cast::<32, 8>(self.received_byte.val());
        self.arrived.next = (self.arguments.q.val() >> 8) | (self.byte_wide.val() << 24);
        self.missing_less.next = self.missing.q.val() - 1;
        self.resets.next = self.is_short.val() & (self.received_byte.val() == 0);
        self.runs.next = self.is_short.val() & (self.received_byte.val() == 1);
        if self.heard.val() & self.received_byte.val().get_bit(7) {
            self.command.d.next = self.received_byte.val();
            self.missing.d.next = 4.into();
        } else if self.received.val() & !self.heard.val() {
            self.arguments.d.next = self.arrived.val();
            self.missing.d.next = self.missing_less.val();
        }
        if self.last_argument.val() & (self.command.q.val() == 0x80) {
            self.divider.d.next = self.arrived.val().get_bits::<24>(0);
        } else if self.last_argument.val() & (self.command.q.val() == 0x81) {
            self.total.d.next = self.arrived.val().get_bits::<10>(0);
            self.after.d.next = self.arrived.val().get_bits::<10>(16);
        } else if self.last_argument.val() & (self.command.q.val() == 0xc0) {
            self.mask.d.next = self.arrived.val().get_bits::<8>(0);
        } else if self.last_argument.val() & (self.command.q.val() == 0xc1) {
            self.value.d.next = self.arrived.val().get_bits::<8>(0);
        }

        // The clock in which a sample's tick falls: then fewer ticks are left than it has.
        self.fraction_wide.next = bit_cast::<8, 7>(self.fraction.q.val());
        self.rest_wide.next = bit_cast::<8, 7>(self.ticks_rest.val());
        self.megahertz_wide.next = bit_cast::<8, 7>(self.megahertz.val());
        self.fraction_sum.next = self.fraction_wide.val() + self.rest_wide.val();
        self.fraction_over.next = self.fraction_sum.val() - self.megahertz_wide.val();
        self.whole.next = self.fraction_sum.val() >= self.megahertz_wide.val();
        self.ticks_wide.next = bit_cast::<25, 4>(self.ticks.val());
        self.ticks_now.next = self.ticks_wide.val();
        if self.whole.val() {
            self.ticks_now.next = self.ticks_wide.val() + 1;
        }
        self.left_wide.next = bit_cast::<25, 24>(self.ticks_left.q.val());
        self.divider_wide.next = bit_cast::<25, 24>(self.divider.q.val());
        self.left_less.next = self.left_wide.val() - self.ticks_now.val();
        self.left_again.next = self.left_less.val() + self.divider_wide.val() + 1;
        self.running.next = (self.phase.q.val() == 1) | (self.phase.q.val() == 2);
        self.due.next = self.running.val() & self.left_less.val().get_bit(24);
        if self.running.val() {
            if self.whole.val() {
                self.fraction.d.next = self.fraction_over.val().get_bits::<7>(0);
            } else {
                self.fraction.d.next = self.fraction_sum.val().get_bits::<7>(0);
            }
            if !self.left_less.val().get_bit(24) {
                self.ticks_left.d.next = self.left_less.val().get_bits::<24>(0);
            } else if self.left_again.val().get_bit(24) {
                self.ticks_left.d.next = 0.into();
            } else {
                self.ticks_left.d.next = self.left_again.val().get_bits::<24>(0);
            }
        }

        // The capture: so many samples, the trigger, so many more, and back through the memory.
        self.fits.next = ((self.seen.q.val() ^ self.value.q.val()) & self.mask.q.val()) == 0;
        self.ahead.next = self.total.q.val() - self.after.q.val();
        self.ahead_wide.next = bit_cast::<13, 10>(self.ahead.val());
        self.after_wide.next = bit_cast::<13, 10>(self.after.q.val());
        self.total_wide.next = bit_cast::<13, 10>(self.total.q.val());
        self.after_count.next = (self.after_wide.val() << 2) + 4;
        self.total_count.next = (self.total_wide.val() << 2) + 4;
        self.samples_less.next = self.samples_left.q.val() - 1;
        self.last_sample.next = self.samples_left.q.val() == 1;
        self.address_more.next = self.address.q.val() + 1;
        self.address_less.next = self.address.q.val() - 1;
        self.tells.next = self.telling.q.val() & self.ready.val();
        self.gives.next = (self.phase.q.val() == 5) & self.ready.val() & !self.telling.q.val();
        if self.due.val() {
            self.address.d.next = self.address_more.val();
            self.samples_left.d.next = self.samples_less.val();
            if (self.phase.q.val() == 2) & self.last_sample.val() {
                self.phase.d.next = 3.into();
                self.samples_left.d.next = self.total_count.val();
            } else if (self.phase.q.val() == 1) & !self.samples_left.q.val().any() {
                self.samples_left.d.next = 0.into();
                if self.fits.val() {
                    self.phase.d.next = 2.into();
                    self.samples_left.d.next = self.after_count.val();
                }
            }
        } else if self.phase.q.val() == 3 {
            self.address.d.next = self.address_less.val();
            self.phase.d.next = 4.into();
        } else if self.phase.q.val() == 4 {
            self.phase.d.next = 5.into();
        } else if self.gives.val() {
            self.samples_left.d.next = self.samples_less.val();
            self.phase.d.next = 3.into();
            if self.last_sample.val() {
                self.phase.d.next = 0.into();
            }
        }
        if self.runs.val() {
            self.phase.d.next = 1.into();
            self.samples_left.d.next = self.ahead_wide.val() << 2;
            self.ticks_left.d.next = 0.into();
            self.fraction.d.next = 0.into();
        } else if self.resets.val() {
            self.phase.d.next = 0.into();
        }

        // Answers: four bytes of an identity, then those of the metadata.
        self.place_more.next = self.place.q.val() + 1;
        if self.is_short.val() & (self.received_byte.val() == 2) {
            self.telling.d.next = true;
            self.place.d.next = 0.into();
        } else if self.is_short.val() & (self.received_byte.val() == 4) {
            self.telling.d.next = true;
            self.place.d.next = 4.into();
        } else if self.resets.val() {
            self.telling.d.next = false;
        } else if self.tells.val() {
            self.place.d.next = self.place_more.val();
            if (self.place.q.val() == 3) | (self.place.q.val() == 29) {
                self.telling.d.next = false;
            }
        }
        // `1ALS`; 1, `helixlock`, 0; 21, 4096; 23, the rate; 40, 8 signals; 41, protocol 2; 0.
        match self.place.q.val().index() {
            0 => self.answer.next = 0x31.into(),
            1 => self.answer.next = 0x41.into(),
            2 => self.answer.next = 0x4c.into(),
            3 => self.answer.next = 0x53.into(),
            4 => self.answer.next = 0x01.into(),
            5 => self.answer.next = 0x68.into(),
            6 => self.answer.next = 0x65.into(),
            7 => self.answer.next = 0x6c.into(),
            8 => self.answer.next = 0x69.into(),
            9 => self.answer.next = 0x78.into(),
            10 => self.answer.next = 0x6c.into(),
            11 => self.answer.next = 0x6f.into(),
            12 => self.answer.next = 0x63.into(),
            13 => self.answer.next = 0x6b.into(),
            15 => self.answer.next = 0x21.into(),
            18 => self.answer.next = 0x10.into(),
            20 => self.answer.next = 0x23.into(),
            21 => self.answer.next = self.rate.val().get_bits::<8>(24),
            22 => self.answer.next = self.rate.val().get_bits::<8>(16),
            23 => self.answer.next = self.rate.val().get_bits::<8>(8),
            24 => self.answer.next = self.rate.val().get_bits::<8>(0),
            25 => self.answer.next = 0x40.into(),
            26 => self.answer.next = 0x08.into(),
            27 => self.answer.next = 0x41.into(),
            28 => self.answer.next = 0x02.into(),
            _ => self.answer.next = 0.into(),
        }
        if self.clear.val() {
            self.missing.d.next = 0.into();
            self.divider.d.next = 0.into();
            self.total.d.next = 0.into();
            self.after.d.next = 0.into();
            self.mask.d.next = 0.into();
            self.value.d.next = 0.into();
            self.phase.d.next = 0.into();
            self.telling.d.next = false;
        }

        self.memory_address.next = self.address.q.val();
        self.memory_write.next = self.due.val();
        self.memory_sample.next = self.seen.q.val();
        self.send.next = self.tells.val() | self.gives.val();
        self.data.next = self.memory_data.val();
        if self.telling.q.val() {
            self.data.next = self.answer.val();
        }
    }
}
