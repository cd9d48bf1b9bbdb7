//! Every circuit with every set of delays.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use helixlock_original::device::{self, Wheels};
use helixlock_original::figures::FIGURES;
use helixlock_original::figures::compensator::Correction;
use helixlock_original::{Change, Circuit, Corner, Delays, Simulator, at_every_pin, verilog};

use super::record::{self, Row, rows};
use super::{Style, agree};
use crate::tools::fnv;

/// The gates of the original in Icarus against our simulator, edge by edge
///
/// Corners of the data sheets, then drawn delays. Each comparison is a row of the file; what is
/// there is not done again unless the netlist has changed, so that the command may be interrupted.
#[derive(Clone, Debug, Args)]
pub struct Campaign {
    /// Pulses at every pin; pins that reset get a hundredth
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    pulses: usize,
    /// Drawn sets of delays
    #[arg(long, value_name = "N", default_value_t = 100)]
    sets: u64,
    /// Where drawing begins
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// The rows; below the folder of the project
    #[arg(short, long, value_name = "FILE", default_value = "original/icarus.csv")]
    output: PathBuf,
}

/// The circuits: each figure, and all of them joined.
pub const CIRCUITS: usize = FIGURES.len() + 1;

/// A circuit, its delays and its pulses.
#[derive(Clone, Debug)]
pub struct Case {
    /// The circuit.
    pub circuit: Circuit,
    /// Its delays.
    pub delays: Delays,
    /// What the table says of it; its edges are not counted yet.
    pub row: Row,
}

impl Case {
    /// The circuit of this place, with delays by their word and seed.
    ///
    /// # Errors
    ///
    /// When its gates do not come to rest.
    pub fn new(place: usize, delays: &str, seed: u64, pulses: usize) -> anyhow::Result<Self> {
        let circuit = FIGURES.get(place).map_or_else(joined, |figure| (figure.build)());
        let word = delays.to_owned();
        let delays = match delays {
            "shortest" => Delays::corner(&circuit, Corner::Shortest),
            "typical" => Delays::corner(&circuit, Corner::Typical),
            "longest" => Delays::corner(&circuit, Corner::Longest),
            _ => Delays::drawn(&circuit, seed),
        };
        let simulator = Simulator::new(&circuit, &delays)?;
        let netlist = fnv(verilog(&circuit, &delays, simulator.levels()).bytes());
        let name = circuit.name.clone();
        let row = Row { circuit: name, delays: word, seed, pulses, netlist, edges: 0 };
        Ok(Self { circuit, delays, row })
    }

    /// Its pulses.
    #[must_use]
    pub fn changes(&self) -> Vec<Change> {
        at_every_pin(&self.circuit, self.row.pulses, self.row.seed)
    }

    /// True when the row is of this very comparison.
    #[must_use]
    pub fn is(&self, row: &Row) -> bool {
        let edges = row.edges;
        Row { edges, ..self.row.clone() } == *row
    }
}

/// The device with wheels so low that everything happens within some pulses.
fn joined() -> Circuit {
    let compensation = Some((1, Correction::Insert));
    device::circuit(&Wheels { a: 3, b: 4, initial_phase: 2, compensation })
}

impl Campaign {
    /// Compares what is not in the file; whether all agree.
    ///
    /// # Errors
    ///
    /// When Icarus cannot be run, or the file not be written.
    pub fn run(&self, root: &Path, out: &mut impl Write) -> anyhow::Result<bool> {
        let path = root.join(&self.output);
        let known = rows(&path)?;
        let cases = self.cases()?;
        let done: Vec<Row> = cases
            .iter()
            .filter_map(|case| known.iter().find(|row| case.is(row)).cloned())
            .collect();
        record::begin(&path, &done)?;
        let mut edges: usize = done.iter().map(|row| row.edges).sum();
        writeln!(out, "{} of {} are there", done.len(), cases.len())?;
        for mut case in cases {
            if done.iter().any(|row| case.is(row)) {
                continue;
            }
            match agree(&case.circuit, &case.delays, &case.changes(), Style::Gates) {
                Ok(compared) => case.row.edges = compared,
                Err(error) => {
                    writeln!(out, "{}: {error:#}", case.row)?;
                    return Ok(false);
                }
            }
            edges += case.row.edges;
            writeln!(out, "{}", case.row)?;
            record::add(&path, &case.row)?;
        }
        writeln!(out, "{edges} edges, all alike")?;
        Ok(true)
    }

    /// All circuits with one set of delays, then with the next.
    fn cases(&self) -> anyhow::Result<Vec<Case>> {
        let corners = ["shortest", "typical", "longest"].map(|word| (word, self.seed));
        let drawn = (0..self.sets).map(|set| ("drawn", self.seed + set));
        let sets = corners.into_iter().chain(drawn);
        let one = |(word, seed)| (0..CIRCUITS).map(move |place| (place, word, seed));
        sets.flat_map(one)
            .map(|(place, word, seed)| Case::new(place, word, seed, self.pulses))
            .collect()
    }
}
