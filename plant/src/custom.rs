//! An effect of the user: an expression over the columns, with named parameters.

mod bound;
mod memory;
mod mistakes;
mod operators;
mod powers;

use exmex::{Express, FlatEx};

use crate::nearest::nearest;
use crate::record::LOGGED_COLUMNS;
use crate::{Basis, Card, Columns, EffectError, Entry, Instant, Nature, Parameter, Role};
use bound::{Bound, Remembering, Source};
use memory::{Call, Kind, placeholder, taken_out};
pub use memory::{lag, relay};
use operators::{Numbers, Operators, is_taken};

type Expression = FlatEx<f64, Operators, Numbers>;

type Reading = fn(&Instant<'_>) -> f64;

/// The user's own formula, in the catalogue.
pub(crate) const CARD: Card = Card {
    kind: "custom",
    entry: Entry::Motion,
    summary: "an expression of the user over the columns, with named parameters",
    formula: "as written: + - * / ^, functions, pi, parameters, and columns such as time_s, position_mm, angle_rev, speed_rpm, direction, velocity_rpm, pass, since_reversal_mm (since_reversal_deg on a rotary chain), since_stop_s, or any logged one; lag(column, s) and relay(column, middle, width) remember the samples before",
    example: "formula = 'a*sin(2*pi*time_s/period)', entry = 'motion', parameters = { a = 1.5, period = 12.0 }",
    parameters: &[],
    parts: &[],
    needs: &[],
    signature: "what the formula says",
    confused_with: &[],
    separated_by: "what the user knows of it",
    source: "the user",
    random: false,
    candidate: false,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::default()),
};

/// Quantities every instant carries, by the names a formula uses.
const ALWAYS_THERE: &[(&str, Reading)] = &[
    ("time_s", |now| now.time_s),
    ("position_mm", |now| now.position_mm),
    ("angle_rev", |now| now.spindle_rad / std::f64::consts::TAU),
    ("spindle_rad", |now| now.spindle_rad),
    ("speed_rpm", |now| now.speed_rpm),
    ("direction", |now| now.direction),
    ("velocity_rpm", |now| now.velocity_rpm),
    ("travelled_mm", |now| now.travelled_mm),
    ("since_reversal_mm", |now| now.since_reversal_mm),
    ("travelled_deg", |now| now.travelled_mm),
    ("since_reversal_deg", |now| now.since_reversal_mm),
    ("since_stop_s", |now| now.since_stop_s),
    ("pass", |now| f64::from(u32::try_from(now.pass).unwrap_or(u32::MAX))),
    ("error_um", |now| now.error_um),
];

/// Where a variable of the formula gets its value.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Variable {
    Parameter(usize),
    AlwaysThere(usize),
    Column(String),
    /// The value of a memory, by its place among them.
    Remembered(usize),
}

