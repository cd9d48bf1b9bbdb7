//! Machines with something hidden, to see whether the diagnosis finds it.

use helixlock_plant::{Machine, MachineFile, Model, Parameter, Record, Role, Term};
use helixlock_traces::Table;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::error::ChallengeError;
use super::recipe::{RECIPES, Recipe};
use super::{outside, recipe, scene};
use crate::answer::Verdict;
use crate::numerics::rms_about_means;

/// Root mean square of the noise, µm.
pub(super) const NOISE_UM: f64 = 0.05;

/// What is hidden in a challenge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Hidden {
    /// Nothing: only noise.
    Nothing,
    /// One or two effects of the catalogue, by name.
    Effects(Vec<String>),
    /// A shape that is in no catalogue.
    Outside(&'static str),
}

/// A machine file, what was measured on the true machine, and the truth.
#[derive(Debug, Clone)]
pub struct Challenge {
    /// The machine file, without what is hidden.
    pub machine: MachineFile,
    /// What was measured.
    pub table: Table,
    /// What is hidden.
    pub hidden: Hidden,
    /// The hidden effects with their true values.
    pub terms: Vec<Term>,
    /// Root mean square of the noise, µm.
    pub noise_um: f64,
    /// Root mean square of the hidden part on its clearest sensor, µm.
    pub hidden_um: f64,
}

/// Makes the challenge of a seed: one in five hides nothing, one in five something outside the
/// catalogue, one in five two effects, the others one.
///
/// # Errors
///
/// [`ChallengeError`] if the recipe does not fit the machine.
pub fn challenge(seed: u64) -> Result<Challenge, ChallengeError> {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let recipe = &RECIPES[chance.random_range(0..RECIPES.len())];
    let kind = chance.random_range(0..10);
    let machine = scene::machine(recipe, &mut chance)?;
    let record = scene::record(&machine.model, recipe, &mut chance);
    let noise_um = NOISE_UM;
    let mut terms = Vec::new();
    let mut hidden = Hidden::Nothing;
    let mut extra = vec![0.0; record.len()];
    match kind {
        0 | 1 => {}
        2 | 3 => {
            let (name, deltas) = outside::shape(&record, &mut chance);
            let size = chance.random_range(4.0..12.0) * noise_um
                / rms_about_means(record.passes(), &deltas);
            extra = deltas.iter().map(|delta| delta * size).collect();
            hidden = Hidden::Outside(name);
        }
        _ => {
            terms.push(hidden_term(&machine.model, &record, recipe, noise_um, &mut chance)?);
            if kind < 6 {
                let gear = &RECIPES[recipe::COMPANION];
                if recipe.kind != gear.kind {
                    terms.push(hidden_term(&machine.model, &record, gear, noise_um, &mut chance)?);
                }
            }
            hidden = Hidden::Effects(terms.iter().map(|term| term.name.clone()).collect());
        }
    }
    let truth = Model { effects: terms.clone(), ..machine.model.clone() };
    let (table, hidden_um) =
        scene::measured(&machine.model, &truth, &record, recipe, &extra, noise_um, &mut chance)?;
    Ok(Challenge { machine, table, hidden, terms, noise_um, hidden_um })
}

/// An effect of a recipe at a size of three to fifteen times the noise.
pub(super) fn hidden_term(
    machine: &Machine,
    record: &Record,
    recipe: &Recipe,
    noise_um: f64,
    chance: &mut ChaCha8Rng,
) -> Result<Term, ChallengeError> {
    let term = recipe::term(machine, record, recipe, chance);
    let effect = term.effect(machine, &record.columns)?;
    let deltas = helixlock_plant::Effect::deltas_um(&effect, record);
    if recipe.fixed_size {
        return Ok(term);
    }
    let wanted = chance.random_range(3.0..15.0) * noise_um;
    let factor = wanted / rms_about_means(record.passes(), &deltas).max(1e-12);
    let scaled = |factor: f64| {
        let coefficients: Vec<f64> = term.coefficients().iter().map(|c| c * factor).collect();
        term.with_coefficients(&coefficients)
    };
    // No larger than the effect can be: a dead path of six metres is none.
    let full = scaled(factor);
    let share = full.parameters.iter().zip(&full.values).map(within).fold(1.0, f64::min);
    Ok(scaled(factor * share))
}

/// Share of a value that lies within the plausible range of its parameter.
fn within((what, &value): (&Parameter, &f64)) -> f64 {
    let (low, high) = (*what.range.start(), *what.range.end());
    let sized = matches!(what.role, Role::Linear | Role::Amplitude);
    if !sized || high <= low || (low..=high).contains(&value) {
        return 1.0;
    }
    (if value < low { low } else { high }) / value
}

/// How a diagnosis did on a challenge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// The hidden effects by name, or nothing where nothing is.
    Right,
    /// No name, and none to be had; or a group with the right one in it.
    Abstained,
    /// A wrong name, and the verdict `explained`.
    FalselyNamed,
    /// Something was missed: no name although one could be had.
    Missed,
}

/// Judges a verdict and the names of the final model.
#[must_use]
pub fn judge(hidden: &Hidden, verdict: Verdict, names: &[String]) -> Outcome {
    let right = match hidden {
        Hidden::Nothing => verdict == Verdict::NothingMissing,
        Hidden::Outside(_) => verdict == Verdict::Unexplained,
        Hidden::Effects(effects) => {
            verdict == Verdict::Explained
                && effects.iter().all(|effect| names.contains(effect))
                && names.iter().all(|name| effects.contains(name))
        }
    };
    match (right, verdict) {
        (true, _) if matches!(hidden, Hidden::Outside(_)) => Outcome::Abstained,
        (true, _) => Outcome::Right,
        (false, Verdict::Explained) => Outcome::FalselyNamed,
        (false, Verdict::Ambiguous) => Outcome::Abstained,
        (false, _) => Outcome::Missed,
    }
}
