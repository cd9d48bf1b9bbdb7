//! Whether a residual comes back at the same place in another pass, whatever its shape.

use std::ops::Range;

use statrs::distribution::{ContinuousCDF, Normal};

use crate::model::{Fit, Problem};
use crate::noise::Whitener;
use crate::numerics::count;
use crate::numerics::least_squares::dot;
use crate::policy::extent::COMMON_SAMPLES;

/// Correlation of what is the same but for rounding.
const MOST: f64 = 1.0 - 1e-9;

/// Mean correlation of ways over the same travel, and its chance in independent noise.
///
/// Passes, or their ways there and back, are compared two by two on the whitened residual, the second
/// interpolated to the places of the first: neighbours, and neighbours of those that go the same way,
/// which alone share what shows one way only. The clearer of both looks is told. The standard error
/// of a correlation allows for what autocorrelation is left in both (Bartlett 1946). `None` without two
/// passes over the same travel.
#[must_use]
pub(crate) fn repeatability(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let whitener = Whitener::new(&problem.layout, &fit.noises);
    let white = whitener.whiten(fit.left.clone());
    let (mut neighbours, mut alike) = (Compared::default(), Compared::default());
    for sensor in 0..problem.sensors.len() {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let ways: Vec<Way> = blocks
            .flat_map(|block| from_turn_to_turn(problem, block.rows.clone()))
            .filter_map(|rows| along_travel(problem, &white, rows))
            .collect();
        neighbours.add(&ways.iter().collect::<Vec<_>>());
        let (there, back): (Vec<&Way>, Vec<&Way>) = ways.iter().partition(|way| way.forward);
        if !there.is_empty() && !back.is_empty() {
            alike.add(&there);
            alike.add(&back);
        }
    }
    let looked = [neighbours, alike].into_iter().filter_map(|looked| looked.judged());
    let looked: Vec<(f64, f64)> = looked.collect();
    let (correlation, chance) = looked.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((correlation, (count(looked.len()) * chance).min(1.0)))
}

/// Pairs of ways that were compared.
#[derive(Debug, Default)]
struct Compared {
    score: f64,
    correlations: f64,
    pairs: f64,
}

impl Compared {
    /// Compares ways with their neighbours, each once.
    fn add(&mut self, ways: &[&Way]) {
        for pair in ways.chunks_exact(2) {
            let both = correlation(&pair[0].points, &pair[1].points);
            let Some((correlation, deviation)) = both else { continue };
            self.score += transformed(correlation, deviation);
            self.correlations += correlation;
            self.pairs += 1.0;
        }
    }

    /// Mean correlation and chance; `None` without a pair.
    fn judged(&self) -> Option<(f64, f64)> {
        let chance = || Normal::standard().sf(self.score / self.pairs.sqrt());
        (0.0 < self.pairs).then(|| (self.correlations / self.pairs, chance()))
    }
}

/// A way over the travel.
#[derive(Debug)]
struct Way {
    forward: bool,
    /// `(place, residual)` sorted by place.
    points: Vec<(f64, f64)>,
}

/// A correlation as a deviate of the normal law: Fisher's transformation, of as many independent
/// samples as its standard deviation says (Fisher 1921, *On the probable error of a coefficient of
/// correlation deduced from a small sample*, Metron 1:3).
fn transformed(correlation: f64, deviation: f64) -> f64 {
    let samples = 1.0 / (deviation * deviation);
    libm::atanh(correlation.clamp(-MOST, MOST)) * (samples - 3.0).max(0.0).sqrt()
}

/// The rows of a pass from one reversal to the next.
fn from_turn_to_turn(problem: &Problem, rows: Range<usize>) -> Vec<Range<usize>> {
    let direction = |row: usize| problem.record.direction[problem.samples[row]];
    let turns = rows.clone().skip(1).filter(|&row| direction(row) * direction(row - 1) < 0.0);
    let ends: Vec<usize> = turns.chain([rows.end]).collect();
    let starts = std::iter::once(rows.start).chain(ends.iter().copied());
    starts.zip(&ends).map(|(start, &end)| start..end).collect()
}

/// What some rows show over the travel; `None` for a way that turns back or stands, or is short.
fn along_travel(problem: &Problem, white: &[f64], rows: Range<usize>) -> Option<Way> {
    let place = |row: usize| problem.record.spindle_rad[problem.samples[row]];
    let mut points: Vec<(f64, f64)> = rows.clone().map(|row| (place(row), white[row])).collect();
    let forward = place(rows.start) < place(rows.end - 1);
    let one_way = points.windows(2).all(|pair| {
        let step = pair[1].0 - pair[0].0;
        if forward { 0.0 <= step } else { step <= 0.0 }
    });
    if !forward {
        points.reverse();
    }
    (one_way && COMMON_SAMPLES <= points.len()).then_some(Way { forward, points })
}

/// Correlation over the common travel, and its standard deviation in independent noise.
fn correlation(a: &[(f64, f64)], b: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (mut first, mut second) = (Vec::new(), Vec::new());
    let mut next = 0;
    for &(place, value) in a {
        while next < b.len() && b[next].0 < place {
            next += 1;
        }
        if next == 0 || next == b.len() {
            continue;
        }
        let ((x0, y0), (x1, y1)) = (b[next - 1], b[next]);
        let share = if x1 > x0 { (place - x0) / (x1 - x0) } else { 0.0 };
        first.push(value);
        second.push(y0 + share * (y1 - y0));
    }
    if first.len() < COMMON_SAMPLES {
        return None;
    }
    centre(&mut first);
    centre(&mut second);
    let size = (dot(&first, &first) * dot(&second, &second)).sqrt();
    if size <= 0.0 {
        return None;
    }
    let samples = count(first.len());
    let (left, right) = (autocorrelations(&first), autocorrelations(&second));
    let bartlett = 1.0 + 2.0 * left.iter().zip(&right).map(|(l, r)| l * r).sum::<f64>();
    Some((dot(&first, &second) / size, (bartlett.max(0.5) / samples).sqrt()))
}

fn centre(values: &mut [f64]) {
    let mean = values.iter().sum::<f64>() / count(values.len());
    for value in values.iter_mut() {
        *value -= mean;
    }
}

/// Autocorrelations at lags 1 … a tenth of the series, at most 100.
fn autocorrelations(values: &[f64]) -> Vec<f64> {
    let power = dot(values, values).max(f64::MIN_POSITIVE);
    let lags = (values.len() / 10).clamp(1, 100);
    (1..=lags).map(|lag| dot(&values[lag..], &values[..values.len() - lag]) / power).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shape_that_repeats_is_found_at_other_places_too() {
        let shape = |x: f64| libm::sin(0.3 * x * x);
        let a: Vec<_> =
            (0..400).map(|i| (0.05 * f64::from(i), shape(0.05 * f64::from(i)))).collect();
        let b: Vec<_> =
            (0..400).map(|i| 1.0 + 0.047 * f64::from(i)).map(|x| (x, shape(x))).collect();
        let (correlation, deviation) = correlation(&a, &b).unwrap();
        assert!(0.9 < correlation && deviation < 0.2, "{correlation} {deviation}");
    }
}
