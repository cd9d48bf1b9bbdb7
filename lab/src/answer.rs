//! What a user is told: compared, diagnosed, one effect added, a machine file written, an
//! experiment proposed, and the learned machine run clock by clock.

mod adding;
mod compare;
mod diagnosis;
mod experiment;
mod far_readings;
mod final_check;
mod harmonics;
mod learn;
mod loud_passes;
mod searched;

pub use adding::{Added, add};
pub use compare::{Comparison, NoiseSize, PassSize, SensorResidual, SlowSize, compare};
pub use diagnosis::{Diagnosis, FittedEffect, FittedParameter, Ranked, Round, Verdict, diagnose};
pub(crate) use diagnosis::{accepted_beyond, effects};
pub use experiment::Advice;
pub(crate) use experiment::{apart, carried_out};
pub(crate) use far_readings::far_readings;
pub use far_readings::{FarReading, FarReadings};
pub use final_check::{FinalCheck, SensorCheck, final_check};
pub use learn::{Ledger, LedgerEntry, Spectra, fingerprint, fnv1a64, ledger, spectra, written};
pub use loud_passes::LoudPass;
pub(crate) use loud_passes::loud_passes;
