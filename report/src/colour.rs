//! The colours of all pictures, told apart by colour-blind readers too (Okabe and Ito, 2008).

/// A colour of the palette.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Colour {
    /// First choice: the model, the corrected state.
    #[default]
    Blue,
    /// Second choice: the measurement, the uncorrected state.
    Orange,
    /// Third choice.
    Green,
    /// What is wrong: a limit, a fault.
    Red,
    /// Fourth choice.
    Purple,
    /// Fifth choice.
    Sky,
    /// Background matter.
    Grey,
    /// Ink.
    Black,
}

impl Colour {
    /// Red, green and blue.
    pub(crate) fn rgb(self) -> (u8, u8, u8) {
        match self {
            Self::Blue => (0, 91, 158),
            Self::Orange => (217, 119, 6),
            Self::Green => (0, 133, 100),
            Self::Red => (200, 30, 40),
            Self::Purple => (157, 80, 142),
            Self::Sky => (60, 155, 210),
            Self::Grey => (140, 147, 156),
            Self::Black => (33, 37, 41),
        }
    }

    /// As `#rrggbb`.
    pub(crate) fn hex(self) -> String {
        let (red, green, blue) = self.rgb();
        format!("#{red:02x}{green:02x}{blue:02x}")
    }
}
