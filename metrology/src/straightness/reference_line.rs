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
/// exact: the narrowest pair of lines touches the convex hull along one of its edges and at a
/// vertex opposite (Houle and Toussaint 1988, "Computing the width of a set"). It is never
/// wider than the zones of the other lines, not even by rounding.
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
    let (squares, middle) = (least_squares_slope(x_mm, height_um), f64::midpoint);
    let (least_squares, end_points) = (run(squares), run(chord));
    let narrowest = run(minimum_zone_slope(x_mm, height_um));
    let narrower = |a: Straightness, b: Straightness| if b.error_um < a.error_um { b } else { a };
    let minimum_zone = narrower(narrower(narrowest, least_squares), end_points);
    let mut lines = StraightnessLines { least_squares, end_points, minimum_zone };
    let mean_x = x_mm.iter().sum::<f64>() / number(x_mm.len());
    let mean_y = height_um.iter().sum::<f64>() / number(x_mm.len());
    lines.least_squares.line.start_um = mean_y - squares * (mean_x - first);
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
///
/// As the slope grows, the highest point moves along the upper hull from right to left and the
/// lowest along the lower hull from left to right, each at the slopes of its edges. The width
/// falls as fast as the highest point lies right of the lowest, so it is least where they pass.
fn minimum_zone_slope(x_mm: &[f64], height_um: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> = x_mm.iter().copied().zip(height_um.iter().copied()).collect();
    let (upper_edges, lower_edges) = (edges(&hull(&points, 1.0)), edges(&hull(&points, -1.0)));
    let (mut upper, mut lower) =
        (upper_edges.iter().rev().peekable(), lower_edges.iter().peekable());
    let (mut highest_mm, mut lowest_mm) = (x_mm[x_mm.len() - 1], x_mm[0]);
    let mut slope = 0.0;
    while lowest_mm < highest_mm {
        let above = upper.peek().map_or(f64::INFINITY, |edge| edge.slope);
        let below = lower.peek().map_or(f64::INFINITY, |edge| edge.slope);
        slope = above.min(below);
        if above <= below {
            highest_mm = upper.next().map_or(lowest_mm, |edge| edge.left_mm);
        } else {
            lowest_mm = lower.next().map_or(highest_mm, |edge| edge.right_mm);
        }
    }
    slope
}

/// An edge of a hull.
struct Edge {
    left_mm: f64,
    right_mm: f64,
    slope: f64,
}

/// The edges of a chain, from left to right.
fn edges(chain: &[(f64, f64)]) -> Vec<Edge> {
    let edge = |ends: &[(f64, f64)]| {
        let ((left_mm, from_um), (right_mm, to_um)) = (ends[0], ends[1]);
        Edge { left_mm, right_mm, slope: (to_um - from_um) / (right_mm - left_mm) }
    };
    chain.windows(2).map(edge).collect()
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
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

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

    /// Upper and lower hull have parallel edges; linear programming gives 0.450 µm.
    #[test]
    fn parallel_hull_edges_do_not_stop_the_search() {
        let heights = [0.2, 0.0, 0.4, 0.0, 0.4, 0.1, 0.6, 0.4, 0.6, 0.4, 0.5];
        let x: Vec<f64> = (0..11).map(|k| f64::from(k) * 20.0).collect();
        let lines = straightness(&x, &heights).unwrap();
        assert!((lines.minimum_zone.error_um - 0.45).abs() < 1e-12, "{lines:?}");
    }

    #[test]
    fn a_flat_profile_is_straight_by_every_line() {
        let lines = straightness(&[0.0, 1.0, 2.0, 5.0], &[0.3; 4]).unwrap();
        let zones = [lines.least_squares, lines.end_points, lines.minimum_zone];
        assert_eq!(zones.map(|zone| zone.error_um), [0.0; 3]);
    }

    /// Narrowest zone by linear programming: the least `t` with `|y − a − b·x| ≤ t/2`.
    fn by_linear_programming(x_mm: &[f64], height_um: &[f64]) -> f64 {
        use microlp::{ComparisonOp, OptimizationDirection, Problem};
        let mut problem = Problem::new(OptimizationDirection::Minimize);
        let anywhere = (f64::NEG_INFINITY, f64::INFINITY);
        let zone = problem.add_var(1.0, (0.0, f64::INFINITY));
        let (start, slope) = (problem.add_var(0.0, anywhere), problem.add_var(0.0, anywhere));
        for (x, y) in x_mm.iter().zip(height_um) {
            let line = [(start, 1.0), (slope, *x)];
            problem.add_constraint([line[0], line[1], (zone, 0.5)], ComparisonOp::Ge, *y);
            problem.add_constraint([line[0], line[1], (zone, -0.5)], ComparisonOp::Le, *y);
        }
        problem.solve().unwrap().solution().unwrap().objective()
    }

    /// 10⁴ profiles of 3 to 40 places as instruments print them, to 0.1 µm, so that hulls have
    /// parallel edges and flat tops.
    #[test]
    fn minimum_zone_is_that_of_linear_programming() {
        let mut chance = ChaCha8Rng::seed_from_u64(1101);
        for _ in 0..10_000 {
            let (places, size) = (chance.random_range(3..=40), chance.random_range(1..=40));
            let x: Vec<f64> = (0..places).map(|k| f64::from(k) * 20.0).collect();
            let tenths = (0..places).map(|_| f64::from(chance.random_range(0..=size)) / 10.0);
            let heights: Vec<f64> = tenths.collect();
            let lines = straightness(&x, &heights).unwrap();
            let zone_um = lines.minimum_zone.error_um;
            let expected_um = by_linear_programming(&x, &heights);
            assert!((zone_um - expected_um).abs() <= 1e-6, "{zone_um} {expected_um} {heights:?}");
            assert!(
                zone_um <= lines.least_squares.error_um && zone_um <= lines.end_points.error_um
            );
        }
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
