//! Initial-phase selector: lets the grating through once m laser pulses have passed.
//!
//! Figure 8 of document 1. The laser channel is dividing already while its first m pulses are
//! counted here; then a flip-flop, cleared beforehand, opens the grating's gate. So the two
//! channels start m laser pulses apart, `φ0 = m/B · 360°`, at ×2 `m/2B · 360°`.
//!
//! | port      | dir | meaning                                                        |
//! |-----------|-----|----------------------------------------------------------------|
//! | `clock`   | in  | FPGA clock, rising edge                                        |
//! | `clear`   | in  | back to zero, gate shut                                        |
//! | `laser`   | in  | high for one clock per compensated laser pulse                 |
//! | `grating` | in  | high for one clock per grating line                            |
//! | `preset`  | in  | m, three BCD digits                                            |
//! | `open`    | out | the gate is open: the phase is selected, measuring begins      |
//! | `line`    | out | grating lines that pass the gate                               |
//!
//! # Waveform
//!
//! m = 2, so `preset` = 002:
//!
//! ```text
//! clear    ▔▔▁▁▁▁▁▁▁▁▁▁▁▁
//! laser    ▁▁▁▔▁▁▁▔▁▁▁▔▁▁
//! grating  ▁▁▁▁▔▁▁▁▔▁▁▁▔▁
//! open     ▁▁▁▁▁▁▁▁▁▔▔▔▔▔
//! line     ▁▁▁▁▁▁▁▁▁▁▁▁▔▁
//! ```
//!
//! # At the same time
//!
//! A line in the clock of the m-th pulse or the next one finds the gate still shut. A laser
//! pulse right behind the m-th is not counted: the count stays m. m = 0 opens the gate one
//! clock after `clear` ends.
//!
//! # Inferred
//!
//! The laser leads, so the meter's T2 starts at φ0 and T1 at 360° − φ0; at 180° both are the
//! same. To within a line: the first to pass is counted as a whole one, however short the wait
//! for it, and makes T1 that much wider.
//! The pulses counted are the compensated ones, those divider B gets, so that a correction
//! during the selection does not change the phase.

use rust_hdl::prelude::*;

use crate::decade_counter::DecadeCounter;

/// Three decades and a gate; see the [module](self) for ports and waveform.
#[derive(Debug, Default, LogicBlock)]
pub struct InitialPhaseSelector {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Back to zero, gate shut.
    pub clear: Signal<In, Bit>,
    /// High for one clock per laser pulse.
    pub laser: Signal<In, Bit>,
    /// High for one clock per grating line.
    pub grating: Signal<In, Bit>,
    /// m in BCD.
    pub preset: Signal<In, Bits<12>>,
    /// The gate is open.
    pub open: Signal<Out, Bit>,
    /// Lines that pass the gate.
    pub line: Signal<Out, Bit>,
    units: DecadeCounter,
    tens: DecadeCounter,
    hundreds: DecadeCounter,
    gate: DFF<Bit>,
    coincidence: Signal<Local, Bit>,
}

impl Logic for InitialPhaseSelector {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, gate);
        self.units.clock.next = self.clock.val();
        self.tens.clock.next = self.clock.val();
        self.hundreds.clock.next = self.clock.val();

        self.coincidence.next = (self.units.digit.val() == self.preset.val().get_bits::<4>(0))
            & (self.tens.digit.val() == self.preset.val().get_bits::<4>(4))
            & (self.hundreds.digit.val() == self.preset.val().get_bits::<4>(8));

        self.units.clear.next = self.clear.val();
        self.tens.clear.next = self.clear.val();
        self.hundreds.clear.next = self.clear.val();
        self.units.count.next =
            self.laser.val() & !self.clear.val() & !self.coincidence.val() & !self.gate.q.val();
        self.tens.count.next = self.units.carry.val();
        self.hundreds.count.next = self.tens.carry.val();

        if self.clear.val() {
            self.gate.d.next = false;
        } else if self.coincidence.val() {
            self.gate.d.next = true;
        }

        self.open.next = self.gate.q.val();
        self.line.next = self.grating.val() & self.gate.q.val();
    }
}
