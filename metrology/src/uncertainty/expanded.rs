//! From where to where the true figure lies, by how all that may be wrong is spread.
//!
//! Two standard uncertainties hold 95.45 % of what is normal and adds to a figure as it is. A wrong
//! scale does neither: a temperature within limits is a rectangle, a cosine error has one sign, and
//! a range of deviations grows with some errors and shrinks with others. So the figure is evaluated
//! over all errors of the scale, and a value of it is held when the readings are not too improbable
//! if it is the true one: the interval of Neyman, with the order of Feldman and Cousins (Physical
//! Review D 57, 1998, 3873). A range has most values twice, on either side of its least; both may
//! be true, and the limits of probability are narrower by what one catches of the other.
//!
//! What is wrong of single readings counts as normal to either side of its mean: it is a sum over
//! many, or told as a standard uncertainty of the figure itself.

use super::source::{Acts, Added, Distribution, Noise, Readings, Source};
use crate::number::{mean, number};

/// Probability with which the true value is held: that of two standard deviations of a normal one.
pub(super) const PROBABILITY: f64 = 0.954_499_736_103_642;

/// The scale's error is taken to four times its standard uncertainty: beyond are 6 of 100 000.
const REACH: usize = 4;
/// Figures are evaluated at every quarter of the scale's standard uncertainty; between them a
/// range goes straight but for a kink.
const PER_STANDARD: usize = 4;
/// Parts of such a quarter that have a probability of their own: an end is then known to 0.2 %.
const PARTS: usize = 4;
/// Standard deviations of a normal number that this probability reaches to.
const LIMIT: f64 = 2.0;
/// The same squared at the least of a range. Errors of lengths lie along the range there and noise
/// across it, so that both count when the true range is below, ½·P(χ²₁) + ½·P(χ²₂) = 95.45 %.
const MOST_AT_LEAST: f64 = 5.32;
/// Readings as they may be, over which the change with lengths is a mean.
const FEW: usize = 8;
/// Halvings of an interval that holds an end: to a millionth of it.
const HALVINGS: usize = 20;
/// Parts on either side of no error.
const HALF: usize = REACH * PER_STANDARD * PARTS;

/// What the error of all lengths changes of each figure, and how probable that is.
pub(super) struct Lengths {
    errors: Errors,
    /// By figure: change when so many parts are added to the lengths, from the least, µm; none when
    /// nothing acts on lengths.
    changes_um: Vec<Vec<f64>>,
}

impl Lengths {
    /// Evaluates the readings over the distribution of all that acts on lengths.
    ///
    /// Of readings as they may be without noise it is the mean over a few: where noise makes a range
    /// as wide as it seems, it does not do so everywhere.
    pub(super) fn new(
        readings: &dyn Readings,
        drawn: &[Box<dyn Readings>],
        sources: &[Source],
    ) -> Self {
        let on_lengths = |source: &Source| match source.acts {
            Acts::OnLengths(um) => Some((source.distribution, (um * source.standard).abs())),
            _ => None,
        };
        let on_lengths: Vec<(Distribution, f64)> =
            sources.iter().filter_map(on_lengths).filter(|(_, um_per_m)| 0.0 < *um_per_m).collect();
        let standard =
            on_lengths.iter().map(|(_, um_per_m)| um_per_m * um_per_m).sum::<f64>().sqrt();
        if standard == 0.0 {
            return Self { errors: Errors::new(&[1.0]), changes_um: Vec::new() };
        }
        let part = standard / number(PER_STANDARD * PARTS);
        let each = on_lengths.iter().map(|(distribution, um)| spread(*distribution, *um, part));
        let weights = each.reduce(|sum, one| sum_of(&sum, &one)).unwrap_or_default();
        let few: Vec<&dyn Readings> = if drawn.is_empty() {
            vec![readings]
        } else {
            drawn.iter().take(FEW).map(AsRef::as_ref).collect()
        };
        let at = |node: usize| {
            let standards = number(node) / number(PER_STANDARD) - number(REACH);
            mean_of(&few, Added::ToLengths(standards * standard))
        };
        let found_um = mean_of(&few, Added::Nothing);
        let nodes: Vec<Vec<f64>> = (0..=2 * REACH * PER_STANDARD).map(at).collect();
        let changes = |(figure, found_um): (usize, &f64)| {
            between(&nodes.iter().map(|node| node[figure] - found_um).collect::<Vec<_>>())
        };
        let changes_um = found_um.iter().enumerate().map(changes).collect();
        Self { errors: Errors::new(&weights), changes_um }
    }

