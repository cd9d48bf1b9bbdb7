//! Supervisor: stops the correction when its signals cannot be right, and everything when asked to.
//!
//! No figure: in 1977 a person stood beside the machine.
//!
//! | port             | dir | meaning                                                          |
//! |------------------|-----|------------------------------------------------------------------|
//! | `clock`          | in  | FPGA clock, rising edge                                          |
//! | `clear`          | in  | forgets what was wrong: no pass runs                             |
//! | `tick`           | in  | high for one clock: the watchdogs count on                       |
//! | `limit`          | in  | ticks without a line or a fringe that are too many; 0 is off     |
//! | `wrap_watched`   | in  | a wrapped meter is wrong                                         |
//! | `measuring`      | in  | the initial phase is selected                                    |
//! | `line`           | in  | high for one clock: a grating line                               |
//! | `fringe`         | in  | high for one clock: a fringe                                     |
//! | `opening`        | in  | high for one clock: the meter is set                             |
//! | `shutting`       | in  | high for one clock: the meter is cleared                         |
//! | `enable`         | in  | steps are allowed                                                |
//! | `stop`           | in  | emergency stop                                                   |
//! | `may_correct`    | out | the loop may step                                                |
//! | `may_step`       | out | panel and playback may step                                      |
//! | `stopped`        | out | windings off: the emergency stop, until `clear`                  |
//! | `lines_missing`  | out | no line came in time                                             |
//! | `fringes_missing` | out | no fringe came in time                                          |
//! | `wrapped`        | out | set twice without clear between, or cleared twice without set    |
//! | `alarm`          | out | one of these three, or stopped                                   |
//!
//! # Waveform
//!
//! `tick` = 1, `limit` = 003, `enable` = 1: fringes come, the lines have stopped.
//!
//! ```text
//! measuring     ▔▔▔▔▔▔▔▔▔▔▔▔▁▁
//! line          ▁▔▁▁▁▁▁▁▁▁▁▁▁▁
//! fringe        ▁▔▁▔▁▔▁▔▁▔▁▔▁▁
//! clear         ▁▁▁▁▁▁▁▁▁▁▁▁▔▁
//! lines_missing ▁▁▁▁▁▔▔▔▔▔▔▔▔▁
//! may_correct   ▔▔▔▔▔▁▁▁▁▁▁▁▁▔
//! ```
//!
//! # At the same time
//!
//! `stop` wins over `clear`. Set and clear of the meter in one clock: the meter keeps, and which of
//! them came last is open until the next one. A line in the clock of the last tick is in time.
//!
//! # Inferred
//!
//! All of it. Missing signals stop the loop alone: the playback has to bring the table home.

use rust_hdl::prelude::*;

/// Two watchdogs, the order of two pulses, and a latch; see the [module](self) for ports.
#[derive(Debug, Default, LogicBlock)]
pub struct Supervisor {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Forgets what was wrong.
    pub clear: Signal<In, Bit>,
    /// The watchdogs count on.
    pub tick: Signal<In, Bit>,
    /// Ticks that are too many; 0 is off.
    pub limit: Signal<In, Bits<12>>,
    /// A wrapped meter is wrong.
    pub wrap_watched: Signal<In, Bit>,
    /// The initial phase is selected.
    pub measuring: Signal<In, Bit>,
    /// A grating line.
    pub line: Signal<In, Bit>,
    /// A fringe.
    pub fringe: Signal<In, Bit>,
    /// The meter is set.
    pub opening: Signal<In, Bit>,
    /// The meter is cleared.
    pub shutting: Signal<In, Bit>,
    /// Steps are allowed.
    pub enable: Signal<In, Bit>,
    /// Emergency stop.
    pub stop: Signal<In, Bit>,
    /// The loop may step.
    pub may_correct: Signal<Out, Bit>,
    /// Panel and playback may step.
    pub may_step: Signal<Out, Bit>,
    /// Windings off.
    pub stopped: Signal<Out, Bit>,
    /// No line came in time.
    pub lines_missing: Signal<Out, Bit>,
    /// No fringe came in time.
    pub fringes_missing: Signal<Out, Bit>,
    /// Two of one kind without the other between.
    pub wrapped: Signal<Out, Bit>,
    /// Something is wrong.
    pub alarm: Signal<Out, Bit>,
    since_line: DFF<Bits<12>>,
    since_fringe: DFF<Bits<12>>,
    no_line: DFF<Bit>,
    no_fringe: DFF<Bit>,
    open: DFF<Bit>,
    order_known: DFF<Bit>,
    wrap: DFF<Bit>,
    halt: DFF<Bit>,
    line_more: Signal<Local, Bits<12>>,
    fringe_more: Signal<Local, Bits<12>>,
    watched: Signal<Local, Bit>,
    again: Signal<Local, Bit>,
    wrong: Signal<Local, Bit>,
}

#[expect(clippy::too_many_lines, reason = "two watchdogs, an order and a latch, few lines each")]
impl Logic for Supervisor {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            since_line,
            since_fringe,
            no_line,
            no_fringe,
            open,
            order_known,
            wrap,
            halt
        );
        self.line_more.next = self.since_line.q.val() + 1;
        self.fringe_more.next = self.since_fringe.q.val() + 1;
        self.watched.next = self.measuring.val() & self.limit.val().any();

        // Watchdogs.
        if self.line.val() | !self.watched.val() {
            self.since_line.d.next = 0.into();
        } else if self.tick.val() & !self.no_line.q.val() {
            self.since_line.d.next = self.line_more.val();
        }
        if self.fringe.val() | !self.watched.val() {
            self.since_fringe.d.next = 0.into();
        } else if self.tick.val() & !self.no_fringe.q.val() {
            self.since_fringe.d.next = self.fringe_more.val();
        }
        if self.clear.val() {
            self.no_line.d.next = false;
            self.no_fringe.d.next = false;
        } else if self.watched.val() & self.tick.val() {
            if !self.line.val() & (self.line_more.val() >= self.limit.val()) {
                self.no_line.d.next = true;
            }
            if !self.fringe.val() & (self.fringe_more.val() >= self.limit.val()) {
                self.no_fringe.d.next = true;
            }
        }

        // Whose turn it is.
        self.again.next = self.order_known.q.val()
            & ((self.opening.val() & !self.shutting.val() & self.open.q.val())
                | (self.shutting.val() & !self.opening.val() & !self.open.q.val()));
        if !self.measuring.val() | (self.opening.val() & self.shutting.val()) {
            self.order_known.d.next = false;
        } else if self.opening.val() | self.shutting.val() {
            self.order_known.d.next = true;
            self.open.d.next = self.opening.val();
        }
        if self.clear.val() {
            self.wrap.d.next = false;
        } else if self.again.val() & self.measuring.val() & self.wrap_watched.val() {
            self.wrap.d.next = true;
        }

        if self.stop.val() {
            self.halt.d.next = true;
        } else if self.clear.val() {
            self.halt.d.next = false;
        }

        self.wrong.next = self.no_line.q.val() | self.no_fringe.q.val() | self.wrap.q.val();
        self.may_step.next = self.enable.val() & !self.halt.q.val() & !self.stop.val();
        self.may_correct.next =
            self.enable.val() & !self.halt.q.val() & !self.stop.val() & !self.wrong.val();
        self.stopped.next = self.halt.q.val() | self.stop.val();
        self.lines_missing.next = self.no_line.q.val();
        self.fringes_missing.next = self.no_fringe.q.val();
        self.wrapped.next = self.wrap.q.val();
        self.alarm.next = self.wrong.val() | self.halt.q.val() | self.stop.val();
    }
}
