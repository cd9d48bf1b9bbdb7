//! `helixlock faults`: flips every flip-flop and looks what becomes of the screw.

mod rows;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use comfy_table::{Cell, CellAlignment, Table};
use helixlock_plant::MachineFile;
use helixlock_sim::faults::{Flips, Outcome, Verdict, flip_flops};

use self::rows::{COLUMNS, Faults, VERDICTS, cells_of, faults_of, word, write_csv};
use crate::shared::cases::{Campaign, Cases, Row, Shard};
use crate::shared::input::machine_files;
use crate::shared::keys::keys;
use crate::shared::output::print_json;

/// Flips of a campaign.
pub(crate) const CAMPAIGN: Campaign = Campaign {
    word: "flips",
    write_csv: |table, file| write_csv(&faults_of(table)?, file),
    print: |table, out| {
        print(out, &faults_of(table)?)?;
        Ok(ExitCode::SUCCESS)
    },
};

/// Flip every flip-flop of the running device: does it recover by itself, when, and at what cost
///
/// A flip is unseen, recovers, loses home (a playback would miss zero), or stays (a step in the
/// thread). Results stream into FILE.journal while they come; run the same command again and only
/// what is missing is tried.
#[derive(Debug, Args)]
pub(crate) struct FaultsCommand {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Instants at which every flip-flop is flipped
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..))]
    instants: u32,
    /// One row a flip: `.csv`, or `.parquet` with places for names; with `--shard` the folder of
    /// the parts
    #[arg(short, long, value_name = "FILE|DIR")]
    output: Option<PathBuf>,
    /// Try only this part of so many, `2/8`, on one machine of many; `helixlock merge` joins them
    #[arg(long, value_name = "PART/PARTS", requires = "output")]
    shard: Option<Shard>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
}

impl FaultsCommand {
    /// Runs what is missing of the campaign, writes and prints it.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let file = MachineFile::read(&self.machine)?;
        let flips = Flips::new(&file.model, self.instants)?;
        let course = [flips.window_s(), flips.band_um()];
        let worked = self.cases(&file).work_out(self.output.as_deref(), |missing, keep| {
            flips.try_each(missing, &|case, outcome| {
                keep(Row { case, cells: cells_of(&outcome, course), failure: None })
            })
        })?;
        if self.json {
            print_json(out, &FaultsJson::new(&faults_of(&worked.table)?))?;
            return Ok(ExitCode::SUCCESS);
        }
        worked.print(&CAMPAIGN, out)?;
        match self.shard {
            Some(_) => Ok(ExitCode::SUCCESS),
            None => (CAMPAIGN.print)(&worked.table, out),
        }
    }

    fn cases(&self, file: &MachineFile) -> Cases {
        Cases {
            campaign: &CAMPAIGN,
            number: flip_flops().len() as u64 * u64::from(self.instants),
            shard: self.shard,
            columns: COLUMNS.map(str::to_owned).to_vec(),
            identity: format!("{}\n{} instants", file.text(), self.instants),
            inputs: machine_files(&self.machine, &file.model),
        }
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

fn print(out: &mut dyn Write, faults: &Faults) -> anyhow::Result<()> {
    let mut blocks: BTreeMap<&str, Block> = BTreeMap::new();
    let mut all = Block::default();
    for outcome in &faults.outcomes {
        let block = faults.name(outcome).split_once('.').map_or("device", |(block, _)| block);
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
        faults.flip_flops.len(),
        faults.instants_s.len(),
        faults.window_s,
        faults.band_um
    )?;
    print_safeguards(out, faults)
}

/// What the ring's self-clear and the counter's fault output were worth.
fn print_safeguards(out: &mut dyn Write, faults: &Faults) -> anyhow::Result<()> {
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
    let mut shown: Vec<&str> = shown.map(|flip| faults.name(flip)).collect();
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

keys! {
    FaultsJson<'a>(faults: &'a Faults) {
        flip_flops: usize = faults.flip_flops.len(),
        instants_s: &'a [f64] = &faults.instants_s,
        window_s: f64 = faults.window_s,
        band_um: f64 = faults.band_um,
        flips: Vec<FlipJson<'a>> =
            faults.outcomes.iter().map(|flip| FlipJson::new(flip, faults.name(flip))).collect(),
    }

    FlipJson<'a>(flip: &'a Outcome, name: &'a str) {
        flip_flop: &'a str = name,
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
