//! All proofs and campaigns, a row each.

use std::path::Path;

use anyhow::bail;
use helixlock_gen::Family;
use helixlock_rtl::BLOCKS;
use rayon::prelude::*;

use super::covers::{From, witnesses};
use super::exhaustive::{Outcome, exhaustively};
use super::lockstep::History;
use super::mutants::{Fate, Mutant, of_module, try_mutant};
use super::properties::{Verdict, claim, prove};
use super::table::{FAILS, Row, Share, total};
use super::tally::Tally;
use super::vacuity::idle;
use super::{Sources, forgets, synthesis};

/// What of it is to be done.
#[derive(Clone, Debug)]
pub struct Extent {
    /// One mutant in so many is tried.
    pub one_in: usize,
    /// The one block to look at; all without.
    pub block: Option<String>,
}

impl Extent {
    fn takes(&self, block: &str) -> bool {
        self.block.as_ref().is_none_or(|only| only == block)
    }
}

/// All that is said of the blocks, in the order of the list.
///
/// Waveforms of witnesses go to `folder`.
///
/// # Errors
///
/// When there is no such block, a tool cannot be started, or a file cannot be read or written.
pub fn all(sources: &Sources, folder: &Path, extent: &Extent) -> anyhow::Result<Vec<Share>> {
    let cards: Vec<_> = synthesis::blocks().filter(|card| extent.takes(card.name)).collect();
    if let Some(block) = extent.block.as_ref().filter(|_| cards.is_empty()) {
        bail!("block `{block}`, expected one of the list");
    }
    let with_properties = sources.blocks()?;
    let shares = cards.par_iter().map(|card| {
        let proven = with_properties.iter().any(|block| block == card.name);
        share(sources, card.name, proven.then_some(folder), extent.one_in)
    });
    shares.collect()
}

/// True when all of it holds.
#[must_use]
pub fn good(shares: &[Share]) -> bool {
    let mut lines = shares.iter().flat_map(|share| &share.lines);
    total(shares).row("").good && !lines.any(|line| line.contains(FAILS))
}

/// What is said of a block; of its properties, if it has any, with witnesses into the folder.
fn share(
    sources: &Sources,
    block: &str,
    folder: Option<&Path>,
    one_in: usize,
) -> anyhow::Result<Share> {
    let mut rows = match folder {
        Some(folder) => proven(sources, block, folder)?.to_vec(),
        None => Vec::new(),
    };
    if block == "device" {
        rows.push(power_up(sources)?);
    }
    rows.extend(equality(sources, block)?);
    let mut unnoticed = Vec::new();
    if BLOCKS.iter().any(|card| card.name == block) {
        let tried = mutants(sources, block, one_in)?;
        rows.push(Tally::of(tried.iter().map(|(_, fate)| fate)).row(block));
        let left = tried.iter().filter(|(_, fate)| !fate.is_noticed());
        unnoticed.extend(left.map(|(mutant, fate)| {
            let Mutant { module, line, was, now } = mutant;
            format!("- {fate:?}: `{module}.v:{line}`, `{was}` as `{}`", now.trim())
        }));
    }
    let lines = rows.iter().map(Row::line).collect();
    Ok(Share { block: block.to_owned(), lines, unnoticed })
}

/// The rows of one block: its properties, that none of them is idle, and its witnesses.
fn proven(sources: &Sources, block: &str, folder: &Path) -> anyhow::Result<[Row; 3]> {
    let (assertions, sentence) = claim(sources, block)?;
    let verdict = prove(sources, block)?;
    let good = matches!(verdict, Verdict::Proven { .. });
    let outcome = match verdict {
        Verdict::Proven { depth } => format!("unbounded, depth {depth}"),
        Verdict::NotProven { log } => log.lines().last().unwrap_or_default().to_owned(),
    };
    let how = format!("{assertions} assertions, induction, any power-up state");
    let properties = Row { what: format!("`{block}`: {sentence}"), how, outcome, good };
    let idle = idle(sources, block, folder)?;
    let reached = Row {
        what: format!("`{block}`: no assertion is idle"),
        how: "each made impossible in turn: the solver finds the way there".to_owned(),
        outcome: match idle.first() {
            None => format!("all {assertions} are reached"),
            Some(first) => format!("{} are not, `{first}` the first", idle.len()),
        },
        good: idle.is_empty(),
    };
    Ok([properties, reached, witness(sources, block, folder)?])
}

