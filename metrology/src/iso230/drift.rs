//! How a drift of the readings may have gone, as far as the approaches tell.
//!
//! What the device shows of a machine that stands has a range; whether it is new at every reading,
//! one of a run, or creeps from the first reading to the last, the range does not say. The runs tell
//! a part of it: each approaches all targets forward and then back again, as figure 1 of ISO 230-2 has
//! it, and the mean of a run over all targets and both ways hardly scatters. But the axis itself may
//! differ from run to run, and grow as it warms; what goes beyond the range told is its own, and within
//! it nothing tells the two apart. So the drift is drawn each way that it may have gone, and no way
//! takes more off than errors within the range can have made.

use super::Target;
use crate::chance::beyond_chance;
use crate::number::{mean, number};

/// What drifted in one way that it may have gone, and how well that is known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drift {
    /// What creeps from a run to the next, µm.
    pub(super) creep_um: f64,
    /// Its standard uncertainty, µm.
    pub(super) creep_standard_um: f64,
    /// Degrees of freedom of that.
    pub(super) degrees_of_freedom: f64,
    /// What is of each run, µm, none on the mean.
    pub(super) runs_um: Vec<f64>,
    /// Standard uncertainty of each, µm.
    pub(super) runs_standard_um: f64,
    /// What is new at every reading, as a standard deviation, µm.
    pub(super) new_um: f64,
    /// What the means of the runs differ from the mean of all, with all that drifted, µm.
    pub(super) means_um: Vec<f64>,
    /// Whole range told: more than that nothing creeps, and nothing of a run is off by more than half.
    pub(super) range_um: f64,
    /// Variance of an approach about the mean of its target and its run, over all, µm².
    pub(super) scatter_um2: f64,
    /// Degrees of freedom as which that counts for one target.
    alike: f64,
}

/// Means of the runs over all approaches, and how the approaches scatter about them.
struct Runs {
    means_um: Vec<f64>,
    /// Variance of an approach about its target's mean and its run's, µm².
    variance_um2: f64,
    /// Targets, each way for itself.
    cells: f64,
    /// Degrees of freedom that the variance of all counts for one of them.
    alike: f64,
}

impl Runs {
    /// From all approaches of one way to a target; `None` when there are not as many of each.
    fn new(targets: &[Target]) -> Option<Self> {
        let cells = || {
            let both = targets.iter().flat_map(|target| [&target.forward_um, &target.backward_um]);
            both.filter(|approaches| !approaches.is_empty())
        };
        let (count, runs) = (cells().count(), cells().next()?.len());
        if cells().any(|approaches| approaches.len() != runs) || count < 2 {
            return None;
        }
        let from_mean = |approaches: &Vec<f64>| -> Vec<f64> {
            let mean_um = mean(approaches);
            approaches.iter().map(|um| um - mean_um).collect()
        };
        let apart: Vec<Vec<f64>> = cells().map(from_mean).collect();
        let mean_of = |run: usize| mean(&apart.iter().map(|cell| cell[run]).collect::<Vec<_>>());
        let means_um: Vec<f64> = (0..runs).map(mean_of).collect();
        let squares = |cell: &Vec<f64>| -> f64 {
            cell.iter().zip(&means_um).map(|(um, mean_um)| (um - mean_um).powi(2)).sum()
        };
        let each: Vec<f64> = apart.iter().map(squares).collect();
        let freedom = number(runs - 1);
        let variance_um2 = each.iter().sum::<f64>() / (number(count - 1) * freedom);
        let alike = alike(&each, freedom);
        Some(Self { means_um, variance_um2, cells: number(count), alike })
    }
}

/// Degrees of freedom of the variance that targets have alike: infinite when theirs differ no more than
/// chance makes them, few when some scatter much more than others.
///
/// Variances that are spread as the inverse of χ² with ν are so with a mean square of
/// (ν − 2)/(ν − 4) times the square of their mean (Smyth, Statistical Applications in Genetics and
/// Molecular Biology 3, 2004, 3), and those found of `freedom` with 1 + 2/`freedom` times that.
fn alike(squares: &[f64], freedom: f64) -> f64 {
    let mean_square = mean(&squares.iter().map(|one| one * one).collect::<Vec<_>>());
    let wider = mean_square / mean(squares).powi(2) / (1.0 + 2.0 / freedom);
    if 1.0 < wider { (4.0 * wider - 2.0) / (wider - 1.0) } else { f64::INFINITY }
}

