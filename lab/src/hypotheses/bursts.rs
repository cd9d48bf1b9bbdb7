//! Waves in a short stretch: chatter at one place, a pump that runs for a while.
//!
//! Over the whole record such a wave stands in so few rows that no line shows it, and no mean of a window does. So
//! stretches of the travel and of single passes are searched as records of their own, every way with a phase of its
//! own, by Fisher's law against what the wave leaves in that very stretch: a louder one makes no wave.

use std::f64::consts::TAU;
use std::ops::Range;

use helixlock_plant::Column;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::probes::{Structure, asked, probes};
use super::repeatability::from_turn_to_turn;
use super::waves::{Cyclic, cyclic};
use crate::model::{Columns, Fit, Problem};
use crate::noise::Whitener;
use crate::numerics::{count, fourier, mean, spread};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::{FEWEST_ROWS_OF_A_BURST, PARTS_WITH_A_BURST, SLOWEST_WAVES};
use crate::spectrum::POINTS_A_CELL;

/// A wave in a stretch, which may be several runs of rows.
struct Burst<'a> {
    runs: &'a [Range<usize>],
    axis: &'a Cyclic,
    frequency: f64,
    /// Chance of as much at any frequency of this stretch in noise.
    chance: f64,
}

/// The clearest one.
#[must_use]
pub(super) fn bursts(problem: &Problem, model: &Columns, fit: &Fit) -> Option<Structure> {
    let white = Whitener::new(&problem.layout, &fit.noises).whiten(fit.left.clone());
    let (windows, axes) = (windows(problem), cyclic(problem));
    let looked = || windows.iter().flat_map(|runs| axes.iter().map(move |axis| (runs, axis)));
    let found = looked().filter_map(|(runs, axis)| clearest(problem, &white, runs, axis));
    let best = found.min_by(|a, b| a.chance.total_cmp(&b.chance))?;
    Some(best.told(problem, (model, fit), count(looked().count())))
}

/// Stretches of the travel, all sensors and passes that come there, and of single passes, half of one apart.
fn windows(problem: &Problem) -> Vec<Vec<Range<usize>>> {
    let blocks = &problem.layout.blocks;
    let ways: Vec<Range<usize>> =
        blocks.iter().flat_map(|block| from_turn_to_turn(problem, block.rows.clone())).collect();
    let place = |row: usize| problem.record.position_mm[problem.samples[row]];
    let places: Vec<f64> = (0..problem.samples.len()).map(place).collect();
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let of_travel = parts().map(|[from, to]| {
        let ends = [from, to].map(|share| low + share * spread(&places));
        let is_inside = |row: &usize| (ends[0]..=ends[1]).contains(&places[*row]);
        let run = |way: &Range<usize>| {
            let inside = || way.clone().filter(is_inside);
            Some(inside().min()?..inside().max()? + 1)
        };
        ways.iter().filter_map(run).collect::<Vec<_>>()
    });
    let of_passes = blocks.iter().flat_map(|block| {
        parts().map(|ends| {
            let [from, to] = ends.map(|share| at_share(&block.rows, share));
            std::iter::once(from..to).collect()
        })
    });
    let of_passes = of_passes.filter(|_| 1 < blocks.len());
    let is_long = |runs: &mut Vec<Range<usize>>| {
        runs.retain(|run| FEWEST_ROWS_OF_A_BURST <= run.len());
        !runs.is_empty()
    };
    of_travel.chain(of_passes).filter_map(|mut runs| is_long(&mut runs).then_some(runs)).collect()
}

/// Where the parts of a whole begin and end.
fn parts() -> impl Iterator<Item = [f64; 2]> {
    PARTS_WITH_A_BURST.into_iter().flat_map(|parts| {
        let part =
            move |half: u8| [half, half + 2].map(|end| f64::from(end) / f64::from(2 * parts));
        (0..2 * parts - 1).map(part)
    })
}

fn at_share(rows: &Range<usize>, share: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of some rows"
    )]
    let inside = (share * count(rows.len())) as usize;
    rows.start + inside
}

