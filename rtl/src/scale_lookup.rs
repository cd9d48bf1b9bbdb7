//! Scale look-up: finds the correction of a place in the EEPROM and steps the corrector to it.
//!
//! Document 3, scheme 1: position and direction address a 2816 EEPROM; what it holds times a
//! factor is the number of steps of a fine-adjusting stepper. Scheme 2 takes `correction` to the
//! display instead. Neither corrects while idling.
//!
//! | port            | dir | meaning                                                          |
//! |-----------------|-----|------------------------------------------------------------------|
//! | `clock`         | in  | FPGA clock, rising edge                                          |
//! | `clear`         | in  | corrector at its zero, place 0                                   |
//! | `origin`        | in  | high for one clock: the origin pulse, place 0                    |
//! | `place_pulse`   | in  | high for one clock per place of the table (1 mm)                 |
//! | `forward`       | in  | direction of travel                                              |
//! | `machining`     | in  | not idling: the corrector may step                               |
//! | `places`        | in  | places of the table for each direction                           |
//! | `two_ways`      | in  | a second table for travel in reverse follows the first           |
//! | `scale`         | in  | steps per LSB of the table, times 4096; at most 65 503           |
//! | `tick`          | in  | step clock of the corrector                                      |
//! | `data`          | in  | byte of the EEPROM at `address`, signed LSB                      |
//! | `address`       | out | address of the EEPROM, registered; the table begins at 16        |
//! | `correction`    | out | the byte in force, 0 outside the table                           |
//! | `step`          | out | high for one clock: a step of the corrector                      |
//! | `step_forward`  | out | its direction                                                    |
//!
//! # Sequence
//!
//! | clocks after a new address | 0 … 15              | 16 … 24           | 25             |
//! |----------------------------|---------------------|-------------------|----------------|
//! |                            | EEPROM access       | multiplies        | target in force|
//!
//! `target = ⌊|data|·scale/4096 + ½⌋` with the sign of `data`. Then at every tick one step nearer.
//!
//! # Waveform
//!
//! The corrector has 2 steps to go: `machining` = 1, `scale` = 1000, `data` = 02, `places` = 9,
//! after 1 pulses on `clear` and after 40 clocks:
//!
//! ```text
//! tick         ▁▔▁▔▁▔▁▔▁
//! step         ▁▔▁▔▁▁▁▁▁
//! step_forward ▔▔▔▔▁▁▁▁▁
//! ```
//!
//! # At the same time
//!
//! A place pulse while the last one is looked up starts the look-up over; the old target stays
//! in force meanwhile. `origin` wins over `place_pulse`. A tick in the clock a target comes into
//! force still follows the old one.
//!
//! # Inferred
//!
//! 16 clocks of access time: 1.3 µs at 12 MHz for a part of 0.25 µs. Outside the table the
//! target is zero, as the table's maker leaves those places uncorrected. While idling the
//! corrector stands still. The header of the image is not read: `places` and `scale` are set.

use rust_hdl::prelude::*;

/// Place counter, multiplier and corrector; see the [module](self) for ports and sequence.
#[derive(Debug, Default, LogicBlock)]
pub struct ScaleLookup {
    /// FPGA clock.
    pub clock: Signal<In, Clock>,
    /// Corrector at its zero, place 0.
    pub clear: Signal<In, Bit>,
    /// The origin pulse.
    pub origin: Signal<In, Bit>,
    /// One per place of the table.
    pub place_pulse: Signal<In, Bit>,
    /// Direction of travel.
    pub forward: Signal<In, Bit>,
    /// The corrector may step.
    pub machining: Signal<In, Bit>,
    /// Places for each direction.
    pub places: Signal<In, Bits<12>>,
    /// A second table for reverse.
    pub two_ways: Signal<In, Bit>,
    /// Steps per LSB, times 4096.
    pub scale: Signal<In, Bits<24>>,
    /// Step clock of the corrector.
    pub tick: Signal<In, Bit>,
    /// Byte of the EEPROM.
    pub data: Signal<In, Bits<8>>,
    /// Address of the EEPROM.
    pub address: Signal<Out, Bits<12>>,
    /// The byte in force.
    pub correction: Signal<Out, Bits<8>>,
    /// A step of the corrector.
    pub step: Signal<Out, Bit>,
    /// Its direction.
    pub step_forward: Signal<Out, Bit>,
    place: DFF<Bits<12>>,
    pointer: DFF<Bits<12>>,
    inside: DFF<Bit>,
    phase: DFF<Bits<5>>,
    byte: DFF<Bits<8>>,
    factor: DFF<Bits<24>>,
    digits: DFF<Bits<8>>,
    product: DFF<Bits<24>>,
    target: DFF<Bits<12>>,
    stands: DFF<Bits<12>>,
    place_more: Signal<Local, Bits<12>>,
    place_less: Signal<Local, Bits<12>>,
    forward_address: Signal<Local, Bits<12>>,
    reverse_address: Signal<Local, Bits<12>>,
    wanted: Signal<Local, Bits<12>>,
    phase_more: Signal<Local, Bits<5>>,
    negated: Signal<Local, Bits<8>>,
    doubled: Signal<Local, Bits<24>>,
    sum: Signal<Local, Bits<24>>,
    rounded: Signal<Local, Bits<24>>,
    above_middle: Signal<Local, Bits<12>>,
    below_middle: Signal<Local, Bits<12>>,
    up: Signal<Local, Bit>,
    moving: Signal<Local, Bit>,
    stands_more: Signal<Local, Bits<12>>,
    stands_less: Signal<Local, Bits<12>>,
}

