//! Phases of the file's waves that were written by another convention than its own, `sin(x + φ)`.

use helixlock_plant::{Model, Role, Term};

use super::hypothesis::Hypothesis;
use crate::model::Problem;
use crate::policy::mistakes::MACHINE_OF_EFFECTS;

/// A way of writing a wave: what is to be done with each phase, and the phase that is meant, in degrees.
struct Convention {
    wave: &'static str,
    mend: &'static str,
    meant: fn(f64) -> f64,
}

const CONVENTIONS: [Convention; 3] = [
    Convention {
        wave: "cos(x + φ)",
        mend: "add 90° to every `phase` of the machine file",
        meant: |phase_deg| phase_deg + 90.0,
    },
    Convention {
        wave: "cos(x − φ)",
        mend: "write 90° less each `phase` of the machine file",
        meant: |phase_deg| 90.0 - phase_deg,
    },
    Convention {
        wave: "sin(x − φ)",
        mend: "turn the sign of every `phase` of the machine file",
        meant: |phase_deg| -phase_deg,
    },
];

/// Every other convention, where more than one wave speaks for it: one alone may have another phase.
pub(super) fn conventions(problem: &Problem) -> Vec<Hypothesis> {
    let waves = problem.model.effects.iter().filter(|term| term.is_wave()).count();
    if waves < MACHINE_OF_EFFECTS {
        return Vec::new();
    }
    CONVENTIONS.iter().filter_map(|one| one.of_file(problem, waves)).collect()
}

impl Convention {
    fn of_file(&self, problem: &Problem, waves: usize) -> Option<Hypothesis> {
        let effects = problem.model.effects.iter().map(|term| self.of(term)).collect();
        let model = Model { effects, ..problem.model.clone() };
        let says = format!("the phases of the file's {waves} waves are those of {}", self.wave);
        Hypothesis::of_model(problem, &model, ("phase", says, self.mend.to_owned()))
    }

    fn of(&self, term: &Term) -> Term {
        let mut meant = term.clone();
        for (what, value) in meant.parameters.iter().zip(&mut meant.values) {
            if what.role == Role::Phase {
                *value = (self.meant)(*value);
            }
        }
        meant
    }
}
