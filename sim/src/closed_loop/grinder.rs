//! The plant as the closed loop sees it.

use helixlock_plant::edges::Edges;
use helixlock_plant::motion::{LeftOut, Pass};
use helixlock_plant::{EffectError, Model};

use super::process::{Place, Process};

/// A machine under way in one pass; its lead error counts from the start of the pass.
#[derive(Debug)]
pub struct Grinder {
    edges: Edges,
    zero_um: f64,
}

impl Grinder {
    /// A machine at the start of a pass of `length_mm`.
    ///
    /// # Errors
    ///
    /// Those of [`Edges::new`].
    pub fn new(model: &Model, length_mm: f64) -> Result<Self, EffectError> {
        let mut pass = Pass::forward(model);
        for leg in &mut pass.legs {
            leg.length_mm = length_mm;
        }
        let mut edges = Edges::new(model, &pass)?;
        let zero_um = edges.place(0.0).lead_error_um;
        Ok(Self { edges, zero_um })
    }

    /// Effects that do nothing because the machine file does not say what drives them.
    #[must_use]
    pub fn left_out(&self) -> &[LeftOut] {
        &self.edges.motion().left_out
    }
}

impl Process for Grinder {
    fn next_line_s(&mut self) -> f64 {
        self.edges.next_line_s()
    }

    fn next_fringe_s(&mut self) -> f64 {
        self.edges.next_fringe_s()
    }

    fn pass_line(&mut self) {
        self.edges.pass_line();
    }

    fn pass_fringe(&mut self) {
        self.edges.pass_fringe();
    }

    fn step(&mut self, time_s: f64, forward: bool) {
        self.edges.step(time_s, forward);
    }

    fn place(&mut self, time_s: f64) -> Place {
        let place = self.edges.place(time_s);
        Place {
            position_mm: place.position_mm,
            lead_error_um: place.lead_error_um - self.zero_um,
            correction_um: place.corrector_um,
        }
    }

    fn failure(&self) -> Option<EffectError> {
        self.edges.failure()
    }
}
