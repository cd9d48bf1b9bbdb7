//! Which shaft makes the error: amplitude against order, with names.

use std::f64::consts::TAU;

use helixlock_fourier::{Complex, forward};

use super::method::Sample;
use crate::Error;
use crate::banded::Banded;
use crate::number::number;

/// A shaft or a mesh, by its turns for one turn of the output.
#[derive(Clone, Debug, PartialEq)]
pub struct Shaft {
    /// Its name.
    pub name: String,
    /// Turns for one turn of the output; with teeth, order × teeth.
    pub order: f64,
}

/// One line of the spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderLine {
    /// Periods for one turn of the output.
    pub order: f64,
    /// Amplitude, rad.
    pub amplitude_rad: f64,
}

/// What one named shaft contributes.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaftLine {
    /// The shaft.
    pub shaft: Shaft,
    /// Amplitude at its order by least squares over all named orders, rad.
    pub amplitude_rad: f64,
    /// Phase of its sine at the first sample, rad.
    pub phase_rad: f64,
}

/// Amplitude against order.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderSpectrum {
    /// Turns of the output that the samples stand for, each for its own step.
    pub turns: f64,
    /// Slope removed, rad a turn: the ratio is not what it was said to be, or the run drifts. Only samples
    /// whole turns apart tell it from what repeats with the turn; absent where there are none.
    pub slope_rad_per_turn: Option<f64>,
    /// Lines, from the lowest order to half the samples; none with less than a whole turn, which does not
    /// tell orders apart.
    pub lines: Vec<OrderLine>,
    /// Named contributions; shafts the samples are too few or the run is too short for are left out.
    pub shafts: Vec<ShaftLine>,
}

/// The order spectrum of δ.
///
/// Samples are even in output turns (each method gives them at output pulses), and each stands for its
/// step: 720 pulses of a disc of 720 lines are a turn. As many whole turns as there are go in. Line `m`
/// has the order `m/turns`, and an amplitude of a sine on its order comes out as it is. With less than a
/// turn there are no lines and no slope, and the named shafts are fitted with a constant alone: the
/// ratio is exact, so δ has no slope of its own.
///
/// # Errors
///
/// When there are fewer than eight samples.
pub fn order_spectrum(samples: &[Sample], shafts: &[Shaft]) -> Result<OrderSpectrum, Error> {
    let whole = whole_turns(samples);
    if whole.len() < 8 {
        return Err(Error::TooFewSamples { found: whole.len(), expected: 8 });
    }
    let step_turns =
        (whole[whole.len() - 1].output_turns - whole[0].output_turns) / number(whole.len() - 1);
    let turns = step_turns * number(whole.len());
    let is_whole = 1.0 - WHOLE < turns;
    let slope_rad_per_turn = slope(samples).filter(|_| is_whole);
    let flat_rad = flat(whole, slope_rad_per_turn.unwrap_or(0.0));
    let lines = if is_whole { lines(&flat_rad, turns) } else { Vec::new() };
    let highest = 0.5 / step_turns;
    let fast = shafts.iter().filter(|shaft| shaft.order < highest).cloned().collect::<Vec<_>>();
    // What turns less than half a period is in the fit, so that it is not taken for others, and not told.
    let mut shafts = named(whole, &flat_rad, &fast);
    shafts.retain(|one| LEAST_PERIODS / turns < one.shaft.order);
    Ok(OrderSpectrum { turns, slope_rad_per_turn, lines, shafts })
}

/// Part of a turn by which a whole one may be short: rounding.
const WHOLE: f64 = 1e-9;
/// Periods of a shaft that a run has to hold. Chosen: with less than half of one, a sine and a constant are
/// much the same.
const LEAST_PERIODS: f64 = 0.5;

fn lines(flat_rad: &[f64], turns: f64) -> Vec<OrderLine> {
    let mut spectrum: Vec<Complex<f64>> =
        flat_rad.iter().map(|&value| Complex::new(value, 0.0)).collect();
    forward(&mut spectrum);
    let line = |index: usize| OrderLine {
        order: number(index) / turns,
        amplitude_rad: 2.0 * spectrum[index].norm() / number(spectrum.len()),
    };
    (1..spectrum.len().div_ceil(2)).map(line).collect()
}

/// The samples of the largest whole number of turns.
fn whole_turns(samples: &[Sample]) -> &[Sample] {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return samples };
    let span = last.output_turns - first.output_turns;
    let step = span / number(samples.len().max(2) - 1);
    let turns = (span + step + WHOLE).floor();
    if turns < 1.0 {
        return samples;
    }
    let end = first.output_turns + turns - WHOLE;
    &samples[..samples.partition_point(|sample| sample.output_turns < end)]
}

/// δ of the whole turns without slope and mean.
fn flat(whole: &[Sample], slope_rad_per_turn: f64) -> Vec<f64> {
    let rest = |s: &Sample| s.error_rad - slope_rad_per_turn * s.output_turns;
    let mean = whole.iter().map(rest).sum::<f64>() / number(whole.len());
    whole.iter().map(|sample| rest(sample) - mean).collect()
}

