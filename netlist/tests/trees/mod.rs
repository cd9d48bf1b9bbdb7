//! Random trees of every operator, as no builder has touched them.

use helixlock_netlist::{Expression, Node, SignalId, mask};

/// Pseudo-random numbers (Marsaglia 2003, xorshift64).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number from `low` to `high`, both included.
    pub(crate) fn between(&mut self, low: u32, high: u32) -> u32 {
        low + u32::try_from(self.next() >> 33).expect("31 bits") % (high - low + 1)
    }
}

/// Widths of the signals that the trees read.
pub(crate) const WIDTHS: [u32; 6] = [1, 1, 3, 4, 12, 64];

/// A tree of that width, as no builder has touched it.
pub(crate) fn tree(dice: &mut Dice, width: u32, depth: u32) -> Expression {
    let node = match dice.between(0, if depth == 0 { 1 } else { 16 }) {
        0 => return leaf(dice, width),
        1 => Node::Constant(constant(dice, width)),
        2 => Node::Not(inner(dice, width, depth)),
        3 => Node::And(inner(dice, width, depth), inner(dice, width, depth)),
        4 => Node::Or(inner(dice, width, depth), inner(dice, width, depth)),
        5 => Node::Xor(inner(dice, width, depth), inner(dice, width, depth)),
        6 => Node::Add(inner(dice, width, depth), inner(dice, width, depth)),
        7 => Node::Subtract(inner(dice, width, depth), inner(dice, width, depth)),
        8 => Node::ShiftUp(inner(dice, width, depth), inner(dice, width, depth)),
        9 => Node::ShiftDown(inner(dice, width, depth), inner(dice, width, depth)),
        10 | 11 if width < 64 => {
            let wider = dice.between(width + 1, 64);
            let low = dice.between(0, wider - width);
            Node::Slice { of: inner(dice, wider, depth), low }
        }
        12 | 13 if 1 < width => {
            let narrower = dice.between(1, width - 1);
            Node::Extend(inner(dice, narrower, depth))
        }
        _ if width == 1 => boolean(dice, depth),
        _ => Node::Select {
            condition: inner(dice, 1, depth),
            then: inner(dice, width, depth),
            otherwise: inner(dice, width, depth),
        },
    };
    Expression { width, node }
}

#[expect(clippy::unnecessary_box_returns, reason = "nodes hold boxes")]
fn inner(dice: &mut Dice, width: u32, depth: u32) -> Box<Expression> {
    Box::new(tree(dice, width, depth - 1))
}

fn boolean(dice: &mut Dice, depth: u32) -> Node {
    let width = dice.between(1, 64);
    let mut side = || inner(dice, width, depth);
    let (l, r) = (side(), side());
    match dice.between(0, 5) {
        0 => Node::Equal(l, r),
        1 => Node::Less(l, r),
        2 => Node::LessOrEqual(l, r),
        3 => Node::All(l),
        4 => Node::Any(l),
        _ => Node::Parity(l),
    }
}

/// A signal of that width, or a constant if there is none.
fn leaf(dice: &mut Dice, width: u32) -> Expression {
    match WIDTHS.iter().position(|&known| known == width) {
        Some(index) => Expression::signal(width, SignalId(u32::try_from(index).expect("few"))),
        None => Expression::constant(width, dice.next()),
    }
}

/// Constants that simplifications look for as often as others.
pub(crate) fn constant(dice: &mut Dice, width: u32) -> u64 {
    let small = u64::from(dice.between(0, 9));
    [0, 1, mask(width), small, dice.next()][dice.between(0, 4) as usize] & mask(width)
}
