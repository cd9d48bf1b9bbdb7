//! The four characteristics of ISO 3408-3: e, Vu, V300 and V2π.

use super::{
    Characteristic, Curve, Gap, MeanLine, Missing, Reached, Weighting, fit_mean_line,
    widest_in_windows,
};
use crate::Error;

/// Travel deviation of a screw by ISO 3408-3.
#[derive(Clone, Debug, PartialEq)]
pub struct TravelVariation {
    /// Travel that was evaluated, mm.
    pub useful_travel_mm: f64,
    /// Samples in it.
    pub samples: usize,
    /// Samples a turn, from the median step.
    pub samples_per_turn: f64,
    /// Sampling intervals a 300 mm window holds (2400 in document 5); one more sample than that.
    pub intervals_in_300_mm: Option<usize>,
    /// The mean line.
    pub mean_line: MeanLine,
    /// `e`, `Vu`, `V300`, `V2π`, in this order.
    pub characteristics: [Characteristic; 4],
    /// Stretches without samples: a variation found across one is a lower bound.
    pub gaps: Vec<Gap>,
    /// Deviation from the mean line at each sample, µm.
    pub from_mean_line_um: Vec<f64>,
}

/// Fewer samples a turn than this cannot show a variation within a turn at all.
const FEWEST_PER_TURN: f64 = 2.0;

/// With fewer samples than this nothing can be said of what lies between them; the mean line alone
/// fits two.
const FEWEST_SAMPLES: usize = 8;

/// With fewer samples a turn than this, up to 8 % of a sine's band lies between the samples.
pub const FAITHFUL_PER_TURN: f64 = 8.0;

/// Evaluates a curve that holds the useful travel only.
///
/// - `lead_mm`: one turn.
/// - `compensation_um`: the travel compensation `c` asked for over the useful travel; zero when
///   the specified travel is the nominal one. `e` is the mean travel less the specified travel.
///
/// V300 and V2π are bands parallel to the mean line of the whole useful travel. The axes are not
/// rotated as document 5 does: for µm over mm the cosine differs from one by less than 1e-9.
///
/// Source: ISO 3408-3; document 5, section 2.3.
///
/// # Errors
///
/// When the lead is not a positive length.
pub fn evaluate_travel(
    curve: &Curve,
    lead_mm: f64,
    compensation_um: f64,
    weighting: Weighting,
) -> Result<TravelVariation, Error> {
    if lead_mm.is_nan() || lead_mm <= 0.0 {
        return Err(Error::LeadNotPositive { found_mm: lead_mm });
    }
    let mean_line = fit_mean_line(curve, weighting);
    let off_line = |(x, y): (&f64, &f64)| y - mean_line.at(*x);
    let from_mean_line_um: Vec<f64> =
        curve.travel_mm().iter().zip(curve.deviation_um()).map(off_line).collect();
    let samples_per_turn = lead_mm / curve.median_step_mm();
    let e = enough_samples(curve).map(|()| mean_deviation(curve, &mean_line, compensation_um));
    let vu = over_any(curve, &from_mean_line_um, curve.length_mm()).map(|found| found.0);
    let (v300, intervals_in_300_mm) = match over_any(curve, &from_mean_line_um, 300.0) {
        Ok((reached, intervals)) => (Ok(reached), Some(intervals)),
        Err(why) => (Err(why), None),
    };
    let v2pi = enough_per_turn(samples_per_turn)
        .and_then(|()| over_any(curve, &from_mean_line_um, lead_mm))
        .map(|found| found.0);
    Ok(TravelVariation {
        useful_travel_mm: curve.length_mm(),
        samples: curve.travel_mm().len(),
        samples_per_turn,
        intervals_in_300_mm,
        mean_line,
        characteristics: named(e, vu, v300, v2pi),
        gaps: curve.gaps(),
        from_mean_line_um,
    })
}

/// The mean line's rise over the useful travel, less the compensation asked for.
fn mean_deviation(curve: &Curve, line: &MeanLine, compensation_um: f64) -> Reached {
    let value_um = line.slope_um_per_mm * curve.length_mm() - compensation_um;
    let (highest_mm, lowest_mm) = (curve.last_mm(), curve.first_mm());
    Reached { value_um, highest_mm, lowest_mm }
}

