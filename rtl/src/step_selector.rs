//! Step selector: at each tick of the step clock, decides whether to ask for a step and which
//! way.
//!
//! Figure 14 of document 1: the oscillator reaches the ring while correcting; a manual pulse
//! input is there to check the ring, "not used normally"; figure 17 adds the playback.
//!
//! | port                | dir | meaning                                                   |
//! |---------------------|-----|-----------------------------------------------------------|
//! | `clock`             | in  | FPGA clock, rising edge                                   |
//! | `clear`             | in  | forgets a manual step that waits                          |
//! | `tick`              | in  | the step clock                                            |
//! | `correcting`        | in  | the loop has decided and may step                         |
//! | `automatic_forward` | in  | the discriminator's Q                                     |
//! | `manual_enable`     | in  | the panel may step: not in the correct position           |
//! | `manual_step`       | in  | high for one clock per press                              |
//! | `manual_forward`    | in  | direction switch of the panel                             |
//! | `playback`          | in  | steps are being played back                               |
//! | `request`           | out | high for one clock: a step is asked for                   |
//! | `forward`           | out | its direction, if it is not played back                   |
//!
//! # Sequence
//!
//! By priority, at each tick:
//!
//! | playback | correcting | manual step waits | request | forward             |
//! |----------|------------|-------------------|---------|---------------------|
//! | 1        | any        | any               | 1       | left to the counter |
//! | 0        | 1          | any               | 1       | `automatic_forward` |
//! | 0        | 0          | 1                 | 1       | `manual_forward`    |
//! | 0        | 0          | 0                 | 0       | `automatic_forward` |
//!
//! # Waveform
//!
//! A press between two ticks, `manual_enable` = 1:
//!
//! ```text
//! tick         ▁▔▁▁▁▔▁▁▁▔▁
//! manual_step  ▁▁▁▔▁▁▁▁▁▁▁
//! request      ▁▁▁▁▁▔▁▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! A press in the clock of a tick waits for the next tick. Presses between two ticks are one
//! step. A press while correcting or playing back is ignored, and one that waits is dropped
//! when either begins.
//!
//! # Inferred
//!
//! Manual steps go by the step clock like all others: no two steps are ever closer than its
//! period, whatever the panel does. A button that bounces for longer than that, or bounces when it
//! is released, makes a step more: the board shell puts an
//! [input conditioner](crate::input_conditioner) before it.

use rust_hdl::prelude::*;

/// Priorities and one flip-flop; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct StepSelector {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Forgets a waiting manual step.
    pub clear: Signal<In, Bit>,
    /// The step clock.
    pub tick: Signal<In, Bit>,
    /// The loop may step.
    pub correcting: Signal<In, Bit>,
    /// Direction the loop asks for.
    pub automatic_forward: Signal<In, Bit>,
    /// The panel may step.
    pub manual_enable: Signal<In, Bit>,
    /// High for one clock per press.
    pub manual_step: Signal<In, Bit>,
    /// Direction the panel asks for.
    pub manual_forward: Signal<In, Bit>,
    /// Steps are being played back.
    pub playback: Signal<In, Bit>,
    /// A step is asked for.
    pub request: Signal<Out, Bit>,
    /// Its direction.
    pub forward: Signal<Out, Bit>,
    waiting: DFF<Bit>,
    manual: Signal<Local, Bit>,
}

impl Logic for StepSelector {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, waiting);
        self.manual.next = self.waiting.q.val() & self.manual_enable.val() & !self.playback.val();

        if self.clear.val() | self.playback.val() | !self.manual_enable.val() {
            self.waiting.d.next = false;
        } else if self.manual_step.val() {
            self.waiting.d.next = true;
        } else if self.tick.val() {
            self.waiting.d.next = false;
        }

        self.request.next =
            self.tick.val() & (self.playback.val() | self.correcting.val() | self.manual.val());
        if self.manual.val() & !self.correcting.val() {
            self.forward.next = self.manual_forward.val();
        } else {
            self.forward.next = self.automatic_forward.val();
        }
    }
}
