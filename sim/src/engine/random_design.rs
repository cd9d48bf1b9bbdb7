//! Designs and stimulus nobody would think of, for tests: registers in several instances, counters
//! with odd steps and thresholds, registers that change under conditions within conditions, logic
//! of every operator.

use helixlock_netlist::{Assignment, Expression, Netlist, Node, Register, Signal, SignalId, mask};

/// A small generator of reproducible numbers (`splitmix64`).
#[derive(Clone, Debug)]
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn roll(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.roll() % bound
    }

    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[usize::try_from(self.below(from.len() as u64)).expect("an index fits")]
    }
}

/// A design of a few registers.
pub(crate) fn random_design(dice: &mut Dice) -> Netlist {
    let mut draft = Draft::new(dice);
    let registers = 2 + draft.dice.below(14);
    let outputs: Vec<SignalId> = (0..registers).map(|_| draft.register_output()).collect();
    for output in &outputs {
        if draft.dice.below(3) == 0 {
            draft.private.push(*output);
        } else {
            draft.show(*output);
        }
    }
    for _ in 0..draft.dice.below(14) {
        draft.local();
    }
    for output in outputs {
        draft.register_input(output);
    }
    draft.finished()
}

/// A design of flip-flops: more than a machine word has bits, in chains and rings, and some behind
/// logic of a dozen of them and of how a counter compares.
pub(crate) fn random_bits(dice: &mut Dice) -> Netlist {
    let mut draft = Draft::new(dice);
    let counter = draft.signal("counter", 6);
    draft.show(counter);
    let outputs: Vec<SignalId> = (0..80).map(|_| draft.signal("bit", 1)).collect();
    draft.known.extend(&outputs);
    draft.register_input(counter);
    for (output, before) in outputs.iter().zip(outputs.iter().cycle().skip(79)) {
        let value = match draft.dice.below(8) {
            0..=4 => read(*before, 1),
            5 => draft.logic_of_many(),
            6 => draft.held(*output, 1),
            _ => draft.expression(1, 2),
        };
        draft.register(*output, value);
    }
    draft.finished()
}

/// A design that waits for pulses: synchronisers, a counter that is loaded again when it has run down,
/// a narrow register and decades that pulses step, and bits behind logic of more bits than one table
/// takes.
pub(crate) fn random_waiting(dice: &mut Dice) -> Netlist {
    let mut draft = Draft::new(dice);
    let width = draft.dice.pick(&[6, 8]);
    let counter = draft.signal("counter", width);
    let tick = draft.compared(counter, width);
    let chain: Vec<SignalId> = (0..6).map(|_| draft.signal("bit", 1)).collect();
    draft.known.extend([tick].iter().chain(&chain));
    let pins = [draft.netlist.inputs[0], draft.netlist.inputs[1]];
    for (chain, pin) in chain.chunks(3).zip(pins) {
        for (output, before) in chain.iter().zip([&[pin], chain].concat()) {
            draft.register(*output, read(before, 1));
        }
    }
    let run_down = draft.run_down(counter, width);
    draft.register(counter, run_down);
    let pulses = [draft.risen(&chain[..3]), draft.risen(&chain[3..])];
    for width in [1, 2, 3, 4] {
        let output = draft.signal("held", width);
        let pulse = Box::new(read(draft.dice.pick(&pulses), 1));
        let value = Box::new(draft.expression(width, 2));
        let value = select(width, pulse, value, Box::new(read(output, width)));
        draft.known.push(output);
        draft.register(output, value);
    }
    let late: Vec<SignalId> = (0..4).map(|_| draft.signal("late", 1)).collect();
    for output in &late {
        let value = draft.logic_of_many();
        draft.register(*output, value);
    }
    draft.known.extend(late);
    draft.finished()
}

struct Draft<'a> {
    dice: &'a mut Dice,
    netlist: Netlist,
    /// Signals that may be read.
    known: Vec<SignalId>,
    /// Registers that only those which change under conditions may read.
    private: Vec<SignalId>,
    /// Conditions under which registers change.
    enables: Vec<SignalId>,
}

impl<'a> Draft<'a> {
    /// Inputs alone.
    fn new(dice: &'a mut Dice) -> Self {
        let netlist = Netlist::default();
        let mut draft = Self { dice, netlist, known: vec![], private: vec![], enables: vec![] };
        for width in [1, 1, 8] {
            let input = draft.signal("input", width);
            draft.netlist.inputs.push(input);
            draft.known.push(input);
        }
        draft
    }

    /// With some outputs.
    fn finished(mut self) -> Netlist {
        for _ in 0..3 {
            let output = self.dice.pick(&self.known);
            self.netlist.outputs.push(output);
        }
        self.netlist
    }
}

