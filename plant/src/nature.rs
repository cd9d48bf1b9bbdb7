//! What is special about an effect beside its formula.

/// What a diagnosis may take for granted of an effect before it has seen any data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nature {
    /// True for a jump wherever the table turns back.
    pub at_reversal: bool,
    /// True when its nonlinear values are plays, µm, that the corrector's moves get through.
    pub play: bool,
    /// Waves a turn of the spindle, of what has always as many.
    pub every_turn: Option<f64>,
    /// True when it shows what the machine does late, as another zero of the position would, but by
    /// the farther the faster a pass is.
    pub delays: bool,
    /// Lowest harmonic that does not come without those below it.
    pub high_harmonic: Option<f64>,
    /// Relative uncertainty of the known physics that its parameters multiply.
    pub uncertainty: f64,
    /// Its parameters that are numbers of the machine file, with their keys there; an effect that
    /// has any is a wrong setting, to be put right and not to be modelled.
    pub settings: &'static [(&'static str, &'static str)],
}

impl Nature {
    /// Nothing special.
    pub const PLAIN: Self = Self {
        at_reversal: false,
        play: false,
        every_turn: None,
        delays: false,
        high_harmonic: None,
        uncertainty: 0.0,
        settings: &[],
    };

    /// True for a number of the machine file that is other than the file says.
    #[must_use]
    pub fn is_setting(&self) -> bool {
        !self.settings.is_empty()
    }
}
