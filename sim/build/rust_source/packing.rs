//! One-bit registers and what is known with them as bits of one word, and the functions of them
//! that are looked up.
//!
//! One word a bit costs a load, a store and an operation each. Packed, a chain of flip-flops is
//! shifted by one operation, and some ten bits at once are the index of a table that holds all that
//! follows from them. The word is called `known`; what tables say of it is `found`.

use std::collections::{BTreeMap, BTreeSet};

use super::blocks::Block;
use super::cuts::Cuts;
use super::layout::{BITS, Layout};
use super::plan::{Kept, Plan};
use super::tables::{Table, tables, with_entering};
use super::words::number;

/// What stands where.
pub(super) struct Packing {
    /// Bits of `known`, by the word that each is.
    pub(super) bits: BTreeMap<usize, u32>,
    /// Bits of `known` that are registers, by register; the others are steady.
    pub(super) registers: BTreeMap<usize, u32>,
    /// Bits of `known` that are steady, and when they are to be computed anew.
    pub(super) steady: Vec<Kept>,
    /// Bits of `found`, by the function that each is; the next value of a register stands where the
    /// register does.
    pub(super) places: BTreeMap<usize, u32>,
    pub(super) tables: Vec<Table>,
}

impl Packing {
    pub(super) fn new(plan: &Plan) -> Self {
        let cuts = Cuts::new(plan);
        let packed = packed(plan, &cuts);
        let next = packed.iter().filter_map(|register| number(plan.next[*register]));
        let needed: Vec<usize> = next.chain(needed(plan, &cuts, &packed)).collect();
        let mut functions = with_entering(&cuts, &needed);
        functions.truncate(BITS);
        let tables = tables(&cuts, &functions);
        let layout = Layout::new(plan, &packed, &tables);
        let places = places(plan, &layout, &functions);
        let steady = layout.words.keys().filter(|word| plan.is_steady(**word));
        let steady = steady.map(|word| plan.kept(*word)).collect();
        let Layout { words: bits, registers } = layout;
        Self { bits, registers, steady, places, tables }
    }

    /// Registers that are neither packed nor in a block.
    pub(super) fn left_outside(&self, plan: &Plan) -> Vec<usize> {
        let outside = plan.blocks.outside.iter().copied();
        outside.filter(|register| !self.registers.contains_key(register)).collect()
    }

    /// True when all that blocks need besides their own registers and inputs is a bit of `known` or
    /// of `found`.
    pub(super) fn gives_all_to_blocks(&self, plan: &Plan) -> bool {
        let given = self.bits.keys().chain(self.places.keys()).copied().collect();
        let needed = plan.cone_up_to(plan.needed_by_blocks(), &given);
        let outside = self.left_outside(plan);
        let mut read = outside.into_iter().filter_map(|register| plan.leaf_of(register));
        !read.any(|word| needed.contains(&word))
    }

    /// The bit of `found` that says whether a block is active, if one does.
    pub(super) fn active(&self, block: &Block) -> Option<u64> {
        self.places.get(&number(block.active)?).map(|place| 1 << place)
    }

    /// The bits that enter a table, lowest first, and the words that stand alone.
    pub(super) fn entering(&self, table: &Table) -> (BTreeMap<u32, usize>, Vec<usize>) {
        let bit = |word: &usize| Some((*self.bits.get(word)?, *word));
        let bits = table.entering.iter().filter_map(bit).collect();
        let alone = table.entering.iter().filter(|word| !self.bits.contains_key(word));
        (bits, alone.copied().collect())
    }
}

/// One-bit registers outside all blocks; but none that is known only after one look-up has followed
/// another, for which all others would wait.
fn packed(plan: &Plan, cuts: &Cuts) -> Vec<usize> {
    let fits = |register: &usize| {
        plan.is_bit(*register)
            && number(plan.next[*register]).is_none_or(|word| cuts.depth(word) <= 1)
    };
    let outside = plan.blocks.outside.iter().copied();
    outside.filter(fits).take(BITS).collect()
}

/// Words computed outside all blocks that blocks, or registers left outside, are computed from.
fn needed(plan: &Plan, cuts: &Cuts, packed: &[usize]) -> BTreeSet<usize> {
    let outside = plan.blocks.outside.iter().filter(|register| !packed.contains(register));
    let mut open: Vec<usize> =
        outside.filter_map(|register| number(plan.next[*register])).collect();
    open.extend(plan.needed_by_blocks());
    let mut needed = BTreeSet::new();
    while let Some(word) = open.pop() {
        if needed.insert(word) && cuts.entering(word).is_none() {
            open.extend(plan.operands(word));
        }
    }
    needed
}

/// Gives each function a bit.
fn places(plan: &Plan, layout: &Layout, functions: &[usize]) -> BTreeMap<usize, u32> {
    let mut places = BTreeMap::new();
    for (register, bit) in &layout.registers {
        if let Some(word) = number(plan.next[*register]).filter(|word| functions.contains(word)) {
            places.entry(word).or_insert(*bit);
        }
    }
    let taken: BTreeSet<u32> = places.values().copied().collect();
    let free = (0..u64::BITS).filter(|bit| !taken.contains(bit));
    let others: Vec<usize> =
        functions.iter().copied().filter(|word| !places.contains_key(word)).collect();
    places.extend(others.into_iter().zip(free));
    places
}