impl Draft<'_> {
    fn signal(&mut self, name: &str, width: u32) -> SignalId {
        let index = self.netlist.signals.len();
        let instance = self.dice.pick(&["", "one.", "two.", "two.inner."]);
        self.netlist.signals.push(Signal { path: format!("{instance}{name}{index}"), width });
        SignalId(u32::try_from(index).expect("a design has few signals"))
    }

    fn register_output(&mut self) -> SignalId {
        let width = self.dice.pick(&[1, 1, 4, 6, 8, 12, 64]);
        self.signal("register", width)
    }

    /// Lets others read a register as it is, or no more than how it compares.
    fn show(&mut self, register: SignalId) {
        let width = self.netlist.signal(register).width;
        if width < 6 || self.dice.below(3) == 0 {
            return self.known.push(register);
        }
        for _ in 0..self.dice.below(3) {
            let value = self.comparison(register, width);
            let target = self.signal("local", 1);
            self.netlist.assignments.push(Assignment { target, value });
            self.known.push(target);
        }
    }

    /// A signal that says whether a register has a certain value.
    fn compared(&mut self, register: SignalId, width: u32) -> SignalId {
        let value = Box::new(constant(self.dice.below(3), width));
        let node = Node::Equal(Box::new(read(register, width)), value);
        let target = self.signal("local", 1);
        self.netlist.assignments.push(Assignment { target, value: Expression { width: 1, node } });
        target
    }

    /// A signal that says that the end of a synchroniser has just risen.
    fn risen(&mut self, chain: &[SignalId]) -> SignalId {
        let fell = Expression { width: 1, node: Node::Not(Box::new(read(chain[2], 1))) };
        let node = Node::And(Box::new(read(chain[1], 1)), Box::new(fell));
        let target = self.signal("local", 1);
        self.netlist.assignments.push(Assignment { target, value: Expression { width: 1, node } });
        target
    }

    /// One less at every clock, until that is over or an input says otherwise.
    fn run_down(&mut self, counter: SignalId, width: u32) -> Expression {
        let (over, clear) = (self.compared(counter, width), self.netlist.inputs[1]);
        let node = Node::Or(Box::new(read(over, 1)), Box::new(read(clear, 1)));
        let restart = Box::new(self.fitted(self.netlist.inputs[2], width));
        let ends = Box::new(Expression { width: 1, node });
        let node = Node::Subtract(Box::new(read(counter, width)), Box::new(constant(1, width)));
        select(width, ends, restart, Box::new(Expression { width, node }))
    }

    fn comparison(&mut self, register: SignalId, width: u32) -> Expression {
        let own = Box::new(Expression { width, node: Node::Signal(register) });
        let threshold = Box::new(self.leaf(width));
        let node = match self.dice.below(4) {
            0 => Node::Equal(own, threshold),
            1 => Node::Less(own, threshold),
            2 => Node::LessOrEqual(threshold, own),
            _ => Node::Any(own),
        };
        Expression { width: 1, node }
    }

    fn register_input(&mut self, output: SignalId) {
        let width = self.netlist.signal(output).width;
        let value = match self.dice.below(6) {
            0 => self.expression(width, 3),
            1 => self.synchroniser(width),
            2..=4 => self.held(output, width),
            _ => self.counter(output, width),
        };
        self.register(output, value);
    }

    fn register(&mut self, output: SignalId, value: Expression) {
        let width = value.width;
        let input = self.signal("next", width);
        self.netlist.assignments.push(Assignment { target: input, value });
        let initial = self.dice.roll() & mask(width);
        self.netlist.registers.push(Register { output, input, initial });
    }

    /// One bit, of more bits than a table takes.
    fn logic_of_many(&mut self) -> Expression {
        let mut value = self.leaf(1);
        for _ in 0..14 {
            let (left, right) = (Box::new(value), Box::new(self.leaf(1)));
            let node = match self.dice.below(3) {
                0 => Node::And(left, right),
                1 => Node::Or(left, right),
                _ => Node::Xor(left, right),
            };
            value = Expression { width: 1, node };
        }
        value
    }

    fn local(&mut self) {
        let width = self.dice.pick(&[1, 1, 1, 4, 8, 12]);
        let value = self.expression(width, 3);
        let target = self.signal("local", width);
        self.netlist.assignments.push(Assignment { target, value });
        self.known.push(target);
    }

    fn synchroniser(&mut self, width: u32) -> Expression {
        self.leaf(width)
    }

    /// Anything under a condition, and rest otherwise.
    fn held(&mut self, output: SignalId, width: u32) -> Expression {
        let own = || Box::new(read(output, width));
        let enable = self.enable();
        let enable = || Box::new(read(enable, 1));
        let value = Box::new(self.held_value(width));
        if self.dice.below(3) == 0 {
            let stall = Box::new(Expression { width: 1, node: Node::Not(enable()) });
            return select(width, stall, own(), value);
        }
        let moved = select(width, enable(), value, own());
        if self.dice.below(2) == 0 {
            return moved;
        }
        let clear = self.enable();
        let cleared = Box::new(constant(0, width));
        select(width, Box::new(read(clear, 1)), cleared, Box::new(moved))
    }

    /// Mixed from what anyone knows and what few do.
    fn held_value(&mut self, width: u32) -> Expression {
        let mut value = self.expression(width, 3);
        for signal in self.private.clone() {
            if self.dice.below(2) == 0 {
                let other = Box::new(self.fitted(signal, width));
                value = Expression { width, node: Node::Xor(Box::new(value), other) };
            }
        }
        value
    }

    /// A condition, at times a part of one that another register has, so that they nest.
    fn enable(&mut self) -> SignalId {
        let mut value = self.expression(1, 2);
        if !self.enables.is_empty() && self.dice.below(3) != 0 {
            let wider = read(self.dice.pick(&self.enables.clone()), 1);
            value = Expression { width: 1, node: Node::And(Box::new(wider), Box::new(value)) };
        }
        let target = self.signal("enable", 1);
        self.netlist.assignments.push(Assignment { target, value });
        self.known.push(target);
        self.enables.push(target);
        target
    }

    /// A step up or down while a condition holds, and a load or rest otherwise.
    fn counter(&mut self, output: SignalId, width: u32) -> Expression {
        let own = || Box::new(Expression { width, node: Node::Signal(output) });
        let step = Box::new(constant(self.dice.pick(&[1, 1, 1, 2, 5]) & mask(width), width));
        let counted = match self.dice.below(2) {
            0 => Node::Add(own(), step),
            _ => Node::Subtract(own(), step),
        };
        let restart = Box::new(self.leaf(width));
        let reached = Box::new(self.comparison(output, width));
        let enabled = Box::new(self.expression(1, 1));
        let counted = Box::new(Expression { width, node: counted });
        let moved = select(width, reached, restart, counted);
        select(width, enabled, Box::new(moved), own())
    }

    fn expression(&mut self, width: u32, depth: u32) -> Expression {
        if depth == 0 {
            return self.leaf(width);
        }
        let operands = if self.dice.below(2) == 0 { width } else { self.dice.pick(&[1, 4, 8, 12]) };
        let mut of = |width| Box::new(self.expression(width, depth - 1));
        let (a, b, condition) = (of(width), of(width), of(1));
        let (left, right) = (of(operands), of(operands));
        let wide = of((width + 3).min(64));
        let node = match self.dice.below(if width == 1 { 15 } else { 9 }) {
            0 => Node::Not(a),
            1 => Node::And(a, b),
            2 => Node::Or(a, b),
            3 => Node::Xor(a, b),
            4 => Node::Add(a, b),
            5 => Node::Subtract(a, b),
            6 => Node::ShiftUp(a, b),
            7 => Node::Slice { low: wide.width - width, of: wide },
            8 => return select(width, condition, a, b),
            9 => Node::ShiftDown(a, b),
            10 => Node::Equal(left, right),
            11 => Node::Less(left, right),
            12 => Node::LessOrEqual(left, right),
            13 => Node::Parity(left),
            _ => Node::All(left),
        };
        Expression { width, node }
    }

    /// A signal, cut or extended to that width, or a constant.
    fn leaf(&mut self, width: u32) -> Expression {
        if self.dice.below(4) == 0 {
            return constant(self.dice.roll() & mask(width), width);
        }
        let known = self.known.clone();
        let signal = self.dice.pick(&known);
        self.fitted(signal, width)
    }

    /// A signal, cut or extended.
    fn fitted(&self, signal: SignalId, width: u32) -> Expression {
        let found = self.netlist.signal(signal).width;
        let whole = read(signal, found);
        match found {
            _ if found == width => whole,
            _ if found < width => Expression { width, node: Node::Extend(Box::new(whole)) },
            _ => Expression { width, node: Node::Slice { of: Box::new(whole), low: 0 } },
        }
    }
}

fn read(signal: SignalId, width: u32) -> Expression {
    Expression { width, node: Node::Signal(signal) }
}

fn constant(value: u64, width: u32) -> Expression {
    Expression { width, node: Node::Constant(value) }
}

fn select(
    width: u32,
    condition: Box<Expression>,
    then: Box<Expression>,
    otherwise: Box<Expression>,
) -> Expression {
    Expression { width, node: Node::Select { condition, then, otherwise } }
}
