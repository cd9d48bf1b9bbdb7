//! One-bit registers and what is known with them as bits of one word, and the functions of them
//! that are looked up.
//!
//! One word a bit costs a load, a store and an operation each. Packed, a chain of flip-flops is
//! shifted by one operation, and some ten bits at once are the index of a table that holds all that
//! follows from them. The word is called `known`; what tables say of it is `found`. Registers known
//! only after one look-up has followed another are in a word of their own, `late`: what is looked up
//! first at the next clock need not wait for them.

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
    /// Bits of `known` that are registers, by register; the others are steady or fresh.
    pub(super) registers: BTreeMap<usize, u32>,
    /// Bits of `known` that are steady, and when they are to be computed anew.
    pub(super) steady: Vec<Kept>,
    /// Bits of `known` that say how registers outside compare: computed anew at every clock.
    pub(super) fresh: Vec<Kept>,
    /// Bits of `late`, by the word that each is.
    pub(super) late_bits: BTreeMap<usize, u32>,
    /// Bits of `late`, by register.
    pub(super) late: BTreeMap<usize, u32>,
    /// Bits of `found`, by the function that each is; the next value of a register stands where the
    /// register does.
    pub(super) places: BTreeMap<usize, u32>,
    pub(super) tables: Vec<Table>,
}

/// What enters a table.
#[derive(Default)]
pub(super) struct Entering {
    /// Words and the bits that they are, by where these are: in `known`, in `late`, in `found`.
    pub(super) packed: [BTreeMap<u32, usize>; 3],
    /// Words that are no bit of another.
    pub(super) alone: Vec<usize>,
}

/// The words that [`Entering::packed`] speaks of.
pub(super) const PACKED: [&str; 3] = ["known", "late", "found"];

impl Packing {
    pub(super) fn new(plan: &Plan) -> Self {
        let cuts = Cuts::new(plan);
        let (packed, late) = packed(plan, &cuts);
        let next = packed.iter().filter_map(|register| number(plan.next[*register]));
        let strays = plan
            .coasting
            .iter()
            .filter(|coasting| plan.blocks.outside.contains(&coasting.register));
        let strays = strays.filter_map(|coasting| number(coasting.strays));
        let needed: Vec<usize> =
            next.clone().chain(needed(plan, &cuts, &packed)).chain(strays).collect();
        let mut functions = with_entering(&cuts, &needed);
        functions.truncate(BITS);
        let tables = tables(&cuts, &functions);
        let is_packed = |register: &usize| packed.contains(register) || late.contains(register);
        let is_fresh = |word: &usize| {
            let is_changing = !plan.is_steady(*word) && cuts.entering(*word).is_none();
            is_changing && !plan.reads(*word, is_packed)
        };
        let beside = |word: &usize| plan.is_steady(*word) || is_fresh(word);
        let shown = entering(&cuts, plan.outputs.iter().filter_map(|output| number(*output)));
        let beside = words_beside(&tables, next, &shown, beside);
        let layout = Layout::new(plan, &packed, &tables, &beside);
        let (places, late) = places(plan, &layout, &late, &functions);
        let all = |is: &dyn Fn(&usize) -> bool| {
            let words = layout.words.keys().copied();
            words.filter(|word| is(word)).map(|word| plan.kept(word)).collect()
        };
        let (steady, fresh) = (all(&|word| plan.is_steady(*word)), all(&is_fresh));
        let late_bits =
            late.iter().filter_map(|(register, bit)| Some((plan.leaf_of(*register)?, *bit)));
        let late_bits = late_bits.collect();
        let Layout { words: bits, registers } = layout;
        Self { bits, registers, steady, fresh, late_bits, late, places, tables }
    }

    /// True for a register that is a bit of `known` or of `late`.
    pub(super) fn has(&self, register: usize) -> bool {
        self.registers.contains_key(&register) || self.late.contains_key(&register)
    }

    /// Registers that are neither packed nor in a block.
    pub(super) fn left_outside(&self, plan: &Plan) -> Vec<usize> {
        plan.blocks.outside.iter().copied().filter(|register| !self.has(*register)).collect()
    }

    /// True when all that blocks need besides their own registers and inputs is a bit of `known`,
    /// of `late` or of `found`.
    pub(super) fn gives_all_to_blocks(&self, plan: &Plan) -> bool {
        let given = self.bits.keys().chain(self.late_bits.keys()).chain(self.places.keys());
        let needed = plan.cone_up_to(plan.needed_by_blocks(), &given.copied().collect());
        let outside = self.left_outside(plan);
        let mut read = outside.into_iter().filter_map(|register| plan.leaf_of(register));
        !read.any(|word| needed.contains(&word))
    }

