//! Does U hold the true figure as often as it says? Axes and errors of measurement are drawn.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution as _, StandardNormal};

use super::{Approaches, Target};
use crate::number::number;
use crate::uncertainty::{Acts, Added, Distribution, Readings, Source, budgets, misalignment};

/// What kind of axis is drawn: 21 targets over a metre, five approaches from each side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// It rises by 10 µm over its length, with a wave.
    Rising,
    /// Waves of half its length and of an eighth.
    Waves,
    /// Nothing but reversal and scatter.
    Flat,
}

/// Share of the figures whose truth lies within ±U, by symbol.
pub type Held = Vec<(&'static str, f64)>;

/// True scatter of an approach, µm.
const SCATTER_UM: f64 = 0.3;
const TARGETS: u32 = 21;
const RUNS: usize = 5;

impl Axis {
    /// All kinds, in the order of the table.
    pub const ALL: [Self; 3] = [Self::Rising, Self::Waves, Self::Flat];

    /// The axis in words, as the table of coverage has it.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Rising => "rises by 10 µm, with a wave",
            Self::Waves => "waves of 500 mm and 125 mm",
            Self::Flat => "flat: reversal and scatter alone",
        }
    }

    fn deviation_um(self, at_mm: f64) -> f64 {
        let wave = |size_um: f64, length_mm: f64| size_um * libm::sin(TAU * at_mm / length_mm);
        match self {
            Self::Rising => 0.01 * at_mm + wave(1.0, 300.0),
            Self::Waves => wave(3.0, 500.0) + wave(1.0, 125.0),
            Self::Flat => 0.0,
        }
    }

    /// Approaches as they are, without any error of measurement.
    fn drawn(self, chance: &mut ChaCha8Rng) -> Vec<Target> {
        let target = |k: u32| {
            let at_mm = 50.0 * f64::from(k);
            let mut around = |shift_um: f64| -> Vec<f64> {
                let approach =
                    |_| self.deviation_um(at_mm) + shift_um + SCATTER_UM * normal(chance);
                (0..RUNS).map(approach).collect()
            };
            Target { at_mm, forward_um: around(0.4), backward_um: around(-0.4) }
        };
        (0..TARGETS).map(target).collect()
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
        rectangle(variation_um, Acts::AtEachReading(1.0)),
    ]
}

/// Draws so many tests of an axis and counts how often ±U holds the figure of the same approaches
/// without errors of measurement.
///
/// # Errors
///
/// When an axis cannot be evaluated; all of these can.
pub fn coverage(
    axis: Axis,
    variation_um: f64,
    records: u32,
    seed: u64,
) -> Result<Held, crate::Error> {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let sources = sources(variation_um);
    let mut held: Held = Vec::new();
    for _ in 0..records {
        let truth = Approaches::new(axis.drawn(&mut chance))?;
        let measured = Approaches::new(measured(&truth, &sources, &mut chance))?;
        if held.is_empty() {
            held = truth.found().figures().iter().map(|figure| (figure.symbol, 0.0)).collect();
        }
        let budgets = budgets(&measured, &sources);
        let true_um = truth.figures_um(Added::Nothing);
        for ((_, held), (budget, true_um)) in held.iter_mut().zip(budgets.iter().zip(true_um)) {
            if (budget.value_um - true_um).abs() <= budget.expanded_um {
                *held += 1.0 / f64::from(records);
            }
        }
    }
    Ok(held)
}

/// The approaches with an error of every source, drawn as it is spread.
fn measured(truth: &Approaches, sources: &[Source], chance: &mut ChaCha8Rng) -> Vec<Target> {
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
            Acts::AtEachReading(per_unit) => {
                for target in &mut targets {
                    for reading in target.forward_um.iter_mut().chain(&mut target.backward_um) {
                        *reading += per_unit * error(source, chance);
                    }
                }
            }
            Acts::AtEachPlace(_) | Acts::OnFigures(_) => {}
        }
    }
    targets
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

fn normal(chance: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(chance)
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
        let found = coverage(Axis::Rising, 0.2, 300, 1).unwrap();
        for (symbol, share) in found.iter().filter(|(symbol, _)| ["A", "E", "M"].contains(symbol)) {
            assert!((0.91..=0.99).contains(share), "{symbol} {share}");
        }
    }
}
