//! Waves that a fit leaves: lines, bands of frequencies that are none, and combs of them.

use super::probes::{Structure, asked, matters, of_all, probes};
use helixlock_plant::Column;

use crate::model::{Columns, Fit, Problem, settle};
use crate::noise::Whitener;
use crate::numerics::least_squares::{self, dot};
use crate::numerics::{chi_squared_tail, count, spread, usual_rate};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::{COLUMNS_OF_PASSES, LISTED_LINES, ROWS_A_COLUMN};
use crate::spectrum::{Line, LineSearch, wave};

/// Degrees of freedom of a block that its zero, a sine and a cosine take.
const LOST_IN_A_BLOCK: f64 = 3.0;

/// Lines over the spindle angle and over time, sensor by sensor.
pub(super) fn lines(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for Cyclic { frequency, values, highest, .. } in cyclic(problem) {
            let of = |fit: &Fit| {
                let search = LineSearch { problem, fit, sensor, coordinate: &values, highest };
                let line = search.strongest()?;
                let drawn_by = wave(problem, sensor, &values, line.frequency).raw;
                Some(of_line(problem, frequency, line).drawn_by(drawn_by))
            };
            found.extend(clearest_that_matters(problem, (model, fit), &of));
        }
    }
    found
}

/// The strongest line that is large enough to matter, or the strongest one where none is: a fine
/// line that is clear in low noise stands before no large one in slow noise.
fn clearest_that_matters(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    strongest: &impl Fn(&Fit) -> Option<Structure>,
) -> Option<Structure> {
    let first = strongest(fit)?;
    let (mut columns, mut now, mut line) = (model.clone(), fit.clone(), first.clone());
    for _ in 1..LISTED_LINES {
        if SIGNIFICANCE <= line.p_value || matters(problem, fit, line.rms_um, line.p_value) {
            break;
        }
        columns = columns.and(&Columns::free(line.drawn_by));
        now = settle(problem, &columns, &now.noises);
        line = strongest(&now)?;
    }
    Some(if matters(problem, fit, line.rms_um, line.p_value) { line } else { first })
}

fn of_line(problem: &Problem, along: &str, line: Line) -> Structure {
    let shape = format!("sinusoid of amplitude {:.3}", line.amplitude);
    let rms_um = line.amplitude / std::f64::consts::SQRT_2;
    let p_value = of_all(problem, line.p_value);
    let told = Structure::without_place(along, &shape, rms_um, p_value);
    let (at, at_stderr) = (Some(line.frequency), Some(line.frequency_stderr));
    Structure { at, at_stderr, line: Some(line), ..told }
}

/// Bands over the spindle angle and over time, sensor by sensor; where a clock begins anew in each pass also over
/// the time that has gone, for a wave with a phase of its own in each is a band there.
pub(super) fn bands(problem: &Problem, fit: &Fit) -> Vec<Structure> {
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(time_gone(problem)).collect();
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for &Cyclic { frequency, ref values, highest, .. } in &axes {
            let search = LineSearch { problem, fit, sensor, coordinate: values, highest };
            let Some(band) = search.band() else { continue };
            let p_value = of_all(problem, band.p_value);
            let shape =
                format!("uneven waves, or of changing length, in a band {:.3} wide", band.width);
            let told = Structure::without_place(frequency, &shape, band.rms, p_value);
            found.push(Structure { at: Some(band.frequency), ..told });
        }
    }
    found
}

/// Waves of one frequency over the spindle angle and over time, with a size and a phase of their own in each pass, sensor
/// by sensor: what shakes at its own time, or by a clock that begins anew. The noise, which has followed them, is fitted
/// anew.
pub(super) fn of_each_pass(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let passes = problem.record.passes();
    let few = problem.samples.len() < ROWS_A_COLUMN * 2 * passes.len();
    if passes.len() < 2 || COLUMNS_OF_PASSES < 2 * passes.len() || few {
        return Vec::new();
    }
    let of = |sensor: usize, axis: &Cyclic| {
        let Cyclic { frequency: along, values, highest, .. } = axis;
        let search = LineSearch { problem, fit, sensor, coordinate: values, highest: *highest };
        let (frequency, looks) = search.strongest_in_each_pass()?;
        let own = in_each_block(problem, &wave(problem, sensor, values, frequency).raw);
        let looks = probes(problem) * looks;
        let (rms_um, p_value) = asked(problem, (model, fit), &own, (looks, SIGNIFICANCE));
        let p_value = if p_value < SIGNIFICANCE {
            p_value.max((looks * chance_in_passes(problem, (model, fit), sensor, &own)).min(1.0))
        } else {
            p_value
        };
        let shape = "waves of one length, in a size and a phase of each pass's own";
        let told = Structure::without_place(along, shape, rms_um, p_value);
        Some(Structure { at: Some(frequency), ..told })
    };
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(rows(problem)).collect();
    let sensors = 0..problem.sensors.len();
    sensors.flat_map(|sensor| axes.iter().filter_map(move |axis| of(sensor, axis))).collect()
}

/// Columns that show each of some others in one block alone, block by block.
fn in_each_block(problem: &Problem, columns: &[Column]) -> Vec<Column> {
    let blocks = problem.layout.blocks.iter();
    let own = blocks.flat_map(|block| {
        columns.iter().map(|column| {
            let mut own = vec![0.0; column.len()];
            own[block.rows.clone()].copy_from_slice(&column[block.rows.clone()]);
            Column::from(own)
        })
    });
    own.collect()
}

