//! The laser beam runs beside the point that grinds, and the carriage pitches.
//!
//! ```text
//! δ = h·β = 4.848e-3·h·β″
//!
//! δ in µm    h Abbe offset in mm    β″ pitch of the carriage in seconds of arc (1″ = 4.848 µrad)
//! ```
//!
//! 50 mm and 2″ are 0.485 µm.

use crate::machine::Part;
use crate::units::MM;
use crate::{Basis, Card, Covariate, Effect, Entry, Instant, Nature, Parameter};

/// µm per mm and second of arc: π/648 000 rad times 1000.
const UM_PER_MM_ARCSEC: f64 = std::f64::consts::PI / 648.0;

pub(super) const CARD: Card = Card {
    kind: "abbe",
    entry: Entry::LengthReference,
    summary: "the laser beam runs beside the point that grinds, and the carriage pitches",
    formula: "4.848e-3·h·β″",
    example: "h = 50 mm, 2″: 0.485 µm",
    parameters: &[Parameter::linear("offset", MM, "height of the beam over the grinding point")
        .within(-500.0..=500.0)],
    parts: &[Part::Table, Part::Laser],
    needs: &["bed_pitch_arcsec"],
    signature: "follows the logged pitch of the carriage",
    confused_with: &["screw-progressive"],
    separated_by: "shift the beam in height and repeat the pass",
    source: "Abbe's principle; 1″ = π/648000 rad",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::one(Pitch)),
};

/// One millimetre of offset.
#[derive(Debug)]
struct Pitch;

impl Effect for Pitch {
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        UM_PER_MM_ARCSEC * now.covariate(Covariate::BedPitch)
    }
}
