//! Times side by side.

use std::collections::BTreeMap;

use anyhow::ensure;
use comfy_table::{Cell, CellAlignment, Table};

use crate::Run;

/// The peer all ratios are to.
pub(crate) const REFERENCE: &str = "Verilator -O3";

/// The quickest run of every engine.
pub(crate) struct Rows {
    rows: Vec<(String, f64)>,
    /// End state after so many clocks.
    states: BTreeMap<u64, String>,
}

impl Rows {
    pub(crate) fn new() -> Self {
        Self { rows: Vec::new(), states: BTreeMap::new() }
    }

    /// Takes a run; its end state must be that of everyone who ran as many clocks.
    pub(crate) fn add(&mut self, name: &str, run: &Run) -> anyhow::Result<()> {
        let state = self.states.entry(run.clocks).or_insert_with(|| run.state.clone());
        ensure!(
            *state == run.state,
            "{name}: the state after {} clocks is\n{}\nexpected\n{state}",
            run.clocks,
            run.state
        );
        let per_clock = run.seconds / run.clocks as f64;
        match self.rows.iter_mut().find(|(known, _)| known == name) {
            Some((_, quickest)) => *quickest = quickest.min(per_clock),
            None => self.rows.push((name.to_owned(), per_clock)),
        }
        Ok(())
    }

    /// Nanoseconds the reference takes for a clock.
    pub(crate) fn reference_ns(&self) -> f64 {
        let reference = self.rows.iter().find(|(name, _)| name == REFERENCE);
        reference.map_or(f64::NAN, |(_, per_clock)| 1e9 * per_clock)
    }

    pub(crate) fn table(&self, title: &str) -> String {
        let reference = self.reference_ns() * 1e-9;
        let mut table = Table::new();
        table.set_header([title, "ns a clock", "× Verilator -O3"]);
        for (name, per_clock) in &self.rows {
            let numbers = [format!("{:.3}", 1e9 * per_clock), ratio(reference / per_clock)];
            let right = |text| Cell::new(text).set_alignment(CellAlignment::Right);
            table.add_row([vec![Cell::new(name)], numbers.map(right).to_vec()].concat());
        }
        let states: Vec<String> = self.states.keys().map(u64::to_string).collect();
        format!("{table}\nequal end states after {} clocks\n", states.join(" and "))
    }
}

/// Three significant digits.
fn ratio(value: f64) -> String {
    let digits = if value < 1.0 { 3 } else { usize::from(value < 10.0) };
    format!("{value:.digits$}")
}
