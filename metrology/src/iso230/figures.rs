//! Every figure of an axis by name, and what errors of the instrument do to them.

use super::{AxisResult, Target, Vdi3441, axis_of, evaluate_axis, evaluate_target};
use crate::number::{mean, number};
use crate::uncertainty::{Added, Readings, Source};

/// One figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// Symbol of the standard.
    pub symbol: &'static str,
    /// Its name as a key.
    pub key: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Its value, µm.
    pub value_um: f64,
}

impl AxisResult {
    /// The figures that there are, ISO 230-2 first, then VDI/DGQ 3441.
    #[must_use]
    pub fn figures(&self) -> Vec<Figure> {
        let vdi = |figure: fn(&Vdi3441) -> f64| self.vdi3441.as_ref().map(figure);
        let [accuracy_up, accuracy_down] = self.accuracy_unidirectional_um;
        let [systematic_up, systematic_down] = self.systematic_unidirectional_um;
        let [repeatability_up, repeatability_down] = self.repeatability_unidirectional_um;
        let all = [
            ("A", "accuracy", "accuracy", Some(self.accuracy_um)),
            ("A↑", "accuracy_forward", "accuracy, forward", accuracy_up),
            ("A↓", "accuracy_backward", "accuracy, backward", accuracy_down),
            ("E", "systematic", "systematic error", Some(self.systematic_um)),
            ("E↑", "systematic_forward", "systematic error, forward", systematic_up),
            ("E↓", "systematic_backward", "systematic error, backward", systematic_down),
            ("M", "mean_range", "range of the means", Some(self.mean_range_um)),
            ("B", "reversal", "largest reversal value", self.reversal_um),
            ("B̄", "mean_reversal", "mean reversal value", self.mean_reversal_um),
            ("R", "repeatability", "repeatability", Some(self.repeatability_um)),
            ("R↑", "repeatability_forward", "repeatability, forward", repeatability_up),
            ("R↓", "repeatability_backward", "repeatability, backward", repeatability_down),
            ("P", "p", "VDI/DGQ 3441 positional uncertainty", vdi(|vdi| vdi.uncertainty_um)),
            ("Pa", "pa", "VDI/DGQ 3441 positional deviation", vdi(|vdi| vdi.deviation_um)),
            ("U", "u_max", "VDI/DGQ 3441 largest reversal span", vdi(|vdi| vdi.reversal_um[0])),
            ("Ps", "ps_max", "VDI/DGQ 3441 largest scatter", vdi(|vdi| vdi.scatter_um[0])),
        ];
        let there = all.into_iter().filter_map(|(symbol, key, meaning, value_um)| {
            Some(Figure { symbol, key, meaning, value_um: value_um? })
        });
        there.collect()
    }
}

/// Approaches that can be evaluated, for a budget of their figures.
#[derive(Clone, Debug)]
pub struct Approaches {
    /// In order of position.
    pub(super) targets: Vec<Target>,
    found: AxisResult,
}

impl Approaches {
    /// Evaluates the approaches.
    ///
    /// # Errors
    ///
    /// As [`evaluate_axis`].
    pub fn new(targets: Vec<Target>) -> Result<Self, crate::Error> {
        let found = evaluate_axis(&targets)?;
        let mut targets = targets;
        targets.sort_by(|a, b| a.at_mm.total_cmp(&b.at_mm));
        Ok(Self { targets, found })
    }

    /// What was found.
    #[must_use]
    pub fn found(&self) -> &AxisResult {
        &self.found
    }

    /// Scatter of the approaches, the root mean square of all standard uncertainties s, µm.
    #[must_use]
    pub fn scatter_um(&self) -> f64 {
        let each = self.found.targets.iter();
        let squares = each.flat_map(|t| [Some(t.s_forward_um), t.s_backward_um]).flatten();
        mean(&squares.map(|s_um| s_um * s_um).collect::<Vec<_>>()).sqrt()
    }

    /// Two approaches that are the same at every target and each way, where by how often others are the
    /// same at one this is no chance: rows that are there twice.
    #[must_use]
    pub fn copied(&self) -> Option<[usize; 2]> {
        /// Less probable than this is no chance.
        const CHANCE: f64 = 0.01;
        let cells = self.targets.iter().flat_map(|t| [&t.forward_um, &t.backward_um]);
        let cells: Vec<&Vec<f64>> = cells.filter(|cell| !cell.is_empty()).collect();
        let runs = cells.iter().map(|cell| cell.len()).min()?;
        let alike = |[one, other]: [usize; 2]| {
            cells.iter().filter(|cell| cell[one].to_bits() == cell[other].to_bits()).count()
        };
        let pairs = (0..runs).flat_map(|one| (one + 1..runs).map(move |other| [one, other]));
        let each: Vec<([usize; 2], usize)> = pairs.map(|pair| (pair, alike(pair))).collect();
        let first = each.iter().find(|(_, alike)| *alike == cells.len())?.0;
        // Coarse readings are often the same, and all of them may be.
        let often = mean(&each.iter().map(|(_, alike)| number(*alike)).collect::<Vec<_>>());
        let chance = libm::pow(often / number(cells.len()), number(cells.len()));
        let all = each.iter().all(|(_, alike)| *alike == cells.len());
        (1 < cells.len() && (all || chance * number(each.len()) < CHANCE)).then_some(first)
    }

