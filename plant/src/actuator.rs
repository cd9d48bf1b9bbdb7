//! Steps of the motor to travel of the table.

use crate::motion::surroundings;
use crate::record::Covariate;
use crate::term::Sum;
use crate::{Effect, EffectError, Entry, Instant, Model, Motion, Play};

/// The corrector: step motor, lever and nut.
#[derive(Debug)]
pub struct Actuator {
    step_um: f64,
    steps: i64,
    plays: Vec<Play>,
    effects: Vec<Sum>,
    covariates: Vec<f64>,
    corrector_um: f64,
}

impl Actuator {
    /// At rest in its middle, with the actuator effects of the model.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when an effect needs a part of the machine file that is missing.
    pub fn new(model: &Model) -> Result<Self, EffectError> {
        let (columns, covariates) = surroundings(model);
        let columns = crate::Columns::new(columns.present().chain(["steps"]));
        let mut actuator = Self {
            step_um: model.drive.step_um,
            steps: 0,
            plays: Vec::new(),
            effects: Vec::new(),
            covariates,
            corrector_um: 0.0,
        };
        for term in model.effects.iter().filter(|term| term.entry == Entry::Actuator) {
            if term.kind() == "corrector-lost-motion" {
                actuator.plays.extend(term.values.first().map(|width_um| Play::new(*width_um)));
            } else {
                actuator.effects.push(term.effect(model, &columns)?);
            }
        }
        Ok(actuator)
    }

    /// Takes a step at a moment of the motion; gives what the table then stands ahead by, µm.
    pub fn step(&mut self, motion: &Motion, time_s: f64, forward: bool) -> f64 {
        self.steps += if forward { 1 } else { -1 };
        self.settle(motion, time_s)
    }

    /// Where the table stands at a moment without a step, which effects in time can change.
    #[expect(clippy::cast_precision_loss, reason = "a counter of 12 bits")]
    pub fn settle(&mut self, motion: &Motion, time_s: f64) -> f64 {
        let commanded_um = self.steps as f64 * self.step_um;
        let mut reached_um = commanded_um;
        for play in &mut self.plays {
            reached_um = play.follow(reached_um);
        }
        if !self.effects.is_empty() {
            self.covariates[Covariate::Steps as usize] = self.steps as f64;
            let now = Instant { covariates: &self.covariates, ..motion.at(time_s) };
            reached_um -= self.effects.iter().map(|effect| effect.delta_um(&now)).sum::<f64>();
        }
        self.corrector_um = reached_um;
        reached_um
    }

    /// Net steps taken, forward positive.
    #[must_use]
    pub fn steps(&self) -> i64 {
        self.steps
    }

    /// What the table stands ahead by since the last step, µm.
    #[must_use]
    pub fn corrector_um(&self) -> f64 {
        self.corrector_um
    }
}
