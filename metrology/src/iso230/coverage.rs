//! Does U hold the true figure as often as it says? Axes and errors of measurement are drawn.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Approaches, Target};
use crate::drawn::{heavy_tailed, normal};
use crate::number::number;
use crate::uncertainty::{Acts, Added, Distribution, Readings, Source, budgets, misalignment};

/// What kind of axis is drawn: 21 targets over a metre, its waves anywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// It rises by 10 µm over its length, with a wave.
    Rising,
    /// It rises by 3 µm, twice the standard uncertainty of the scale over its length.
    RisingALittle,
    /// It rises by once that.
    RisingLess,
    /// It falls by once that.
    FallingLess,
    /// Waves of half its length and of an eighth.
    Waves,
    /// Nothing but reversal and scatter.
    Flat,
}

/// How it is approached and what the drift does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// Five approaches from each side; the drift adds to each reading.
    Usual,
    /// Three approaches from each side.
    ThreeRuns,
    /// Scatter and reversal of a tenth.
    Still,
    /// Scatter with the tails of Student's t for three degrees of freedom.
    HeavyTails,
    /// The drift is one of each run.
    DriftOfRuns,
    /// The drift goes from nothing to its most from the first reading to the last.
    Creeping,
    /// The axis itself differs from run to run, by a standard deviation of 0.5 µm.
    OwnRuns,
    /// The axis itself creeps by 1 µm in the test.
    Growing,
    /// The drift is a wave of ten readings.
    CycleOfTenReadings,
    /// The drift is a wave of one run, the same in each.
    CycleOfARun,
    /// The drift is a wave of a run and a third.
    CycleOfMoreThanARun,
    /// The drift is a wave of two runs.
    CycleOfTwoRuns,
    /// The drift is a wave of three runs.
    CycleOfThreeRuns,
    /// The drift is a random walk, its range that of another one.
    Wandering,
}

/// Share of the figures of which U holds the truth, by symbol.
pub type Held = Vec<(&'static str, f64)>;

/// True scatter of an approach, and half of the reversal, µm.
const SCATTER_UM: f64 = 0.3;
const HALF_REVERSAL_UM: f64 = 0.4;
const TARGETS: u32 = 21;

impl Axis {
    /// All kinds, in the order of the table.
    pub const ALL: [Self; 6] = [
        Self::Rising,
        Self::RisingALittle,
        Self::RisingLess,
        Self::FallingLess,
        Self::Waves,
        Self::Flat,
    ];

    /// The axis in words, as the table of coverage has it.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Rising => "rises by 10 µm, with a wave",
            Self::RisingALittle => "rises by 3 µm",
            Self::RisingLess => "rises by 1.4 µm",
            Self::FallingLess => "falls by 1.4 µm",
            Self::Waves => "waves of 500 mm and 125 mm",
            Self::Flat => "flat: reversal and scatter alone",
        }
    }

    fn deviation_um(self, at_mm: f64, phases: [f64; 2]) -> f64 {
        let wave = |size_um: f64, length_mm: f64, phase: f64| {
            size_um * libm::sin(TAU * at_mm / length_mm + phase)
        };
        match self {
            Self::Rising => 0.01 * at_mm + wave(1.0, 300.0, phases[0]),
            Self::RisingALittle => 0.003 * at_mm,
            Self::RisingLess => 0.0014 * at_mm,
            Self::FallingLess => -0.0014 * at_mm,
            Self::Waves => wave(3.0, 500.0, phases[0]) + wave(1.0, 125.0, phases[1]),
            Self::Flat => 0.0,
        }
    }

    /// Approaches as they are, without any error of measurement.
    fn drawn(self, condition: Condition, chance: &mut ChaCha8Rng) -> Vec<Target> {
        let phases = [0, 1].map(|_| chance.random_range(0.0..TAU));
        let part = if condition == Condition::Still { 0.1 } else { 1.0 };
        let target = |k: u32| {
            let at_mm = 50.0 * f64::from(k);
            let mut around = |shift_um: f64| -> Vec<f64> {
                let mean_um = self.deviation_um(at_mm, phases) + part * shift_um;
                let approach = |_| mean_um + part * SCATTER_UM * condition.scattered(chance);
                (0..condition.runs()).map(approach).collect()
            };
            Target {
                at_mm,
                forward_um: around(HALF_REVERSAL_UM),
                backward_um: around(-HALF_REVERSAL_UM),
            }
        };
        let mut targets: Vec<Target> = (0..TARGETS).map(target).collect();
        let [runs_um, creep_um] = condition.own_um();
        if 0.0 < runs_um + creep_um {
            let last = number(2 * condition.runs() * targets.len() - 1);
            let of_runs_um: Vec<f64> =
                (0..condition.runs()).map(|_| runs_um * normal(chance)).collect();
            in_order(&mut targets, condition.runs(), &mut |run, read| {
                of_runs_um[run] + creep_um * number(read) / last
            });
        }
        targets
    }
}