/// The clearest wave along an axis of a stretch.
fn clearest<'a>(
    problem: &Problem,
    white: &[f64],
    runs: &'a [Range<usize>],
    axis: &'a Cyclic,
) -> Option<Burst<'a>> {
    let along = |run: &Range<usize>| -> Vec<f64> {
        run.clone().map(|row| axis.values[problem.samples[row]]).collect()
    };
    let along: Vec<Vec<f64>> = runs.iter().map(along).collect();
    let length = along.iter().map(|run| spread(run)).fold(0.0, f64::max);
    let rows = runs.iter().map(Range::len).max()?;
    let lowest = SLOWEST_WAVES / length;
    let highest = axis.highest.min(0.5 * count(rows) / length);
    if length <= 0.0 || highest <= lowest {
        return None;
    }
    let (step, points) = grid(length, highest);
    let (mut gains, mut total) = (vec![0.0; points], 0.0);
    for (run, places) in runs.iter().zip(&along) {
        let middle = mean(&white[run.clone()]);
        let about: Vec<f64> = white[run.clone()].iter().map(|value| value - middle).collect();
        total += about.iter().map(|value| value * value).sum::<f64>();
        let sizes = fourier::sizes(places, &about, step, points);
        for (gain, size) in gains.iter_mut().zip(sizes) {
            *gain += 2.0 * size * size / count(run.len());
        }
    }
    let resolved = gains.into_iter().enumerate().map(|(at, gain)| (step * count(at), gain));
    let resolved = resolved.filter(|(frequency, _)| (lowest..=highest).contains(frequency));
    let (frequency, gain) = resolved.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let all = count(runs.iter().map(Range::len).sum());
    let single = chance_of((gain, total), count(runs.len()), all)?;
    let looks = 2.0 * (highest - lowest) * length;
    Some(Burst { runs, axis, frequency, chance: (looks * single).min(1.0) })
}

/// Distance and number of the frequencies of a scan up to the highest.
fn grid(length: f64, highest: f64) -> (f64, usize) {
    let step = 1.0 / (POINTS_A_CELL * length);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "no more than a few points a row"
    )]
    let points = (highest / step) as usize;
    (step, points + 1)
}

/// Chance that waves of one frequency, one a run, gain so much of a whitened square.
fn chance_of((gain, total): (f64, f64), runs: f64, rows: f64) -> Option<f64> {
    let freedom = rows - 3.0 * runs;
    let scale = ((total - gain) / freedom).max(1.0);
    let law = FisherSnedecor::new(2.0 * runs, freedom).ok()?;
    Some(law.sf(gain / (2.0 * runs) / scale))
}

impl Burst<'_> {
    /// Under noise that is fitted anew beside it, as one of so many stretches.
    fn told(&self, problem: &Problem, (model, fit): (&Columns, &Fit), stretches: f64) -> Structure {
        let looks = probes(problem) * stretches;
        let by_law = (looks * self.chance).min(1.0);
        let (mut rms_um, mut p_value, columns) = (0.0, by_law, self.columns(problem));
        if by_law < SIGNIFICANCE {
            let (size, chance) = asked(problem, (model, fit), &columns, (looks, SIGNIFICANCE));
            (rms_um, p_value) = (size, by_law.max(chance));
        }
        let shape = "waves in one stretch";
        let told = Structure::without_place(self.axis.along, shape, rms_um, p_value);
        told.drawn_by(columns)
    }

    /// A sine and a cosine in each run.
    fn columns(&self, problem: &Problem) -> Vec<Column> {
        let wave = |of: fn(f64) -> f64, run: &Range<usize>| {
            let mut column = vec![0.0; problem.samples.len()];
            for row in run.clone() {
                column[row] = of(TAU * self.frequency * self.axis.values[problem.samples[row]]);
            }
            Column::from(column)
        };
        self.runs.iter().flat_map(|run| [wave(libm::sin, run), wave(libm::cos, run)]).collect()
    }
}
