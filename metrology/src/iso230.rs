//! Positioning accuracy of an axis by ISO 230-2.
//!
//! Targets are approached several times from each side; each approach leaves one deviation
//! (actual less target position, µm). Usable on its own: it knows no scale and no compensation.

use crate::Error;
use crate::number::{mean, number};

pub mod coverage;
mod cycles;
mod drift;
mod figures;
mod noise;

pub use figures::{Approaches, Figure};

/// Approaches of one target.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Target position, mm.
    pub at_mm: f64,
    /// Deviations of the approaches towards larger positions, µm.
    pub forward_um: Vec<f64>,
    /// Deviations of the approaches towards smaller positions, µm; empty for a unidirectional test.
    pub backward_um: Vec<f64>,
}

/// What is found at one target, all in µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetResult {
    /// Target position, mm.
    pub at_mm: f64,
    /// Mean of the forward approaches.
    pub mean_forward_um: f64,
    /// Mean of the backward approaches; absent in a unidirectional test.
    pub mean_backward_um: Option<f64>,
    /// Standard uncertainty estimator s↑ (n − 1 in the denominator).
    pub s_forward_um: f64,
    /// s↓.
    pub s_backward_um: Option<f64>,
    /// Reversal value B = mean↑ − mean↓.
    pub reversal_um: Option<f64>,
    /// Bidirectional repeatability R = max(2s↑ + 2s↓ + |B|, 4s↑, 4s↓); 4s↑ when unidirectional.
    pub repeatability_um: f64,
}

/// What is found for the axis, all in µm.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisResult {
    /// Each target, in order of position.
    pub targets: Vec<TargetResult>,
    /// Accuracy A = max(mean + 2s) − min(mean − 2s) over both directions.
    pub accuracy_um: f64,
    /// Unidirectional accuracies A↑ and A↓.
    pub accuracy_unidirectional_um: [Option<f64>; 2],
    /// Systematic positioning error E = max − min of all unidirectional means.
    pub systematic_um: f64,
    /// Unidirectional systematic errors E↑ and E↓.
    pub systematic_unidirectional_um: [Option<f64>; 2],
    /// Range M of the bidirectional means.
    pub mean_range_um: f64,
    /// Largest reversal value |B|.
    pub reversal_um: Option<f64>,
    /// Mean reversal value B̄, with its sign.
    pub mean_reversal_um: Option<f64>,
    /// Largest repeatability R.
    pub repeatability_um: f64,
    /// Unidirectional repeatabilities R↑ and R↓: the largest 4s.
    pub repeatability_unidirectional_um: [Option<f64>; 2],
    /// The same approaches by VDI/DGQ 3441; absent in a unidirectional test.
    pub vdi3441: Option<Vdi3441>,
}

/// Figures of VDI/DGQ 3441 (1977), all in µm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vdi3441 {
    /// Positional uncertainty P = max(x̄ⱼ + (Uⱼ + Psⱼ)/2) − min(x̄ⱼ − (Uⱼ + Psⱼ)/2).
    pub uncertainty_um: f64,
    /// Positional deviation Pa: range of the means x̄ⱼ of both directions.
    pub deviation_um: f64,
    /// Reversal span U: the largest and the mean of Uⱼ = |x̄ⱼ↑ − x̄ⱼ↓|.
    pub reversal_um: [f64; 2],
    /// Positional scatter Ps: the largest and the mean of Psⱼ = 6·(sⱼ↑ + sⱼ↓)/2.
    pub scatter_um: [f64; 2],
}

/// Evaluates an axis.
///
/// Source: ISO 230-2:2014, clause 2 and 4. It asks for five approaches; two are enough for the
/// formulas, so fewer than five are evaluated and it is for the caller to say so.
///
/// # Errors
///
/// When there is no target, a deviation is not finite, a target has one approach only, or some
/// targets have backward approaches and others none.
pub fn evaluate_axis(targets: &[Target]) -> Result<AxisResult, Error> {
    if targets.is_empty() {
        return Err(Error::TooFewSamples { found: 0, expected: 1 });
    }
    let bidirectional = targets.iter().any(|target| !target.backward_um.is_empty());
    let mut results = Vec::with_capacity(targets.len());
    for target in targets {
        results.push(evaluate_target(target, bidirectional)?);
    }
    results.sort_by(|a, b| a.at_mm.total_cmp(&b.at_mm));
    Ok(axis_of(results))
}

