//! A logic analyser's capture of the device's two references, for the commands that compare.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{anyhow, bail};
use clap::Args;
use helixlock_lab::{PulseTrains, Steps};
use helixlock_plant::{Model, Part};
use helixlock_traces::{Capture, CapturedSignal};

use super::input::Input;

/// Signals of a captured value change dump; without them they are found by their names.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct Signals {
    /// In a VCD capture, the signal of the grating lines
    #[arg(long = "grating-signal", value_name = "SIGNAL")]
    grating: Option<String>,
    /// In a VCD capture, the signal of the laser fringes
    #[arg(long = "laser-signal", value_name = "SIGNAL")]
    laser: Option<String>,
    /// In a VCD capture, the signal of the motor's steps
    #[arg(long = "step-signal", value_name = "SIGNAL", requires = "forward")]
    step: Option<String>,
    /// In a VCD capture, the signal that is high when a step goes forward
    #[arg(long = "forward-signal", value_name = "SIGNAL", requires = "step")]
    forward: Option<String>,
}

/// Whole names and parts of names by which a signal is known.
struct Role {
    whole: &'static [&'static str],
    parts: &'static [&'static str],
}

const GRATING: Role =
    Role { whole: &["grating", "grating_divided"], parts: &["grating", "line", "encoder"] };
const LASER: Role =
    Role { whole: &["laser", "laser_divided"], parts: &["laser", "fringe", "interferometer"] };

impl Signals {
    /// True when a signal was named, which only a capture has.
    pub(crate) fn named(&self) -> bool {
        [&self.grating, &self.laser, &self.step, &self.forward].into_iter().any(Option::is_some)
    }

    /// The words that named them.
    pub(crate) fn words(&self) -> Vec<&OsStr> {
        let named = [
            ("--grating-signal", &self.grating),
            ("--laser-signal", &self.laser),
            ("--step-signal", &self.step),
            ("--forward-signal", &self.forward),
        ];
        let words = named.iter().filter_map(|(word, name)| Some([*word, name.as_deref()?]));
        words.flatten().map(AsRef::as_ref).collect()
    }

    /// Reads the trains of a dump.
    pub(crate) fn read(
        &self,
        machine: &Model,
        path: &Path,
        input: Input,
    ) -> anyhow::Result<PulseTrains> {
        if machine.rotary {
            bail!(
                "{}: found a value change dump, expected a table for a rotary chain\nhint: `helixlock transmission` makes one of two captured encoders",
                path.display()
            );
        }
        if let Some(part) = machine.lacks(&[Part::Grating, Part::Laser, Part::Dividers]) {
            bail!("{}: found a value change dump, whose pulses need {part}", path.display());
        }
        let capture = input.capture()?;
        let (grating, laser) = self.references(&capture, machine)?;
        let seconds = |signal: &CapturedSignal| -> Vec<f64> {
            signal.rising_ticks.iter().map(|ticks| capture.tick.seconds(*ticks)).collect()
        };
        Ok(PulseTrains {
            path: path.to_owned(),
            grating_s: seconds(grating),
            laser_s: seconds(laser),
            steps: self.steps(&capture)?,
        })
    }

