//! `helixlock faults`: flips every flip-flop and looks what becomes of the screw.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use comfy_table::{Cell, CellAlignment, Table};
use helixlock_plant::Model;
use helixlock_sim::faults::{Faults, Outcome, Verdict, flip_everything, flip_flops};

use crate::shared::input::machine_files;
use crate::shared::keys::keys;
use crate::shared::output::{print_json, write_whole};
use crate::shared::progress;

/// Flip every flip-flop of the running device: does it recover by itself, when, and at what cost
///
/// A flip is unseen, recovers, loses home (a playback would miss zero), or stays (a step in the
/// thread).
#[derive(Debug, Args)]
pub(crate) struct FaultsCommand {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Instants at which every flip-flop is flipped
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..))]
    instants: u32,
    /// One row a flip, as CSV
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
}

impl FaultsCommand {
    /// Runs the campaign, writes and prints it.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let machine = Model::read(&self.machine)?;
        let bar = progress::bar(flip_flops() as u64 * u64::from(self.instants), "flips");
        let faults = flip_everything(&machine, self.instants, &|| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(output) = &self.output {
            let inputs = machine_files(&self.machine, &machine);
            write_whole(output, inputs, |file| write_rows(file, &faults))?;
        }
        if self.json {
            print_json(out, &FaultsJson::new(&faults))?;
        } else {
            print(out, &faults)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// What came of the flips in one block.
#[derive(Default)]
struct Block {
    verdicts: BTreeMap<Verdict, usize>,
    slowest_s: f64,
    worst_um: f64,
    healed: usize,
    slowest_clocks: u64,
    fault_shown: usize,
}

const VERDICTS: [(Verdict, &str); 4] = [
    (Verdict::Unseen, "unseen"),
    (Verdict::Recovers, "recovers"),
    (Verdict::HomeLost, "home lost"),
    (Verdict::Stays, "stays"),
];

impl Block {
    fn add(&mut self, outcome: &Outcome) {
        *self.verdicts.entry(outcome.verdict).or_default() += 1;
        self.slowest_s = outcome.recovery_s.map_or(self.slowest_s, |s| self.slowest_s.max(s));
        self.worst_um = self.worst_um.max(outcome.worst_um);
        self.healed += usize::from(outcome.healed_clocks.is_some());
        self.slowest_clocks = self.slowest_clocks.max(outcome.healed_clocks.unwrap_or(0));
        self.fault_shown += usize::from(outcome.fault_shown);
    }

    fn cells(&self, name: &str) -> Vec<Cell> {
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
        let right = |text| Cell::new(text).set_alignment(CellAlignment::Right);
        cells.into_iter().map(right).collect()
    }
}

fn print(out: &mut impl Write, faults: &Faults) -> anyhow::Result<()> {
    let mut blocks: BTreeMap<&str, Block> = BTreeMap::new();
    let mut all = Block::default();
    for outcome in &faults.outcomes {
        let block = outcome.flip_flop.split_once('.').map_or("device", |(block, _)| block);
        blocks.entry(block).or_default().add(outcome);
        all.add(outcome);
    }
    let mut table = Table::new();
    let verdicts = VERDICTS.map(|(_, name)| name);
    let header = [
        &["block", "flips"],
        &verdicts[..],
        &["logic heals (clocks)", "slowest, s", "worst, µm", "fault shown"],
    ];
    table.set_header(header.concat());
    for (name, block) in &blocks {
        table.add_row(block.cells(name));
    }
    table.add_row(all.cells("all"));
    writeln!(out, "{table}")?;
    writeln!(
        out,
        "{} flip-flops at {} instants, followed for {:.2} s; on course: within {:.4} µm",
        faults.flip_flops,
        faults.instants_s.len(),
        faults.window_s,
        faults.band_um
    )?;
    print_safeguards(out, faults)
}

/// What the ring's self-clear and the counter's fault output were worth.
fn print_safeguards(out: &mut impl Write, faults: &Faults) -> anyhow::Result<()> {
    let cleared: Vec<&Outcome> =
        faults.outcomes.iter().filter(|flip| 0 < flip.ring_illegal_clocks).collect();
    let clocks = cleared.iter().map(|flip| flip.ring_illegal_clocks).max().unwrap_or(0);
    let slip = cleared.iter().map(|flip| flip.ring_slip.abs()).max().unwrap_or(0);
    writeln!(
        out,
        "self-clear of the ring: {} flips left it in an illegal state, for {clocks} clocks at most; \
         it then ran on, {slip} steps beside its place at most",
        cleared.len(),
    )?;
    let shown = faults.outcomes.iter().filter(|flip| flip.fault_shown);
    let mut shown: Vec<&str> = shown.map(|flip| flip.flip_flop.as_str()).collect();
    shown.sort_unstable();
    shown.dedup();
    let lost = faults.outcomes.iter().filter(|flip| flip.home_error != 0).count();
    let shown = if shown.is_empty() { "none".to_owned() } else { shown.join(", ") };
    writeln!(
        out,
        "fault output of the counter: came on after a flip of {shown}; it tells of a counter that \
         is full, not of the {lost} flips that made it count from elsewhere"
    )?;
    Ok(())
}

fn write_rows(file: &mut dyn Write, faults: &Faults) -> anyhow::Result<()> {
    writeln!(
        file,
        "flip_flop,time_s,verdict,healed_clocks,worst_um,left_um,recovery_s,home_error_steps,\
         ring_slip_steps,ring_illegal_clocks,fault_shown"
    )?;
    for outcome in &faults.outcomes {
        let optional = |number: Option<String>| number.unwrap_or_default();
        writeln!(
            file,
            "{},{},{},{},{},{},{},{},{},{},{}",
            outcome.flip_flop,
            outcome.time_s,
            word(outcome.verdict),
            optional(outcome.healed_clocks.map(|clocks| clocks.to_string())),
            outcome.worst_um,
            outcome.left_um,
            optional(outcome.recovery_s.map(|seconds| seconds.to_string())),
            outcome.home_error,
            outcome.ring_slip,
            outcome.ring_illegal_clocks,
            u8::from(outcome.fault_shown),
        )?;
    }
    Ok(())
}

keys! {
    FaultsJson<'a>(faults: &'a Faults) {
        flip_flops: usize = faults.flip_flops,
        instants_s: &'a [f64] = &faults.instants_s,
        window_s: f64 = faults.window_s,
        band_um: f64 = faults.band_um,
        flips: Vec<FlipJson<'a>> = faults.outcomes.iter().map(FlipJson::new).collect(),
    }

    FlipJson<'a>(flip: &'a Outcome) {
        flip_flop: &'a str = &flip.flip_flop,
        time_s: f64 = flip.time_s,
        verdict: String = word(flip.verdict),
        healed_clocks: Option<u64> = flip.healed_clocks,
        worst_um: f64 = flip.worst_um,
        left_um: f64 = flip.left_um,
        recovery_s: Option<f64> = flip.recovery_s,
        home_error_steps: i64 = flip.home_error,
        ring_slip_steps: i64 = flip.ring_slip,
        ring_illegal_clocks: u64 = flip.ring_illegal_clocks,
        fault_shown: bool = flip.fault_shown,
    }
}

fn word(verdict: Verdict) -> String {
    let name = VERDICTS.iter().find(|(known, _)| *known == verdict);
    name.map_or_else(String::new, |(_, name)| name.replace(' ', "-"))
}
