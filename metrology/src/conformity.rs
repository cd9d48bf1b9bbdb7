//! Whether a measured value proves that a limit is kept.

/// What a value with its uncertainty says of an upper limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conformity {
    /// Kept, even with the uncertainty against it.
    Proven,
    /// Exceeded, even with the uncertainty in its favour.
    Disproven,
    /// Neither: the value lies within the uncertainty of the limit.
    Open,
}

/// Decides by ISO 14253-1: the tolerance is smaller by the expanded uncertainty for whoever has to prove
/// conformity, and larger by it for whoever has to disprove it. The true value is at most so far
/// below and so far above the one measured.
///
/// # Examples
///
/// ```
/// use helixlock_metrology::{Conformity, conformity};
///
/// assert_eq!(conformity(7.9, 10.0, [2.0, 2.0]), Conformity::Proven);
/// assert_eq!(conformity(9.0, 10.0, [0.5, 2.0]), Conformity::Open);
/// assert_eq!(conformity(12.1, 10.0, [2.0, 3.0]), Conformity::Disproven);
/// ```
#[must_use]
pub fn conformity(value_um: f64, limit_um: f64, [below_um, above_um]: [f64; 2]) -> Conformity {
    if value_um + above_um <= limit_um {
        Conformity::Proven
    } else if limit_um < value_um - below_um {
        Conformity::Disproven
    } else {
        Conformity::Open
    }
}

impl Conformity {
    /// In one word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Proven => "proven",
            Self::Disproven => "disproven",
            Self::Open => "open",
        }
    }
}
