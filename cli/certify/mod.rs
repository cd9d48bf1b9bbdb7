//! `helixlock certify`: the synchronous device against the asynchronous one of the print.

mod gates;
mod json;
mod page;
mod sets;
mod spread;
mod text;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_original::{Corner, Hazard, dump, hazards};
use helixlock_plant::Model;
use helixlock_sim::blocks::{BlockCheck, Blocks, Spread};
use helixlock_sim::{
    Certificate, Course, DelaySet, FLIP_FLOP, FlipFlop, GateWaves, Options, WholeGates, certify,
    certify_gates, gate_waves, mtbf_log10_years, parallel,
};
use helixlock_traces::csv::write_csv;

use self::json::{BlockJson, CertificateJson, GatesJson, HazardJson, SetJson, WholeJson};
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
    /// The whole original also with all delays at either limit, and with so many drawn sets, which
    /// begin at `--seed`
    #[arg(long, value_name = "N", requires = "gates",
          value_parser = clap::value_parser!(u64).range(0..=100_000))]
    gates_spread: Option<u64>,
    /// What a recorder at the gates' meter draws, loop open, as a table that `diagnose` reads
    #[arg(long, value_name = "FILE.csv", requires = "gates")]
    trace: Option<PathBuf>,
    /// Waveform of every gate of the whole original, loop closed: with `--length`, as a millimetre is
    /// about a megabyte
    #[arg(long, value_name = "FILE.vcd", requires = "gates", conflicts_with = "shard")]
    wave: Option<PathBuf>,
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
        let others =
            [("`--page`", &self.page), ("`--trace`", &self.trace), ("`--wave`", &self.wave)];
        let others = others.map(|(name, path)| (name, path.as_deref()));
        apart_from_cases(self.output.as_deref(), others)?;
        let machine = Model::read(&self.machine)?;
        if self.shard.is_some() {
            self.delay_sets(&machine)?.print(&CAMPAIGN, out)?;
            return Ok(ExitCode::SUCCESS);
        }
        let answer = self.answer(&machine)?;
        self.write_files(&machine, &answer, out)?;
        if self.json { self.print_json(&answer, out) } else { self.print(&answer, out) }
    }

    /// Everything that is worked out.
    fn answer(&self, machine: &Model) -> anyhow::Result<Answer> {
        let options = Options { length_mm: self.length };
        let bar = progress::bar(Course::new(machine, &options)?.clocks(), "clocks");
        let certificate = certify(machine, self.length, &mut |clocks| bar.set_position(clocks))?;
        bar.finish_and_clear();
        let sets = self.delay_sets(machine)?;
        let checks = sets::checks_of(&sets.table, &self.spread())?;
        let delays = self.sets_of_gates();
        let originals = match delays.as_slice() {
            [] => vec![],
            delays => certify_gates(machine, self.length, delays)?,
        };
        let originals = delays.into_iter().zip(originals).collect();
        Ok(Answer { certificate, sets, checks, hazards: hazards()?, originals })
    }

    fn write_files(
        &self,
        machine: &Model,
        answer: &Answer,
        out: &mut impl Reporter,
    ) -> anyhow::Result<()> {
        let inputs = || machine_files(&self.machine, machine);
        let first = answer.originals.first();
        if let Some((path, (_, whole))) = self.trace.as_ref().zip(first) {
            let trace = gates::trace(&whole.drawn);
            write_whole(path, inputs(), |mut file| Ok(write_csv(&trace, &mut file)?))?;
        }
        if let Some((path, (delays, _))) = self.wave.as_ref().zip(first) {
            let GateWaves { circuit, initial, edges } = gate_waves(machine, self.length, *delays)?;
            write_whole(path, inputs(), |file| Ok(dump(file, &circuit, &initial, &edges)?))?;
        }
        if let Some(path) = &self.page {
            let Answer { certificate, checks, hazards, .. } = answer;
            let page = page::page(&machine.title, certificate, checks, hazards);
            write_page(path, inputs(), &page, out.language())?;
        }
        Ok(())
    }

    fn print_json(&self, answer: &Answer, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        let mut originals = answer.originals.iter();
        let mtbf = self.mtbf_log10_years(&answer.certificate);
        let all = WholeJson {
            certificate: CertificateJson::new(&answer.certificate, self.flip_flop(), mtbf),
            blocks: answer.checks.iter().map(BlockJson::new).collect(),
            hazards: answer.hazards.iter().map(HazardJson::new).collect(),
            whole_original: originals.next().map(|(_, whole)| GatesJson::new(whole)),
            whole_original_sets: originals.map(SetJson::new).collect(),
        };
        print_json(out, &all)?;
        Ok(status(answer.holds()))
    }

    fn print(&self, answer: &Answer, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
        text::print(&answer.certificate, out)?;
        let given = [self.settling, self.window, self.lost];
        text::print_metastability(self.mtbf_log10_years(&answer.certificate), given, out)?;
        gates::print(&answer.checks, out)?;
        gates::print_hazards(&answer.hazards, out)?;
        if let Some(((_, whole), others)) = answer.originals.split_first() {
            gates::print_whole(whole, out)?;
            if self.gates_spread.is_some() {
                spread::print(others, out)?;
            }
        }
        if let Some(path) = &self.trace {
            writeln!(out, "{}: what a recorder at the gates draws", path.display())?;
        }
        if let Some(path) = &self.wave {
            writeln!(out, "{}: every gate, loop closed", path.display())?;
        }
        answer.sets.print(&CAMPAIGN, out)?;
        print_page(out, self.page.as_deref())?;
        Next::command("faults").words([&self.machine]).print(out)?;
        Ok(status(answer.holds()))
    }

    fn mtbf_log10_years(&self, certificate: &Certificate) -> f64 {
        mtbf_log10_years(self.flip_flop(), certificate.clock_hz, certificate.fringe_hz)
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

    /// Delays of the whole original: what was asked for, then those of `--gates-spread`.
    fn sets_of_gates(&self) -> Vec<DelaySet> {
        let typical = DelaySet::Corner(Corner::Typical);
        let first = self.gates.map(|seed| seed.map_or(typical, DelaySet::Drawn));
        let limits = [Corner::Shortest, Corner::Longest].map(DelaySet::Corner);
        let spread = self.gates_spread.into_iter().flat_map(|sets| {
            let drawn = (0..sets).map(|set| DelaySet::Drawn(self.seed.wrapping_add(set)));
            limits.into_iter().chain(drawn)
        });
        first.into_iter().chain(spread).collect()
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

/// What the command found.
struct Answer {
    certificate: Certificate,
    sets: Worked,
    checks: Vec<BlockCheck>,
    hazards: Vec<Hazard>,
    /// The whole original, with each set of delays that was asked for.
    originals: Vec<(DelaySet, WholeGates)>,
}

impl Answer {
    fn holds(&self) -> bool {
        self.certificate.holds()
            && self.checks.iter().all(BlockCheck::is_alike)
            && self.originals.iter().all(|(_, whole)| whole.holds())
    }
}

fn status(holds: bool) -> ExitCode {
    if holds { ExitCode::SUCCESS } else { ExitCode::from(1) }
}
