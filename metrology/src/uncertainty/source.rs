//! What may be wrong with a measurement, and by how much.

use crate::number::{mean, number};

/// How the values of an input quantity are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// Normal, as certificates state it.
    Normal,
    /// Anywhere between two limits alike.
    Rectangular,
    /// The square of a length that lies anywhere between two limits alike: a cosine error.
    SquareOfRectangular,
}

/// What an error of an input quantity does to the readings; each number is for one unit of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Acts {
    /// It makes all lengths wrong alike, µm/m.
    OnLengths(f64),
    /// It adds to every reading at a place alike, from place to place independently, µm.
    AtEachPlace(f64),
    /// It adds to every reading independently, µm.
    AtEachReading(f64),
    /// It adds to the readings and goes its own way while they are taken, µm: new at each reading,
    /// or one of each run, or from little to much.
    AsTimeGoes(f64),
    /// It changes each figure by this, µm, found by other means.
    OnFigures(Vec<f64>),
    /// The same, and how far off the figures may be is in the readings as they may be.
    AsDrawn(Vec<f64>),
}

/// An input quantity of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// What it is.
    pub quantity: String,
    /// Its estimate, in its unit.
    pub estimate: f64,
    /// Its unit.
    pub unit: &'static str,
    /// Its standard uncertainty, in its unit.
    pub standard: f64,
    /// How its values are spread.
    pub distribution: Distribution,
    /// Degrees of freedom of the standard uncertainty; infinite when it is taken as known.
    pub degrees_of_freedom: f64,
    /// What an error of it does.
    pub acts: Acts,
}

/// An error that is added to readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Added {
    /// None.
    Nothing,
    /// Proportional to the position, µm/m.
    ToLengths(f64),
    /// To every reading at one place, µm.
    AtPlace(usize, f64),
    /// To one reading, µm.
    AtReading(usize, f64),
}

/// What errors of single readings do to a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Mean of the true figure less the one as read, µm.
    pub shift_um: f64,
    /// Standard uncertainty to below of that mean, half of what holds all but 2.3 %, µm.
    pub below_um: f64,
    /// To above of it, µm.
    pub above_um: f64,
}

/// So many draws have enough beyond 2.3 % of them.
const MANY_DRAWS: usize = 1000;

impl Noise {
    /// As much to either side, and about the figure as read.
    #[must_use]
    pub fn even(standard_um: f64) -> Self {
        Self { shift_um: 0.0, below_um: standard_um, above_um: standard_um }
    }

    /// Of the true figure as it may be, drawn, and of the one as read, µm. Many draws show where they
    /// end to either side, few how they scatter.
    pub(super) fn of(drawn_um: &[f64], found_um: f64) -> Self {
        let shift_um = mean(drawn_um) - found_um;
        if MANY_DRAWS <= drawn_um.len() {
            let mut sorted = drawn_um.to_vec();
            sorted.sort_by(f64::total_cmp);
            let beyond = sorted.len() * 23 / 1000;
            let mean_um = found_um + shift_um;
            let below_um = (mean_um - sorted[beyond]) / 2.0;
            let above_um = (sorted[sorted.len() - 1 - beyond] - mean_um) / 2.0;
            return Self { shift_um, below_um, above_um };
        }
        let squares = drawn_um.iter().map(|um| (um - found_um - shift_um).powi(2)).sum::<f64>();
        // One alone is what it is for sure.
        let standard_um = (squares / (number(drawn_um.len()) - 1.0).max(1.0)).sqrt();
        Self { shift_um, ..Self::even(standard_um) }
    }

    /// From the lowest to the highest that any of several ways may have made: nothing tells which it was.
    pub(super) fn of_any(ways: &[Self]) -> Self {
        let first = match ways {
            [] => return Self::even(0.0),
            [only] => return *only,
            [first, ..] => first,
        };
        let lowest = |one: &Self| one.shift_um - 2.0 * one.below_um;
        let highest = |one: &Self| one.shift_um + 2.0 * one.above_um;
        let shift_um = first.shift_um;
        let lowest_um = ways.iter().map(lowest).fold(f64::INFINITY, f64::min);
        let highest_um = ways.iter().map(highest).fold(f64::NEG_INFINITY, f64::max);
        Self {
            shift_um,
            below_um: (shift_um - lowest_um) / 2.0,
            above_um: (highest_um - shift_um) / 2.0,
        }
    }

