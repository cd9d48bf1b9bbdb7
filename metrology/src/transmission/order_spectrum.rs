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
    /// Slope removed, rad a turn: the ratio is not what it was said to be, or the run drifts.
    pub slope_rad_per_turn: f64,
    /// Lines, from the lowest order to half the samples.
    pub lines: Vec<OrderLine>,
    /// Named contributions; shafts the samples are too few or the run is too short for are left out.
    pub shafts: Vec<ShaftLine>,
}

/// The order spectrum of δ.
///
/// Samples are even in output turns (each method gives them at output pulses). As many whole
/// turns as there are go in; with less than a turn, all of it does. Line `m` has the order
/// `m/turns`, and an amplitude of a sine on its order comes out as it is.
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
    let slope_rad_per_turn = slope(samples);
    let flat_rad = flat(whole, slope_rad_per_turn);
    let mut spectrum: Vec<Complex<f64>> =
        flat_rad.iter().map(|&value| Complex::new(value, 0.0)).collect();
    forward(&mut spectrum);
    let line = |index: usize| OrderLine {
        order: number(index) / turns,
        amplitude_rad: 2.0 * spectrum[index].norm() / number(spectrum.len()),
    };
    let lines: Vec<OrderLine> = (1..spectrum.len().div_ceil(2)).map(line).collect();
    let highest = 0.5 / step_turns;
    let seen = |shaft: &&Shaft| 0.5 / turns < shaft.order && shaft.order < highest;
    let seen: Vec<Shaft> = shafts.iter().filter(seen).cloned().collect();
    Ok(OrderSpectrum { slope_rad_per_turn, lines, shafts: named(whole, &flat_rad, &seen) })
}

/// The samples of the largest whole number of turns.
fn whole_turns(samples: &[Sample]) -> &[Sample] {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return samples };
    let turns = (last.output_turns - first.output_turns + 1e-9).floor();
    if turns < 1.0 {
        return samples;
    }
    let end = first.output_turns + turns - 1e-9;
    &samples[..samples.partition_point(|sample| sample.output_turns < end)]
}

/// δ of the whole turns without slope and mean.
fn flat(whole: &[Sample], slope_rad_per_turn: f64) -> Vec<f64> {
    let rest = |s: &Sample| s.error_rad - slope_rad_per_turn * s.output_turns;
    let mean = whole.iter().map(rest).sum::<f64>() / number(whole.len());
    whole.iter().map(|sample| rest(sample) - mean).collect()
}

/// How much δ grows a turn: the mean of what differs between samples whole turns apart, so that
/// nothing periodic in the turn counts; the least-squares slope when there is less than a turn.
fn slope(samples: &[Sample]) -> f64 {
    let turns = samples[samples.len() - 1].output_turns - samples[0].output_turns;
    let lag = ((turns + 1e-9).floor() - 1.0).max(1.0);
    let later = |sample: &Sample| {
        let at = sample.output_turns + lag - 1e-9;
        let after = samples.partition_point(|other| other.output_turns < at);
        let other = samples.get(after)?;
        Some((other.error_rad - sample.error_rad) / (other.output_turns - sample.output_turns))
    };
    let growths: Vec<f64> = samples.iter().map_while(later).collect();
    if growths.is_empty() {
        return least_squares_slope(samples);
    }
    growths.iter().sum::<f64>() / number(growths.len())
}

fn least_squares_slope(samples: &[Sample]) -> f64 {
    let count = number(samples.len());
    let mean_turns = samples.iter().map(|s| s.output_turns).sum::<f64>() / count;
    let (mut squares, mut products) = (0.0, 0.0);
    for sample in samples {
        let turns = sample.output_turns - mean_turns;
        squares += turns * turns;
        products += turns * sample.error_rad;
    }
    products / squares
}

/// Least squares of a sine and a cosine at every named order, jointly.
fn named(samples: &[Sample], flat_rad: &[f64], shafts: &[Shaft]) -> Vec<ShaftLine> {
    let size = 2 * shafts.len();
    let mut matrix = Banded::zeros(size, size);
    let mut right = vec![0.0; size];
    let start = samples.first().map_or(0.0, |sample| sample.output_turns);
    for (sample, value) in samples.iter().zip(flat_rad) {
        let waves = shafts.iter().flat_map(|shaft| {
            let (sin, cos) = libm::sincos(TAU * shaft.order * (sample.output_turns - start));
            [sin, cos]
        });
        let row: Vec<(usize, f64)> = waves.enumerate().collect();
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
    shafts.iter().zip(found.chunks(2)).map(line).collect()
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
        assert!((spectrum.slope_rad_per_turn - 0.1).abs() < 1e-9);
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
}
