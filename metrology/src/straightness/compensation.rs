//! The correction table, and what correcting by it would give.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::reference_line::straightness;
use super::separated::Separated;
use crate::drawn::normal;
use crate::number::number;

/// One row of a correction table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CorrectionPoint {
    /// Carriage position, mm.
    pub position_mm: f64,
    /// What the tool is moved by, µm: minus the error expected there.
    pub correction_um: f64,
}

/// What a simulated compensation is told, all of it printed with the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompensationModel {
    /// Part of the carriage motion that differs from pass to pass, standard deviation, µm.
    pub unrepeatable_um: f64,
    /// Length over which that part stays alike, mm.
    pub correlation_mm: f64,
    /// Standard uncertainty of the measured profile, µm.
    pub measurement_um: f64,
    /// Smallest motion of the corrector, µm; zero for none.
    pub corrector_step_um: f64,
    /// Step of the correction table, mm.
    pub table_step_mm: f64,
    /// Passes simulated.
    pub passes: u32,
    /// Seed of chance.
    pub seed: u64,
}

/// Straightness before and after, mean over the passes, µm by the least-squares line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompensationOutcome {
    /// Before.
    pub before_um: f64,
    /// After.
    pub after_um: f64,
    /// `100·(1 − after/before)`.
    pub improvement_pct: f64,
    /// After, were the carriage to repeat itself.
    pub after_if_repeatable_um: f64,
    /// After, were the measurement free of noise.
    pub after_if_measured_exactly_um: f64,
    /// After, were the corrector to move without steps.
    pub after_if_stepless_um: f64,
}

/// The correction at every `step_mm` along the bar.
///
/// The bar was cut by the carriage it was measured on, so its own error is what to expect of the
/// next cut. It is smoothed over three samples, as document 2 smooths before it interpolates,
/// interpolated linearly, and its sign reversed.
#[must_use]
pub fn correction_table(separated: &Separated, step_mm: f64) -> Vec<CorrectionPoint> {
    let smooth_um = smoothed(&separated.workpiece_um);
    table(&separated.position_mm, &smooth_um, step_mm)
}

/// What correcting the next cut would give, and what limits it.
///
/// Each pass draws two independent motions of the carriage about the measured form: the one the
/// correction is taken from and the one it is applied to. What repeats is corrected, what does
/// not is cut twice.
#[must_use]
pub fn simulate_compensation(
    separated: &Separated,
    model: &CompensationModel,
) -> CompensationOutcome {
    let after = |model: CompensationModel| mean_straightness(separated, &model);
    let (before_um, after_um) = after(*model);
    CompensationOutcome {
        before_um,
        after_um,
        improvement_pct: 100.0 * (1.0 - after_um / before_um),
        after_if_repeatable_um: after(CompensationModel { unrepeatable_um: 0.0, ..*model }).1,
        after_if_measured_exactly_um: after(CompensationModel { measurement_um: 0.0, ..*model }).1,
        after_if_stepless_um: after(CompensationModel { corrector_step_um: 0.0, ..*model }).1,
    }
}

fn mean_straightness(separated: &Separated, model: &CompensationModel) -> (f64, f64) {
    let mut chance = ChaCha8Rng::seed_from_u64(model.seed);
    let (mut before_um, mut after_um) = (0.0, 0.0);
    for _ in 0..model.passes {
        let (before, after) = one_pass(separated, model, &mut chance);
        before_um += before;
        after_um += after;
    }
    (before_um / f64::from(model.passes), after_um / f64::from(model.passes))
}

/// Straightness of a bar cut without correction and of the next one cut with it.
fn one_pass(
    separated: &Separated,
    model: &CompensationModel,
    chance: &mut ChaCha8Rng,
) -> (f64, f64) {
    let x_mm = &separated.position_mm;
    let form_um = &separated.workpiece_um;
    let cut =
        |wander: Vec<f64>| -> Vec<f64> { form_um.iter().zip(wander).map(|(f, w)| f + w).collect() };
    let first_um = cut(wander(x_mm, model, chance));
    let noise: Vec<f64> = x_mm.iter().map(|_| normal(chance) * model.measurement_um).collect();
    let seen_um: Vec<f64> = first_um.iter().zip(&noise).map(|(cut, noise)| cut + noise).collect();
    let corrections = table(x_mm, &smoothed(&seen_um), model.table_step_mm);
    let next_um = cut(wander(x_mm, model, chance));
    let corrected: Vec<f64> = next_um
        .iter()
        .zip(x_mm)
        .map(|(cut, &x)| cut + stepped(looked_up(&corrections, x), model.corrector_step_um))
        .collect();
    (peak_to_valley(x_mm, &first_um), peak_to_valley(x_mm, &corrected))
}

