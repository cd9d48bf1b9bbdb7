//! Descriptions without a single sound meaning are refused, each with its reason.
//!
//! The first ones are traps in which rust-hdl's simulator and its Verilog disagree.

use helixlock_netlist::{Library, Netlist, NetlistError, elaborate};
use rust_hdl::core::block::Block;
use rust_hdl::prelude::*;

/// Why the block is refused, as its author reads it.
fn refusal(block: &dyn Block) -> String {
    let flat = elaborate("block", block, &Library::new()).and_then(|design| Netlist::new(&design));
    flat.expect_err("the block is refused").to_string()
}

/// Declares a block with a four-bit input `a` and an output of the given width.
macro_rules! block {
    ($name:ident, $width:literal) => {
        #[derive(Default, LogicBlock)]
        struct $name {
            pub clock: Signal<In, Clock>,
            pub a: Signal<In, Bits<4>>,
            pub b: Signal<In, Bit>,
            pub out: Signal<Out, Bits<$width>>,
            pub bit: Signal<Out, Bit>,
            state: DFF<Bit>,
            local: Signal<Local, Bits<4>>,
        }
    };
}

block!(Wrap, 4);

impl Logic for Wrap {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.local.next = self.a.val();
        self.out.next = self.local.val();
        self.bit.next = (self.a.val() - 1) == 0xF;
    }
}

#[test]
fn arithmetic_inside_a_comparison() {
    // At 4 bits 0 − 1 is 15; Verilog takes 32 bits for the literal, where it is not.
    assert_eq!(
        refusal(&Wrap::default()),
        "block: `(a - 1) == 0xf` means (a - 4'd1) == 4'd15 in simulation and \
         ({28'h0, a} - 32'h1) == 32'hf in Verilog\n\
         hint: give the inner part a `Local` signal of its own"
    );
}

block!(WideNot, 3);

impl Logic for WideNot {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.local.next = self.a.val();
        self.bit.next = self.b.val();
        self.out.next = bit_cast::<3, 1>((!self.b.val()).into());
    }
}

#[test]
fn a_complement_inside_a_cast() {
    assert_eq!(
        refusal(&WideNot::default()),
        "block: `bit_cast::<3>((!b))` means {2'd0, ~b} in simulation and ~{2'd0, b} in Verilog\n\
         hint: give the inner part a `Local` signal of its own"
    );
}

block!(Grouping, 4);

impl Logic for Grouping {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.local.next = self.a.val();
        self.out.next = self.local.val();
        self.bit.next = self.b.val() == self.b.val() & self.b.val();
    }
}

#[test]
fn operators_that_group_differently() {
    assert_eq!(
        refusal(&Grouping::default()),
        "block: `b == b & b` groups differently in Rust and in Verilog\nhint: add parentheses"
    );
}

block!(Latch, 4);

impl Logic for Latch {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.bit.next = self.b.val();
        self.out.next = self.a.val();
        if self.b.val() {
            self.local.next = self.a.val();
        }
    }
}

#[test]
fn a_latch() {
    let said = refusal(&Latch::default());
    assert!(said.starts_with("block: `local` is not assigned on every path"), "{said}");
}

block!(Early, 4);

impl Logic for Early {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.bit.next = self.b.val();
        self.out.next = self.local.val();
        self.local.next = self.a.val();
    }
}

#[test]
fn a_local_read_above_its_assignment() {
    assert_eq!(refusal(&Early::default()), "block: `local` is read before it is assigned");
}

block!(Undriven, 4);

impl Logic for Undriven {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, state);
        self.local.next = self.a.val();
        self.out.next = self.local.val();
    }
}

#[test]
fn an_output_nobody_drives() {
    assert_eq!(refusal(&Undriven::default()), "block: nothing drives `bit`");
}

block!(NoClock, 4);

impl Logic for NoClock {
    #[hdl_gen]
    fn update(&mut self) {
        self.state.d.next = self.b.val();
        self.local.next = self.a.val();
        self.out.next = self.local.val();
        self.bit.next = self.state.q.val();
    }
}

#[test]
fn a_flip_flop_without_clock() {
    let said = refusal(&NoClock::default());
    assert!(said.starts_with("block: clock of `state.clock`: found nothing"), "{said}");
}

/// An inner block whose output follows its input at once.
#[derive(Default, LogicBlock)]
struct Wire {
    pub input_bit: Signal<In, Bit>,
    pub output_bit: Signal<Out, Bit>,
}

impl Logic for Wire {
    #[hdl_gen]
    fn update(&mut self) {
        self.output_bit.next = !self.input_bit.val();
    }
}

#[derive(Default, LogicBlock)]
struct Circle {
    pub out: Signal<Out, Bit>,
    one: Wire,
    two: Wire,
}

impl Logic for Circle {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.input_bit.next = self.two.output_bit.val();
        self.two.input_bit.next = self.one.output_bit.val();
        self.out.next = self.one.output_bit.val();
    }
}

#[test]
fn a_loop_through_two_blocks_is_shown_whole() {
    let found = elaborate("block", &Circle::default(), &Library::new())
        .and_then(|design| Netlist::new(&design))
        .expect_err("it feeds itself");
    let NetlistError::Loop { path } = found else { panic!("{found}") };
    assert_eq!(path.first(), path.last());
    for signal in ["one.input_bit", "one.output_bit", "two.input_bit", "two.output_bit"] {
        assert!(path.iter().any(|step| step == signal), "{signal} in {path:?}");
    }
}

/// Code written as Verilog text.
#[derive(Default, LogicBlock)]
struct Text {
    pub out: Signal<Out, Bit>,
}

impl Logic for Text {
    fn update(&mut self) {}

    fn hdl(&self) -> Verilog {
        Verilog::Custom("assign out = 1;".into())
    }
}

#[test]
fn verilog_of_the_authors_own() {
    let said = refusal(&Text::default());
    assert!(said.starts_with("block: found custom Verilog"), "{said}");
}