impl Drift {
    /// Variance of the approaches of one way to a target, µm²: between theirs and that of all.
    pub(super) fn variance_um2(&self, approaches_um: &[f64]) -> f64 {
        if self.alike.is_infinite() {
            return self.scatter_um2;
        }
        let mean_um = mean(approaches_um);
        let squares_um2 = approaches_um.iter().map(|um| (um - mean_um).powi(2)).sum::<f64>();
        let freedom = number(approaches_um.len()) - 1.0;
        (self.alike * self.scatter_um2 + squares_um2) / (self.alike + freedom)
    }

    /// What is new at every reading alone, as a standard deviation, µm.
    pub(super) fn of_device(targets: &[Target], new_um: f64) -> Option<Self> {
        Some(Self { new_um, ..Self::none(&Runs::new(targets)?) })
    }

    /// Every way in which a drift of this range may have gone: as the runs have it, all new at every
    /// reading, all of runs, creeping one way or the other. None when targets have not as many
    /// approaches each.
    pub(super) fn ways(targets: &[Target], range_um: f64) -> Vec<Self> {
        let Some(found) = Runs::new(targets) else { return Vec::new() };
        let none = Self { range_um, ..Self::none(&found) };
        let ways = [
            Self { new_um: range_um / 12.0_f64.sqrt(), ..none.clone() },
            Self { range_um, ..Self::as_found(&found, range_um) },
            Self { range_um, ..Self::of_runs(&found, range_um) },
        ];
        let creeping = [-1.0, 1.0].map(|way| {
            let creep_um = way * range_um / number(found.means_um.len());
            Self { creep_um, ..none.clone() }
        });
        let told = if 0.0 < range_um { 5 } else { 1 };
        ways.into_iter().chain(creeping).take(told).collect()
    }

    fn none(found: &Runs) -> Self {
        Self {
            creep_um: 0.0,
            creep_standard_um: 0.0,
            degrees_of_freedom: f64::INFINITY,
            runs_um: vec![0.0; found.means_um.len()],
            runs_standard_um: 0.0,
            new_um: 0.0,
            means_um: found.means_um.clone(),
            range_um: f64::INFINITY,
            scatter_um2: found.variance_um2,
            alike: found.alike,
        }
    }

    /// All of runs: of what their means differ by as much as the range told can have made.
    fn of_runs(found: &Runs, range_um: f64) -> Self {
        let (of_mean_um2, most_um2) =
            (found.variance_um2 / found.cells, range_um * range_um / 12.0);
        let chance = most_um2 / (most_um2 + of_mean_um2).max(f64::MIN_POSITIVE);
        let share = chance * within(&found.means_um, range_um);
        Self {
            runs_um: found.means_um.iter().map(|um| share * um).collect(),
            runs_standard_um: (chance * of_mean_um2).sqrt(),
            ..Self::none(found)
        }
    }

    /// As the means of the runs have it, as far as the range told goes.
    fn as_found(found: &Runs, range_um: f64) -> Self {
        let runs = number(found.means_um.len());
        let of_mean_um2 = found.variance_um2 / found.cells;
        let order: Vec<f64> =
            (0..found.means_um.len()).map(|run| number(run) - (runs - 1.0) / 2.0).collect();
        let squares: f64 = order.iter().map(|at| at * at).sum();
        let products = order.iter().zip(&found.means_um).map(|(at, um)| at * um);
        let slope_um = products.sum::<f64>() / squares;
        let off_line = order.iter().zip(&found.means_um).map(|(at, um)| um - slope_um * at);
        let off_line_um: Vec<f64> = off_line.collect();
        let off_um2 = off_line_um.iter().map(|um| um * um).sum::<f64>() / (runs - 2.0).max(1.0);
        // What is of a run varies by no more than the range told; chance alone makes means differ too.
        let most_um2 = range_um * range_um / 12.0;
        let freedom = (runs - 2.0).max(1.0);
        let sure = beyond_chance(off_um2 / of_mean_um2, freedom, 1.0 + most_um2 / of_mean_um2);
        let of_run_um2 = sure * (off_um2 - of_mean_um2).max(0.0).min(most_um2);
        let mean_um2 = of_mean_um2 + of_run_um2;
        let freedom = (found.cells - 1.0) * (runs - 1.0);
        let fourth = of_mean_um2.powi(2) / freedom + of_run_um2.powi(2) / (runs - 2.0).max(1.0);
        let share = if 0.0 < of_run_um2 { of_run_um2 / mean_um2 } else { 0.0 };
        // What they differ by beyond the range is the axis itself.
        let its_share = share * within(&off_line_um, range_um);
        let mut drift = Self {
            creep_um: slope_um,
            creep_standard_um: (mean_um2 / squares).sqrt(),
            degrees_of_freedom: if 0.0 < fourth { mean_um2.powi(2) / fourth } else { freedom },
            runs_um: off_line_um.iter().map(|um| its_share * um).collect(),
            runs_standard_um: (share * of_mean_um2).sqrt(),
            ..Self::none(found)
        };
        let of_runs_um = (12.0 * (off_um2 - SURE * SURE * of_mean_um2).max(0.0)).sqrt();
        drift.as_far_as_told(range_um, of_runs_um, runs);
        drift
    }

