//! The spectrum of a residual, with names only where there is a peak to carry them.

use helixlock_lab::{NamedLine, Problem, amplitude_spectrum, lines_left};
use serde::Serialize;

use super::opened::Opened;
use super::refusal::{Answered, json};
use crate::shared::spectrum::{beyond, top_near};

/// Most names in a picture.
const MOST: usize = 8;

#[derive(Serialize)]
struct SpectrumJson {
    /// Order and amplitude.
    points: Vec<[f64; 2]>,
    peaks: Vec<PeakJson>,
    /// Lines beyond the points, which peaks may be aliases of: what the machine file calls them,
    /// and their orders.
    beyond: Vec<(Option<String>, f64)>,
}

/// A drawn peak with its name.
#[derive(Debug, PartialEq, Serialize)]
pub(crate) struct PeakJson {
    order: f64,
    amplitude: f64,
    /// What the machine file calls it.
    name: Option<String>,
}

/// What turns faster than the samples resolve.
#[derive(Serialize)]
struct FastJson {
    /// Cycles a spindle turn up to which waves are resolved.
    highest_order: f64,
    /// Shafts and meshes beyond, with their orders.
    faster: Vec<(String, f64)>,
}

/// What the machine file names and the samples stand too far apart for.
pub(crate) fn faster(problem: &Problem) -> Answered {
    let machine = &problem.model;
    let shafts = machine.gears.iter().flat_map(|gear| {
        let mesh = gear.mesh_order().map(|order| (format!("mesh of {}", gear.name), order));
        std::iter::once((gear.name.clone(), gear.order)).chain(mesh)
    });
    let highest_order = problem.highest_order();
    json(&FastJson {
        highest_order,
        faster: shafts.filter(|(_, order)| highest_order < *order).collect(),
    })
}

/// Order spectrum of one sensor's residual, up to the highest order its sampling resolves.
pub(crate) fn spectrum(opened: &Opened, sensor: usize) -> Answered {
    let Opened { problem, residual, .. } = opened;
    let points: Vec<[f64; 2]> = amplitude_spectrum(problem, residual, sensor)
        .into_iter()
        .filter(|[order, _]| *order <= problem.highest_order())
        .collect();
    let lines = lines_left(problem);
    let beyond = beyond(&lines, &points, sensor);
    let beyond = beyond.map(|line| (line.name.clone(), line.line.frequency)).collect();
    let lines = lines.iter().filter(|line| line.sensor == sensor).cloned();
    json(&SpectrumJson { peaks: peaks(lines, &points), beyond, points })
}

fn peaks(lines: impl Iterator<Item = NamedLine>, points: &[[f64; 2]]) -> Vec<PeakJson> {
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
