//! One-bit logic outside all blocks as functions of a few bits each, small enough to be looked up.
//!
//! As a mapper for an FPGA does: a function takes in the logic before it as long as no more bits
//! enter than a table may have; then part of that logic becomes a function of its own.

use std::collections::{BTreeMap, BTreeSet};

use super::plan::Plan;
use super::words::Gate;

/// Bits that may enter a function, of which a table then takes 16 KB. Measured on the device: with
/// one less a clock takes 5 % longer, with one more 10 to 50 %.
pub(super) const MOST_ENTERING: usize = 11;

/// For every word, what it is a function of.
pub(super) struct Cuts {
    /// By word: the one-bit words it is a function of; itself alone where nothing is to be looked
    /// up; absent when something wider enters.
    entering: BTreeMap<usize, BTreeSet<usize>>,
    /// Words of one bit.
    bits: BTreeSet<usize>,
}

impl Cuts {
    pub(super) fn new(plan: &Plan) -> Self {
        let words = plan.words.all().iter().enumerate();
        let bits = words.filter(|(_, word)| word.width == 1).map(|(index, _)| index).collect();
        let mut cuts = Self { entering: BTreeMap::new(), bits };
        for word in 0..plan.words.all().len() {
            let entering = cuts.of_operands(plan, word);
            if let Some(entering) = entering {
                cuts.entering.insert(word, entering);
            } else if cuts.bits.contains(&word) {
                cuts.entering.insert(word, BTreeSet::from([word]));
            }
        }
        cuts
    }

    /// What enters a function, if the word is one.
    pub(super) fn entering(&self, word: usize) -> Option<&BTreeSet<usize>> {
        let entering = self.entering.get(&word).filter(|_| self.bits.contains(&word));
        entering.filter(|entering| !entering.contains(&word))
    }

    /// True for a word of one bit.
    pub(super) fn is_bit(&self, word: usize) -> bool {
        self.bits.contains(&word)
    }

    /// Look-ups one after the other until a word is known.
    pub(super) fn depth(&self, word: usize) -> usize {
        let before =
            |entering: &BTreeSet<usize>| entering.iter().map(|word| self.depth(*word)).max();
        self.entering(word).map_or(0, |entering| 1 + before(entering).unwrap_or(0))
    }

    fn of_operands(&self, plan: &Plan, word: usize) -> Option<BTreeSet<usize>> {
        let is_inverter = matches!(plan.words.all()[word].gate, Some(Gate::Not(_)));
        if plan.is_read(word) || plan.is_steady(word) && !is_inverter {
            return None;
        }
        let mut operands = plan.words.all()[word].operands.clone();
        let mut own: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        operands.sort_unstable();
        for operand in operands {
            own.insert(operand, self.entering.get(&operand)?.clone());
        }
        while MOST_ENTERING < union(own.values()).len() {
            let bits = own.iter().filter(|(word, _)| self.bits.contains(word));
            let largest = bits.max_by_key(|(_, entering)| entering.len());
            let (word, _) = largest.filter(|(_, entering)| 1 < entering.len())?;
            own.insert(*word, BTreeSet::from([*word]));
        }
        Some(union(own.values()))
    }
}

/// All words of several sets.
pub(super) fn union<'a>(sets: impl Iterator<Item = &'a BTreeSet<usize>>) -> BTreeSet<usize> {
    sets.flatten().copied().collect()
}
