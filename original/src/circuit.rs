//! A circuit: parts and what joins them. Written once, by the functions in [`figures`](crate::figures).

use crate::error::Error;
use crate::library::{self as lib, Limits, Part};

/// A wire, by its number in [`Circuit::nets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Net(pub usize);

/// What an element's output is of its inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// All.
    And,
    /// Not all.
    Nand,
    /// Any.
    Or,
    /// None.
    Nor,
    /// Not both of the first pair, and not both of the second.
    AndOrInvert,
    /// The input, later.
    Delay,
    /// JK flip-flop; inputs are clock, preset, clear (these two active low), so many J, then K.
    FlipFlop {
        /// Number of J inputs; all have to be high.
        j: usize,
    },
}

/// One gate or flip-flop.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Its place: blocks and name joined by `_`.
    pub name: String,
    /// The part's number.
    pub part: &'static str,
    /// What it does.
    pub function: Function,
    /// Wires in.
    pub inputs: Vec<Net>,
    /// Wire out; a flip-flop has its complement, too.
    pub outputs: Vec<Net>,
    /// Delays of each output.
    pub limits: Limits,
}

/// Parts and wires, with pins to the outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Circuit {
    /// Its name, that of the module in Verilog.
    pub name: String,
    /// Names of the wires; the first two are always low and always high.
    pub nets: Vec<String>,
    /// Pins in, with their level at power-up.
    pub inputs: Vec<(Net, bool)>,
    /// Pins out, by name.
    pub outputs: Vec<(String, Net)>,
    /// The parts.
    pub elements: Vec<Element>,
    scope: String,
}

/// The pins of a JK flip-flop; what is not given is tied high.
#[derive(Clone, Copy, Debug)]
pub struct Jk<'a> {
    /// Clock; the output changes when it falls.
    pub clock: Net,
    /// J inputs, all of which have to be high.
    pub j: &'a [Net],
    /// K inputs, all of which have to be high.
    pub k: &'a [Net],
    /// Sets while low.
    pub preset: Net,
    /// Clears while low; wins over preset.
    pub clear: Net,
}

impl Jk<'_> {
    /// One that toggles at each fall of `clock`.
    #[must_use]
    pub fn toggle(clock: Net, clear: Net) -> Self {
        Self { clock, j: &[Circuit::HIGH], k: &[Circuit::HIGH], preset: Circuit::HIGH, clear }
    }
}

impl Circuit {
    /// Always low.
    pub const LOW: Net = Net(0);
    /// Always high.
    pub const HIGH: Net = Net(1);

