//! What a diagnosis has found.

use helixlock_lab::Diagnosis;

/// Names of the effects of the final model.
pub(crate) fn names(diagnosis: &Diagnosis) -> Vec<&str> {
    let last = diagnosis.rounds.last().expect("there is always a round 0");
    last.effects.iter().map(|effect| effect.name.as_str()).collect()
}
