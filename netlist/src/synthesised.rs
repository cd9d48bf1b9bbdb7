//! Kernel expressions as Verilog reads them (IEEE 1364-2005, 5.4): operands of arithmetic are first
//! extended to the widest of them and of the target, literals counting as 32 bits.

use rust_hdl::core::ast::{VerilogExpression, VerilogOp, VerilogOpUnary};

use crate::agreed::{bits_of, compare};
use crate::expression::{
    add, all, and, any, not, or, parity, resize, shift_down, shift_up, significant, subtract, xor,
};
use crate::scope::{Name, Scope, literal};
use crate::{Expression, NetlistError, mask};

/// Unsized numbers and enum codes are this wide.
const UNSIZED: u32 = 32;

/// The value an assignment to `width` bits takes.
pub(crate) fn value(
    scope: &Scope,
    e: &VerilogExpression,
    width: u32,
) -> Result<Expression, NetlistError> {
    let context = width.max(own_width(scope, e)?);
    Ok(resize(in_context(scope, e, context)?, width))
}

/// Width of the expression standing alone.
fn own_width(scope: &Scope, e: &VerilogExpression) -> Result<u32, NetlistError> {
    match e {
        VerilogExpression::Signal(name) => match scope.find(name)? {
            Name::State(_) => Ok(UNSIZED),
            _ => Ok(scope.read(name)?.width),
        },
        VerilogExpression::Literal(_) => Ok(literal(scope, e)?.0),
        VerilogExpression::Paren(a) => own_width(scope, a),
        VerilogExpression::Cast(a, bits) => {
            Ok(own_width(scope, a)?.max(scope.width(*bits, "cast")?))
        }
        VerilogExpression::Unary(VerilogOpUnary::Not | VerilogOpUnary::Neg, a) => {
            own_width(scope, a)
        }
        VerilogExpression::Binary(l, op, r) => match op {
            VerilogOp::Shl | VerilogOp::Shr => own_width(scope, l),
            _ if is_boolean(op) => Ok(1),
            _ => Ok(own_width(scope, l)?.max(own_width(scope, r)?)),
        },
        VerilogExpression::Slice(_, bits, _) => scope.width(*bits, "slice"),
        VerilogExpression::Unary(..) | VerilogExpression::Index(..) => Ok(1),
        _ => Err(scope.unsupported(e, "this operation")),
    }
}

fn is_boolean(op: &VerilogOp) -> bool {
    use VerilogOp::{Eq, Ge, Gt, Le, LogicalAnd, LogicalOr, Lt, Ne};
    matches!(op, Eq | Ge | Gt | Le | LogicalAnd | LogicalOr | Lt | Ne)
}

/// The expression computed at `width` bits, which are at least its own.
fn in_context(
    scope: &Scope,
    e: &VerilogExpression,
    width: u32,
) -> Result<Expression, NetlistError> {
    match e {
        VerilogExpression::Signal(name) => match scope.find(name)? {
            Name::State(code) => Ok(Expression::constant(width, code)),
            _ => Ok(resize(scope.read(name)?, width)),
        },
        VerilogExpression::Literal(_) => Ok(Expression::constant(width, literal(scope, e)?.1)),
        VerilogExpression::Paren(a) => in_context(scope, a, width),
        // rust-hdl writes a cast as `value & mask`.
        VerilogExpression::Cast(a, bits) => {
            let ones = Expression::constant(width, mask(scope.width(*bits, "cast")?));
            Ok(and(in_context(scope, a, width)?, ones))
        }
        VerilogExpression::Unary(op, a) => unary(scope, op, a, width),
        VerilogExpression::Binary(l, op, r) if is_boolean(op) => {
            Ok(resize(boolean(scope, l, op, r)?, width))
        }
        VerilogExpression::Binary(l, op, r) => {
            let left = in_context(scope, l, width)?;
            match op {
                VerilogOp::Shl => Ok(shift_up(left, amount(scope, r, width)?)),
                VerilogOp::Shr => Ok(shift_down(left, amount(scope, r, width)?)),
                _ => arithmetic(scope, e, left, op, in_context(scope, r, width)?),
            }
        }
        VerilogExpression::Index(..) | VerilogExpression::Slice(..) => {
            Ok(resize(bits_of(scope, e)?, width))
        }
        _ => Err(scope.unsupported(e, "this operation")),
    }
}

fn unary(
    scope: &Scope,
    op: &VerilogOpUnary,
    a: &VerilogExpression,
    width: u32,
) -> Result<Expression, NetlistError> {
    let alone = |a| in_context(scope, a, own_width(scope, a)?);
    Ok(match op {
        VerilogOpUnary::Not => not(in_context(scope, a, width)?),
        VerilogOpUnary::Neg => {
            subtract(Expression::constant(width, 0), in_context(scope, a, width)?)
        }
        VerilogOpUnary::All => resize(all(alone(a)?), width),
        VerilogOpUnary::Any => resize(any(alone(a)?), width),
        VerilogOpUnary::Xor => resize(parity(alone(a)?), width),
    })
}

/// A shift amount, which stands alone in Verilog, as wide as the value shifted.
fn amount(scope: &Scope, e: &VerilogExpression, width: u32) -> Result<Expression, NetlistError> {
    let by = in_context(scope, e, own_width(scope, e)?)?;
    match by.as_constant() {
        Some(by) => Ok(Expression::constant(width, by.min(u64::from(width)))),
        None if significant(&by) <= width => Ok(resize(by, width)),
        None => Err(scope.unsupported(e, "a shift amount wider than the value shifted")),
    }
}

fn arithmetic(
    scope: &Scope,
    e: &VerilogExpression,
    l: Expression,
    op: &VerilogOp,
    r: Expression,
) -> Result<Expression, NetlistError> {
    Ok(match op {
        VerilogOp::Add => add(l, r),
        VerilogOp::Sub => subtract(l, r),
        VerilogOp::BitAnd => and(l, r),
        VerilogOp::BitOr => or(l, r),
        VerilogOp::BitXor => xor(l, r),
        _ => return Err(scope.unsupported(e, "multiplication")),
    })
}

fn boolean(
    scope: &Scope,
    l: &VerilogExpression,
    op: &VerilogOp,
    r: &VerilogExpression,
) -> Result<Expression, NetlistError> {
    let (left, right) = (own_width(scope, l)?, own_width(scope, r)?);
    let widest = left.max(right);
    let alone = |e, width| in_context(scope, e, width).map(any);
    let both = || Ok((in_context(scope, l, widest)?, in_context(scope, r, widest)?));
    Ok(match op {
        VerilogOp::LogicalAnd => and(alone(l, left)?, alone(r, right)?),
        VerilogOp::LogicalOr => or(alone(l, left)?, alone(r, right)?),
        _ => compare(op, both()?),
    })
}
