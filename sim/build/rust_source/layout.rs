//! Which bit of a word each one-bit register has, and each bit that is computed beside them.
//!
//! A register that copies another stands right above it, so that one shift moves all chains. What
//! enters one table stands together as far as chains leave room, so that few runs make its index.

use std::collections::{BTreeMap, BTreeSet};

use super::plan::Plan;
use super::tables::Table;
use super::words::number;

/// Bits of a word.
pub(super) const BITS: usize = u64::BITS as usize;

/// Where bits stand.
#[derive(Default)]
pub(super) struct Layout {
    /// By the word that each is.
    pub(super) words: BTreeMap<usize, u32>,
    /// By register.
    pub(super) registers: BTreeMap<usize, u32>,
}

impl Layout {
    /// Gives every packed register a bit, and words `beside` them that enter tables what is left.
    pub(super) fn new(plan: &Plan, packed: &[usize], tables: &[Table], beside: &[usize]) -> Self {
        let register_of: BTreeMap<usize, usize> = packed
            .iter()
            .filter_map(|register| Some((plan.leaf_of(*register)?, *register)))
            .collect();
        let mut chains = chains(plan, &register_of);
        let placed: BTreeSet<usize> = chains.iter().flatten().copied().collect();
        let others = beside.iter().filter(|word| !placed.contains(word));
        chains.extend(others.map(|word| vec![*word]));
        let enters =
            |chain: &[usize], table: &Table| chain.iter().any(|word| table.entering.contains(word));
        // What enters none comes last, if there is room.
        chains.sort_by_key(|chain| {
            tables.iter().position(|table| enters(chain, table)).unwrap_or(tables.len())
        });
        let mut layout = Self::default();
        let mut room = BITS - packed.len();
        for word in chains.into_iter().flatten() {
            if let Some(register) = register_of.get(&word) {
                let bit = layout.add_register(*register);
                layout.words.insert(word, bit);
            } else if 0 < room {
                room -= 1;
                layout.words.insert(word, layout.next_bit());
            }
        }
        let unread = packed.iter().filter(|register| plan.leaf_of(**register).is_none());
        for register in unread {
            layout.add_register(*register);
        }
        layout
    }

    fn add_register(&mut self, register: usize) -> u32 {
        let bit = self.next_bit();
        self.registers.insert(register, bit);
        bit
    }

    fn next_bit(&self) -> u32 {
        let bits = self.words.values().chain(self.registers.values());
        bits.max().map_or(0, |last| last + 1)
    }
}

/// Words of which each but the first is a packed register that copies the one before; all packed
/// registers that somebody reads are in one.
fn chains(plan: &Plan, register_of: &BTreeMap<usize, usize>) -> Vec<Vec<usize>> {
    let before = |word: &usize| number(plan.next[register_of[word]]);
    let is_copy = |word: &usize| before(word).is_some_and(|word| register_of.contains_key(&word));
    let (copies, heads): (Vec<usize>, Vec<usize>) =
        register_of.keys().partition(|word| is_copy(word));
    let mut open: BTreeSet<usize> = register_of.keys().copied().collect();
    let mut sources = BTreeSet::new();
    let mut chains = vec![];
    // Of what is left when heads have been followed, a ring or a second copy, any may be the first.
    for head in heads.into_iter().chain(copies) {
        if !open.contains(&head) {
            continue;
        }
        let source = before(&head).filter(|word| plan.is_steady(*word) && sources.insert(*word));
        let mut chain = Vec::from_iter(source);
        let mut last = Some(head);
        while let Some(word) = last {
            open.remove(&word);
            chain.push(word);
            last = open.iter().copied().find(|next| before(next) == Some(word));
        }
        chains.push(chain);
    }
    chains
}
