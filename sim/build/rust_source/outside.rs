//! The order in which registers outside all blocks are updated: few values at a time.
//!
//! A processor has sixteen registers; what does not fit goes to the stack and back. So each register
//! is written as soon as all that read its old value have been computed, those with the fewest
//! readers left first: a chain of flip-flops is shifted from its end.

use std::collections::BTreeSet;

use super::plan::Plan;
use super::words::number;

/// Statements that update the registers outside and compute what blocks need.
pub(super) fn lines(plan: &Plan) -> Vec<String> {
    let mut outside = Outside { plan, computed: BTreeSet::new(), lines: vec![] };
    let mut open = plan.blocks.outside.clone();
    while let Some(place) = outside.least_read(&open) {
        outside.update(open.remove(place));
    }
    for word in plan.computed_in(None) {
        outside.compute(word);
    }
    outside.lines
}

struct Outside<'a> {
    plan: &'a Plan<'a>,
    computed: BTreeSet<usize>,
    lines: Vec<String>,
}

impl Outside<'_> {
    /// The place of the register whose old value the fewest words still wait for.
    fn least_read(&self, open: &[usize]) -> Option<usize> {
        (0..open.len()).min_by_key(|place| {
            let register = open[*place];
            let others = open.iter().filter(|other| **other != register);
            let copies = others.filter(|other| self.copies(**other, register)).count();
            copies + self.waiting(register).len()
        })
    }

    /// True when a register takes the old value of another as it is.
    fn copies(&self, register: usize, of: usize) -> bool {
        let word = number(self.plan.next[register]);
        word.is_some() && word == self.plan.reading(of)
    }

    /// Words not computed yet that read the old value of a register.
    fn waiting(&self, register: usize) -> Vec<usize> {
        let Some(old) = self.plan.reading(register) else { return vec![] };
        let open = self.plan.computed_in(None).filter(|word| !self.computed.contains(word));
        open.filter(|word| self.plan.operands(*word).contains(&old)).collect()
    }

    fn update(&mut self, register: usize) {
        if let Some(word) = number(self.plan.next[register]) {
            self.compute(word);
        }
        for word in self.waiting(register) {
            self.compute(word);
        }
        if let Some(old) = self.plan.reading(register) {
            self.compute(old);
        }
        self.lines.push(self.plan.update(register));
    }

    /// Computes a word and, before it, those it needs.
    fn compute(&mut self, word: usize) {
        if self.computed.insert(word) {
            for operand in self.plan.operands(word) {
                self.compute(*operand);
            }
            self.lines.push(self.plan.line(word));
        }
    }
}
