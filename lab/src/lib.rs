//! Model against measurement.
//!
//! Each room uses those above it in this list and none below.

mod policy;

mod numerics;

mod measurement;

mod noise;

mod model;

mod doubts;

mod spectrum;

mod formulas;

mod hypotheses;

mod search;

mod answer;

mod discover;

mod challenge;

pub use answer::{
    Added, Advice, Comparison, Diagnosis, FarReading, FarReadings, FinalCheck, FittedEffect,
    FittedParameter, Ledger, LedgerEntry, LoudPass, NoiseSize, PassSize, Ranked, Round,
    SensorCheck, SensorResidual, SlowSize, Spectra, Verdict, add, compare, diagnose, final_check,
    fingerprint, fnv1a64, ledger, spectra, written,
};
pub use challenge::{
    Challenge, ChallengeError, Experimented, Figure, Hidden, Outcome, Score, Scored, Share,
    challenge, experiment, judge,
};
pub use discover::{Discovery, FormulaParameter, Found, Proposal, RunnerUp, discover};
pub use doubts::{Doubt, divider_doubt, doubts};
pub use hypotheses::Structure;
pub use measurement::{LabError, Measurement, Nominal, PulseTrains, Steps, Told, sensor_column};
pub use model::Problem;
pub use noise::{Block, Layout, Noise, SlowPart};
pub use spectrum::{Line, NamedLine, amplitude_spectrum, lines_left};
