//! What is computed at every clock: what tables say, packed registers, and the few registers that
//! are left outside all blocks.

use std::collections::{BTreeMap, BTreeSet};

use super::gather::gathered;
use super::packing::{PACKED, Packing};
use super::plan::Plan;
use super::tables::Table;
use super::words::number;

/// Statements that ask all tables and give what packed registers become and what is found; and the
/// entries of the tables of the kernel of that name.
pub(super) fn look(plan: &Plan, packing: &Packing, name: &str) -> (Vec<String>, Vec<u64>) {
    let mut outside = Outside::new(plan, packing);
    outside.lines.push(format!("let tables = &{}_TABLES;", name.to_uppercase()));
    outside.look_up();
    let known = "Known { early: known, late }";
    let next = "Known { early: next, late: later }";
    let found = format!("found: found & {:#x}", read_of_found(plan, packing));
    outside.lines.push(format!("Edge {{ known: {known}, next: {next}, {found} }}"));
    (outside.lines, outside.entries)
}

/// True when what tables say, and packed registers become, follows from what is known.
pub(super) fn looks_at_known_alone(plan: &Plan, packing: &Packing) -> bool {
    let mut outside = Outside::new(plan, packing);
    outside.look_up();
    outside.looks_at_known_alone()
}

/// Statements that compute what registers left outside all blocks take next when tables have been
/// asked.
pub(super) fn left(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut outside = Outside::found(plan, packing);
    for register in packing.left_outside(plan) {
        outside.compute(number(plan.next[register]));
    }
    outside.lines
}

/// Statements that compute what blocks need when `known` and `found` are.
pub(super) fn needed_by_blocks(plan: &Plan, packing: &Packing) -> Vec<String> {
    let mut outside = Outside::found(plan, packing);
    for word in plan.needed_by_blocks() {
        outside.compute(Some(word));
    }
    outside.lines
}

/// Bits of what is found that something else than packed registers is made of.
fn read_of_found(plan: &Plan, packing: &Packing) -> u64 {
    let mut outside = Outside::found(plan, packing);
    let left =
        packing.left_outside(plan).into_iter().filter_map(|register| number(plan.next[register]));
    let strays = plan.coasting.iter().filter_map(|coasting| number(coasting.strays));
    for word in plan.needed_by_blocks().into_iter().chain(left).chain(strays) {
        outside.compute(Some(word));
    }
    let places = packing.places.iter().filter(|(word, _)| outside.computed.contains(word));
    places.map(|(_, bit)| 1 << bit).sum()
}

/// Code outside all blocks in the making.
pub(super) struct Outside<'a> {
    plan: &'a Plan<'a>,
    packing: &'a Packing,
    /// Functions that tables have been asked for.
    found: BTreeSet<usize>,
    computed: BTreeSet<usize>,
    pub(super) lines: Vec<String>,
    /// Of all tables asked, one behind the other.
    entries: Vec<u64>,
}

impl<'a> Outside<'a> {
    /// Before any table has been asked.
    pub(super) fn new(plan: &'a Plan<'a>, packing: &'a Packing) -> Self {
        let [found, computed] = [BTreeSet::new(), BTreeSet::new()];
        Self { plan, packing, found, computed, lines: vec![], entries: vec![] }
    }

    /// When all tables have been asked.
    fn found(plan: &'a Plan<'a>, packing: &'a Packing) -> Self {
        let found = packing.places.keys().copied().collect();
        Self { found, ..Self::new(plan, packing) }
    }

    /// True when nothing is read but what is known, which then is all that the code depends on.
    pub(super) fn looks_at_known_alone(&self) -> bool {
        let reads = |line: &String| {
            ["inputs[", "registers[", "kept["].iter().any(|place| line.contains(place))
        };
        !self.lines.iter().any(reads)
    }

