//! Channels with clocks of their own, laid side by side.

mod latency;

use std::cmp::Reverse;
use std::collections::BTreeSet;

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;
use crate::recipe::Value;
use crate::runs::counts;
use latency::latency_s;

/// A channel: when, and what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Channel {
    pub(crate) name: String,
    pub(crate) time_s: Vec<f64>,
    pub(crate) values: Vec<f64>,
    /// A value holds until the next is told.
    pub(crate) held: bool,
}

impl Channel {
    /// True when every sample of the one comes with one of the other.
    fn is_sampled_with(&self, other: &Self) -> bool {
        let mut pairs = self.time_s.iter().zip(&other.time_s);
        self.time_s.len() == other.time_s.len() && pairs.all(|(a, b)| (a - b).abs() <= 0.0)
    }

    /// How many values differ from the one before: a value again is no new reading.
    fn readings(&self) -> usize {
        let new = |pair: &&[f64]| pair[0].to_bits() != pair[1].to_bits();
        1 + self.values.windows(2).filter(new).count()
    }

    /// True for what is told only when it changes, far more rarely than the `most` that is told of any channel,
    /// and is nothing between: a count, or a setpoint that takes a few values time and again.
    fn takes_steps(&self, most: usize) -> bool {
        const MORE_RARELY: usize = 10;
        const TIMES_EACH: usize = 4;
        let different: BTreeSet<u64> = self.values.iter().map(|value| value.to_bits()).collect();
        let few = TIMES_EACH * different.len() <= self.values.len();
        MORE_RARELY * self.values.len() <= most
            && self.readings() == self.values.len()
            && (few || counts(&self.values))
    }

    /// The value at a time; NaN before the first sample.
    ///
    /// What is held lasts until the next sample and behind the last one; all else goes straight from sample
    /// to sample, and ends.
    fn at(&self, time_s: f64) -> f64 {
        let next = self.time_s.partition_point(|sample| *sample < time_s);
        if self.time_s.get(next).is_some_and(|sample| *sample <= time_s) {
            return self.values[next];
        }
        let Some(before) = next.checked_sub(1) else { return f64::NAN };
        if self.held {
            return self.values[before];
        }
        if next == self.time_s.len() {
            return f64::NAN;
        }
        let (from, to) = (self.time_s[before], self.time_s[next]);
        let share = (time_s - from) / (to - from);
        self.values[before] + share * (self.values[next] - self.values[before])
    }
}

/// A grid with a column of time and one a channel, on the clock of one of them.
pub(crate) fn grid(
    mut channels: Vec<Channel>,
    decisions: &mut Decisions<'_>,
) -> Result<Grid, ImportError> {
    let file = decisions.file();
    without_short(&mut channels, decisions);
    if channels.is_empty() {
        return Err(ImportError::found(
            Place::file(file),
            "no channel of numbers",
            "channels with three samples and more",
        ));
    }
    for channel in &mut channels {
        sort(channel);
    }
    let most = channels.iter().map(|channel| channel.values.len()).max().unwrap_or(0);
    for channel in &mut channels {
        channel.held = channel.takes_steps(most);
    }
    let lead = clock(&channels, decisions)?;
    shift(&mut channels, lead, decisions);
    tell_between(&channels, lead, decisions);
    if limits::CELLS < channels[lead].values.len() * (1 + channels.len()) {
        return Err(ImportError::found(
            Place::file(file),
            "more cells",
            format!("up to {}", limits::CELLS),
        ));
    }
    side_by_side(file, &channels, lead)
}

/// The channel whose times count: the recipe's, or the one that tells most.
fn clock(channels: &[Channel], decisions: &mut Decisions<'_>) -> Result<usize, ImportError> {
    let name = decisions.text("channels", "clock", || {
        let lead = &channels[tells_most(channels)];
        let one = channels.iter().all(|channel| channel.is_sampled_with(lead));
        let reason = if one { "all channels have its times" } else { "it has the most readings" };
        (lead.name.clone(), reason.into())
    });
    let found = channels.iter().position(|channel| channel.name == name);
    found.ok_or_else(|| {
        let names: Vec<String> = channels.iter().map(|channel| quoted(&channel.name)).collect();
        let found = format!("no channel {} for `clock`", quoted(&name));
        let expected = format!("one of {}", names.join(", "));
        ImportError::found(Place::file(decisions.file()), found, expected)
    })
}

/// Of those with about the most readings the one that repeats least: a channel that is read faster than it
/// changes has rows that tell nothing.
fn tells_most(channels: &[Channel]) -> usize {
    let most = channels.iter().map(Channel::readings).max().unwrap_or(0);
    let about = |index: &usize| 9 * most <= 10 * channels[*index].readings();
    let repeats = |index: &usize| {
        let readings = channels[*index].readings();
        (channels[*index].values.len() - readings, Reverse(readings))
    };
    (0..channels.len()).filter(about).min_by_key(repeats).unwrap_or(0)
}