    fn references<'a>(
        &self,
        capture: &'a Capture,
        machine: &Model,
    ) -> anyhow::Result<(&'a CapturedSignal, &'a CapturedSignal)> {
        let grating = chosen(capture, self.grating.as_deref(), &GRATING)?;
        let laser = chosen(capture, self.laser.as_deref(), &LASER)?;
        let missing = || {
            let names: Vec<_> =
                capture.signals.iter().take(12).map(|s| format!("`{}`", s.path)).collect();
            anyhow!(
                "{}: found one-bit signals {}, expected one of grating lines and one of laser fringes\nhint: name them with `--grating-signal` and `--laser-signal`",
                capture.path.display(),
                names.join(", ")
            )
        };
        let active: Vec<_> = capture.signals.iter().filter(|s| 1 < s.rising_ticks.len()).collect();
        let other = |known: &CapturedSignal| match active.as_slice() {
            [one, two] if *one == known => Some(*two),
            [one, two] if *two == known => Some(*one),
            _ => None,
        };
        match (grating, laser, active.as_slice()) {
            (Some(grating), Some(laser), _) => Ok((grating, laser)),
            (Some(grating), None, _) => Ok((grating, other(grating).ok_or_else(missing)?)),
            (None, Some(laser), _) => Ok((other(laser).ok_or_else(missing)?, laser)),
            (None, None, [one, two]) => by_rate(one, two, machine).ok_or_else(missing),
            (None, None, _) => Err(missing()),
        }
    }

    /// Steps, when both signals are there.
    fn steps(&self, capture: &Capture) -> anyhow::Result<Option<Steps>> {
        let signal = |given: &Option<String>, usual: &'static [&'static str]| {
            chosen(capture, given.as_deref(), &Role { whole: usual, parts: &[] })
        };
        let step = signal(&self.step, &["step"])?;
        let forward = signal(&self.forward, &["forward"])?;
        let Some((step, forward)) = step.zip(forward) else { return Ok(None) };
        let rises = &step.rising_ticks;
        Ok(Some(Steps {
            at_s: rises.iter().map(|ticks| capture.tick.seconds(*ticks)).collect(),
            forward: rises.iter().map(|ticks| forward.high_at(*ticks) == Some(true)).collect(),
        }))
    }
}

/// The signal that was named, or the one whose name says what it is.
fn chosen<'a>(
    capture: &'a Capture,
    given: Option<&str>,
    role: &Role,
) -> anyhow::Result<Option<&'a CapturedSignal>> {
    if let Some(name) = given {
        return Ok(Some(capture.signal(name)?));
    }
    let with = |fits: &dyn Fn(&str) -> bool| -> Vec<&'a CapturedSignal> {
        let mut found: Vec<&CapturedSignal> = Vec::new();
        for signal in &capture.signals {
            let name = signal.path.rsplit('.').next().unwrap_or_default().to_lowercase();
            // A net carries one train under several names, as in the scopes of a test bench.
            let known = |other: &&CapturedSignal| other.rising_ticks == signal.rising_ticks;
            if fits(&name) && !found.iter().any(known) {
                found.push(signal);
            }
        }
        found
    };
    let whole = role.whole.iter().map(|whole| with(&|name| name == *whole));
    let parts = with(&|name| role.parts.iter().any(|part| name.contains(part)));
    let found = whole.chain([parts]).find(|found| !found.is_empty()).unwrap_or_default();
    match found.as_slice() {
        [] => Ok(None),
        [signal] => Ok(Some(signal)),
        several => {
            let names: Vec<_> = several.iter().map(|s| format!("`{}`", s.path)).collect();
            bail!(
                "{}: found {}, expected one signal\nhint: name it, see `--help`",
                capture.path.display(),
                names.join(", ")
            )
        }
    }
}

/// Grating and laser of two unnamed trains, told apart by which has B/A times the other's pulses.
fn by_rate<'a>(
    one: &'a CapturedSignal,
    two: &'a CapturedSignal,
    machine: &Model,
) -> Option<(&'a CapturedSignal, &'a CapturedSignal)> {
    /// Rates may be off by this much, either way.
    const NEAR: f64 = 1.05;
    let count = |signal: &CapturedSignal| u32::try_from(signal.rising_ticks.len()).map(f64::from);
    let ratio = f64::from(machine.dividers.b) / f64::from(machine.dividers.a);
    let found = count(two).ok()? / count(one).ok()?;
    let near = |expected: f64| (1.0 / NEAR..=NEAR).contains(&(found / expected));
    match (near(ratio), near(1.0 / ratio)) {
        (true, false) => Some((one, two)),
        (false, true) => Some((two, one)),
        _ => None,
    }
}
