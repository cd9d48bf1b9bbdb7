//! One figure a standard asks for, with the place where it is reached.

/// One characteristic of a screw.
#[derive(Clone, Debug, PartialEq)]
pub struct Characteristic {
    /// Symbol as the standard writes it: `e`, `Vu`, `V300`, `V2π`, `ΔL25` …
    pub symbol: &'static str,
    /// Key of its limits in the tolerance table: `ep`, `vup`, `v300p`, `v2pip` …
    pub limit: &'static str,
    /// What it is, in words.
    pub meaning: &'static str,
    /// The value, or why there is none.
    pub reached: Result<Reached, Missing>,
}

impl Characteristic {
    /// True of a figure that is linear in the readings: noise moves it, and does not make it larger.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.symbol == "e"
    }
}

/// Why a characteristic has no value.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Missing {
    /// The screw has no such figure: a window is longer than its useful travel.
    #[error("the travel evaluated, {travel_mm:.3} mm, is shorter than {window_mm} mm")]
    ShortTravel {
        /// Travel evaluated, mm.
        travel_mm: f64,
        /// The window, mm.
        window_mm: f64,
    },
    /// It has one, but samples are too far apart to show it.
    #[error("{found:.2} samples a turn are too few, expected {expected} or more")]
    TooFewPerTurn {
        /// Samples a turn.
        found: f64,
        /// What it takes.
        expected: f64,
    },
    /// It has one, but a line through so few samples leaves nothing.
    #[error("{found} samples are too few, expected {expected} or more")]
    TooFewSamples {
        /// Samples there are.
        found: usize,
        /// What it takes.
        expected: usize,
    },
    /// It has one, but no two samples lie within the window.
    #[error("no two samples lie within {window_mm} mm of each other")]
    NoPair {
        /// The window, mm.
        window_mm: f64,
    },
}

impl Missing {
    /// True when the screw has the figure and only the samples do not show it.
    #[must_use]
    pub fn is_unmeasured(self) -> bool {
        !matches!(self, Self::ShortTravel { .. })
    }
}

/// A value and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// The value, µm; only `e` and pitch errors have a sign.
    pub value_um: f64,
    /// Travel of the higher of the two points that make it, mm.
    pub highest_mm: f64,
    /// Travel of the lower of them, mm.
    pub lowest_mm: f64,
}

impl Reached {
    /// The stretch of travel it is reached in, mm, the smaller end first.
    #[must_use]
    pub fn stretch_mm(&self) -> [f64; 2] {
        [self.highest_mm.min(self.lowest_mm), self.highest_mm.max(self.lowest_mm)]
    }
}
