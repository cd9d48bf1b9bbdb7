//! Reset counter: counts the net steps, and plays them back to zero.
//!
//! Figure 17 of document 1: a 12-bit binary up/down counter of the pulses that went to the
//! motor. On "reset" the direction is reversed and the count is let out until zero, which
//! blocks the step pulses. The sign is the direction of the first step after the last zero, not
//! of the last step: +8 then −6 leaves 2 to go in reverse.
//!
//! | port            | dir | meaning                                                     |
//! |-----------------|-----|-------------------------------------------------------------|
//! | `clock`         | in  | FPGA clock, rising edge                                     |
//! | `clear`         | in  | here is zero; no fault                                      |
//! | `request`       | in  | high for one clock: a step is asked for                     |
//! | `forward`       | in  | its direction, unless played back                           |
//! | `playback`      | in  | go back to zero and stay there                              |
//! | `step`          | out | the step is taken: ring and counter both move               |
//! | `drive_forward` | out | its direction                                               |
//! | `count`         | out | steps away from zero, 0 to 4095                             |
//! | `count_forward` | out | on which side of zero; at zero, where it last was           |
//! | `zero`          | out | the count is zero (line 158 of the figure)                  |
//! | `fault`         | out | a step was refused at 4095; until zero is reached again     |
//!
//! # Sequence
//!
//! What a request does; "away" is from zero, "back" towards it:
//!
//! | count     | playback | direction | step | next count | next side     |
//! |-----------|----------|-----------|------|------------|---------------|
//! | 0         | 0        | any       | 1    | 1          | the direction |
//! | 0         | 1        | –         | 0    | 0          | same          |
//! | 1 … 4094  | 0        | away      | 1    | + 1        | same          |
//! | 1 … 4095  | 0        | back      | 1    | − 1        | same          |
//! | 4095      | 0        | away      | 0    | 4095       | same, `fault` |
//! | 1 … 4095  | 1        | back      | 1    | − 1        | same          |
//!
//! # Waveform
//!
//! Two steps forward, one back, then the playback:
//!
//! ```text
//! request       ▁▔▁▔▁▔▁▔▁▔▁▔▁
//! forward       ▔▔▔▔▁▁▁▁▁▁▁▁▁
//! playback      ▁▁▁▁▁▁▁▔▔▔▔▔▔
//! step          ▁▔▁▔▁▔▁▔▁▁▁▁▁
//! drive_forward ▔▔▔▔▁▁▁▁▁▁▁▁▁
//! zero          ▔▔▁▁▁▁▁▁▔▔▔▔▔
//! ```
//!
//! # At the same time
//!
//! Up and down cannot come together: one request has one direction. `clear` wins over a step,
//! which then neither moves the motor nor is counted. `playback` and a request of the loop: the
//! step is the playback's.
//!
//! # Inferred
//!
//! Beyond 4095 the original wraps and loses the zero. Here the step is refused to the ring as
//! well, so the count stays the true position, and `fault` tells; correction in the other
//! direction goes on. In the print the zero line drives J and K of the first stage; here
//! it decides the direction of counting and the side.

use rust_hdl::prelude::*;

/// Magnitude, side and fault; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct ResetCounter {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Here is zero.
    pub clear: Signal<In, Bit>,
    /// A step is asked for.
    pub request: Signal<In, Bit>,
    /// Its direction, unless played back.
    pub forward: Signal<In, Bit>,
    /// Back to zero.
    pub playback: Signal<In, Bit>,
    /// The step is taken.
    pub step: Signal<Out, Bit>,
    /// Its direction.
    pub drive_forward: Signal<Out, Bit>,
    /// Steps away from zero.
    pub count: Signal<Out, Bits<12>>,
    /// The side of zero.
    pub count_forward: Signal<Out, Bit>,
    /// The count is zero.
    pub zero: Signal<Out, Bit>,
    /// A step was refused.
    pub fault: Signal<Out, Bit>,
    magnitude: DFF<Bits<12>>,
    side: DFF<Bit>,
    refused: DFF<Bit>,
    one_more: Signal<Local, Bits<12>>,
    one_less: Signal<Local, Bits<12>>,
    at_zero: Signal<Local, Bit>,
    at_limit: Signal<Local, Bit>,
    direction: Signal<Local, Bit>,
    away: Signal<Local, Bit>,
    refusing: Signal<Local, Bit>,
    taken: Signal<Local, Bit>,
}

impl Logic for ResetCounter {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, magnitude, side, refused);
        self.one_more.next = self.magnitude.q.val() + 1;
        self.one_less.next = self.magnitude.q.val() - 1;
        self.at_zero.next = self.magnitude.q.val() == 0;
        self.at_limit.next = self.magnitude.q.val().all();
        if self.playback.val() {
            self.direction.next = !self.side.q.val();
        } else {
            self.direction.next = self.forward.val();
        }
        self.away.next = self.at_zero.val() | (self.direction.val() == self.side.q.val());
        self.refusing.next = self.request.val() & self.at_limit.val() & self.away.val();
        self.taken.next = self.request.val()
            & !self.clear.val()
            & !self.refusing.val()
            & !(self.at_zero.val() & self.playback.val());

        if self.clear.val() {
            self.magnitude.d.next = 0.into();
            self.side.d.next = false;
        } else if self.taken.val() & self.away.val() {
            self.magnitude.d.next = self.one_more.val();
            self.side.d.next = self.direction.val();
        } else if self.taken.val() {
            self.magnitude.d.next = self.one_less.val();
        }

        if self.clear.val() | self.at_zero.val() {
            self.refused.d.next = false;
        } else if self.refusing.val() {
            self.refused.d.next = true;
        }

        self.step.next = self.taken.val();
        self.drive_forward.next = self.direction.val();
        self.count.next = self.magnitude.q.val();
        self.count_forward.next = self.side.q.val();
        self.zero.next = self.at_zero.val();
        self.fault.next = self.refused.q.val();
    }
}