/// Chance of what a sine and a cosine of each block take away there, each block by the noise that it has itself: one may
/// be louder than another.
///
/// Twice the logarithm of the chance by Fisher's F(2, m), `m·ln(1 + taken/left)`, is χ² with two degrees of freedom,
/// and so is the sum with two a block (Fisher 1925).
fn chance_in_passes(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    sensor: usize,
    own: &[Column],
) -> f64 {
    let wider = settle(problem, &model.and(&Columns::free(own.to_vec())), &fit.noises);
    let whitener = Whitener::new(&problem.layout, &wider.noises);
    let left = whitener.whiten(fit.left.clone());
    let blocks = problem.layout.blocks.iter().zip(own.chunks_exact(2));
    let evidence = blocks.filter(|(block, _)| block.sensor == sensor).map(|(block, waves)| {
        let rows = block.rows.clone();
        let waves = whitener.whiten_all(&[&waves[0], &waves[1]]);
        let left = &left[rows.clone()];
        let fit = least_squares::fit(&[&waves[0][rows.clone()], &waves[1][rows]], left);
        let freedom = (count(left.len()) - LOST_IN_A_BLOCK).max(0.0);
        freedom * libm::log(dot(left, left) / fit.residual_square.max(f64::MIN_POSITIVE))
    });
    let evidence: Vec<f64> = evidence.filter(|one| one.is_finite()).collect();
    chi_squared_tail(evidence.iter().sum(), 2.0 * count(evidence.len()))
}

/// Combs of frequencies over the spindle angle, over time and over the way, sensor by sensor: what all harmonics show
/// beside the strongest, the noise fitted anew.
pub(super) fn combs(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(way(problem)).collect();
    let of = |sensor: usize, axis: &Cyclic| {
        let Cyclic { frequency, values, highest, .. } = axis;
        let search = LineSearch { problem, fit, sensor, coordinate: values, highest: *highest };
        let comb = search.comb()?;
        let harmonic =
            |times: &u32| wave(problem, sensor, values, f64::from(*times) * comb.frequency);
        let with_one = model.and(&harmonic(&comb.strongest));
        let before = settle(problem, &with_one, &fit.noises);
        let others: Vec<Column> =
            comb.others.iter().flat_map(|times| harmonic(times).raw).collect();
        let looks = (probes(problem) * comb.looks, SIGNIFICANCE);
        let (rms_um, p_value) = asked(problem, (&with_one, &before), &others, looks);
        let shape = "comes again evenly, in no smooth shape";
        let told = Structure::without_place(frequency, shape, rms_um, p_value);
        Some(Structure { at: Some(comb.frequency), ..told })
    };
    let sensors = 0..problem.sensors.len();
    sensors.flat_map(|sensor| axes.iter().filter_map(move |axis| of(sensor, axis))).collect()
}

/// A coordinate that waves are looked for in.
pub(super) struct Cyclic {
    /// What it is, and what a frequency over it is called.
    pub(super) along: &'static str,
    pub(super) frequency: &'static str,
    pub(super) values: Column,
    /// Highest frequency that its samples resolve.
    pub(super) highest: f64,
}

/// The spindle's turns, and time, which is travel in a single pass of one way and speed.
pub(super) fn cyclic(problem: &Problem) -> Vec<Cyclic> {
    let mut axes = vec![Cyclic {
        along: "position",
        frequency: "spindle order",
        values: problem.record.turns().collect(),
        highest: problem.highest_order(),
    }];
    if problem.measurement.timed && !time_is_travel(problem) {
        axes.push(Cyclic {
            along: "time",
            frequency: "frequency in time",
            values: problem.record.time_s.clone(),
            highest: problem.highest_hz(),
        });
    }
    axes
}

/// The way that the axis has gone since the record began, in turns, where it is not the angle.
fn way(problem: &Problem) -> Option<Cyclic> {
    let once = problem.record.passes().len() == 1 && spread(&problem.record.direction) <= 0.0;
    if once {
        return None;
    }
    let values = gone_through(problem.record.turns());
    let highest = 0.5 * usual_rate(&values);
    let frequency = "order of the way";
    Some(Cyclic { along: "way", frequency, values: values.into(), highest })
}

/// The rows, which come evenly in time or not, where no clock says when.
fn rows(problem: &Problem) -> Option<Cyclic> {
    let values = (0..problem.record.len()).map(count).collect();
    let along = Cyclic { along: "rows", frequency: "waves a row", values, highest: 0.5 };
    (!problem.measurement.timed).then_some(along)
}

/// The time that has gone since the record began, where a clock begins anew in each pass.
fn time_gone(problem: &Problem) -> Option<Cyclic> {
    let measurement = &problem.measurement;
    (measurement.timed && !measurement.tells_pauses()).then(|| Cyclic {
        along: "time",
        frequency: "frequency in time",
        values: gone_through(problem.record.time_s.iter().copied()).into(),
        highest: problem.highest_hz(),
    })
}

/// The sum of all steps up to each value.
fn gone_through(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut before = None;
    let mut gone = 0.0;
    values
        .map(|value| {
            gone += before.replace(value).map_or(0.0, |before: f64| (value - before).abs());
            gone
        })
        .collect()
}

fn time_is_travel(problem: &Problem) -> bool {
    let one_way = problem.record.direction.windows(2).all(|pair| 0.0 <= pair[0] * pair[1]);
    problem.record.passes().len() == 1 && one_way && problem.velocity_rpm().is_none()
}
