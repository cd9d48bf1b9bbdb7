//! Words and signs for what sums runs up: means, scatter, bands, and the figures of ISO 230-2.

use crate::runs;

/// Words for what sums readings up, at the beginning of a row or within the name of a column, in letters alone.
const WORDS: [&str; 26] = [
    "mean",
    "average",
    "avg",
    "median",
    "min",
    "minimum",
    "max",
    "maximum",
    "range",
    "spread",
    "sigma",
    "std",
    "stddev",
    "stdev",
    "reversal",
    "mittelwert",
    "mittel",
    "durchschnitt",
    "spannweite",
    "streuung",
    "standardabweichung",
    "umkehrspanne",
    "平均",
    "平均值",
    "标准差",
    "极差",
];

/// More of them that a row may begin with.
const OF_ROWS: [&str; 16] = [
    "mean deviation",
    "mean value",
    "sum",
    "total",
    "std dev",
    "std. dev",
    "standard deviation",
    "standard uncertainty",
    "reversal error",
    "mittlere abweichung",
    "summe",
    "最大",
    "最大值",
    "最小",
    "最小值",
    "合计",
];

/// More of them within the name of a column.
const OF_COLUMNS: [&str; 6] =
    ["standard", "repeatability", "mittlere", "umkehrfehler", "wiederholpräzision", "反向差值"];

/// Signs of ISO 230-2 and VDI/DGQ 3441 for what a target or an axis has.
const SIGNS: [&str; 15] =
    ["s", "σ", "b", "b̄", "r", "e", "m", "a", "u", "ps", "pa", "µ", "μ", "ø", "⌀"];

/// True for what a row begins with that sums the rows above it up.
pub(crate) fn begins_with(cell: &str) -> bool {
    let plain = cell.trim_end_matches([':', '：', '.']).to_lowercase();
    if WORDS.iter().chain(&OF_ROWS).any(|word| *word == plain) {
        return true;
    }
    // One letter alone may be anything; with an arrow or a bar it is of the standard.
    let marked = plain.contains(ARROWS) || is_barred(&plain);
    marked && names(&plain)
}

/// True for what is the mean of runs by its name, and may stand for them where no run does.
pub(crate) fn is_mean(text: &str) -> bool {
    const MEANS: [&str; 8] =
        ["mean", "average", "avg", "mittel", "mittlere", "durchschnitt", "平均", "x̄"];
    let lower = text.to_lowercase();
    !is_band(&lower) && MEANS.iter().any(|word| lower.contains(word))
}

/// True for a name of a column that sums runs up: `Mean ↑`, `x̄ fwd`, `s ↓`, `X↑+2s↑`, `B`.
pub(crate) fn names(text: &str) -> bool {
    let lower = text.to_lowercase();
    if is_barred(&lower) {
        return true;
    }
    let letters = |c: char| !c.is_alphabetic();
    let words: Vec<&str> = lower.split(letters).filter(|word| !word.is_empty()).collect();
    if words.iter().any(|word| WORDS.contains(word) || OF_COLUMNS.contains(word)) {
        return true;
    }
    let mut left = words.iter().filter(|word| runs::run_of(word).is_none());
    let first = left.next();
    let alone = left.next().is_none() && first.is_some_and(|word| SIGNS.contains(word));
    let numbered = lower.chars().any(|c| c.is_ascii_digit());
    alone && !numbered || is_band(&lower)
}

const ARROWS: [char; 2] = ['↑', '↓'];

/// True for a letter with a bar above it, as a mean has it.
fn is_barred(text: &str) -> bool {
    text.contains(['\u{304}', '\u{305}', '¯', 'ā', 'ē', 'ū'])
}

/// True for multiples of s: `4s`, `2 s↑`, `x+2s`, `X̄↑ − 2s↑`.
fn is_band(text: &str) -> bool {
    let plain: Vec<char> = text.chars().filter(|c| !c.is_whitespace() && *c != '·').collect();
    let is_s = |at: usize| {
        let part = |at: usize| plain.get(at).is_some_and(|c| c.is_alphabetic());
        ['s', 'σ'].contains(&plain[at]) && !part(at + 1) && plain[at - 1].is_ascii_digit()
    };
    (1..plain.len()).any(is_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_sums_runs_up_is_known_by_its_name() {
        for text in [
            "Mean ↑",
            "x̄↑",
            "X̄ ↓",
            "s ↑",
            "Sigma ↓",
            "std dev forward",
            "Mittel ↑",
            "Average rev",
            "X↑+2s↑",
            "x↓-2s↓",
            "4s",
            "B",
            "Reversal",
            "mean deviation ↑",
            "R ↑",
            "平均 正向",
            "B̄",
            "Umkehrspanne",
        ] {
            assert!(names(text), "{text}");
        }
        for text in [
            "1↑",
            "x1 ↑",
            "Run 2 fwd",
            "↑",
            "forward",
            "x3↓",
            "error",
            "第2次正向",
            "s1 ↑",
            "Meander",
        ] {
            assert!(!names(text), "{text}");
        }
        for text in ["Mean", "Mittelwert:", "x̄↑", "s ↑"] {
            assert!(begins_with(text), "{text}");
        }
        for text in ["s", "B", "12.5", "run ↑"] {
            assert!(!begins_with(text), "{text}");
        }
    }
}
