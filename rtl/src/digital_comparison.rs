//! Digital comparison: counts the clocks between two pulses, and from period to period.
//!
//! Document 4, digital phase comparison: the two pulses open and shut a gate in front of a
//! counter; `δ = 2π·Δt/T`. Software divides; both numbers come out as words.
//!
//! | port           | dir | meaning                                                       |
//! |----------------|-----|---------------------------------------------------------------|
//! | `clock`        | in  | FPGA clock, rising edge                                       |
//! | `clear`        | in  | gate shut, no period begun                                    |
//! | `opening`      | in  | high for one clock: the gate opens, a period begins           |
//! | `shutting`     | in  | high for one clock: the gate shuts                            |
//! | `delay`        | out | clocks from opening to shutting, Δt                           |
//! | `delay_ready`  | out | high for one clock, the clock after: `delay` is new           |
//! | `period`       | out | clocks from opening to opening, T                             |
//! | `period_ready` | out | high for one clock, the clock after: `period` is new          |
//!
//! # Waveform
//!
//! ```text
//! opening      ▁▔▁▁▁▁▁▁▔▁▁▁
//! shutting     ▁▁▁▁▔▁▁▁▁▁▁▁
//! delay_ready  ▁▁▁▁▁▔▁▁▁▁▁▁
//! delay        000003333333
//! period_ready ▁▁▁▁▁▁▁▁▁▔▁▁
//! period       000000000777
//! ```
//!
//! # At the same time
//!
//! Opening and shutting together: Δt = 0. A second shutting in a period, or one before the first
//! opening, changes nothing.
//!
//! # Inferred
//!
//! 32 bits: six minutes at 12 MHz; the count stops there instead of starting over.

use rust_hdl::prelude::*;

/// One counter and two latches; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct DigitalComparison {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Gate shut, no period begun.
    pub clear: Signal<In, Bit>,
    /// The gate opens.
    pub opening: Signal<In, Bit>,
    /// The gate shuts.
    pub shutting: Signal<In, Bit>,
    /// Clocks from opening to shutting.
    pub delay: Signal<Out, Bits<32>>,
    /// `delay` is new.
    pub delay_ready: Signal<Out, Bit>,
    /// Clocks from opening to opening.
    pub period: Signal<Out, Bits<32>>,
    /// `period` is new.
    pub period_ready: Signal<Out, Bit>,
    since: DFF<Bits<32>>,
    begun: DFF<Bit>,
    gate: DFF<Bit>,
    delay_latch: DFF<Bits<32>>,
    period_latch: DFF<Bits<32>>,
    delay_new: DFF<Bit>,
    period_new: DFF<Bit>,
    one_more: Signal<Local, Bits<32>>,
    full: Signal<Local, Bit>,
}

impl Logic for DigitalComparison {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            since,
            begun,
            gate,
            delay_latch,
            period_latch,
            delay_new,
            period_new
        );
        self.one_more.next = self.since.q.val() + 1;
        self.full.next = self.since.q.val().all();

        if self.opening.val() {
            self.since.d.next = 1.into();
        } else if !self.full.val() {
            self.since.d.next = self.one_more.val();
        }

        if self.clear.val() {
            self.begun.d.next = false;
            self.gate.d.next = false;
        } else if self.opening.val() {
            self.begun.d.next = true;
            self.gate.d.next = !self.shutting.val();
        } else if self.shutting.val() {
            self.gate.d.next = false;
        }

        if self.opening.val() & self.shutting.val() {
            self.delay_latch.d.next = 0.into();
        } else if self.gate.q.val() & self.shutting.val() {
            self.delay_latch.d.next = self.since.q.val();
        }
        self.delay_new.d.next =
            self.shutting.val() & (self.opening.val() | self.gate.q.val()) & !self.clear.val();

        if self.begun.q.val() & self.opening.val() {
            self.period_latch.d.next = self.since.q.val();
        }
        self.period_new.d.next = self.begun.q.val() & self.opening.val() & !self.clear.val();

        self.delay.next = self.delay_latch.q.val();
        self.delay_ready.next = self.delay_new.q.val();
        self.period.next = self.period_latch.q.val();
        self.period_ready.next = self.period_new.q.val();
    }
}