    fn look_up(&mut self) {
        let packing = self.packing;
        self.lines.push("let mut found = 0_u64;".to_owned());
        let at_once = packing.tables.partition_point(|table| table.depth == 1);
        let (first, later) = packing.tables.split_at(at_once);
        // Tables that say what registers become are asked first: the next clock waits for nothing else.
        let (registers, others): (Vec<&Table>, Vec<&Table>) =
            first.iter().partition(|table| packing.tells_registers(self.plan, table));
        self.ask_all(registers);
        self.update("next", &packing.registers);
        let beside = packing.steady.iter().chain(&packing.fresh);
        let beside: u64 = beside.map(|kept| 1 << packing.bits[&kept.word]).sum();
        if beside != 0 {
            self.lines.push(format!("let next = next | known & {beside:#x};"));
        }
        self.ask_all(others);
        for tables in later.chunk_by(|one, next| one.depth == next.depth) {
            self.ask_all(tables.iter().collect());
        }
        self.update("later", &packing.late);
    }

    fn ask_all(&mut self, tables: Vec<&Table>) {
        for table in &tables {
            self.ask(table);
        }
        self.found.extend(tables.into_iter().flat_map(|table| &table.functions));
    }

    fn ask(&mut self, table: &Table) {
        let entering = self.packing.entering(table, &self.found);
        let (mut order, mut index) = (vec![], vec![]);
        for (word, bits) in PACKED.iter().zip(&entering.packed) {
            if bits.is_empty() {
                continue;
            }
            let places: Vec<u32> = bits.keys().copied().collect();
            let text = gathered(word, &places);
            index.push(if order.is_empty() { text } else { format!("{text} << {}", order.len()) });
            order.extend(bits.values());
        }
        for word in entering.alone {
            self.compute(Some(word));
            index.push(format!("w{word} << {}", order.len()));
            order.push(word);
        }
        let entries = table.entries(self.plan, &order, &self.packing.places);
        let (first, last, index) = (self.entries.len(), entries.len() - 1, index.join(" | "));
        // The mask is there for the compiler, which needs not look whether an entry is there.
        let entry = format!("tables[{first} + (({index}) as usize & {last:#x})]");
        // What is asked later says which bits it tells: others are known before, and need not wait.
        let told: u64 = table.functions.iter().map(|word| 1 << self.packing.places[word]).sum();
        let only = if table.depth == 1 { String::new() } else { format!(" & {told:#x}") };
        self.lines.push(format!("found |= {entry}{only};"));
        self.entries.extend(entries);
    }

    /// What registers become that are bits of one word.
    fn update(&mut self, name: &str, registers: &BTreeMap<usize, u32>) {
        let packing = self.packing;
        let mut found = 0_u64;
        let mut shifted: BTreeMap<i64, u64> = BTreeMap::new();
        let mut parts = vec!["0".to_owned()];
        for (register, bit) in registers {
            let next = self.plan.next[*register];
            let word = number(next);
            let place = word.and_then(|word| packing.places.get(&word));
            let source = word.and_then(|word| packing.bits.get(&word));
            if place == Some(bit) {
                found |= 1 << bit;
            } else if let Some(source) = source {
                let distance = i64::from(*bit) - i64::from(*source);
                *shifted.entry(distance).or_default() |= 1 << source;
            } else {
                self.compute(word);
                parts.push(format!("{next} << {bit}"));
            }
        }
        parts.push(format!("found & {found:#x}"));
        for (distance, mask) in shifted {
            let shift = if distance < 0 { ">>" } else { "<<" };
            parts.push(format!("(known & {mask:#x}) {shift} {}", distance.abs()));
        }
        self.lines.push(format!("let {name} = {};", parts.join(" | ")));
    }

    /// Computes a word and, before it, those it needs.
    pub(super) fn compute(&mut self, word: Option<usize>) {
        let Some(word) = word.filter(|word| self.computed.insert(*word)) else { return };
        if let Some(bit) = self.packing.bits.get(&word) {
            return self.lines.push(format!("let w{word} = known >> {bit} & 1;"));
        }
        if let Some(bit) = self.packing.late_bits.get(&word) {
            return self.lines.push(format!("let w{word} = late >> {bit} & 1;"));
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