    /// Nothing yet.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self {
            name: name.into(),
            nets: vec!["low".into(), "high".into()],
            inputs: vec![],
            outputs: vec![],
            elements: vec![],
            scope: String::new(),
        }
    }

    /// A pin in, with its level at power-up.
    pub fn input(&mut self, name: &str, level: bool) -> Net {
        let net = self.wire(name);
        self.inputs.push((net, level));
        net
    }

    /// A pin out.
    pub fn output(&mut self, name: &str, net: Net) {
        self.outputs.push((name.into(), net));
    }

    /// The wire at a pin.
    ///
    /// # Errors
    ///
    /// When there is no pin or wire of that name.
    pub fn pin(&self, name: &str) -> Result<Net, Error> {
        let pin = self.outputs.iter().find(|(pin, _)| pin == name).map(|(_, net)| *net);
        let wire = || self.nets.iter().position(|net| net == name).map(Net);
        let missing = || Error::NoSuchName { circuit: self.name.clone(), name: name.into() };
        pin.or_else(wire).ok_or_else(missing)
    }

    /// Builds a block whose names begin with this one.
    pub fn block<T>(&mut self, name: &str, build: impl FnOnce(&mut Self) -> T) -> T {
        let outside = self.scope.len();
        self.scope.push_str(name);
        self.scope.push('_');
        let made = build(self);
        self.scope.truncate(outside);
        made
    }

    /// A wire that an element drives later.
    pub fn wire(&mut self, name: &str) -> Net {
        self.nets.push(format!("{}{name}", self.scope));
        Net(self.nets.len() - 1)
    }

    /// NAND gate, or inverter when there is one input.
    pub fn nand(&mut self, name: &str, inputs: &[Net]) -> Net {
        let output = self.wire(name);
        self.nand_onto(output, inputs);
        output
    }

    /// A NAND gate that drives a wire made before.
    pub fn nand_onto(&mut self, output: Net, inputs: &[Net]) {
        let part = match inputs.len() {
            1 => lib::SN7404,
            2 => lib::SN7400,
            3 => lib::SN7410,
            4 => lib::SN7420,
            _ => lib::SN7430,
        };
        self.place(output, part, Function::Nand, inputs);
    }

    /// Inverter.
    pub fn not(&mut self, name: &str, input: Net) -> Net {
        self.nand(name, &[input])
    }

    /// NOR gate.
    pub fn nor(&mut self, name: &str, inputs: &[Net]) -> Net {
        let output = self.wire(name);
        self.nor_onto(output, inputs);
        output
    }

    /// A NOR gate that drives a wire made before.
    pub fn nor_onto(&mut self, output: Net, inputs: &[Net]) {
        let part = if inputs.len() == 2 { lib::SN7402 } else { lib::SN7427 };
        self.place(output, part, Function::Nor, inputs);
    }

    /// AND gate of two.
    pub fn and(&mut self, name: &str, inputs: [Net; 2]) -> Net {
        self.gate(name, lib::SN7408, Function::And, &inputs)
    }

    /// OR gate of two.
    pub fn or(&mut self, name: &str, inputs: [Net; 2]) -> Net {
        self.gate(name, lib::SN7432, Function::Or, &inputs)
    }

    /// Not (first pair or second pair).
    pub fn and_or_invert(&mut self, name: &str, first: [Net; 2], second: [Net; 2]) -> Net {
        let inputs = [first, second].concat();
        self.gate(name, lib::SN7451, Function::AndOrInvert, &inputs)
    }

    /// RC network and gate: what is shorter than the delay does not get through.
    pub fn delay(&mut self, name: &str, input: Net, nominal_ps: u64) -> Net {
        let (output, limits) = (self.wire(name), lib::rc_limits(nominal_ps));
        self.join(lib::RC_DELAY, limits, Function::Delay, (&[input], &[output]));
        output
    }

    /// Clock input of the two-clock flip-flop.
    pub fn clock_input(&mut self, name: &str, input: Net) -> Net {
        self.gate(name, lib::CLOCK_INPUT, Function::Delay, &[input])
    }

    /// JK flip-flop: output and complement.
    pub fn flip_flop(&mut self, name: &str, pins: Jk) -> [Net; 2] {
        let outputs = self.flip_flop_wires(name);
        self.flip_flop_onto(outputs, pins);
        outputs
    }

    /// The wires of a flip-flop that is placed later.
    pub fn flip_flop_wires(&mut self, name: &str) -> [Net; 2] {
        [self.wire(name), self.wire(&format!("{name}_bar"))]
    }

    /// A flip-flop that drives wires made before.
    pub fn flip_flop_onto(&mut self, outputs: [Net; 2], pins: Jk) {
        let part = if pins.j.len() == 1 && pins.k.len() == 1 { lib::SN7476 } else { lib::SN7472 };
        let inputs = [&[pins.clock, pins.preset, pins.clear], pins.j, pins.k].concat();
        let function = Function::FlipFlop { j: pins.j.len() };
        self.join(part.name, part.limits, function, (&inputs, &outputs));
    }

    /// Double-input flip-flop of two NAND gates: any of `set` low sets, any of `clear` low clears.
    /// While both are low both outputs are high, and who lets go last wins.
    pub fn latch(&mut self, name: &str, set: &[Net], clear: &[Net]) -> [Net; 2] {
        let outputs = self.flip_flop_wires(name);
        self.nand_onto(outputs[0], &[set, &[outputs[1]]].concat());
        self.nand_onto(outputs[1], &[clear, &[outputs[0]]].concat());
        outputs
    }

    fn gate(&mut self, name: &str, part: Part, function: Function, inputs: &[Net]) -> Net {
        let output = self.wire(name);
        self.place(output, part, function, inputs);
        output
    }

    fn place(&mut self, output: Net, part: Part, function: Function, inputs: &[Net]) {
        self.join(part.name, part.limits, function, (inputs, &[output]));
    }

    fn join(
        &mut self,
        part: &'static str,
        limits: Limits,
        function: Function,
        (inputs, outputs): (&[Net], &[Net]),
    ) {
        let name = self.nets[outputs[0].0].clone();
        let (inputs, outputs) = (inputs.to_vec(), outputs.to_vec());
        self.elements.push(Element { name, part, function, inputs, outputs, limits });
    }
}
