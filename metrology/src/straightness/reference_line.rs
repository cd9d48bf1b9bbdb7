//! Straightness against three reference lines.

use crate::number::number;

/// A line `height = start_um + slope·(x − x₀)`, `x₀` being the first place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Height at the first place, µm.
    pub start_um: f64,
    /// Slope, µm/mm.
    pub slope_um_per_mm: f64,
}

/// Straightness by one reference line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Straightness {
    /// The reference line.
    pub line: Line,
    /// Highest less lowest distance from it, µm.
    pub error_um: f64,
    /// Where the highest point lies, mm.
    pub highest_mm: f64,
    /// Where the lowest point lies, mm.
    pub lowest_mm: f64,
}

/// Straightness by all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightnessLines {
    /// By the least-squares line.
    pub least_squares: Straightness,
    /// By the line through both ends.
    pub end_points: Straightness,
    /// By the narrowest pair of parallel lines: never wider than the others.
    pub minimum_zone: Straightness,
}

/// Straightness of a profile by three reference lines.
///
/// Distances are taken along the height, as the slope is far below 1e-3. The minimum zone is
/// exact: the narrowest pair of lines touches the convex hull along one of its edges, and the
/// width is a convex function of the slope, so the best edge is found by bisection.
///
/// `x_mm` must increase and be as long as `height_um`, two places or more; `None` otherwise.
#[must_use]
pub fn straightness(x_mm: &[f64], height_um: &[f64]) -> Option<StraightnessLines> {
    if x_mm.len() != height_um.len() || !x_mm.is_sorted_by(|a, b| a < b) {
        return None;
    }
    let (first, last) = (*x_mm.first()?, *x_mm.last()?);
    if x_mm.len() < 2 {
        return None;
    }
    let run = |slope: f64| measured(x_mm, height_um, slope);
    let chord = (height_um[height_um.len() - 1] - height_um[0]) / (last - first);
    let (least_squares, middle) = (least_squares_slope(x_mm, height_um), f64::midpoint);
    let mut lines = StraightnessLines {
        least_squares: run(least_squares),
        end_points: run(chord),
        minimum_zone: run(minimum_zone_slope(x_mm, height_um)),
    };
    let mean_x = x_mm.iter().sum::<f64>() / number(x_mm.len());
    let mean_y = height_um.iter().sum::<f64>() / number(x_mm.len());
    lines.least_squares.line.start_um = mean_y - least_squares * (mean_x - first);
    lines.end_points.line.start_um = height_um[0];
    let zone = &mut lines.minimum_zone;
    let distance = |x: f64| height_at(x_mm, height_um, x) - zone.line.slope_um_per_mm * (x - first);
    zone.line.start_um = middle(distance(zone.highest_mm), distance(zone.lowest_mm));
    Some(lines)
}

fn height_at(x_mm: &[f64], height_um: &[f64], at_mm: f64) -> f64 {
    height_um[x_mm.partition_point(|&x| x < at_mm)]
}

/// Highest and lowest distance from a line of a slope; its start is left at zero.
fn measured(x_mm: &[f64], height_um: &[f64], slope_um_per_mm: f64) -> Straightness {
    let distances =
        x_mm.iter().zip(height_um).map(|(x, y)| (*x, y - slope_um_per_mm * (x - x_mm[0])));
    let start = (x_mm[0], height_um[0]);
    let (mut highest, mut lowest) = (start, start);
    for (x, distance) in distances {
        if highest.1 < distance {
            highest = (x, distance);
        }
        if distance < lowest.1 {
            lowest = (x, distance);
        }
    }
    Straightness {
        line: Line { start_um: 0.0, slope_um_per_mm },
        error_um: highest.1 - lowest.1,
        highest_mm: highest.0,
        lowest_mm: lowest.0,
    }
}

fn least_squares_slope(x_mm: &[f64], height_um: &[f64]) -> f64 {
    let mean_x = x_mm.iter().sum::<f64>() / number(x_mm.len());
    let mean_y = height_um.iter().sum::<f64>() / number(x_mm.len());
    let (mut squares, mut products) = (0.0, 0.0);
    for (x, y) in x_mm.iter().zip(height_um) {
        squares += (x - mean_x) * (x - mean_x);
        products += (x - mean_x) * (y - mean_y);
    }
    products / squares
}

