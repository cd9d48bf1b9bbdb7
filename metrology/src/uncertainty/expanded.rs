//! How wide ± has to be, from how all that may be wrong is spread (JCGM 101:2008).
//!
//! Two standard uncertainties hold 95.45 % of what is normal and adds to a figure as it is. A wrong
//! scale does neither: a temperature within limits is a rectangle, a cosine error has one sign, and
//! a range of deviations grows with some errors and shrinks with others. So the figure is evaluated
//! over the whole distribution of the scale's error. The rest counts as normal: it is a sum over
//! many readings, or told as a standard uncertainty of the figure itself.

use super::source::{Acts, Added, Distribution, Readings, Source};
use crate::number::number;

/// Probability that the value lies within ±U: that of two standard deviations of a normal one.
pub(super) const PROBABILITY: f64 = 0.954_499_736_103_642;

/// The scale's error is taken to four times its standard uncertainty: beyond are 6 of 100 000.
const REACH: usize = 4;
/// Figures are evaluated at every quarter of the scale's standard uncertainty; between them a
/// range goes straight but for a kink.
const PER_STANDARD: usize = 4;
/// Parts of such a quarter that have a probability of their own: U is then known to 0.2 %.
const PARTS: usize = 4;
/// Halvings of an interval that holds U: to a millionth of it.
const HALVINGS: usize = 20;

/// What the error of all lengths changes of each figure, and how probable that is.
pub(super) struct Lengths {
    /// Probability of each error, from the least to the greatest.
    weights: Vec<f64>,
    /// By figure: change at each of these errors, µm.
    changes_um: Vec<Vec<f64>>,
}

impl Lengths {
    /// Evaluates the readings over the distribution of all that acts on lengths.
    pub(super) fn new(readings: &dyn Readings, sources: &[Source], values_um: &[f64]) -> Self {
        let on_lengths = |source: &Source| match source.acts {
            Acts::OnLengths(um) => Some((source.distribution, (um * source.standard).abs())),
            _ => None,
        };
        let on_lengths: Vec<(Distribution, f64)> =
            sources.iter().filter_map(on_lengths).filter(|(_, um_per_m)| 0.0 < *um_per_m).collect();
        let standard =
            on_lengths.iter().map(|(_, um_per_m)| um_per_m * um_per_m).sum::<f64>().sqrt();
        if standard == 0.0 {
            return Self { weights: vec![1.0], changes_um: vec![vec![0.0]; values_um.len()] };
        }
        let part = standard / number(PER_STANDARD * PARTS);
        let each = on_lengths.iter().map(|(distribution, um)| spread(*distribution, *um, part));
        let weights = each.reduce(|sum, one| sum_of(&sum, &one)).unwrap_or_default();
        let at = |node: usize| {
            let standards = number(node) / number(PER_STANDARD) - number(REACH);
            readings.figures_um(Added::ToLengths(standards * standard))
        };
        let nodes: Vec<Vec<f64>> = (0..=2 * REACH * PER_STANDARD).map(at).collect();
        let changes = |(figure, value_um): (usize, &f64)| {
            between(&nodes.iter().map(|node| node[figure] - value_um).collect::<Vec<_>>())
        };
        Self {
            weights: either_way(&weights),
            changes_um: values_um.iter().enumerate().map(changes).collect(),
        }
    }

    /// U: ±U holds 95.45 % of what the figure may be, when `noise_um` (k = 1) is normal and adds to it.
    pub(super) fn expanded_um(&self, figure: usize, noise_um: f64) -> f64 {
        let changes_um = &self.changes_um[figure];
        let farthest_um = changes_um.iter().fold(0.0, |most: f64, um| most.max(um.abs()));
        if farthest_um == 0.0 {
            return 2.0 * noise_um;
        }
        let inside = |um: f64| {
            let share = |(at, weight): (usize, &f64)| {
                // A part is as wide as the step to its neighbour, and spread like a rectangle.
                let next_um = changes_um.get(at + 1).unwrap_or(&changes_um[at]);
                let part_um = (next_um - changes_um[at]) / 12.0_f64.sqrt();
                let standard_um = libm::hypot(noise_um, part_um);
                let below = |um: f64| normal_below((um - changes_um[at]) / standard_um);
                weight * (below(um) - below(-um))
            };
            self.weights.iter().enumerate().map(share).sum()
        };
        // Ten standard deviations of the noise beyond the farthest are beyond all doubt.
        where_reached(&inside, PROBABILITY, [0.0, farthest_um + 10.0 * noise_um])
    }
}

