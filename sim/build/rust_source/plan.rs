//! Where each word of a kernel is computed, and which are kept from clock to clock.
//!
//! A word is computed in the innermost block around all that need it. One that depends on nothing
//! but inputs and registers in blocks, and would be computed at every clock, is *kept* instead: it
//! is computed anew when one of those blocks has been active or such an input has changed.

use std::collections::{BTreeMap, BTreeSet};

use super::blocks::{Blocks, Site};
use super::cuts::Cuts;
use super::words::{Operand, Words, number};
use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::{Netlist, Register};

/// A block that spares fewer operations than this is dissolved: a branch costs as much.
const FEWEST_SPARED: usize = 8;

/// Keeping a word that takes fewer operations than this spares nothing.
const FEWEST_KEPT: usize = 2;

/// What a word that no other word gives is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Leaf {
    /// Index in [`Netlist::inputs`].
    Input(usize),
    /// Index in [`Netlist::registers`].
    Register(usize),
}

/// A word kept from clock to clock.
pub(super) struct Kept {
    /// Its number.
    pub(super) word: usize,
    /// Inputs it depends on.
    pub(super) inputs: BTreeSet<usize>,
    /// Outermost blocks it depends on.
    pub(super) roots: BTreeSet<usize>,
}

/// All decisions about a kernel.
pub(super) struct Plan<'a> {
    pub(super) words: Words<'a>,
    pub(super) blocks: Blocks,
    /// Next value of every register.
    pub(super) next: Vec<Operand>,
    /// Where each word that is needed is computed.
    pub(super) places: BTreeMap<usize, Site>,
    pub(super) kept: Vec<Kept>,
    leaves: BTreeMap<usize, Leaf>,
    /// Of every register.
    widths: Vec<u32>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(netlist: &'a Netlist) -> Self {
        let mut words = Words::new(netlist);
        let leaves = leaves(&mut words, netlist);
        let registers = netlist.registers.iter();
        let width = |register: &Register| netlist.signal(register.output).width;
        let widths = registers.clone().map(width).collect();
        let next = registers.map(|register| words.signal(register.input)).collect();
        let blocks = Blocks::new(&mut words, netlist);
        let places = BTreeMap::new();
        let mut plan = Self { words, blocks, next, places, kept: vec![], leaves, widths };
        plan.places = plan.placed();
        while let Some(register) = plan.looked_up() {
            plan.blocks.take_out(register);
            plan.places = plan.placed();
        }
        while let Some(hollow) = plan.blocks.hollow() {
            plan.blocks.dissolve(hollow);
            plan.places = plan.placed();
        }
        while let Some(poor) = plan.poor_block() {
            plan.blocks.dissolve(poor);
            plan.places = plan.placed();
        }
        plan.kept = plan.worth_keeping();
        plan.places = plan.placed();
        plan
    }

    /// Words computed in a site, in order.
    pub(super) fn computed_in(&self, site: Site) -> impl Iterator<Item = usize> {
        self.places.iter().filter(move |(_, place)| **place == site).map(|(word, _)| *word)
    }

    /// The place of a word among those kept.
    fn kept_at(&self, word: usize) -> Option<usize> {
        self.kept.iter().position(|kept| kept.word == word)
    }

    /// True for a word that is read from an input or a register.
    pub(super) fn is_read(&self, word: usize) -> bool {
        self.leaves.contains_key(&word)
    }

    /// The input that a word reads as it is.
    pub(super) fn input_of(&self, word: usize) -> Option<usize> {
        match self.leaves.get(&word) {
            Some(Leaf::Input(input)) => Some(*input),
            _ => None,
        }
    }

    /// True for a register of one bit.
    pub(super) fn is_bit(&self, register: usize) -> bool {
        self.widths[register] == 1
    }

    /// Words computed outside all blocks that blocks are computed from.
    pub(super) fn needed_by_blocks(&self) -> BTreeSet<usize> {
        let inside = self.places.iter().filter(|(_, site)| site.is_some());
        let operands = inside.flat_map(|(word, _)| &self.words.all()[*word].operands).copied();
        let blocks = &self.blocks.blocks;
        let active = blocks.iter().filter_map(|block| number(block.active));
        let registers = blocks.iter().flat_map(|block| &block.registers);
        let next = registers.filter_map(|register| number(self.next[*register]));
        let all = operands.chain(active).chain(next);
        all.filter(|word| self.places.get(word) == Some(&None)).collect()
    }

    /// The statement that computes a word, or takes it from where it is kept.
    pub(super) fn line(&self, word: usize) -> String {
        match self.kept_at(word) {
            Some(place) => format!("let {} = kept[{place}];", Operand::Word(word)),
            None => self.words.line(word),
        }
    }

    /// The statement that gives a register its next value.
    pub(super) fn update(&self, register: usize) -> String {
        format!("registers[{register}] = {};", self.next[register])
    }

    /// Words that are to be known before this one: none when it is taken from where it is kept.
    pub(super) fn operands(&self, word: usize) -> &[usize] {
        if self.kept_at(word).is_some() { &[] } else { &self.words.all()[word].operands }
    }

    /// A word and all it is computed from.
    pub(super) fn cone(&self, word: usize) -> BTreeSet<usize> {
        self.cone_up_to([word], &BTreeSet::new())
    }

    /// Words and all they are computed from when some are known.
    pub(super) fn cone_up_to(
        &self,
        words: impl IntoIterator<Item = usize>,
        known: &BTreeSet<usize>,
    ) -> BTreeSet<usize> {
        let mut cone = BTreeSet::new();
        let mut open: Vec<usize> = words.into_iter().collect();
        while let Some(word) = open.pop() {
            if cone.insert(word) && !known.contains(&word) {
                open.extend(&self.words.all()[word].operands);
            }
        }
        cone
    }

    /// The innermost block around all that need it, for every word that is needed.
    fn placed(&self) -> BTreeMap<usize, Site> {
        let mut places = BTreeMap::new();
        for (needed, site) in self.needs() {
            self.need(&mut places, needed, site);
        }
        for (word, of) in self.words.all().iter().enumerate().rev() {
            let Some(site) = places.get(&word).copied() else { continue };
            if self.kept_at(word).is_some() || self.is_written_first(word) {
                // Read before anything is written.
                places.insert(word, None);
                continue;
            }
            for operand in &of.operands {
                self.need(&mut places, *operand, site);
            }
        }
        places
    }

    /// What registers and blocks need, and where.
    fn needs(&self) -> Vec<(usize, Site)> {
        let outside = self.blocks.outside.iter().map(|register| (self.next[*register], None));
        let mut needs: Vec<(Operand, Site)> = outside.collect();
        for (index, block) in self.blocks.blocks.iter().enumerate() {
            needs.push((block.active, block.parent));
            needs
                .extend(block.registers.iter().map(|register| (self.next[*register], Some(index))));
        }
        needs.into_iter().filter_map(|(operand, site)| Some((number(operand)?, site))).collect()
    }

    fn need(&self, places: &mut BTreeMap<usize, Site>, word: usize, site: Site) {
        let place = places.entry(word).or_insert(site);
        *place = self.blocks.common(*place, site);
    }

    /// True for the old value of a register outside all blocks, which is written before them. One in
    /// a block needs no such care: its next value holds its old one, so that its own block reads it
    /// too, and it is read around whoever else does.
    fn is_written_first(&self, word: usize) -> bool {
        let outside = |register| self.blocks.outside.contains(register);
        matches!(self.leaves.get(&word), Some(Leaf::Register(register)) if outside(register))
    }

    /// The word that reads a register, if there is one.
    pub(super) fn leaf_of(&self, register: usize) -> Option<usize> {
        let found = self.leaves.iter().find(|(_, leaf)| **leaf == Leaf::Register(register));
        found.map(|(word, _)| *word)
    }

    /// A one-bit register in a block that is looked up as cheaply: outside it costs nothing, and its
    /// block may be passed over while it stands still under a condition that lasts.
    fn looked_up(&self) -> Option<usize> {
        let cuts = Cuts::new(self);
        let outside = |word: &usize| {
            self.is_steady(*word) || self.is_read(*word) || self.places.get(word) == Some(&None)
        };
        let looked_up = |register: &usize| {
            let next = number(self.next[*register]).filter(|word| cuts.depth(*word) == 1);
            let entering = next.and_then(|word| cuts.entering(word));
            entering.is_some_and(|entering| entering.iter().all(outside))
        };
        let inside = self.blocks.blocks.iter().flat_map(|block| &block.registers);
        inside.copied().filter(|register| self.is_bit(*register)).find(looked_up)
    }

    /// A block that spares too little.
    fn poor_block(&self) -> Site {
        (0..self.blocks.blocks.len()).find(|block| self.spared(*block) < FEWEST_SPARED)
    }

    /// Operations passed over when a block is not active.
    fn spared(&self, block: usize) -> usize {
        let within = |site: &Site| self.blocks.common(*site, Some(block)) == Some(block);
        let words = self.places.iter().filter(|(_, site)| within(site));
        words.filter(|(word, _)| !self.leaves.contains_key(word)).count()
    }

    fn worth_keeping(&self) -> Vec<Kept> {
        let steady: BTreeSet<usize> =
            self.computed_in(None).filter(|word| self.is_steady(*word)).collect();
        let mut seen: BTreeSet<usize> = self.needs().into_iter().map(|(word, _)| word).collect();
        for word in self.places.keys().filter(|word| !steady.contains(word)) {
            seen.extend(&self.words.all()[*word].operands);
        }
        let worth = |word: &usize| {
            let computed = self.cone(*word).into_iter().filter(|word| !self.is_read(*word));
            FEWEST_KEPT <= computed.count()
        };
        steady.intersection(&seen).copied().filter(worth).map(|word| self.kept(word)).collect()
    }

    /// True when it can change only with an input or a block.
    pub(super) fn is_steady(&self, word: usize) -> bool {
        self.cone(word).iter().all(|word| match self.leaves.get(word) {
            Some(Leaf::Register(register)) => !self.blocks.outside.contains(register),
            _ => true,
        })
    }

    /// A steady word, and what it depends on.
    pub(super) fn kept(&self, word: usize) -> Kept {
        let mut kept = Kept { word, inputs: BTreeSet::new(), roots: BTreeSet::new() };
        for word in self.cone(word) {
            match self.leaves.get(&word) {
                Some(Leaf::Input(input)) => kept.inputs.extend([*input]),
                Some(Leaf::Register(register)) => {
                    kept.roots.extend(self.blocks.root(self.blocks.of_register(*register)));
                }
                None => {}
            }
        }
        kept
    }
}

/// Places inputs and registers, and says which words they are.
fn leaves(words: &mut Words, netlist: &Netlist) -> BTreeMap<usize, Leaf> {
    let mut leaves = BTreeMap::new();
    let drivers = Drivers::new(netlist);
    for end in drivers.ends(netlist.registers.iter().map(|register| register.input), |_| false) {
        let (leaf, place) = match drivers.of(end) {
            Driver::Input(index) => (Leaf::Input(index), format!("inputs[{index}]")),
            Driver::Register(index) => (Leaf::Register(index), format!("registers[{index}]")),
            Driver::Assignment(_) | Driver::Nothing => continue,
        };
        words.place(end, &place);
        leaves.extend(number(words.signal(end)).map(|word| (word, leaf)));
    }
    leaves
}
