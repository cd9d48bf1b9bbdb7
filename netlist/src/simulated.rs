//! Kernel expressions as rust-hdl's simulator computes them: every operator at the width of its
//! Rust operands, literals as wide as what they meet.

use rust_hdl::core::ast::{VerilogExpression, VerilogOp, VerilogOpUnary};

use crate::agreed::{bits_of, compare};
use crate::expression::{
    add, all, and, any, not, or, parity, resize, shift_down, shift_up, significant, subtract, xor,
};
use crate::kernel_text::text;
use crate::scope::{Name, Scope, literal};
use crate::{Expression, NetlistError, mask};

/// The value; `expected` is the width a bare literal takes.
pub(crate) fn value(
    scope: &Scope,
    e: &VerilogExpression,
    expected: u32,
) -> Result<Expression, NetlistError> {
    match e {
        VerilogExpression::Signal(name) => match scope.find(name)? {
            Name::State(code) => Ok(Expression::constant(expected, code)),
            _ => scope.read(name),
        },
        VerilogExpression::Literal(_) => number(scope, e, expected),
        VerilogExpression::Paren(a) => value(scope, a, expected),
        VerilogExpression::Cast(a, bits) => {
            let width = scope.width(*bits, "cast")?;
            Ok(resize(value(scope, a, width)?, width))
        }
        VerilogExpression::Unary(op, a) => unary(scope, op, a, expected),
        VerilogExpression::Binary(l, op, r) => binary(scope, e, (l, op, r), expected),
        VerilogExpression::Index(..) | VerilogExpression::Slice(..) => bits_of(scope, e),
        _ => Err(scope.unsupported(e, "this operation")),
    }
}

/// The width Rust's types give the expression; none for a bare literal.
fn own_width(scope: &Scope, e: &VerilogExpression) -> Result<Option<u32>, NetlistError> {
    use VerilogOp::{Add, BitAnd, BitOr, BitXor, Shl, Shr, Sub};
    Ok(match e {
        VerilogExpression::Signal(name) => match scope.find(name)? {
            Name::State(_) => None,
            _ => Some(scope.read(name)?.width),
        },
        // Only `bool` literals are one bit wide.
        VerilogExpression::Literal(_) => Some(literal(scope, e)?.0).filter(|&width| width == 1),
        VerilogExpression::Paren(a)
        | VerilogExpression::Unary(VerilogOpUnary::Not | VerilogOpUnary::Neg, a)
        | VerilogExpression::Binary(a, Shl | Shr, _) => own_width(scope, a)?,
        VerilogExpression::Cast(_, bits) | VerilogExpression::Slice(_, bits, _) => {
            Some(scope.width(*bits, &text(e))?)
        }
        VerilogExpression::Binary(l, Add | Sub | BitAnd | BitOr | BitXor, r) => {
            own_width(scope, l)?.max(own_width(scope, r)?)
        }
        _ => Some(1),
    })
}

fn number(scope: &Scope, e: &VerilogExpression, expected: u32) -> Result<Expression, NetlistError> {
    let (width, value) = literal(scope, e)?;
    let width = if width == 1 { 1 } else { expected };
    if value <= mask(width) {
        return Ok(Expression::constant(width, value));
    }
    Err(NetlistError::Literal { block: scope.block.clone(), literal: text(e), expected: width })
}

fn unary(
    scope: &Scope,
    op: &VerilogOpUnary,
    a: &VerilogExpression,
    expected: u32,
) -> Result<Expression, NetlistError> {
    let a = value(scope, a, expected)?;
    Ok(match op {
        VerilogOpUnary::Not => not(a),
        VerilogOpUnary::Neg => subtract(Expression::constant(a.width, 0), a),
        VerilogOpUnary::All => all(a),
        VerilogOpUnary::Any => any(a),
        VerilogOpUnary::Xor => parity(a),
    })
}

fn binary(
    scope: &Scope,
    e: &VerilogExpression,
    (l, op, r): (&VerilogExpression, &VerilogOp, &VerilogExpression),
    expected: u32,
) -> Result<Expression, NetlistError> {
    use VerilogOp::{
        Add, BitAnd, BitOr, BitXor, Eq, Ge, Gt, Le, LogicalAnd, LogicalOr, Lt, Ne, Shl, Shr, Sub,
    };
    let own = own_width(scope, l)?.max(own_width(scope, r)?);
    let both = |width| Ok((value(scope, l, width)?, value(scope, r, width)?));
    match op {
        Shl | Shr => shift(scope, value(scope, l, expected)?, op, r),
        Lt | Le | Gt | Ge | Eq | Ne => {
            let sides = same_width(scope, e, both(own.unwrap_or(64))?)?;
            Ok(compare(op, sides))
        }
        LogicalAnd => both(1).map(|(l, r)| and(l, r)),
        LogicalOr => both(1).map(|(l, r)| or(l, r)),
        // `Bits<N> + bool` is the one sum of unequal widths that Rust's types allow.
        Add => {
            let (l, r) = both(own.unwrap_or(expected))?;
            let r = if r.width == 1 { resize(r, l.width) } else { r };
            same_width(scope, e, (l, r)).map(|(l, r)| add(l, r))
        }
        Sub | BitAnd | BitOr | BitXor => {
            let (l, r) = same_width(scope, e, both(own.unwrap_or(expected))?)?;
            Ok(match op {
                Sub => subtract(l, r),
                BitAnd => and(l, r),
                BitOr => or(l, r),
                _ => xor(l, r),
            })
        }
        VerilogOp::Mul => Err(scope.unsupported(e, "multiplication")),
    }
}

fn shift(
    scope: &Scope,
    left: Expression,
    op: &VerilogOp,
    by: &VerilogExpression,
) -> Result<Expression, NetlistError> {
    let width = left.width;
    let amount = value(scope, by, 64)?;
    let amount = match amount.as_constant() {
        Some(by) => Expression::constant(width, by.min(u64::from(width))),
        None if significant(&amount) <= width => resize(amount, width),
        None => {
            return Err(scope.unsupported(by, "a shift amount wider than the value shifted"));
        }
    };
    Ok(match op {
        VerilogOp::Shl => shift_up(left, amount),
        _ => shift_down(left, amount),
    })
}

fn same_width(
    scope: &Scope,
    e: &VerilogExpression,
    (l, r): (Expression, Expression),
) -> Result<(Expression, Expression), NetlistError> {
    if l.width == r.width {
        return Ok((l, r));
    }
    Err(NetlistError::Width {
        block: scope.block.clone(),
        text: text(e),
        found: r.width as usize,
        expected: l.width as usize,
    })
}