    /// How far below and above the figure as read the true one may be, µm, when `noise` adds to it
    /// and what is known of all of it is widened by a factor.
    pub(super) fn ends_um(&self, figure: usize, noise: Noise, wider: f64) -> [f64; 2] {
        let lengths = self.changes_um.get(figure).filter(|each| each.iter().any(|um| *um != 0.0));
        let [below_um, above_um] = lengths.map_or_else(
            || [LIMIT * noise.below_um, LIMIT * noise.above_um],
            |changes_um| self.reach_um(changes_um, noise),
        );
        [below_um * wider - noise.shift_um, above_um * wider + noise.shift_um]
    }

    /// How far below and above, by an error of lengths and one of noise at a time: their squares, in
    /// standard deviations, add to four.
    fn reach_um(&self, changes_um: &[f64], noise: Noise) -> [f64; 2] {
        let parts = 0..changes_um.len();
        let lowest = |a: &usize, b: &usize| changes_um[*a].total_cmp(&changes_um[*b]);
        let least = parts.clone().min_by(lowest).unwrap_or(HALF);
        let scores: Vec<f64> = parts.map(|part| self.score(changes_um, least, part)).collect();
        let mut ends_um = [0.0; 2];
        let mut holds = |um: f64, score: f64, most: f64| {
            let left = (most - score * score).max(0.0).sqrt();
            ends_um = [
                f64::max(ends_um[0], left * noise.below_um - um),
                f64::max(ends_um[1], left * noise.above_um + um),
            ];
        };
        for (part, score) in scores.iter().enumerate().filter(|(_, score)| **score <= LIMIT) {
            holds(changes_um[part], *score, LIMIT * LIMIT);
        }
        for (part, pair) in scores.windows(2).enumerate() {
            if (pair[0] <= LIMIT) != (pair[1] <= LIMIT) {
                let (from_um, to_um) = (changes_um[part], changes_um[part + 1]);
                let at = (LIMIT - pair[0]) / (pair[1] - pair[0]);
                holds(from_um + (to_um - from_um) * at, LIMIT, LIMIT * LIMIT);
            }
        }
        let [mut below_um, above_um] = ends_um;
        if scores[least] <= LIMIT {
            let left = (MOST_AT_LEAST - scores[least].powi(2)).sqrt();
            below_um = below_um.max(left * noise.below_um - deepest(changes_um, least));
        }
        [below_um, above_um]
    }

    /// How many standard deviations the readings are off, if the true figure is what it is at a part;
    /// two of a normal number are the limit.
    fn score(&self, changes_um: &[f64], least: usize, part: usize) -> f64 {
        let place = number(part) - number(HALF);
        let score = |place: f64, other: Option<f64>| {
            let limit = self.errors.limit(other.map(|other| other - place));
            LIMIT * self.errors.deviations(-place) / limit
        };
        let Some(other) = twin(changes_um, least, part) else { return score(place, None) };
        let other = other - number(HALF);
        score(place, Some(other)).min(score(other, Some(place)))
    }
}

/// So many standard deviations and more are on either side of a normal number with this probability.
fn deviations(tail: f64) -> f64 {
    where_reached(&|deviations| 1.0 - 2.0 * normal_below(-deviations), 1.0 - tail, [0.0, 9.0])
}

