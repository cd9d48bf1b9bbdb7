//! Where each word of a kernel is computed, and which are kept from clock to clock.
//!
//! A word is computed in the innermost block around all that need it. One that depends on nothing
//! but inputs and registers in blocks, and would be computed at every clock, is *kept* instead: it
//! is computed anew when one of those blocks has been active or such an input has changed.

use std::collections::{BTreeMap, BTreeSet};

use super::activity::{Logic, step};
use super::blocks::{Block, Blocks, Site};
use super::cuts::Cuts;
use super::words::{Operand, Words, number};
use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::settle::counters;
use helixlock_netlist::{Expression, Netlist, Node, Register};

/// A block that spares fewer operations than this is dissolved: a branch costs as much.
const FEWEST_SPARED: usize = 8;

/// A narrower counter leaves its stretch too soon to be worth a leap.
const NARROWEST_COASTING: u32 = 6;

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

/// A register that takes the same step at every clock, and is seen only by how it compares.
pub(super) struct Coasting {
    /// Index in [`Netlist::registers`].
    pub(super) register: usize,
    pub(super) width: u32,
    pub(super) step: u64,
    pub(super) thresholds: Vec<u64>,
    /// One bit: it does something else.
    pub(super) strays: Operand,
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
    /// Words of several bits that follow from inputs alone, and are read like them.
    pub(super) set: Vec<usize>,
    /// What each output shows.
    pub(super) outputs: Vec<Operand>,
    /// Registers that count at every clock, or nearly.
    pub(super) coasting: Vec<Coasting>,
    leaves: BTreeMap<usize, Leaf>,
    /// Of every register.
    widths: Vec<u32>,
    /// How many there are.
    inputs: usize,
}

impl<'a> Plan<'a> {
    /// What follows from the design, before anything is decided.
    pub(super) fn undecided(netlist: &'a Netlist) -> Self {
        let mut words = Words::new(netlist);
        let leaves = leaves(&mut words, netlist);
        let registers = netlist.registers.iter();
        let width = |register: &Register| netlist.signal(register.output).width;
        let widths = registers.clone().map(width).collect();
        let next = registers.map(|register| words.signal(register.input)).collect();
        let blocks = Blocks::new(&mut words, netlist);
        let outputs = netlist.outputs.iter().map(|output| words.signal(*output)).collect();
        let coasting = coasting(&mut words, netlist);
        let (places, kept, set) = (BTreeMap::new(), vec![], vec![]);
        let inputs = netlist.inputs.len();
        Self { words, blocks, next, places, kept, set, outputs, coasting, leaves, widths, inputs }
    }

