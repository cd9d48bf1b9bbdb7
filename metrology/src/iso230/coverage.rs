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
        (0..TARGETS).map(target).collect()
    }
}

impl Condition {
    /// All, in the order of the table.
    pub const ALL: [Self; 6] = [
        Self::Usual,
        Self::ThreeRuns,
        Self::Still,
        Self::HeavyTails,
        Self::DriftOfRuns,
        Self::Creeping,
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

/// Readings drift in the order they are taken: run by run, forward and back again.
fn drift(targets: &mut [Target], condition: Condition, source: &Source, chance: &mut ChaCha8Rng) {
    let (runs, places) = (condition.runs(), targets.len());
    let (mut read, last) = (0.0, number(2 * runs * places - 1));
    for run in 0..runs {
        let of_run_um = error(source, chance);
        for step in 0..2 * places {
            let drift_um = match condition {
                Condition::DriftOfRuns => of_run_um,
                Condition::Creeping => source.standard * 12.0_f64.sqrt() * read / last,
                _ => error(source, chance),
            };
            match step.checked_sub(places) {
                None => targets[step].forward_um[run] += drift_um,
                Some(back) => targets[places - 1 - back].backward_um[run] += drift_um,
            }
            read += 1.0;
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

    /// 300 records: 91 % is three standard deviations below 95.45 %.
    #[test]
    fn what_spans_the_axis_is_held_as_often_as_said() {
        let found = coverage((Axis::Rising, Condition::Usual), 0.2, 300, 1).unwrap();
        for (symbol, share) in found.iter().filter(|(symbol, _)| ["A", "E", "M"].contains(symbol)) {
            assert!((0.91..=0.99).contains(share), "{symbol} {share}");
        }
    }
}
