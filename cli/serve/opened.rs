//! The machine and the measurement that a page looks at, laid out once.

use std::sync::{Arc, Mutex};

use helixlock_lab::{Problem, fingerprint, sensor_column};
use helixlock_plant::MachineFile;
use serde::Serialize;

use super::folder::Folder;
use super::frame::Frame;
use super::jobs::held;
use super::refusal::{Answered, Refusal};
use crate::shared::captured::Signals;
use crate::shared::input::Input;
use crate::shared::measured;

/// A problem, and the bytes it was made of.
#[derive(Debug)]
pub(crate) struct Opened {
    key: (String, String),
    /// The model against the measurement.
    pub(crate) problem: Problem,
    /// What it leaves, row by row.
    pub(crate) residual: Vec<f64>,
}

/// The one that was opened last; several pages mostly look at the same.
#[derive(Debug, Default)]
pub(crate) struct Cache {
    last: Mutex<Option<Arc<Opened>>>,
}

impl Cache {
    /// The problem of a machine file and data, read again only where one of them has changed.
    pub(crate) fn open(
        &self,
        folder: &Folder,
        machine: &str,
        data: &str,
    ) -> Result<Arc<Opened>, Refusal> {
        let text = folder.text(machine)?;
        let bytes = folder.read(data)?;
        let key = (fingerprint(text.as_bytes()), fingerprint(&bytes));
        let mut last = held(&self.last);
        if let Some(known) = last.as_ref().filter(|known| known.key == key) {
            return Ok(Arc::clone(known));
        }
        *last = None;
        let file = MachineFile::parse(&text, &folder.path(machine)?)?;
        let path = folder.path(data)?;
        let input = Input::of(path.clone(), bytes);
        let problem = measured::problem(&file.model, &path, input, &Signals::default())?;
        let residual = problem.residual();
        let opened = Arc::new(Opened { key, problem, residual });
        *last = Some(Arc::clone(&opened));
        Ok(opened)
    }
}

#[derive(Serialize)]
struct SeriesJson {
    unit: &'static str,
    rotary: bool,
    rows: usize,
    highest_order: f64,
    notes: Vec<String>,
    blocks: Vec<BlockJson>,
}

/// Rows of one sensor in one pass.
#[derive(Serialize)]
pub(crate) struct BlockJson {
    sensor: &'static str,
    pass: f64,
    from: usize,
    to: usize,
}

/// Where each sensor's passes stand in the rows.
pub(crate) fn blocks(problem: &Problem) -> Vec<BlockJson> {
    let rotary = problem.measurement.rotary;
    let block = |block: &helixlock_lab::Block| BlockJson {
        sensor: sensor_column(problem.sensors[block.sensor], rotary),
        pass: problem.measurement.pass_names[block.pass],
        from: block.rows.start,
        to: block.rows.end,
    };
    problem.layout.blocks.iter().map(block).collect()
}

/// Coordinates, measured and model, row by row.
pub(crate) fn series(opened: &Opened) -> Answered {
    let Opened { problem, residual, .. } = opened;
    let record = &problem.record;
    let of_row = |values: &[f64]| -> Vec<f64> {
        problem.samples.iter().map(|&sample| values[sample]).collect()
    };
    let mut frame = Frame::default();
    if !problem.measurement.rotary {
        frame.push_f64("position_mm", &of_row(&record.position_mm));
    }
    frame.push_f64("time_s", &of_row(&record.time_s));
    let turns: Vec<f64> = record.turns().collect();
    frame.push_f64("angle_rev", &of_row(&turns));
    frame.push_f32("measured", &problem.observed);
    frame.push_f32("residual", residual);
    frame.answer(&SeriesJson {
        unit: problem.measurement.unit(),
        rotary: problem.measurement.rotary,
        rows: problem.samples.len(),
        highest_order: problem.highest_order(),
        notes: problem.measurement.notes.clone(),
        blocks: blocks(problem),
    })
}

/// Values about the mean of each block, as they are drawn and sized.
pub(crate) fn about_zero(problem: &Problem, values: &[f64]) -> Vec<f64> {
    let mut centred = values.to_vec();
    for block in &problem.layout.blocks {
        let part = &mut centred[block.rows.clone()];
        let mean = part.iter().sum::<f64>() / count(part.len());
        for value in part {
            *value -= mean;
        }
    }
    centred
}

#[expect(clippy::cast_precision_loss, reason = "a number of samples")]
pub(crate) fn count(number: usize) -> f64 {
    number.max(1) as f64
}
