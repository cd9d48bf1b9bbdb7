//! Downhill simplex of Nelder and Mead (1965): minimises without derivatives in few dimensions.

use super::summary::count;

/// How far and how finely to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Search {
    /// Most evaluations.
    pub(crate) evaluations: usize,
    /// Stop when the values at the corners differ by less.
    pub(crate) tolerance: f64,
}

/// The lowest point found and its value.
///
/// `steps` are the first edges of the simplex, one a dimension, none zero. Values that are not
/// numbers count as infinitely high. Every choice is deterministic.
pub(crate) fn minimise(
    mut value_at: impl FnMut(&[f64]) -> f64,
    start: &[f64],
    steps: &[f64],
    search: Search,
) -> (Vec<f64>, f64) {
    let mut evaluate = |point: &[f64]| {
        let value = value_at(point);
        if value.is_nan() { f64::INFINITY } else { value }
    };
    let mut corners = vec![(start.to_vec(), evaluate(start))];
    for (dimension, step) in steps.iter().enumerate() {
        let mut point = start.to_vec();
        point[dimension] += step;
        let value = evaluate(&point);
        corners.push((point, value));
    }
    let mut left = search.evaluations.saturating_sub(corners.len());
    loop {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let spread = corners[corners.len() - 1].1 - corners[0].1;
        if left == 0 || spread <= search.tolerance || start.is_empty() {
            return corners.swap_remove(0);
        }
        left = left.saturating_sub(improve(&mut corners, &mut evaluate));
    }
}

/// Replaces the worst corner, or shrinks all towards the best; returns the evaluations spent.
fn improve(corners: &mut [(Vec<f64>, f64)], evaluate: &mut impl FnMut(&[f64]) -> f64) -> usize {
    let last = corners.len() - 1;
    let centre = centroid(&corners[..last]);
    let (best, second, worst) = (corners[0].1, corners[last - 1].1, corners[last].1);
    let mut probe = |factor: f64| {
        let point = between(&centre, &corners[last].0, factor);
        let value = evaluate(&point);
        (point, value)
    };
    let mirrored = probe(-1.0);
    let (candidate, spent) = if mirrored.1 < best {
        let far = probe(-2.0);
        (if far.1 < mirrored.1 { far } else { mirrored }, 2)
    } else if mirrored.1 < second {
        (mirrored, 1)
    } else {
        (probe(if mirrored.1 < worst { -0.5 } else { 0.5 }), 2)
    };
    if candidate.1 < worst {
        corners[last] = candidate;
        return spent;
    }
    let anchor = corners[0].0.clone();
    for corner in &mut corners[1..] {
        corner.0 = between(&anchor, &corner.0, 0.5);
        corner.1 = evaluate(&corner.0);
    }
    spent + last
}

fn centroid(corners: &[(Vec<f64>, f64)]) -> Vec<f64> {
    let mut centre = vec![0.0; corners[0].0.len()];
    for (point, _) in corners {
        for (sum, value) in centre.iter_mut().zip(point) {
            *sum += value;
        }
    }
    centre.iter().map(|sum| sum / count(corners.len())).collect()
}

fn between(centre: &[f64], point: &[f64], factor: f64) -> Vec<f64> {
    centre.iter().zip(point).map(|(c, p)| c + factor * (p - c)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_valley_of_rosenbrock() {
        let valley = |p: &[f64]| {
            let (a, b) = (1.0 - p[0], p[1] - p[0] * p[0]);
            a * a + 100.0 * b * b
        };
        let search = Search { evaluations: 600, tolerance: 1e-14 };
        let (point, value) = minimise(valley, &[-1.2, 1.0], &[0.5, 0.5], search);
        assert!(value < 1e-9, "{value}");
        assert!((point[0] - 1.0).abs() < 1e-4 && (point[1] - 1.0).abs() < 1e-4, "{point:?}");
    }
}
