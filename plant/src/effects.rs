//! The catalogue, one effect a file, in the order of the guide.

mod abbe;
mod air_humidity;
mod air_index;
mod air_pressure;
mod air_temperature;
mod backlash;
mod clamping_runout;
mod compensator_staircase;
mod corrector_lost_motion;
mod cosine;
mod dead_path;
mod fringe_nonlinearity;
mod fringe_slip;
mod gear_error;
mod grating_eccentricity;
mod grating_graduation;
mod grating_slip;
mod grinding_force;
mod guide;
mod headstock_growth;
mod laser_drift;
mod lever_ratio;
mod lost_added_pulses;
mod lost_steps;
mod meter_dead_zone;
mod phase_drift;
mod rationalisation;
mod recorder_lag;
mod screw_periodic;
mod screw_progressive;
mod screw_wear;
mod shape;
mod steady_sag;
mod stick_slip;
mod turbulence;
mod vibration;
mod wave;
mod wheel_wear;
mod wind_up;
mod workpiece_expansion;
mod wrong_setting;

pub use guide::{guide, page};

use crate::Card;

/// Every effect there is.
pub const CATALOGUE: &[&Card] = &[
    &screw_periodic::CARD,
    &screw_progressive::CARD,
    &screw_wear::CARD,
    &gear_error::CARD,
    &clamping_runout::CARD,
    &backlash::CARD,
    &wind_up::CARD,
    &stick_slip::CARD,
    &air_temperature::CARD,
    &air_pressure::CARD,
    &air_humidity::CARD,
    &dead_path::CARD,
    &laser_drift::CARD,
    &cosine::CARD,
    &abbe::CARD,
    &turbulence::CARD,
    &fringe_nonlinearity::CARD,
    &rationalisation::CARD,
    &compensator_staircase::CARD,
    &lost_added_pulses::CARD,
    &fringe_slip::CARD,
    &grating_slip::CARD,
    &grating_eccentricity::CARD,
    &grating_graduation::CARD,
    &workpiece_expansion::CARD,
    &grinding_force::CARD,
    &wheel_wear::CARD,
    &steady_sag::CARD,
    &headstock_growth::CARD,
    &phase_drift::CARD,
    &meter_dead_zone::CARD,
    &recorder_lag::CARD,
    &vibration::CARD,
    &corrector_lost_motion::CARD,
    &lost_steps::CARD,
    &lever_ratio::CARD,
    &wrong_setting::CARD,
    &crate::custom::CARD,
    &crate::measured_curve::CARD,
];

#[cfg(test)]
mod numbers;
#[cfg(test)]
mod tests;
