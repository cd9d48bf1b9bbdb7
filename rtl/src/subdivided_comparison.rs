//! Subdivided comparison: where between two input pulses an output pulse falls, as a fraction.
//!
//! Document 4, subdivided phase comparison and counting: at every output pulse, the clocks since
//! the last input pulse over the clocks of the last input period, `N_t/N`, and how many input
//! pulses came since the last output pulse, `N0`. Any ratio, no 360° limit.
//!
//! | port       | dir | meaning                                                            |
//! |------------|-----|--------------------------------------------------------------------|
//! | `clock`    | in  | FPGA clock, rising edge                                            |
//! | `clear`    | in  | no period known, no division running                               |
//! | `fast`     | in  | high for one clock per input pulse                                 |
//! | `slow`     | in  | high for one clock per output pulse                                |
//! | `fraction` | out | `2¹⁶·N_t/N`, rounded down, 65 535 if that is 1 or more             |
//! | `pulses`   | out | N0: input pulses since the last output pulse, modulo 2¹⁶           |
//! | `ready`    | out | high for one clock: `fraction` and `pulses` are new                |
//!
//! # Sequence
//!
//! | clocks after `slow` | 1 … 16                    | 17             |
//! |---------------------|---------------------------|----------------|
//! | division            | one bit of the quotient   | `ready`        |
//!
//! # Waveform
//!
//! Input pulses every 4 clocks; the output pulse falls 1 clock behind one: a quarter, 0x4000.
//!
//! ```text
//! fast     ▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁▔▁▁▁
//! slow     ▁▁▁▁▁▁▁▁▁▁▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
//! ready    ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▔▁
//! ```
//!
//! # At the same time
//!
//! Both pulses: the input's comes first, so `N_t` is 0 and N the period that just ended; it counts
//! towards N0 of that output pulse. An output pulse while a division runs, or before a whole
//! input period is known, gives no word; its input pulses are counted to the next.
//!
//! # Inferred
//!
//! The paper's microcomputer divides; here it is a shift-and-subtract divider of 16 bits, so
//! output pulses must be 17 clocks apart. The counts stop at 2³², six minutes at 12 MHz.

use rust_hdl::prelude::*;

/// Two counters and a divider; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct SubdividedComparison {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// No period known, no division running.
    pub clear: Signal<In, Bit>,
    /// Input pulses.
    pub fast: Signal<In, Bit>,
    /// Output pulses.
    pub slow: Signal<In, Bit>,
    /// `2¹⁶·N_t/N`.
    pub fraction: Signal<Out, Bits<16>>,
    /// N0.
    pub pulses: Signal<Out, Bits<16>>,
    /// The words are new.
    pub ready: Signal<Out, Bit>,
    since: DFF<Bits<33>>,
    last_period: DFF<Bits<33>>,
    seen: DFF<Bit>,
    known: DFF<Bit>,
    counted: DFF<Bits<16>>,
    pulses_latch: DFF<Bits<16>>,
    remainder: DFF<Bits<33>>,
    divisor: DFF<Bits<33>>,
    quotient: DFF<Bits<16>>,
    left: DFF<Bits<5>>,
    done: DFF<Bit>,
    one_more: Signal<Local, Bits<33>>,
    full: Signal<Local, Bit>,
    since_now: Signal<Local, Bits<33>>,
    period_now: Signal<Local, Bits<33>>,
    known_now: Signal<Local, Bit>,
    counted_more: Signal<Local, Bits<16>>,
    counted_now: Signal<Local, Bits<16>>,
    busy: Signal<Local, Bit>,
    take: Signal<Local, Bit>,
    beyond: Signal<Local, Bit>,
    doubled: Signal<Local, Bits<33>>,
    fits: Signal<Local, Bit>,
    reduced: Signal<Local, Bits<33>>,
    shifted: Signal<Local, Bits<16>>,
    shifted_one: Signal<Local, Bits<16>>,
    left_less: Signal<Local, Bits<5>>,
}

#[expect(clippy::too_many_lines, reason = "two counters and a divider, each of a few lines")]
impl Logic for SubdividedComparison {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            since,
            last_period,
            seen,
            known,
            counted,
            pulses_latch,
            remainder,
            divisor,
            quotient,
            left,
            done
        );

        // Clocks since the last input pulse, and of the last period, as of this clock.
        self.one_more.next = self.since.q.val() + 1;
        self.full.next = self.since.q.val().get_bit(32);
        if self.fast.val() {
            self.since_now.next = 0.into();
            self.period_now.next = self.since.q.val();
            self.known_now.next = self.seen.q.val();
            self.since.d.next = 1.into();
            self.last_period.d.next = self.since.q.val();
            self.known.d.next = self.seen.q.val();
            self.seen.d.next = true;
        } else {
            self.since_now.next = self.since.q.val();
            self.period_now.next = self.last_period.q.val();
            self.known_now.next = self.known.q.val();
            if !self.full.val() {
                self.since.d.next = self.one_more.val();
            }
        }
        if self.clear.val() {
            self.seen.d.next = false;
            self.known.d.next = false;
        }

        // Input pulses since the last output pulse that gave a word.
        self.counted_more.next = self.counted.q.val() + 1;
        if self.fast.val() {
            self.counted_now.next = self.counted_more.val();
        } else {
            self.counted_now.next = self.counted.q.val();
        }
        self.busy.next = self.left.q.val().any();
        self.take.next =
            self.slow.val() & self.known_now.val() & !self.busy.val() & !self.clear.val();
        if self.take.val() | self.clear.val() {
            self.counted.d.next = 0.into();
        } else {
            self.counted.d.next = self.counted_now.val();
        }

        // Shift and subtract; the remainder stays below the divisor, so doubled it fits.
        self.doubled.next = self.remainder.q.val() << 1;
        self.reduced.next = self.doubled.val() - self.divisor.q.val();
        self.shifted.next = self.quotient.q.val() << 1;
        self.shifted_one.next = self.shifted.val() + 1;
        self.left_less.next = self.left.q.val() - 1;
        self.beyond.next = self.since_now.val() >= self.period_now.val();
        self.fits.next = self.doubled.val() >= self.divisor.q.val();
        if self.take.val() {
            self.quotient.d.next = 0.into();
            self.pulses_latch.d.next = self.counted_now.val();
            self.remainder.d.next = self.since_now.val();
            self.divisor.d.next = self.period_now.val();
        } else if self.busy.val() & self.fits.val() {
            self.remainder.d.next = self.reduced.val();
            self.quotient.d.next = self.shifted_one.val();
        } else if self.busy.val() {
            self.remainder.d.next = self.doubled.val();
            self.quotient.d.next = self.shifted.val();
        }
        if self.take.val() & self.beyond.val() {
            // Nothing fits into nothing, every time: all bits of the quotient become one.
            self.remainder.d.next = 0.into();
            self.divisor.d.next = 0.into();
        }

        if self.clear.val() {
            self.left.d.next = 0.into();
        } else if self.take.val() {
            self.left.d.next = 16.into();
        } else if self.busy.val() {
            self.left.d.next = self.left_less.val();
        }
        self.done.d.next = (self.left.q.val() == 1) & !self.clear.val();

        self.fraction.next = self.quotient.q.val();
        self.pulses.next = self.pulses_latch.q.val();
        self.ready.next = self.done.q.val();
    }
}