    /// With something independent of it, normal, of this standard uncertainty, µm.
    #[must_use]
    pub fn with(self, standard_um: f64) -> Self {
        let with = |um: f64| libm::hypot(um, standard_um);
        Self { below_um: with(self.below_um), above_um: with(self.above_um), ..self }
    }
}

/// Readings from which figures are evaluated.
pub trait Readings {
    /// Places at which something was read.
    fn places(&self) -> usize;
    /// Readings at all places.
    fn readings(&self) -> usize;
    /// All figures, µm, always in the same order, with an error added to the readings.
    fn figures_um(&self, added: Added) -> Vec<f64>;
    /// The readings without the errors of single ones as they may have been, drawn given what was read,
    /// for each way in which these errors may have gone that nothing tells from the others; none where
    /// nothing but the contributions tells of these errors.
    fn as_may_be(&self, _sources: &[Source]) -> Vec<Vec<Box<dyn Readings>>> {
        Vec::new()
    }
}

/// Figures whose errors are told of themselves.
#[derive(Clone, Debug)]
pub struct Told {
    figures_um: Vec<f64>,
    drawn_um: Vec<Vec<f64>>,
}

impl Told {
    /// Figures as found, and as they may be, µm.
    #[must_use]
    pub fn new(figures_um: Vec<f64>, drawn_um: Vec<Vec<f64>>) -> Self {
        Self { figures_um, drawn_um }
    }
}

impl Readings for Told {
    fn places(&self) -> usize {
        0
    }

    fn readings(&self) -> usize {
        0
    }

    fn figures_um(&self, _: Added) -> Vec<f64> {
        self.figures_um.clone()
    }

    fn as_may_be(&self, _: &[Source]) -> Vec<Vec<Box<dyn Readings>>> {
        let boxed = |figures_um: &Vec<f64>| -> Box<dyn Readings> {
            Box::new(Self::new(figures_um.clone(), Vec::new()))
        };
        let drawn: Vec<Box<dyn Readings>> = self.drawn_um.iter().map(boxed).collect();
        if drawn.is_empty() { Vec::new() } else { vec![drawn] }
    }
}

impl Distribution {
    /// In one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Normal => "normal",
            Self::Rectangular => "rectangular",
            Self::SquareOfRectangular => "square of rectangular",
        }
    }
}

/// A measuring line that is off the axis by at most `offset_mm` over `length_mm`: lengths are
/// too short by `o²/(2·L²)` of themselves, `o` anywhere up to the offset alike.
///
/// Nobody takes such an error off, so what counts is its root mean square about zero,
/// `offset²/(2·√5·L²)`, and not its spread about its mean (JCGM 100:2008, F.2.4.4 and F.2.4.5).
/// Twice it, `0.447·offset²/L`, holds the error in √0.894 = 94.6 % of all cases; the spread,
/// `0.3·offset²/L`, as a width taken for centred, in √0.577 = 76 %.
#[must_use]
pub fn misalignment(offset_mm: f64, length_mm: f64) -> Source {
    let part = offset_mm / length_mm;
    Source {
        quantity: "misalignment of the device".into(),
        estimate: 0.0,
        unit: "um/m",
        standard: part * part / (2.0 * 5.0_f64.sqrt()) * 1e6,
        distribution: Distribution::SquareOfRectangular,
        degrees_of_freedom: f64::INFINITY,
        acts: Acts::OnLengths(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::misalignment;

    /// 1 mm over 1 m is a cosine error of up to 0.5 µm.
    #[test]
    fn a_millimetre_over_a_metre() {
        let um_per_m = misalignment(1.0, 1000.0).standard;
        assert!((um_per_m - 0.223_606_797_749_979).abs() < 1e-12, "{um_per_m}");
    }
}
