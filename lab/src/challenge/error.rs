//! Why a challenge could not be made.

use helixlock_plant::{EffectError, MachineError};

use crate::measurement::LabError;

/// Why a challenge could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ChallengeError {
    /// The machine file is wrong, which is a flaw of the program.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// An effect does not fit the machine, which is a flaw of the program.
    #[error(transparent)]
    Effect(#[from] EffectError),
    /// What was simulated cannot be read, which is a flaw of the program.
    #[error(transparent)]
    Measured(#[from] LabError),
}
