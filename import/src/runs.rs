//! Words for a run and its direction, as in `Run 2 rückwärts` or `第3次正向`.

use std::collections::BTreeMap;

/// Words for the way there.
const FORWARD: [&str; 16] = [
    "forward",
    "forwards",
    "fwd",
    "vorwärts",
    "vorwaerts",
    "vor",
    "hin",
    "hinweg",
    "positive",
    "positiv",
    "正向",
    "去程",
    "正",
    "up",
    "pos dir",
    "↑",
];
/// Words for the way back.
const REVERSE: [&str; 20] = [
    "reverse",
    "backward",
    "backwards",
    "bwd",
    "rev",
    "rückwärts",
    "rueckwaerts",
    "rück",
    "zurück",
    "rückweg",
    "her",
    "negative",
    "negativ",
    "反向",
    "负向",
    "返程",
    "回程",
    "反",
    "down",
    "↓",
];
/// Words for a run.
const RUN: [&str; 16] = [
    "run",
    "lauf",
    "messung",
    "messlauf",
    "messreihe",
    "durchgang",
    "durchlauf",
    "cycle",
    "zyklus",
    "pass",
    "trial",
    "series",
    "repeat",
    "次",
    "循环",
    "趟",
];

/// A run and a direction, as far as words tell them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Run {
    pub(crate) number: Option<i64>,
    pub(crate) direction: Option<i64>,
}

/// The run a text names; `None` when it tells neither run nor direction.
pub(crate) fn run_of(text: &str) -> Option<Run> {
    let lower = text.to_lowercase();
    let tokens = tokens(&lower);
    let any = |words: &[&str]| {
        tokens.iter().any(|token| words.contains(&token.as_str()))
            || words
                .iter()
                .any(|word| !word.is_ascii() && 1 < word.chars().count() && lower.contains(word))
    };
    let direction =
        match (any(&FORWARD) || signed(&lower, '+'), any(&REVERSE) || signed(&lower, '-')) {
            (true, false) => Some(1),
            (false, true) => Some(-1),
            _ => None,
        };
    let named = any(&RUN) || lower.contains('次');
    let number = named.then(|| tokens.iter().rev().find_map(|token| run_number(token))).flatten();
    let short = tokens.len() <= 8;
    (short && (number.is_some() || direction.is_some())).then_some(Run { number, direction })
}

/// The direction a cell names: +1, −1, a word, or a sign.
pub(crate) fn direction_of(cell: &str) -> Option<f64> {
    let cell = cell.trim().to_lowercase();
    match cell.as_str() {
        "+" | "1" | "+1" | "1.0" | "1,0" | "f" | "v" => return Some(1.0),
        "-" | "-1" | "-1.0" | "-1,0" | "\u{2212}1" | "\u{2212}" | "r" | "b" => return Some(-1.0),
        _ => {}
    }
    match run_of(&cell)?.direction? {
        1 => Some(1.0),
        _ => Some(-1.0),
    }
}

/// A sign that stands alone or behind a number, as in `Run 1 +` or `x1-`.
fn signed(text: &str, sign: char) -> bool {
    let trimmed = text.trim().trim_end_matches([')', ']']).trim_end();
    trimmed.ends_with(sign)
}

/// Runs of letters, and of digits.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut kind = 0;
    for c in text.chars() {
        let next = if c.is_ascii_digit() {
            1
        } else if c.is_alphabetic() {
            2
        } else if "↑↓".contains(c) {
            3
        } else {
            0
        };
        if next != 0 && next == kind {
            tokens.last_mut().expect("a token has begun").push(c);
        } else if next != 0 {
            tokens.push(c.into());
        }
        kind = next;
    }
    tokens
}

fn run_number(token: &str) -> Option<i64> {
    let chinese = ["一", "二", "三", "四", "五", "六", "七", "八", "九", "十"];
    let spelled = || {
        let at = chinese
            .iter()
            .position(|digit| token == format!("第{digit}次") || token == format!("第{digit}"))?;
        i64::try_from(at + 1).ok()
    };
    token.parse().ok().filter(|number| (0..100_000).contains(number)).or_else(spelled)
}

/// True for a count: whole numbers that rise by one step, or by several where rows were lost, and may
/// begin anew where the first one did.
pub(crate) fn counts(values: &[f64]) -> bool {
    let values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    let mut steps: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    let Some(usual) = steps.get(steps.len() / 2).filter(|step| 0.0 < **step) else { return false };
    let whole = |value: f64| value.fract().abs() <= 0.0;
    values.iter().all(|value| whole(*value))
        && values.windows(2).all(|pair| {
            let anew = pair[1] < pair[0] && (pair[1] - values[0]).abs() <= 0.0;
            anew || pair[0] < pair[1] && whole((pair[1] - pair[0]) / usual)
        })
}

/// True where more than half of the runs have a single row: such numbers count rows.
pub(crate) fn counts_rows(numbers: &[f64]) -> bool {
    let mut rows = BTreeMap::<u64, usize>::new();
    for number in numbers.iter().filter(|number| number.is_finite()) {
        *rows.entry(number.to_bits()).or_default() += 1;
    }
    let lone = rows.values().filter(|rows| **rows == 1).count();
    1 < rows.len() && rows.len() < 2 * lone
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A temperature in whole degrees rests and falls; one that was measured has fractions.
    #[test]
    fn a_count_rises_steadily() {
        let counted: [&[f64]; 4] = [
            &[0.0, 1.0, 2.0, 3.0],
            &[5.0, 15.0, 35.0, 45.0, 55.0],
            &[1.0, 2.0, 3.0, 1.0, 2.0, 3.0],
            &[7.0, f64::NAN, 9.0, 10.0, 11.0],
        ];
        let measured: [&[f64]; 6] = [
            &[21.0, 21.0, 22.0, 22.0, 23.0],
            &[21.0, 22.0, 23.0, 22.0, 23.0],
            &[0.5, 1.5, 2.5, 3.5],
            &[100.0, 105.0, 111.0, 115.0],
            &[105.0, 105.0, 105.0],
            &[3.0, 2.0, 1.0],
        ];
        assert!(counted.into_iter().all(counts));
        assert!(!measured.into_iter().any(counts));
    }

    #[test]
    fn runs_are_told_in_three_languages() {
        for (text, number, direction) in [
            ("Run 1", Some(1), None),
            ("Run 2 rev", Some(2), Some(-1)),
            ("Lauf 3 vorwärts", Some(3), Some(1)),
            ("第4次反向", Some(4), Some(-1)),
            ("第2次 正向 (μm)", Some(2), Some(1)),
            ("Run 5 +", Some(5), Some(1)),
            ("Data backward direction", None, Some(-1)),
            ("Messreihe 2", Some(2), None),
        ] {
            assert_eq!(run_of(text), Some(Run { number, direction }), "{text}");
        }
        for text in ["Position [mm]", "error", "12", "Temperature 1", ""] {
            assert_eq!(run_of(text), None, "{text}");
        }
    }
}
