//! Sessions of sigrok: logic channels of a stepping motor, as its net steps over time.
//!
//! A ZIP archive with `version`, `metadata` (channels and sample rate) and the samples in parts
//! `logic-1-1`, `logic-1-2` …, `unitsize` bytes each, channel 1 in the lowest bit.
//! Format: sigrok wiki, "File format:Sigrok/v2".

use std::io::{Cursor, Read};

use helixlock_traces::Column;
use zip::ZipArchive;

use super::unpacked::Room;
use crate::build::Built;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::number::number;
use crate::place::Place;
use crate::question::Answer;
use crate::recipe::Value;

/// What `metadata` says.
#[derive(Debug, Default)]
struct Session {
    part: String,
    rate_hz: f64,
    unit_size: usize,
    /// Names of the channels, from the lowest bit.
    channels: Vec<String>,
}

/// Net steps at every step.
#[derive(Debug, Default)]
struct Counted {
    before: Option<u64>,
    samples: u64,
    steps: f64,
    time_s: Vec<f64>,
    count: Vec<f64>,
}

/// Reads a session.
pub(crate) fn read(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let file = decisions.file();
    let refuse = |found: String, expected: &str| {
        ImportError::found(Place::file(file), found, expected.to_owned())
    };
    let broken = |error: zip::result::ZipError| refuse(error.to_string(), "a whole sigrok session");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(broken)?;
    let mut text = String::new();
    let metadata = archive.by_name("metadata").map_err(broken)?;
    let read = metadata.take(1 << 20).read_to_string(&mut text);
    read.map_err(|error| refuse(error.to_string(), "`metadata` as text"))?;
    let session = Session::read(file, &text)?;
    let Some(step) = channel(&session, "step", "step", decisions) else {
        return Ok(Built { columns: Vec::new(), origin_s: None });
    };
    let direction = channel(&session, "direction", "dir", decisions);
    let mut counted = Counted::default();
    let mut room = Room::of_an_archive();
    // Older sessions have all samples in one part, without a number.
    let parts = (1..=archive.len()).map(|part| format!("{}-{part}", session.part));
    let parts: Vec<String> = std::iter::once(session.part.clone())
        .chain(parts)
        .filter(|name| archive.index_for_name(name).is_some())
        .collect();
    for name in parts {
        let samples = archive.by_name(&name).map_err(broken)?;
        let data = room.unpack(samples).map_err(|error| refuse(error.to_string(), "samples"))?;
        let data = data.ok_or_else(|| refuse("more samples".into(), "up to 512 MB of them"))?;
        for unit in data.chunks_exact(session.unit_size) {
            let lines = unit.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte));
            counted.sample(lines, step, direction, session.rate_hz);
        }
    }
    if counted.time_s.is_empty() {
        let found = format!("no step on {}", quoted(&session.channels[step]));
        return Err(refuse(found, "a channel that steps"));
    }
    let columns = [("time_s", counted.time_s), ("steps", counted.count)];
    let columns = columns.map(|(name, values)| Column { name: name.into(), values });
    Ok(Built { columns: columns.into(), origin_s: None })
}

impl Session {
    fn read(file: &str, text: &str) -> Result<Self, ImportError> {
        let mut session = Self { unit_size: 1, ..Self::default() };
        for (index, line) in text.lines().enumerate() {
            let Some((key, value)) = line.split_once('=') else { continue };
            let (key, value) = (key.trim(), value.trim());
            let wrong = |expected: &str| {
                let found = format!("{} in `metadata`, line {}", quoted(line), index + 1);
                ImportError::found(Place::file(file), found, expected.to_owned())
            };
            if key == "capturefile" {
                value.clone_into(&mut session.part);
            } else if key == "unitsize" {
                let size = value.parse().ok().filter(|size| (1..=8).contains(size));
                session.unit_size = size.ok_or_else(|| wrong("one to eight bytes a sample"))?;
            } else if key == "samplerate" {
                session.rate_hz = rate_hz(value).ok_or_else(|| wrong("a rate such as `2 MHz`"))?;
            } else if let Some(place) = key.strip_prefix("probe") {
                let place = place.parse::<usize>().ok().filter(|place| (1..=64).contains(place));
                let place = place.ok_or_else(|| wrong("a channel from 1 to 64"))?;
                session.channels.resize(session.channels.len().max(place), String::new());
                value.clone_into(&mut session.channels[place - 1]);
            }
        }
        if session.part.is_empty() || session.channels.is_empty() || session.rate_hz <= 0.0 {
            let found = "`metadata` without capture, channels or rate";
            return Err(ImportError::found(
                Place::file(file),
                found,
                "a session of logic channels",
            ));
        }
        Ok(session)
    }
}

fn rate_hz(text: &str) -> Option<f64> {
    let (value, unit) = text.split_once(' ').unwrap_or((text, "Hz"));
    let factor = match unit.trim() {
        "Hz" => 1.0,
        "kHz" => 1e3,
        "MHz" => 1e6,
        "GHz" => 1e9,
        _ => return None,
    };
    number(value, '.').map(|value| value * factor).filter(|rate| 0.0 < *rate)
}

/// The channel a recipe names, or the only one whose name says so; the step must be known.
fn channel(
    session: &Session,
    key: &str,
    word: &str,
    decisions: &mut Decisions<'_>,
) -> Option<usize> {
    let place = |name: &str| session.channels.iter().position(|channel| channel == name);
    if let Some(Value::Text(name)) = decisions.given("sigrok", key) {
        let name = name.clone();
        if name == "none" && key == "direction" {
            return None;
        }
        if let Some(place) = place(&name) {
            return Some(place);
        }
    }
    let named: Vec<usize> = (0..session.channels.len())
        .filter(|at| session.channels[*at].to_lowercase().contains(word))
        .collect();
    if let [only] = named.as_slice() {
        let name = session.channels[*only].clone();
        decisions.text("sigrok", key, || (name, format!("its name has `{word}` in it")));
        return Some(*only);
    }
    if named.is_empty() && key == "direction" {
        let reason = "no channel is named so: every step counts as forward";
        decisions.text("sigrok", key, || ("none".into(), reason.into()));
        return None;
    }
    let all: Vec<usize> =
        if named.is_empty() { (0..session.channels.len()).collect() } else { named };
    let answers = all.into_iter().filter(|at| !session.channels[*at].is_empty()).map(|at| {
        let name = &session.channels[at];
        Answer {
            label: quoted(name),
            recipe: format!("[sigrok]\n{key} = {}", toml_edit::Value::from(name.as_str())),
        }
    });
    let text = format!(
        "which channel is the {key} is not told (pulses of a grating and a laser: `sigrok-cli -i FILE.sr -O vcd` makes a capture for `compare`)"
    );
    decisions.question(&text, answers.collect());
    None
}

impl Counted {
    fn sample(&mut self, lines: u64, step: usize, direction: Option<usize>, rate_hz: f64) {
        let high = |channel: usize| lines >> channel & 1 == 1;
        let was = self.before.is_some_and(|before| before >> step & 1 == 1);
        if self.before.is_some() && high(step) && !was {
            self.steps += if direction.is_none_or(high) { 1.0 } else { -1.0 };
            #[expect(clippy::cast_precision_loss, reason = "samples are far below 2⁵³")]
            self.time_s.push(self.samples as f64 / rate_hz);
            self.count.push(self.steps);
        }
        self.before = Some(lines);
        self.samples += 1;
    }
}
