//! `helixlock faults`: flips every flip-flop and looks what becomes of the screw.

mod blocks;
mod page;
mod rows;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use comfy_table::{Cell, CellAlignment, Table};
use helixlock_plant::MachineFile;
use helixlock_sim::faults::{Flips, Outcome, flip_flops};

use self::blocks::{HEADER, by_block, safeguards};
use self::rows::{COLUMNS, Faults, cells_of, faults_of, word, write_csv};
use crate::shared::cases::{Campaign, Cases, Row, Shard, apart_from_cases};
use crate::shared::input::machine_files;
use crate::shared::keys::keys;
use crate::shared::language::Reporter;
use crate::shared::next::Next;
use crate::shared::output::{print_json, print_page, write_page};

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
    /// The same as a page
    #[arg(long, value_name = "FILE.html", conflicts_with = "shard")]
    page: Option<PathBuf>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
}

impl FaultsCommand {
    /// Runs what is missing of the campaign, writes and prints it.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        apart_from_cases(self.output.as_deref(), [("`--page`", self.page.as_deref())])?;
        let file = MachineFile::read(&self.machine)?;
        let flips = Flips::new(&file.model, self.instants)?;
        let course = [flips.window_s(), flips.band_um()];
        let worked = self.cases(&file).work_out(self.output.as_deref(), |missing, keep| {
            flips.try_each(missing, &|case, outcome| {
                keep(Row { case, cells: cells_of(&outcome, course), failure: None })
            })
        })?;
        let faults = faults_of(&worked.table)?;
        if let Some(path) = &self.page {
            let page = page::page(&file.model.title, &faults);
            write_page(path, machine_files(&self.machine, &file.model), &page, out.language())?;
        }
        if self.json {
            print_json(out, &FaultsJson::new(&faults))?;
            return Ok(ExitCode::SUCCESS);
        }
        worked.print(&CAMPAIGN, out)?;
        if self.shard.is_none() {
            print(out, &faults)?;
        }
        print_page(out, self.page.as_deref())?;
        self.print_next(out)?;
        Ok(ExitCode::SUCCESS)
    }

    /// A part is joined with the others; a device that was seen to recover is built.
    fn print_next(&self, out: &mut impl Reporter) -> anyhow::Result<()> {
        match (self.shard, &self.output) {
            (Some(_), Some(parts)) => {
                Next::command("merge").words([parts]).output("faults.csv").print(out)
            }
            _ => Next::command("gen").words([&self.machine]).output("fpga").print(out),
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

fn print(out: &mut dyn Write, faults: &Faults) -> anyhow::Result<()> {
    let mut table = Table::new();
    table.set_header(HEADER);
    let right = |text| Cell::new(text).set_alignment(CellAlignment::Right);
    for (name, block) in by_block(faults) {
        table.add_row(block.cells(name).into_iter().map(right));
    }
    writeln!(out, "{table}")?;
    writeln!(
        out,
        "{} flip-flops at {} instants, followed for {:.2} s; on course: within {:.4} µm",
        faults.flip_flops.len(),
        faults.instants_s.len(),
        faults.window_s,
        faults.band_um
    )?;
    Ok(safeguards(faults).iter().try_for_each(|line| writeln!(out, "{line}"))?)
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
