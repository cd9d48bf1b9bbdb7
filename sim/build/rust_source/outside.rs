//! What is computed at every clock: what tables say, packed registers, and the few registers that
//! are left outside all blocks.

use std::collections::{BTreeMap, BTreeSet};

use super::gather::gathered;
use super::packing::Packing;
use super::plan::Plan;
use super::tables::Table;
use super::words::number;

/// Statements that ask all tables, in `found`, compute what packed registers become, in `next`, and
/// the values that the other registers outside all blocks take next.
pub(super) fn lines(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut outside = Outside::new(plan, packing);
    outside.look_up();
    for register in packing.left_outside(plan) {
        outside.compute(number(plan.next[register]));
    }
    outside.lines
}

/// Statements that compute what blocks need when `known` and `found` are.
pub(super) fn needed_by_blocks(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut outside = Outside::new(plan, packing);
    outside.found = packing.places.keys().copied().collect();
    for word in plan.needed_by_blocks() {
        outside.compute(Some(word));
    }
    outside.lines
}

struct Outside<'a> {
    plan: &'a Plan<'a>,
    packing: &'a Packing,
    /// Functions that tables have been asked for.
    found: BTreeSet<usize>,
    computed: BTreeSet<usize>,
    lines: Vec<String>,
}

impl<'a> Outside<'a> {
    fn new(plan: &'a Plan<'a>, packing: &'a Packing) -> Self {
        let [found, computed] = [BTreeSet::new(), BTreeSet::new()];
        Self { plan, packing, found, computed, lines: vec![] }
    }

    fn look_up(&mut self) {
        let packing = self.packing;
        self.lines.push("let mut found = 0_u64;".to_owned());
        let at_once = packing.tables.partition_point(|table| table.depth == 1);
        let (first, later) = packing.tables.split_at(at_once);
        self.ask_all(first);
        self.update_packed();
        for tables in later.chunk_by(|one, next| one.depth == next.depth) {
            self.ask_all(tables);
        }
    }

    fn ask_all(&mut self, tables: &[Table]) {
        for table in tables {
            self.ask(table);
        }
        self.found.extend(tables.iter().flat_map(|table| &table.functions));
    }

    fn ask(&mut self, table: &Table) {
        let (bits, alone) = self.packing.entering(table);
        let (mut order, mut index) = (vec![], vec![]);
        if !bits.is_empty() {
            let places: Vec<u32> = bits.keys().copied().collect();
            let (text, places) = gathered(&places);
            index.push(text);
            order.extend(places.iter().map(|place| bits[place]));
        }
        for word in alone {
            self.compute(Some(word));
            index.push(format!("w{word} << {}", order.len()));
            order.push(word);
        }
        let entries = table.entries(self.plan, &order, &self.packing.places);
        let (length, index) = (entries.len(), index.join(" | "));
        // The mask is there for the compiler, which needs not look whether an entry is there.
        self.lines.push(format!(
            "found |= {{ static TABLE: [u64; {length}] = {entries:?}; TABLE[({index}) as usize & {:#x}] }};",
            length - 1
        ));
    }

    fn update_packed(&mut self) {
        let packing = self.packing;
        let steady: u64 = packing.steady.iter().map(|kept| 1 << packing.bits[&kept.word]).sum();
        let mut found = 0_u64;
        let mut shifted: BTreeMap<i64, u64> = BTreeMap::new();
        let mut parts = vec![];
        for (register, bit) in &packing.registers {
            let next = self.plan.next[*register];
            let place = number(next).and_then(|word| packing.places.get(&word));
            let source = number(next).and_then(|word| packing.bits.get(&word));
            if place == Some(bit) {
                found |= 1 << bit;
            } else if let Some(source) = source {
                *shifted.entry(i64::from(*bit) - i64::from(*source)).or_default() |= 1 << source;
            } else {
                self.compute(number(next));
                parts.push(format!("{next} << {bit}"));
            }
        }
        parts.push(format!("known & {steady:#x}"));
        parts.push(format!("found & {found:#x}"));
        for (distance, mask) in shifted {
            let shift = if distance < 0 { ">>" } else { "<<" };
            parts.push(format!("(known & {mask:#x}) {shift} {}", distance.abs()));
        }
        self.lines.push(format!("let mut next = {};", parts.join(" | ")));
    }

    /// Computes a word and, before it, those it needs.
    fn compute(&mut self, word: Option<usize>) {
        let Some(word) = word.filter(|word| self.computed.insert(*word)) else { return };
        if let Some(bit) = self.packing.bits.get(&word) {
            return self.lines.push(format!("let w{word} = known >> {bit} & 1;"));
        }
        if self.found.contains(&word) {
            let bit = self.packing.places[&word];
            return self.lines.push(format!("let w{word} = found >> {bit} & 1;"));
        }
        for operand in self.plan.operands(word) {
            self.compute(Some(*operand));
        }
        self.lines.push(self.plan.line(word));
    }
}
