//! A slope that is exactly a wrong number in the machine file.

use helixlock_plant::{Entry, Term};

use super::settings::alternatives;
use super::trial::{Trial, gain_at};
use crate::model::{Columns, Component, Stage};
use crate::numerics::{Looks, count};
use crate::policy::chance::EXACT_STANDARD_ERRORS;
use crate::policy::evidence::{EXACT_SLOPE, NORMAL_WIDTH, PHYSICAL_UM_PER_M};

/// The setting that fits a slope best, if one does to within four standard errors.
///
/// An exact ratio that happens to fit is worth more than a free slope: the fewer of them lie
/// within the error, the more.
#[must_use]
pub(crate) fn setting_trials(stage: &Stage<'_>) -> Option<Trial> {
    let problem = stage.problem;
    let metres: Vec<f64> = problem.record.position_mm.iter().map(|place| place / 1000.0).collect();
    let slope = Columns::free(vec![problem.column(Entry::AngleReference, &metres)]);
    let free = stage.gain(&slope);
    let (value, stderr) = (free.fit.coefficients[0], free.fit.covariance[(0, 0)].sqrt());
    if !value.is_finite() || stderr <= 0.0 || value.abs() < EXACT_STANDARD_ERRORS * stderr {
        return None;
    }
    let all = alternatives(&problem.model);
    let tried = count(all.len());
    let near = |setting: &Term| {
        let slope = slope_um_per_m(stage, setting)?;
        // A slope can pass for slow noise, and then its standard error is no measure.
        let tolerance =
            (EXACT_STANDARD_ERRORS * stderr).min(PHYSICAL_UM_PER_M) + EXACT_SLOPE * slope.abs();
        ((slope - value).abs() < tolerance).then(|| setting.clone())
    };
    all.iter()
        .filter_map(near)
        .map(Component::new)
        .filter_map(|component| {
            let gain = gain_at(stage, &component)?.gain;
            let looks = Looks::at_places(tried * NORMAL_WIDTH * stderr / PHYSICAL_UM_PER_M);
            let coefficients = Vec::new();
            Some(Trial { component, gain, looks: Some(looks), choices: 1.0, coefficients })
        })
        .max_by(|a, b| a.gain.total_cmp(&b.gain))
}

/// Slope a setting leaves, from its effect one metre along.
fn slope_um_per_m(stage: &Stage<'_>, setting: &Term) -> Option<f64> {
    let record = &stage.problem.record;
    let effect = setting.effect(&stage.problem.model, &record.columns).ok()?;
    let mut now = record.instant(0);
    let at = |now: &helixlock_plant::Instant<'_>| helixlock_plant::Effect::delta_um(&effect, now);
    now.position_mm = 0.0;
    let start = at(&now);
    now.position_mm = 1000.0;
    Some(at(&now) - start)
}
