//! Splits a body into parts that do not depend on each other's order.
//!
//! A part that is one plain assignment becomes an `assign`; the others become an `always @*`
//! each, so that no process drives what it waits for through another block.

use std::collections::BTreeMap;

use helixlock_netlist::{Expression, Module, SignalId, Statement};

/// Statements that belong together, in order.
#[derive(Debug)]
pub(crate) struct Group<'a> {
    pub(crate) statements: Vec<&'a Statement>,
}

impl<'a> Group<'a> {
    /// Target and value when it is one plain assignment.
    pub(crate) fn as_assignment(&self) -> Option<(SignalId, &'a Expression)> {
        match self.statements[..] {
            [Statement::Assign { target, value }] => Some((*target, value)),
            _ => None,
        }
    }

    /// True when it assigns the signal.
    pub(crate) fn assigns(&self, signal: SignalId) -> bool {
        let mut found = false;
        for statement in &self.statements {
            for_each_target(statement, &mut |target| found |= target == signal);
        }
        found
    }
}

/// The groups of a body, in order of their last statement: what a group reads stands above it.
pub(crate) fn groups(module: &Module) -> Vec<Group<'_>> {
    let mut writers: BTreeMap<SignalId, Vec<usize>> = BTreeMap::new();
    for (place, statement) in module.body.iter().enumerate() {
        for_each_target(statement, &mut |target| writers.entry(target).or_default().push(place));
    }
    let mut leader: Vec<usize> = (0..module.body.len()).collect();
    for places in writers.values() {
        for &place in places {
            join(&mut leader, places[0], place);
        }
    }
    for (place, statement) in module.body.iter().enumerate() {
        for_each_read(statement, &mut |signal| {
            // What is assigned again further down is read at a passing value.
            if let Some(last) = writers.get(&signal).and_then(|places| places.last())
                && place < *last
            {
                join(&mut leader, *last, place);
            }
        });
    }
    let mut groups: BTreeMap<usize, Vec<&Statement>> = BTreeMap::new();
    for (place, statement) in module.body.iter().enumerate() {
        groups.entry(find(&leader, place)).or_default().push(statement);
    }
    groups.into_values().map(|statements| Group { statements }).collect()
}

fn find(leader: &[usize], mut place: usize) -> usize {
    while leader[place] != place {
        place = leader[place];
    }
    place
}

/// Joins two groups; the later statement leads.
fn join(leader: &mut [usize], a: usize, b: usize) {
    let (a, b) = (find(leader, a), find(leader, b));
    leader[a.min(b)] = a.max(b);
}

/// Calls `visit` with every signal a statement assigns.
fn for_each_target(statement: &Statement, visit: &mut impl FnMut(SignalId)) {
    match statement {
        Statement::Assign { target, .. } => visit(*target),
        Statement::If { then, otherwise, .. } => {
            for inner in then.iter().chain(otherwise) {
                for_each_target(inner, visit);
            }
        }
        Statement::Case { arms, default, .. } => {
            for inner in arms.iter().flat_map(|(_, body)| body).chain(default) {
                for_each_target(inner, visit);
            }
        }
    }
}

/// Calls `visit` with every expression of a statement.
pub(crate) fn for_each_expression(statement: &Statement, visit: &mut impl FnMut(&Expression)) {
    match statement {
        Statement::Assign { value, .. } => visit(value),
        Statement::If { condition, then, otherwise } => {
            visit(condition);
            for inner in then.iter().chain(otherwise) {
                for_each_expression(inner, visit);
            }
        }
        Statement::Case { of, arms, default } => {
            visit(of);
            for inner in arms.iter().flat_map(|(_, body)| body).chain(default) {
                for_each_expression(inner, visit);
            }
        }
    }
}

fn for_each_read(statement: &Statement, visit: &mut impl FnMut(SignalId)) {
    for_each_expression(statement, &mut |e| e.for_each_signal(visit));
}
