//! Debug logs of the PHD2 autoguider: the same readings and pushes as in a guide log, to the
//! millisecond of the computer's clock.
//!
//! A line begins with the clock, the seconds since the line before, and a thread. `Moving (…) raw
//! xDistance=… yDistance=…` is a reading in pixels; the algorithms of right ascension and then of
//! declination answer it with `… returns PUSH from input READING`. Format: PHD2 issue 1013, which
//! quotes such a log. A line has no date: past midnight the clock begins anew.

use helixlock_traces::Column;

use super::phd2::{Wanted, ask_for_scale, wanted};
use crate::build::Built;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::instant::{Order, parse};
use crate::number::number;
use crate::place::Place;

const DAY_S: f64 = 86_400.0;

/// A pause, in usual intervals, behind which guiding was begun anew.
const PAUSE: f64 = 10.0;

/// A reading and the push that answers it, pixels.
struct Frame {
    time_s: f64,
    raw: f64,
    push: f64,
}

/// True for a line of such a log.
pub(crate) fn fits(line: &str) -> bool {
    parted(line).is_some()
}

/// Clock and message of a line.
fn parted(line: &str) -> Option<(&str, &str)> {
    let mut words = line.splitn(4, ' ');
    let (clock, since) = (words.next()?, words.next()?);
    words.next()?;
    let is_clock = clock.len() == 12 && clock.bytes().filter(|byte| *byte == b':').count() == 2;
    let is_since = since.len() == 6 && since.as_bytes().get(2) == Some(&b'.');
    (is_clock && is_since).then(|| (clock, words.next().unwrap_or_default()))
}

/// Reads a debug log.
pub(crate) fn read(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let Wanted { is_dec, unguided, scale } = wanted(decisions);
    let frames = frames(decisions.file(), lines, is_dec)?;
    if scale.is_none() {
        ask_for_scale(decisions);
    }
    decisions.note("time counts from the first reading, by the clock of the log");
    let table = Table::of(&frames, scale.unwrap_or(1.0), unguided);
    if 1.0 < table.passes.last().copied().unwrap_or(1.0) {
        decisions.note("a pause of more than ten intervals begins a pass");
    }
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let columns = vec![
        column("time_s", table.time_s),
        column("error_arcsec", table.error),
        column("pass", table.passes),
    ];
    Ok(Built { columns, origin_s: None })
}

/// Every reading of an axis, with the push that answers it.
fn frames(file: &str, lines: &[&str], is_dec: bool) -> Result<Vec<Frame>, ImportError> {
    let (mut frames, mut answers, mut midnights): (Vec<Frame>, usize, f64) = (Vec::new(), 0, 0.0);
    for (index, line) in lines.iter().enumerate() {
        let Some((clock, message)) = parted(line) else { continue };
        let found = |word: &str, expected: &str| {
            ImportError::found(Place::word(file, index + 1, line, word), quoted(word), expected)
        };
        if message.starts_with("Moving (") {
            let name = if is_dec { "yDistance=" } else { "xDistance=" };
            let word = message.split(name).nth(1).and_then(|rest| rest.split(' ').next());
            let raw = word.and_then(|word| number(word, '.'));
            let raw = raw.ok_or_else(|| found(message, "a reading behind `raw xDistance=`"))?;
            let second = parse(clock, Order::Year).map(|instant| instant.second);
            let second = second.ok_or_else(|| found(clock, "a time of day"))?;
            let before = frames.last().map_or(f64::NEG_INFINITY, |frame| frame.time_s);
            if midnights + second < before - 0.5 * DAY_S {
                midnights += DAY_S;
            }
            let time_s = midnights + second;
            if time_s < before {
                return Err(found(clock, "a clock that does not go back"));
            }
            frames.push(Frame { time_s, raw, push: 0.0 });
            answers = 0;
        } else if let Some((_, rest)) = message.split_once("esult() returns ") {
            let push = rest.split(' ').next().and_then(|word| number(word, '.'));
            let push = push.ok_or_else(|| found(message, "a push behind `returns`"))?;
            if let Some(frame) = frames.last_mut().filter(|_| answers == usize::from(is_dec)) {
                frame.push = push;
            }
            answers += 1;
        }
    }
    if frames.len() < 2 {
        let found = format!("{} readings", frames.len());
        return Err(ImportError::found(Place::file(file), found, "lines with `Moving (`"));
    }
    Ok(frames)
}

/// What the frames say of the drive.
struct Table {
    time_s: Vec<f64>,
    error: Vec<f64>,
    passes: Vec<f64>,
}

impl Table {
    fn of(frames: &[Frame], scale: f64, unguided: bool) -> Self {
        let pause_s = PAUSE * usual_interval_s(frames);
        let mut table = Self { time_s: Vec::new(), error: Vec::new(), passes: Vec::new() };
        let (mut pass, mut pushed, mut before_s) = (1.0, 0.0, frames[0].time_s);
        for frame in frames {
            if pause_s < frame.time_s - before_s {
                pass += 1.0;
                pushed = 0.0;
            }
            before_s = frame.time_s;
            let error = scale * (frame.raw + if unguided { pushed } else { 0.0 });
            table.time_s.push(((frame.time_s - frames[0].time_s) * 1e6).round() / 1e6);
            table.error.push((error * 1e4).round() / 1e4);
            table.passes.push(pass);
            pushed += frame.push;
        }
        table
    }
}

fn usual_interval_s(frames: &[Frame]) -> f64 {
    let mut intervals: Vec<f64> =
        frames.windows(2).map(|pair| pair[1].time_s - pair[0].time_s).collect();
    intervals.sort_by(f64::total_cmp);
    intervals[intervals.len() / 2]
}