/// How much δ grows a turn: the mean of what differs between samples whole turns apart, so that
/// nothing periodic in the turn counts; `None` where none are.
fn slope(samples: &[Sample]) -> Option<f64> {
    let turns = samples[samples.len() - 1].output_turns - samples[0].output_turns;
    let lag = ((turns + WHOLE).floor() - 1.0).max(1.0);
    let later = |sample: &Sample| {
        let at = sample.output_turns + lag - WHOLE;
        let after = samples.partition_point(|other| other.output_turns < at);
        let other = samples.get(after)?;
        Some((other.error_rad - sample.error_rad) / (other.output_turns - sample.output_turns))
    };
    let growths: Vec<f64> = samples.iter().map_while(later).collect();
    (!growths.is_empty()).then(|| growths.iter().sum::<f64>() / number(growths.len()))
}

/// Least squares of a constant, and of a sine and a cosine at every named order, jointly.
fn named(samples: &[Sample], flat_rad: &[f64], shafts: &[Shaft]) -> Vec<ShaftLine> {
    let size = 1 + 2 * shafts.len();
    let mut matrix = Banded::zeros(size, size);
    let mut right = vec![0.0; size];
    let start = samples.first().map_or(0.0, |sample| sample.output_turns);
    for (sample, value) in samples.iter().zip(flat_rad) {
        let waves = shafts.iter().flat_map(|shaft| {
            let (sin, cos) = libm::sincos(TAU * shaft.order * (sample.output_turns - start));
            [sin, cos]
        });
        let row: Vec<(usize, f64)> = std::iter::once(1.0).chain(waves).enumerate().collect();
        matrix.add_outer(&row, 1.0);
        for (place, wave) in &row {
            right[*place] += wave * value;
        }
    }
    // Two shafts of one order cannot be told apart; then none is given a number.
    let Some(factor) = matrix.factor() else { return Vec::new() };
    let found = factor.solve(&right);
    let line = |(shaft, wave): (&Shaft, &[f64])| ShaftLine {
        shaft: shaft.clone(),
        amplitude_rad: libm::hypot(wave[0], wave[1]),
        phase_rad: libm::atan2(wave[1], wave[0]),
    };
    shafts.iter().zip(found[1..].chunks(2)).map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> Vec<Sample> {
        let sample = |index: usize| {
            let output_turns = number(index) / 360.0;
            let error_rad = 3.0 * libm::sin(TAU * output_turns + 0.2)
                + 0.5 * libm::cos(TAU * 36.0 * output_turns)
                + 0.1 * output_turns;
            Sample { time_s: output_turns, output_turns, error_rad }
        };
        (0..1000).map(sample).collect()
    }

    #[test]
    fn lines_have_the_amplitude_of_their_sine() {
        let spectrum = order_spectrum(&samples(), &[]).unwrap();
        let at = |order: f64| {
            let line = spectrum.lines.iter().find(|line| (line.order - order).abs() < 1e-9);
            line.unwrap().amplitude_rad
        };
        assert!((at(1.0) - 3.0).abs() < 1e-6, "{}", at(1.0));
        assert!((spectrum.slope_rad_per_turn.unwrap() - 0.1).abs() < 1e-9);
        assert!((at(36.0) - 0.5).abs() < 1e-6, "{}", at(36.0));
    }

    #[test]
    fn shafts_are_named_with_their_amplitude() {
        let shaft = |name: &str, order| Shaft { name: name.into(), order };
        let shafts = [shaft("table", 1.0), shaft("worm", 36.0), shaft("too high", 500.0)];
        let spectrum = order_spectrum(&samples(), &shafts).unwrap();
        assert_eq!(spectrum.shafts.len(), 2);
        assert!((spectrum.shafts[1].amplitude_rad - 0.5).abs() < 1e-6);
        // cos = sin a quarter turn on.
        assert!((spectrum.shafts[1].phase_rad - TAU / 4.0).abs() < 1e-6);
    }

    /// δ of 12 once a turn and of 4 at the worm, over part of a turn. A line through what was less than a
    /// turn took most of the first away: 4.7 of 12 over 720 pulses, 4.0 over 0.95 turns.
    #[test]
    fn no_slope_is_taken_off_less_than_a_turn() {
        let shaft = |name: &str, order| Shaft { name: name.into(), order };
        let shafts = [shaft("table", 1.0), shaft("worm", 36.0)];
        let sample = |index: usize| {
            let output_turns = number(index) / 720.0;
            let error_rad = 12.0 * libm::sin(TAU * output_turns + 0.7)
                + 4.0 * libm::cos(TAU * 36.0 * output_turns);
            Sample { time_s: output_turns, output_turns, error_rad }
        };
        for pulses in [720, 721, 684, 504] {
            let samples: Vec<Sample> = (0..pulses).map(sample).collect();
            let found = order_spectrum(&samples, &shafts).unwrap();
            let amplitudes: Vec<f64> = found.shafts.iter().map(|one| one.amplitude_rad).collect();
            assert!((amplitudes[0] - 12.0).abs() < 1e-6, "{pulses}: {amplitudes:?}");
            assert!((amplitudes[1] - 4.0).abs() < 1e-6, "{pulses}: {amplitudes:?}");
            assert_eq!(found.lines.is_empty(), pulses < 720, "{pulses}");
            assert!(found.slope_rad_per_turn.is_none_or(|slope| slope.abs() < 1e-9), "{found:?}");
        }
        let short: Vec<Sample> = (0..288).map(sample).collect();
        let found = order_spectrum(&short, &shafts).unwrap();
        assert_eq!(found.shafts.len(), 1, "0.4 turns do not show what turns once");
        assert!((found.shafts[0].amplitude_rad - 4.0).abs() < 1e-6, "{found:?}");
    }
}
