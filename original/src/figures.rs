//! The logic drawings of document 1, one a file, as circuits of the parts of the time.
//!
//! Each file has two functions: one that puts the drawing into a larger circuit, and `circuit`,
//! the drawing alone with its pins. The drawings themselves are lost; what the text does not say
//! is *Inferred*, with the alternatives.

pub mod calibrator;
pub mod compensator;
pub mod decade;
pub mod discriminator;
pub mod divider;
pub mod laser_direction;
pub mod oscillator;
pub mod phase_meter;
pub mod phase_selector;
pub mod range_stage;
pub mod reset_counter;
pub mod ring;

use crate::circuit::Circuit;

/// A drawing.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Its number in the print.
    pub number: &'static str,
    /// Its file and the name of its circuit.
    pub name: &'static str,
    /// The block of the synchronous device that does the same.
    pub block: Option<&'static str>,
    /// The drawing with the settings of an example.
    pub build: fn() -> Circuit,
}

/// All of them, in the order of the print.
pub const FIGURES: &[Figure] = &[
    figure("3, 6", "phase_meter", Some("phase_meter"), phase_meter::circuit),
    figure("6", "laser_direction", None, laser_direction::circuit),
    figure("7", "decade", Some("decade_counter"), decade::circuit),
    figure("7", "divider", Some("programmable_divider"), || divider::circuit(127, Clear::Delayed)),
    figure("8", "phase_selector", Some("initial_phase_selector"), || phase_selector::circuit(126)),
    figure("9", "compensator", Some("cumulative_compensator"), || {
        compensator::circuit(156, compensator::Correction::Block)
    }),
    figure("11, 12", "calibrator", Some("calibrator"), || {
        calibrator::circuit(calibrator::Step::Degrees45)
    }),
    figure("14", "oscillator", Some("step_clock"), oscillator::circuit),
    figure("14", "ring", Some("ring_distributor"), ring::circuit),
    figure("15", "range_stage", Some("range_stage"), range_stage::circuit),
    figure("15, 16", "discriminator", Some("direction_discriminator"), discriminator::circuit),
    figure("17", "reset_counter", Some("reset_counter"), reset_counter::circuit),
];

pub use divider::Clear;

const fn figure(
    number: &'static str,
    name: &'static str,
    block: Option<&'static str>,
    build: fn() -> Circuit,
) -> Figure {
    Figure { number, name, block, build }
}
