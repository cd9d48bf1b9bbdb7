//! Whether a residual comes back at the same place in another pass, whatever its shape.

use std::ops::Range;

use statrs::distribution::{ContinuousCDF, Normal};

use crate::model::{Fit, Problem};
use crate::noise::Whitener;
use crate::numerics::least_squares::{dot, lagged};
use crate::numerics::{count, mean};
use crate::policy::extent::{CELLS_OF_WAYS, COMMON_SAMPLES};

/// Correlation of what is the same but for rounding.
const MOST: f64 = 1.0 - 1e-9;

/// Share of the whitened square of a way that others over the same travel show too, and the chance of
/// as much in independent noise.
///
/// Of all passes, or of their ways there and back, the mean of every other one is compared with that
/// of the rest, on the whitened residual, interpolated to the places of the longest; and so are those
/// that go the same way, which alone share what shows one way only; both in cells of several lengths.
/// The clearest look is told. The standard error of a correlation allows for what autocorrelation is
/// left in both (Bartlett 1946). `None` without two passes over the same travel.
#[must_use]
pub(crate) fn repeatability(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let whitener = Whitener::new(&problem.layout, &fit.noises);
    let white = whitener.whiten(fit.left.clone());
    let mut looked = [[Compared::default(); 2]; CELLS_OF_WAYS.len()];
    for sensor in 0..problem.sensors.len() {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let ways: Vec<Way> = blocks
            .flat_map(|block| from_turn_to_turn(problem, block.rows.clone()))
            .filter_map(|rows| along_travel(problem, &white, rows))
            .collect();
        let (there, back): (Vec<&Way>, Vec<&Way>) = ways.iter().partition(|way| way.forward);
        let all = halves(&ways.iter().collect::<Vec<_>>());
        let both_ways = !there.is_empty() && !back.is_empty();
        let alike = if both_ways { [halves(&there), halves(&back)] } else { [None, None] };
        for (rows, [of_all, of_alike]) in CELLS_OF_WAYS.iter().zip(&mut looked) {
            of_all.add(all.as_ref(), *rows);
            for one_way in &alike {
                of_alike.add(one_way.as_ref(), *rows);
            }
        }
    }
    let judged: Vec<(f64, f64)> = looked.iter().flatten().filter_map(Compared::judged).collect();
    let (share, chance) = judged.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((share, (count(judged.len()) * chance).min(1.0)))
}

/// Halves of ways that were compared.
#[derive(Debug, Default, Clone, Copy)]
struct Compared {
    score: f64,
    shares: f64,
    pairs: f64,
}

impl Compared {
    /// Compares two halves in cells of some rows.
    fn add(&mut self, halves: Option<&Halves>, rows: usize) {
        let Some(halves) = halves else { return };
        let cells = halves.in_cells(rows);
        let Some((covariance, correlation, deviation)) = cells.and_then(compared) else { return };
        self.score += transformed(correlation, deviation);
        self.shares += covariance / halves.square;
        self.pairs += 1.0;
    }

    /// Mean share and chance; `None` without a pair.
    fn judged(&self) -> Option<(f64, f64)> {
        let chance = || Normal::standard().sf(self.score / self.pairs.sqrt());
        (0.0 < self.pairs).then(|| ((self.shares / self.pairs).min(1.0), chance()))
    }
}

/// A way over the travel.
#[derive(Debug)]
struct Way {
    forward: bool,
    /// `(place, residual)` sorted by place.
    points: Vec<(f64, f64)>,
}

impl Way {
    /// How far it goes.
    fn span(&self) -> f64 {
        self.points.last().zip(self.points.first()).map_or(0.0, |(last, first)| last.0 - first.0)
    }

    /// What it shows at a place, between its neighbours; `None` where it has not been.
    fn value_at(&self, place: f64) -> Option<f64> {
        let next = self.points.partition_point(|point| point.0 < place);
        let (x1, y1) = *self.points.get(next)?;
        if x1 <= place {
            return Some(y1);
        }
        let (x0, y0) = self.points[next.checked_sub(1)?];
        Some(y0 + (place - x0) / (x1 - x0) * (y1 - y0))
    }
}

/// A correlation as a deviate of the normal law: Fisher's transformation, of as many independent
/// samples as its standard deviation says (Fisher 1921, *On the probable error of a coefficient of
/// correlation deduced from a small sample*, Metron 1:3).
fn transformed(correlation: f64, deviation: f64) -> f64 {
    let samples = 1.0 / (deviation * deviation);
    libm::atanh(correlation.clamp(-MOST, MOST)) * (samples - 3.0).max(0.0).sqrt()
}

/// The rows of a pass from one reversal to the next.
pub(super) fn from_turn_to_turn(problem: &Problem, rows: Range<usize>) -> Vec<Range<usize>> {
    between_turns(rows, |row| problem.record.direction[problem.samples[row]])
}

