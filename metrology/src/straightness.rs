//! Straightness of a guideway and a workpiece by three probes.
//!
//! Three probes on a carriage read a turned bar at `x`, `x − L1` and `x − L1 − L2` (document 2):
//!
//! ```text
//! z1 = h(x)           + δ(x)                  h   straightness of the bar, µm
//! z2 = h(x − L1)      + δ(x) + L1·β(x)        δ   straightness of the carriage motion, µm
//! z3 = h(x − L1 − L2) + δ(x) + (L1 + L2)·β(x) β   its tilt, µm/mm
//! ```
//!
//! `z = z1 − (1 + L1/L2)·z2 + (L1/L2)·z3` holds no δ and no β. From it h is found, by Fourier
//! series as in the document or by least squares without periodicity, and then δ and β. Shift
//! and tilt of h are not observable; nor is its parabola while the probes' zeros are unknown.

mod chauvenet;
mod compensation;
pub mod coverage;
mod drawn;
mod fourier;
mod least_squares;
mod plan;
mod readings;
mod reference_line;
mod separated;
mod spacing;

pub use chauvenet::is_outlier;
pub use compensation::{
    CompensationModel, CompensationOutcome, CorrectionPoint, correction_table,
    simulate_compensation,
};
pub use drawn::{drawn_straightness_um, straightness_uncertainty_um};
pub use fourier::separate_by_fourier;
pub use least_squares::separate_by_least_squares;
pub use plan::{Plan, plan, propose};
pub use readings::{Combined, Readings, Rejected, Repeat};
pub use reference_line::{Line, Straightness, StraightnessLines, straightness};
pub use separated::Separated;
pub use spacing::{Harmonic, Spacing};
