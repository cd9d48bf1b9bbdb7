//! The catalogue, one effect a file, in the order of the guide.

mod abbe;
mod gear_error;
mod grating_eccentricity;
mod screw_periodic;
mod screw_progressive;
mod vibration;
mod wave;

use crate::Card;

/// Every effect there is.
pub const CATALOGUE: &[&Card] = &[
    &screw_periodic::CARD,
    &screw_progressive::CARD,
    &gear_error::CARD,
    &abbe::CARD,
    &grating_eccentricity::CARD,
    &vibration::CARD,
];
