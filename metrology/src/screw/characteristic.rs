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
    pub reached: Result<Reached, String>,
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
