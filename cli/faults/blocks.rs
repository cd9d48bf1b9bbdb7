//! What came of the flips, block by block.

use std::collections::BTreeMap;

use helixlock_sim::faults::{Outcome, Verdict};

use super::rows::{Faults, VERDICTS};

/// Names of the [cells](Block::cells).
pub(super) const HEADER: [&str; 10] = [
    "block",
    "flips",
    VERDICTS[0].1,
    VERDICTS[1].1,
    VERDICTS[2].1,
    VERDICTS[3].1,
    "logic heals (clocks)",
    "slowest, s",
    "worst, µm",
    "fault shown",
];

/// What came of the flips in one block.
#[derive(Default)]
pub(super) struct Block {
    verdicts: BTreeMap<Verdict, usize>,
    slowest_s: f64,
    worst_um: f64,
    healed: usize,
    slowest_clocks: u64,
    fault_shown: usize,
}

/// Blocks by name, and all of them together.
pub(super) fn by_block(faults: &Faults) -> Vec<(&str, Block)> {
    let mut blocks: BTreeMap<&str, Block> = BTreeMap::new();
    let mut all = Block::default();
    for outcome in &faults.outcomes {
        let block = faults.name(outcome).split_once('.').map_or("device", |(block, _)| block);
        blocks.entry(block).or_default().add(outcome);
        all.add(outcome);
    }
    blocks.into_iter().chain([("all", all)]).collect()
}

impl Block {
    fn add(&mut self, outcome: &Outcome) {
        *self.verdicts.entry(outcome.verdict).or_default() += 1;
        self.slowest_s = outcome.recovery_s.map_or(self.slowest_s, |s| self.slowest_s.max(s));
        self.worst_um = self.worst_um.max(outcome.worst_um);
        self.healed += usize::from(outcome.healed_clocks.is_some());
        self.slowest_clocks = self.slowest_clocks.max(outcome.healed_clocks.unwrap_or(0));
        self.fault_shown += usize::from(outcome.fault_shown);
    }

    /// A row of the table.
    pub(super) fn cells(&self, name: &str) -> Vec<String> {
        let flips: usize = self.verdicts.values().sum();
        let counts = VERDICTS.map(|(verdict, _)| self.verdicts.get(&verdict).copied().unwrap_or(0));
        let mut cells = vec![name.to_owned(), flips.to_string()];
        cells.extend(counts.map(|count| count.to_string()));
        cells.extend([
            format!("{} ({})", self.healed, self.slowest_clocks),
            format!("{:.2}", self.slowest_s),
            format!("{:.3}", self.worst_um),
            self.fault_shown.to_string(),
        ]);
        cells
    }
}

/// What the ring's self-clear and the counter's fault output were worth, a sentence each.
pub(super) fn safeguards(faults: &Faults) -> [String; 2] {
    let cleared: Vec<&Outcome> =
        faults.outcomes.iter().filter(|flip| 0 < flip.ring_illegal_clocks).collect();
    let clocks = cleared.iter().map(|flip| flip.ring_illegal_clocks).max().unwrap_or(0);
    let slip = cleared.iter().map(|flip| flip.ring_slip.abs()).max().unwrap_or(0);
    let shown = faults.outcomes.iter().filter(|flip| flip.fault_shown);
    let mut shown: Vec<&str> = shown.map(|flip| faults.name(flip)).collect();
    shown.sort_unstable();
    shown.dedup();
    let lost = faults.outcomes.iter().filter(|flip| flip.home_error != 0).count();
    let shown = if shown.is_empty() { "none".to_owned() } else { shown.join(", ") };
    [
        format!(
            "self-clear of the ring: {} flips left it in an illegal state, for {clocks} clocks at \
             most; it then ran on, {slip} steps beside its place at most",
            cleared.len()
        ),
        format!(
            "fault output of the counter: came on after a flip of {shown}; it tells of a counter \
             that is full, not of the {lost} flips that made it count from elsewhere"
        ),
    ]
}