fn peak_to_valley(x_mm: &[f64], height_um: &[f64]) -> f64 {
    straightness(x_mm, height_um).map_or(0.0, |lines| lines.least_squares.error_um)
}

/// A first-order random process along the stroke.
fn wander(x_mm: &[f64], model: &CompensationModel, chance: &mut ChaCha8Rng) -> Vec<f64> {
    let mut value_um = normal(chance) * model.unrepeatable_um;
    let mut previous_mm = x_mm.first().copied().unwrap_or(0.0);
    let mut walk = Vec::with_capacity(x_mm.len());
    for &x in x_mm {
        let kept = libm::exp(-(x - previous_mm) / model.correlation_mm);
        let fresh = (1.0 - kept * kept).sqrt() * model.unrepeatable_um;
        value_um = kept * value_um + fresh * normal(chance);
        walk.push(value_um);
        previous_mm = x;
    }
    walk
}

fn stepped(value_um: f64, step_um: f64) -> f64 {
    if 0.0 < step_um { (value_um / step_um).round() * step_um } else { value_um }
}

/// Mean of three neighbours; the ends keep what they have.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let middle = |three: &[f64]| (three[0] + three[1] + three[2]) / 3.0;
    let ends = (values.first().copied(), values.last().copied());
    ends.0.into_iter().chain(values.windows(3).map(middle)).chain(ends.1).collect()
}

/// Minus the values, linearly interpolated at every step of the table.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a stroke holds few table steps"
)]
fn table(x_mm: &[f64], values_um: &[f64], step_mm: f64) -> Vec<CorrectionPoint> {
    let (Some(&first), Some(&last)) = (x_mm.first(), x_mm.last()) else { return Vec::new() };
    let rows = ((last - first) / step_mm + 1e-9).floor() as usize;
    let row = |index: usize| {
        let position_mm = first + number(index) * step_mm;
        let after = x_mm.partition_point(|&x| x < position_mm).clamp(1, x_mm.len() - 1);
        let (x0, x1) = (x_mm[after - 1], x_mm[after]);
        let part = (position_mm - x0) / (x1 - x0);
        let value = values_um[after - 1] + (values_um[after] - values_um[after - 1]) * part;
        CorrectionPoint { position_mm, correction_um: -value }
    };
    (0..=rows).map(row).collect()
}

/// The nearest row of a table.
fn looked_up(table: &[CorrectionPoint], at_mm: f64) -> f64 {
    let after = table.partition_point(|row| row.position_mm < at_mm);
    let near = [after.checked_sub(1), Some(after)].into_iter().flatten();
    let rows = near.filter_map(|index| table.get(index));
    let distance = |row: &CorrectionPoint| (row.position_mm - at_mm).abs();
    let nearest = rows.min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.map_or(0.0, |row| row.correction_um)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn separated() -> Separated {
        let position_mm: Vec<f64> = (0..33).map(|k| f64::from(k) * 5.0).collect();
        let workpiece_um = position_mm.iter().map(|x| 0.5 * libm::sin(TAU * x / 120.0)).collect();
        Separated {
            position_mm,
            workpiece_um,
            carriage_um: vec![0.0; 33],
            tilt_urad: vec![0.0; 33],
            uncertainty_um: None,
            covariance_um2: None,
            otherwise: None,
        }
    }

    fn model() -> CompensationModel {
        CompensationModel {
            unrepeatable_um: 0.0,
            correlation_mm: 40.0,
            measurement_um: 0.0,
            corrector_step_um: 0.0,
            table_step_mm: 1.0,
            passes: 50,
            seed: 1,
        }
    }

    #[test]
    fn table_has_a_row_a_millimetre_and_the_opposite_sign() {
        let rows = correction_table(&separated(), 1.0);
        assert_eq!(rows.len(), 161);
        // 30 mm is the top of the sine; three-point smoothing takes 1 − cos(15°)·2/3 of it.
        assert!(
            (rows[30].correction_um + 0.5 * (1.0 + 2.0 * libm::cos(TAU / 24.0)) / 3.0).abs() < 1e-9
        );
    }

    #[test]
    fn a_repeatable_carriage_is_limited_by_smoothing_alone() {
        let outcome = simulate_compensation(&separated(), &model());
        assert!(95.0 < outcome.improvement_pct, "{outcome:?}");
    }

    #[test]
    fn what_does_not_repeat_limits_the_gain() {
        let wandering = CompensationModel { unrepeatable_um: 0.1, ..model() };
        let outcome = simulate_compensation(&separated(), &wandering);
        assert!(outcome.improvement_pct < 75.0, "{outcome:?}");
        assert!(outcome.after_if_repeatable_um < 0.2 * outcome.after_um, "{outcome:?}");
    }
}
