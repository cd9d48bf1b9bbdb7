//! Which signals, which window: every change of the chosen signals, clock by clock.
//!
//! A record is held whole by [`Waveform`], or handed on in pieces by [`Watch`].

use std::collections::BTreeSet;
use std::fmt;
use std::io;
use std::ops::Range;

use helixlock_netlist::{Netlist, SignalId};

use crate::Error;
use crate::engine::Engine;

/// What to look at, and when.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Signals, in the order of the netlist.
    pub signals: Vec<SignalId>,
    /// First clock, and the one after the last.
    pub window: Range<u64>,
}

/// What is told each piece of a waveform.
pub type Seen<'a> = &'a mut dyn FnMut(&Waveform) -> io::Result<()>;

/// Somebody who looks at a run while it goes on, and is told piece by piece, so that no window is
/// too long.
pub struct Watch<'a> {
    /// What to look at.
    pub probe: &'a Probe,
    /// Gets the pieces in the order of time; the first holds the value of every signal.
    pub seen: Seen<'a>,
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch").field("probe", self.probe).finish_non_exhaustive()
    }
}

/// Most changes a waveform holds in memory: about half a gigabyte.
const MOST_CHANGES: usize = 20_000_000;

/// A change of one signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// Clock number since when it holds.
    pub clock: u64,
    /// Index in [`Waveform::signals`].
    pub signal: usize,
    /// The value it has taken.
    pub value: u64,
}

/// Micrometres at one clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analogue {
    /// Clock number since when they hold.
    pub clock: u64,
    /// Workpiece position, mm.
    pub position_mm: f64,
    /// Lead error of the table, µm.
    pub lead_error_um: f64,
    /// Correction by the motor, µm.
    pub correction_um: f64,
    /// Last reading of the recorder, µm.
    pub error_um: f64,
}

/// Bits and micrometres of a window: every signal at its first clock, then each change.
#[derive(Clone, Debug, Default)]
pub struct Waveform {
    /// Signals looked at: path and width in bits.
    pub signals: Vec<(String, u32)>,
    /// Changes, by clock; at the first clock one for every signal.
    pub changes: Vec<Change>,
    /// Micrometres, by clock.
    pub analogue: Vec<Analogue>,
    /// First clock, and the one after the last.
    pub window: Range<u64>,
}

/// The signals of the named scopes: an instance with all below it, `top` for the ports and local
/// signals of the device itself, `all` for everything, or one signal by its path.
///
/// # Errors
///
/// [`Error::NoScope`] when a name fits nothing.
pub fn signals_of(netlist: &Netlist, scopes: &[String]) -> Result<Vec<SignalId>, Error> {
    for scope in scopes {
        if !netlist.signals.iter().any(|signal| is_in(&signal.path, scope)) {
            return Err(Error::NoScope { scope: scope.clone(), known: scopes_of(netlist) });
        }
    }
    let chosen = |path: &str| scopes.iter().any(|scope| is_in(path, scope));
    let ids = (0..).map(SignalId).zip(&netlist.signals);
    Ok(ids.filter(|(_, signal)| chosen(&signal.path)).map(|(id, _)| id).collect())
}

fn is_in(path: &str, scope: &str) -> bool {
    match scope {
        "all" => true,
        "top" => !path.contains('.'),
        _ => path.strip_prefix(scope).is_some_and(|rest| rest.is_empty() || rest.starts_with('.')),
    }
}

fn scopes_of(netlist: &Netlist) -> Vec<String> {
    let instances = netlist.signals.iter().filter_map(|signal| signal.path.rsplit_once('.'));
    let names: BTreeSet<&str> = instances.map(|(instance, _)| instance).collect();
    ["all", "top"].into_iter().chain(names).map(str::to_owned).collect()
}

impl Waveform {
    /// An empty waveform of what `probe` looks at.
    #[must_use]
    pub fn new(netlist: &Netlist, probe: &Probe) -> Self {
        let named = |id: &SignalId| {
            let signal = &netlist.signals[id.0 as usize];
            (signal.path.clone(), signal.width)
        };
        Self {
            signals: probe.signals.iter().map(named).collect(),
            window: probe.window.clone(),
            ..Self::default()
        }
    }

    /// Forgets what has been seen, not what is looked at.
    pub(crate) fn clear(&mut self) {
        self.changes.clear();
        self.analogue.clear();
    }
}

/// Fills a [`Waveform`] as the run goes on.
#[derive(Clone, Debug)]
pub(crate) struct Recording {
    pub(crate) probe: Probe,
    pub(crate) waveform: Waveform,
    /// Values of the signals; none before the first sample.
    last: Vec<u64>,
    now: Vec<u64>,
}

impl Recording {
    pub(crate) fn new(netlist: &Netlist, probe: Probe) -> Self {
        let waveform = Waveform::new(netlist, &probe);
        Self { probe, waveform, last: Vec::new(), now: Vec::new() }
    }

    /// Notes what has changed, at most once a clock, when inputs and flip-flops are settled; false
    /// when the waveform is full.
    pub(crate) fn sample(&mut self, engine: &mut impl Engine, analogue: Analogue) -> bool {
        let clock = engine.clock();
        engine.values(&self.probe.signals, &mut self.now);
        for (signal, &value) in self.now.iter().enumerate() {
            if self.last.get(signal) != Some(&value) {
                self.waveform.changes.push(Change { clock, signal, value });
            }
        }
        std::mem::swap(&mut self.last, &mut self.now);
        let differs = |before: &Analogue| Analogue { clock: before.clock, ..analogue } != *before;
        if self.waveform.analogue.last().is_none_or(differs) {
            self.waveform.analogue.push(analogue);
        }
        self.waveform.changes.len() < MOST_CHANGES
    }
}