/// What is found for the axis from what is found at its targets, in order of position.
fn axis_of(results: Vec<TargetResult>) -> AxisResult {
    let bidirectional = results.iter().any(|target| target.reversal_um.is_some());
    let forward = |t: &TargetResult| Some((t.mean_forward_um, t.s_forward_um));
    let backward = |t: &TargetResult| t.mean_backward_um.zip(t.s_backward_um);
    let upward: Vec<_> = results.iter().filter_map(forward).collect();
    let downward: Vec<_> = results.iter().filter_map(backward).collect();
    let both = [upward.as_slice(), downward.as_slice()].concat();
    let middle = |t: &TargetResult| {
        t.mean_backward_um.map_or(t.mean_forward_um, |back| f64::midpoint(t.mean_forward_um, back))
    };
    let reversals: Vec<f64> = results.iter().filter_map(|t| t.reversal_um).collect();
    let of_backward = |figure: f64| bidirectional.then_some(figure);
    AxisResult {
        accuracy_um: range(&both, 2.0),
        accuracy_unidirectional_um: [Some(range(&upward, 2.0)), of_backward(range(&downward, 2.0))],
        systematic_um: range(&both, 0.0),
        systematic_unidirectional_um: [
            Some(range(&upward, 0.0)),
            of_backward(range(&downward, 0.0)),
        ],
        mean_range_um: range(&results.iter().map(|t| (middle(t), 0.0)).collect::<Vec<_>>(), 0.0),
        reversal_um: reversals.iter().map(|reversal| reversal.abs()).max_by(f64::total_cmp),
        mean_reversal_um: of_backward(mean(&reversals)),
        repeatability_um: results.iter().map(|t| t.repeatability_um).fold(0.0, f64::max),
        repeatability_unidirectional_um: [
            Some(4.0 * largest_s(&upward)),
            of_backward(4.0 * largest_s(&downward)),
        ],
        vdi3441: vdi3441(&results),
        targets: results,
    }
}

fn vdi3441(targets: &[TargetResult]) -> Option<Vdi3441> {
    let (mut means, mut bands, mut reversals, mut scatters) = (vec![], vec![], vec![], vec![]);
    for target in targets {
        let (back_um, s_back_um) = (target.mean_backward_um?, target.s_backward_um?);
        let mean_um = f64::midpoint(target.mean_forward_um, back_um);
        let reversal_um = (target.mean_forward_um - back_um).abs();
        let scatter_um = 6.0 * f64::midpoint(target.s_forward_um, s_back_um);
        means.push((mean_um, 0.0));
        bands.push((mean_um, f64::midpoint(reversal_um, scatter_um)));
        reversals.push(reversal_um);
        scatters.push(scatter_um);
    }
    let largest_and_mean = |all: &[f64]| [all.iter().copied().fold(0.0, f64::max), mean(all)];
    Some(Vdi3441 {
        uncertainty_um: range(&bands, 1.0),
        deviation_um: range(&means, 0.0),
        reversal_um: largest_and_mean(&reversals),
        scatter_um: largest_and_mean(&scatters),
    })
}

fn largest_s(means: &[(f64, f64)]) -> f64 {
    means.iter().map(|(_, s)| *s).fold(0.0, f64::max)
}

fn evaluate_target(target: &Target, bidirectional: bool) -> Result<TargetResult, Error> {
    let (mean_forward_um, s_forward_um) = mean_and_s(target, &target.forward_um)?;
    let mut result = TargetResult {
        at_mm: target.at_mm,
        mean_forward_um,
        mean_backward_um: None,
        s_forward_um,
        s_backward_um: None,
        reversal_um: None,
        repeatability_um: 4.0 * s_forward_um,
    };
    if bidirectional {
        let (mean_um, s_um) = mean_and_s(target, &target.backward_um)?;
        let reversal_um = mean_forward_um - mean_um;
        let across_um = 2.0 * s_forward_um + 2.0 * s_um + reversal_um.abs();
        result.repeatability_um = across_um.max(4.0 * s_forward_um).max(4.0 * s_um);
        result.mean_backward_um = Some(mean_um);
        result.s_backward_um = Some(s_um);
        result.reversal_um = Some(reversal_um);
    }
    Ok(result)
}

