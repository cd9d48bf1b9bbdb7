//! Play between two parts.

/// Lost motion: the output follows the input once the play is taken up.
///
/// It starts in the middle of the play, so a motion of less than half the width moves nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Play {
    width_um: f64,
    output_um: f64,
}

impl Play {
    /// With a dead zone of this width, µm.
    #[must_use]
    pub fn new(width_um: f64) -> Self {
        Self { width_um: width_um.abs(), output_um: 0.0 }
    }

    /// Output for an input, µm.
    pub fn follow(&mut self, input_um: f64) -> f64 {
        let half_um = self.width_um / 2.0;
        self.output_um = self.output_um.clamp(input_um - half_um, input_um + half_um);
        self.output_um
    }
}
