//! Powers in brackets: the parser takes a sign before the power that follows, and powers from the
//! left; `-x^2` is −(x²) and `2^3^2` is 2^(3²) everywhere else.

use crate::units::number_length;

/// A formula that means the same whatever comes first, signs or powers.
pub(super) fn in_brackets(formula: &str) -> String {
    let mut text = String::with_capacity(2 * formula.len());
    let mut rest = formula;
    while let Some(c) = rest.chars().next() {
        if let Some((power, behind)) = power(rest) {
            text.push_str(&power);
            rest = behind;
        } else {
            text.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    text
}

/// What a text begins with, a base with its powers, and what is behind; `None` where no base begins.
fn power(text: &str) -> Option<(String, &str)> {
    let (base, behind) = base(text)?;
    let Some(exponent) = behind.trim_start().strip_prefix('^') else { return Some((base, behind)) };
    let exponent = exponent.trim_start();
    let unsigned = exponent.trim_start_matches(['-', '+']);
    let sign = &exponent[..exponent.len() - unsigned.len()];
    let Some((exponent, behind)) = power(unsigned) else { return Some((base, behind)) };
    Some((format!("({base}^({sign}{exponent}))"), behind))
}

/// A number, a name, a call or a bracket, and what is behind.
fn base(text: &str) -> Option<(String, &str)> {
    let number = if text.starts_with(['-', '+']) { 0 } else { number_length(text) };
    if 0 < number {
        return Some((text[..number].to_owned(), &text[number..]));
    }
    let word = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    let (name, behind) = text.split_at(word);
    match bracket(behind.trim_start()) {
        Some((inside, behind)) => Some((format!("{name}({})", in_brackets(inside)), behind)),
        None if name.is_empty() => None,
        None => Some((name.to_owned(), behind)),
    }
}

/// What is inside the bracket that a text begins with, and what is behind it.
fn bracket(text: &str) -> Option<(&str, &str)> {
    let mut depth = 0_usize;
    let inside = text.strip_prefix('(')?;
    for (at, c) in inside.char_indices() {
        match c {
            '(' => depth += 1,
            ')' if depth == 0 => return Some((&inside[..at], &inside[at + 1..])),
            ')' => depth -= 1,
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use exmex::Express;
    use proptest::prelude::*;

    use super::super::Expression;
    use super::*;

    /// A formula with its value, worked out apart from any parser.
    #[derive(Debug, Clone)]
    struct Known {
        text: String,
        value: f64,
        /// Largest value on the way: what is far larger loses digits.
        largest: f64,
        /// How strongly its last operator binds: sum, product, sign, power, bracket.
        binds: u8,
    }

    fn known(text: String, value: f64, binds: u8) -> Known {
        Known { text, value, largest: value.abs(), binds }
    }

    /// The same, made of others.
    fn made_of(parts: &[&Known], one: Known) -> Known {
        let largest = parts.iter().map(|part| part.largest).fold(one.largest, f64::max);
        Known { largest, ..one }
    }

    /// The formula as an operand of what binds so strongly.
    fn within(one: &Known, least: u8) -> String {
        if one.binds < least { format!("({})", one.text) } else { one.text.clone() }
    }

    fn join(a: &Known, b: &Known, operator: u8) -> Known {
        let both = |sign: &str, left: u8, right: u8| {
            format!("{}{sign}{}", within(a, left), within(b, right))
        };
        let one = match operator {
            0 => known(both("+", 0, 1), a.value + b.value, 0),
            1 => known(both(" - ", 0, 1), a.value - b.value, 0),
            2 => known(both("*", 1, 2), a.value * b.value, 1),
            3 => known(both("/", 1, 2), a.value / b.value, 1),
            _ => known(format!("{}^2", within(a, 4)), a.value * a.value, 3),
        };
        made_of(&[a, b], one)
    }

    fn formulas() -> impl Strategy<Value = Known> {
        let leaf = prop_oneof![
            (1_u8..30).prop_map(|n| known(n.to_string(), f64::from(n), 4)),
            (1_u8..30).prop_map(|n| known(format!("{n}.5"), f64::from(n) + 0.5, 4)),
            Just(known("pi".to_owned(), std::f64::consts::PI, 4)),
            Just(known("x".to_owned(), 1.7, 4)),
            Just(known("y".to_owned(), -0.6, 4)),
        ];
        leaf.prop_recursive(6, 48, 2, |inner| {
            prop_oneof![
                4 => (inner.clone(), inner.clone(), 0_u8..5).prop_map(|(a, b, by)| join(&a, &b, by)),
                1 => inner.clone().prop_map(|a| {
                    made_of(&[&a], known(format!("-{}", within(&a, 3)), -a.value, 2))
                }),
                1 => inner.prop_map(|a| {
                    made_of(&[&a], known(format!("sin({})", a.text), libm::sin(a.value), 4))
                }),
            ]
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn a_formula_is_worth_what_it_says(one in formulas()) {
            let expression: Expression = Expression::parse(&in_brackets(&one.text)).unwrap();
            let values: Vec<f64> = expression
                .var_names()
                .iter()
                .map(|name| if name == "x" { 1.7 } else { -0.6 })
                .collect();
            let value = expression.eval(&values).unwrap();
            let is_exact = one.value.is_finite() && one.largest < 1e6;
            prop_assert!(
                !is_exact || (value - one.value).abs() < 1e-6,
                "{} is {}, not {value}", one.text, one.value
            );
        }
    }

    #[test]
    fn signs_and_powers_are_as_in_school() {
        for (formula, expected) in
            [("-2^2", -4.0), ("2^3^2", 512.0), ("2^-1", 0.5), ("8/-(2)^2", -2.0)]
        {
            let expression: Expression = Expression::parse(&in_brackets(formula)).unwrap();
            let value = expression.eval(&[]).unwrap();
            assert!((value - expected).abs() < 1e-12, "{formula} is {value}");
        }
    }
}