/// The slope of the hull edge with the narrowest zone.
fn minimum_zone_slope(x_mm: &[f64], height_um: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> = x_mm.iter().copied().zip(height_um.iter().copied()).collect();
    let (upper, lower) = (hull(&points, 1.0), hull(&points, -1.0));
    let slopes = |chain: &[(f64, f64)]| -> Vec<f64> {
        chain.windows(2).map(|p| (p[1].1 - p[0].1) / (p[1].0 - p[0].0)).collect()
    };
    let mut candidates = [slopes(&upper), slopes(&lower)].concat();
    candidates.sort_by(f64::total_cmp);
    let extreme = |chain: &[(f64, f64)], sign: f64, slope: f64| {
        chain.iter().map(|(x, y)| sign * (y - slope * x)).fold(f64::NEG_INFINITY, f64::max)
    };
    let width = |slope: f64| extreme(&upper, 1.0, slope) + extreme(&lower, -1.0, slope);
    // Convex: the width falls towards the best candidate and rises after it.
    let (mut low, mut high) = (0, candidates.len() - 1);
    while low < high {
        let middle = usize::midpoint(low, high);
        if width(candidates[middle + 1]) < width(candidates[middle]) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    candidates[low]
}

/// Upper (`side` 1) or lower (`side` −1) convex hull, from left to right (Andrew 1979).
fn hull(points: &[(f64, f64)], side: f64) -> Vec<(f64, f64)> {
    let mut chain: Vec<(f64, f64)> = Vec::new();
    for &point in points {
        while let [.., a, b] = chain[..] {
            let turn = (b.0 - a.0) * (point.1 - a.1) - (b.1 - a.1) * (point.0 - a.0);
            if side * turn < 0.0 {
                break;
            }
            chain.pop();
        }
        chain.push(point);
    }
    chain
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A triangle: both ends at 0, the top at 4 in the middle.
    #[test]
    fn triangle_by_hand() {
        let lines = straightness(&[0.0, 1.0, 2.0], &[0.0, 4.0, 0.0]).unwrap();
        assert!((lines.end_points.error_um - 4.0).abs() < 1e-12);
        assert!((lines.minimum_zone.error_um - 4.0).abs() < 1e-12);
        assert!((lines.minimum_zone.line.start_um - 2.0).abs() < 1e-12);
    }

    /// ISO 1101's principle: three points touch alternately. Here 0, 3, −1, 2: by hand the zone
    /// through (1,3) and (3,2) above and (2,−1) below is 3.5 wide.
    #[test]
    fn alternating_profile_by_hand() {
        let lines = straightness(&[0.0, 1.0, 2.0, 3.0], &[0.0, 3.0, -1.0, 2.0]).unwrap();
        assert!((lines.minimum_zone.error_um - 3.5).abs() < 1e-12, "{lines:?}");
    }

    proptest! {
        /// Second implementation: the width at 4001 slopes about the best one is never smaller.
        #[test]
        fn minimum_zone_is_the_minimum(
            heights in prop::collection::vec(-5.0..5.0f64, 2..40),
            tilt in -1.0..1.0f64,
        ) {
            let x: Vec<f64> = (0..heights.len()).map(number).collect();
            let tilted: Vec<f64> = x.iter().zip(&heights).map(|(x, y)| y + tilt * x + 7.0).collect();
            let lines = straightness(&x, &tilted).unwrap();
            let zone = lines.minimum_zone;
            for step in -2000..=2000 {
                let slope = zone.line.slope_um_per_mm + f64::from(step) * 0.005;
                prop_assert!(zone.error_um <= measured(&x, &tilted, slope).error_um + 1e-9);
            }
            prop_assert!(zone.error_um <= lines.least_squares.error_um + 1e-9);
            prop_assert!(zone.error_um <= lines.end_points.error_um + 1e-9);
            let untilted = straightness(&x, &heights).unwrap();
            prop_assert!((untilted.minimum_zone.error_um - zone.error_um).abs() < 1e-9);
        }
    }
}
