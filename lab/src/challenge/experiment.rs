//! Whether the experiment that is advised settles what a record cannot: both are simulated.

use helixlock_plant::Model;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::error::ChallengeError;
use super::recipe::{self, Recipe};
use super::scene;
use super::task::{Hidden, NOISE_UM, Outcome, hidden_term, judge};
use crate::answer::{Diagnosis, Verdict, carried_out, diagnose};
use crate::measurement::{Measurement, Nominal};
use crate::model::Problem;

/// A hidden effect, what a poor record says of it, and what it says with the advised experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct Experimented {
    /// The hidden effect.
    pub hidden: String,
    /// Verdict and outcome on the record alone.
    pub before: (Verdict, Outcome),
    /// What was advised, and the evidence that it was expected to bring; none where no two effects
    /// were confused.
    pub advised: Option<(String, f64)>,
    /// Verdict and outcome with the experiment behind the record.
    pub after: Option<(Verdict, Outcome)>,
}

/// Hides an effect in a record that lacks what would tell it, and carries the best experiment out.
///
/// # Errors
///
/// [`ChallengeError`] if the recipe does not fit the machine.
pub fn experiment(seed: u64) -> Result<Experimented, ChallengeError> {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let poor = recipe::poor();
    let recipe = &poor[chance.random_range(0..poor.len())];
    let machine = scene::machine(recipe, &mut chance)?.model;
    let record = scene::record(&machine, recipe, &mut chance);
    let term = hidden_term(&machine, &record, recipe, NOISE_UM, &mut chance)?;
    let hidden = term.name.clone();
    let truth = Model { effects: vec![term], ..machine.clone() };
    let first = measured(&machine, &truth, &record, recipe, &mut chance)?;
    let said = diagnose(&first);
    let before = outcome(&hidden, &said);
    let best = said.experiments.first().filter(|_| said.verdict == Verdict::Ambiguous);
    let Some((best, more)) =
        best.and_then(|best| Some((best, carried_out(&first.measurement, &best.action)?)))
    else {
        return Ok(Experimented { hidden, before, advised: None, after: None });
    };
    let advised = Some((best.action.clone(), best.evidence));
    let record = Problem::new(&machine, &more)?.record;
    let second = measured(&machine, &truth, &record, recipe, &mut chance)?;
    let after = Some(outcome(&hidden, &diagnose(&second)));
    Ok(Experimented { hidden, before, advised, after })
}

fn outcome(hidden: &str, said: &Diagnosis) -> (Verdict, Outcome) {
    let effects = said.rounds.last().map(|last| last.effects.as_slice()).unwrap_or_default();
    let names: Vec<String> = effects.iter().map(|effect| effect.name.clone()).collect();
    let hidden = Hidden::Effects(vec![hidden.to_owned()]);
    (said.verdict, judge(&hidden, said.verdict, &names))
}

/// A record of the true machine against the one without what is hidden.
fn measured(
    known: &Model,
    truth: &Model,
    record: &helixlock_plant::Record,
    recipe: &Recipe,
    chance: &mut ChaCha8Rng,
) -> Result<Problem, ChallengeError> {
    let nothing = vec![0.0; record.len()];
    let (table, _) = scene::measured(known, truth, record, recipe, &nothing, NOISE_UM, chance)?;
    let measurement = Measurement::from_table(&table, &Nominal::of(known))?;
    Ok(Problem::new(known, &measurement)?)
}
