//! An error curve that was measured, as the machine's motion error.

use std::path::{Component, Path, PathBuf};

use helixlock_traces::{read_bytes, table_of};

use crate::units::NUMBER;
use crate::{Basis, Card, Effect, Entry, Instant, Machine, Nature, Parameter};

/// A measured curve, in the catalogue.
pub(crate) const CARD: Card = Card {
    kind: "measured-curve",
    entry: Entry::Motion,
    summary: "an error curve that was measured is the machine's motion error",
    formula: "straight between the points of a table of position_mm and lead_error_um or error_um, level beyond its ends",
    example: "file = 'curve.csv', scale = 1.0",
    parameters: &[],
    parts: &[],
    needs: &[],
    signature: "the curve itself, in every pass",
    confused_with: &[],
    separated_by: "what the measurement says of its own conditions",
    source: "the user",
    random: false,
    candidate: false,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::default()),
};

/// Longest curve, bytes: some two million points.
const LONGEST_BYTES: u64 = 64 << 20;

/// Table motion error over travel, straight between the points and level beyond the ends.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredCurve {
    file: String,
    /// `(travel in mm, table ahead in µm)`, travel rising.
    points: Vec<(f64, f64)>,
}

impl MeasuredCurve {
    /// The only parameter: a factor on the curve.
    pub const SCALE: Parameter =
        Parameter::linear("scale", NUMBER, "factor on the curve").within(-10.0..=10.0).or(1.0);

    /// The curve through points `(travel in mm, table ahead in µm)`, in any order.
    #[must_use]
    pub fn new(file: &str, mut points: Vec<(f64, f64)>) -> Self {
        points.sort_by(|one, other| one.0.total_cmp(&other.0));
        let places = points.chunk_by(|one, other| one.0.to_bits() == other.0.to_bits());
        let points = places.map(mean).collect();
        Self { file: file.into(), points }
    }

    /// Reads a table with `position_mm` and one of `lead_error_um` (thread too long is positive, so
    /// the table was ahead) and `error_um` (recorder: laser lag is positive, so it was behind).
    ///
    /// Rows at the same place are averaged; rows with a missing cell are left out. On a rotary
    /// chain the columns are `angle_rev` and `error_arcsec`. `file` is a plain file in the machine
    /// file's `folder` or below: whoever sends a machine file does not choose what else is read.
    ///
    /// # Errors
    ///
    /// What is wrong with the table, for a person.
    pub fn read(folder: &Path, file: &str, machine: &Machine) -> Result<Self, String> {
        let path = beside(folder, file)?;
        let bytes = read_bytes(&path, LONGEST_BYTES).map_err(|error| error.to_string())?;
        let table = table_of(bytes, &path).map_err(|error| error.to_string())?;
        let (place, per_turn_mm) = if machine.rotary {
            ("angle_rev", machine.workpiece.lead.mm())
        } else {
            ("position_mm", 1.0)
        };
        let places = table.require(place).map_err(|error| error.to_string())?;
        let (values, sign) = if machine.rotary {
            (table.require("error_arcsec").map_err(|error| error.to_string())?, -1.0)
        } else if let Some(values) = table.column("lead_error_um") {
            (values, 1.0)
        } else {
            (table.require("error_um").map_err(|error| error.to_string())?, -1.0)
        };
        let pairs = places.iter().zip(values);
        let points: Vec<_> = pairs
            .filter(|(place, value)| place.is_finite() && value.is_finite())
            .map(|(place, value)| (place * per_turn_mm, sign * value))
            .collect();
        if points.len() < 2 {
            return Err(format!("found {} complete rows, expected at least 2", points.len()));
        }
        Ok(Self::new(file, points))
    }

    /// The file it came from, as the machine file names it.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The curve as a unit effect.
    #[must_use]
    pub fn basis(&self) -> Basis {
        Basis::one(self.clone())
    }
}

impl Effect for MeasuredCurve {
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        let after = self.points.partition_point(|point| point.0 <= now.position_mm);
        match (after.checked_sub(1).map(|before| self.points[before]), self.points.get(after)) {
            (Some((x0, y0)), Some((x1, y1))) => y0 + (y1 - y0) * (now.position_mm - x0) / (x1 - x0),
            (Some((_, end)), None) => end,
            (None, Some((_, start))) => *start,
            (None, None) => 0.0,
        }
    }
}

/// The path of a plain file of the folder, wherever links lead.
fn beside(folder: &Path, file: &str) -> Result<PathBuf, String> {
    let path = folder.join(file);
    let home = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let below = Path::new(file).components().all(|part| matches!(part, Component::Normal(_)));
    let expected = "expected a plain file beside the machine file, or in a folder there";
    if !below {
        return Err(format!("found a path that leads elsewhere, {expected}"));
    }
    let cannot = |error: std::io::Error| format!("{}: cannot be read: {error}", path.display());
    let (end, home) = (path.canonicalize().map_err(cannot)?, home.canonicalize());
    if !end.is_file() || !home.is_ok_and(|home| end.starts_with(home)) {
        return Err(format!("found no such file, {expected}"));
    }
    Ok(path)
}

/// The mean of points at one place.
#[expect(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ points")]
fn mean(points: &[(f64, f64)]) -> (f64, f64) {
    let sum: f64 = points.iter().map(|point| point.1).sum();
    (points[0].0, sum / points.len() as f64)
}
