//! Input conditioner: lets a level through once it has stood still for some ticks.
//!
//! No figure: the print has clean signals and switches that do not bounce. Ticks of every clock make
//! a filter against glitches of it, ticks of a millisecond take the bouncing from a switch.
//!
//! | port         | dir | meaning                                                        |
//! |--------------|-----|----------------------------------------------------------------|
//! | `clock`      | in  | FPGA clock, rising edge                                        |
//! | `pin`        | in  | line, fringe or switch, at any time                            |
//! | `active_low` | in  | low on the pin means on                                        |
//! | `tick`       | in  | high for one clock: the time counts on                         |
//! | `ticks`      | in  | ticks that a new level has to stand; 0 is off                  |
//! | `level`      | out | the level that stood; off: the pin itself, not synchronised    |
//! | `steady`     | out | the same, but synchronised in either case                      |
//!
//! # Waveform
//!
//! `tick` = 1, `ticks` = 3: a notch and a spike of two clocks are nothing, a level of three is one.
//!
//! ```text
//! pin   ▁▁▔▔▁▁▁▁▔▔▔▔▔▔▁▁▔▔▔▔▁▁▁▁▁▁▁▁▁
//! level ▁▁▁▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▔▔▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! A level that goes back in the clock of the last tick comes too late to count: it was seen two
//! clocks ago. Press and release are treated alike. Both channels get the same filter, so its delay
//! leaves the phase alone.
//!
//! # Inferred
//!
//! All of it. `ticks` is to stay while signals change.

use rust_hdl::prelude::*;

use crate::level_synchroniser::LevelSynchroniser;

/// A synchroniser, a counter of ticks and the level; see the [module](self) for ports.
#[derive(Debug, Default, LogicBlock)]
pub struct InputConditioner {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// The asynchronous input.
    pub pin: Signal<In, Bit>,
    /// Low means on.
    pub active_low: Signal<In, Bit>,
    /// The time counts on.
    pub tick: Signal<In, Bit>,
    /// Ticks to stand; 0 is off.
    pub ticks: Signal<In, Bits<4>>,
    /// The level that stood, or the pin itself.
    pub level: Signal<Out, Bit>,
    /// The same, synchronised.
    pub steady: Signal<Out, Bit>,
    synchroniser: LevelSynchroniser,
    settled: DFF<Bit>,
    stood: DFF<Bits<4>>,
    active: Signal<Local, Bit>,
    differs: Signal<Local, Bit>,
    one_more: Signal<Local, Bits<4>>,
    long_enough: Signal<Local, Bit>,
}

impl Logic for InputConditioner {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, settled, stood);
        self.active.next = self.pin.val() ^ self.active_low.val();
        self.synchroniser.clock.next = self.clock.val();
        self.synchroniser.pin.next = self.active.val();
        self.differs.next = self.synchroniser.level.val() ^ self.settled.q.val();
        self.one_more.next = self.stood.q.val() + 1;
        self.long_enough.next = self.one_more.val() >= self.ticks.val();

        if !self.differs.val() {
            self.stood.d.next = 0.into();
        } else if self.tick.val() & self.long_enough.val() {
            self.stood.d.next = 0.into();
            self.settled.d.next = self.synchroniser.level.val();
        } else if self.tick.val() {
            self.stood.d.next = self.one_more.val();
        }

        if self.ticks.val() == 0 {
            self.level.next = self.active.val();
            self.steady.next = self.synchroniser.level.val();
        } else {
            self.level.next = self.settled.q.val();
            self.steady.next = self.settled.q.val();
        }
    }
}
