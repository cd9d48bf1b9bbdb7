//! A formula as a tree: evaluated column by column, written as text, and checked for its units.

use std::borrow::Cow;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, RangeInclusive, Sub};
use std::sync::Arc;

use helixlock_plant::Column;

use super::dimension::Dimension;

/// What a sample knows: a coordinate or a logged column, by the name it has in formulas.
#[derive(Debug, PartialEq)]
pub(crate) struct Quantity {
    /// Its name.
    pub(crate) name: String,
    /// Its unit.
    pub(crate) dimension: Dimension,
    /// One value a sample.
    pub(crate) values: Column,
}

/// A number that is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Unknown {
    /// Its name in the formula.
    pub(crate) name: &'static str,
    /// Its unit.
    pub(crate) dimension: Dimension,
    /// Values worth trying, in order; a single one is where a refinement begins.
    pub(crate) axis: Vec<f64>,
}

impl Unknown {
    /// Where a place or a moment may lie: among those that are tried, for beyond them a kink is a straight line.
    pub(crate) fn places(&self) -> Option<RangeInclusive<f64>> {
        let (first, last) = (self.axis.first()?, self.axis.last()?);
        self.name.starts_with("at_").then_some(*first..=*last)
    }
}

/// Between two parts of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Operation {
    Plus,
    Minus,
    Times,
    Over,
}

/// Of one part of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Function {
    Sin,
    Cos,
    Exp,
    Sqrt,
    Abs,
    Atan,
    /// 1 above 0, else 0.
    Step,
    /// The value above 0, else 0.
    Ramp,
    /// What is beyond the next whole number below.
    Fract,
}

/// A formula of quantities and unknowns; unknowns by their place in a list.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Expression {
    /// A number with its unit.
    Number(f64, Dimension),
    /// π.
    Pi,
    Of(Arc<Quantity>),
    Unknown(usize),
    Two(Operation, Box<Self>, Box<Self>),
    Power(Box<Self>, i32),
    Call(Function, Box<Self>),
    /// A quantity as something of first order follows it, from rest.
    Lag {
        of: Arc<Quantity>,
        time: Arc<Quantity>,
        constant: usize,
    },
    /// 1 from where a quantity rises above the middle by half the width to where it falls below
    /// by as much.
    Relay {
        of: Arc<Quantity>,
        middle: usize,
        width: usize,
    },
}

impl Function {
    fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Exp => "exp",
            Self::Sqrt => "sqrt",
            Self::Abs => "abs",
            Self::Atan => "atan",
            Self::Step => "step",
            Self::Ramp => "ramp",
            Self::Fract => "fract",
        }
    }

    fn apply(self, value: f64) -> f64 {
        match self {
            Self::Sin => libm::sin(value),
            Self::Cos => libm::cos(value),
            Self::Exp => libm::exp(value),
            Self::Sqrt => value.sqrt(),
            Self::Abs => value.abs(),
            Self::Atan => libm::atan(value),
            Self::Step => f64::from(u8::from(0.0 < value)),
            Self::Ramp => value.max(0.0),
            Self::Fract => value - value.floor(),
        }
    }
}

impl Operation {
    fn sign(self) -> &'static str {
        match self {
            Self::Plus => " + ",
            Self::Minus => " - ",
            Self::Times => "*",
            Self::Over => "/",
        }
    }

    fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Plus => a + b,
            Self::Minus => a - b,
            Self::Times => a * b,
            Self::Over => a / b,
        }
    }

    fn is_a_sum(self) -> bool {
        matches!(self, Self::Plus | Self::Minus)
    }
}

/// A pure number.
pub(crate) fn number(value: f64) -> Expression {
    Expression::Number(value, Dimension::number())
}

/// A function of a part.
pub(crate) fn call(function: Function, of: Expression) -> Expression {
    Expression::Call(function, Box::new(of))
}

/// The angle of so many turns, rad.
pub(crate) fn turns(of: Expression) -> Expression {
    number(2.0) * Expression::Pi * of
}