fn witness(sources: &Sources, block: &str, folder: &Path) -> anyhow::Result<Row> {
    let found = witnesses(sources, block, folder)?;
    let from = |wanted| {
        let reached = found.iter().filter_map(|one| one.reached.as_ref());
        reached.filter(|(from, _)| *from == wanted).count()
    };
    let (power_up, invariant) = (from(From::PowerUp), from(From::Invariant));
    Ok(Row {
        what: format!("`{block}`: its interesting states are reachable"),
        how: format!("{} cover properties, a waveform each", found.len()),
        outcome: format!("{power_up} from power-up, {invariant} from a state the properties allow"),
        good: power_up + invariant == found.len(),
    })
}

fn power_up(sources: &Sources) -> anyhow::Result<Row> {
    let registers = forgets::power_up(sources)?;
    Ok(Row {
        what: "`device`: no output depends on the power-up state after a reset".to_owned(),
        how: "two copies, any two power-up states, four clocks of reset, SAT".to_owned(),
        outcome: match registers {
            Some(count) => format!("unbounded: all {count} registers equal, so equal for ever"),
            None => "registers differ".to_owned(),
        },
        good: registers.is_some(),
    })
}

/// The row that holds the gates of every family to the Verilog.
fn gates(sources: &Sources, block: &str) -> anyhow::Result<Row> {
    let verdicts = Family::ALL
        .into_iter()
        .map(|family| Ok((family, synthesis::synthesised(sources, sources, block, family)?)));
    let verdicts: Vec<_> = verdicts.collect::<anyhow::Result<_>>()?;
    let cells = verdicts.iter().filter_map(|(_, verdict)| match verdict {
        synthesis::Verdict::Equal { cells } => Some(cells.to_string()),
        synthesis::Verdict::Unequal { .. } => None,
    });
    let cells: Vec<_> = cells.collect();
    let unequal = verdicts.iter().find_map(|(family, verdict)| match verdict {
        synthesis::Verdict::Equal { .. } => None,
        synthesis::Verdict::Unequal { log } => {
            Some(format!("{}: {}", family.title(), log.lines().last().unwrap_or_default()))
        }
    });
    Ok(Row {
        what: format!("`{block}`: the gates after synthesis equal the Verilog"),
        how: "iCE40, ECP5 and Gowin cells of yosys, sequential equivalence from power-up"
            .to_owned(),
        good: unequal.is_none(),
        outcome: unequal.unwrap_or_else(|| {
            format!("unbounded, {} flip-flops and look-up tables", cells.join(", "))
        }),
    })
}

/// The rows that hold a block's Verilog to its gates, and to the engine where states are few.
fn equality(sources: &Sources, block: &str) -> anyhow::Result<Vec<Row>> {
    let mut rows = vec![gates(sources, block)?];
    let outcome = exhaustively(sources, block)?;
    if outcome != Outcome::TooMany {
        rows.push(Row {
            what: format!("`{block}`: the Verilog equals the engine"),
            how: "every state with every input, one clock in Icarus".to_owned(),
            good: matches!(outcome, Outcome::Alike(_)),
            outcome: match outcome {
                Outcome::Alike(transitions) => format!("exhaustive, {transitions} transitions"),
                Outcome::Differs(first) => first,
                Outcome::TooMany => String::new(),
            },
        });
    }
    Ok(rows)
}

/// A block's mutants, one in so many, and what became of each.
fn mutants(sources: &Sources, block: &str, one_in: usize) -> anyhow::Result<Vec<(Mutant, Fate)>> {
    let mutants = of_module(sources, block)?;
    let chosen: Vec<_> = mutants.into_iter().step_by(one_in).collect();
    let history = History::draw(block, 30_000, 7430)?;
    let fates = chosen
        .into_par_iter()
        .map(|mutant| try_mutant(sources, &mutant, &history).map(|fate| (mutant, fate)));
    fates.collect()
}