impl Condition {
    /// All, in the order of the table.
    pub const ALL: [Self; 14] = [
        Self::Usual,
        Self::ThreeRuns,
        Self::Still,
        Self::HeavyTails,
        Self::DriftOfRuns,
        Self::Creeping,
        Self::OwnRuns,
        Self::Growing,
        Self::CycleOfTenReadings,
        Self::CycleOfARun,
        Self::CycleOfMoreThanARun,
        Self::CycleOfTwoRuns,
        Self::CycleOfThreeRuns,
        Self::Wandering,
    ];

    /// The condition in words, as the table of coverage has it.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Usual => "from reading to reading",
            Self::ThreeRuns => "three runs",
            Self::Still => "scatter and reversal of a tenth",
            Self::HeavyTails => "scatter with heavy tails",
            Self::DriftOfRuns => "from run to run",
            Self::Creeping => "from the first reading to the last",
            Self::OwnRuns => "the axis differs from run to run by 0.5 µm",
            Self::Growing => "the axis creeps by 1 µm",
            Self::CycleOfTenReadings => "a wave of ten readings",
            Self::CycleOfARun => "a wave of one run",
            Self::CycleOfMoreThanARun => "a wave of 55 readings",
            Self::CycleOfTwoRuns => "a wave of two runs",
            Self::CycleOfThreeRuns => "a wave of three runs",
            Self::Wandering => "a random walk",
        }
    }

    /// True where the drift is a wave or a walk.
    #[must_use]
    pub fn cycles(self) -> bool {
        self.period().is_some() || self == Self::Wandering
    }

    /// Readings of a wave.
    fn period(self) -> Option<f64> {
        match self {
            Self::CycleOfTenReadings => Some(10.0),
            Self::CycleOfARun => Some(42.0),
            Self::CycleOfMoreThanARun => Some(55.0),
            Self::CycleOfTwoRuns => Some(84.0),
            Self::CycleOfThreeRuns => Some(126.0),
            _ => None,
        }
    }

    /// What of the axis itself differs from run to run, as a standard deviation, and what creeps in the
    /// test, µm.
    fn own_um(self) -> [f64; 2] {
        match self {
            Self::OwnRuns => [0.5, 0.0],
            Self::Growing => [0.0, 1.0],
            _ => [0.0, 0.0],
        }
    }

    fn runs(self) -> usize {
        if self == Self::ThreeRuns { 3 } else { 5 }
    }

    /// Scatter of one approach about its mean, its standard deviation one.
    fn scattered(self, chance: &mut ChaCha8Rng) -> f64 {
        if self == Self::HeavyTails { heavy_tailed(chance) } else { normal(chance) }
    }
}

/// What is known of the measurement: a laser of 0.4 µm/m (k = 2), a beam within 1.5 mm over a metre,
/// steel at 22 °C known to ±0.1 K and ±1 µm/(m·K), and a drift of up to `variation_um`.
fn sources(variation_um: f64) -> Vec<Source> {
    let source = |standard: f64, distribution, acts| Source {
        quantity: String::new(),
        estimate: 0.0,
        unit: "",
        standard,
        distribution,
        degrees_of_freedom: f64::INFINITY,
        acts,
    };
    let rectangle =
        |range: f64, acts| source(range / 12.0_f64.sqrt(), Distribution::Rectangular, acts);
    vec![
        source(0.2, Distribution::Normal, Acts::OnLengths(1.0)),
        misalignment(1.5, 1000.0),
        rectangle(0.2, Acts::OnLengths(11.5)),
        rectangle(2.0, Acts::OnLengths(2.0)),
        rectangle(variation_um, Acts::AsTimeGoes(1.0)),
    ]
}

/// Draws so many tests of an axis and counts how often U holds the figure of the same approaches
/// without errors of measurement.
///
/// # Errors
///
/// When an axis cannot be evaluated; all of these can.
pub fn coverage(
    (axis, condition): (Axis, Condition),
    variation_um: f64,
    records: u32,
    seed: u64,
) -> Result<Held, crate::Error> {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let sources = sources(variation_um);
    let mut held: Held = Vec::new();
    for _ in 0..records {
        let truth = Approaches::new(axis.drawn(condition, &mut chance))?;
        let measured = Approaches::new(measured(&truth, condition, &sources, &mut chance))?;
        if held.is_empty() {
            held = truth.found().figures().iter().map(|figure| (figure.symbol, 0.0)).collect();
        }
        let budgets = budgets(&measured, &sources);
        let true_um = truth.figures_um(Added::Nothing);
        for ((_, held), (budget, true_um)) in held.iter_mut().zip(budgets.iter().zip(true_um)) {
            if budget.holds(true_um) {
                *held += 1.0 / f64::from(records);
            }
        }
    }
    Ok(held)
}

