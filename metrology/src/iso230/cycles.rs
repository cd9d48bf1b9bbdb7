//! Environments that cycle, of the range told, which the approaches do not exclude.
//!
//! A range says nothing of how the readings went through it. An air conditioning has a period, and
//! when that is one of the runs, each target has the same error in each: no scatter shows it, and it
//! stays in means and reversals. So every period is tried, at several phases. What differs from run to
//! run in another way at each target is the axis' scatter or the environment's; a cycle of the size
//! told that makes it larger than others do is excluded. What runs as a whole and targets as a whole
//! differ by says nothing here, since the axis may do that itself.

use std::f64::consts::TAU;

use super::Target;
use crate::number::{mean, number};

/// Phases of each period; between two of them a cycle is at most 2 % of its size away.
const PHASES: usize = 16;
/// Readings of the shortest period: what goes faster is as good as new at every reading.
const SHORTEST: usize = 4;
/// Parts of a turn over all readings by which a period differs from the next.
const PARTS: usize = 4;
/// Waves of a run that are the same in each: so many of them are always tried, the longest first.
const IN_STEP: usize = 10;
/// Cycles that are evaluated at most: those that are most probable by the approaches.
const MOST: usize = 400;
/// Half the logarithm of how improbable a cycle is beside the best: beyond two standard deviations, as
/// the best of so many.
const EXCLUDED: f64 = 2.0;

/// Approaches without what cycled, each as it may have been.
pub(super) fn without_cycles(targets: &[Target], range_um: f64) -> Vec<Vec<Target>> {
    let Some(order) = Order::of(targets).filter(|_| 0.0 < range_um) else { return Vec::new() };
    let own = order.alone(&|run, cell| {
        let target = &targets[cell / order.ways];
        if cell % order.ways == 0 { target.forward_um[run] } else { target.backward_um[run] }
    });
    // So far a phase may be from the nearest that is tried.
    let size_um = range_um / 2.0 / libm::cos(TAU / number(2 * PHASES));
    let readings = order.readings();
    let of = |frequency| order.cycles(frequency, size_um, &own);
    let of_parts = |parts: usize| of(number(parts) / number(PARTS * readings));
    let mut cycles: Vec<Cycle> = (1..=PARTS * readings / SHORTEST).flat_map(of_parts).collect();
    cycles.sort_by(|a, b| a.left_um2.total_cmp(&b.left_um2));
    let none_um2 = own.iter().map(|um| um * um).sum::<f64>();
    let least_um2 = cycles.first().map_or(none_um2, |best| best.left_um2.min(none_um2));
    let freedom = number((order.runs - 1) * (order.cells - 1));
    let most = EXCLUDED + libm::log(number(readings));
    let may_be = |cycle: &&Cycle| freedom / 2.0 * libm::log(cycle.left_um2 / least_um2) <= most;
    let waves = IN_STEP.min(order.cells / SHORTEST);
    let in_step: Vec<Cycle> =
        (1..=waves).flat_map(|waves| of(number(waves) / number(order.cells))).collect();
    let kept: Vec<&Cycle> = cycles.iter().filter(may_be).collect();
    let step = kept.len().div_ceil(MOST).max(1);
    let each = kept.into_iter().step_by(step).chain(in_step.iter().filter(may_be));
    each.map(|cycle| order.taken_off(targets, cycle)).collect()
}

/// A cycle in the order of the readings, and the sum of squares that it leaves of the approaches.
struct Cycle {
    /// Turns from a reading to the next.
    frequency: f64,
    /// What it is a sine and a cosine of, µm.
    parts_um: [f64; 2],
    left_um2: f64,
}

impl Cycle {
    fn at_um(&self, reading: usize) -> f64 {
        let angle = TAU * self.frequency * number(reading);
        self.parts_um[0] * libm::sin(angle) + self.parts_um[1] * libm::cos(angle)
    }
}

/// In which order readings are taken: each run forward over all targets, and then back.
struct Order {
    runs: usize,
    places: usize,
    ways: usize,
    /// Targets, each way for itself.
    cells: usize,
}

impl Order {
    /// `None` when targets have not as many approaches each.
    fn of(targets: &[Target]) -> Option<Self> {
        let first = targets.first()?;
        let (runs, ways) =
            (first.forward_um.len(), if first.backward_um.is_empty() { 1 } else { 2 });
        let alike = targets.iter().all(|target| {
            target.forward_um.len() == runs && target.backward_um.len() == (ways - 1) * runs
        });
        let (places, cells) = (targets.len(), targets.len() * ways);
        (alike && 1 < cells && 1 < runs).then_some(Self { runs, places, ways, cells })
    }

    fn readings(&self) -> usize {
        self.runs * self.cells
    }

    /// When an approach was read.
    fn reading(&self, run: usize, cell: usize) -> usize {
        let (place, back) = (cell / self.ways, cell % self.ways == 1);
        run * self.cells + if back { 2 * self.places - 1 - place } else { place }
    }

    /// Values of all approaches less what their run and their target have as a whole, run by run.
    fn alone(&self, of: &dyn Fn(usize, usize) -> f64) -> Vec<f64> {
        let mut all: Vec<f64> =
            (0..self.runs).flat_map(|run| (0..self.cells).map(move |cell| of(run, cell))).collect();
        for run in all.chunks_exact_mut(self.cells) {
            let mean_um = mean(run);
            for um in run {
                *um -= mean_um;
            }
        }
        for cell in 0..self.cells {
            let each: Vec<f64> = all.iter().skip(cell).step_by(self.cells).copied().collect();
            let mean_um = mean(&each);
            all.iter_mut().skip(cell).step_by(self.cells).for_each(|um| *um -= mean_um);
        }
        all
    }

    /// A period at all phases, held against approaches of which the rest is `own`.
    fn cycles(&self, frequency: f64, size_um: f64, own: &[f64]) -> Vec<Cycle> {
        let angle = |run, cell| TAU * frequency * number(self.reading(run, cell));
        let sine = self.alone(&|run, cell| libm::sin(angle(run, cell)));
        let cosine = self.alone(&|run, cell| libm::cos(angle(run, cell)));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (own_um2, of_sine, of_cosine) =
            (product(own, own), product(own, &sine), product(own, &cosine));
        let squares = [product(&sine, &sine), product(&sine, &cosine), product(&cosine, &cosine)];
        let at_phase = |phase: usize| {
            let phase = TAU * number(phase) / number(PHASES);
            let [s, c] = [size_um * libm::cos(phase), size_um * libm::sin(phase)];
            let with = s * s * squares[0] + 2.0 * s * c * squares[1] + c * c * squares[2];
            let left_um2 = own_um2 - 2.0 * (s * of_sine + c * of_cosine) + with;
            Cycle { frequency, parts_um: [s, c], left_um2: left_um2.max(f64::MIN_POSITIVE) }
        };
        (0..PHASES).map(at_phase).collect()
    }

    fn taken_off(&self, targets: &[Target], cycle: &Cycle) -> Vec<Target> {
        let still = |place: usize, way: usize, approaches_um: &[f64]| -> Vec<f64> {
            let cell = self.ways * place + way;
            let each = approaches_um.iter().enumerate();
            each.map(|(run, um)| um - cycle.at_um(self.reading(run, cell))).collect()
        };
        let target = |(place, target): (usize, &Target)| Target {
            at_mm: target.at_mm,
            forward_um: still(place, 0, &target.forward_um),
            backward_um: still(place, 1, &target.backward_um),
        };
        targets.iter().enumerate().map(target).collect()
    }
}
