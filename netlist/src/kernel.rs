//! A kernel's statements, with every expression typed and every clock connection checked.

use std::collections::BTreeSet;

use rust_hdl::core::ast::{
    VerilogBlockOrConditional, VerilogCase, VerilogConditional, VerilogExpression, VerilogMatch,
    VerilogStatement,
};

use crate::kernel_text::text;
use crate::meaning;
use crate::scope::{Name, Scope};
use crate::{Expression, ModuleSignal, NetlistError, SignalId, Statement};

/// Reads a kernel.
pub(crate) struct Kernel<'a> {
    pub(crate) scope: &'a Scope,
    pub(crate) signals: &'a [ModuleSignal],
    /// Clocks of flip-flops and blocks inside that were connected, as `digit$clock`.
    pub(crate) clocked: BTreeSet<String>,
}

impl Kernel<'_> {
    /// The statements of the kernel itself; clocks must be connected here.
    pub(crate) fn body(
        &mut self,
        code: &[VerilogStatement],
    ) -> Result<Vec<Statement>, NetlistError> {
        let mut body = vec![];
        for statement in code {
            match statement {
                VerilogStatement::Macro(inner) => body.extend(self.body(inner)?),
                VerilogStatement::Assignment(VerilogExpression::Signal(target), value)
                    if matches!(self.scope.find(target)?, Name::InnerClock) =>
                {
                    self.connect_clock(target, value)?;
                }
                _ => body.extend(self.statement(statement)?),
            }
        }
        Ok(body)
    }

    fn connect_clock(
        &mut self,
        target: &str,
        value: &VerilogExpression,
    ) -> Result<(), NetlistError> {
        let is_own_clock = match value {
            VerilogExpression::Signal(name) => matches!(self.scope.find(name)?, Name::Clock),
            _ => false,
        };
        let inner = target.strip_suffix("$next").unwrap_or(target);
        if is_own_clock {
            self.clocked.insert(inner.to_owned());
            return Ok(());
        }
        Err(self.clock_error(inner, "another signal"))
    }

    fn clock_error(&self, target: &str, found: &'static str) -> NetlistError {
        let target = target.replace('$', ".");
        NetlistError::Clock { block: self.scope.block.clone(), target, found }
    }

    fn block(&self, code: &[VerilogStatement]) -> Result<Vec<Statement>, NetlistError> {
        let statements: Result<Vec<_>, _> = code.iter().map(|s| self.statement(s)).collect();
        Ok(statements?.into_iter().flatten().collect())
    }

    fn statement(&self, statement: &VerilogStatement) -> Result<Vec<Statement>, NetlistError> {
        match statement {
            VerilogStatement::Assignment(target, value) => self.assign(target, value),
            VerilogStatement::If(branches) => self.branch(branches),
            VerilogStatement::Match(cases) => self.case(cases),
            VerilogStatement::Comment(_) => Ok(vec![]),
            VerilogStatement::Macro(inner) => self.block(inner),
            VerilogStatement::SliceAssignment { base, .. } => {
                Err(self.scope.unsupported(base, "assigning single bits"))
            }
            VerilogStatement::Loop(repeat) => Err(self.scope.refuse(&repeat.index, "a `for` loop")),
            VerilogStatement::Link(_) => Err(self.scope.refuse("link", "an interface")),
        }
    }

    fn assign(
        &self,
        target: &VerilogExpression,
        value: &VerilogExpression,
    ) -> Result<Vec<Statement>, NetlistError> {
        let VerilogExpression::Signal(name) = target else {
            return Err(self.scope.unsupported(target, "assigning to this"));
        };
        let (target, width) = match self.scope.find(name)? {
            Name::Data(id, width) | Name::WriteOnly(id, width) => (id, width),
            Name::InnerClock => return Err(self.clock_error(name, "a branch")),
            Name::Clock | Name::State(_) => {
                return Err(self.scope.refuse(name, "assigning to this"));
            }
        };
        self.check_free(target)?;
        Ok(vec![Statement::Assign { target, value: self.value(value, width)? }])
    }

    fn check_free(&self, target: SignalId) -> Result<(), NetlistError> {
        use crate::Role::{Constant, Input, InstanceOutput, RegisterOutput};
        let signal = &self.signals[target.0 as usize];
        let driver = match signal.role {
            Input => "an input",
            Constant(_) => "a constant",
            RegisterOutput => "the output of a flip-flop",
            InstanceOutput => "the output of a block inside",
            _ => return Ok(()),
        };
        let (block, signal) = (self.scope.block.clone(), signal.name.clone());
        Err(NetlistError::DrivenTwice { block, signal, driver })
    }

    fn branch(&self, branches: &VerilogConditional) -> Result<Vec<Statement>, NetlistError> {
        let otherwise = match &branches.otherwise {
            VerilogBlockOrConditional::Block(code) => self.block(code)?,
            VerilogBlockOrConditional::Conditional(next) => self.statement(next)?,
            VerilogBlockOrConditional::None => vec![],
        };
        Ok(vec![Statement::If {
            condition: self.value(&branches.test, 1)?,
            then: self.block(&branches.then)?,
            otherwise,
        }])
    }

    fn case(&self, cases: &VerilogMatch) -> Result<Vec<Statement>, NetlistError> {
        let VerilogExpression::Signal(name) = &cases.test else {
            return Err(self.scope.unsupported(&cases.test, "`match` on anything but a signal"));
        };
        let of = self.scope.read(name)?;
        let (mut arms, mut default) = (vec![], vec![]);
        for case in &cases.cases {
            let body = self.block(&case.block)?;
            match case.condition.as_str() {
                "default" => default = body,
                _ => arms.push((self.arm(case, &arms, of.width)?, body)),
            }
        }
        Ok(vec![Statement::Case { of, arms, default }])
    }

    fn arm(
        &self,
        case: &VerilogCase,
        before: &[(u64, Vec<Statement>)],
        width: u32,
    ) -> Result<u64, NetlistError> {
        let code = match self.scope.names.get(&case.condition) {
            Some(Name::State(code)) => Some(*code),
            _ => case.condition.replace('_', "").parse().ok(),
        };
        let unfit = || NetlistError::Literal {
            block: self.scope.block.clone(),
            literal: case.condition.clone(),
            expected: width,
        };
        let code = code.filter(|&c| c <= crate::mask(width)).ok_or_else(unfit)?;
        if before.iter().any(|(earlier, _)| *earlier == code) {
            return Err(self.scope.refuse(&case.condition, "a second arm for the same value"));
        }
        Ok(code)
    }

    fn value(&self, e: &VerilogExpression, width: u32) -> Result<Expression, NetlistError> {
        let name = |id: SignalId| self.signals[id.0 as usize].name.clone();
        let value = meaning::value(self.scope, e, width, &name)?;
        if value.has_cut_arithmetic() {
            let text = text(e);
            return Err(self.scope.refuse(&text, "taking bits of a computed value"));
        }
        Ok(value)
    }
}
