//! Numbers in the words of a report.

/// Chances below this come from rounding, and say no more than that it is very small.
const SMALLEST: f64 = 1e-99;

/// A chance, as people read it.
pub(crate) fn chance(p_value: f64) -> String {
    if p_value < SMALLEST {
        "< 1e-99".to_owned()
    } else if p_value < 0.001 {
        format!("{p_value:.1e}")
    } else {
        format!("{p_value:.3}")
    }
}

/// A chance with its letter: `p = 0.022`, `p < 1e-99`.
pub(crate) fn with_p(p_value: f64) -> String {
    let chance = chance(p_value);
    if chance.starts_with('<') { format!("p {chance}") } else { format!("p = {chance}") }
}