#[expect(clippy::too_many_lines, reason = "counter, multiplier and corrector, few lines each")]
impl Logic for ScaleLookup {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self, clock, place, pointer, inside, phase, byte, factor, digits, product, target,
            stands
        );

        // Place of the table; below 0 it wraps, and is outside like all beyond the last.
        self.place_more.next = self.place.q.val() + 1;
        self.place_less.next = self.place.q.val() - 1;
        if self.clear.val() | self.origin.val() {
            self.place.d.next = 0.into();
        } else if self.place_pulse.val() & self.forward.val() {
            self.place.d.next = self.place_more.val();
        } else if self.place_pulse.val() {
            self.place.d.next = self.place_less.val();
        }
        self.forward_address.next = self.place.q.val() + 16;
        self.reverse_address.next = self.forward_address.val() + self.places.val();
        if self.two_ways.val() & !self.forward.val() {
            self.wanted.next = self.reverse_address.val();
        } else {
            self.wanted.next = self.forward_address.val();
        }
        self.pointer.d.next = self.wanted.val();
        self.inside.d.next = self.place.q.val() < self.places.val();

        // Look-up and multiplication, over again whenever the address changes.
        self.phase_more.next = self.phase.q.val() + 1;
        if self.clear.val() | (self.pointer.q.val() != self.wanted.val()) {
            self.phase.d.next = 0.into();
        } else if self.phase.q.val() < 26 {
            self.phase.d.next = self.phase_more.val();
        }
        self.negated.next = !self.data.val() + 1;
        self.doubled.next = self.factor.q.val() << 1;
        self.sum.next = self.product.q.val() + self.factor.q.val();
        if self.phase.q.val() == 15 {
            self.product.d.next = 0.into();
            self.factor.d.next = self.scale.val();
            if !self.inside.q.val() {
                self.byte.d.next = 0.into();
                self.digits.d.next = 0.into();
            } else if self.data.val().get_bit(7) {
                self.byte.d.next = self.data.val();
                self.digits.d.next = self.negated.val();
            } else {
                self.byte.d.next = self.data.val();
                self.digits.d.next = self.data.val();
            }
        } else if self.phase.q.val() < 24 {
            self.factor.d.next = self.doubled.val();
            self.digits.d.next = self.digits.q.val() >> 1;
            if self.digits.q.val().get_bit(0) {
                self.product.d.next = self.sum.val();
            }
        }

        // The corrector's zero is 2048.
        self.rounded.next = self.product.q.val() + 2048;
        self.above_middle.next = self.rounded.val().get_bits::<12>(12) + 2048;
        self.below_middle.next = !self.rounded.val().get_bits::<12>(12) + 2049;
        self.stands_more.next = self.stands.q.val() + 1;
        self.stands_less.next = self.stands.q.val() - 1;
        self.up.next = self.stands.q.val() < self.target.q.val();
        self.moving.next = self.tick.val()
            & self.machining.val()
            & !self.clear.val()
            & (self.stands.q.val() != self.target.q.val());
        if self.clear.val() {
            self.target.d.next = 2048.into();
            self.stands.d.next = 2048.into();
        } else {
            if (self.phase.q.val() == 24) & self.byte.q.val().get_bit(7) {
                self.target.d.next = self.below_middle.val();
            } else if self.phase.q.val() == 24 {
                self.target.d.next = self.above_middle.val();
            }
            if self.moving.val() & self.up.val() {
                self.stands.d.next = self.stands_more.val();
            } else if self.moving.val() {
                self.stands.d.next = self.stands_less.val();
            }
        }

        self.address.next = self.pointer.q.val();
        self.correction.next = self.byte.q.val();
        self.step.next = self.moving.val();
        self.step_forward.next = self.up.val();
    }
}
