//! Kernel expressions that mean the same to rust-hdl's simulator and in Verilog.

use rust_hdl::core::ast::{VerilogExpression, VerilogOp};

use crate::expression::{equal, less, less_or_equal, not, slice};
use crate::kernel_text::text;
use crate::scope::{Scope, literal};
use crate::{Expression, NetlistError};

/// Bits at a fixed place of a signal.
pub(crate) fn bits_of(scope: &Scope, e: &VerilogExpression) -> Result<Expression, NetlistError> {
    let (of, width, at) = match e {
        VerilogExpression::Index(of, at) => (of, 1, at),
        VerilogExpression::Slice(of, bits, at) => (of, scope.width(*bits, &text(e))?, at),
        _ => return Err(scope.unsupported(e, "this operation")),
    };
    let VerilogExpression::Signal(name) = of.as_ref() else {
        return Err(scope.unsupported(e, "taking bits of anything but a signal"));
    };
    let of = scope.read(name)?;
    let (_, low) = literal(scope, at)?;
    match u32::try_from(low) {
        Ok(low) if low.saturating_add(width) <= of.width => Ok(slice(of, low, width)),
        _ => Err(scope.unsupported(e, "taking bits beyond the end")),
    }
}

/// The comparison of two equally wide values.
pub(crate) fn compare(op: &VerilogOp, (l, r): (Expression, Expression)) -> Expression {
    match op {
        VerilogOp::Lt => less(l, r),
        VerilogOp::Le => less_or_equal(l, r),
        VerilogOp::Gt => less(r, l),
        VerilogOp::Ge => less_or_equal(r, l),
        VerilogOp::Ne => not(equal(l, r)),
        _ => equal(l, r),
    }
}
