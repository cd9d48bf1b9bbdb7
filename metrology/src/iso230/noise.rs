//! What the errors of single readings do to the figures of an axis, by drawing (JCGM 101:2008).
//!
//! Noise makes a scatter wider and the largest of many reversals larger. By how much the approaches
//! tell, since how far the readings are off is known: of what an approach lies from its mean, that
//! share is the reading's which its variance has of theirs (the mean of a normal number of which a
//! sum was read). So errors are drawn as they may have been, given what was read, taken off, and the
//! rest is evaluated.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::Target;
use super::cycles::without_cycles;
use super::drift::Drift;
use crate::drawn::normal;
use crate::number::{mean, number};
use crate::uncertainty::{Acts, Source, student};

/// Sets of errors that are drawn: a standard deviation of theirs is known to 4 %.
const DRAWS: usize = 300;
/// Sets for each cycle, of which there are many.
const DRAWS_OF_CYCLE: usize = 30;
const SEED: u64 = 1;

/// What is told of the readings, as standard deviations, µm.
#[expect(clippy::struct_field_names, reason = "all are in µm")]
struct Told {
    at_each_place_um: f64,
    at_each_reading_um: f64,
    /// Whole range of the drift.
    drift_range_um: f64,
}

impl Told {
    fn new(sources: &[Source]) -> Self {
        let root = |of: &dyn Fn(&Source) -> f64| {
            sources.iter().map(|source| of(source).powi(2)).sum::<f64>().sqrt()
        };
        Self {
            at_each_place_um: root(&|source| match source.acts {
                Acts::AtEachPlace(um) => um * source.standard,
                _ => 0.0,
            }),
            at_each_reading_um: root(&|source| match source.acts {
                Acts::AtEachReading(um) => um * source.standard,
                _ => 0.0,
            }),
            drift_range_um: root(&|source| match source.acts {
                Acts::AsTimeGoes(um) => um * source.standard * 12.0_f64.sqrt(),
                _ => 0.0,
            }),
        }
    }
}

/// The approaches without errors of single readings, as they may have been, drawn for each way in which
/// the drift may have gone; none when there are not as many of each target, so that no run can be told.
///
/// Nothing tells these ways apart for sure, as the axis itself may differ from run to run and creep:
/// the range told may be new at every reading, of the runs, creep either way, or be in all of these as
/// the means of the runs have it; and it may cycle.
pub(super) fn without_noise(targets: &[Target], sources: &[Source]) -> Vec<Vec<Vec<Target>>> {
    let told = Told::new(sources);
    let ways = Drift::ways(targets, told.drift_range_um);
    let mut chance = ChaCha8Rng::seed_from_u64(SEED);
    let mut drawn: Vec<Vec<Vec<Target>>> = Vec::new();
    for mut drift in ways {
        drift.new_um = libm::hypot(drift.new_um, told.at_each_reading_um);
        let errors = Errors::new(targets, &drift, told.at_each_place_um);
        let sets = if errors.are_certain() { 1 } else { DRAWS };
        drawn.push((0..sets).map(|_| errors.taken_off(&mut chance)).collect());
    }
    if drawn.is_empty() {
        return drawn;
    }
    // What the device adds is in a cycle as well; where it adds nothing one draw is all of them.
    let still = libm::hypot(told.at_each_reading_um, told.at_each_place_um) <= 0.0;
    for cycled in without_cycles(targets, told.drift_range_um) {
        let Some(drift) = Drift::of_device(&cycled, told.at_each_reading_um).filter(|_| !still)
        else {
            drawn.push(vec![cycled]);
            continue;
        };
        let errors = Errors::new(&cycled, &drift, told.at_each_place_um);
        drawn.push((0..DRAWS_OF_CYCLE).map(|_| errors.taken_off(&mut chance)).collect());
    }
    drawn
}

/// Approaches, and how far their readings may be off.
struct Errors<'a> {
    targets: &'a [Target],
    drift: &'a Drift,
    place_um: f64,
    /// Of the mean of both ways and of the reversal at each target.
    middles: Shared,
    reversals: Shared,
}