/// Where a growing function reaches a value.
fn where_reached(function: &dyn Fn(f64) -> f64, value: f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if function(middle) < value {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Probability of each part of a distribution, the middle one about zero.
fn spread(distribution: Distribution, standard: f64, part: f64) -> Vec<f64> {
    let half = REACH * PER_STANDARD * PARTS;
    let edge = |k: usize| (number(k) - number(half) - 0.5) * part / standard;
    let below = |k: usize| below(distribution, edge(k));
    (0..=2 * half).map(|k| below(k + 1) - below(k)).collect()
}

/// Probability that an error is less than so many of its standard uncertainties.
fn below(distribution: Distribution, standards: f64) -> f64 {
    match distribution {
        Distribution::Normal => normal_below(standards),
        Distribution::Rectangular => (0.5 + standards / 12.0_f64.sqrt()).clamp(0.0, 1.0),
        // −√5·p² of it, p evenly between 0 and 1.
        Distribution::SquareOfRectangular => {
            1.0 - (-standards / 5.0_f64.sqrt()).clamp(0.0, 1.0).sqrt()
        }
    }
}

fn normal_below(standards: f64) -> f64 {
    // Nothing over nothing: a change that is none at all is not below none.
    if standards.is_nan() { 0.5 } else { libm::erfc(-standards / 2.0_f64.sqrt()) / 2.0 }
}

/// The distribution of a sum, over as many parts as each has; the middle is zero in all.
fn sum_of(one: &[f64], other: &[f64]) -> Vec<f64> {
    let middle = one.len() / 2;
    let at = |k: usize| -> f64 {
        let pair = |(i, weight): (usize, &f64)| {
            (k + middle).checked_sub(i).and_then(|j| other.get(j)).map_or(0.0, |p| weight * p)
        };
        one.iter().enumerate().map(pair).sum()
    };
    (0..other.len()).map(at).collect()
}

/// ± counts an error and its opposite alike, so both have the mean of their probabilities; what is
/// beyond reach is shared out.
///
/// With one sign alone an axis that the cosine error lets seem to rise would be taken for one that
/// rises: ±U then holds the range of a flat one in 88 % instead of 94.
fn either_way(weights: &[f64]) -> Vec<f64> {
    let all: f64 = weights.iter().sum();
    weights.iter().zip(weights.iter().rev()).map(|(a, b)| (a + b) / (2.0 * all)).collect()
}

/// Values at the parts of each step, straight from one to the next.
fn between(values: &[f64]) -> Vec<f64> {
    let parts = |pair: &[f64]| -> Vec<f64> {
        let (from, to) = (pair[0], pair[1]);
        (0..PARTS).map(|part| from + (to - from) * number(part) / number(PARTS)).collect()
    };
    let mut all: Vec<f64> = values.windows(2).flat_map(parts).collect();
    all.extend(values.last());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The size of a length of 1 m that is off by so many µm, and the length itself.
    struct Metre(f64);

    impl Readings for Metre {
        fn places(&self) -> usize {
            0
        }

        fn readings(&self) -> usize {
            0
        }

        fn figures_um(&self, added: Added) -> Vec<f64> {
            let Added::ToLengths(um) = added else { return vec![self.0.abs(), self.0] };
            vec![(self.0 + um).abs(), self.0 + um]
        }
    }

    fn expanded_um(at_um: f64, sources: &[(Distribution, f64)], noise_um: f64) -> [f64; 2] {
        let source = |(distribution, standard): &(Distribution, f64)| Source {
            quantity: String::new(),
            estimate: 0.0,
            unit: "",
            standard: *standard,
            distribution: *distribution,
            degrees_of_freedom: f64::INFINITY,
            acts: Acts::OnLengths(1.0),
        };
        let sources: Vec<Source> = sources.iter().map(source).collect();
        let metre = Metre(at_um);
        let lengths = Lengths::new(&metre, &sources, &metre.figures_um(Added::Nothing));
        [0, 1].map(|figure| lengths.expanded_um(figure, noise_um))
    }

    fn near(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 2e-3, "{found}, expected {expected}");
    }

    /// Two of a normal one; of a rectangle 0.9545·√3; of two alike, a triangle, (1 − √0.0455)·√6; of a
    /// cosine error, that is 0.9545² of its most, √5.
    #[test]
    fn what_adds_as_it_is() {
        let (share, rectangle) = (PROBABILITY, Distribution::Rectangular);
        near(expanded_um(1.0, &[(Distribution::Normal, 0.3)], 0.4)[1], 1.0);
        near(expanded_um(1.0, &[(Distribution::Normal, 0.3)], 0.0)[1], 0.6);
        near(expanded_um(1.0, &[], 0.3)[1], 0.6);
        near(expanded_um(1.0, &[(rectangle, 0.3)], 0.0)[1], 0.3 * share * 3.0_f64.sqrt());
        let triangle = (1.0 - (1.0 - share).sqrt()) * 6.0_f64.sqrt();
        near(expanded_um(1.0, &[(rectangle, 0.3); 2], 0.0)[1], 0.3 * 2.0_f64.sqrt() * triangle);
        let cosine = Distribution::SquareOfRectangular;
        near(expanded_um(1.0, &[(cosine, 0.3)], 0.0)[1], 0.3 * share * share * 5.0_f64.sqrt());
    }

    #[test]
    fn nothing_wrong_is_no_uncertainty() {
        assert!(expanded_um(1.0, &[], 0.0)[0].abs() < 1e-6);
    }

    /// A length of nothing can only seem longer: 2 holds it. Far from nothing it is as any other.
    #[test]
    fn a_size_near_nothing() {
        near(expanded_um(0.0, &[(Distribution::Normal, 1.0)], 0.0)[0], 2.0);
        near(expanded_um(9.0, &[(Distribution::Normal, 1.0)], 0.0)[0], 2.0);
    }
}
