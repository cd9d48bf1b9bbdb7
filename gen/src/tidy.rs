//! Leaves out assignments that a later one overwrites before anybody reads them.
//!
//! `dff_setup!` lets every flip-flop keep its value first; where the next line gives it another one
//! in any case, the first says nothing.

use helixlock_netlist::{Module, SignalId, Statement};

use crate::groups::for_each_expression;

/// The module without them.
pub(crate) fn tidy(module: &Module) -> Module {
    let mut tidied = module.clone();
    let body = &module.body;
    let kept = |place: &usize| !is_overwritten(&body[*place], &body[place + 1..]);
    tidied.body = (0..body.len()).filter(kept).map(|place| body[place].clone()).collect();
    tidied
}

/// True when the first of `later` that touches the statement's target plainly assigns it anew.
fn is_overwritten(statement: &Statement, later: &[Statement]) -> bool {
    let Statement::Assign { target, .. } = statement else { return false };
    let next = later.iter().find(|statement| touches(statement, *target));
    matches!(next, Some(Statement::Assign { value, .. }) if !reads(value, *target))
}

fn touches(statement: &Statement, signal: SignalId) -> bool {
    let mut found = false;
    for_each_expression(statement, &mut |value| found |= reads(value, signal));
    found || assigns(statement, signal)
}

fn reads(value: &helixlock_netlist::Expression, signal: SignalId) -> bool {
    let mut found = false;
    value.for_each_signal(&mut |read| found |= read == signal);
    found
}

fn assigns(statement: &Statement, signal: SignalId) -> bool {
    let any = |body: &[Statement]| body.iter().any(|inner| assigns(inner, signal));
    match statement {
        Statement::Assign { target, .. } => *target == signal,
        Statement::If { then, otherwise, .. } => any(then) || any(otherwise),
        Statement::Case { arms, default, .. } => {
            arms.iter().any(|(_, body)| any(body)) || any(default)
        }
    }
}
