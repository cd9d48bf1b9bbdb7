//! Logged quantities that a coarse instrument rounded to steps: what they passed through between.
//!
//! A value on a lattice of spacing q says that the truth lay within q/2 of it, and where the column
//! changes the truth crossed the middle. A smooth curve through the crossings, held within q/2 of
//! every value, is as true to the log as the staircase, and has no treads that a fit takes for
//! structure of the machine.

use helixlock_plant::{Bridging, LOGGED_COLUMNS, LoggedColumn};

use super::Measurement;
use crate::numerics::count;
use crate::policy::reading::{CHANGES_A_LEAP, FEWEST_VALUES, OFF_THE_LATTICE};

impl Measurement {
    /// The same with the treads of rounded logs bridged, and a note on each.
    pub(super) fn without_treads(mut self) -> Self {
        let steady = LOGGED_COLUMNS.iter().filter(|column| column.bridging != Bridging::Never);
        for LoggedColumn { name, bridging, .. } in steady {
            let Some(values) = self.covariates.get(*name) else { continue };
            let Some(step) = lattice(values) else { continue };
            let breaks = |row: usize| {
                self.time_s[row] < self.time_s[row - 1]
                    || (*bridging == Bridging::WithinPasses && self.pass[row] != self.pass[row - 1])
            };
            let mut smooth = values.clone();
            let mut start = 0;
            let mut doubts: Vec<f64> = Vec::new();
            for end in 1..=values.len() {
                if end == values.len() || breaks(end) {
                    doubts.extend(bridge(&self.time_s[start..end], &mut smooth[start..end], step));
                    start = end;
                }
            }
            let square: f64 = doubts.iter().map(|doubt| doubt * doubt).sum();
            let off_by = (square / count(doubts.len().max(1))).sqrt();
            self.off_by.insert((*name).to_owned(), off_by);
            self.notes.push(format!(
                "column `{name}` is rounded to steps of {step:.3}: between them it is interpolated"
            ));
            self.samples.covariates.insert((*name).to_owned(), smooth);
        }
        self
    }
}

/// Spacing of the lattice that all values lie on; none for a constant.
pub(crate) fn spacing(values: &[f64]) -> Option<f64> {
    between(&levels(values))
}

/// The same of the values there are.
fn between(levels: &[f64]) -> Option<f64> {
    let gaps = levels.windows(2).map(|pair| pair[1] - pair[0]);
    let step = gaps.fold(f64::INFINITY, f64::min);
    let whole = |level: &f64| {
        let steps = (level - levels[0]) / step;
        (steps - steps.round()).abs() < OFF_THE_LATTICE
    };
    (step.is_finite() && levels.iter().all(whole)).then_some(step)
}

/// The values there are, each once, in order.
fn levels(values: &[f64]) -> Vec<f64> {
    let mut levels = values.to_vec();
    levels.sort_unstable_by(f64::total_cmp);
    let largest = levels.iter().fold(0.0_f64, |largest, level| largest.max(level.abs()));
    levels.dedup_by(|b, a| *b - *a <= 1e-9 * largest);
    levels
}

/// Spacing of the lattice, if the values climb it step by step.
fn lattice(values: &[f64]) -> Option<f64> {
    let levels = levels(values);
    let step = between(&levels)?;
    let moves = values.windows(2).map(|pair| ((pair[1] - pair[0]) / step).abs());
    let changes = moves.clone().filter(|steps| 0.5 < *steps).count();
    let leaps = moves.filter(|steps| 1.5 < *steps).count();
    let stair = FEWEST_VALUES <= levels.len() && CHANGES_A_LEAP * leaps <= changes;
    stair.then_some(step)
}