    /// From the first target to the last, mm.
    #[must_use]
    pub fn length_mm(&self) -> f64 {
        let [first, .., last] = self.found.targets.as_slice() else { return 0.0 };
        last.at_mm - first.at_mm
    }
}

impl Readings for Approaches {
    fn as_may_be(&self, sources: &[Source]) -> Vec<Vec<Box<dyn Readings>>> {
        let drawn = super::noise::without_noise(&self.targets, sources).into_iter();
        let boxed = |targets| Self::new(targets).ok().map(|one| Box::new(one) as Box<dyn Readings>);
        drawn.map(|way| way.into_iter().filter_map(boxed).collect()).collect()
    }

    fn places(&self) -> usize {
        self.targets.len()
    }

    fn readings(&self) -> usize {
        self.targets.iter().map(|target| target.forward_um.len() + target.backward_um.len()).sum()
    }

    fn figures_um(&self, added: Added) -> Vec<f64> {
        if added == Added::Nothing {
            return self.found.figures().iter().map(|figure| figure.value_um).collect();
        }
        // One target alone is another where one reading or one place is.
        let mut results = self.found.targets.clone();
        let mut reading = 0;
        for (place, target) in self.targets.iter().enumerate() {
            let first = reading;
            reading += target.forward_um.len() + target.backward_um.len();
            let shift = |one: usize| match added {
                Added::ToLengths(um_per_m) => um_per_m * target.at_mm / 1000.0,
                Added::AtPlace(at, more) if at == place => more,
                Added::AtReading(at, more) if at == first + one => more,
                _ => 0.0,
            };
            let there = match added {
                Added::AtPlace(at, _) => at == place,
                Added::AtReading(at, _) => (first..reading).contains(&at),
                Added::ToLengths(_) | Added::Nothing => true,
            };
            if there {
                let mut changed = target.clone();
                let each = changed.forward_um.iter_mut().chain(&mut changed.backward_um);
                each.enumerate().for_each(|(one, um)| *um += shift(one));
                let bidirectional = !changed.backward_um.is_empty();
                // Evaluated once already, and a finite error makes no reading infinite.
                results[place] = evaluate_target(&changed, bidirectional).unwrap_or(results[place]);
            }
        }
        axis_of(results).figures().iter().map(|figure| figure.value_um).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uncertainty::{Acts, Budget, Distribution, budgets};

    /// 11 targets over a metre; deviations rise by 10 µm, 1 µm of reversal, scatter alike.
    fn approaches() -> Approaches {
        let scatter_um = [0.4, -0.3, 0.1, -0.4, 0.2];
        let target = |k: u32| {
            let mean_um = f64::from(k);
            let around = |shift: f64| scatter_um.iter().map(|um| mean_um + shift + um).collect();
            Target { at_mm: 100.0 * mean_um, forward_um: around(0.5), backward_um: around(-0.5) }
        };
        Approaches::new((0..11).map(target).collect()).unwrap()
    }

    fn with(acts: Acts) -> Vec<(&'static str, Budget)> {
        let approaches = approaches();
        let source = Source {
            quantity: "something".into(),
            estimate: 0.0,
            unit: "um",
            standard: 1e-3,
            distribution: Distribution::Normal,
            degrees_of_freedom: f64::INFINITY,
            acts,
        };
        let symbols = approaches.found().figures().into_iter().map(|figure| figure.symbol);
        symbols.zip(budgets(&approaches, &[source])).collect()
    }

    fn sensitivity(of: &[(&'static str, Budget)], symbol: &str) -> f64 {
        let found = of.iter().find(|(name, _)| *name == symbol).unwrap();
        found.1.contributions[0].sensitivity
    }

    /// n = 5: means √(1/n), standard deviations √(1/(n − 1)), each taken from the formulas by hand.
    #[test]
    fn noise_of_readings_by_hand() {
        let found = with(Acts::AtEachReading(1.0));
        let by_hand = [
            ("A", (2.0 * (1.0 / 5.0 + 4.0 / 4.0_f64)).sqrt()),
            ("E", (2.0 / 5.0_f64).sqrt()),
            ("M", (1.0 / 5.0_f64).sqrt()),
            ("B̄", (2.0 / 5.0 / 11.0_f64).sqrt()),
        ];
        for (symbol, expected) in by_hand {
            let sensitivity = sensitivity(&found, symbol);
            assert!((sensitivity - expected).abs() < 2e-3 * expected, "{symbol} {sensitivity}");
        }
    }

    #[test]
    fn a_wrong_scale_moves_what_spans_the_axis_and_nothing_else() {
        let found = with(Acts::OnLengths(1.0));
        for symbol in ["A", "A↑", "E", "E↓", "M", "P", "Pa"] {
            assert!((sensitivity(&found, symbol) - 1.0).abs() < 1e-6, "{symbol}");
        }
        for symbol in ["B", "B̄", "R", "R↑", "U", "Ps"] {
            assert!(sensitivity(&found, symbol) < 1e-6, "{symbol}");
        }
    }

    #[test]
    fn an_error_of_a_place_is_no_scatter_and_no_reversal() {
        let found = with(Acts::AtEachPlace(1.0));
        assert!((sensitivity(&found, "E") - 2.0_f64.sqrt()).abs() < 1e-6);
        for symbol in ["B", "R", "Ps"] {
            assert!(sensitivity(&found, symbol) < 1e-6, "{symbol}");
        }
    }
}
