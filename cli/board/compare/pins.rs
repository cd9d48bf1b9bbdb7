//! Levels of a board's pins, by the clock.

use anyhow::bail;
use helixlock_gen::Board;
use helixlock_netlist::{Netlist, SignalId};
use helixlock_traces::{Capture, CapturedSignal};

/// Pins without which there is no pass to compare.
const NEEDED: [&str; 3] = ["grating", "laser", "start"];

/// A bit of a port.
#[derive(Clone, Debug)]
pub(super) struct Pin {
    /// Its name, `calibrate[0]` for a bit of several.
    pub(super) name: String,
    /// The port.
    pub(super) port: SignalId,
    /// Its place in the port.
    pub(super) bit: u32,
    /// The board reads it.
    pub(super) input: bool,
    /// It is in the log; an input that is not stays at rest.
    pub(super) logged: bool,
    /// Its level before the first clock.
    pub(super) first: bool,
}

/// A pin at a new level: after the edge of that number, seen by the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Change {
    pub(super) clock: u64,
    pub(super) pin: usize,
    pub(super) high: bool,
}

/// The pins of a board while it ran.
#[derive(Clone, Debug)]
pub(super) struct PinLog {
    pub(super) pins: Vec<Pin>,
    /// In the order of the clocks.
    pub(super) changes: Vec<Change>,
    /// Clocks that it covers.
    pub(super) clocks: u64,
}

impl PinLog {
    /// Finds the ports of a netlist in a capture; inputs that are not there are at rest.
    pub(super) fn new(
        capture: &Capture,
        netlist: &Netlist,
        board: &Board,
        at_rest: bool,
    ) -> anyhow::Result<Self> {
        let clocks = Clocks::of(capture, board)?;
        let mut log = Self { pins: vec![], changes: vec![], clocks: clocks.at(capture.end_ticks) };
        let inputs = netlist.inputs.iter().map(|port| (*port, true));
        let outputs = netlist.outputs.iter().map(|port| (*port, false));
        for (port, input) in inputs.chain(outputs) {
            let signal = netlist.signal(port);
            for bit in 0..signal.width {
                let name = match signal.width {
                    1 => signal.path.clone(),
                    _ => format!("{}[{bit}]", signal.path),
                };
                let found = signal_of(capture, &name, NEEDED.contains(&name.as_str()))?;
                let pin = Pin { name, port, bit, input, logged: found.is_some(), first: at_rest };
                match found {
                    Some(found) => log.add(pin, found, &clocks, capture)?,
                    None if input => log.pins.push(pin),
                    None => {}
                }
            }
        }
        if log.pins.iter().all(|pin| pin.input) {
            bail!(
                "{}: found no output of the board, expected one of `t1`, `t2`, `step`, `tx` …",
                capture.path.display()
            );
        }
        log.changes.sort_by_key(|change| change.clock);
        Ok(log)
    }

    fn add(
        &mut self,
        mut pin: Pin,
        signal: &CapturedSignal,
        clocks: &Clocks<'_>,
        capture: &Capture,
    ) -> anyhow::Result<()> {
        let Some(first) = signal.first_high else {
            bail!("{}: `{}` has no level", capture.path.display(), signal.path);
        };
        pin.first = first;
        let index = self.pins.len();
        let of = |ticks: &[u64], high| ticks.iter().map(|at| (*at, high)).collect::<Vec<_>>();
        let mut edges = of(&signal.rising_ticks, true);
        edges.extend(of(&signal.falling_ticks, false));
        edges.sort_unstable();
        self.changes.extend(edges.iter().map(|(at, high)| Change {
            clock: clocks.at(*at),
            pin: index,
            high: *high,
        }));
        self.pins.push(pin);
        Ok(())
    }
}

/// The signal of that name, if there is one, or if there has to be.
fn signal_of<'a>(
    capture: &'a Capture,
    name: &str,
    needed: bool,
) -> anyhow::Result<Option<&'a CapturedSignal>> {
    let ends = |path: &str| path.strip_suffix(name).is_some_and(|rest| rest.ends_with('.'));
    let there = capture.signals.iter().any(|signal| signal.path == name || ends(&signal.path));
    Ok(if there || needed { Some(capture.signal(name)?) } else { None })
}

/// Which clock an instant belongs to.
enum Clocks<'a> {
    /// By the edges of the clock itself.
    Counted(&'a [u64]),
    /// By its frequency: femtoseconds of a tick, and Hz.
    Exact(u128, u128),
}

impl<'a> Clocks<'a> {
    fn of(capture: &'a Capture, board: &Board) -> anyhow::Result<Self> {
        Ok(match signal_of(capture, "clock", false)? {
            Some(clock) => Self::Counted(&clock.rising_ticks),
            None => {
                Self::Exact(capture.tick.femtoseconds(), 1_000_000 * u128::from(board.clock_mhz))
            }
        })
    }

    /// Edges up to that instant.
    fn at(&self, ticks: u64) -> u64 {
        match self {
            Self::Counted(edges) => edges.partition_point(|edge| *edge <= ticks) as u64,
            Self::Exact(tick, hz) => {
                const SECOND: u128 = 1_000_000_000_000_000;
                let clock = (u128::from(ticks) * tick * hz + SECOND / 2) / SECOND;
                u64::try_from(clock).unwrap_or(u64::MAX)
            }
        }
    }
}