/// A memory of the formula.
#[derive(Clone, Debug)]
struct Memory {
    kind: Kind,
    of: Variable,
    arguments: Vec<Argument>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Argument {
    Parameter(usize),
    Number(f64),
}

/// Longest formula, bytes: some three hundred operands.
const LONGEST_FORMULA: usize = 2000;

/// A formula of the user, in µm (arcsec on a rotary chain).
///
/// Operators are `+ - * / ^`, functions `abs sign sqrt exp ln log10 sin cos tan asin acos atan
/// sinh cosh tanh floor ceil round step ramp fract`, constants `pi` and `π`, angles in radians.
/// `step` is 1 above 0, `ramp` what is above 0, `fract` what is beyond the next whole number below.
/// `lag(column, s)` is a column as something of that time constant follows it, `relay(column,
/// middle, width)` 1 while a switch with hysteresis is on.
#[derive(Clone, Debug)]
pub struct Custom {
    name: String,
    formula: String,
    expression: Expression,
    variables: Vec<Variable>,
    memories: Vec<Memory>,
    roles: Vec<Role>,
}

/// Points at which a formula is tried for its linear parameters; at 24, whose variables went in one
/// step, the width of a plateau turned nothing over and was taken for linear.
const TRIALS: u32 = 64;

impl Custom {
    /// Reads a formula; names that are neither parameters nor always there are logged columns.
    ///
    /// A parameter is linear when the formula is, by trial at fixed points, in it and in the other
    /// linear ones together.
    ///
    /// # Errors
    ///
    /// [`EffectError::Formula`] when it cannot be read, or leaves a parameter out.
    pub fn new(name: &str, formula: &str, parameters: &[String]) -> Result<Self, EffectError> {
        let refuse = |message: String| EffectError::Formula {
            effect: name.into(),
            formula: formula.into(),
            message,
        };
        if LONGEST_FORMULA < formula.len() {
            return Err(EffectError::Formula {
                effect: name.into(),
                formula: formula.chars().take(40).chain(['…']).collect(),
                message: format!(
                    "found {} bytes, expected at most {LONGEST_FORMULA}",
                    formula.len()
                ),
            });
        }
        if let Some(taken) = parameters.iter().find(|name| is_taken(name)) {
            return Err(refuse(format!("`{taken}` is a function, and no name of a parameter")));
        }
        let (text, calls) =
            taken_out(formula).map_err(|usage| refuse(format!("a memory is written `{usage}`")))?;
        if let Some(mistake) = mistakes::first(&text) {
            return Err(refuse(mistake));
        }
        let expression = Expression::parse(&powers::in_brackets(&text))
            .map_err(|error| refuse(error.msg().to_lowercase()))?;
        let memories: Vec<Memory> = calls
            .iter()
            .map(|call| read_memory(call, parameters).map_err(&refuse))
            .collect::<Result<_, _>>()?;
        let of_word = |word: &String| {
            let remembered = (0..memories.len()).find(|index| placeholder(*index) == *word);
            remembered.map_or_else(|| variable(word, parameters), Variable::Remembered)
        };
        let variables: Vec<_> = expression.var_names().iter().map(of_word).collect();
        let roles = vec![Role::Nonlinear; parameters.len()];
        let (name, formula) = (name.into(), formula.into());
        let mut custom = Self { name, formula, expression, variables, memories, roles };
        for (index, parameter) in parameters.iter().enumerate() {
            if !custom.variables.contains(&Variable::Parameter(index)) && !custom.is_kept(index) {
                return Err(refuse(format!("the parameter `{parameter}` does not occur in it")));
            }
        }
        custom.find_linear();
        Ok(custom)
    }

    /// The formula as written.
    #[must_use]
    pub fn formula(&self) -> &str {
        &self.formula
    }

    /// Logged columns it reads.
    #[must_use]
    pub fn needs(&self) -> Vec<&str> {
        let of_memories = self.memories.iter().map(|memory| &memory.of);
        let columns = self.variables.iter().chain(of_memories).filter_map(|one| match one {
            Variable::Column(name) => Some(name.as_str()),
            _ => None,
        });
        columns.collect()
    }

    /// True when a memory is set by a parameter.
    fn is_kept(&self, parameter: usize) -> bool {
        let mut arguments = self.memories.iter().flat_map(|memory| &memory.arguments);
        arguments.any(|argument| *argument == Argument::Parameter(parameter))
    }

    /// The parameters with their roles.
    #[must_use]
    pub fn with_roles(&self, mut parameters: Vec<Parameter>) -> Vec<Parameter> {
        for (parameter, role) in parameters.iter_mut().zip(&self.roles) {
            parameter.role = *role;
        }
        parameters
    }

    /// Unit effects for given values of the nonlinear parameters.
    ///
    /// # Errors
    ///
    /// [`EffectError::MissingColumn`] when the record lacks a column of the formula.
    pub fn basis(
        &self,
        columns: &Columns,
        parameters: &[Parameter],
        nonlinear: &[f64],
    ) -> Result<Basis, EffectError> {
        let mut values = vec![0.0; parameters.len()];
        let mut rest = nonlinear.iter();
        for (value, parameter) in values.iter_mut().zip(parameters) {
            if parameter.is_nonlinear() {
                *value = rest.next().copied().unwrap_or_default();
            }
        }
        let fixed = self.bound(columns, values.clone(), None)?;
        let mut basis = Basis { columns: Vec::new(), fixed: Some(Box::new(fixed)) };
        for (index, parameter) in parameters.iter().enumerate() {
            if !parameter.is_nonlinear() {
                let mut one = values.clone();
                one[index] = 1.0;
                basis.columns.push(Box::new(self.bound(columns, one, Some(values.clone()))?));
            }
        }
        Ok(basis)
    }

