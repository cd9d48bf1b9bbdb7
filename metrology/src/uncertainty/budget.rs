//! From what may be wrong to the uncertainty of each figure.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::expanded::{Lengths, PROBABILITY};
use super::source::{Acts, Added, Noise, Readings, Source};

/// One line of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// The input quantity.
    pub source: Source,
    /// Change of the figure for one unit of the input quantity, µm.
    pub sensitivity: f64,
    /// Their product, µm.
    pub contribution_um: f64,
}

/// The uncertainty of one figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// The figure as measured, µm.
    pub value_um: f64,
    /// What contributes, in the order of the sources.
    pub contributions: Vec<Contribution>,
    /// Combined standard uncertainty, µm.
    pub standard_um: f64,
    /// Effective degrees of freedom (Welch and Satterthwaite); infinite when every source's are.
    pub degrees_of_freedom: f64,
    /// Coverage factor, the mean of both sides over u: 2 where all is normal and adds to the figure as it is.
    pub coverage_factor: f64,
    /// How far below the figure as read the true one may be, µm; less than nothing when it is above.
    pub below_um: f64,
    /// How far above it, µm.
    pub above_um: f64,
}

impl Contribution {
    /// True of what lengths and single readings do: the one is spread by itself, the other may be told
    /// by the readings.
    fn is_alone(&self, told: bool) -> bool {
        match self.source.acts {
            Acts::OnFigures(_) => true,
            Acts::OnLengths(_) | Acts::AsDrawn(_) => false,
            _ => !told,
        }
    }
}

impl Budget {
    /// An expanded uncertainty (k = 2) that somebody else worked out.
    #[must_use]
    pub fn told(value_um: f64, expanded_um: f64) -> Self {
        Self {
            value_um,
            contributions: Vec::new(),
            standard_um: expanded_um / 2.0,
            degrees_of_freedom: f64::INFINITY,
            coverage_factor: 2.0,
            below_um: expanded_um,
            above_um: expanded_um,
        }
    }

    /// Expanded uncertainty U: the larger of both sides, µm.
    #[must_use]
    pub fn expanded_um(&self) -> f64 {
        self.below_um.max(self.above_um)
    }

    /// Whether the true figure may be this one, µm.
    #[must_use]
    pub fn holds(&self, true_um: f64) -> bool {
        (-self.below_um..=self.above_um).contains(&(true_um - self.value_um))
    }
}

/// As many degrees of freedom are as good as infinitely many: k is 2.00003.
const MANY: f64 = 1e5;

/// A budget for every figure, in their order.
///
/// A contribution is the root mean square of what one standard uncertainty more and one less
/// change (JCGM 100:2008, 5.1.3 note 2; both differ where a range changes its places), with what
/// noise adds on average (the second-order term of 5.1.2). Contributions are independent and add by
/// their squares (5.1.2). Both sides are by how all of them together are spread, times half of
/// Student's factor where the standard uncertainties themselves are not well known (G.4).
#[must_use]
pub fn budgets(readings: &dyn Readings, sources: &[Source]) -> Vec<Budget> {
    let values_um = readings.figures_um(Added::Nothing);
    let changes: Vec<Vec<f64>> =
        sources.iter().map(|source| changes_um(readings, source, &values_um)).collect();
    let drawn = readings.as_may_be(sources);
    let drawn_um: Vec<Vec<Vec<f64>>> = drawn
        .iter()
        .map(|way| way.iter().map(|one| one.figures_um(Added::Nothing)).collect())
        .collect();
    let noise = |figure: usize| {
        let of_way = |way: &Vec<Vec<f64>>| {
            let each: Vec<f64> = way.iter().map(|figures_um| figures_um[figure]).collect();
            Noise::of(&each, values_um[figure])
        };
        Noise::of_any(&drawn_um.iter().map(of_way).collect::<Vec<_>>())
    };
    let lengths = Lengths::new(readings, drawn.first().map_or(&[], Vec::as_slice), sources);
    let budget = |(figure, value_um): (usize, &f64)| {
        let each = sources.iter().zip(&changes);
        let contributions: Vec<Contribution> =
            each.map(|(source, changes)| contribution(source, changes[figure])).collect();
        let alone = contributions.iter().filter(|one| one.is_alone(!drawn.is_empty()));
        let noise = noise(figure).with(root_of_squares(alone));
        combined(*value_um, contributions, &|wider| lengths.ends_um(figure, noise, wider))
    };
    values_um.iter().enumerate().map(budget).collect()
}

