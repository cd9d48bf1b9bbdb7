//! Minimises a smooth function of few variables whose values are cheap side by side.
//!
//! Broyden, Fletcher, Goldfarb and Shanno's update of the inverse curvature, as in Nocedal and
//! Wright, *Numerical Optimization*, 2nd ed., algorithm 6.1; slopes by differences.

use nalgebra::{DMatrix, SMatrix, SVector, SymmetricEigen};

/// How far and how finely to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Descent {
    /// Most iterations.
    pub(crate) iterations: usize,
    /// Longest move of a variable in one of them.
    pub(crate) longest: f64,
    /// Stop when the next one promises less.
    pub(crate) tolerance: f64,
}

/// Distance over which a slope is taken, so short that no bend disturbs it.
const STEP: f64 = 1e-5;

/// Distance over which a curvature is taken, so long that rounding does not.
const WIDE: f64 = 3e-4;

/// Share of the promised descent that a move must keep.
const KEPT: f64 = 1e-4;

/// Shorter moves tried when one does not go down.
const SHORTER: usize = 5;

type Point<const D: usize> = SVector<f64, D>;

/// The lowest point found.
///
/// `values_at` gives the function at several points at once. Every choice is deterministic.
pub(crate) fn minimise<const D: usize>(
    mut values_at: impl FnMut(&[Point<D>]) -> Vec<f64>,
    start: Point<D>,
    descent: Descent,
) -> Point<D> {
    let (mut now, mut inverse) = first(&mut values_at, start, descent.longest);
    for _ in 0..descent.iterations {
        let mut along = -(inverse * now.slope);
        if 0.0 <= along.dot(&now.slope) {
            inverse = SMatrix::identity();
            along = -now.slope;
        }
        along *= (descent.longest / along.amax().max(f64::MIN_POSITIVE)).min(1.0);
        if -0.5 * along.dot(&now.slope) < descent.tolerance {
            break;
        }
        let Some(next) = lower(&mut values_at, &now, &along) else { break };
        let (step, bend) = (next.point - now.point, next.slope - now.slope);
        now = next;
        updated(&mut inverse, &step, &bend);
    }
    now.point
}

/// A point with the value and the slope there.
struct Place<const D: usize> {
    point: Point<D>,
    value: f64,
    slope: Point<D>,
}

fn moved<const D: usize>(point: &Point<D>, variable: usize, by: f64) -> Point<D> {
    let mut moved = *point;
    moved[variable] += by;
    moved
}

/// The start, and the inverse of its curvature.
fn first<const D: usize>(
    values_at: &mut impl FnMut(&[Point<D>]) -> Vec<f64>,
    point: Point<D>,
    longest: f64,
) -> (Place<D>, SMatrix<f64, D, D>) {
    let mut points = vec![point];
    for variable in 0..D {
        points.extend([moved(&point, variable, WIDE), moved(&point, variable, -WIDE)]);
    }
    let pairs: Vec<_> = (0..D).flat_map(|i| (0..i).map(move |j| (i, j))).collect();
    points.extend(pairs.iter().map(|&(i, j)| moved(&moved(&point, i, WIDE), j, WIDE)));
    let values = values_at(&points);
    let up = |variable: usize| values[1 + 2 * variable];
    let down = |variable: usize| values[2 + 2 * variable];
    let slope = Point::from_fn(|variable, _| (up(variable) - down(variable)) / (2.0 * WIDE));
    let square = WIDE * WIDE;
    let mut bend = DMatrix::from_fn(D, D, |i, _| (up(i) + down(i) - 2.0 * values[0]) / square);
    for (&(i, j), both) in pairs.iter().zip(&values[1 + 2 * D..]) {
        bend[(i, j)] = (both - up(i) - up(j) + values[0]) / square;
        bend[(j, i)] = bend[(i, j)];
    }
    (Place { point, value: values[0], slope }, inverse_of(bend, &slope, longest))
}

/// Inverse of a curvature that is made to bend upwards along each of its own directions, by the size
/// of how it bends (Nocedal and Wright, section 3.4), so much that none is followed too far.
fn inverse_of<const D: usize>(
    bend: DMatrix<f64>,
    slope: &Point<D>,
    longest: f64,
) -> SMatrix<f64, D, D> {
    let eigen = SymmetricEigen::new(bend);
    let mut inverse = SMatrix::<f64, D, D>::zeros();
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let vector = Point::<D>::from_iterator(vector.iter().copied());
        let least = slope.dot(&vector).abs() / longest;
        let size = value.abs().max(least).max(f64::MIN_POSITIVE.sqrt());
        inverse += vector * vector.transpose() / size;
    }
    inverse
}

/// A lower point along a direction; `None` when there is none near.
fn lower<const D: usize>(
    values_at: &mut impl FnMut(&[Point<D>]) -> Vec<f64>,
    now: &Place<D>,
    along: &Point<D>,
) -> Option<Place<D>> {
    let promised = along.dot(&now.slope);
    let mut share = 1.0;
    for _ in 0..SHORTER {
        let point = now.point + share * along;
        let mut points = vec![point];
        points.extend((0..D).map(|variable| moved(&point, variable, STEP)));
        let values = values_at(&points);
        let value = values[0];
        if value <= now.value + KEPT * share * promised {
            let slope = Point::from_fn(|variable, _| (values[1 + variable] - value) / STEP);
            return Some(Place { point, value, slope });
        }
        // The lowest point of the parabola through what is known.
        let over = value - now.value - share * promised;
        let best = -0.5 * promised * share * share / over;
        share = if best.is_finite() { best.clamp(0.1 * share, 0.5 * share) } else { 0.1 * share };
    }
    None
}

/// Takes in how the slope changed over a step.
fn updated<const D: usize>(inverse: &mut SMatrix<f64, D, D>, step: &Point<D>, bend: &Point<D>) {
    let along = step.dot(bend);
    if along <= 1e-10 * step.norm() * bend.norm() {
        return;
    }
    let left = SMatrix::identity() - step * bend.transpose() / along;
    *inverse = left * *inverse * left.transpose() + step * step.transpose() / along;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_valley_of_rosenbrock() {
        let mut calls = 0;
        let values = |points: &[Point<2>]| {
            calls += 1;
            let value = |p: &Point<2>| {
                let (a, b) = (1.0 - p[0], p[1] - p[0] * p[0]);
                a * a + 100.0 * b * b
            };
            points.iter().map(value).collect()
        };
        let descent = Descent { iterations: 80, longest: 1.0, tolerance: 1e-9 };
        let point = minimise(values, Point::from([-1.2, 1.0]), descent);
        assert!((point[0] - 1.0).abs() < 1e-2 && (point[1] - 1.0).abs() < 1e-2, "{point:?}");
        assert!(calls < 80, "{calls}");
    }

    #[test]
    fn a_parabola_takes_two_moves() {
        let value = |point: &Point<4>| {
            let apart = point - Point::repeat(0.5);
            apart.component_mul(&apart).dot(&Point::from([1.0, 9.0, 70.0, 3.0]))
                + apart[0] * apart[2]
        };
        let values = |points: &[Point<4>]| points.iter().map(value).collect();
        let descent = Descent { iterations: 2, longest: 1.0, tolerance: 1e-12 };
        let point = minimise(values, Point::zeros(), descent);
        assert!((point - Point::repeat(0.5)).amax() < 1e-3, "{point:?}");
    }
}