    /// Decided for one copy, of which each word costs an operation and each bit may be looked up.
    pub(super) fn new(netlist: &'a Netlist) -> Self {
        let mut plan = Self::undecided(netlist);
        plan.places = plan.placed();
        while let Some(register) = plan.looked_up() {
            plan.blocks.take_out(register);
            plan.places = plan.placed();
        }
        while let Some(block) = plan.looked_up_block() {
            for register in plan.blocks.blocks[block].registers.clone() {
                plan.blocks.take_out(register);
            }
            plan.blocks.dissolve(block);
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
        plan.set = plan.set_by_inputs();
        plan.places = plan.placed();
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

    /// Where a word that follows from inputs stands behind them.
    pub(super) fn set_at(&self, word: usize) -> Option<usize> {
        Some(self.inputs + self.set.iter().position(|set| *set == word)?)
    }

    /// True for a word that is read from an input or a register.
    pub(super) fn is_read(&self, word: usize) -> bool {
        self.leaves.contains_key(&word)
    }

    /// What a word is read from as it is.
    pub(super) fn leaf(&self, word: usize) -> Option<Leaf> {
        self.leaves.get(&word).copied()
    }

    /// The inputs and registers that a value is computed from.
    pub(super) fn leaves_of(&self, value: Operand) -> impl Iterator<Item = Leaf> {
        let cone = self.cone_up_to(number(value), &BTreeSet::new());
        cone.into_iter().filter_map(|word| self.leaf(word))
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
        if let Some(place) = self.kept_at(word) {
            return format!("let {} = kept[{place}];", Operand::Word(word));
        }
        match self.set_at(word) {
            Some(place) => format!("let {} = inputs[{place}];", Operand::Word(word)),
            None => self.words.line(word),
        }
    }

    /// The statement that gives a register its next value.
    pub(super) fn update(&self, register: usize) -> String {
        format!("registers[{register}] = {};", self.next[register])
    }

    /// Words that are to be known before this one: none when it is taken from where it is kept.
    pub(super) fn operands(&self, word: usize) -> &[usize] {
        let is_there = self.kept_at(word).is_some() || self.set_at(word).is_some();
        if is_there { &[] } else { &self.words.all()[word].operands }
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
            if self.set_at(word).is_some() {
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

    /// A block of one-bit registers, known after two look-ups at most, and of nothing else: looked up
    /// they need no branch.
    fn looked_up_block(&self) -> Site {
        let cuts = Cuts::new(self);
        let is_looked_up = |register: &usize| {
            let word = number(self.next[*register]);
            self.is_bit(*register) && word.is_some_and(|word| (1..=2).contains(&cuts.depth(word)))
        };
        let blocks = &self.blocks.blocks;
        (0..blocks.len()).find(|index| {
            let is_inside = |block: &Block| block.parent == Some(*index);
            blocks[*index].registers.iter().all(is_looked_up) && !blocks.iter().any(is_inside)
        })
    }

    /// Words of several bits that follow from inputs alone, where others are computed from them.
    fn set_by_inputs(&self) -> Vec<usize> {
        let needs = self.needs().into_iter().map(|(word, _)| word);
        let all = self.cone_up_to(needs, &BTreeSet::new());
        let is_set = |word: &usize| !self.is_read(*word) && !self.reads(*word, |_| true);
        let others = all.into_iter().filter(|word| !is_set(word));
        let operands = others.flat_map(|word| self.words.all()[word].operands.clone());
        let wide = |word: &usize| 1 < self.words.all()[*word].width;
        let set: BTreeSet<usize> = operands.filter(|word| is_set(word) && wide(word)).collect();
        set.into_iter().collect()
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
            self.set_at(*word).is_none() && FEWEST_KEPT <= computed.count()
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

    /// True when a word is computed from a register of that kind, at this clock.
    pub(super) fn reads(&self, word: usize, which: impl Fn(&usize) -> bool) -> bool {
        self.cone(word).iter().any(|word| match self.leaves.get(word) {
            Some(Leaf::Register(register)) => which(register),
            _ => false,
        })
    }

    /// A word that is not computed at every clock, or not for others, and what it depends on.
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

/// Counters whose step and thresholds are constants.
fn coasting(words: &mut Words, netlist: &Netlist) -> Vec<Coasting> {
    let mut logic = Logic::default();
    let mut found = vec![];
    for counter in counters(netlist, NARROWEST_COASTING) {
        let register = counter.register;
        let constant = |threshold: &Expression| match threshold.node {
            Node::Constant(value) => Some(value),
            _ => None,
        };
        let thresholds: Option<Vec<u64>> = counter.thresholds.iter().map(constant).collect();
        let step = step(words, &mut logic, netlist, register);
        if let (Some(thresholds), Some((step, conditions))) = (thresholds, step) {
            let none = Operand::Constant(0);
            let strays = conditions.into_iter().fold(none, |any, bit| words.or(any, bit));
            let width = netlist.signal(netlist.registers[register].output).width;
            found.push(Coasting { register, width, step, thresholds, strays });
        }
    }
    found
}

/// Places inputs and registers, and says which words they are.
fn leaves(words: &mut Words, netlist: &Netlist) -> BTreeMap<usize, Leaf> {
    let mut leaves = BTreeMap::new();
    let drivers = Drivers::new(netlist);
    let inputs = netlist.registers.iter().map(|register| register.input);
    let roots = inputs.chain(netlist.outputs.iter().copied());
    for end in drivers.ends(roots, |_| false) {
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