/// The widest band over any window, and the most intervals a window held.
pub(super) fn over_any(
    curve: &Curve,
    values: &[f64],
    window_mm: f64,
) -> Result<(Reached, usize), Missing> {
    let (travel_mm, length_mm) = (curve.travel_mm(), curve.length_mm());
    if length_mm + super::WINDOW_SLACK_MM < window_mm {
        return Err(Missing::ShortTravel { travel_mm: length_mm, window_mm });
    }
    enough_samples(curve)?;
    match widest_in_windows(travel_mm, values, window_mm) {
        Some(found) if 1 < found.most_samples => {
            let (highest_mm, lowest_mm) = (travel_mm[found.highest], travel_mm[found.lowest]);
            let reached = Reached { value_um: found.spread, highest_mm, lowest_mm };
            Ok((reached, found.most_samples - 1))
        }
        _ => Err(Missing::NoPair { window_mm }),
    }
}

/// Refuses a curve that is hardly sampled at all.
fn enough_samples(curve: &Curve) -> Result<(), Missing> {
    let (found, expected) = (curve.travel_mm().len(), FEWEST_SAMPLES);
    if found < expected { Err(Missing::TooFewSamples { found, expected }) } else { Ok(()) }
}

/// Refuses a sampling that cannot see what happens within a turn.
pub(super) fn enough_per_turn(samples_per_turn: f64) -> Result<(), Missing> {
    // A step computed from decimal positions may be off in its last digit.
    if samples_per_turn + 1e-6 < FEWEST_PER_TURN {
        return Err(Missing::TooFewPerTurn { found: samples_per_turn, expected: FEWEST_PER_TURN });
    }
    Ok(())
}

fn named(
    e: Result<Reached, Missing>,
    vu: Result<Reached, Missing>,
    v300: Result<Reached, Missing>,
    v2pi: Result<Reached, Missing>,
) -> [Characteristic; 4] {
    let make = |symbol, limit, meaning, reached| Characteristic { symbol, limit, meaning, reached };
    [
        make("e", "ep", "mean travel deviation over the useful travel", e),
        make("Vu", "vup", "travel variation over the useful travel", vu),
        make("V300", "v300p", "travel variation over any 300 mm", v300),
        make("V2π", "v2pip", "travel variation over any turn", v2pi),
    ]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A slope and two sines whose bands follow by hand.
    fn worked_example() -> TravelVariation {
        let x: Vec<f64> = (0..=8000).map(|k| f64::from(k) / 8.0).collect();
        let y: Vec<f64> = x
            .iter()
            .map(|x| 0.01 * x + 1.5 * libm::sin(TAU * x / 2.0) + 4.0 * libm::cos(TAU * x / 100.0))
            .collect();
        evaluate_travel(&Curve::new(&x, &y).unwrap(), 2.0, 0.0, Weighting::Samples).unwrap()
    }

    #[test]
    fn slope_and_bands_of_known_sines() {
        let found = worked_example();
        let value = |k: usize| found.characteristics[k].reached.unwrap().value_um;
        assert_eq!(found.intervals_in_300_mm, Some(2400));
        assert!((value(0) - 10.0).abs() < 0.05, "10 µm/m over 1 m, found {}", value(0));
        // Sine peaks lie a quarter lead beside a cosine peak: 2·(1.5 + 4) less than 0.01 µm.
        assert!((value(1) - 11.0).abs() < 0.05, "{}", value(1));
        assert!((value(2) - 11.0).abs() < 0.05, "{}", value(2));
        // Over one turn: 2·1.5 plus what the long wave moves in half a turn at its steepest.
        let steepest_um = 3.0 + 4.0 * TAU / 100.0;
        assert!((value(3) - steepest_um).abs() < 0.02, "{} {steepest_um}", value(3));
    }

    #[test]
    fn short_screws_have_no_v300_and_sparse_ones_no_v2pi() {
        let x: Vec<f64> = (0..=100).map(f64::from).collect();
        let curve = Curve::new(&x, &x).unwrap();
        let found = evaluate_travel(&curve, 1.5, 0.0, Weighting::Samples).unwrap();
        assert!(found.characteristics[2].reached.is_err());
        assert!(found.characteristics[3].reached.is_err());
        assert!((found.characteristics[0].reached.unwrap().value_um - 100.0).abs() < 1e-9);
    }

    #[test]
    fn compensation_is_taken_off_e() {
        let x: Vec<f64> = (0..=1000).map(f64::from).collect();
        let y: Vec<f64> = x.iter().map(|x| -0.02 * x).collect();
        let curve = Curve::new(&x, &y).unwrap();
        let found = evaluate_travel(&curve, 10.0, -20.0, Weighting::Samples).unwrap();
        assert!(found.characteristics[0].reached.unwrap().value_um.abs() < 1e-9);
    }
}
