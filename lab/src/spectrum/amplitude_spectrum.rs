//! A spectrum to look at: the amplitude of the best sinusoid at every order.

use crate::model::Problem;
use crate::numerics::{count, fourier, mean, spread, usual_rate};
use crate::policy::extent::SLOWEST_WAVES;

/// Points a frequency cell: at worst the top of a line is drawn a fortieth too low.
const POINTS_A_CELL: f64 = 4.0;

/// Most points; a spectrum for more covers the lowest ones.
const MOST_POINTS: f64 = 65_536.0;

/// `(order, amplitude)` of one sensor's rows of a residual, every pass about its own mean.
///
/// Orders are in cycles a spindle turn, from one wave and a half over the record to the highest
/// that the samples resolve. All samples weigh alike: unlike the search's own scan it knows nothing
/// of the noise, and an even height does not mean an even significance.
#[must_use]
pub fn amplitude_spectrum(problem: &Problem, left: &[f64], sensor: usize) -> Vec<[f64; 2]> {
    let mut values = Vec::new();
    let mut turns = Vec::new();
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        let part = &left[block.rows.clone()];
        let mean = mean(part);
        values.extend(part.iter().map(|value| value - mean));
        let rad = |row: usize| problem.record.spindle_rad[problem.samples[row]];
        turns.extend(block.rows.clone().map(|row| rad(row) / std::f64::consts::TAU));
    }
    let range = spread(&turns);
    if range <= 0.0 {
        return Vec::new();
    }
    let step = 1.0 / (POINTS_A_CELL * range);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to small positive numbers"
    )]
    let points = (0.5 * usual_rate(&turns) / step).clamp(4.0, MOST_POINTS) as usize;
    let rows = count(values.len());
    let sizes = fourier::sizes(&turns, &values, step, points);
    let orders = (0..points).map(|index| step * count(index));
    orders
        .zip(sizes)
        .filter(|(order, _)| SLOWEST_WAVES / range <= *order)
        .map(|(order, size)| [order, 2.0 * size / rows])
        .collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use helixlock_plant::Model;
    use helixlock_traces::{Column, Table};

    use super::*;
    use crate::measurement::{Measurement, Nominal};

    /// Two passes of a sinusoid of 0.3 µm and order 2.5, sampled unevenly.
    #[test]
    fn a_sinusoid_stands_at_its_order_with_its_amplitude() {
        let text = "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\ngrating.lines = 13906\n\
                    laser.wavelength = '0.6 um'\ndividers = { a = 110, b = 150 }\n\
                    drive = { step = '0.0125 um', frequency = '100 Hz' }\n";
        let machine = Model::parse(text, Path::new("machine.toml")).expect("a machine");
        let rows: Vec<f64> = (0..2000).map(count).collect();
        let position_mm: Vec<f64> =
            rows.iter().map(|i| (i % 1000.0) * 0.4 + 0.1 * libm::sin(i * i)).collect();
        let wave = |x: &f64| 5.0 + 0.3 * libm::sin(std::f64::consts::TAU * 2.5 * x / 6.0);
        let columns = [
            ("error_um", position_mm.iter().map(wave).collect()),
            ("position_mm", position_mm.clone()),
            ("pass", rows.iter().map(|i| (i / 1000.0).floor()).collect()),
        ];
        let column = |(name, values): (&str, Vec<f64>)| Column { name: name.into(), values };
        let table = Table::new(columns.into_iter().map(column).collect());
        let measurement = Measurement::from_table(&table, &Nominal::of(&machine)).expect("data");
        let problem = Problem::new(&machine, &measurement).expect("a problem");
        let spectrum = amplitude_spectrum(&problem, &problem.observed, 0);
        let highest = spectrum.iter().max_by(|a, b| a[1].total_cmp(&b[1])).expect("points");
        assert!((highest[0] - 2.5).abs() < 0.02, "{highest:?}");
        assert!((highest[1] - 0.3).abs() < 0.01, "{highest:?}");
        let elsewhere = spectrum.iter().filter(|point| 0.2 < (point[0] - 2.5).abs());
        assert!(elsewhere.map(|point| point[1]).fold(0.0, f64::max) < 0.05);
    }
}
