//! What a formula may contain, with the same results on every platform.

use exmex::{BinOp, MakeOperators, MatchLiteral, Operator};

use crate::units::number_length;

/// Operators, functions and constants of formulas.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Operators;

impl MakeOperators<f64> for Operators {
    fn make<'a>() -> Vec<Operator<'a, f64>> {
        // Of operators that it may turn round, the library draws numbers out of brackets.
        let binary = |apply, prio| BinOp { apply, prio, is_commutative: false };
        let mut operators = vec![
            Operator::make_bin("^", binary(libm::pow, 4)),
            Operator::make_bin("*", binary(|a, b| a * b, 2)),
            Operator::make_bin("/", binary(|a, b| a / b, 3)),
            Operator::make_bin_unary("+", binary(|a, b| a + b, 0), |a| a),
            Operator::make_bin_unary("-", binary(|a, b| a - b, 1), |a| -a),
            Operator::make_constant("pi", std::f64::consts::PI),
            Operator::make_constant("π", std::f64::consts::PI),
        ];
        operators.extend(FUNCTIONS.iter().map(|(name, apply)| Operator::make_unary(name, *apply)));
        operators
    }
}

/// Numbers as everywhere in a machine file: `1e-3` is one.
#[derive(Clone, Debug)]
pub(super) struct Numbers;

impl MatchLiteral for Numbers {
    fn is_literal(text: &str) -> Option<&str> {
        // A sign is an operator.
        let number = &text[..number_length(text)];
        (!text.starts_with(['+', '-']) && number.parse::<f64>().is_ok()).then_some(number)
    }
}

pub(super) type Function = fn(f64) -> f64;

/// True for a word that is a function or a constant, and so no name of a parameter.
pub(super) fn is_taken(word: &str) -> bool {
    FUNCTIONS.iter().any(|(name, _)| *name == word) || matches!(word, "pi" | "π" | "lag" | "relay")
}

/// Functions of one argument.
pub(super) const FUNCTIONS: &[(&str, Function)] = &[
    ("abs", f64::abs),
    ("sign", |a| if a == 0.0 { 0.0 } else { f64::signum(a) }),
    ("sqrt", f64::sqrt),
    ("exp", libm::exp),
    ("ln", libm::log),
    ("log10", libm::log10),
    ("sin", libm::sin),
    ("cos", libm::cos),
    ("tan", libm::tan),
    ("asin", libm::asin),
    ("acos", libm::acos),
    ("atan", libm::atan),
    ("sinh", libm::sinh),
    ("cosh", libm::cosh),
    ("tanh", libm::tanh),
    ("floor", f64::floor),
    ("ceil", f64::ceil),
    ("round", libm::round),
    ("step", |a| if 0.0 < a { 1.0 } else { 0.0 }),
    ("ramp", |a| if a < 0.0 { 0.0 } else { a }),
    ("fract", |a| a - a.floor()),
];
