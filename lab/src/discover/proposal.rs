//! What a formula says of itself: its text, its numbers, what could be behind it.

use helixlock_plant::{EffectError, Entry, Term};

use super::errors::errors;
use super::orders::is_beside_listed;
use crate::formulas::{Delta, ORDER, Placed, Shape};
use crate::model::{Columns, Problem, State};
use crate::numerics::spread;
use crate::policy::evidence::MARGIN;
use crate::policy::extent::MANY_TURNS;
use crate::search::Claim;

/// A number of a formula.
#[derive(Debug, Clone, PartialEq)]
pub struct FormulaParameter {
    /// Its name in the formula.
    pub name: String,
    /// Value in its unit.
    pub value: f64,
    /// Standard error under the noise model; `None` when the data do not hold it.
    pub stderr: Option<f64>,
    /// The unit; empty for a pure number.
    pub unit: String,
}

/// Another formula that was in the same place.
#[derive(Debug, Clone, PartialEq)]
pub struct RunnerUp {
    /// Its shape in words.
    pub shape: &'static str,
    /// What it stands along.
    pub along: String,
    /// The formula.
    pub formula: String,
    /// Named effects in whose place it stands.
    pub instead_of: Vec<String>,
    /// Evidence behind the proposal, in units of twice the log likelihood.
    pub behind: f64,
    /// How many numbers it has.
    pub numbers: usize,
    /// True when the data cannot tell it from the proposal.
    pub alike: bool,
    /// Why it is not proposed though it is clearly ahead.
    pub refused: Option<&'static str>,
}

/// A formula that explains what no name does.
#[derive(Debug, Clone)]
pub struct Proposal {
    /// Its shape in words.
    pub shape: &'static str,
    /// What it stands along.
    pub along: String,
    /// What kind of physics has this shape.
    pub physics: &'static str,
    /// The formula, δ in µm (arcsec), as a `custom` effect reads it.
    pub formula: String,
    /// Where it enters.
    pub entry: Entry,
    /// Its numbers.
    pub parameters: Vec<FormulaParameter>,
    /// The effect with its values, ready for a machine file.
    pub term: Term,
    /// Named effects in whose place it stands.
    pub instead_of: Vec<String>,
    /// Evidence ahead of those, or of nothing.
    pub evidence: f64,
    /// Chance of as much in noise, or odds that those effects are right.
    pub p_value: f64,
    /// What else could stand there, best first.
    pub runners_up: Vec<RunnerUp>,
}

/// A claim the court has granted, with its rivals.
#[derive(Debug, Clone)]
pub(super) struct Granted {
    pub(super) shape: Shape,
    pub(super) units: Vec<String>,
    pub(super) term: Term,
    pub(super) instead_of: Vec<String>,
    pub(super) evidence: f64,
    pub(super) p_value: f64,
    pub(super) runners_up: Vec<RunnerUp>,
    /// Those of them that stand in the same place, as effects.
    pub(super) rivals: Vec<Term>,
    /// Its columns when it was granted.
    pub(super) columns: Columns,
    /// Shapes and places among which it was looked for.
    pub(super) looks: f64,
}

/// Most runners-up that are told.
const TOLD: usize = 5;

impl Granted {
    /// A claim as an effect of the user named so, with the claims behind it.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when the formula cannot be read, which a test of the grammar excludes.
    pub(super) fn new(
        name: &str,
        delta: Delta,
        state: &State,
        claim: &Claim<'_>,
        others: &[(&Claim<'_>, Option<&'static str>)],
    ) -> Result<Self, EffectError> {
        let shape = claim.placed.shape;
        let named = |group: &[usize]| -> Vec<String> {
            group.iter().map(|&at| state.components[at].term.name.clone()).collect()
        };
        let mut runners_up = Vec::new();
        let mut rivals = Vec::new();
        for (other, refused) in others.iter().take(TOLD) {
            let gap = claim.ahead - other.ahead;
            runners_up.push(RunnerUp {
                shape: other.placed.shape.words,
                along: other.placed.shape.along.clone(),
                formula: formula(&other.placed, delta),
                instead_of: named(&other.group),
                behind: gap,
                numbers: other.placed.shape.numbers(),
                alike: gap < MARGIN && refused.is_none(),
                refused: *refused,
            });
            if other.group == claim.group {
                let other = &other.placed;
                let words = format!("{} along {}", other.shape.words, other.shape.along);
                rivals.push(other.term(&words)?);
            }
        }
        Ok(Self {
            shape: shape.clone(),
            units: shape.units(delta),
            term: claim.placed.term(name)?,
            instead_of: named(&claim.group),
            evidence: claim.ahead,
            p_value: claim.p_value,
            runners_up,
            rivals,
            columns: claim.placed.columns.clone(),
            looks: claim.looks,
        })
    }

