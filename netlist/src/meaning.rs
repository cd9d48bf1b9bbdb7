//! What a kernel expression computes: read twice, once as Verilog and once as rust-hdl's
//! simulator, and accepted only when both agree.

use rust_hdl::core::ast::VerilogExpression;

use crate::kernel_text::{groups_differently, text};
use crate::scope::Scope;
use crate::{Expression, NetlistError, SignalId, simulated, synthesised};

/// The value of `e` where `width` bits are wanted.
pub(crate) fn value(
    scope: &Scope,
    e: &VerilogExpression,
    width: u32,
    name: &dyn Fn(SignalId) -> String,
) -> Result<Expression, NetlistError> {
    check_grouping(scope, e)?;
    let simulator = simulated::value(scope, e, width)?;
    let verilog = synthesised::value(scope, e, width)?;
    if simulator.width != width {
        return Err(NetlistError::Width {
            block: scope.block.clone(),
            text: text(e),
            found: simulator.width as usize,
            expected: width as usize,
        });
    }
    if simulator == verilog {
        return Ok(verilog);
    }
    Err(NetlistError::TwoMeanings {
        block: scope.block.clone(),
        expression: text(e),
        simulator: simulator.verilog(name),
        verilog: verilog.verilog(name),
    })
}

fn check_grouping(scope: &Scope, e: &VerilogExpression) -> Result<(), NetlistError> {
    if groups_differently(e) {
        return Err(NetlistError::Precedence { block: scope.block.clone(), expression: text(e) });
    }
    children(e).into_iter().try_for_each(|child| check_grouping(scope, child))
}

fn children(e: &VerilogExpression) -> Vec<&VerilogExpression> {
    match e {
        VerilogExpression::Signal(_) | VerilogExpression::Literal(_) => vec![],
        VerilogExpression::Cast(a, _)
        | VerilogExpression::Signed(a)
        | VerilogExpression::Unsigned(a)
        | VerilogExpression::Paren(a)
        | VerilogExpression::Unary(_, a) => vec![a],
        VerilogExpression::Binary(a, _, b)
        | VerilogExpression::Index(a, b)
        | VerilogExpression::Slice(a, _, b) => vec![a, b],
        VerilogExpression::IndexReplace(a, b, c) => vec![a, b, c],
    }
}
