//! Two detectors a quarter of a fringe apart: a pointer that turns with the travel.
//!
//! Unequal gains, offsets and a lag that is not 90° make its circle an ellipse, and leave an error
//! that repeats with every fringe. A general conic is fitted by least squares and turned back into a
//! circle (P. L. M. Heydemann, Applied Optics 20 (1981) 3382). Fringes that fade change its size, so
//! that every stretch of some twenty fringes has an ellipse of its own.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use super::Reading;
use super::carrier::number;

/// Fringes that share an ellipse.
const SHARED: f64 = 20.0;

/// Readings, and what the ellipses leave of their radius, rms.
pub(super) struct Found {
    pub(super) readings: Vec<Reading>,
    pub(super) left: f64,
}

/// A reading a fringe; `None` where the pair makes no ellipse.
pub(super) fn readings(way: &[f64], first: &[f64], second: &[f64], carrier: f64) -> Option<Found> {
    let fringe = TAU / carrier;
    let length = *way.last()?;
    let stretches = (length / (SHARED * fringe)).floor().max(1.0);
    let pointers = {
        let mut pointers: Vec<Vector2<f64>> = Vec::with_capacity(way.len());
        let mut from = 0;
        while from < way.len() {
            let stretch = (way[from] * stretches / length).floor() + 1.0;
            let end = length * stretch / stretches;
            let to = way.partition_point(|at| *at < end).max(from + 1);
            let to = if stretches <= stretch { way.len() } else { to };
            let circle = Circle::fitted(&first[from..to], &second[from..to])?;
            pointers.extend((from..to).map(|at| circle.pointer(first[at], second[at])));
            from = to;
        }
        pointers
    };
    let angles = followed(&pointers);
    let sense = (angles.last()? - angles.first()?).signum();
    let mut readings = Vec::new();
    let mut from = 0;
    while from < way.len() {
        let to = way.partition_point(|at| *at < way[from] + fringe).max(from + 1);
        readings.extend(mean(&way[from..to], &angles[from..to], &pointers[from..to], sense));
        from = to;
    }
    let radii = pointers.iter().map(|pointer| (pointer.norm() - 1.0).powi(2));
    let left = (radii.sum::<f64>() / number(pointers.len())).sqrt();
    Some(Found { readings, left })
}

/// The mean of a fringe: the phase in its middle.
fn mean(way: &[f64], angles: &[f64], pointers: &[Vector2<f64>], sense: f64) -> Option<Reading> {
    let count = number(way.len());
    if way.len() < 3 {
        return None;
    }
    let middle = way.iter().sum::<f64>() / count;
    let phase = sense * angles.iter().sum::<f64>() / count;
    let off: f64 =
        pointers.iter().map(|pointer| (pointer.norm() - 1.0).powi(2)).sum::<f64>() / count;
    let amplitude = pointers.iter().map(Vector2::norm).sum::<f64>() / count;
    let deviation = off.sqrt().max(1e-6) / amplitude / count.sqrt();
    Some(Reading { way: middle, phase: wrapped(phase), deviation })
}

/// Angles without jumps: from sample to sample the shorter way.
fn followed(pointers: &[Vector2<f64>]) -> Vec<f64> {
    let mut angle = 0.0;
    let mut angles = Vec::with_capacity(pointers.len());
    for (index, pointer) in pointers.iter().enumerate() {
        let now = libm::atan2(pointer.y, pointer.x);
        angle = if index == 0 { now } else { angle + wrapped(now - angle) };
        angles.push(angle);
    }
    angles
}

/// To half a turn on either side of zero.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * ((angle + PI) / TAU).floor()
}

/// What makes the ellipse a circle of radius 1 about the origin.
struct Circle {
    centre: Vector2<f64>,
    map: Matrix2<f64>,
}

impl Circle {
    fn fitted(first: &[f64], second: &[f64]) -> Option<Self> {
        // Centred and scaled before, so that the squares are of one size.
        let (m, s) = (moments(first), moments(second));
        if m.1 <= 0.0 || s.1 <= 0.0 {
            return None;
        }
        let mut normal = SMatrix::<f64, 5, 5>::zeros();
        let mut right = SVector::<f64, 5>::zeros();
        for (u, v) in first.iter().zip(second) {
            let (u, v) = ((u - m.0) / m.1, (v - s.0) / s.1);
            let row = SVector::<f64, 5>::new(u * u, u * v, v * v, u, v);
            normal += row * row.transpose();
            right += row;
        }
        let found = normal.cholesky()?.solve(&right);
        let shape = Matrix2::new(found[0], found[1] / 2.0, found[1] / 2.0, found[2]);
        let centre = shape.try_inverse()? * Vector2::new(found[3], found[4]) * -0.5;
        let size = 1.0 + centre.dot(&(shape * centre));
        let root = (shape / size).cholesky()?.l().transpose();
        let unit = Matrix2::new(1.0 / m.1, 0.0, 0.0, 1.0 / s.1);
        let centre = Vector2::new(m.0 + m.1 * centre.x, s.0 + s.1 * centre.y);
        Some(Self { centre, map: root * unit })
    }

    fn pointer(&self, first: f64, second: f64) -> Vector2<f64> {
        self.map * (Vector2::new(first, second) - self.centre)
    }
}

/// Mean and standard deviation.
fn moments(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / number(values.len());
    let squares = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    (mean, (squares / number(values.len())).sqrt())
}
