//! The spectrum of a residual, with names only where there is a peak to carry them.

use helixlock_lab::{Problem, amplitude_spectrum, lines_left};
use serde::Serialize;

use super::opened::Opened;
use super::refusal::{Answered, json};
use crate::shared::spectrum::top_near;

/// Most names in a picture.
const MOST: usize = 8;

#[derive(Serialize)]
struct SpectrumJson {
    /// Order and amplitude.
    points: Vec<[f64; 2]>,
    peaks: Vec<PeakJson>,
}

/// A drawn peak with its name.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct PeakJson {
    order: f64,
    amplitude: f64,
    /// What the machine file calls it.
    name: Option<String>,
}

/// Order spectrum of one sensor's residual, up to the highest order its sampling resolves.
pub(crate) fn spectrum(opened: &Opened, sensor: usize) -> Answered {
    let Opened { problem, residual, .. } = opened;
    let points: Vec<[f64; 2]> = amplitude_spectrum(problem, residual, sensor)
        .into_iter()
        .filter(|[order, _]| *order <= problem.highest_order)
        .collect();
    let peaks = peaks(problem, sensor, &points);
    json(&SpectrumJson { points, peaks })
}

fn peaks(problem: &Problem, sensor: usize, points: &[[f64; 2]]) -> Vec<PeakJson> {
    let lines = lines_left(problem).into_iter().filter(|line| line.sensor == sensor);
    let mut peaks: Vec<PeakJson> = Vec::new();
    for line in lines {
        let Some([order, amplitude]) = top_near(points, line.line.frequency) else { continue };
        let known = peaks.iter().any(|known| known.order.total_cmp(&order).is_eq());
        if !known && peaks.len() < MOST {
            peaks.push(PeakJson { order, amplitude, name: line.name });
        }
    }
    peaks
}