fn contribution(source: &Source, contribution_um: f64) -> Contribution {
    let known = 0.0 < source.standard;
    let sensitivity = if known { contribution_um / source.standard } else { 0.0 };
    Contribution { source: source.clone(), sensitivity, contribution_um }
}

fn root_of_squares<'a>(contributions: impl Iterator<Item = &'a Contribution>) -> f64 {
    contributions.map(|one| one.contribution_um.powi(2)).sum::<f64>().sqrt()
}

/// `ends_um` are how far below and above the true figure may be, when what is known is widened.
fn combined(
    value_um: f64,
    contributions: Vec<Contribution>,
    ends_um: &dyn Fn(f64) -> [f64; 2],
) -> Budget {
    let fourth = |one: &Contribution| one.contribution_um.powi(4) / one.source.degrees_of_freedom;
    let fourths: f64 = contributions.iter().map(fourth).sum();
    let standard_um = root_of_squares(contributions.iter());
    let effective = if 0.0 < fourths { standard_um.powi(4) / fourths } else { f64::INFINITY };
    let degrees_of_freedom = if effective < MANY { effective } else { f64::INFINITY };
    let [below_um, above_um] = ends_um(student(degrees_of_freedom) / 2.0);
    let half_um = f64::midpoint(below_um, above_um);
    Budget {
        value_um,
        contributions,
        standard_um,
        degrees_of_freedom,
        coverage_factor: if 0.0 < standard_um { half_um / standard_um } else { 2.0 },
        below_um,
        above_um,
    }
}

/// Two, or more for few degrees of freedom, of which a part does not count.
pub(crate) fn student(degrees_of_freedom: f64) -> f64 {
    let whole = degrees_of_freedom.floor().max(1.0);
    match StudentsT::new(0.0, 1.0, whole) {
        Ok(student) if whole < MANY => student.inverse_cdf(f64::midpoint(1.0, PROBABILITY)),
        _ => 2.0,
    }
}

/// What a source's standard uncertainty changes of each figure, µm.
fn changes_um(readings: &dyn Readings, source: &Source, values_um: &[f64]) -> Vec<f64> {
    let of = |um: f64| um * source.standard;
    match &source.acts {
        Acts::OnFigures(um) | Acts::AsDrawn(um) => um.iter().map(|um| of(*um)).collect(),
        Acts::OnLengths(um) => on_lengths(readings, values_um, of(*um)),
        Acts::AtEachPlace(um) => {
            changed(readings, values_um, 0..readings.places(), &|place, sign| {
                Added::AtPlace(place, sign * of(*um))
            })
        }
        Acts::AtEachReading(um) | Acts::AsTimeGoes(um) => {
            changed(readings, values_um, 0..readings.readings(), &|reading, sign| {
                Added::AtReading(reading, sign * of(*um))
            })
        }
    }
}

/// A range may grow both ways; the mean of the squares has that already.
fn on_lengths(readings: &dyn Readings, values_um: &[f64], um_per_m: f64) -> Vec<f64> {
    let [more, less] =
        [um_per_m, -um_per_m].map(|um_per_m| readings.figures_um(Added::ToLengths(um_per_m)));
    let mean = |(value, (more, less)): (&f64, (&f64, &f64))| {
        libm::hypot(more - value, less - value) / 2.0_f64.sqrt()
    };
    values_um.iter().zip(more.iter().zip(&less)).map(mean).collect()
}