/// Mean of each figure, µm.
fn mean_of(few: &[&dyn Readings], added: Added) -> Vec<f64> {
    let all: Vec<Vec<f64>> = few.iter().map(|one| one.figures_um(added)).collect();
    let figures = all.first().map_or(0, Vec::len);
    let of = |figure: usize| mean(&all.iter().map(|each| each[figure]).collect::<Vec<_>>());
    (0..figures).map(of).collect()
}

/// The other place at which a figure has the value it has at a part, in parts from the least.
fn twin(changes_um: &[f64], least: usize, part: usize) -> Option<f64> {
    let value_um = changes_um[part];
    let between = |from: usize, to: usize| {
        let (from_um, to_um) = (changes_um[from], changes_um[to]);
        if (to_um - from_um).abs() == 0.0 {
            number(to)
        } else {
            number(from) + (number(to) - number(from)) * (value_um - from_um) / (to_um - from_um)
        }
    };
    if part < least {
        let beyond = (least + 1..changes_um.len()).find(|at| value_um <= changes_um[*at])?;
        return Some(between(beyond - 1, beyond));
    }
    if part == least {
        return Some(number(least));
    }
    let beyond = (0..least).rev().find(|at| value_um <= changes_um[*at])?;
    Some(between(beyond + 1, beyond))
}

/// How errors of all lengths are spread, in parts.
struct Errors {
    /// Probability of each part, from the least to the greatest, no error in the middle.
    weights: Vec<f64>,
    /// Probability of less than each part, and of all.
    below: Vec<f64>,
    /// How far out the middle of each part is, in standard deviations of a normal number.
    deviations: Vec<f64>,
    /// How far out is excluded at a place of a figure, by how many steps another one with an equal
    /// value is before or behind it, from the farthest before to the farthest behind.
    limits: Vec<f64>,
}

impl Errors {
    fn new(weights: &[f64]) -> Self {
        // What is beyond reach is shared out.
        let all: f64 = weights.iter().sum();
        let weights: Vec<f64> = weights.iter().map(|weight| weight / all).collect();
        let mut below = vec![0.0];
        for weight in &weights {
            below.push(below.last().copied().unwrap_or_default() + weight);
        }
        let mut errors = Self { weights, below, deviations: Vec::new(), limits: Vec::new() };
        let out = |part: usize| {
            let below = errors.below(number(part) - number(errors.weights.len() / 2));
            deviations(2.0 * below.min(1.0 - below))
        };
        errors.deviations = (0..errors.weights.len()).map(out).collect();
        let pairs: Vec<[f64; 2]> = (0..=STEPS_APART)
            .map(|step| errors.may_be_excluded(number(step * PARTS)).map(deviations))
            .collect();
        let before = pairs.iter().skip(1).rev().map(|pair| pair[1]);
        errors.limits = before.chain(pairs.iter().map(|pair| pair[0])).collect();
        errors
    }

    /// Probability of less than so many parts.
    fn below(&self, parts: f64) -> f64 {
        between_two(&self.below, parts + number(self.weights.len()) / 2.0)
    }

    /// How far out so many parts are, in standard deviations of a normal number.
    fn deviations(&self, parts: f64) -> f64 {
        between_two(&self.deviations, parts + number(self.weights.len() / 2))
    }

    /// Parts of which less have this probability.
    fn quantile(&self, probability: f64) -> f64 {
        let beyond = self.below.partition_point(|below| *below < probability).max(1);
        let Some(upper) = self.below.get(beyond) else { return number(self.weights.len()) / 2.0 };
        let lower = self.below[beyond - 1];
        let part = if lower < *upper { (probability - lower) / (upper - lower) } else { 0.0 };
        number(beyond - 1) + part - number(self.weights.len()) / 2.0
    }

    /// How far out is excluded at a place of a figure that has the same value at another one, so many
    /// parts behind.
    fn limit(&self, behind: Option<f64>) -> f64 {
        behind.map_or(LIMIT, |parts| {
            between_two(&self.limits, parts / number(PARTS) + number(STEPS_APART))
        })
    }

