//! Where each word of a kernel is computed, and which are kept from clock to clock.
//!
//! A word is computed in the innermost block around all that need it. One that depends on nothing
//! but inputs and registers in blocks, and would be computed at every clock, is *kept* instead: it
//! is computed anew when one of those blocks has been active or such an input has changed.

use std::collections::{BTreeMap, BTreeSet};

use super::blocks::{Blocks, Site};
use super::words::{Operand, Words, number};
use helixlock_netlist::Netlist;
use helixlock_netlist::drivers::{Driver, Drivers};

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
}

impl<'a> Plan<'a> {
    pub(super) fn new(netlist: &'a Netlist) -> Self {
        let mut words = Words::new(netlist);
        let leaves = leaves(&mut words, netlist);
        let registers = netlist.registers.iter();
        let next = registers.map(|register| words.signal(register.input)).collect();
        let blocks = Blocks::new(&mut words, netlist);
        let places = BTreeMap::new();
        let mut plan = Self { words, blocks, next, places, kept: vec![], leaves };
        plan.places = plan.placed();
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
        let mut cone = BTreeSet::new();
        let mut open = vec![word];
        while let Some(word) = open.pop() {
            if cone.insert(word) {
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

    /// The word that reads a register, if it is needed.
    pub(super) fn reading(&self, register: usize) -> Option<usize> {
        let found = self.leaves.iter().find(|(_, leaf)| **leaf == Leaf::Register(register));
        found.map(|(word, _)| *word).filter(|word| self.places.contains_key(word))
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
        steady.intersection(&seen).filter_map(|word| self.keep(*word)).collect()
    }

    /// True when it can change only with an input or a block.
    fn is_steady(&self, word: usize) -> bool {
        self.cone(word).iter().all(|word| match self.leaves.get(word) {
            Some(Leaf::Register(register)) => !self.blocks.outside.contains(register),
            _ => true,
        })
    }

    fn keep(&self, word: usize) -> Option<Kept> {
        let cone = self.cone(word);
        let leaves: Vec<Leaf> =
            cone.iter().filter_map(|word| self.leaves.get(word).copied()).collect();
        let inputs = leaves.iter().filter_map(|leaf| match leaf {
            Leaf::Input(input) => Some(*input),
            Leaf::Register(_) => None,
        });
        let roots = leaves.iter().filter_map(|leaf| match leaf {
            Leaf::Input(_) => None,
            Leaf::Register(register) => self.blocks.root(self.blocks.of_register(*register)),
        });
        let kept = Kept { word, inputs: inputs.collect(), roots: roots.collect() };
        (FEWEST_KEPT <= cone.len() - leaves.len()).then_some(kept)
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
