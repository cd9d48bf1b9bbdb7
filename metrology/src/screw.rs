//! Travel deviation of lead screws: mean line, variation in windows, grades.
//!
//! A curve of travel deviation (µm) against travel (mm) comes in; the characteristics of
//! ISO 3408-3 (ball screws) or JB/T 2886 (trapezoidal screws), the places where they are
//! reached, and grades with their probability come out.

mod characteristic;
pub mod coverage;
mod curve;
mod doubts;
mod grade;
mod helical;
mod mean_line;
mod pitch;
mod reading_noise;
mod smooth_process;
mod tolerance;
mod travel_variation;
mod true_curve;
mod windows;

pub use characteristic::{Characteristic, Missing, Reached};
pub use curve::{Curve, Gap};
pub use doubts::{Doubt, doubt, without_wild};
pub use grade::{GradeVerdict, Grading, Judgement, grade};
pub use helical::helical_characteristics;
pub use mean_line::{MeanLine, Weighting, fit_mean_line};
pub use pitch::pitch_characteristics;
pub use reading_noise::{Estimate, without_reading_noise};
pub use tolerance::{Limit, Status, ToleranceTable, built_in_table};
pub use travel_variation::{FAITHFUL_PER_TURN, TravelVariation, evaluate_travel};
pub use windows::{WINDOW_SLACK_MM, Widest, widest_in_windows};