    /// What creeps farther than was told, and than chance makes it seem, is the axis itself. Where the
    /// range told says more of it than the runs, it is anywhere within that. And what for sure neither
    /// creeps nor is of runs, which have a range of their own, is new at every reading.
    fn as_far_as_told(&mut self, range_um: f64, of_runs_um: f64, runs: f64) {
        let unsure_um = SURE * self.creep_standard_um * runs;
        let most_um = (range_um + unsure_um) / runs;
        self.creep_um = self.creep_um.clamp(-most_um, most_um);
        if range_um < self.creep_standard_um * runs {
            self.creep_um = 0.0;
            self.creep_standard_um = range_um / runs / 3.0_f64.sqrt();
            self.degrees_of_freedom = f64::INFINITY;
        }
        let creeps_um = self.creep_um.abs() * runs;
        let sure_um =
            if unsure_um < creeps_um { creeps_um - unsure_um.powi(2) / creeps_um } else { 0.0 };
        self.new_um = (range_um - sure_um - of_runs_um).max(0.0) / 12.0_f64.sqrt();
    }
}

/// The part of what runs differ by that has a range, all of it at most.
fn within(runs_um: &[f64], range_um: f64) -> f64 {
    let highest = runs_um.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = runs_um.iter().copied().fold(f64::INFINITY, f64::min);
    if range_um < highest - lowest { range_um / (highest - lowest) } else { 1.0 }
}

/// So many standard deviations are more than chance.
const SURE: f64 = 2.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// Four targets, five runs; readings take what `drift_um` says of the run and the reading in it.
    fn targets(drift_um: &dyn Fn(usize, usize) -> f64) -> Vec<Target> {
        let scatter_um = [0.2, -0.1, -0.3, 0.1, 0.1];
        let target = |place: usize| {
            let around = |turn: usize, at: usize| -> Vec<f64> {
                let reading = |run: usize| scatter_um[(run + turn) % 5] + drift_um(run, at);
                (0..5).map(reading).collect()
            };
            Target {
                at_mm: 100.0 * number(place),
                forward_um: around(place, place),
                backward_um: around(place + 2, 7 - place),
            }
        };
        (0..4).map(target).collect()
    }

    #[test]
    fn what_creeps_is_found_and_leaves_nothing_new() {
        let creeping = targets(&|run, at| 0.5 * number(8 * run + at));
        let drift = &Drift::ways(&creeping, 20.0)[1];
        assert!((drift.creep_um - 4.0).abs() < 0.1, "{drift:?}");
        assert!(drift.new_um < 0.05, "{drift:?}");
    }

    #[test]
    fn what_is_of_a_run_is_found() {
        let of_run_um = [3.0, -2.0, -2.0, -2.0, 3.0];
        let drift = &Drift::ways(&targets(&|run, _| of_run_um[run]), 10.0)[1];
        for (found_um, expected_um) in drift.runs_um.iter().zip(of_run_um) {
            assert!((found_um - expected_um).abs() < 0.2, "{drift:?}");
        }
        assert!(drift.new_um < 1.0, "{drift:?}");
    }

    #[test]
    fn without_any_all_that_was_told_may_be_new() {
        let drift = &Drift::ways(&targets(&|_, _| 0.0), 1.2)[1];
        assert!((drift.new_um - 1.2 / 12.0_f64.sqrt()).abs() < 0.1, "{drift:?}");
        assert!(drift.creep_um.abs() < 0.1, "{drift:?}");
    }
}
