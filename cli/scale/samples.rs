//! Measured errors of a scale from a file, and their ISO 230-2 evaluation.

use std::path::Path;

use anyhow::{anyhow, bail};
use helixlock_metrology::Error;
use helixlock_metrology::iso230::{AxisResult, Target, evaluate_axis};
use helixlock_metrology::scale::{Detector, Direction, ErrorSample};

use crate::shared::series::Series;

/// Reads `position_mm`, `error_um` or `adc_code` (0 to 255, 128 for none), `direction`, `idle`.
///
/// Positions count from the origin pulse. Without `direction` all samples are forward; samples
/// with `idle` other than 0 are left out, as nothing is compensated while idling. Missing cells
/// leave their row out.
pub(crate) fn read_samples(
    path: &Path,
    origin_mm: f64,
    detector: &Detector,
) -> anyhow::Result<Vec<ErrorSample>> {
    let series = Series::read_all(path)?;
    refuse_angles(path, &series)?;
    let position = series.column("position_mm")?;
    let error = match (series.optional("error_um")?, series.optional("adc_code")?) {
        (Some(error), _) => error,
        (None, Some(codes)) => decoded(&series, &codes, detector)?,
        (None, None) => bail!(
            "{}: no column `error_um` or `adc_code`, found {}",
            path.display(),
            series.names()
        ),
    };
    let direction = series.optional("direction")?;
    let idle = series.optional("idle")?;
    let mut samples = Vec::with_capacity(position.len());
    for row in 0..position.len() {
        let way = direction.as_ref().map_or(1.0, |direction| direction[row]);
        let Some(direction) = direction_of(way) else {
            return Err(anyhow!("direction {way}, expected 1 or -1").context(series.place(row)));
        };
        let cutting = idle.as_ref().is_none_or(|idle| idle[row].abs() < 0.5);
        let known = position[row].is_finite() && error[row].is_finite();
        if cutting && known {
            let position_mm = position[row] - origin_mm;
            samples.push(ErrorSample { position_mm, error_um: error[row], direction });
        }
    }
    Ok(samples)
}

/// What turns has the same figures in another unit, which `import` cannot change.
fn refuse_angles(path: &Path, series: &Series) -> anyhow::Result<()> {
    let has = |name| series.optional(name).map(|column| column.is_some());
    if has("position_mm")? || !has("angle_rev")? {
        return Ok(());
    }
    bail!(
        "{}: `angle_rev` of an axis that turns, expected `position_mm` of one that goes straight\n\n\
         hint: ISO 230-2 has the same figures for both: with degrees as `position_mm` and \
         arc-seconds as `error_um`, every µm printed is an arc-second",
        path.display()
    )
}

fn direction_of(way: f64) -> Option<Direction> {
    match way {
        1.0 => Some(Direction::Forward),
        -1.0 => Some(Direction::Backward),
        _ => None,
    }
}

/// Errors of offset-binary codes of the 8-bit converter, µm.
fn decoded(series: &Series, codes: &[f64], detector: &Detector) -> anyhow::Result<Vec<f64>> {
    let mut errors_um = Vec::with_capacity(codes.len());
    for (row, &code) in codes.iter().enumerate() {
        if code.is_nan() {
            errors_um.push(f64::NAN);
        } else if (0.0..=255.0).contains(&code) && code.fract().abs() < 1e-9 {
            #[expect(clippy::cast_possible_truncation, reason = "checked to be of eight bits")]
            let signed = (code - 128.0) as i8;
            errors_um.push(detector.difference_um(signed));
        } else {
            let refused = anyhow!("code {code}, expected a whole number from 0 to 255");
            return Err(refused.context(series.place(row)));
        }
    }
    Ok(errors_um)
}

/// ISO 230-2 of errors, as [`targets`] has them.
pub(crate) fn axis_result(
    errors: impl Iterator<Item = (ErrorSample, f64)>,
) -> Result<AxisResult, Error> {
    evaluate_axis(&targets(errors))
}

/// Approaches of targets; samples at one position (to a nanometre) are approaches of one target.
///
/// The standard's deviation is actual less target: the opposite of what the scale shows too much.
pub(crate) fn targets(errors: impl Iterator<Item = (ErrorSample, f64)>) -> Vec<Target> {
    let mut sorted: Vec<(ErrorSample, f64)> = errors.collect();
    sorted.sort_by(|a, b| a.0.position_mm.total_cmp(&b.0.position_mm));
    let same =
        |a: &(ErrorSample, f64), b: &(ErrorSample, f64)| b.0.position_mm - a.0.position_mm < 1e-6;
    let target = |group: &[(ErrorSample, f64)]| {
        let side = |direction: Direction| {
            group.iter().filter(|(s, _)| s.direction == direction).map(|(_, um)| -um).collect()
        };
        Target {
            at_mm: group[0].0.position_mm,
            forward_um: side(Direction::Forward),
            backward_um: side(Direction::Backward),
        }
    };
    sorted.chunk_by(same).map(target).collect()
}
