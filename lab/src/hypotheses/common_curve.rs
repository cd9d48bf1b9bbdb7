//! A curve that the passes of a record have in common, each in a size and a sign of its own.
//!
//! Noise that is fitted to all passes becomes as slow as what they share, but it follows another course
//! in each. So every two passes are asked how much of the one the other draws, whatever its size, and
//! passes weigh as much as they show. How often noise drawn from the fit is as much alike says whether
//! it is chance. What all passes repeat in one size is told by more than this.

use std::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::drawn::{OwnNoise, clearest, surest};
use super::repeatability::from_turn_to_turn;
use crate::model::{Fit, Problem};
use crate::noise::{rms, without_outliers};
use crate::numerics::least_squares::dot;
use crate::numerics::{count, mean, spread};
use crate::policy::extent::{CELLS_OF_A_CURVE, FEWEST_WAYS, ROWS_A_PART, WHOLE_WAY};
use crate::policy::reading::FAR_OUT;

/// Root mean square of what passes have in common, µm (arcsec), and the chance of as much in noise;
/// `None` where they are few, or short, or go over different parts of the travel, and for what rounding
/// may show: the same curve is rounded alike in every pass.
#[must_use]
pub(super) fn common_curve(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let of_sensor = |sensor: usize| {
        let (own, rows) = OwnNoise::of(problem, fit, sensor);
        // Two ways with a wild reading in the same cell are alike, whatever else they show.
        let passes = own.passes(&fit.left[rows.clone()]);
        let left: &[f64] =
            &passes.flat_map(|pass| without_outliers(pass, FAR_OUT)).collect::<Vec<_>>();
        let courses = courses(problem, sensor, rows.start);
        let alike: Vec<Alike> = courses.iter().map(|course| Alike::of(course, left)).collect();
        let found: Vec<f64> = alike.iter().map(|one| one.share_of(left)).collect();
        let drawn = |seed| {
            let values = own.drawn(&mut ChaCha8Rng::seed_from_u64(seed));
            alike.iter().map(|one| surprise(one.share_of(&values))).collect()
        };
        let surprises: Vec<f64> = found.iter().map(|share| surprise(*share)).collect();
        let (place, chance) = clearest(&surprises, drawn)?;
        let rms_um = rms(&own.layout, left) * found[place].sqrt();
        (problem.least_variance[sensor] < rms_um * rms_um).then_some((rms_um, chance))
    };
    let sensors = 0..problem.sensors.len();
    let found: Vec<(f64, f64)> = sensors.filter_map(of_sensor).collect();
    surest(&found)
}

/// Shares of two curves of chance leave `1 − share` a power law: its logarithm has a tail like that of
/// the Gamma law.
fn surprise(share: f64) -> f64 {
    -libm::log((1.0 - share).max(f64::EPSILON))
}

/// Rows of each cell of each way: over the travel, or as they follow one another.
type Course = Vec<Vec<Vec<usize>>>;

/// The courses along which ways are compared: over the travel, and from the start of each where some go
/// back. Rows count from the first of the sensor.
fn courses(problem: &Problem, sensor: usize, first: usize) -> Vec<Course> {
    let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
    let ways: Vec<Range<usize>> =
        blocks.flat_map(|block| from_turn_to_turn(problem, block.rows.clone())).collect();
    let places = |rows: &Range<usize>| -> Vec<f64> {
        rows.clone().map(|row| problem.record.spindle_rad[problem.samples[row]]).collect()
    };
    let longest = ways.iter().map(|rows| spread(&places(rows))).fold(0.0, f64::max);
    let is_whole = |rows: &&Range<usize>| WHOLE_WAY * longest <= spread(&places(rows));
    let whole: Vec<&Range<usize>> = ways.iter().filter(is_whole).collect();
    let goes_back = |rows: &&Range<usize>| {
        let places = places(rows);
        places.last() < places.first()
    };
    let over_travel = |rows: &&Range<usize>| in_cells(&places(rows), rows.start - first);
    let in_time = |rows: &&Range<usize>| {
        in_cells(&(0..rows.len()).map(count).collect::<Vec<_>>(), rows.start - first)
    };
    let mut all: Vec<Course> = vec![whole.iter().filter_map(over_travel).collect()];
    if whole.iter().any(goes_back) {
        all.push(whole.iter().filter_map(in_time).collect());
    }
    all.retain(|course| FEWEST_WAYS <= course.len());
    all
}

/// Rows of equal parts of a way; `None` where any has too few.
fn in_cells(along: &[f64], first: usize) -> Option<Vec<Vec<usize>>> {
    let low = along.iter().copied().fold(f64::INFINITY, f64::min);
    let width = spread(along) / count(CELLS_OF_A_CURVE);
    let mut cells = vec![Vec::new(); CELLS_OF_A_CURVE];
    for (row, place) in along.iter().enumerate() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and the number of cells"
        )]
        let cell = ((place - low) / width) as usize;
        cells[cell.min(CELLS_OF_A_CURVE - 1)].push(first + row);
    }
    cells.iter().all(|cell| ROWS_A_PART <= cell.len()).then_some(cells)
}

/// Ways along one course, and how much each shows.
struct Alike<'a> {
    course: &'a Course,
    squares: Vec<f64>,
}

impl<'a> Alike<'a> {
    fn of(course: &'a Course, values: &[f64]) -> Self {
        let squares = curves(course, values).iter().map(|curve| dot(curve, curve)).collect();
        Self { course, squares }
    }

    /// Share of the square of a way that another draws, in the mean of all pairs; each way weighs what it
    /// showed at first.
    fn share_of(&self, values: &[f64]) -> f64 {
        let curves = curves(self.course, values);
        let (mut shared, mut all) = (0.0, 0.0);
        let ways: Vec<(&Vec<f64>, &f64)> = curves.iter().zip(&self.squares).collect();
        for (place, (one, shown)) in ways.iter().enumerate() {
            for (other, of_other) in &ways[..place] {
                let square = dot(one, one) * dot(other, other);
                let weight = *shown * *of_other;
                let common = dot(one, other);
                all += weight;
                shared += if 0.0 < square { weight * common * common / square } else { 0.0 };
            }
        }
        if 0.0 < all { shared / all } else { 0.0 }
    }
}

/// Means of the cells of each way, about their own mean.
fn curves(course: &Course, values: &[f64]) -> Vec<Vec<f64>> {
    let of_way = |cells: &Vec<Vec<usize>>| {
        let of_cell = |rows: &Vec<usize>| {
            rows.iter().map(|&row| values[row]).sum::<f64>() / count(rows.len())
        };
        let means: Vec<f64> = cells.iter().map(of_cell).collect();
        let level = mean(&means);
        means.iter().map(|value| value - level).collect()
    };
    course.iter().map(of_way).collect()
}