    fn bound(
        &self,
        columns: &Columns,
        values: Vec<f64>,
        minus: Option<Vec<f64>>,
    ) -> Result<Bound, EffectError> {
        let source = |variable: &Variable| match variable {
            Variable::Parameter(index) => Ok(Source::Parameter(*index)),
            Variable::AlwaysThere(index) => Ok(Source::AlwaysThere(*index)),
            Variable::Column(name) => {
                columns.index(name).map(Source::Column).ok_or_else(|| EffectError::MissingColumn {
                    effect: self.name.clone(),
                    column: name.clone(),
                    near: near(name),
                })
            }
            Variable::Remembered(index) => Ok(Source::Remembered(*index)),
        };
        let value = |argument: &Argument| match argument {
            Argument::Parameter(index) => values[*index],
            Argument::Number(number) => *number,
        };
        let memories = self.memories.iter().map(|memory| {
            let arguments = memory.arguments.iter().map(value).collect();
            Ok(Remembering { kind: memory.kind, of: source(&memory.of)?, arguments })
        });
        let memories = memories.collect::<Result<_, _>>()?;
        let sources = self.variables.iter().map(source).collect::<Result<_, _>>()?;
        Ok(Bound { expression: self.expression.clone(), sources, memories, values, minus })
    }

    /// Marks parameters the formula is linear in, taking them in order while they stay so together.
    fn find_linear(&mut self) {
        for index in 0..self.roles.len() {
            let linear: Vec<_> =
                (0..index).filter(|other| self.roles[*other] == Role::Linear).collect();
            if !self.is_kept(index) && self.is_linear(index, &linear) {
                self.roles[index] = Role::Linear;
            }
        }
    }

    /// Second differences in `index`, alone and mixed with each of `others`, vanish everywhere.
    fn is_linear(&self, index: usize, others: &[usize]) -> bool {
        let mut tried = 0;
        for trial in 0..TRIALS {
            let at = |moves: &[usize]| self.evaluate_trial(trial, moves);
            let (zero, one, two) = (at(&[]), at(&[index]), at(&[index, index]));
            if ![zero, one, two].iter().all(|value| value.is_finite()) {
                continue;
            }
            tried += 1;
            let tolerance = 1e-9 * (zero.abs() + one.abs() + two.abs());
            let bent = tolerance < (two - 2.0 * one + zero).abs();
            let mixed = others
                .iter()
                .any(|&other| tolerance < (at(&[index, other]) - one - at(&[other]) + zero).abs());
            if bent || mixed {
                return false;
            }
        }
        4 <= tried
    }

    /// The formula at the trial's point, moved in a parameter once for each time it is in `moves`.
    ///
    /// Every trial moves by another irrational step: one of 1 is a whole turn to many a phase.
    fn evaluate_trial(&self, trial: u32, moves: &[usize]) -> f64 {
        let golden = |number: u32| {
            let turn = 0.618_033_988_749_895 * f64::from(number);
            turn - turn.floor()
        };
        let step = 0.3 + golden(1 + trial * 7);
        let values: Vec<_> = (0_u32..)
            .zip(&self.variables)
            .map(|(place, variable)| {
                // Spread over 0.1 to 3.1, each variable by an irrational number of its own: what
                // compares two of them is met on either side. n² + n + 1 is no square.
                let rate = f64::from((place + 1) * (place + 2) + 1).sqrt();
                let turn = rate * f64::from(1 + trial);
                let base = 0.1 + 3.0 * (turn - turn.floor());
                match variable {
                    Variable::Parameter(index) => moves
                        .iter()
                        .filter(|moved| *moved == index)
                        .fold(base, |value, _| value + step),
                    _ => base,
                }
            })
            .collect();
        self.expression.eval(&values).unwrap_or(f64::NAN)
    }
}

/// What formulas can read that is called nearly as a column is that nothing holds.
pub(crate) fn near(column: &str) -> Option<&'static str> {
    let known = LOGGED_COLUMNS.iter().map(|known| known.name);
    let known = ALWAYS_THERE.iter().map(|(name, _)| *name).chain(known);
    nearest(column, known).filter(|near| *near != column)
}

