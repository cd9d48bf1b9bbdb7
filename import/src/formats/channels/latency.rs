//! How much later one channel comes than another.
//!
//! Two channels of one motion that were stamped by different clocks are shifted against each other. The shift
//! is the one at which their rates of change agree best, but for a factor and a sign: where their
//! cross-correlation is largest. It has to stand alone. A motion that repeats agrees with itself once a
//! period; and a speed agrees with its integral, which lags by nothing, at two shifts of opposite sign, as
//! the correlation of a rate with what it is the rate of is odd.

use super::Channel;

/// How much later `other` comes than `lead`, and how alike they are then (−1 to 1); nothing where no one
/// shift stands out.
pub(super) fn latency_s(lead: &Channel, other: &Channel) -> Option<(f64, f64)> {
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
        Channel { time_s, values, ..Channel::default() }
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
