//! Channels with clocks of their own, laid side by side.
//!
//! Two channels of one motion that were stamped by different clocks are shifted against each other. The shift
//! is the one at which their rates of change agree best, but for a factor and a sign: where their
//! cross-correlation is largest. It has to stand alone. A motion that repeats agrees with itself once a
//! period; and a speed agrees with its integral, which lags by nothing, at two shifts of opposite sign, as
//! the correlation of a rate with what it is the rate of is odd.

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;
use crate::recipe::Value;

/// A channel: when, and what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Channel {
    pub(crate) name: String,
    pub(crate) time_s: Vec<f64>,
    pub(crate) values: Vec<f64>,
}

impl Channel {
    /// True when every sample of the one comes with one of the other.
    fn is_sampled_with(&self, other: &Self) -> bool {
        let mut pairs = self.time_s.iter().zip(&other.time_s);
        self.time_s.len() == other.time_s.len() && pairs.all(|(a, b)| (a - b).abs() <= 0.0)
    }

    /// The value at a time, straight between samples; NaN outside of them.
    fn at(&self, time_s: f64) -> f64 {
        let next = self.time_s.partition_point(|sample| *sample < time_s);
        if self.time_s.get(next).is_some_and(|sample| *sample <= time_s) {
            return self.values[next];
        }
        let Some(before) = next.checked_sub(1).filter(|_| next < self.time_s.len()) else {
            return f64::NAN;
        };
        let (from, to) = (self.time_s[before], self.time_s[next]);
        let share = (time_s - from) / (to - from);
        self.values[before] + share * (self.values[next] - self.values[before])
    }
}

/// A grid with a column of time and one a channel, on the clock of the busiest one.
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
    let busiest = channels
        .iter()
        .enumerate()
        .max_by_key(|(index, channel)| (channel.values.len(), usize::MAX - index));
    let lead = busiest.map_or(0, |(index, _)| index);
    decisions.text("channels", "clock", || {
        let one = channels.iter().all(|channel| channel.is_sampled_with(&channels[lead]));
        let reason = if one { "all channels have its times" } else { "it has the most samples" };
        (channels[lead].name.clone(), reason.into())
    });
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
    let others = channels.iter().filter(|channel| !channel.is_sampled_with(&channels[lead]));
    let names: Vec<String> = others.map(|channel| quoted(&channel.name)).collect();
    if !names.is_empty() {
        decisions.note(format!(
            "sampled at other times than {clock}, and taken at its times, straight between two samples: {}",
            names.join(", ")
        ));
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

/// How much later `other` comes than `lead`, and how alike they are then (−1 to 1); nothing where no one
/// shift stands out.
fn latency_s(lead: &Channel, other: &Channel) -> Option<(f64, f64)> {
    const GRID: usize = 2048;
    let start = lead.time_s.first()?.max(*other.time_s.first()?);
    let end = lead.time_s.last()?.min(*other.time_s.last()?);
    let span = end - start;
    if span <= 0.0 || !span.is_finite() {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "a few thousand steps")]
    let step = span / GRID as f64;
    let rates = |channel: &Channel| -> Vec<f64> {
        #[expect(clippy::cast_precision_loss, reason = "a few thousand steps")]
        let value = |index: usize| channel.at(start + step * index as f64);
        (1..GRID)
            .map(|index| value(index) - value(index - 1))
            .map(|rate| if rate.is_finite() { rate } else { 0.0 })
            .collect()
    };
    let (first, second) = (centred(rates(lead)), centred(rates(other)));
    let most = isize::try_from(GRID / 8).ok()?;
    let likeness: Vec<f64> =
        (-most..=most).map(|shift| correlation(&first, &second, shift)).collect();
    let best = standing_out(&likeness)?;
    #[expect(clippy::cast_precision_loss, reason = "a few hundred steps")]
    let coarse_s = step * (best as f64 - most as f64);
    Some(((refined_s(lead, other, coarse_s) * 1e6).round() / 1e6, likeness[best]))
}

/// Where the one peak is, of either sign, that stands clearly above all others.
///
/// The square of a correlation is the share of the one that the other explains. A peak ends where it has
/// fallen to half, and stands out where it leaves at most half of what is left anywhere beside it; of all
/// there is, where nothing beside it explains anything. A hundredth is always left: so well the line from one
/// sample to the next is known.
fn standing_out(likeness: &[f64]) -> Option<usize> {
    const LEFT: f64 = 0.01;
    let explained: Vec<f64> = likeness.iter().map(|likeness| likeness * likeness).collect();
    let best = (0..explained.len()).max_by(|a, b| explained[*a].total_cmp(&explained[*b]))?;
    let fallen = |at: &usize| explained[*at] < 0.5 * explained[best];
    let before = (0..best).rev().find(fallen).map_or(0, |at| at + 1);
    let behind = (best..explained.len()).find(fallen).unwrap_or(explained.len());
    let beside = explained[..before].iter().chain(&explained[behind..]);
    let rival = beside.copied().fold(0.0, f64::max);
    ((1.0 - explained[best]).max(LEFT) <= 0.5 * (1.0 - rival)).then_some(best)
}

