//! Joints between scales of 250 mm.
//!
//! Where two scales meet the slider lies on both, its reading passes from the one to the other,
//! and single samples there are poor. Within a zone about the joint the table is therefore not
//! taken from the samples but from what lies beside it: a straight line on each side, carried on
//! to the joint, and a steady passage between them.

use crate::number::number;

/// Where joints are and how far they reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRule {
    /// Length of one scale, mm (250 mm).
    pub every_mm: f64,
    /// First joint, mm from the origin pulse.
    pub first_mm: f64,
    /// Length about the joint whose samples are replaced, mm; zero keeps them all.
    pub zone_mm: f64,
}

/// What was found at a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Where it is, mm.
    pub at_mm: f64,
    /// Error just after it less error just before it, µm: how far the scales are apart.
    pub step_um: f64,
}

impl JointRule {
    /// The joints inside a curve of error against position, with the step at each.
    ///
    /// `curve` is sorted by position; a side with samples at fewer than two places gives no line and no joint.
    #[must_use]
    pub fn joints(&self, curve: &[(f64, f64)]) -> Vec<Joint> {
        let inside = self.places(curve);
        inside
            .filter_map(|at_mm| {
                let [before, after] = self.sides(curve, at_mm)?;
                Some(Joint { at_mm, step_um: after.at(at_mm) - before.at(at_mm) })
            })
            .collect()
    }

    fn places(&self, curve: &[(f64, f64)]) -> impl Iterator<Item = f64> {
        let (first, last) = match curve {
            [first, .., last] => (first.0, last.0),
            _ => (0.0, 0.0),
        };
        // Scales that are hardly as long as a sample have no joints worth the name.
        let long_enough = (last - first) / 10_000.0 < self.every_mm && 0.0 < self.every_mm;
        let every_mm = if long_enough { self.every_mm } else { f64::INFINITY };
        let before = ((first - self.first_mm) / every_mm).floor().max(0.0);
        let place = move |index: usize| self.first_mm + (before + number(index)) * every_mm;
        (0..).map(place).take_while(move |at| *at < last).filter(move |at| first < *at)
    }

    /// The straight lines on both sides of a joint.
    fn sides(&self, curve: &[(f64, f64)], at_mm: f64) -> Option<[Side; 2]> {
        let half = self.zone_mm / 2.0;
        // As far as the zone is long, but never less than a tenth of a scale.
        let reach = self.zone_mm.max(self.every_mm / 10.0);
        let chosen = |from: f64, to: f64| -> Vec<(f64, f64)> {
            curve.iter().copied().filter(|(x, _)| from <= *x && *x <= to).collect()
        };
        let before = chosen(at_mm - half - reach, (at_mm - half).min(at_mm - 1e-6));
        let after = chosen(at_mm + half, at_mm + half + reach);
        Some([Side::through(&before)?, Side::through(&after)?])
    }
}

/// Replaces the errors within each zone: the line before the joint passes steadily into the one
/// after it.
pub(super) fn bridge_joints(
    rule: &JointRule,
    curve: &[(f64, f64)],
    places: &[f64],
    errors_um: &mut [f64],
) {
    let half = rule.zone_mm / 2.0;
    for at_mm in rule.places(curve) {
        let Some([before, after]) = rule.sides(curve, at_mm) else { continue };
        for (&place, error) in places.iter().zip(errors_um.iter_mut()) {
            if (place - at_mm).abs() < half {
                let part = (place - at_mm + half) / rule.zone_mm;
                *error = before.at(place) * (1.0 - part) + after.at(place) * part;
            }
        }
    }
}

/// A straight line beside a joint.
struct Side {
    centre_mm: f64,
    height_um: f64,
    slope_um_per_mm: f64,
}

impl Side {
    /// The least-squares line through sorted samples; `None` unless they have two places.
    fn through(samples: &[(f64, f64)]) -> Option<Self> {
        let [first, .., last] = samples else { return None };
        if last.0 <= first.0 {
            return None;
        }
        let count = number(samples.len());
        let centre_mm = samples.iter().map(|(x, _)| x).sum::<f64>() / count;
        let height_um = samples.iter().map(|(_, y)| y).sum::<f64>() / count;
        let squares: f64 = samples.iter().map(|(x, _)| (x - centre_mm) * (x - centre_mm)).sum();
        let products: f64 = samples.iter().map(|(x, y)| (x - centre_mm) * (y - height_um)).sum();
        Some(Self { centre_mm, height_um, slope_um_per_mm: products / squares })
    }

    fn at(&self, at_mm: f64) -> f64 {
        self.height_um + self.slope_um_per_mm * (at_mm - self.centre_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULE: JointRule = JointRule { every_mm: 250.0, first_mm: 250.0, zone_mm: 20.0 };

    /// Two scales 3 µm apart, with nonsense within 5 mm of the joint.
    fn curve() -> Vec<(f64, f64)> {
        let error = |x: f64| {
            if (x - 250.0).abs() < 5.0 {
                40.0
            } else if x < 250.0 {
                0.01 * x
            } else {
                3.0 + 0.01 * x
            }
        };
        (0..=500).map(|k| (f64::from(k), error(f64::from(k)))).collect()
    }

    /// Both ways over one target beside the joint: its samples are at one place.
    #[test]
    fn one_place_makes_no_line() {
        let curve: Vec<_> = [0.0, 240.0, 240.0, 260.0, 265.0, 500.0].map(|x| (x, 1.0)).into();
        assert!(RULE.joints(&curve).is_empty());
        let two: Vec<_> = [0.0, 235.0, 240.0, 260.0, 265.0, 500.0].map(|x| (x, 1.0)).into();
        assert_eq!(RULE.joints(&two), [Joint { at_mm: 250.0, step_um: 0.0 }]);
    }

    #[test]
    fn the_step_is_found_beside_the_zone() {
        let joints = RULE.joints(&curve());
        assert_eq!(joints.len(), 1, "500 mm is the end, not a joint");
        assert!((joints[0].step_um - 3.0).abs() < 1e-9);
    }

    #[test]
    fn the_zone_is_bridged_steadily() {
        let curve = curve();
        let places: Vec<f64> = curve.iter().map(|(x, _)| *x).collect();
        let mut errors: Vec<f64> = curve.iter().map(|(_, y)| *y).collect();
        bridge_joints(&RULE, &curve, &places, &mut errors);
        assert!((errors[250] - 4.0).abs() < 1e-9, "half way from 2.5 to 5.5: {}", errors[250]);
        assert!(errors.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.17));
    }
}
