//! Kernel expressions as their author wrote them, for messages.

use rust_hdl::core::ast::{VerilogExpression, VerilogOp, VerilogOpUnary};

/// The expression, close to the Rust it came from.
pub(crate) fn text(e: &VerilogExpression) -> String {
    match e {
        VerilogExpression::Signal(name) => name.replace('$', "."),
        VerilogExpression::Literal(literal) => plain_number(&format!("{literal:x}")),
        VerilogExpression::Cast(a, width) => format!("bit_cast::<{width}>({})", text(a)),
        VerilogExpression::Signed(a) => format!("signed({})", text(a)),
        VerilogExpression::Unsigned(a) => format!("unsigned({})", text(a)),
        VerilogExpression::Paren(a) => format!("({})", text(a)),
        VerilogExpression::Binary(l, op, r) => {
            format!("{} {} {}", text(l), operator(op), text(r))
        }
        VerilogExpression::Unary(op, a) => unary(op, &text(a)),
        VerilogExpression::Index(a, at) => format!("{}.get_bit({})", text(a), text(at)),
        VerilogExpression::Slice(a, width, at) => {
            format!("{}.get_bits::<{width}>({})", text(a), text(at))
        }
        VerilogExpression::IndexReplace(a, at, bit) => {
            format!("{}.replace_bit({}, {})", text(a), text(at), text(bit))
        }
    }
}

fn unary(op: &VerilogOpUnary, operand: &str) -> String {
    match op {
        VerilogOpUnary::Not => format!("!{operand}"),
        VerilogOpUnary::Neg => format!("-{operand}"),
        VerilogOpUnary::All => format!("{operand}.all()"),
        VerilogOpUnary::Any => format!("{operand}.any()"),
        VerilogOpUnary::Xor => format!("{operand}.xor()"),
    }
}

fn operator(op: &VerilogOp) -> &'static str {
    match op {
        VerilogOp::Add => "+",
        VerilogOp::Sub => "-",
        VerilogOp::Mul => "*",
        VerilogOp::LogicalAnd => "&&",
        VerilogOp::LogicalOr => "||",
        VerilogOp::BitXor => "^",
        VerilogOp::BitAnd => "&",
        VerilogOp::BitOr => "|",
        VerilogOp::Shl => "<<",
        VerilogOp::Shr => ">>",
        VerilogOp::Eq => "==",
        VerilogOp::Lt => "<",
        VerilogOp::Le => "<=",
        VerilogOp::Ne => "!=",
        VerilogOp::Ge => ">=",
        VerilogOp::Gt => ">",
    }
}

/// `32'h1f` as `0x1f`.
fn plain_number(literal: &str) -> String {
    let digits = literal.split_once("'h").map_or(literal, |(_, digits)| digits);
    if digits.len() == 1 && digits.starts_with(|c: char| c.is_ascii_digit()) {
        digits.to_owned()
    } else {
        format!("0x{digits}")
    }
}

/// True when Verilog would read the operators without further parentheses as another tree.
pub(crate) fn groups_differently(e: &VerilogExpression) -> bool {
    let VerilogExpression::Binary(l, op, r) = e else { return false };
    let weaker = |inner: &VerilogExpression, than: u32| matches!(inner, VerilogExpression::Binary(_, op, _) if binding(op) < than);
    weaker(l, binding(op)) || weaker(r, binding(op) + 1)
}

/// How tightly Verilog binds (IEEE 1364-2005, table 5-4); Rust puts comparisons below `|`.
fn binding(op: &VerilogOp) -> u32 {
    match op {
        VerilogOp::Mul => 10,
        VerilogOp::Add | VerilogOp::Sub => 9,
        VerilogOp::Shl | VerilogOp::Shr => 8,
        VerilogOp::Lt | VerilogOp::Le | VerilogOp::Ge | VerilogOp::Gt => 7,
        VerilogOp::Eq | VerilogOp::Ne => 6,
        VerilogOp::BitAnd => 5,
        VerilogOp::BitXor => 4,
        VerilogOp::BitOr => 3,
        VerilogOp::LogicalAnd => 2,
        VerilogOp::LogicalOr => 1,
    }
}