/// The same by the directions alone.
pub(super) fn between_turns(
    rows: Range<usize>,
    direction: impl Fn(usize) -> f64,
) -> Vec<Range<usize>> {
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

/// Means of every other way and of the rest, place by place.
#[derive(Debug)]
struct Halves {
    means: [Vec<f64>; 2],
    /// Mean square of a row of one way.
    square: f64,
}

/// The halves of some ways at the places of the longest that both have been to; `None` where these
/// are few.
fn halves(ways: &[&Way]) -> Option<Halves> {
    let longest = ways.iter().max_by(|a, b| a.span().total_cmp(&b.span()))?;
    let mut means = [Vec::new(), Vec::new()];
    for &(place, _) in &longest.points {
        let mean = |half: usize| {
            let values = ways.iter().skip(half).step_by(2).filter_map(|way| way.value_at(place));
            let (sum, number) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value, n + 1.0));
            (0.0 < number).then(|| sum / number)
        };
        if let (Some(one), Some(other)) = (mean(0), mean(1)) {
            means[0].push(one);
            means[1].push(other);
        }
    }
    let values = || ways.iter().flat_map(|way| way.points.iter().map(|(_, value)| *value));
    let square = values().map(|value| value * value).sum::<f64>() / count(values().count());
    (COMMON_SAMPLES <= means[0].len() && 0.0 < square).then_some(Halves { means, square })
}

impl Halves {
    /// Means of so many neighbours; `None` where these are few.
    fn in_cells(&self, rows: usize) -> Option<[Vec<f64>; 2]> {
        let cells =
            |values: &Vec<f64>| -> Vec<f64> { values.chunks_exact(rows).map(mean).collect() };
        (COMMON_SAMPLES * rows <= self.means[0].len()).then(|| self.means.each_ref().map(cells))
    }
}

/// Covariance, correlation, and its standard deviation in independent noise.
fn compared([mut first, mut second]: [Vec<f64>; 2]) -> Option<(f64, f64, f64)> {
    centre(&mut first);
    centre(&mut second);
    let size = (dot(&first, &first) * dot(&second, &second)).sqrt();
    if size <= 0.0 {
        return None;
    }
    let samples = count(first.len());
    let (left, right) = (autocorrelations(&first), autocorrelations(&second));
    let bartlett = 1.0 + 2.0 * left.iter().zip(&right).map(|(l, r)| l * r).sum::<f64>();
    let product = dot(&first, &second);
    Some((product / samples, product / size, (bartlett.max(0.5) / samples).sqrt()))
}

fn centre(values: &mut [f64]) {
    let mean = mean(values);
    for value in values.iter_mut() {
        *value -= mean;
    }
}

/// Autocorrelations at lags 1 … a tenth of the series, at most 100.
fn autocorrelations(values: &[f64]) -> Vec<f64> {
    let power = dot(values, values).max(f64::MIN_POSITIVE);
    let lags = (values.len() / 10).clamp(1, 100);
    (1..=lags).map(|lag| lagged(values, lag) / power).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    fn way(rows: u16, place: impl Fn(f64) -> f64, mut shown: impl FnMut(f64) -> f64) -> Way {
        let places = (0..rows).map(|row| place(f64::from(row)));
        Way { forward: true, points: places.map(|place| (place, shown(place))).collect() }
    }

    #[test]
    fn a_shape_that_repeats_is_found_at_other_places_too() {
        let shape = |x: f64| libm::sin(0.3 * x * x);
        let ways = [way(400, |i| 0.05 * i, shape), way(400, |i| 1.0 + 0.047 * i, shape)];
        let halves = halves(&ways.iter().collect::<Vec<_>>()).unwrap();
        let (_, correlation, deviation) = compared(halves.means).unwrap();
        assert!(0.9 < correlation && deviation < 0.2, "{correlation} {deviation}");
    }

    /// Of six ways whose shape is a third of the noise in size, 300 rows each; and of six ways of noise.
    #[test]
    fn many_ways_tell_more_than_two() {
        let chance = |size: f64, seed: u64, ways: usize| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut noisy = |x: f64| -> f64 {
                let noise: f64 = StandardNormal.sample(&mut random);
                size * libm::sin(0.01 * x * x) + noise
            };
            let ways: Vec<Way> = (0..ways).map(|_| way(300, |i| 0.2 * i, &mut noisy)).collect();
            let mut compared = Compared::default();
            compared.add(halves(&ways.iter().collect::<Vec<_>>()).as_ref(), 1);
            compared.judged().unwrap().1
        };
        let median_of = |size: f64, ways: usize| {
            let mut all: Vec<f64> = (0..21).map(|seed| chance(size, seed, ways)).collect();
            crate::numerics::median(&mut all)
        };
        let (two, six) = (median_of(0.6, 2), median_of(0.6, 6));
        assert!(1e-3 < two && six < 1e-4, "{two} {six}");
        let below = (0..300).filter(|&seed| chance(0.0, seed, 6) < 0.01).count();
        assert!(below <= 8, "{below} of 300");
    }
}
