//! Numbers in the words of a report, and a verdict as an exit status.

use std::borrow::Borrow;
use std::process::ExitCode;

use helixlock_lab::{Comparison, Doubt, FittedParameter, Structure, Verdict};

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

/// What is left, in words.
pub(crate) fn left_over(comparison: &Comparison) -> &'static str {
    match (comparison.noise_only, comparison.is_beyond_chance()) {
        (true, _) => "no shape stands out of the noise",
        (false, true) => "more than noise",
        (false, false) => "a curve that cannot be told from noise",
    }
}

/// Why structure is told of: its chance in noise, or that there is none.
pub(crate) fn why_left(left: &Structure) -> String {
    if left.is_beyond_chance() {
        with_p(left.p_value)
    } else {
        "not to be told from noise".to_owned()
    }
}

/// How slow what is left is: noise of few independent samples a pass may have slow causes in it.
pub(crate) fn worth_of_a_pass(samples: f64) -> String {
    format!("a pass of that is worth {samples:.1} independent samples")
}

/// What a round did to the model: the effect it added, and those it took out again.
pub(crate) fn change<S: Borrow<str>>(added: Option<&str>, dropped: &[S]) -> String {
    let dropped = dropped.join(", ");
    match (added, dropped.is_empty()) {
        (Some(added), true) => added.to_owned(),
        (Some(added), false) => format!("{added} in the place of {dropped}"),
        (None, true) => "the model as it is".to_owned(),
        (None, false) => format!("taken out again: {dropped}"),
    }
}

/// What is said of a limit.
pub(crate) fn held(holds: bool) -> &'static str {
    if holds { "holds" } else { "is exceeded" }
}

/// A value and its standard error, both to the error's second digit: `239.8 ± 2.2`.
pub(crate) fn with_error(value: f64, stderr: f64) -> String {
    const MOST_DECIMALS: usize = 6;
    if 0.0 < stderr && stderr < 1e-5 {
        return format!("{value:.4e} ± {stderr:.1e}");
    }
    let mut decimals = 0;
    let mut shown = stderr;
    while shown < 9.95 && decimals < MOST_DECIMALS {
        shown *= 10.0;
        decimals += 1;
    }
    format!("{value:.decimals$} ± {stderr:.decimals$}")
}

/// A doubt as a sentence of a page.
pub(crate) fn doubted(doubt: &Doubt) -> String {
    let mend = doubt.mend.replace('\n', "; ");
    format!("Doubtful input: {}. To mend it: {mend}", doubt.says)
}

/// Exit status of a diagnosis: 1 when the input itself is doubted.
pub(crate) fn status(verdict: Verdict) -> ExitCode {
    if verdict == Verdict::DoubtfulInput { ExitCode::from(1) } else { ExitCode::SUCCESS }
}

/// What the machine file says of a value that is another one.
pub(crate) fn file_says(parameter: &FittedParameter) -> Option<String> {
    let before =
        parameter.file_says.filter(|before| before.to_bits() != parameter.value.to_bits())?;
    Some(format!("the file says {before:.4}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_shown_with_two_digits() {
        assert_eq!(with_error(239.8231, 2.2034), "239.8 ± 2.2");
        assert_eq!(with_error(4.788_12, 0.000_117), "4.78812 ± 0.00012");
        assert_eq!(with_error(1234.5, 67.8), "1234 ± 68");
        assert_eq!(with_error(1.234_56e-6, 7.8e-9), "1.2346e-6 ± 7.8e-9");
        assert_eq!(with_error(2.5, 0.0), "2.500000 ± 0.000000");
    }

    #[test]
    fn a_chance_is_never_nought() {
        assert_eq!([chance(0.0), chance(4e-7), chance(1.0)], ["< 1e-99", "4.0e-7", "1.000"]);
        assert_eq!([with_p(0.0), with_p(0.25)], ["p < 1e-99", "p = 0.250"]);
    }
}
