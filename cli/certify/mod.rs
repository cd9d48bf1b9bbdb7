//! `helixlock certify`: the synchronous device against the asynchronous one of the print.

mod gates;
mod json;
mod page;
mod sets;
mod text;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_original::hazards;
use helixlock_plant::Model;
use helixlock_sim::blocks::{BlockCheck, Blocks, Spread};
use helixlock_sim::{
    Course, FLIP_FLOP, FlipFlop, Options, certify, certify_gates, mtbf_log10_years, parallel,
};
use helixlock_traces::csv::write_csv;

use self::json::{BlockJson, CertificateJson, GatesJson, HazardJson, WholeJson};
use crate::shared::cases::{Campaign, Cases, Row, Shard, Worked, apart_from_cases, write_numbers};
use crate::shared::input::machine_files;
use crate::shared::language::Reporter;
use crate::shared::next::Next;
use crate::shared::output::{print_json, print_page, write_page, write_whole};
use crate::shared::progress;
use crate::shared::quantity::length_mm;

/// Sets of gate delays, each tried on every figure.
pub(crate) const CAMPAIGN: Campaign = Campaign {
    word: "sets",
    write_csv: write_numbers,
    print: |table, out| {
        let checks = sets::checks_of(table, &Spread::default())?;
        gates::print(&checks, out)?;
        Ok(status(checks.iter().all(BlockCheck::is_alike)))
    },
};

/// Compare the clocked logic with the asynchronous original over a whole pass
///
/// Loop open and loop closed, and on edges made to coincide: prints the largest difference in time
/// and µm and the bound that follows from the clock. Then block by block against the gates of the
/// report's figures. Exit status 1 when a bound is not kept, or gates of typical delay differ.
#[derive(Debug, Args)]
pub(crate) struct Certify {
    /// Machine file
    #[arg(value_name = "MACHINE.toml")]
    machine: PathBuf,
    /// Only the first so many millimetres
    #[arg(long, value_name = "MM", value_parser = length_mm)]
    length: Option<f64>,
    /// Time constant with which a flip-flop of the FPGA settles, ns; 0.2 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    settling: Option<f64>,
    /// Window around the clock edge in which a flip-flop is upset, ns; 0.2 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    window: Option<f64>,
    /// What clock-to-output, routing and set-up take of a clock, ns; 3 is assumed
    #[arg(long, value_name = "NS", value_parser = positive_ns)]
    lost: Option<f64>,
    /// Pulses that each figure and its block are given
    #[arg(long, value_name = "N", default_value_t = 2000,
          value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pulses: u64,
    /// Sets of gate delays, drawn between the limits of the data sheets, with a tenth of the pulses
    #[arg(long, value_name = "N", default_value_t = 10,
          value_parser = clap::value_parser!(u64).range(0..=100_000))]
    spread: u64,
    /// Where drawing begins
    #[arg(long, value_name = "N", default_value_t = 1977)]
    seed: u64,
    /// One row a set of delays, the typical ones first, `.csv` or `.parquet`: what every figure did
    /// with it; what is there already is not run again. With `--shard` the folder of the parts
    #[arg(short, long, value_name = "FILE|DIR")]
    output: Option<PathBuf>,
    /// Run only this part of the sets of delays, `2/8`, and nothing else, on one machine of many;
    /// `helixlock merge` joins them
    #[arg(long, value_name = "PART/PARTS", requires = "output")]
    shard: Option<Shard>,
    /// Run the whole original gate by gate too, loop open and loop closed; with typical delays, or
    /// `--gates=SEED` with delays drawn between the limits of the data sheets
    #[arg(long, value_name = "SEED", num_args = 0..=1, require_equals = true)]
    #[expect(clippy::option_option, reason = "the flag may come with a seed or without")]
    gates: Option<Option<u64>>,
    /// What a recorder at the gates' meter draws, loop open, as a table that `diagnose` reads
    #[arg(long, value_name = "FILE.csv", requires = "gates")]
    trace: Option<PathBuf>,
    /// The same as a page
    #[arg(long, value_name = "FILE.html", conflicts_with = "shard")]
    page: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A time between a femtosecond and a second.
fn positive_ns(word: &str) -> Result<f64, String> {
    match word.parse() {
        Ok(ns) if (1e-6..=1e9).contains(&ns) => Ok(ns),
        _ => Err(format!("found `{word}`, expected a number of nanoseconds, 1e-6 to 1e9")),
    }
}