/// Root of the sum of the squares of what each error changes, up and down; and of what all of them
/// change on average, as the noise of readings makes a scatter wider: nobody takes that off.
fn changed<One: Copy>(
    readings: &dyn Readings,
    values_um: &[f64],
    each: impl Iterator<Item = One>,
    added: &dyn Fn(One, f64) -> Added,
) -> Vec<f64> {
    let mut squares = vec![0.0; values_um.len()];
    let mut widened = vec![0.0; values_um.len()];
    for one in each {
        for sign in [1.0, -1.0] {
            let figures_um = readings.figures_um(added(one, sign));
            for (figure, (with, without)) in figures_um.iter().zip(values_um).enumerate() {
                squares[figure] += (with - without).powi(2) / 2.0;
                widened[figure] += (with - without) / 2.0;
            }
        }
    }
    squares
        .iter()
        .zip(widened)
        .map(|(square, widened)| libm::hypot(square.sqrt(), widened))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uncertainty::Distribution;

    /// The mean and the range of readings at places 0, 1, 2 … m.
    struct Few(Vec<f64>);

    impl Readings for Few {
        fn places(&self) -> usize {
            self.0.len()
        }

        fn readings(&self) -> usize {
            self.0.len()
        }

        fn figures_um(&self, added: Added) -> Vec<f64> {
            let with = |(at, um): (usize, &f64)| match added {
                Added::ToLengths(um_per_m) => um + um_per_m * crate::number::number(at),
                Added::AtPlace(place, more) | Added::AtReading(place, more) if place == at => {
                    um + more
                }
                _ => *um,
            };
            let all: Vec<f64> = self.0.iter().enumerate().map(with).collect();
            let highest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let lowest = all.iter().copied().fold(f64::INFINITY, f64::min);
            vec![crate::number::mean(&all), highest - lowest]
        }
    }

    fn source(standard: f64, degrees_of_freedom: f64, acts: Acts) -> Source {
        Source {
            quantity: "something".into(),
            estimate: 0.0,
            unit: "um",
            standard,
            distribution: Distribution::Normal,
            degrees_of_freedom,
            acts,
        }
    }

    #[test]
    fn a_mean_and_a_range_by_hand() {
        let sources = [
            source(0.3, f64::INFINITY, Acts::AtEachReading(1.0)),
            source(0.1, f64::INFINITY, Acts::OnLengths(2.0)),
        ];
        let found = budgets(&Few(vec![0.0, 5.0, 2.0, 9.0]), &sources);
        let by_hand = [[0.3 / 2.0, 0.2 * 1.5], [0.3 * 2.0_f64.sqrt(), 0.2 * 3.0]];
        for (budget, [reading_um, length_um]) in found.iter().zip(by_hand) {
            let contributions = [&budget.contributions[0], &budget.contributions[1]];
            assert!((contributions[0].contribution_um - reading_um).abs() < 1e-12, "{budget:?}");
            assert!((contributions[1].contribution_um - length_um).abs() < 1e-12, "{budget:?}");
            assert!((budget.standard_um - libm::hypot(reading_um, length_um)).abs() < 1e-12);
            assert!((budget.coverage_factor - 2.0).abs() < 2e-3, "{budget:?}");
        }
    }

    /// JCGM 100:2008, table G.2: t for 95.45 % and 4, 10 and 50 degrees of freedom.
    #[test]
    fn few_degrees_of_freedom_widen() {
        for (degrees, published) in [(4.0, 2.87), (10.0, 2.28), (50.0, 2.05)] {
            let sources = [source(1.0, degrees, Acts::AtEachReading(1.0))];
            let found = &budgets(&Few(vec![1.0]), &sources)[0];
            assert!((found.degrees_of_freedom - degrees).abs() < 1e-9, "{found:?}");
            assert!((found.coverage_factor - published).abs() < 0.005, "{found:?}");
        }
    }

    /// JCGM 100:2008, G.4.1, example: 0.25, 0.57 and 0.82 of 10, 5 and 15 readings make 1.03 with 19
    /// degrees of freedom.
    #[test]
    fn welch_and_satterthwaite() {
        let sources = [(0.25, 9.0), (0.57, 4.0), (0.82, 14.0)]
            .map(|(standard, degrees)| source(standard, degrees, Acts::AtEachReading(1.0)));
        let found = &budgets(&Few(vec![1.0]), &sources)[0];
        assert!((found.standard_um - 1.03).abs() < 0.005, "{found:?}");
        assert!((found.degrees_of_freedom - 19.0).abs() < 0.05, "{found:?}");
    }
}
