//! The edges of every one-bit signal of a dump, as a logic analyser shows them.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use crate::error::{At, TraceError};
use crate::file::{LONGEST_BYTES, read_bytes};
use crate::vcd::{Bit, Change, Signal, Tick, Value, VcdReader};

/// Most changes of a dump; a pass over a metre has some five million.
const MOST_CHANGES: usize = 40_000_000;

/// Edges of the one-bit signals of a dump.
#[derive(Clone, Debug)]
pub struct Capture {
    /// The file they came from.
    pub path: PathBuf,
    /// Unit of the instants.
    pub tick: Tick,
    /// End of the record, in ticks.
    pub end_ticks: u64,
    /// The signals, in the order of the file.
    pub signals: Vec<CapturedSignal>,
}

/// Edges of one signal, in ticks; a rise and a fall take turns unless the level was unknown
/// between.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CapturedSignal {
    /// Scopes and name joined by dots.
    pub path: String,
    /// The first known level; `None` if there is none.
    pub first_high: Option<bool>,
    /// Instants at which it rises.
    pub rising_ticks: Vec<u64>,
    /// Instants at which it falls.
    pub falling_ticks: Vec<u64>,
}

impl Capture {
    /// The signal called `name`: its whole path, or as many of its last parts as make it unique.
    ///
    /// # Errors
    ///
    /// [`TraceError::NoSignal`] when there is none, or more than one.
    pub fn signal(&self, name: &str) -> Result<&CapturedSignal, TraceError> {
        if let Some(exact) = self.signals.iter().find(|signal| signal.path == name) {
            return Ok(exact);
        }
        let ends = |path: &str| path.strip_suffix(name).is_some_and(|scope| scope.ends_with('.'));
        let meant: Vec<_> = self.signals.iter().filter(|signal| ends(&signal.path)).collect();
        match meant.as_slice() {
            [signal] => Ok(signal),
            [] => Err(self.no_signal(name, "is missing", &self.signals.iter().collect::<Vec<_>>())),
            several => Err(self.no_signal(name, "may mean several", several)),
        }
    }

    /// Instants at which a signal rises, in seconds.
    ///
    /// # Errors
    ///
    /// As [`Capture::signal`].
    pub fn rising_s(&self, name: &str) -> Result<Vec<f64>, TraceError> {
        let ticks = &self.signal(name)?.rising_ticks;
        Ok(ticks.iter().map(|ticks| self.tick.seconds(*ticks)).collect())
    }

    fn no_signal(
        &self,
        name: &str,
        problem: &'static str,
        signals: &[&CapturedSignal],
    ) -> TraceError {
        const MOST: usize = 12;
        let mut found: Vec<_> =
            signals.iter().take(MOST).map(|signal| format!("`{}`", signal.path)).collect();
        if signals.len() > MOST {
            found.push(format!("{} more", signals.len() - MOST));
        }
        let found = if found.is_empty() { "no one-bit signal".into() } else { found.join(", ") };
        TraceError::NoSignal { path: self.path.clone(), name: name.into(), problem, found }
    }
}

impl CapturedSignal {
    /// The last known level at an instant; an edge at that very instant counts.
    #[must_use]
    pub fn high_at(&self, ticks: u64) -> Option<bool> {
        let last = |edges: &[u64]| {
            let passed = edges.partition_point(|edge| *edge <= ticks);
            passed.checked_sub(1).map(|index| edges[index])
        };
        match (last(&self.rising_ticks), last(&self.falling_ticks)) {
            (None, None) => self.first_high,
            (rise, fall) => Some(fall < rise),
        }
    }
}

/// Reads the edges of all one-bit signals of a dump.
///
/// The first value of a signal is no edge, nor is a change from or to an unknown level. A pulse
/// that begins and ends at one instant is left out: it has no width.
///
/// # Errors
///
/// Those of [`VcdReader`], and a file that cannot be opened.
pub fn read_capture(path: &Path) -> Result<Capture, TraceError> {
    capture_edges(read_bytes(path, LONGEST_BYTES)?.as_slice(), path)
}

