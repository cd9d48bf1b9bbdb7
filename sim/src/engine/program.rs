//! Expressions as a list of operations, each value computed once: what a design that is met at run
//! time is evaluated by.

use std::collections::BTreeMap;

use helixlock_netlist::{Assignment, Expression, Node, SignalId, mask};

use super::words::{choose, shift_down, shift_up};

/// Where a value stands: sources first, then one for each operation, in order.
pub(super) type Place = u32;

/// Straight-line code.
#[derive(Clone, Debug)]
pub(super) struct Program {
    sources: usize,
    operations: Vec<Operation>,
}

/// Computes one value from those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Operation {
    code: Code,
    operands: [Place; 3],
    /// The bits kept; the value itself of a constant.
    mask: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Code {
    Constant,
    Copy,
    Not,
    And,
    Or,
    Xor,
    Add,
    Subtract,
    ShiftUp,
    ShiftDown,
    /// By as many bits as the second operand says of itself.
    Slice,
    Equal,
    Less,
    LessOrEqual,
    Any,
    Parity,
    /// The second operand if the first is not zero, or else the third.
    Select,
}

impl Program {
    /// All values, the sources first.
    pub(super) fn run(&self, sources: impl Iterator<Item = u64>) -> Vec<u64> {
        let mut values = Vec::with_capacity(self.sources + self.operations.len());
        values.extend(sources);
        debug_assert_eq!(values.len(), self.sources, "one value a source");
        for operation in &self.operations {
            values.push(operation.evaluate(&values));
        }
        values
    }
}

impl Operation {
    #[inline]
    fn evaluate(&self, values: &[u64]) -> u64 {
        let [a, b, c] = self.operands;
        let of = |place: Place| values[place as usize];
        let raw = match self.code {
            Code::Constant => u64::MAX,
            Code::Copy => of(a),
            Code::Not => !of(a),
            Code::And => of(a) & of(b),
            Code::Or => of(a) | of(b),
            Code::Xor => of(a) ^ of(b),
            Code::Add => of(a).wrapping_add(of(b)),
            Code::Subtract => of(a).wrapping_sub(of(b)),
            Code::ShiftUp => shift_up(of(a), of(b)),
            Code::ShiftDown => shift_down(of(a), of(b)),
            Code::Slice => of(a) >> b,
            Code::Equal => u64::from(of(a) == of(b)),
            Code::Less => u64::from(of(a) < of(b)),
            Code::LessOrEqual => u64::from(of(a) <= of(b)),
            Code::Any => u64::from(of(a) != 0),
            Code::Parity => u64::from(of(a).count_ones() & 1),
            Code::Select => choose(of(a), of(b), of(c)),
        };
        raw & self.mask
    }
}

/// A program in the making.
pub(super) struct Compiler {
    program: Program,
    signals: BTreeMap<SignalId, Place>,
    known: BTreeMap<Operation, Place>,
}

impl Compiler {
    /// Begins with the signals that are given, one place each.
    pub(super) fn new(sources: impl Iterator<Item = SignalId>) -> Self {
        let signals: BTreeMap<_, _> = sources.zip(0..).collect();
        let program = Program { sources: signals.len(), operations: Vec::new() };
        Self { program, signals, known: BTreeMap::new() }
    }

    /// Computes the target of an assignment, which reads only what stands before it.
    pub(super) fn assign(&mut self, assignment: &Assignment) {
        let place = self.value(&assignment.value);
        self.signals.insert(assignment.target, place);
    }

    /// Where a signal stands; one that nothing drives is zero.
    pub(super) fn signal(&mut self, signal: SignalId) -> Place {
        match self.signals.get(&signal) {
            Some(place) => *place,
            None => self.constant(0),
        }
    }

    /// Where the value of an expression stands.
    pub(super) fn value(&mut self, expression: &Expression) -> Place {
        let (code, operands) = match &expression.node {
            Node::Constant(value) => return self.constant(*value & mask(expression.width)),
            Node::Signal(id) => return self.signal(*id),
            Node::Not(a) => (Code::Not, self.values([a])),
            Node::And(a, b) => (Code::And, self.values([a, b])),
            Node::Or(a, b) => (Code::Or, self.values([a, b])),
            Node::Xor(a, b) => (Code::Xor, self.values([a, b])),
            Node::Add(a, b) => (Code::Add, self.values([a, b])),
            Node::Subtract(a, b) => (Code::Subtract, self.values([a, b])),
            Node::ShiftUp(a, b) => (Code::ShiftUp, self.values([a, b])),
            Node::ShiftDown(a, b) => (Code::ShiftDown, self.values([a, b])),
            Node::Equal(a, b) => (Code::Equal, self.values([a, b])),
            Node::Less(a, b) => (Code::Less, self.values([a, b])),
            Node::LessOrEqual(a, b) => (Code::LessOrEqual, self.values([a, b])),
            Node::All(a) => (Code::Equal, [self.value(a), self.constant(mask(a.width)), 0]),
            Node::Any(a) => (Code::Any, self.values([a])),
            Node::Parity(a) => (Code::Parity, self.values([a])),
            Node::Slice { of, low } => (Code::Slice, [self.value(of), *low, 0]),
            Node::Extend(a) => (Code::Copy, self.values([a])),
            Node::Select { condition, then, otherwise } => {
                (Code::Select, self.values([condition, then, otherwise]))
            }
        };
        self.place(Operation { code, operands, mask: mask(expression.width) })
    }

    /// The program, complete.
    pub(super) fn finish(self) -> Program {
        self.program
    }

    fn values<const N: usize>(&mut self, operands: [&Expression; N]) -> [Place; 3] {
        let mut places = [0; 3];
        for (place, operand) in places.iter_mut().zip(operands) {
            *place = self.value(operand);
        }
        places
    }

    fn constant(&mut self, value: u64) -> Place {
        self.place(Operation { code: Code::Constant, operands: [0; 3], mask: value })
    }

    fn place(&mut self, operation: Operation) -> Place {
        let Program { sources, operations } = &mut self.program;
        *self.known.entry(operation).or_insert_with(|| {
            operations.push(operation);
            Place::try_from(*sources + operations.len() - 1).expect("a design fits into memory")
        })
    }
}