    /// The bit of `found` that says whether a block is active, if one does.
    pub(super) fn active(&self, block: &Block) -> Option<u64> {
        self.places.get(&number(block.active)?).map(|place| 1 << place)
    }

    /// True when a table tells what a packed register becomes.
    pub(super) fn tells_registers(&self, plan: &Plan, table: &Table) -> bool {
        let mut next = self.registers.keys().filter_map(|register| number(plan.next[*register]));
        next.any(|word| table.functions.contains(&word))
    }

    /// What enters a table when the functions of others are `found`.
    pub(super) fn entering(&self, table: &Table, found: &BTreeSet<usize>) -> Entering {
        let mut entering = Entering::default();
        for word in &table.entering {
            let place = self.places.get(word).filter(|_| found.contains(word));
            let bits = [self.bits.get(word), self.late_bits.get(word), place];
            match bits.iter().position(Option::is_some) {
                Some(at) => entering.packed[at].extend(bits[at].map(|bit| (*bit, *word))),
                None => entering.alone.push(*word),
            }
        }
        entering
    }
}

/// One-bit registers outside all blocks: those known after one look-up, and those after more.
fn packed(plan: &Plan, cuts: &Cuts) -> (Vec<usize>, Vec<usize>) {
    let at_once =
        |register: &usize| number(plan.next[*register]).is_none_or(|word| cuts.depth(word) <= 1);
    let outside = plan.blocks.outside.iter().copied().filter(|register| plan.is_bit(*register));
    let (mut packed, mut late): (Vec<usize>, Vec<usize>) = outside.partition(at_once);
    packed.truncate(BITS);
    // Each has a bit of `found` too, where no packed register has one.
    late.truncate(BITS - packed.len());
    (packed, late)
}

/// Words beside packed registers that are to be bits: those that enter tables or are the next value of
/// a packed register, and if there is room those from which outputs of one bit follow.
fn words_beside(
    tables: &[Table],
    next: impl Iterator<Item = usize>,
    shown: &BTreeSet<usize>,
    is_beside: impl Fn(&usize) -> bool,
) -> Vec<usize> {
    let first: BTreeSet<usize> = tables
        .iter()
        .flat_map(|table| &table.entering)
        .copied()
        .chain(next)
        .filter(&is_beside)
        .collect();
    let then = shown - &first;
    first.into_iter().chain(then.into_iter().filter(is_beside)).collect()
}

/// What enters functions, down to what is none.
fn entering(cuts: &Cuts, functions: impl Iterator<Item = usize>) -> BTreeSet<usize> {
    let functions: Vec<usize> = functions.collect();
    let all = with_entering(cuts, &functions);
    let entering = all.iter().filter_map(|word| cuts.entering(*word)).flatten().copied();
    let ends = |word: &usize| cuts.is_bit(*word) && cuts.entering(*word).is_none();
    entering.chain(functions).filter(ends).collect()
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

/// Gives each function a bit, and each late register that of its next value.
fn places(
    plan: &Plan,
    layout: &Layout,
    late: &[usize],
    functions: &[usize],
) -> (BTreeMap<usize, u32>, BTreeMap<usize, u32>) {
    let mut places = BTreeMap::new();
    let next =
        |register: usize| number(plan.next[register]).filter(|word| functions.contains(word));
    for (register, bit) in &layout.registers {
        if let Some(word) = next(*register) {
            places.entry(word).or_insert(*bit);
        }
    }
    let taken: BTreeSet<u32> = places.values().copied().collect();
    let mut free = (0..u64::BITS).filter(|bit| !taken.contains(bit));
    let late: BTreeMap<usize, u32> = late.iter().copied().zip(free.by_ref()).collect();
    for (register, bit) in &late {
        if let Some(word) = next(*register) {
            places.entry(word).or_insert(*bit);
        }
    }
    let taken: BTreeSet<u32> = places.values().copied().collect();
    let free = (0..u64::BITS).filter(|bit| !taken.contains(bit));
    let others: Vec<usize> =
        functions.iter().copied().filter(|word| !places.contains_key(word)).collect();
    places.extend(others.into_iter().zip(free));
    (places, late)
}
