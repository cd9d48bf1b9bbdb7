//! Evaluation order: by level, so that each assignment reads only what stands before it.

use std::collections::BTreeMap;

use crate::{Assignment, NetlistError, Signal, SignalId};

/// The assignments in order of level, then of target.
pub(crate) fn ordered(
    signals: &[Signal],
    mut assignments: Vec<Assignment>,
) -> Result<Vec<Assignment>, NetlistError> {
    let drivers: BTreeMap<SignalId, &Assignment> =
        assignments.iter().map(|assignment| (assignment.target, assignment)).collect();
    let mut levels = Levels { drivers, known: BTreeMap::new(), open: vec![], signals };
    for target in levels.drivers.keys().copied().collect::<Vec<_>>() {
        levels.of(target)?;
    }
    let known = levels.known;
    assignments.sort_by_key(|assignment| (known.get(&assignment.target), assignment.target));
    Ok(assignments)
}

struct Levels<'a> {
    drivers: BTreeMap<SignalId, &'a Assignment>,
    known: BTreeMap<SignalId, u32>,
    open: Vec<SignalId>,
    signals: &'a [Signal],
}

impl Levels<'_> {
    /// Assignments on the longest way from a register or an input to this signal.
    fn of(&mut self, target: SignalId) -> Result<u32, NetlistError> {
        let Some(&assignment) = self.drivers.get(&target) else { return Ok(0) };
        if let Some(&level) = self.known.get(&target) {
            return Ok(level);
        }
        if let Some(start) = self.open.iter().position(|&open| open == target) {
            return Err(self.closed_loop(start));
        }
        self.open.push(target);
        let mut read = vec![];
        assignment.value.for_each_signal(&mut |id| read.push(id));
        let mut level = 0;
        for id in read {
            level = level.max(self.of(id)?);
        }
        self.open.pop();
        self.known.insert(target, level + 1);
        Ok(level + 1)
    }

    fn closed_loop(&self, start: usize) -> NetlistError {
        let around = self.open[start..].iter().chain(self.open.get(start));
        let path = around.map(|id| self.signals[id.0 as usize].path.clone());
        NetlistError::Loop { path: path.collect() }
    }
}
