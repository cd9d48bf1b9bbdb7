//! Along which axis a model fails: the residual in bins of everything it could follow.

use std::f64::consts::TAU;

use helixlock_lab::Problem;
use helixlock_plant::Column;
use serde::Serialize;

use super::opened::{Opened, about_zero, count};
use super::refusal::{Answered, Refusal, json};

/// Bins of a strip, and of a curve.
const STRIP: usize = 96;
const CURVE: usize = 240;

/// Something the residual could follow, with its value at every sample.
struct Axis {
    key: String,
    /// What the pages call this kind of axis.
    kind: &'static str,
    /// The name of a shaft or a column.
    name: String,
    unit: &'static str,
    values: Column,
}

/// An axis in bins.
#[derive(Serialize)]
struct AxisJson {
    key: String,
    kind: &'static str,
    name: String,
    unit: &'static str,
    low: f64,
    high: f64,
    /// Part of the residual's square that the means of the bins hold.
    share: f64,
    #[serde(flatten)]
    bins: Bins,
}

/// What lies in each bin; nothing where no sample does.
#[derive(Serialize)]
struct Bins {
    mean: Vec<Option<f64>>,
    least: Vec<Option<f64>>,
    most: Vec<Option<f64>>,
    count: Vec<usize>,
}

#[derive(Serialize)]
struct AxesJson {
    axes: Vec<AxisJson>,
    /// Root mean square of the residual.
    rms: f64,
}

/// Rows that count: of one sensor, or of chosen passes.
fn chosen(problem: &Problem, sensor: usize, without: &[f64]) -> Vec<usize> {
    let names = &problem.measurement.pass_names;
    let blocks = problem.layout.blocks.iter();
    let counts =
        blocks.filter(|block| block.sensor == sensor && !without.contains(&names[block.pass]));
    counts.flat_map(|block| block.rows.clone()).collect()
}

/// Every axis as a strip, the one that explains most first.
pub(crate) fn strips(opened: &Opened, sensor: usize, without: &[f64]) -> Answered {
    let residual = about_zero(&opened.problem, &opened.residual);
    let rows = chosen(&opened.problem, sensor, without);
    let square: f64 = rows.iter().map(|&row| residual[row] * residual[row]).sum();
    let all = axes(&opened.problem).into_iter();
    let mut axes: Vec<AxisJson> =
        all.map(|axis| binned(&opened.problem, axis, (&rows, &residual), STRIP)).collect();
    axes.sort_by(|one, other| other.share.total_cmp(&one.share));
    json(&AxesJson { axes, rms: (square / count(rows.len())).sqrt() })
}

/// One axis as a curve.
pub(crate) fn curve(opened: &Opened, key: &str, sensor: usize, without: &[f64]) -> Answered {
    let residual = about_zero(&opened.problem, &opened.residual);
    let rows = chosen(&opened.problem, sensor, without);
    let axis = axes(&opened.problem).into_iter().find(|axis| axis.key == key);
    let axis = axis.ok_or_else(|| Refusal::Unknown(key.to_owned()))?;
    json(&binned(&opened.problem, axis, (&rows, &residual), CURVE))
}

/// Everything there is to look along.
fn axes(problem: &Problem) -> Vec<Axis> {
    let record = &problem.record;
    let mut axes = Vec::new();
    let mut push = |kind: &'static str, name: &str, unit, values: Column| {
        let key = if name.is_empty() { kind.to_owned() } else { format!("{kind}:{name}") };
        axes.push(Axis { key, kind, name: name.to_owned(), unit, values });
    };
    if !problem.measurement.rotary {
        push("position", "", "mm", record.position_mm.clone());
    }
    push("time", "", "s", record.time_s.clone());
    let turns: Vec<f64> = record.spindle_rad.iter().map(|rad| rad / TAU).collect();
    push("spindle", "", "°", angles(&turns, 1.0));
    if let Some(lead) = problem.model.lead_screw {
        push("screw", "", "°", angles(&record.position_mm, 1.0 / lead.mm()));
    }
    for gear in &problem.model.gears {
        push("gear", &gear.name, "°", angles(&turns, gear.order));
    }
    push("direction", "", "", record.direction.clone());
    push("speed", "", "rpm", record.speed_rpm.clone());
    for (name, values) in &problem.measurement.covariates {
        push("column", name, "", values.clone());
    }
    axes.retain(|axis| axis.values.iter().any(|value| (value - axis.values[0]).abs() > 0.0));
    axes
}

/// The angle of something that turns `order` times a unit of the coordinate, degrees.
fn angles(coordinate: &[f64], order: f64) -> Column {
    coordinate.iter().map(|value| 360.0 * (value * order).rem_euclid(1.0)).collect()
}

fn binned(
    problem: &Problem,
    axis: Axis,
    (rows, residual): (&[usize], &[f64]),
    most_bins: usize,
) -> AxisJson {
    let value = |row: usize| axis.values[problem.samples[row]];
    let finite = || rows.iter().copied().filter(|&row| value(row).is_finite());
    let turns = axis.unit == "°";
    let (mut low, mut high) = if turns { (0.0, 360.0) } else { (f64::INFINITY, f64::NEG_INFINITY) };
    if !turns {
        for row in finite() {
            (low, high) = (value(row).min(low), value(row).max(high));
        }
    }
    let number = if axis.kind == "direction" { 2 } else { most_bins };
    let width = ((high - low) / count(number)).max(f64::MIN_POSITIVE);
    let mut sums = vec![0.0; number];
    let mut bins = Bins {
        mean: vec![None; number],
        least: vec![None; number],
        most: vec![None; number],
        count: vec![0; number],
    };
    for row in finite() {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
        let bin = (((value(row) - low) / width).max(0.0) as usize).min(number - 1);
        let here = residual[row];
        sums[bin] += here;
        bins.count[bin] += 1;
        bins.least[bin] = Some(bins.least[bin].map_or(here, |least| least.min(here)));
        bins.most[bin] = Some(bins.most[bin].map_or(here, |most| most.max(here)));
    }
    let mut held = 0.0;
    for (bin, sum) in sums.into_iter().enumerate().filter(|(bin, _)| 0 < bins.count[*bin]) {
        let mean = sum / count(bins.count[bin]);
        bins.mean[bin] = Some(mean);
        held += mean * sum;
    }
    let square: f64 = finite().map(|row| residual[row] * residual[row]).sum();
    let share = held / square.max(f64::MIN_POSITIVE);
    let Axis { key, kind, name, unit, .. } = axis;
    AxisJson { key, kind, name, unit, low, high, share, bins }
}
