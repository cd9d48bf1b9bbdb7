//! A formula with all its numbers put in.

use exmex::Express;

use super::memory::Kind;
use super::{ALWAYS_THERE, Expression};
use crate::{Effect, Instant, Record};

/// Where a variable gets its value at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    Parameter(usize),
    AlwaysThere(usize),
    Column(usize),
    Remembered(usize),
}

/// A memory with its numbers.
#[derive(Debug)]
pub(super) struct Remembering {
    pub(super) kind: Kind,
    pub(super) of: Source,
    pub(super) arguments: Vec<f64>,
}

/// The formula with its parameters put in, less the same with others.
#[derive(Debug)]
pub(super) struct Bound {
    pub(super) expression: Expression,
    pub(super) sources: Vec<Source>,
    pub(super) memories: Vec<Remembering>,
    pub(super) values: Vec<f64>,
    pub(super) minus: Option<Vec<f64>>,
}

impl Bound {
    /// The formula, `remembered` being the values of its memories.
    fn evaluate(&self, now: &Instant<'_>, remembered: &[f64]) -> f64 {
        let with = |parameters: &[f64]| {
            let values: Vec<_> = self
                .sources
                .iter()
                .map(|source| match source {
                    Source::Parameter(index) => parameters[*index],
                    Source::Remembered(index) => remembered[*index],
                    other => other.read(now),
                })
                .collect();
            self.expression.eval(&values).unwrap_or(f64::NAN)
        };
        with(&self.values) - self.minus.as_deref().map_or(0.0, with)
    }
}

impl Source {
    /// What an instant knows of it; nothing of parameters and memories.
    fn read(self, now: &Instant<'_>) -> f64 {
        match self {
            Self::AlwaysThere(index) => (ALWAYS_THERE[index].1)(now),
            Self::Column(index) => now.covariates.get(index).copied().unwrap_or(f64::NAN),
            Self::Parameter(_) | Self::Remembered(_) => f64::NAN,
        }
    }
}

impl Effect for Bound {
    /// Without samples before it, an instant has been as it is for ever.
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        let at_rest =
            |memory: &Remembering| memory.kind.at_rest(memory.of.read(now), &memory.arguments);
        let remembered: Vec<f64> = self.memories.iter().map(at_rest).collect();
        self.evaluate(now, &remembered)
    }

    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        let of_all = |memory: &Remembering| {
            let led: Vec<f64> = record.instants().map(|now| memory.of.read(&now)).collect();
            memory.kind.values(&led, &record.time_s, &memory.arguments)
        };
        let memories: Vec<Vec<f64>> = self.memories.iter().map(of_all).collect();
        let mut remembered = vec![0.0; memories.len()];
        let at = |(row, now): (usize, Instant<'_>)| {
            for (value, memory) in remembered.iter_mut().zip(&memories) {
                *value = memory[row];
            }
            self.evaluate(&now, &remembered)
        };
        record.instants().enumerate().map(at).collect()
    }

    fn remembers(&self) -> bool {
        !self.memories.is_empty()
    }

    fn feeds_back(&self) -> bool {
        let error = ALWAYS_THERE.len() - 1;
        let of_memories = self.memories.iter().map(|memory| &memory.of);
        self.sources
            .iter()
            .chain(of_memories)
            .any(|source| matches!(source, Source::AlwaysThere(index) if *index == error))
    }
}
