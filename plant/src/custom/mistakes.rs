//! What people write in formulas that is none, told in their words.

use super::operators::{FUNCTIONS, is_taken};
use crate::units::number_length;

/// What other programs call our functions.
const ELSEWHERE: &[(&str, &str)] = &[
    ("log", "`ln` or `log10`"),
    ("lg", "`log10`"),
    ("loge", "`ln`"),
    ("arcsin", "`asin`"),
    ("arccos", "`acos`"),
    ("arctan", "`atan`"),
    ("tg", "`tan`"),
    ("sgn", "`sign`"),
    ("heaviside", "`step`"),
    ("pow", "`a^b`"),
    ("max", "`ramp`, which is max(x, 0)"),
    ("mod", "`fract`, which is x mod 1"),
];

/// The first mistake that the parser's own message would hide: a word that is no function, a product
/// without its sign, a second argument.
pub(super) fn first(text: &str) -> Option<String> {
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let number = number_length(&text[at..]);
        let word = text[at..].find(|c: char| !c.is_alphanumeric() && c != '_');
        let word = word.unwrap_or(text.len() - at);
        let behind = |length: usize| text[at + length..].trim_start();
        if c.is_alphabetic() && 0 < word {
            let name = &text[at..at + word];
            if behind(word).starts_with('(') && !is_taken(name) {
                return Some(no_function(name));
            }
            at += word;
        } else if c.is_ascii_digit() && 0 < number {
            let next = behind(number).chars().next();
            if next.is_some_and(|next| next.is_alphabetic() || next == '(') {
                return Some(format!("expected `*` behind `{}`", &text[at..at + number]));
            }
            at += number;
        } else if c == ',' {
            return Some("found `,`, while a function takes one value, and 0.5 has a point".into());
        } else {
            at += c.len_utf8();
        }
    }
    None
}

fn no_function(name: &str) -> String {
    let elsewhere = ELSEWHERE.iter().find(|(word, _)| *word == name.to_lowercase());
    if let Some((_, ours)) = elsewhere {
        return format!("`{name}` is no function, expected {ours}");
    }
    let all: Vec<&str> = FUNCTIONS.iter().map(|(name, _)| *name).collect();
    format!("`{name}` is no function, expected one of {}", all.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_are_told_in_the_words_of_who_made_them() {
        for (formula, expected) in [
            ("2*log(time_s)", "`log` is no function, expected `ln` or `log10`"),
            ("arctan (x)", "`arctan` is no function, expected `atan`"),
            ("sin(2π*time_s)", "expected `*` behind `2`"),
            ("1e-3(x)", "expected `*` behind `1e-3`"),
            ("0,5*x", "found `,`, while a function takes one value, and 0.5 has a point"),
        ] {
            assert_eq!(first(formula).as_deref(), Some(expected), "{formula}");
        }
        let list = first("a*foo(x)").expect("no function");
        assert!(list.starts_with("`foo` is no function, expected one of abs, sign"), "{list}");
        for sound in ["a*sin(2*pi*time_s/p)", "x2*(y + 1)", "1e-3*ln(x)", "a_1*π", "-(x)"] {
            assert_eq!(first(sound), None, "{sound}");
        }
    }
}