/// What is read of each target, and what of it is an error: as far as it lies beside what is expected
/// there, and as drawn.
#[expect(clippy::struct_field_names, reason = "all are in µm")]
struct Shared {
    /// Mean of the error, given what was read, µm.
    means_um: Vec<f64>,
    /// What is left unknown, as a standard deviation, µm.
    left_um: Vec<f64>,
    /// What is unknown of all alike, µm.
    alike_um: f64,
}

impl Shared {
    fn drawn_um(&self, chance: &mut ChaCha8Rng) -> Vec<f64> {
        let own: Vec<f64> = self.left_um.iter().map(|um| um * normal(chance)).collect();
        let off_um = self.alike_um * normal(chance) - mean(&own);
        self.means_um.iter().zip(&own).map(|(mean_um, own_um)| mean_um + own_um + off_um).collect()
    }
}

impl<'a> Errors<'a> {
    fn new(targets: &'a [Target], drift: &'a Drift, place_um: f64) -> Self {
        let runs = number(targets.first().map_or(1, |target| target.forward_um.len()));
        let mean_um2 = drift.new_um.powi(2) / runs;
        Self {
            targets,
            drift,
            place_um,
            middles: of_middles(targets, mean_um2),
            reversals: of_reversals(targets, drift, mean_um2),
        }
    }

    /// True when nothing is by chance, so that one draw is all of them.
    fn are_certain(&self) -> bool {
        let drift = self.drift;
        drift.new_um + drift.creep_standard_um + drift.runs_standard_um + self.place_um <= 0.0
    }

    /// The approaches without errors as they may have been.
    fn taken_off(&self, chance: &mut ChaCha8Rng) -> Vec<Target> {
        let (drift, places) = (self.drift, self.targets.len());
        let wider = student(drift.degrees_of_freedom) / 2.0;
        let creep_um = drift.creep_um + wider * drift.creep_standard_um * normal(chance);
        let most_um = drift.range_um / number(drift.runs_um.len());
        let creep_um = creep_um.clamp(-most_um, most_um);
        let of_run = |um: &f64| um + drift.runs_standard_um * normal(chance);
        let mut runs_um: Vec<f64> = drift.runs_um.iter().map(of_run).collect();
        let half_um = drift.range_um / 2.0;
        for um in &mut runs_um {
            *um = um.clamp(-half_um, half_um);
        }
        let left_um = self.left_of_runs_um(creep_um, &runs_um);
        let (middles_um, reversals_um) =
            (self.middles.drawn_um(chance), self.reversals.drawn_um(chance));
        let target = |(place, target): (usize, &Target)| {
            let still = |approaches_um: &[f64], read: usize| -> Vec<f64> {
                let part = number(read) / number(2 * places);
                let each = approaches_um.iter().zip(&runs_um).enumerate();
                each.map(|(run, (um, of_run_um))| um - creep_um * (number(run) + part) - of_run_um)
                    .collect()
            };
            let forward_um = still(&target.forward_um, place);
            let backward_um = still(&target.backward_um, 2 * places - 1 - place);
            let both_um = middles_um[place] + self.place_um * normal(chance);
            let half_um = reversals_um[place] / 2.0;
            Target {
                at_mm: target.at_mm,
                forward_um: self.narrowed(&forward_um, both_um + half_um, &left_um, chance),
                backward_um: self.narrowed(&backward_um, both_um - half_um, &left_um, chance),
            }
        };
        self.targets.iter().enumerate().map(target).collect()
    }

    /// What runs differ by as a whole without what drifted: the axis does that itself, and single
    /// readings do not.
    fn left_of_runs_um(&self, creep_um: f64, runs_um: &[f64]) -> Vec<f64> {
        let each = self.drift.means_um.iter().zip(runs_um).enumerate();
        let left = each.map(|(run, (um, of_run_um))| um - creep_um * number(run) - of_run_um);
        let left_um: Vec<f64> = left.collect();
        let mean_um = mean(&left_um);
        left_um.iter().map(|um| um - mean_um).collect()
    }