    /// It without one of its parts, with values that it has now; `None` where nothing is left of it.
    pub(super) fn without(&self, part: usize, now: &Term, delta: Delta) -> Option<Self> {
        let shape = self.shape.without(part)?;
        let mut values = now.values.clone();
        values.drain(self.shape.numbers_of(part));
        let term = shape.term(&now.name, now.entry, values).ok()?;
        let mut raw = self.columns.raw.clone();
        raw.drain(self.shape.numbers_of(part));
        let columns = Columns::free(raw);
        let units = shape.units(delta);
        Some(Self { shape, units, term, columns, ..self.clone() })
    }

    /// It with the values of a fit to all rows of which it is a component, and with the errors of
    /// the fit to means of neighbours.
    pub(super) fn proposed(
        &self,
        state: &State,
        (small, thin): (&Problem, &State),
        index: usize,
    ) -> Proposal {
        let (used, _) = state.coefficients(index);
        let term = state.components[index].valued(used);
        let stderrs = errors(small, thin, index);
        let parameters = term.parameters.iter().zip(&term.values).zip(&self.units).enumerate();
        let parameters = parameters.map(|(place, ((what, value), unit))| FormulaParameter {
            name: what.name.to_string(),
            value: *value,
            stderr: stderrs.get(place).copied().flatten(),
            unit: unit.clone(),
        });
        let parameters: Vec<FormulaParameter> = parameters.collect();
        let turns =
            parameters.iter().any(|what| what.unit == "1/s" && turns_with(small, what.value));
        let mut orders = parameters.iter().filter(|what| what.name == ORDER);
        let physics = match (turns, orders.any(|what| is_beside_listed(small, what.value))) {
            (true, _) => OF_THE_SPINDLE,
            (_, true) => BESIDE_A_LINE,
            _ => self.shape.physics,
        };
        Proposal {
            shape: self.shape.words,
            along: self.shape.along.clone(),
            physics,
            formula: term.formula_text().to_owned(),
            entry: term.entry,
            parameters,
            term,
            instead_of: self.instead_of.clone(),
            evidence: self.evidence,
            p_value: self.p_value,
            runners_up: self.runners_up.clone(),
        }
    }
}

/// What has a frequency in time that is none of the clock's.
const OF_THE_SPINDLE: &str = "whole waves in a turn at the mean speed: what turns with the spindle where its angle is stamped unevenly, or a pump, a motor";

/// What has an order beside that of a listed wheel.
const BESIDE_A_LINE: &str = "a listed wheel's wave, or one that swells or comes early and late with the turn of a slower one";

/// True for a frequency that is a whole multiple of the mean rate of a spindle, over the longest pass to half a wave.
fn turns_with(problem: &Problem, hertz: f64) -> bool {
    let turns: Vec<f64> = problem.record.turns().collect();
    let passes = problem.record.passes().into_iter();
    let longest =
        passes.map(|rows| (spread(&turns[rows.clone()]), spread(&problem.record.time_s[rows])));
    let (turns, seconds) = longest.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
    let waves = hertz * seconds;
    let multiple = (waves / turns.max(f64::MIN_POSITIVE)).round();
    problem.measurement.timed
        && MANY_TURNS <= turns
        && 1.0 <= multiple
        && (waves - multiple * turns).abs() < 0.5
}

fn formula(placed: &Placed<'_>, delta: Delta) -> String {
    placed.shape.written(delta).map(|(text, _)| text).unwrap_or_default()
}
