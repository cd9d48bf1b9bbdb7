//! What EPICS' `camonitor` prints: a name, a date, a time, a value, and the state of an alarm.

use std::collections::BTreeMap;

use super::channels::{self, Channel};
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::instant::{Order, parse};
use crate::number::number;
use crate::place::Place;

/// True when most lines hold a name, a date and a time.
pub(crate) fn fits(lines: &[&str]) -> bool {
    const LOOKED_AT: usize = 200;
    let used: Vec<&&str> =
        lines.iter().filter(|line| !line.trim().is_empty()).take(LOOKED_AT).collect();
    let good = used.iter().filter(|line| split(line).is_some()).count();
    2 < good && used.len() < 2 * good
}

/// Name, instant and the rest of a line.
fn split(line: &str) -> Option<(&str, String, &str)> {
    let (name, rest) = line.trim().split_once([' ', '\t'])?;
    let rest = rest.trim_start();
    let (date, rest) = rest.split_once([' ', '\t'])?;
    let (clock, rest) = rest.trim_start().split_once([' ', '\t']).unwrap_or((rest, ""));
    let good =
        !name.starts_with(|c: char| c.is_ascii_digit()) && date.len() == 10 && clock.contains(':');
    let stamp = format!("{date} {clock}");
    (good && parse(&stamp, Order::Year).is_some()).then_some((name, stamp, rest.trim()))
}

/// Channels side by side.
pub(crate) fn grid(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let mut channels: BTreeMap<&str, Channel> = BTreeMap::new();
    let (mut first_day, mut first_s) = (None, None);
    for (index, line) in lines.iter().enumerate() {
        let Some((name, stamp, rest)) = split(line) else {
            if line.contains("*** ") || line.trim().is_empty() || line.trim_start().starts_with('#')
            {
                continue; // `*** Not connected (PV not found)`
            }
            return Err(ImportError::found(
                Place::line(file, index + 1),
                quoted(line.trim()),
                "a name, a date, a time and a value",
            ));
        };
        if line.contains("*** ") || rest.is_empty() {
            continue;
        }
        let word = rest.split_whitespace().next().unwrap_or_default();
        let Some(value) = number(word, '.') else {
            let place = Place::word(file, index + 1, line, word);
            return Err(ImportError::found(place, quoted(word), format!("a number for `{name}`")));
        };
        let Some(instant) = parse(&stamp, Order::Year) else { continue };
        let day = *first_day.get_or_insert(instant.day.unwrap_or(0));
        let time_s = instant.since(day, 0);
        let start_s = *first_s.get_or_insert(time_s);
        let channel = channels.entry(name).or_default();
        name.clone_into(&mut channel.name);
        channel.time_s.push(time_s - start_s);
        channel.values.push(value);
    }
    channels::grid(channels.into_values().collect(), decisions)
}
