//! What a run is worth, in the few numbers the report of 1977 gives.

use std::collections::VecDeque;

/// Lead error along the screw, taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeadAppraisal {
    /// Largest peak to peak within one turn of the machine's screw, about the mean over a turn, µm.
    pub periodic_um: f64,
    /// Peak to peak of the mean over a turn, along the whole screw, µm.
    pub cumulative_um: f64,
    /// Peak to peak of everything, µm.
    pub total_um: f64,
}

/// Takes a lead error apart into what repeats within `turn_mm` and what piles up over the screw.
///
/// The mean over one turn removes a periodic error and keeps a slope; a screw shorter than two
/// turns has no such mean, so all of its error is called periodic. Positions must rise.
#[must_use]
pub fn appraise_lead(position_mm: &[f64], lead_error_um: &[f64], turn_mm: f64) -> LeadAppraisal {
    let centred = means_over_a_turn(position_mm, lead_error_um, turn_mm);
    let total_um = peak_to_peak(lead_error_um.iter().copied());
    if centred.is_empty() {
        return LeadAppraisal { periodic_um: total_um, cumulative_um: 0.0, total_um };
    }
    let cumulative_um = peak_to_peak(centred.iter().map(|point| point.mean_um));
    let rest: Vec<_> = centred.iter().map(|p| (p.position_mm, p.value_um - p.mean_um)).collect();
    LeadAppraisal { periodic_um: largest_range_within(&rest, turn_mm), cumulative_um, total_um }
}

struct Centred {
    position_mm: f64,
    value_um: f64,
    mean_um: f64,
}

/// Every sample that has half a turn on either side, with the mean over that turn.
fn means_over_a_turn(position_mm: &[f64], value_um: &[f64], turn_mm: f64) -> Vec<Centred> {
    let (Some(first), Some(last)) = (position_mm.first(), position_mm.last()) else {
        return Vec::new();
    };
    let integral = integral_um_mm(position_mm, value_um);
    let inside = |&(&at_mm, _): &(&f64, &f64)| {
        first + turn_mm / 2.0 <= at_mm && at_mm + turn_mm / 2.0 <= *last
    };
    let centred = |(&at_mm, &value): (&f64, &f64)| {
        let upto = |mm: f64| interpolate(position_mm, &integral, mm);
        let mean_um = (upto(at_mm + turn_mm / 2.0) - upto(at_mm - turn_mm / 2.0)) / turn_mm;
        Centred { position_mm: at_mm, value_um: value, mean_um }
    };
    position_mm.iter().zip(value_um).filter(inside).map(centred).collect()
}

/// Trapezoidal integral from the first position to each, µm·mm.
fn integral_um_mm(position_mm: &[f64], value_um: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let pieces = position_mm.windows(2).zip(value_um.windows(2));
    let partial = pieces.map(|(x, y)| {
        sum += (x[1] - x[0]) * (y[0] + y[1]) / 2.0;
        sum
    });
    std::iter::once(0.0).chain(partial).collect()
}

/// Straight line between the two neighbours of `x`, which lies within `xs`.
fn interpolate(xs: &[f64], ys: &[f64], x: f64) -> f64 {
    let above = xs.partition_point(|&other| other < x).clamp(1, xs.len() - 1);
    let (x0, x1) = (xs[above - 1], xs[above]);
    ys[above - 1] + (ys[above] - ys[above - 1]) * ((x - x0) / (x1 - x0))
}

/// Largest minus smallest; 0 for nothing.
#[must_use]
pub fn peak_to_peak(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low <= high { high - low } else { 0.0 }
}

/// Largest range of values among samples at most `window` apart, by two monotone queues.
fn largest_range_within(samples: &[(f64, f64)], window: f64) -> f64 {
    let (mut lows, mut highs) = (VecDeque::new(), VecDeque::new());
    let mut largest = 0.0_f64;
    for &sample in samples {
        enter(&mut lows, sample, window, |before, now| now <= before);
        enter(&mut highs, sample, window, |before, now| before <= now);
        if let (Some((_, low)), Some((_, high))) = (lows.front(), highs.front()) {
            largest = largest.max(high - low);
        }
    }
    largest
}

/// Appends a sample, dropping those it outdoes and those that have left the window.
fn enter(
    queue: &mut VecDeque<(f64, f64)>,
    sample: (f64, f64),
    window: f64,
    outdone: impl Fn(f64, f64) -> bool,
) {
    while queue.back().is_some_and(|last| outdone(last.1, sample.1)) {
        queue.pop_back();
    }
    queue.push_back(sample);
    while queue.front().is_some_and(|first| first.0 < sample.0 - window) {
        queue.pop_front();
    }
}

