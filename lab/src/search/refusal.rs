//! Why an effect is not taken into a model: the clause it failed, and by how much.

use std::fmt;

use crate::model::Judged;

/// The first clause of the acceptance that an effect fails.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Refusal {
    /// Noise does as much with this chance, all places and effects that were tried counted.
    Chance { p_value: f64 },
    /// Smaller than the share of the noise that changes a figure; in µm (arcsec).
    Small { size_um: f64, least_um: f64 },
    /// The swing of the closed loop may show as much; in µm.
    Hunting { size_um: f64, least_um: f64 },
    /// Others in the model undo nearly all of it: its size and what is left of that, µm (arcsec).
    Undone { size_um: f64, own_um: f64 },
    /// Held-out data are followed no better with it; root mean squares with and without, µm (arcsec).
    Unseen { with_um: f64, without_um: f64 },
    /// A value farther than two standard errors outside its plausible range.
    Range { parameter: String, value: f64, stderr: f64 },
    /// A parameter whose square would have to be negative.
    NegativeSquare { parameter: String },
    /// A nonlinear value at the end of its range: the fit would go on to another shape.
    End { parameter: String, value: f64 },
    /// A bump of which only one flank lies inside the travel.
    Flank,
    /// A wave of whole turns of the spindle, of which the record has not one.
    Turn,
    /// So small a piece of a wave that a parabola follows it.
    Piece,
    /// A moment so near the start or end of a pass that a machine which runs in does as much.
    Edge,
    /// A frequency in time, without a clock or enough waves by one.
    Clock,
    /// A time, at targets that nobody measured the time of.
    Untimed,
    /// A wave shorter than what targets resolve.
    Targets,
    /// Own errors of targets, another each way, do as much by how they scatter, with this chance.
    Scatter { p_value: f64 },
    /// A curve that is at one target what it is nowhere else: it has no shape there.
    OneTarget,
    /// A play wider than every move of the motor.
    Play,
    /// It is in the model already, and a sum of such shapes imitates anything.
    Again,
    /// In the model it is superfluous at once.
    AtOnce,
    /// A line over the angle of the spindle explains as much as one in time.
    Angle { order: f64, ahead: f64 },
    /// One sample alone speaks for it, and the tails of the noise reach as far.
    OneSample { chance: f64 },
    /// Another effect explains more; by so much evidence.
    Victor { name: String, by: f64 },
}

impl Refusal {
    /// Refused because another one was taken.
    pub(crate) fn victor(victor: &Judged, judged: &Judged) -> Self {
        let name = victor.component.term.name.clone();
        Self::Victor { name, by: victor.evidence - judged.evidence }
    }

    /// True when something is there, for all that this says, under another name.
    pub(crate) fn is_of_the_name(&self) -> bool {
        matches!(
            self,
            Self::Undone { .. }
                | Self::Unseen { .. }
                | Self::Range { .. }
                | Self::NegativeSquare { .. }
                | Self::End { .. }
                | Self::Flank
                | Self::Turn
                | Self::Piece
                | Self::Edge
                | Self::Untimed
                | Self::OneTarget
                | Self::Play
                | Self::Again
        )
    }

    /// The chance in noise that it was refused for.
    pub(crate) fn chance(&self) -> Option<f64> {
        match self {
            Self::Chance { p_value } => Some(*p_value),
            Self::OneSample { chance } => Some(*chance),
            _ => None,
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Chance { p_value } => write!(f, "not beyond chance: p = {}", rounded(*p_value)),
            Self::Small { size_um, least_um } => {
                write!(f, "too small to change a figure: {size_um:.4}, at least {least_um:.4}")
            }
            Self::Hunting { size_um, least_um } => {
                write!(f, "within the swing of the loop: {size_um:.4}, at least {least_um:.4}")
            }
            Self::Undone { size_um, own_um } => {
                write!(
                    f,
                    "undone by the effects beside it: {own_um:.4} of {size_um:.4} are its own"
                )
            }
            Self::Unseen { with_um, without_um } => write!(
                f,
                "no better on held-out data: {with_um:.4} with it, {without_um:.4} without"
            ),
            Self::Range { parameter, value, stderr } => {
                write!(f, "outside its plausible range: {parameter} {value:.4} ± {stderr:.4}")
            }
            Self::NegativeSquare { parameter } => {
                write!(f, "the square of {parameter} would have to be negative")
            }
            Self::End { parameter, value } => {
                write!(f, "at the end of its range: {parameter} {value:.4}")
            }
            Self::Flank => f.write_str("only one flank of the bump lies inside the travel"),
            Self::Turn => f.write_str("whole waves a turn need nine tenths of a turn"),
            Self::Piece => f.write_str("so small a piece of a wave that any drift follows it"),
            Self::Edge => {
                f.write_str("so near the start or the end that a machine runs in or out there")
            }
            Self::Clock => f.write_str(
                "a frequency in time needs a clock and three waves that it went through",
            ),
            Self::Untimed => f.write_str("how long the axis stood is in no log"),
            Self::Targets => f.write_str("not told by the targets from a longer wave"),
            Self::Scatter { p_value } => write!(f, "within the targets' scatter: p = {p_value:.3}"),
            Self::OneTarget => f.write_str("it shows at one target alone, where it has no shape"),
            Self::Play => f.write_str("a play wider than every move of the motor"),
            Self::Again => f.write_str("it is in the model already"),
            Self::AtOnce => f.write_str("superfluous as soon as it is in the model"),
            Self::Angle { order, ahead } => {
                write!(
                    f,
                    "order {order:.4} of the spindle explains as much: evidence {ahead:.1} ahead only"
                )
            }
            Self::OneSample { chance } => {
                write!(f, "one sample alone speaks for it: p = {chance:.3} with the noise's tails")
            }
            // As it would be printed.
            Self::Victor { name, by } if *by < 0.05 => write!(f, "explains as much as {name}"),
            Self::Victor { name, by } => {
                write!(f, "explains less than {name}: evidence {by:.1} behind")
            }
        }
    }
}

/// A chance as people read it: without a power of ten where it is none of one in thousands.
fn rounded(chance: f64) -> String {
    if chance < 0.001 { format!("{chance:.2e}") } else { format!("{chance:.3}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chance_that_is_no_rare_one_has_no_power_of_ten() {
        for (p_value, said) in [(1.0, "1.000"), (0.0123, "0.012"), (0.000_123, "1.23e-4")] {
            let expected = format!("not beyond chance: p = {said}");
            assert_eq!(Refusal::Chance { p_value }.to_string(), expected);
        }
    }
}