/// Replaces a staircase by a curve through its crossings, within half a step of it; standard
/// deviations of that curve at the crossings, which are anywhere between two samples.
fn bridge(time: &[f64], values: &mut [f64], step: f64) -> Vec<f64> {
    let mut crossings: Vec<[f64; 2]> = Vec::new();
    let mut gaps: Vec<f64> = Vec::new();
    for row in 1..values.len() {
        let at = 0.5 * (time[row - 1] + time[row]);
        let apart = crossings.last().is_none_or(|last| last[0] < at);
        if apart && 0.5 * step < (values[row] - values[row - 1]).abs() {
            crossings.push([at, 0.5 * (values[row - 1] + values[row])]);
            gaps.push(time[row] - time[row - 1]);
        }
    }
    if crossings.len() < 2 {
        return Vec::new();
    }
    let slopes = slopes(&crossings);
    for (at, value) in time.iter().zip(values) {
        let half = 0.5 * step;
        *value = curve(&crossings, &slopes, *at).clamp(*value - half, *value + half);
    }
    // A uniform law of that width.
    gaps.iter().zip(&slopes).map(|(gap, slope)| (gap * slope).abs() / f64::sqrt(12.0)).collect()
}

/// Slope at every crossing, that of the parabola through it and its neighbours.
fn slopes(points: &[[f64; 2]]) -> Vec<f64> {
    let chords: Vec<[f64; 2]> = points
        .windows(2)
        .map(|pair| {
            let width = pair[1][0] - pair[0][0];
            [width, (pair[1][1] - pair[0][1]) / width]
        })
        .collect();
    let inner = chords.windows(2).map(|pair| {
        let [[before, rise], [after, next]] = [pair[0], pair[1]];
        (after * rise + before * next) / (before + after)
    });
    let mut slopes = vec![chords[0][1]];
    slopes.extend(inner);
    slopes.push(chords[chords.len() - 1][1]);
    slopes
}

/// Cubic through the crossings with their slopes; beyond the last, a straight line.
fn curve(points: &[[f64; 2]], slopes: &[f64], at: f64) -> f64 {
    let next = points.partition_point(|point| point[0] < at);
    if next == 0 || next == points.len() {
        let end = next.min(points.len() - 1);
        return points[end][1] + slopes[end] * (at - points[end][0]);
    }
    let ([from, low], [to, high]) = (points[next - 1], points[next]);
    let width = to - from;
    let share = (at - from) / width;
    let rest = 1.0 - share;
    let bend = width * rest * share * (slopes[next - 1] * rest - slopes[next] * share);
    low * rest * rest * (1.0 + 2.0 * share) + high * share * share * (1.0 + 2.0 * rest) + bend
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rms(a: &[f64], b: &[f64]) -> f64 {
        let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        (square / count(a.len())).sqrt()
    }

    /// A rounded value is off by q/√12; the bridged one by far less, and nowhere beyond q/2.
    #[test]
    fn a_rounded_wave_is_restored() {
        let time: Vec<f64> =
            (0..600).map(|i| f64::from(i) + 0.3 * libm::sin(f64::from(i))).collect();
        let truth: Vec<f64> = time.iter().map(|t| 20.0 + libm::sin(t / 60.0)).collect();
        let rounded: Vec<f64> = truth.iter().map(|v| (v / 0.1).round() * 0.1).collect();
        let step = lattice(&rounded).expect("a staircase");
        assert!((step - 0.1).abs() < 1e-9, "{step}");
        let mut bridged = rounded.clone();
        let doubts = bridge(&time, &mut bridged, step);
        assert!(doubts.iter().all(|doubt| (1e-4..1e-2).contains(doubt)), "{doubts:?}");
        assert!((rms(&rounded, &truth) * 12.0_f64.sqrt() / step - 1.0).abs() < 0.2);
        assert!(rms(&bridged, &truth) < 0.1 * rms(&rounded, &truth), "{}", rms(&bridged, &truth));
        assert!(bridged.iter().zip(&rounded).all(|(a, b)| (a - b).abs() < 0.5 * step + 1e-12));
    }

    #[test]
    fn settings_and_fine_logs_are_left_alone() {
        let of = |value: fn(f64) -> f64| (0..300).map(f64::from).map(value).collect::<Vec<_>>();
        assert_eq!(lattice(&of(|i| 20.0 + libm::sin(i / 60.0))), None, "not rounded");
        assert_eq!(lattice(&of(|i| 40.0 * (i / 50.0).floor() % 80.0)), None, "on and off");
        assert_eq!(lattice(&of(|i| (9.0 * libm::sin(i)).round())), None, "leaps");
        assert_eq!(lattice(&of(|_| 20.0)), None, "constant");
    }
}
