//! Positioning errors of a machine scale: measured, stored, corrected (document 3).
//!
//! A calibrated inductosyn scale A rides beside the machine's scale B. What they differ by is
//! sampled by position, stored in a 2 KiB EEPROM, and taken off again while machining: by stepping
//! the tool (scheme 1) or by correcting the display (scheme 2).
//!
//! An *error* is what the machine's scale shows less what the calibrated one does; a *correction*
//! has the opposite sign.

mod apply;
mod detector;
mod export;
mod image;
mod joints;
mod model;
mod table;

pub use apply::{Corrected, Scheme, Spread, apply};
pub use detector::Detector;
pub use export::{LINUXCNC_ROWS, LinuxCnc, linuxcnc_file, nominal_actual_csv, siemens_file};
pub use image::{IMAGE_BYTES, from_hex, from_image, to_hex, to_image};
pub use joints::{Joint, JointRule};
pub use model::{ModelledScale, Residual, residual_budget};
pub use table::{CorrectionTable, Direction, ErrorSample, LookUp, TableRule, build_table};
