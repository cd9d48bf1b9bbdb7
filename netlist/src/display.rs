//! Expressions as Verilog text, every literal with its width: what a refusal shows of two meanings,
//! and what files of Verilog are written with.

use std::fmt::Write as _;

use crate::{Expression, Node, SignalId};

impl Expression {
    /// Verilog text of the expression; `name` gives the text of a signal.
    ///
    /// A slice of anything but a signal has no Verilog spelling: the text then shows the meaning,
    /// and the caller has to give the inner value a name first.
    #[must_use]
    pub fn verilog(&self, name: &dyn Fn(SignalId) -> String) -> String {
        match &self.node {
            Node::Constant(value) => literal(self.width, *value),
            Node::Signal(signal) => name(*signal),
            Node::Not(a) => complement(a, name),
            Node::All(a) => format!("&{}", unary_operand(a, name)),
            Node::Any(a) => format!("|{}", unary_operand(a, name)),
            Node::Parity(a) => format!("^{}", unary_operand(a, name)),
            Node::Extend(a) => {
                format!("{{{}, {}}}", literal(self.width - a.width, 0), a.verilog(name))
            }
            Node::Slice { of, low } => sliced(of, *low, self.width, name),
            Node::Select { condition, then, otherwise } => format!(
                "{} ? {} : {}",
                operand(condition, name),
                operand(then, name),
                operand(otherwise, name)
            ),
            _ => self.infix(name),
        }
    }

    fn infix(&self, name: &dyn Fn(SignalId) -> String) -> String {
        let (Some(operator), [l, r]) = (infix_operator(&self.node), &self.operands()[..]) else {
            return String::new();
        };
        let left = if associates(operator) && infix_operator(&l.node) == Some(operator) {
            l.verilog(name)
        } else {
            operand(l, name)
        };
        format!("{left} {operator} {}", operand(r, name))
    }
}

/// A Verilog literal: binary for one bit, decimal up to a digit, hexadecimal beyond.
#[must_use]
pub fn literal(width: u32, value: u64) -> String {
    match width {
        1 => format!("1'b{value}"),
        2..=4 => format!("{width}'d{value}"),
        _ => format!("{width}'h{value:x}"),
    }
}

fn infix_operator(node: &Node) -> Option<&'static str> {
    Some(match node {
        Node::And(..) => "&",
        Node::Or(..) => "|",
        Node::Xor(..) => "^",
        Node::Add(..) => "+",
        Node::Subtract(..) => "-",
        Node::ShiftUp(..) => "<<",
        Node::ShiftDown(..) => ">>",
        Node::Equal(..) => "==",
        Node::Less(..) => "<",
        Node::LessOrEqual(..) => "<=",
        _ => return None,
    })
}

/// True for operators that may follow themselves without parentheses.
fn associates(operator: &str) -> bool {
    matches!(operator, "&" | "|" | "^" | "+")
}

fn operand(e: &Expression, name: &dyn Fn(SignalId) -> String) -> String {
    let text = e.verilog(name);
    match &e.node {
        Node::Constant(_) | Node::Signal(_) | Node::Extend(_) | Node::Slice { .. } => text,
        Node::Not(inner) if !is_comparison(inner) => text,
        _ => format!("({text})"),
    }
}

/// Operand of a complement or a reduction. Another complement needs parentheses there: `^~` is one
/// token, the exclusive nor, and `|~` and `~~` are none.
fn unary_operand(e: &Expression, name: &dyn Fn(SignalId) -> String) -> String {
    let text = operand(e, name);
    if matches!(e.node, Node::Not(_)) && text.starts_with('~') { format!("({text})") } else { text }
}

fn is_comparison(e: &Expression) -> bool {
    matches!(e.node, Node::Equal(..) | Node::Less(..) | Node::LessOrEqual(..))
}

/// `~a`, or the opposite comparison.
fn complement(a: &Expression, name: &dyn Fn(SignalId) -> String) -> String {
    let opposite = match a.node {
        Node::Equal(..) => "!=",
        Node::Less(..) => ">=",
        Node::LessOrEqual(..) => ">",
        _ => return format!("~{}", unary_operand(a, name)),
    };
    let sides = a.operands();
    format!("{} {opposite} {}", operand(sides[0], name), operand(sides[1], name))
}

fn sliced(of: &Expression, low: u32, width: u32, name: &dyn Fn(SignalId) -> String) -> String {
    let mut text = operand(of, name);
    // Writing to a string cannot fail.
    let _ = match (&of.node, width) {
        (Node::ShiftDown(value, by), 1) if low == 0 => {
            text = operand(value, name);
            write!(text, "[{}]", by.verilog(name))
        }
        (_, 1) => write!(text, "[{low}]"),
        _ => write!(text, "[{}:{low}]", low + width - 1),
    };
    text
}