impl Expression {
    /// One value a sample, or a single one when all are alike.
    pub(crate) fn values(&self, at: &[f64]) -> Cow<'_, [f64]> {
        match self {
            Self::Number(value, _) => Cow::Owned(vec![*value]),
            Self::Pi => Cow::Owned(vec![PI]),
            Self::Of(quantity) => Cow::Borrowed(&quantity.values),
            Self::Unknown(place) => Cow::Owned(vec![at[*place]]),
            Self::Two(operation, a, b) => {
                Cow::Owned(combined(*operation, &a.values(at), &b.values(at)))
            }
            Self::Power(base, power) => each(base.values(at), |value| value.powi(*power)),
            Self::Call(function, of) => each(of.values(at), |value| function.apply(value)),
            Self::Lag { of, time, constant } => Cow::Owned(followed(of, time, at[*constant])),
            Self::Relay { of, middle, width } => Cow::Owned(switched(of, at[*middle], at[*width])),
        }
    }

    /// The same with all that depends on no unknown worked out: a quantity that is called by its formula.
    pub(crate) fn worked_out(&self) -> Self {
        let known = if self.has_unknowns() { None } else { self.dimension(&[]) };
        if let Some(dimension) = known {
            let (name, values) = (format!("({})", self.text(&[])), self.values(&[]).into_owned());
            return Self::Of(Arc::new(Quantity { name, dimension, values: values.into() }));
        }
        let part = |of: &Self| Box::new(of.worked_out());
        match self {
            Self::Two(operation, a, b) => Self::Two(*operation, part(a), part(b)),
            Self::Power(base, power) => Self::Power(part(base), *power),
            Self::Call(function, of) => Self::Call(*function, part(of)),
            _ => self.clone(),
        }
    }

    fn has_unknowns(&self) -> bool {
        match self {
            Self::Number(..) | Self::Pi | Self::Of(_) => false,
            Self::Unknown(_) | Self::Lag { .. } | Self::Relay { .. } => true,
            Self::Two(_, a, b) => a.has_unknowns() || b.has_unknowns(),
            Self::Power(of, _) | Self::Call(_, of) => of.has_unknowns(),
        }
    }

    /// As a `custom` effect reads it, with the unknowns' names.
    pub(crate) fn text(&self, names: &[&str]) -> String {
        match self {
            Self::Number(value, _) => format!("{value}"),
            Self::Pi => "pi".to_owned(),
            Self::Of(quantity) => quantity.name.clone(),
            Self::Unknown(place) => names[*place].to_owned(),
            Self::Two(operation, a, b) => {
                let (left, right) = (a.text(names), b.text(names));
                let left =
                    if a.is_a_sum() && !operation.is_a_sum() { format!("({left})") } else { left };
                let binds = match operation {
                    Operation::Plus => false,
                    Operation::Minus | Operation::Times => b.is_a_sum(),
                    Operation::Over => matches!(**b, Self::Two(..)),
                };
                let right = if binds { format!("({right})") } else { right };
                format!("{left}{}{right}", operation.sign())
            }
            Self::Power(base, power) => match **base {
                Self::Of(_) | Self::Unknown(_) | Self::Call(..) => {
                    format!("{}^{power}", base.text(names))
                }
                _ => format!("({})^{power}", base.text(names)),
            },
            Self::Call(function, of) => format!("{}({})", function.name(), of.text(names)),
            Self::Lag { of, constant, .. } => format!("lag({}, {})", of.name, names[*constant]),
            Self::Relay { of, middle, width } => {
                format!("relay({}, {}, {})", of.name, names[*middle], names[*width])
            }
        }
    }

    /// Its unit; `None` when it adds what is unlike, or takes a function of what has a unit.
    pub(crate) fn dimension(&self, unknowns: &[Unknown]) -> Option<Dimension> {
        let of_unknown = |place: usize| &unknowns[place].dimension;
        match self {
            Self::Number(_, dimension) => Some(dimension.clone()),
            Self::Pi => Some(Dimension::number()),
            Self::Of(quantity) => Some(quantity.dimension.clone()),
            Self::Unknown(place) => Some(of_unknown(*place).clone()),
            Self::Two(operation, a, b) => {
                let (a, b) = (a.dimension(unknowns)?, b.dimension(unknowns)?);
                match operation {
                    Operation::Plus | Operation::Minus => (a == b).then_some(a),
                    Operation::Times => Some(a.times(&b)),
                    Operation::Over => Some(a.over(&b)),
                }
            }
            Self::Power(base, power) => Some(base.dimension(unknowns)?.to_the(*power)),
            // Where something is above 0, and by how much, is told in any unit.
            Self::Call(Function::Ramp | Function::Abs, of) => of.dimension(unknowns),
            Self::Call(Function::Step, of) => of.dimension(unknowns).map(|_| Dimension::number()),
            Self::Call(Function::Sqrt, of) => of.dimension(unknowns)?.root(),
            Self::Call(_, of) => of.dimension(unknowns).filter(Dimension::is_number),
            Self::Lag { of, time, constant } => {
                (*of_unknown(*constant) == time.dimension).then(|| of.dimension.clone())
            }
            Self::Relay { of, middle, width } => {
                let alike = [middle, width].map(|place| *of_unknown(*place) == of.dimension);
                (alike == [true; 2]).then(Dimension::number)
            }
        }
    }

    /// True when it must stand in brackets as a factor.
    pub(crate) fn is_a_sum(&self) -> bool {
        matches!(self, Self::Two(operation, ..) if operation.is_a_sum())
    }
}

fn each(values: Cow<'_, [f64]>, apply: impl Fn(f64) -> f64) -> Cow<'_, [f64]> {
    let mut values = values.into_owned();
    for value in &mut values {
        *value = apply(*value);
    }
    Cow::Owned(values)
}

/// Value by value; a single one stands for all.
fn combined(operation: Operation, a: &[f64], b: &[f64]) -> Vec<f64> {
    match (a.len(), b.len()) {
        (_, 1) => a.iter().map(|x| operation.apply(*x, b[0])).collect(),
        (1, _) => b.iter().map(|y| operation.apply(a[0], *y)).collect(),
        _ => a.iter().zip(b).map(|(x, y)| operation.apply(*x, *y)).collect(),
    }
}

fn followed(of: &Quantity, time: &Quantity, constant_s: f64) -> Vec<f64> {
    helixlock_plant::lag(&of.values, &time.values, constant_s)
}

fn switched(of: &Quantity, middle: f64, width: f64) -> Vec<f64> {
    helixlock_plant::relay(&of.values, middle, width)
}

impl Add for Expression {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::Two(Operation::Plus, Box::new(self), Box::new(other))
    }
}

impl Sub for Expression {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::Two(Operation::Minus, Box::new(self), Box::new(other))
    }
}

impl Mul for Expression {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::Two(Operation::Times, Box::new(self), Box::new(other))
    }
}

impl Div for Expression {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::Two(Operation::Over, Box::new(self), Box::new(other))
    }
}