/// Drops channels that are too short to lie beside others.
fn without_short(channels: &mut Vec<Channel>, decisions: &mut Decisions<'_>) {
    let is_long = |channel: &Channel| 2 < channel.values.len();
    for channel in channels.iter().filter(|channel| !is_long(channel)) {
        decisions.note(format!("`{}` has fewer than three samples: left out", channel.name));
    }
    channels.retain(is_long);
}

/// Takes the other one of two channels earlier, by what the recipe says or by how they move.
///
/// Channels with the same times were sampled by one clock: what one lags behind the other is real.
fn shift(channels: &mut [Channel], lead: usize, decisions: &mut Decisions<'_>) {
    let others: Vec<usize> = (0..channels.len()).filter(|index| *index != lead).collect();
    let &[other] = others.as_slice() else { return };
    let given = decisions.given("channels", "latency_s").cloned();
    let latency = if let Some(Value::Number(latency)) = given {
        latency
    } else if channels[other].is_sampled_with(&channels[lead]) {
        return;
    } else {
        found_latency(&channels[lead], &channels[other], decisions)
    };
    if latency.abs() <= 0.0 {
        return;
    }
    let named = format!("the clock of `{}`", channels[lead].name);
    decisions.note(format!("`{}` is taken {latency} s earlier, on {named}", channels[other].name));
    channels[other].time_s.iter_mut().for_each(|time| *time -= latency);
}

fn found_latency(lead: &Channel, other: &Channel, decisions: &mut Decisions<'_>) -> f64 {
    let (latency, reason) = match latency_s(lead, other) {
        Some((latency, likeness)) => (
            latency,
            format!(
                "`{}` comes that much later than `{}`: there their rates agree best (correlation {likeness:.3})",
                other.name, lead.name
            ),
        ),
        None => {
            (0.0, "no one shift stands out at which the two move alike: not shifted".to_owned())
        }
    };
    decisions.made.set("channels", "latency_s", Value::Number(latency), reason);
    latency
}

/// Says which channels were sampled at other times, and what becomes of them.
fn tell_between(channels: &[Channel], lead: usize, decisions: &mut Decisions<'_>) {
    let clock = quoted(&channels[lead].name);
    for (held, how) in [(false, "straight between two samples"), (true, "held until it changes")] {
        let others = channels.iter().filter(|channel| !channel.is_sampled_with(&channels[lead]));
        let names: Vec<String> = others
            .filter(|channel| channel.held == held)
            .map(|channel| quoted(&channel.name))
            .collect();
        if !names.is_empty() {
            decisions.note(format!(
                "sampled at other times than {clock}, and taken at its times, {how}: {}",
                names.join(", ")
            ));
        }
    }
}

fn side_by_side(file: &str, channels: &[Channel], lead: usize) -> Result<Grid, ImportError> {
    let mut grid = Grid::of_text(file);
    grid.start_row(0, false);
    grid.push("time [s]", 1)?;
    for (index, channel) in channels.iter().enumerate() {
        grid.push(&channel.name, index + 2)?;
    }
    let sampled: Vec<bool> =
        channels.iter().map(|channel| channel.is_sampled_with(&channels[lead])).collect();
    for time in &channels[lead].time_s {
        let values: Vec<f64> = channels.iter().map(|channel| channel.at(*time)).collect();
        if values.iter().any(|value| !value.is_finite()) {
            continue; // a channel had not begun, or was over
        }
        grid.start_row(0, false);
        grid.push(&digits(*time), 1)?;
        for (index, (value, sampled)) in values.iter().zip(&sampled).enumerate() {
            // A sample keeps the digits it has; those of a value between two mean nothing.
            let text = if *sampled { value.to_string() } else { digits(*value) };
            grid.push(&text, index + 2)?;
        }
    }
    Ok(grid)
}

/// Nine decimals: a nanosecond, a picometre.
fn digits(value: f64) -> String {
    let text = format!("{value:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn sort(channel: &mut Channel) {
    let mut order: Vec<usize> = (0..channel.time_s.len()).collect();
    order.sort_by(|a, b| channel.time_s[*a].total_cmp(&channel.time_s[*b]));
    order.dedup_by(|a, b| channel.time_s[*a] <= channel.time_s[*b]);
    channel.time_s = order.iter().map(|index| channel.time_s[*index]).collect::<Vec<_>>();
    let values = order.iter().map(|index| channel.values[*index]).collect();
    channel.values = values;
}