/// The approaches with an error of every source, drawn as it is spread.
fn measured(
    truth: &Approaches,
    condition: Condition,
    sources: &[Source],
    chance: &mut ChaCha8Rng,
) -> Vec<Target> {
    let mut targets = truth.targets.clone();
    for source in sources {
        match source.acts {
            Acts::OnLengths(per_unit) => {
                let um_per_m = per_unit * error(source, chance);
                for target in &mut targets {
                    let um = um_per_m * target.at_mm / 1000.0;
                    target.forward_um.iter_mut().for_each(|reading| *reading += um);
                    target.backward_um.iter_mut().for_each(|reading| *reading += um);
                }
            }
            Acts::AsTimeGoes(_) => drift(&mut targets, condition, source, chance),
            _ => {}
        }
    }
    targets
}

/// Readings drift in the order they are taken.
fn drift(targets: &mut [Target], condition: Condition, source: &Source, chance: &mut ChaCha8Rng) {
    let (runs, places) = (condition.runs(), targets.len());
    let (all, range_um) = (2 * runs * places, source.standard * 12.0_f64.sqrt());
    let walked_um =
        if condition == Condition::Wandering { walk(all, range_um, chance) } else { Vec::new() };
    let phase = if condition.period().is_some() { chance.random_range(0.0..TAU) } else { 0.0 };
    let (mut of_run_um, mut current) = (0.0, runs);
    in_order(targets, runs, &mut |run, read| {
        if run != current {
            (of_run_um, current) = (error(source, chance), run);
        }
        match (condition, condition.period()) {
            (Condition::DriftOfRuns, _) => of_run_um,
            (Condition::Creeping, _) => range_um * number(read) / number(all - 1),
            (Condition::Wandering, _) => walked_um[read],
            (_, Some(period)) => range_um / 2.0 * libm::sin(TAU * number(read) / period + phase),
            _ => error(source, chance),
        }
    });
}

/// A walk by chance, as far as another one of as many steps went, on average over all of them.
fn walk(steps: usize, range_um: f64, chance: &mut ChaCha8Rng) -> Vec<f64> {
    let mut walked = |step_um: f64| -> Vec<f64> {
        let mut at_um = 0.0;
        let mut next = || {
            at_um += step_um * normal(chance);
            at_um
        };
        (0..steps).map(|_| next()).collect()
    };
    // A walk of n steps has a range of √(8·n/π) of them on average (Feller, 1951).
    walked(range_um / (8.0 * number(steps) / std::f64::consts::PI).sqrt())
}

/// Adds to readings in the order they are taken, run by run, forward and back again: what is added is
/// asked by the run and the reading.
fn in_order(targets: &mut [Target], runs: usize, added_um: &mut dyn FnMut(usize, usize) -> f64) {
    let places = targets.len();
    for run in 0..runs {
        for step in 0..2 * places {
            let um = added_um(run, run * 2 * places + step);
            match step.checked_sub(places) {
                None => targets[step].forward_um[run] += um,
                Some(back) => targets[places - 1 - back].backward_um[run] += um,
            }
        }
    }
}

/// An error as its source says it is spread, in the source's unit.
fn error(source: &Source, chance: &mut ChaCha8Rng) -> f64 {
    match source.distribution {
        Distribution::Normal => source.standard * normal(chance),
        Distribution::Rectangular => {
            source.standard * 3.0_f64.sqrt() * chance.random_range(-1.0..1.0)
        }
        Distribution::SquareOfRectangular => {
            let part: f64 = chance.random_range(0.0..1.0);
            -source.standard * 5.0_f64.sqrt() * part * part
        }
    }
}

/// Mean over the figures, of the share that is held.
#[must_use]
pub fn overall(held: &Held) -> f64 {
    held.iter().map(|(_, share)| share).sum::<f64>() / number(held.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawn::records;

    /// 300 records: 91 % is three standard deviations below 95.45 %.
    #[test]
    fn what_spans_the_axis_is_held_as_often_as_said() {
        let found = coverage((Axis::Rising, Condition::Usual), 0.2, records(100, 300), 1).unwrap();
        for (symbol, share) in found.iter().filter(|(symbol, _)| ["A", "E", "M"].contains(symbol)) {
            assert!((0.91..=0.99).contains(share), "{symbol} {share}");
        }
    }

    /// What the axis does itself, and what cycles or walks: 30 records of each; 83 % is more than three
    /// standard deviations below 95.45 %. Taken for the environment's, R of the first was held in 3 %, and
    /// B̄ of the second and of a wave of one run in none and 6 %.
    #[test]
    fn what_the_axis_does_itself_and_what_cycles_is_held() {
        for (condition, variation_um) in [
            (Condition::OwnRuns, 0.2),
            (Condition::Growing, 0.2),
            (Condition::CycleOfTenReadings, 0.5),
            (Condition::CycleOfARun, 0.5),
            (Condition::CycleOfTwoRuns, 0.5),
            (Condition::Wandering, 0.5),
        ] {
            let found =
                coverage((Axis::Rising, condition), variation_um, records(15, 30), 1).unwrap();
            for (symbol, share) in found {
                assert!(0.83 < share, "{condition:?}: {symbol} {share}");
            }
        }
    }
}
