//! Times side by side, as the Markdown table that `docs/performance.md` shows.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use anyhow::ensure;

use crate::Run;

/// What the names of our engines begin with.
const OURS: &str = "helixlock";

/// The quickest run of every engine on one stimulus.
pub(crate) struct Column {
    pub(crate) title: &'static str,
    rows: Vec<(String, f64)>,
    /// End state after so many clocks.
    states: BTreeMap<u64, String>,
}

impl Column {
    pub(crate) fn new(title: &'static str) -> Self {
        Self { title, rows: Vec::new(), states: BTreeMap::new() }
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

    /// Seconds that the quickest of the others takes for a clock.
    pub(crate) fn quickest_peer(&self) -> f64 {
        let peers = self.rows.iter().filter(|(name, _)| !name.starts_with(OURS));
        peers.map(|(_, per_clock)| *per_clock).fold(f64::INFINITY, f64::min)
    }

    fn per_clock(&self, name: &str) -> f64 {
        self.rows.iter().find(|(known, _)| known == name).map_or(f64::NAN, |(_, time)| *time)
    }
}

/// Every engine in a row, every stimulus in two columns.
pub(crate) fn engines(columns: &[Column]) -> String {
    let mut text = String::from("| engine |");
    for column in columns {
        // Writing into a string does not fail.
        let _ = write!(text, " {}, ns a clock | × quickest peer |", column.title);
    }
    let _ = writeln!(text, "\n|---|{}", "---:|---:|".repeat(columns.len()));
    for (name, _) in columns.first().map_or(&[][..], |column| &column.rows) {
        let _ = write!(text, "| {name} |");
        for column in columns {
            let per_clock = column.per_clock(name);
            let ratio = column.quickest_peer() / per_clock;
            let _ = write!(text, " {} | {} |", digits(1e9 * per_clock), digits(ratio));
        }
        text.push('\n');
    }
    text.push('\n');
    for column in columns {
        let clocks: Vec<String> = column.states.keys().map(u64::to_string).collect();
        let _ = writeln!(
            text,
            "Equal end states, {}: after {} clocks.",
            column.title,
            clocks.join(" and ")
        );
    }
    text
}

/// Three significant digits, four of large numbers.
pub(crate) fn digits(value: f64) -> String {
    let decimals = [100.0, 10.0, 1.0, 0.1].into_iter().filter(|limit| value < *limit).count();
    format!("{value:.decimals$}")
}
