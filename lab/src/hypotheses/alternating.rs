//! What is the other way round from one sample to the next: every second step longer, two heads read in turn.
//!
//! The shortest wave that samples can show has a sign and no phase, and stands in no spectrum.

use helixlock_plant::Column;

use super::probes::{Structure, probe};
use crate::model::{Columns, Fit, Problem};

/// Of one size forwards and of another backwards, with its chance, all probes counted.
#[must_use]
pub(super) fn alternating(problem: &Problem, model: &Columns, fit: &Fit) -> Structure {
    let raw = [1.0, -1.0].map(|way| column(problem, way));
    let (rms_um, p_value) = probe(problem, model, fit, &raw);
    let shape = "alternates from one sample to the next";
    Structure::without_place("time", shape, rms_um, p_value).drawn_by(raw.into())
}

/// 1 and −1 in turn in the rows of a direction, from 1 at the start of each way.
fn column(problem: &Problem, way: f64) -> Column {
    let mut column = vec![0.0; problem.samples.len()];
    let direction = |row: usize| problem.record.direction[problem.samples[row]];
    for block in &problem.layout.blocks {
        let mut next = 1.0;
        for row in block.rows.clone() {
            if way * direction(row) <= 0.0 {
                next = 1.0;
            } else {
                column[row] = next;
                next = -next;
            }
        }
    }
    column.into()
}