    /// Where a value is at two places so many parts apart, readings near either of them speak for it.
    /// So that they do with the probability asked for whichever is true, less of each counts as
    /// near: what is excluded at the first and at the second.
    fn may_be_excluded(&self, apart: f64) -> [f64; 2] {
        let least = 1.0 - PROBABILITY;
        let mut excluded = [least; 2];
        for _ in 0..ROUNDS {
            for at in [0, 1] {
                let behind = if at == 0 { apart } else { -apart };
                let other = self.window(excluded[1 - at]).map(|end| end + behind);
                let held_less = |excluded: f64| {
                    let own = self.window(excluded);
                    let of = |[from, to]: [f64; 2]| (self.below(to) - self.below(from)).max(0.0);
                    let shared = [own[0].max(other[0]), own[1].min(other[1])];
                    of(shared) - of(own) - of(other)
                };
                // At most what is cut off at one side is caught again.
                excluded[at] = where_reached(&held_less, -PROBABILITY, [least, 2.0 * least]);
            }
        }
        excluded
    }

    /// Errors between which all are but what is excluded, half on either side.
    fn window(&self, excluded: f64) -> [f64; 2] {
        [self.quantile(excluded / 2.0), self.quantile(1.0 - excluded / 2.0)]
    }
}

/// Straight between two values of a row, at its ends beyond.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within the row")]
fn between_two(row: &[f64], at: f64) -> f64 {
    let last = row.len() - 1;
    let at = at.clamp(0.0, number(last));
    let whole = (at as usize).min(last.saturating_sub(1));
    row[whole] + (row[(whole + 1).min(last)] - row[whole]) * (at - number(whole))
}

/// Steps of the scale's standard uncertainty that two places are at most apart.
const STEPS_APART: usize = 2 * REACH * PER_STANDARD;
/// Rounds in which what is excluded at two places is found: each depends on the other.
const ROUNDS: usize = 6;

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
    let edge = |k: usize| (number(k) - number(HALF) - 0.5) * part / standard;
    let below = |k: usize| below(distribution, edge(k));
    (0..=2 * HALF).map(|k| below(k + 1) - below(k)).collect()
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

/// Values at the parts of each step: straight from one to the next, or with a kink where the lines
/// of both neighbouring steps meet.
fn between(values: &[f64]) -> Vec<f64> {
    let step = |from: usize| Some(values.get(from + 1)? - values.get(from)?);
    let parts = |at: usize| -> Vec<f64> {
        let (from, to) = (values[at], values[at + 1]);
        let sides = at.checked_sub(1).and_then(step).zip(step(at + 1));
        let value = |part: usize| {
            let x = number(part) / number(PARTS);
            let straight = from + (to - from) * x;
            let kinked =
                |(before, after): (f64, f64)| (from + before * x).max(to - after * (1.0 - x));
            sides.map_or(straight, |sides| straight.min(kinked(sides)))
        };
        (0..PARTS).map(value).collect()
    };
    let mut all: Vec<f64> = (0..values.len() - 1).flat_map(parts).collect();
    all.extend(values.last());
    all
}

