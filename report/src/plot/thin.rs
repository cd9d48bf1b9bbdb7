//! Fewer points, same picture.

/// Keeps of each run of points in one pixel column the first, lowest, highest and last, in order.
///
/// `pixels_per_unit` turns positions into pixels; what is drawn differs by less than a pixel.
pub(crate) fn thin_line(points: &[[f64; 2]], pixels_per_unit: f64) -> Vec<[f64; 2]> {
    let column = |point: &[f64; 2]| libm::floor(point[0] * pixels_per_unit);
    let mut kept = Vec::new();
    for run in
        points.chunk_by(|one, next| column(one) <= column(next) && column(next) <= column(one))
    {
        keep_extremes(run, &mut kept);
    }
    kept
}

fn keep_extremes(run: &[[f64; 2]], kept: &mut Vec<[f64; 2]>) {
    if run.len() <= 4 {
        kept.extend_from_slice(run);
        return;
    }
    let height = |index: &usize| run[*index][1];
    let by_height = |one: &usize, other: &usize| height(one).total_cmp(&height(other));
    let lowest = (0..run.len()).min_by(by_height).unwrap_or(0);
    let highest = (0..run.len()).max_by(by_height).unwrap_or(0);
    let mut indices = [0, lowest, highest, run.len() - 1];
    indices.sort_unstable();
    let mut last = None;
    for index in indices {
        if last != Some(index) {
            kept.push(run[index]);
        }
        last = Some(index);
    }
}

/// Keeps one point of those that share a pixel.
pub(crate) fn thin_dots(points: &[[f64; 2]], pixels_per_unit: [f64; 2]) -> Vec<[f64; 2]> {
    let pixel = |point: &[f64; 2]| {
        let [x, y] = [0, 1].map(|axis| libm::floor(point[axis] * pixels_per_unit[axis]));
        (x.to_bits(), y.to_bits())
    };
    let mut taken = std::collections::BTreeSet::new();
    points.iter().filter(|point| taken.insert(pixel(point))).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_survives() {
        let mut points: Vec<_> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
        points[54_321][1] = 7.0;
        let thinned = thin_line(&points, 0.01);
        assert!(thinned.len() <= 4_000, "{}", thinned.len());
        assert!(thinned.contains(&[54_321.0, 7.0]));
        assert!(thinned.is_sorted_by(|one, next| one[0] < next[0]));
    }

    #[test]
    fn dots_on_one_pixel_become_one() {
        let points: Vec<_> = (0..1000).map(|i| [f64::from(i % 10), 0.5]).collect();
        assert_eq!(thin_dots(&points, [1.0, 1.0]).len(), 10);
    }
}
