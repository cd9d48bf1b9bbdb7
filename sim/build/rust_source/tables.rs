//! Functions of a few bits looked up together: several share a table as long as few bits enter.

use std::collections::{BTreeMap, BTreeSet};

use super::cuts::{Cuts, MOST_ENTERING};
use super::plan::Plan;

/// A table: what enters it, and which functions it holds.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Look-ups before this one may be made.
    pub(super) depth: usize,
    pub(super) entering: BTreeSet<usize>,
    pub(super) functions: Vec<usize>,
}

/// A function, what enters it, and look-ups until it is known.
#[derive(Clone, Copy)]
struct Function<'a> {
    word: usize,
    entering: &'a BTreeSet<usize>,
    depth: usize,
}

/// Puts functions into few tables.
pub(super) fn tables(cuts: &Cuts, functions: &[usize]) -> Vec<Table> {
    let function = |word: &usize| {
        Some(Function { word: *word, entering: cuts.entering(*word)?, depth: cuts.depth(*word) })
    };
    let mut functions: Vec<Function> = functions.iter().filter_map(function).collect();
    functions.sort_by_key(|of| (of.depth, usize::MAX - of.entering.len(), of.word));
    // Which comes first decides how well the others fit: each is tried.
    let firsts = 0..functions.len();
    let tries = firsts.map(|first| in_order(&[&functions[first..=first], &functions].concat()));
    tries.min_by_key(|tables| (tables.len(), entries(tables))).unwrap_or_default()
}

/// All entries of some tables.
fn entries(tables: &[Table]) -> usize {
    tables.iter().map(|table| 1_usize << table.entering.len()).sum()
}

/// Puts each function into the table that it widens least; one that comes again stays.
fn in_order(functions: &[Function]) -> Vec<Table> {
    let mut tables: Vec<Table> = vec![];
    for Function { word, entering, depth } in functions.iter().copied() {
        if tables.iter().any(|table| table.functions.contains(&word)) {
            continue;
        }
        let more = |table: &Table| entering.difference(&table.entering).count();
        let fitting = tables.iter_mut().filter(|table| {
            table.depth == depth && table.entering.len() + more(table) <= MOST_ENTERING
        });
        if let Some(table) = fitting.min_by_key(|table| more(table)) {
            table.entering.extend(entering);
            table.functions.push(word);
        } else {
            tables.push(Table { depth, entering: entering.clone(), functions: vec![word] });
        }
    }
    tables.sort_by_key(|table| table.depth);
    tables
}

impl Table {
    /// What it holds: by what enters, its bits in the given order, each function in its place.
    pub(super) fn entries(
        &self,
        plan: &Plan,
        order: &[usize],
        places: &BTreeMap<usize, u32>,
    ) -> Vec<u64> {
        let functions = self.functions.iter().copied();
        let cone = &plan.cone_up_to(functions, &self.entering) - &self.entering;
        let mut values = vec![0; plan.words.all().len()];
        let entry = |index: usize| {
            for (place, word) in order.iter().enumerate() {
                values[*word] = index as u64 >> place & 1;
            }
            for word in &cone {
                values[*word] = plan.words.evaluate(*word, &values);
            }
            self.functions.iter().map(|word| values[*word] << places[word]).sum()
        };
        (0..1 << order.len()).map(entry).collect()
    }
}

/// All functions that these need, themselves included, in order.
pub(super) fn with_entering(cuts: &Cuts, functions: &[usize]) -> Vec<usize> {
    let mut found = vec![];
    let mut open: Vec<usize> = functions.iter().rev().copied().collect();
    while let Some(word) = open.pop() {
        let Some(entering) = cuts.entering(word) else { continue };
        if !found.contains(&word) {
            found.push(word);
            open.extend(entering);
        }
    }
    found
}
