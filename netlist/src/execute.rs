//! One expression per driven signal, from the body's statements in order.
//!
//! A signal read after its last assignment is named; one read between two assignments is written
//! out, so that the result does not depend on order any more.

use std::collections::BTreeMap;

use crate::expression::{equal, select};
use crate::{Expression, Module, NetlistError, SignalId, Statement};

/// What a signal holds at some point of the body.
#[derive(Clone, Debug, PartialEq)]
enum Held {
    /// Assigned on every path so far.
    Always(Expression),
    /// Assigned on some.
    Sometimes,
}

type State = BTreeMap<SignalId, Held>;

/// The value of every signal that the body drives; `block` is for messages.
pub(crate) fn execute(
    module: &Module,
    block: &str,
) -> Result<BTreeMap<SignalId, Expression>, NetlistError> {
    let mut run = Run { module, block, place: 0, last: BTreeMap::new() };
    run.find_last(&module.body);
    run.place = 0;
    let mut state = State::new();
    run.statements(&module.body, &mut state)?;
    run.finish(state)
}

struct Run<'a> {
    module: &'a Module,
    block: &'a str,
    /// Number of the statement, in reading order.
    place: usize,
    /// Where each signal is assigned for the last time.
    last: BTreeMap<SignalId, usize>,
}

impl Run<'_> {
    fn find_last(&mut self, statements: &[Statement]) {
        for statement in statements {
            self.place += 1;
            match statement {
                Statement::Assign { target, .. } => {
                    self.last.insert(*target, self.place);
                }
                Statement::If { then, otherwise, .. } => {
                    self.find_last(then);
                    self.find_last(otherwise);
                }
                Statement::Case { arms, default, .. } => {
                    for (_, body) in arms {
                        self.find_last(body);
                    }
                    self.find_last(default);
                }
            }
        }
    }

    fn statements(
        &mut self,
        statements: &[Statement],
        state: &mut State,
    ) -> Result<(), NetlistError> {
        for statement in statements {
            self.place += 1;
            match statement {
                Statement::Assign { target, value } => {
                    let value = self.current(value, state)?;
                    state.insert(*target, Held::Always(value));
                }
                Statement::If { condition, then, otherwise } => {
                    let condition = self.current(condition, state)?;
                    let mut taken = state.clone();
                    self.statements(then, &mut taken)?;
                    self.statements(otherwise, state)?;
                    *state = merged(&condition, taken, state);
                }
                Statement::Case { of, arms, default } => self.case(of, arms, default, state)?,
            }
        }
        Ok(())
    }

    fn case(
        &mut self,
        of: &Expression,
        arms: &[(u64, Vec<Statement>)],
        default: &[Statement],
        state: &mut State,
    ) -> Result<(), NetlistError> {
        let of = self.current(of, state)?;
        let mut ends = vec![];
        for (code, body) in arms {
            let mut end = state.clone();
            self.statements(body, &mut end)?;
            ends.push((Expression::constant(of.width, *code), end));
        }
        let covers_all = of.width < 64 && arms.len() as u64 == 1 << of.width;
        self.statements(default, state)?;
        if covers_all && let Some((_, end)) = ends.pop() {
            *state = end;
        }
        for (code, end) in ends.into_iter().rev() {
            *state = merged(&equal(of.clone(), code), end, state);
        }
        Ok(())
    }

    /// The expression as it stands here.
    fn current(&self, e: &Expression, state: &State) -> Result<Expression, NetlistError> {
        e.substitute(&mut |id| {
            let signal = self.module.signal(id);
            let named = || Expression::signal(signal.width, id);
            if !signal.role.is_driven_by_body() {
                return Ok(named());
            }
            match state.get(&id) {
                Some(Held::Always(_)) if self.last.get(&id) < Some(&self.place) => Ok(named()),
                Some(Held::Always(value)) => Ok(value.clone()),
                _ => Err(NetlistError::ReadBeforeAssigned {
                    block: self.block.to_owned(),
                    signal: signal.name.clone(),
                }),
            }
        })
    }

    fn finish(&self, mut state: State) -> Result<BTreeMap<SignalId, Expression>, NetlistError> {
        let mut values = BTreeMap::new();
        for (signal, id) in self.module.signals.iter().zip((0..).map(SignalId)) {
            if !signal.role.is_driven_by_body() {
                continue;
            }
            let (block, name) = (self.block.to_owned(), signal.name.clone());
            match state.remove(&id) {
                Some(Held::Always(value)) => values.insert(id, value),
                Some(Held::Sometimes) => {
                    return Err(NetlistError::Latch { block, signal: name });
                }
                None => return Err(NetlistError::Undriven { block, signal: name }),
            };
        }
        Ok(values)
    }
}

/// The state after two branches.
fn merged(condition: &Expression, then: State, otherwise: &State) -> State {
    let mut both = otherwise.clone();
    for held in both.iter_mut().filter(|(id, _)| !then.contains_key(id)) {
        *held.1 = Held::Sometimes;
    }
    for (id, held) in then {
        let value = match (held, otherwise.get(&id)) {
            (Held::Always(a), Some(Held::Always(b))) => {
                Held::Always(select(condition.clone(), a, b.clone()))
            }
            _ => Held::Sometimes,
        };
        both.insert(id, value);
    }
    both
}