/// The least of a figure that has its least near a part: where the lines of both sides meet.
fn deepest(changes_um: &[f64], least: usize) -> f64 {
    let about = least.checked_sub(2).and_then(|from| changes_um.get(from..=least + 2));
    let Some(&[a, b, at, c, d]) = about else { return changes_um[least] };
    let (down, up) = (b - a, d - c);
    let from_b = (c - b - 2.0 * up) / (down - up);
    let met = b + down * from_b;
    if met.is_finite() { at.min(met) } else { at }
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

    fn source(distribution: Distribution, standard: f64) -> Source {
        Source {
            quantity: String::new(),
            estimate: 0.0,
            unit: "",
            standard,
            distribution,
            degrees_of_freedom: f64::INFINITY,
            acts: Acts::OnLengths(1.0),
        }
    }

    /// Of the size, and of the length itself: how far below and above the true one may be.
    fn ends_um(at_um: f64, sources: &[(Distribution, f64)], noise_um: f64) -> [[f64; 2]; 2] {
        let sources: Vec<Source> = sources.iter().map(|one| source(one.0, one.1)).collect();
        let metre = Metre(at_um);
        let lengths = Lengths::new(&metre, &[], &sources);
        [0, 1].map(|figure| lengths.ends_um(figure, Noise::even(noise_um), 1.0))
    }

    fn near(found: f64, expected: f64) {
        assert!((found - expected).abs() < 4e-3 * expected.abs(), "{found}, expected {expected}");
    }

    fn both_near(found: [f64; 2], expected: f64) {
        for one in found {
            near(one, expected);
        }
    }

    /// Two of a normal one; of a rectangle 0.9545·√3; of two alike, a triangle, (1 − √0.0455)·√6.
    #[test]
    fn what_adds_as_it_is() {
        let (share, rectangle) = (PROBABILITY, Distribution::Rectangular);
        both_near(ends_um(1.0, &[(Distribution::Normal, 0.3)], 0.4)[1], 1.0);
        both_near(ends_um(1.0, &[(Distribution::Normal, 0.3)], 0.0)[1], 0.6);
        both_near(ends_um(1.0, &[], 0.3)[1], 0.6);
        both_near(ends_um(1.0, &[(rectangle, 0.3)], 0.0)[1], 0.3 * share * 3.0_f64.sqrt());
        let triangle = (1.0 - (1.0 - share).sqrt()) * 6.0_f64.sqrt();
        let two = ends_um(1.0, &[(rectangle, 0.3); 2], 0.0)[1];
        both_near(two, 0.3 * 2.0_f64.sqrt() * triangle);
    }

    /// A cosine error makes lengths too short alone: up to 0.977² of its most, √5.
    #[test]
    fn what_has_one_sign_is_on_one_side() {
        let cosine = Distribution::SquareOfRectangular;
        let [below_um, above_um] = ends_um(1.0, &[(cosine, 0.3)], 0.0)[1];
        near(above_um, 0.3 * (0.977_25 * 0.977_25) * 5.0_f64.sqrt());
        assert!(below_um.abs() < 0.3 / 16.0, "a part: {below_um}");
    }

    /// Of one degree of freedom when the noise is on the one side, of two on the other.
    #[test]
    fn the_limit_at_a_least_holds_as_much() {
        let one = libm::erf((MOST_AT_LEAST / 2.0).sqrt());
        let two = 1.0 - libm::exp(-MOST_AT_LEAST / 2.0);
        assert!((f64::midpoint(one, two) - PROBABILITY).abs() < 1e-3);
    }

    #[test]
    fn nothing_wrong_is_no_uncertainty() {
        assert_eq!(ends_um(1.0, &[], 0.0)[0], [0.0; 2]);
    }

    /// The mean of a normal number of unit variance whose sign is not known, as Feldman and Cousins
    /// have it for 95.45 %: a size of nothing may be 1.69, one far from nothing is as any other.
    #[test]
    fn a_size_near_nothing() {
        let one = [(Distribution::Normal, 1.0)];
        let [below_um, above_um] = ends_um(0.0, &one, 0.0)[0];
        assert!(below_um.abs() < 1e-9);
        assert!((1.69..1.73).contains(&above_um), "{above_um}");
        both_near(ends_um(9.0, &one, 0.0)[0], 2.0);
    }

    /// Of 2000 sizes each, drawn: whether one is nothing, near it or far, it is held as often as said.
    #[test]
    fn sizes_are_held_wherever_they_are() {
        use rand::SeedableRng;
        let mut chance = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        // A size of nothing is told to rounding.
        for true_um in [1e-9, 0.5, 1.0, 2.0, 3.0] {
            let held = (0..500).filter(|_| {
                let read_um = true_um + crate::drawn::normal(&mut chance);
                let [below_um, above_um] = ends_um(read_um, &[(Distribution::Normal, 1.0)], 0.0)[0];
                (-below_um..=above_um).contains(&(true_um - read_um.abs()))
            });
            let held = held.count();
            assert!((465..=489).contains(&held), "{true_um}: {held} of 500, expected 477");
        }
    }
}
