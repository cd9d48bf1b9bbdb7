//! Waves of one frequency with a size and a phase of their own in each pass: what shakes at its own time, or by a clock
//! that begins anew.
//!
//! They are no line, and few of them a pass are slow noise to the fit. The spectra of all passes are added, and a sine and
//! a cosine of each pass asked together, the noise fitted anew.

use helixlock_plant::Column;

use super::probes::{Structure, asked, probes};
use super::waves::{Cyclic, cyclic};
use crate::model::{Columns, Fit, Problem, settle};
use crate::noise::Whitener;
use crate::numerics::least_squares::{self, dot};
use crate::numerics::{chi_squared_tail, count};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::{COLUMNS_OF_PASSES, ROWS_A_COLUMN};
use crate::spectrum::{LineSearch, wave};

/// Degrees of freedom of a block that its zero, a sine and a cosine take.
const LOST_IN_A_BLOCK: f64 = 3.0;

/// Those over the spindle angle, over time and, where nothing was timed, over the rows, sensor by sensor.
pub(super) fn waves_of_passes(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let passes = problem.record.passes().len();
    let few = problem.samples.len() < ROWS_A_COLUMN * 2 * passes;
    if passes < 2 || COLUMNS_OF_PASSES < 2 * passes || few {
        return Vec::new();
    }
    let of = |sensor: usize, axis: &Cyclic| {
        let Cyclic { frequency: along, values, highest, .. } = axis;
        let search = LineSearch { problem, fit, sensor, coordinate: values, highest: *highest };
        let (frequency, looks) = search.strongest_in_each_pass()?;
        let waves = wave(problem, sensor, values, frequency);
        let own = in_each_block(problem, &waves.raw);
        let looks = probes(problem) * looks;
        let (rms_um, p_value) = asked(problem, (model, fit), &own, (looks, SIGNIFICANCE));
        let of_passes = (p_value < SIGNIFICANCE)
            .then(|| looks * chance_in_passes(problem, (model, fit), sensor, (&waves, own)));
        let p_value = of_passes.map_or(p_value, |chance| chance.clamp(p_value, 1.0));
        let shape = "waves of one length, in a size and a phase of each pass's own";
        let told = Structure::without_place(along, shape, rms_um, p_value);
        Some(Structure { at: Some(frequency), ..told })
    };
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(rows(problem)).collect();
    let sensors = 0..problem.sensors.len();
    sensors.flat_map(|sensor| axes.iter().filter_map(move |axis| of(sensor, axis))).collect()
}

/// The rows, which come evenly in time or not, where no clock says when.
fn rows(problem: &Problem) -> Option<Cyclic> {
    let values = (0..problem.record.len()).map(count).collect();
    let along = Cyclic { along: "rows", frequency: "waves a row", values, highest: 0.5 };
    (!problem.measurement.timed).then_some(along)
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
/// Minus twice the logarithm of the chance by Fisher's F(2, m), `m·ln(1 + taken/left)`, is χ² with two degrees of
/// freedom, and so is the sum with two a block (Fisher 1925).
fn chance_in_passes(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    sensor: usize,
    (waves, own): (&Columns, Vec<Column>),
) -> f64 {
    let wider = settle(problem, &model.and(&Columns::free(own)), &fit.noises);
    let whitener = Whitener::new(&problem.layout, &wider.noises);
    let left = whitener.whiten(fit.left.clone());
    let waves = whitener.whiten_all(&waves.views());
    let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
    let evidence = blocks.map(|block| {
        let waves: Vec<&[f64]> = waves.iter().map(|wave| &wave[block.rows.clone()]).collect();
        let left = &left[block.rows.clone()];
        let fit = least_squares::fit(&waves, left);
        let freedom = (count(left.len()) - LOST_IN_A_BLOCK).max(0.0);
        freedom * libm::log(dot(left, left) / fit.residual_square.max(f64::MIN_POSITIVE))
    });
    let evidence: Vec<f64> = evidence.filter(|one| one.is_finite()).collect();
    chi_squared_tail(evidence.iter().sum(), 2.0 * count(evidence.len()))
}