fn read_memory(call: &Call, parameters: &[String]) -> Result<Memory, String> {
    let argument = |word: &String| {
        let parameter = parameters.iter().position(|name| name == word).map(Argument::Parameter);
        let number = || word.parse().ok().map(Argument::Number);
        parameter
            .or_else(number)
            .ok_or_else(|| format!("`{word}` in a memory is neither a parameter nor a number"))
    };
    let arguments = call.arguments.iter().map(argument).collect::<Result<Vec<_>, _>>()?;
    // The last is a time constant or a width.
    if let Some(Argument::Number(..0.0)) = arguments.last() {
        return Err(format!("a memory is written `{}`, the last 0 or more", call.kind.usage()));
    }
    let of = variable(&call.of, parameters);
    if matches!(of, Variable::Parameter(_)) {
        return Err(format!(
            "`{}` is a parameter: a memory is written `{}`",
            call.of,
            call.kind.usage()
        ));
    }
    Ok(Memory { kind: call.kind, of, arguments })
}

fn variable(word: &str, parameters: &[String]) -> Variable {
    if let Some(index) = parameters.iter().position(|name| name == word) {
        return Variable::Parameter(index);
    }
    ALWAYS_THERE
        .iter()
        .position(|(name, _)| *name == word)
        .map_or_else(|| Variable::Column(word.into()), Variable::AlwaysThere)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Record;

    fn roles(formula: &str, names: &[&str]) -> Vec<Role> {
        let names: Vec<_> = names.iter().map(ToString::to_string).collect();
        Custom::new("test", formula, &names).expect(formula).roles
    }

    #[test]
    fn linear_parameters_are_found() {
        let (linear, bent) = (Role::Linear, Role::Nonlinear);
        assert_eq!(roles("a*sin(2*pi*time_s/p) + b", &["a", "p", "b"]), [linear, bent, linear]);
        assert_eq!(roles("a*b*time_s", &["a", "b"]), [linear, bent]);
        assert_eq!(roles("a^2*position_mm", &["a"]), [bent]);
        assert_eq!(roles("a*sin(2*pi*(time_s/9 + turns))", &["a", "turns"]), [linear, bent]);
        assert_eq!(roles("a*exp(0-position_mm/l)", &["a", "l"]), [linear, bent]);
        let plateau = "a*step(w - abs(position_mm - c))";
        assert_eq!(roles(plateau, &["a", "w", "c"]), [linear, bent, bent]);
    }

    #[test]
    fn precedence_is_that_of_school() {
        let record = Record::default();
        for (formula, expected) in
            [("8-4-2", 2.0), ("8/4/2", 1.0), ("2+3*4^2", 50.0), ("-2*3", -6.0), ("8/4*2", 4.0)]
                .into_iter()
                .chain([("1e-3*1e3", 1.0), ("2.5E+1-1e1", 15.0), ("1e1-1", 9.0), (".5*2", 1.0)])
        {
            let custom = Custom::new("test", formula, &[]).expect(formula);
            let basis = custom.basis(&record.columns, &[], &[]).expect(formula);
            let now = Instant { covariates: &[], ..NOWHERE };
            let value = basis.fixed.map_or(0.0, |fixed| fixed.delta_um(&now));
            assert!((value - expected).abs() < 1e-12, "{formula} = {value}");
        }
    }

    const NOWHERE: Instant<'_> = Instant {
        time_s: 0.0,
        position_mm: 0.0,
        spindle_rad: 0.0,
        speed_rpm: 6.0,
        direction: 1.0,
        velocity_rpm: 6.0,
        pass: 0,
        travelled_mm: 0.0,
        since_reversal_mm: f64::INFINITY,
        since_turn_mm: f64::INFINITY,
        since_stop_s: f64::INFINITY,
        error_um: 0.0,
        covariates: &[],
    };

    #[test]
    fn what_is_no_formula_is_refused() {
        assert!(Custom::new("test", "a*(sin(time_s)", &["a".into()]).is_err());
        assert!(Custom::new("test", "sin(time_s)", &["a".into()]).is_err());
        assert!(Custom::new("test", "", &[]).is_err());
    }
}