/// As [`read_capture`], from text already at hand; `path` is for messages only.
///
/// # Errors
///
/// Those of [`VcdReader`].
pub fn capture_edges(reader: impl BufRead, path: &Path) -> Result<Capture, TraceError> {
    let mut reader = VcdReader::new(reader, path)?;
    let channels = reader.signals().iter().map(|signal| signal.channel + 1).max().unwrap_or(0);
    let mut edges = vec![Edges::default(); channels];
    for (count, change) in reader.by_ref().enumerate() {
        let Change { ticks, channel, value } = change?;
        if count == MOST_CHANGES {
            let at = At::file(path);
            return Err(TraceError::TooMany { at, most: MOST_CHANGES, what: "changes" });
        }
        if let Value::Bit(bit) = value {
            edges[channel].take(ticks, bit);
        }
    }
    let one_bit = |signal: &&Signal| signal.width == 1 && !signal.real;
    let signals = reader.signals().iter().filter(one_bit).map(|signal| {
        let Edges { first_high, rising_ticks, falling_ticks, .. } = edges[signal.channel].clone();
        CapturedSignal { path: signal.path.clone(), first_high, rising_ticks, falling_ticks }
    });
    Ok(Capture {
        path: path.to_owned(),
        tick: reader.tick(),
        end_ticks: reader.ticks(),
        signals: signals.collect(),
    })
}

/// Edges of one channel so far.
#[derive(Clone, Default)]
struct Edges {
    first_high: Option<bool>,
    /// Present level, if known.
    high: Option<bool>,
    rising_ticks: Vec<u64>,
    falling_ticks: Vec<u64>,
}

impl Edges {
    fn take(&mut self, ticks: u64, bit: Bit) {
        let high = match bit {
            Bit::V0 => Some(false),
            Bit::V1 => Some(true),
            Bit::X | Bit::Z => None,
        };
        self.first_high = self.first_high.or(high);
        match (self.high, high) {
            (Some(false), Some(true)) => {
                edge(&mut self.rising_ticks, &mut self.falling_ticks, ticks);
            }
            (Some(true), Some(false)) => {
                edge(&mut self.falling_ticks, &mut self.rising_ticks, ticks);
            }
            _ => {}
        }
        self.high = high;
    }
}

/// Adds an edge, or takes back the opposite one of the same instant.
fn edge(these: &mut Vec<u64>, opposite: &mut Vec<u64>, ticks: u64) {
    if opposite.last() == Some(&ticks) {
        opposite.pop();
    } else {
        these.push(ticks);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "$timescale 1us $end\n$scope module libsigrok $end\n\
        $var wire 1 ! laser $end\n$var wire 1 \" grating $end\n$upscope $end\n\
        $scope module copy $end\n$var wire 1 ! laser $end\n$upscope $end\n\
        $enddefinitions $end\n\
        #0 1! 0\"\n#2 0!\n#3 1! 1\"\n#3 0!\n#5 x\"\n#6 1\"\n#7 1! 0\"\n#9\n";

    fn capture() -> Capture {
        capture_edges(TEXT.as_bytes(), Path::new("two.vcd")).unwrap()
    }

    #[test]
    fn first_values_unknown_levels_and_empty_pulses_are_no_edges() {
        let capture = capture();
        let laser = capture.signal("libsigrok.laser").unwrap();
        assert_eq!((laser.first_high, laser.falling_ticks.as_slice()), (Some(true), &[2][..]));
        assert_eq!(laser.rising_ticks, [7]);
        let grating = capture.signal("grating").unwrap();
        assert_eq!(
            (grating.rising_ticks.as_slice(), grating.falling_ticks.as_slice()),
            (&[3][..], &[7][..])
        );
        assert_eq!(capture.end_ticks, 9);
        let levels = [0, 1, 2, 6, 7, 9].map(|ticks| laser.high_at(ticks));
        assert_eq!(levels, [true, true, false, false, true, true].map(Some));
    }

    #[test]
    fn a_name_must_mean_one_signal() {
        let capture = capture();
        assert_eq!(
            capture.signal("laser").unwrap_err().to_string(),
            "two.vcd: signal `laser` may mean several, found `libsigrok.laser`, `copy.laser`"
        );
        assert_eq!(
            capture.signal("fringe").unwrap_err().to_string(),
            "two.vcd: signal `fringe` is missing, found `libsigrok.laser`, `libsigrok.grating`, `copy.laser`"
        );
        assert_eq!(capture.rising_s("grating").unwrap(), [3e-6]);
    }
}