fn mean_and_s(target: &Target, deviations_um: &[f64]) -> Result<(f64, f64), Error> {
    let found = deviations_um.len();
    if found < 2 {
        return Err(Error::TooFewRepeats { at_mm: target.at_mm, found, expected: 2 });
    }
    if let Some(row) = deviations_um.iter().position(|value| !value.is_finite()) {
        return Err(Error::NotFinite { row, column: "deviation" });
    }
    let mean_um = mean(deviations_um);
    let squares = deviations_um.iter().map(|value| (value - mean_um) * (value - mean_um));
    Ok((mean_um, (squares.sum::<f64>() / number(found - 1)).sqrt()))
}

/// Highest of `mean + k·s` less lowest of `mean − k·s`.
fn range(means: &[(f64, f64)], k: f64) -> f64 {
    let highest = means.iter().map(|(mean, s)| mean + k * s).fold(f64::NEG_INFINITY, f64::max);
    let lowest = means.iter().map(|(mean, s)| mean - k * s).fold(f64::INFINITY, f64::min);
    highest - lowest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two targets whose figures follow by hand.
    fn by_hand() -> AxisResult {
        let targets = [
            Target { at_mm: 100.0, forward_um: vec![1.0, 3.0], backward_um: vec![-1.0, -1.0] },
            Target { at_mm: 0.0, forward_um: vec![0.0, 0.0], backward_um: vec![-2.0, -4.0] },
        ];
        evaluate_axis(&targets).unwrap()
    }

    #[test]
    fn figures_by_hand() {
        let found = by_hand();
        let s = 2.0_f64.sqrt();
        assert_eq!(found.targets[0].at_mm, 0.0);
        assert!((found.systematic_um - 5.0).abs() < 1e-12, "means 2, −1, 0, −3");
        assert!((found.mean_range_um - 2.0).abs() < 1e-12, "middles 0.5 and −1.5");
        assert_eq!(found.reversal_um, Some(3.0));
        // At either target s is √2 in one direction and 0 in the other, |B| = 3.
        let repeatability_um = (2.0 * s + 3.0).max(4.0 * s);
        assert!((found.repeatability_um - repeatability_um).abs() < 1e-12);
        assert!((found.accuracy_um - (2.0 + 2.0 * s - (-3.0 - 2.0 * s))).abs() < 1e-12);
    }

    #[test]
    fn unidirectional_accuracy_by_hand() {
        let found = by_hand();
        let s = 2.0_f64.sqrt();
        // Upward: mean 0 with s 0, mean 2 with s √2; the lower bound is min(0, 2 − 2√2).
        let upward_um = 2.0 + 2.0 * s - (2.0 - 2.0 * s).min(0.0);
        assert!((found.accuracy_unidirectional_um[0].unwrap() - upward_um).abs() < 1e-12);
    }

    #[test]
    fn the_other_figures_by_hand() {
        let (found, s) = (by_hand(), 2.0_f64.sqrt());
        assert_eq!(found.systematic_unidirectional_um, [Some(2.0), Some(2.0)]);
        assert_eq!(found.repeatability_unidirectional_um, [Some(4.0 * s), Some(4.0 * s)]);
        assert_eq!(found.mean_reversal_um, Some(3.0));
        let vdi = found.vdi3441.unwrap();
        assert_eq!((vdi.deviation_um, vdi.reversal_um), (2.0, [3.0, 3.0]));
        // Ps is 6·√2/2 at either target; the means are 0.5 and −1.5.
        assert!((vdi.scatter_um[0] - 3.0 * s).abs() < 1e-12, "{vdi:?}");
        assert!((vdi.uncertainty_um - (2.0 + 3.0 + 3.0 * s)).abs() < 1e-12, "{vdi:?}");
    }

    #[test]
    fn one_approach_is_refused_with_its_place() {
        let target = Target { at_mm: 7.0, forward_um: vec![1.0], backward_um: vec![] };
        let error = evaluate_axis(&[target]).unwrap_err();
        assert!(matches!(error, Error::TooFewRepeats { found: 1, .. }), "{error}");
    }
}
