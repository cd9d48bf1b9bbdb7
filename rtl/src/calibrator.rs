//! Calibrator: puts a known phase on the outputs instead of the measured one.
//!
//! Figures 11 and 12 of document 1. The operator records the heights of 180° and of 135° and
//! so learns what 45° are on the chart: `φ = 180° + (U_T1 − U_T2)/2V · 360°`.
//!
//! | port        | dir | meaning                                                    |
//! |-------------|-----|------------------------------------------------------------|
//! | `clock`     | in  | FPGA clock, rising edge                                    |
//! | `clear`     | in  | start state                                                |
//! | `line`      | in  | high for one clock per grating line, gated or not          |
//! | `meter`     | in  | the measured pulse                                         |
//! | `calibrate` | in  | 0 measured, 1 180°, 2 90° below it, 3 45° below it         |
//! | `t1`        | out | meter output                                               |
//! | `t2`        | out | its complement                                             |
//!
//! # Sequence
//!
//! Eight lines make a calibration period; the level of T1 in each eighth:
//!
//! | calibrate | step | phase of T1 | 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 |
//! |-----------|------|-------------|---|---|---|---|---|---|---|---|
//! | 1         | 180° | 180°        | 1 | 1 | 1 | 1 | 0 | 0 | 0 | 0 |
//! | 2         | 90°  | 90°         | 1 | 1 | 0 | 0 | 0 | 0 | 0 | 0 |
//! | 3         | 45°  | 135°        | 1 | 1 | 1 | 0 | 0 | 0 | 0 | 0 |
//!
//! # Waveform
//!
//! `calibrate` = 3, from the clamp on:
//!
//! ```text
//! line     ▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔▁▔
//! t1       ▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▔▔▔▔▔▔▁▁▁▁▁▁
//! t2       ▁▁▁▁▁▁▔▔▔▔▔▔▔▔▔▔▁▁▁▁▁▁▔▔▔▔▔▔
//! ```
//!
//! # At the same time
//!
//! The loop does not see the calibration: the discriminator is fed by the meter itself, so
//! calibrating while correcting is harmless. A change of `calibrate` in mid-period changes the
//! level at once; the eighth goes on.
//!
//! # Inferred
//!
//! The print's trigger E toggles, so it needs a clamp pulse from D to start low; else it stands
//! at 225° instead of 135°. Here the clamp holds the eighth at 0 until a calibration is asked
//! for, and the level is read off the eighth: 225° has no state to exist in. Undivided lines
//! are used because the eighth of a comparison frequency would pass the filter.

use rust_hdl::prelude::*;

/// A three-bit counter and a choice; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct Calibrator {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Start state.
    pub clear: Signal<In, Bit>,
    /// High for one clock per grating line.
    pub line: Signal<In, Bit>,
    /// The measured pulse.
    pub meter: Signal<In, Bit>,
    /// 0 measured, 1 180°, 2 90°, 3 45°.
    pub calibrate: Signal<In, Bits<2>>,
    /// Meter output.
    pub t1: Signal<Out, Bit>,
    /// Its complement.
    pub t2: Signal<Out, Bit>,
    eighth: DFF<Bits<3>>,
    next_eighth: Signal<Local, Bits<3>>,
    clamp: Signal<Local, Bit>,
    shown: Signal<Local, Bit>,
}

impl Logic for Calibrator {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, eighth);
        self.clamp.next = self.clear.val() | (self.calibrate.val() == 0);
        self.next_eighth.next = self.eighth.q.val() + 1;
        if self.clamp.val() {
            self.eighth.d.next = 0.into();
        } else if self.line.val() {
            self.eighth.d.next = self.next_eighth.val();
        }

        if self.calibrate.val() == 1 {
            self.shown.next = self.eighth.q.val() < 4;
        } else if self.calibrate.val() == 2 {
            self.shown.next = self.eighth.q.val() < 2;
        } else if self.calibrate.val() == 3 {
            self.shown.next = self.eighth.q.val() < 3;
        } else {
            self.shown.next = self.meter.val();
        }

        self.t1.next = self.shown.val();
        self.t2.next = !self.shown.val();
    }
}