impl Certify {
    /// Runs the pass through both and prints what differs.
    pub(crate) fn run(self, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let others = [("`--page`", &self.page), ("`--trace`", &self.trace)];
        let others = others.map(|(name, path)| (name, path.as_deref()));
        apart_from_cases(self.output.as_deref(), others)?;
        let machine = Model::read(&self.machine)?;
        if self.shard.is_some() {
            self.delay_sets(&machine)?.print(&CAMPAIGN, out)?;
            return Ok(ExitCode::SUCCESS);
        }
        let options = Options { length_mm: self.length };
        let bar = progress::bar(Course::new(&machine, &options)?.clocks(), "clocks");
        let certificate = certify(&machine, self.length, &mut |clocks| bar.set_position(clocks))?;
        bar.finish_and_clear();
        let sets = self.delay_sets(&machine)?;
        let checks = sets::checks_of(&sets.table, &self.spread())?;
        let hazards = hazards()?;
        let whole =
            self.gates.map(|seed| certify_gates(&machine, self.length, seed)).transpose()?;
        let (clock_hz, fringe_hz) = (certificate.clock_hz, certificate.fringe_hz);
        let mtbf = mtbf_log10_years(self.flip_flop(), clock_hz, fringe_hz);
        if let Some((path, whole)) = self.trace.as_ref().zip(whole.as_ref()) {
            let trace = gates::trace(&whole.drawn);
            let inputs = machine_files(&self.machine, &machine);
            write_whole(path, inputs, |mut file| Ok(write_csv(&trace, &mut file)?))?;
        }
        if let Some(path) = &self.page {
            let page = page::page(&machine.title, &certificate, &checks, &hazards);
            write_page(path, machine_files(&self.machine, &machine), &page, out.language())?;
        }
        if self.json {
            let words = CertificateJson::new(&certificate, self.flip_flop(), mtbf);
            let blocks = checks.iter().map(BlockJson::new).collect();
            let hazards = hazards.iter().map(HazardJson::new).collect();
            let whole_original = whole.as_ref().map(GatesJson::new);
            print_json(out, &WholeJson { certificate: words, blocks, hazards, whole_original })?;
        } else {
            text::print(&certificate, out)?;
            let given = [self.settling, self.window, self.lost];
            text::print_metastability(mtbf, given, out)?;
            gates::print(&checks, out)?;
            gates::print_hazards(&hazards, out)?;
            whole.iter().try_for_each(|whole| gates::print_whole(whole, out))?;
            if let Some(path) = &self.trace {
                writeln!(out, "{}: what a recorder at the gates draws", path.display())?;
            }
            sets.print(&CAMPAIGN, out)?;
            print_page(out, self.page.as_deref())?;
            Next::command("faults").words([&self.machine]).print(out)?;
        }
        let holds = certificate.holds()
            && checks.iter().all(BlockCheck::is_alike)
            && whole.is_none_or(|whole| whole.holds());
        Ok(status(holds))
    }

    /// The figures with typical delays and with drawn ones, or a part of the sets.
    fn delay_sets(&self, machine: &Model) -> anyhow::Result<Worked> {
        let (spread, blocks) = (self.spread(), Blocks::all());
        let cases = Cases {
            campaign: &CAMPAIGN,
            number: 1 + spread.drawn,
            shard: self.shard,
            columns: sets::columns(),
            identity: format!("{spread:?}"),
            inputs: machine_files(&self.machine, machine),
        };
        cases.work_out(self.output.as_deref(), |missing, keep| {
            parallel(missing, |case| {
                let cells = sets::cells_of(&blocks.try_delays(&spread, *case)?);
                keep(Row { case: *case, cells, failure: None })
            })
        })
    }

    /// How much the figures are given.
    fn spread(&self) -> Spread {
        let Self { pulses, spread: drawn, seed, .. } = *self;
        Spread { pulses, drawn, drawn_pulses: pulses.div_ceil(10), seed }
    }

    /// What is said of the flip-flops, and of what was not said what is assumed.
    fn flip_flop(&self) -> FlipFlop {
        let given_s = |ns: Option<f64>, assumed_s| ns.map_or(assumed_s, |ns| 1e-9 * ns);
        FlipFlop {
            tau_s: given_s(self.settling, FLIP_FLOP.tau_s),
            window_s: given_s(self.window, FLIP_FLOP.window_s),
            overhead_s: given_s(self.lost, FLIP_FLOP.overhead_s),
        }
    }
}

fn status(holds: bool) -> ExitCode {
    if holds { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