    /// Approaches of one way less what their mean is off by, each less its own part of the scatter
    /// beside what is of the runs.
    fn narrowed(
        &self,
        approaches_um: &[f64],
        off_um: f64,
        of_runs_um: &[f64],
        chance: &mut ChaCha8Rng,
    ) -> Vec<f64> {
        let mean_um = mean(approaches_um);
        let read_um2 = self.drift.new_um.powi(2);
        let share = share_of(read_um2, self.drift.variance_um2(approaches_um));
        let left_um = (read_um2 * (1.0 - share)).sqrt();
        let drawn: Vec<f64> = approaches_um.iter().map(|_| left_um * normal(chance)).collect();
        let drawn_mean_um = mean(&drawn);
        let each = approaches_um.iter().zip(of_runs_um).zip(&drawn);
        each.map(|((um, of_run_um), drawn)| {
            um - off_um - share * (um - mean_um - of_run_um) - (drawn - drawn_mean_um)
        })
        .collect()
    }
}

/// The mean of both ways: an error shows as far as a target lies beside the line through its
/// neighbours, of which the variance is 3/2 of its own and 6 at the ends. A form that bends between
/// targets makes that more, and the share of the readings less.
fn of_middles(targets: &[Target], mean_um2: f64) -> Shared {
    let both = targets.iter().map(|target| {
        let forward_um = mean(&target.forward_um);
        if target.backward_um.is_empty() {
            return (forward_um, mean_um2);
        }
        (f64::midpoint(forward_um, mean(&target.backward_um)), mean_um2 / 2.0)
    });
    let (middles_um, errors_um2): (Vec<f64>, Vec<f64>) = both.unzip();
    let bends: Vec<f64> =
        middles_um.windows(3).map(|um| um[1] - f64::midpoint(um[0], um[2])).collect();
    let squares = bends.iter().map(|um| um * um).sum::<f64>();
    let own_um2 = squares / 1.5 / number(bends.len().max(1));
    let mut shared = Shared { means_um: Vec::new(), left_um: Vec::new(), alike_um: 0.0 };
    for (place, error_um2) in errors_um2.iter().enumerate() {
        let (beside_um, times) = match place.checked_sub(1).and_then(|before| bends.get(before)) {
            Some(bend_um) => (*bend_um, 1.5),
            // At an end, of the line through the two next to it.
            None => (-2.0 * bends.get(place.saturating_sub(2)).copied().unwrap_or_default(), 6.0),
        };
        let share = share_of(*error_um2, own_um2) / times;
        shared.means_um.push(share * beside_um);
        shared.left_um.push((error_um2 * (1.0 - share)).sqrt());
    }
    shared
}

/// The reversal: an error shows as far as it is not that of the others.
fn of_reversals(targets: &[Target], drift: &Drift, mean_um2: f64) -> Shared {
    let places = targets.len();
    let reversal = |(place, target): (usize, &Target)| {
        // Part of a run between the approaches from both sides.
        let part = number(2 * (places - place) - 1) / number(2 * places);
        mean(&target.forward_um) - mean(&target.backward_um) + drift.creep_um * part
    };
    if targets.iter().any(|target| target.backward_um.is_empty()) {
        return Shared { means_um: vec![0.0; places], left_um: vec![0.0; places], alike_um: 0.0 };
    }
    let reversals_um: Vec<f64> = targets.iter().enumerate().map(reversal).collect();
    let mean_um = mean(&reversals_um);
    let squares: f64 = reversals_um.iter().map(|um| (um - mean_um).powi(2)).sum();
    let all_um2 = squares / number((places - 1).max(1));
    let error_um2 = 2.0 * mean_um2;
    // Where approaches scatter more, so does the reversal.
    let share = |target: &Target| {
        let ways = [&target.forward_um, &target.backward_um];
        let times = mean(&ways.map(|way| drift.variance_um2(way))) / drift.scatter_um2;
        share_of(error_um2, all_um2 * times)
    };
    let shares: Vec<f64> = targets.iter().map(share).collect();
    let own = shares.iter().zip(&reversals_um);
    Shared {
        means_um: own.map(|(share, um)| share * (um - mean_um)).collect(),
        left_um: shares.iter().map(|share| (error_um2 * (1.0 - share)).sqrt()).collect(),
        alike_um: (error_um2 / number(places)).sqrt(),
    }
}

/// Share of a part in a variance that has it, one at most.
fn share_of(part_um2: f64, all_um2: f64) -> f64 {
    if part_um2 < all_um2 { part_um2 / all_um2 } else { 1.0 }
}
