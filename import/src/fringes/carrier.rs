//! How many fringes there are in a unit of the command: the strongest line of the light.

use std::f64::consts::TAU;

use helixlock_fourier::{Complex, forward};

/// Waves on the whole way below which a line is drift of the lamp, not fringes.
const FEWEST: usize = 8;
/// Points of the even grid for each sample: what is slower than Nyquist stays in place.
const FINER: usize = 2;
/// Most points of the grid, for memory.
const MOST: usize = 1 << 22;

/// Phase in a unit of the way, rad; `None` when there are no fringes. `way` must rise.
///
/// The light is laid on an even grid, straight between samples, tapered by a Hann window and
/// transformed; the line's place follows from a parabola through its three highest points.
pub(super) fn rad_a_unit(way: &[f64], light: &[f64]) -> Option<f64> {
    let points = (FINER * way.len()).next_power_of_two().min(MOST);
    let (from, to) = (*way.first()?, *way.last()?);
    if way.len() < 4 * FEWEST || to <= from {
        return None;
    }
    let step = (to - from) / number(points - 1);
    let mean = light.iter().sum::<f64>() / number(light.len());
    let mut next = 1;
    let mut grid: Vec<Complex<f64>> = (0..points)
        .map(|point| {
            let at = from + step * number(point);
            while next + 1 < way.len() && way[next] < at {
                next += 1;
            }
            let share = (at - way[next - 1]) / (way[next] - way[next - 1]);
            let value = light[next - 1] + share.min(1.0) * (light[next] - light[next - 1]) - mean;
            let taper = 0.5 - 0.5 * libm::cos(TAU * number(point) / number(points - 1));
            Complex::new(taper * value, 0.0)
        })
        .collect();
    forward(&mut grid);
    let power: Vec<f64> = grid[..points / 2].iter().map(Complex::norm_sqr).collect();
    let most = way.len() / 2;
    let best =
        (FEWEST..most.min(power.len() - 1)).max_by(|a, b| power[*a].total_cmp(&power[*b]))?;
    let [before, at, after] =
        [best - 1, best, best + 1].map(|bin| libm::log(power[bin].max(1e-300)));
    let bend = before - 2.0 * at + after;
    let beside = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    let told = FEWEST < best && 0.0 < power[best];
    told.then(|| TAU * (number(best) + beside.clamp(-0.5, 0.5)) / (step * number(points)))
}

#[expect(clippy::cast_precision_loss, reason = "points are far below 2⁵³")]
pub(super) fn number(count: usize) -> f64 {
    count as f64
}
