//! Registers that may be passed over together, and which words are needed for them alone.
//!
//! A *block* holds the registers that change only under its conditions; a block whose conditions
//! imply those of another stands inside it: the tens of a counter inside its units.
use super::activity::{Logic, conditions};
use super::words::{Operand, Words};
use helixlock_netlist::Netlist;

/// The code around all blocks, or a block.
pub(super) type Site = Option<usize>;

/// Registers that change only under a condition.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// One of them is set whenever a register of the block changes.
    conditions: Vec<Operand>,
    /// One bit: some condition is set; evaluated in the block around.
    pub(super) active: Operand,
    /// The block around.
    pub(super) parent: Site,
    /// Indices in [`Netlist::registers`].
    pub(super) registers: Vec<usize>,
}

/// All blocks of a design, and the registers outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    /// By number; a block stands behind the one around it.
    pub(super) blocks: Vec<Block>,
    /// Registers that may change at any clock.
    pub(super) outside: Vec<usize>,
}

impl Blocks {
    pub(super) fn new(words: &mut Words, netlist: &Netlist) -> Self {
        let mut logic = Logic::default();
        let mut found = Self::default();
        for register in 0..netlist.registers.len() {
            match conditions(words, &mut logic, netlist, register) {
                None => found.outside.push(register),
                Some(none) if none.is_empty() => {}
                Some(conditions) => found.put(words, &mut logic, register, conditions),
            }
        }
        found.nest(words, &mut logic);
        found
    }

    /// Adds a register to the block of its conditions.
    fn put(&mut self, words: &mut Words, logic: &mut Logic, register: usize, of: Vec<Operand>) {
        let same = self.blocks.iter_mut().find(|block| {
            logic.implies(words, &of, &block.conditions)
                && logic.implies(words, &block.conditions, &of)
        });
        if let Some(block) = same {
            block.registers.push(register);
            return;
        }
        let zero = Operand::Constant(0);
        let active = of.iter().fold(zero, |any, condition| words.or(any, *condition));
        self.blocks.push(Block { conditions: of, active, parent: None, registers: vec![register] });
    }

    /// Puts each block into the innermost one that its conditions imply, and outer ones first.
    fn nest(&mut self, words: &Words, logic: &mut Logic) {
        let blocks = std::mem::take(&mut self.blocks);
        let around: Vec<Vec<usize>> = blocks
            .iter()
            .enumerate()
            .map(|(index, block)| {
                let implied =
                    |other: &Block| logic.implies(words, &block.conditions, &other.conditions);
                let others: Vec<bool> = blocks.iter().map(implied).collect();
                (0..blocks.len()).filter(|other| *other != index && others[*other]).collect()
            })
            .collect();
        let mut order: Vec<usize> = (0..blocks.len()).collect();
        order.sort_by_key(|index| around[*index].len());
        for index in &order {
            let innermost = around[*index].iter().max_by_key(|other| around[**other].len());
            let parent = innermost.and_then(|other| order.iter().position(|place| place == other));
            self.blocks.push(Block { parent, ..blocks[*index].clone() });
        }
    }

    /// Takes a register out of its block.
    pub(super) fn take_out(&mut self, register: usize) {
        for block in &mut self.blocks {
            block.registers.retain(|other| *other != register);
        }
        self.outside.push(register);
    }

    /// Puts registers from outside into a block of their own, under no condition; gives its number.
    pub(super) fn set_apart(&mut self, registers: Vec<usize>) -> usize {
        self.outside.retain(|register| !registers.contains(register));
        let (conditions, active) = (vec![], Operand::Constant(1));
        self.blocks.push(Block { conditions, active, parent: None, registers });
        self.blocks.len() - 1
    }

    /// A block that has nothing left but blocks inside, each of which has its own condition.
    pub(super) fn hollow(&self) -> Site {
        self.blocks.iter().position(|block| block.registers.is_empty())
    }

    /// Gives the registers of a block to the one around it.
    pub(super) fn dissolve(&mut self, index: usize) {
        let block = self.blocks.remove(index);
        match block.parent {
            Some(parent) => self.blocks[parent].registers.extend(block.registers),
            None => self.outside.extend(block.registers),
        }
        for other in &mut self.blocks {
            other.parent = match other.parent {
                Some(parent) if parent == index => block.parent,
                Some(parent) if index < parent => Some(parent - 1),
                parent => parent,
            };
        }
    }

    /// The outermost block around a site.
    pub(super) fn root(&self, site: Site) -> Site {
        self.path(site).pop()
    }

    /// Whose block a register is in.
    pub(super) fn of_register(&self, register: usize) -> Site {
        self.blocks.iter().position(|block| block.registers.contains(&register))
    }

    /// False for a register that keeps its first value.
    pub(super) fn may_change(&self, register: usize) -> bool {
        self.outside.contains(&register) || self.of_register(register).is_some()
    }

    /// The blocks around both.
    pub(super) fn common(&self, a: Site, b: Site) -> Site {
        let around = self.path(a);
        self.path(b).into_iter().find(|block| around.contains(block))
    }

    /// A block and those around it, inner ones first.
    fn path(&self, site: Site) -> Vec<usize> {
        std::iter::successors(site, |block| self.blocks[*block].parent).collect()
    }
}