/// How a closed loop hunts about zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hunting {
    /// Comparisons per second.
    pub comparison_hz: f64,
    /// Swings per second: half the inverse of the median time from one change of sign to the next.
    pub frequency_hz: f64,
    /// Median of the change of the reading from one comparison to the next, µm: the swing.
    pub swing_um: f64,
    /// Share of comparisons, after the first pull to zero, further from zero than twice the swing
    /// allows although the motor ran towards zero throughout.
    pub outrun_share: f64,
}

/// Measures the hunting from the readings of a closed loop, or nothing if they are too few.
///
/// `swing_limit_um` is what the motor moves in one comparison. What comes before the first change
/// of sign is the pull to zero and does not count.
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "a run has far fewer than 2⁵³ comparisons")]
pub fn measure_hunting(
    times_s: &[f64],
    readings_um: &[f64],
    swing_limit_um: f64,
) -> Option<Hunting> {
    let settled = readings_um.windows(2).position(|pair| pair[0] * pair[1] <= 0.0)? + 1;
    let (times_s, readings_um) = (&times_s[settled..], &readings_um[settled..]);
    let span_s = times_s.last()? - times_s.first()?;
    if times_s.len() < 8 {
        return None;
    }
    let turns_s: Vec<f64> = readings_um
        .windows(2)
        .zip(&times_s[1..])
        .filter(|(pair, _)| pair[0] * pair[1] < 0.0)
        .map(|(_, time_s)| *time_s)
        .collect();
    let half_period_s = median(turns_s.windows(2).map(|pair| pair[1] - pair[0]))?;
    let swing_um = median(readings_um.windows(2).map(|pair| (pair[1] - pair[0]).abs()))?;
    let outrun = readings_um.iter().filter(|reading| reading.abs() > 2.0 * swing_limit_um).count();
    Some(Hunting {
        comparison_hz: (times_s.len() - 1) as f64 / span_s,
        frequency_hz: 0.5 / half_period_s,
        swing_um,
        outrun_share: outrun as f64 / readings_um.len() as f64,
    })
}

fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Largest rate of change of a lead error over about `over_s`, µm/s: what the motor must follow.
#[must_use]
pub fn fastest_um_per_s(times_s: &[f64], lead_error_um: &[f64], over_s: f64) -> f64 {
    let mut behind = 0;
    let mut fastest = 0.0_f64;
    for (ahead, time_s) in times_s.iter().enumerate() {
        while time_s - times_s[behind] > over_s {
            let rate = (lead_error_um[ahead] - lead_error_um[behind]) / (time_s - times_s[behind]);
            fastest = fastest.max(rate.abs());
            behind += 1;
        }
    }
    fastest
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn a_sine_on_a_slope_comes_apart() {
        let position_mm: Vec<f64> = (0..=2_000).map(|i| f64::from(i) * 0.5).collect();
        let lead_error_um: Vec<f64> =
            position_mm.iter().map(|x| 1.5 * libm::sin(TAU * x / 12.0) + 0.035 * x).collect();
        let found = appraise_lead(&position_mm, &lead_error_um, 12.0);
        assert!((found.periodic_um - 3.0).abs() < 0.01, "{found:?}");
        assert!((found.cumulative_um - 0.035 * 988.0).abs() < 0.01, "{found:?}");
        assert!(found.total_um > 35.0);
    }

    #[test]
    fn a_short_screw_is_all_periodic() {
        let found = appraise_lead(&[0.0, 1.0, 2.0], &[0.0, 2.0, -1.0], 12.0);
        assert_eq!((found.periodic_um, found.cumulative_um), (3.0, 0.0));
    }

    #[test]
    fn alternate_readings_hunt_at_half_the_comparison_frequency() {
        let times_s: Vec<f64> = (0..1_000).map(|i| f64::from(i) / 6.0).collect();
        let readings_um: Vec<f64> =
            (0..1_000).map(|i| if i % 2 == 0 { 0.15 } else { -0.15 }).collect();
        let hunting = measure_hunting(&times_s, &readings_um, 0.3).unwrap();
        assert!((hunting.comparison_hz - 6.0).abs() < 1e-9);
        assert!((hunting.frequency_hz - 3.0).abs() < 1e-9);
        assert!((hunting.swing_um - 0.3).abs() < 1e-12);
    }

    #[test]
    fn the_fastest_slope_is_found() {
        let times_s: Vec<f64> = (0..100).map(f64::from).collect();
        let error_um: Vec<f64> = times_s.iter().map(|t| (t - 50.0).max(0.0) * -2.0).collect();
        assert!((fastest_um_per_s(&times_s, &error_um, 3.0) - 2.0).abs() < 1e-12);
    }
}