/// The shift near `coarse_s` at which one channel is best a straight function of the other.
fn refined_s(lead: &Channel, other: &Channel, coarse_s: f64) -> f64 {
    const STEPS: i32 = 60;
    let spacing_s = (lead.time_s[lead.time_s.len() - 1] - lead.time_s[0]) / f64::from(STEPS);
    let spacing_s = spacing_s.min(4.0 * typical_step_s(other)) / f64::from(STEPS);
    let unlike = |step: i32| {
        let shift_s = coarse_s + spacing_s * f64::from(step);
        let pairs = lead
            .time_s
            .iter()
            .zip(&lead.values)
            .map(|(time, value)| (*value, other.at(time + shift_s)));
        let (first, second): (Vec<f64>, Vec<f64>) =
            pairs.filter(|(_, value)| value.is_finite()).unzip();
        1.0 - correlation(&centred(first), &centred(second), 0).abs()
    };
    let best = (-STEPS..=STEPS).min_by(|a, b| unlike(*a).total_cmp(&unlike(*b))).unwrap_or(0);
    let (before, at, after) = (unlike(best - 1), unlike(best), unlike(best + 1));
    let curve = before - 2.0 * at + after;
    let within = if 0.0 < curve { 0.5 * (before - after) / curve } else { 0.0 };
    coarse_s + spacing_s * (f64::from(best) + within.clamp(-0.5, 0.5))
}

fn typical_step_s(channel: &Channel) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "samples are few beside 2⁵³")]
    let steps = (channel.time_s.len() - 1).max(1) as f64;
    (channel.time_s[channel.time_s.len() - 1] - channel.time_s[0]) / steps
}

fn centred(mut values: Vec<f64>) -> Vec<f64> {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand values")]
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    for value in &mut values {
        *value -= mean;
    }
    values
}

/// Likeness of `first` now and `second` `shift` steps later.
fn correlation(first: &[f64], second: &[f64], shift: isize) -> f64 {
    let pairs = first.iter().enumerate().filter_map(|(index, a)| {
        let later = index.checked_add_signed(shift)?;
        second.get(later).map(|b| (a, b))
    });
    let (product, a2, b2) = pairs.fold((0.0, 0.0, 0.0), |(product, a2, b2), (a, b)| {
        (product + a * b, a2 + a * a, b2 + b * b)
    });
    let size = (a2 * b2).sqrt();
    if 0.0 < size { product / size } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty seconds of what is moved by `value`, that comes `late` seconds late.
    fn channel(late: f64, rate: f64, value: impl Fn(f64) -> f64) -> Channel {
        let time_s: Vec<f64> = (0..2000).map(|n| f64::from(n) / rate).collect();
        let values = time_s.iter().map(|time| value(time - late)).collect();
        Channel { name: String::new(), time_s, values }
    }

    fn moved(t: f64) -> f64 {
        libm::sin(3.0 * t) + 0.3 * libm::sin(7.3 * t)
    }

    /// A motion that comes 0.125 s late is found late by that, whichever way and in whatever unit it counts.
    #[test]
    fn a_known_latency_is_found() {
        for factor in [1.0, -1.0, -1000.0] {
            let other = channel(0.125, 83.0, |t| factor * moved(t));
            let (latency, likeness) = latency_s(&channel(0.0, 100.0, moved), &other).unwrap();
            assert!((latency - 0.125).abs() < 0.002, "{factor}: {latency}");
            assert!(0.99 < likeness * factor.signum(), "{factor}: {likeness}");
        }
    }

    /// A speed is the rate of its position, and neither is late; a sine is itself again a period later.
    #[test]
    fn nothing_is_late_where_several_shifts_fit_as_well() {
        let speed = |t: f64| 3.0 * libm::cos(3.0 * t) + 2.19 * libm::cos(7.3 * t);
        assert!(latency_s(&channel(0.0, 100.0, moved), &channel(0.0, 83.0, speed)).is_none());
        let sine = |t: f64| libm::sin(10.0 * t);
        assert!(latency_s(&channel(0.0, 100.0, sine), &channel(0.125, 83.0, sine)).is_none());
        let other = |t: f64| libm::sin(1.3 * t * t);
        assert!(latency_s(&channel(0.0, 100.0, moved), &channel(0.0, 83.0, other)).is_none());
    }
}
