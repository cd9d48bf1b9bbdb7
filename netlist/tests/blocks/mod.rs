//! Small blocks of the sorts a design has.

use rust_hdl::prelude::*;

/// One decimal digit with carry and clear.
#[derive(Default, LogicBlock)]
pub(crate) struct Decade {
    pub(crate) clock: Signal<In, Clock>,
    pub(crate) pulse: Signal<In, Bit>,
    pub(crate) clear: Signal<In, Bit>,
    pub(crate) carry: Signal<Out, Bit>,
    pub(crate) value: Signal<Out, Bits<4>>,
    digit: DFF<Bits<4>>,
    last: Signal<Local, Bit>,
}

impl Logic for Decade {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, digit);
        self.last.next = self.digit.q.val() == 9;
        self.carry.next = self.last.val() & self.pulse.val();
        self.value.next = self.digit.q.val();
        if self.clear.val() | self.carry.val() {
            self.digit.d.next = 0.into();
        } else if self.pulse.val() {
            self.digit.d.next = self.digit.q.val() + 1;
        }
    }
}

/// Two digits in cascade.
#[derive(Default, LogicBlock)]
pub(crate) struct Nested {
    pub(crate) clock: Signal<In, Clock>,
    pub(crate) pulse: Signal<In, Bit>,
    pub(crate) clear: Signal<In, Bit>,
    pub(crate) value: Signal<Out, Bits<8>>,
    units: Decade,
    tens: Decade,
}

impl Logic for Nested {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, units, tens);
        self.units.pulse.next = self.pulse.val();
        self.units.clear.next = self.clear.val();
        self.tens.pulse.next = self.units.carry.val();
        self.tens.clear.next = self.clear.val();
        self.value.next = (bit_cast::<8, 4>(self.tens.value.val()) << 4)
            | bit_cast::<8, 4>(self.units.value.val());
    }
}

/// Three phases, six steps.
#[derive(Default, LogicBlock)]
pub(crate) struct Ring {
    pub(crate) clock: Signal<In, Clock>,
    pub(crate) step: Signal<In, Bit>,
    pub(crate) forward: Signal<In, Bit>,
    pub(crate) phase_a: Signal<Out, Bit>,
    pub(crate) phase_b: Signal<Out, Bit>,
    pub(crate) phase_c: Signal<Out, Bit>,
    a: DFF<Bit>,
    b: DFF<Bit>,
    c: DFF<Bit>,
    illegal: Signal<Local, Bit>,
}

impl Logic for Ring {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, a, b, c);
        self.illegal.next = (self.a.q.val() == self.b.q.val()) & (self.b.q.val() == self.c.q.val());

        if self.illegal.val() {
            self.a.d.next = true;
            self.b.d.next = false;
            self.c.d.next = false;
        } else if self.step.val() & self.forward.val() {
            self.a.d.next = !self.b.q.val();
            self.b.d.next = !self.c.q.val();
            self.c.d.next = !self.a.q.val();
        } else if self.step.val() {
            self.a.d.next = !self.c.q.val();
            self.b.d.next = !self.a.q.val();
            self.c.d.next = !self.b.q.val();
        }

        self.phase_a.next = self.a.q.val();
        self.phase_b.next = self.b.q.val();
        self.phase_c.next = self.c.q.val();
    }
}
