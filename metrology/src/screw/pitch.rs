//! Pitch error and cumulative pitch error (JB/T 2886, grades 7 to 9).
//!
//! Pitches are whole turns apart, so only deviations a whole number of leads apart are compared.
//! Document 5 measures one point a turn; a dense curve has many starting phases within the turn,
//! all are tried, and the worst counts.

use super::{Characteristic, Curve, Missing, Reached, widest_in_windows};
use crate::number::number;

/// `ΔP`, `ΔPL60`, `ΔPL300` and `ΔPLu`, in this order.
///
/// A curve with more than one sample a turn is interpolated to whole turns from each of the
/// starting phases; one with a sample a turn is taken as it is.
#[must_use]
pub fn pitch_characteristics(curve: &Curve, lead_mm: f64) -> [Characteristic; 4] {
    let phases = phases(curve, lead_mm);
    let cumulative = |window_mm: f64| {
        let length_mm = curve.length_mm();
        if length_mm + super::WINDOW_SLACK_MM < window_mm {
            return Err(Missing::ShortTravel { travel_mm: length_mm, window_mm });
        }
        worst(&phases, lead_mm, |turns| within(turns, window_mm))
    };
    let make = |symbol, limit, meaning, reached| Characteristic { symbol, limit, meaning, reached };
    let one = worst(&phases, lead_mm, single_pitch);
    [
        make("ΔP", "pitch", "error of one pitch", one),
        make("ΔPL60", "pitch-60", "cumulative pitch error within any 60 mm", cumulative(60.0)),
        make("ΔPL300", "pitch-300", "cumulative pitch error within any 300 mm", cumulative(300.0)),
        make(
            "ΔPLu",
            "pitch-full",
            "cumulative pitch error over the useful length",
            cumulative(curve.length_mm()),
        ),
    ]
}

/// Travel and deviation at whole turns from one starting phase.
struct Turns {
    travel_mm: Vec<f64>,
    deviation_um: Vec<f64>,
}

/// One series of whole turns for each sample of the first turn.
fn phases(curve: &Curve, lead_mm: f64) -> Result<Vec<Turns>, Missing> {
    let samples_per_turn = lead_mm / curve.median_step_mm();
    if samples_per_turn < 1.0 - 1e-6 {
        return Err(Missing::TooFewPerTurn { found: samples_per_turn, expected: 1.0 });
    }
    if samples_per_turn < 1.0 + 1e-6 {
        let (travel_mm, deviation_um) = (curve.travel_mm(), curve.deviation_um());
        return Ok(vec![Turns {
            travel_mm: travel_mm.to_vec(),
            deviation_um: deviation_um.to_vec(),
        }]);
    }
    let end_mm = curve.first_mm() + lead_mm - super::WINDOW_SLACK_MM;
    let starts = curve.travel_mm().iter().take_while(|&&x| x < end_mm);
    Ok(starts.map(|&start_mm| whole_turns(curve, start_mm, lead_mm)).collect())
}

fn whole_turns(curve: &Curve, start_mm: f64, lead_mm: f64) -> Turns {
    let places = (0..).map(|turn| start_mm + number(turn) * lead_mm);
    let known = places.map_while(|x| {
        // The last turn may end beside the last sample by a rounding error.
        let near = x.min(curve.last_mm());
        (x - near < super::WINDOW_SLACK_MM).then(|| curve.at(near).map(|y| (x, y))).flatten()
    });
    let (travel_mm, deviation_um) = known.unzip();
    Turns { travel_mm, deviation_um }
}

/// The worst over all phases, by absolute value.
fn worst(
    phases: &Result<Vec<Turns>, Missing>,
    lead_mm: f64,
    find: impl Fn(&Turns) -> Option<Reached>,
) -> Result<Reached, Missing> {
    let found = phases.as_ref().map_err(|why| *why)?.iter().filter_map(find);
    let by_size = |a: &Reached, b: &Reached| a.value_um.abs().total_cmp(&b.value_um.abs());
    found.max_by(by_size).ok_or(Missing::NoPair { window_mm: lead_mm })
}

/// The worst step from one turn to the next, with its sign: positive when the pitch is too long.
fn single_pitch(turns: &Turns) -> Option<Reached> {
    let steps = turns.deviation_um.windows(2).map(|pair| pair[1] - pair[0]);
    let (index, value_um) = steps.enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let (before_mm, after_mm) = (turns.travel_mm[index], turns.travel_mm[index + 1]);
    let (highest_mm, lowest_mm) =
        if 0.0 < value_um { (after_mm, before_mm) } else { (before_mm, after_mm) };
    Some(Reached { value_um, highest_mm, lowest_mm })
}

fn within(turns: &Turns, window_mm: f64) -> Option<Reached> {
    let found = widest_in_windows(&turns.travel_mm, &turns.deviation_um, window_mm)?;
    Some(Reached {
        value_um: found.spread,
        highest_mm: turns.travel_mm[found.highest],
        lowest_mm: turns.travel_mm[found.lowest],
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// An error that repeats every turn is no pitch error, whatever its size.
    #[test]
    fn what_repeats_every_turn_is_no_pitch_error() {
        let x: Vec<f64> = (0..=9600).map(|k| f64::from(k) / 16.0).collect();
        let y: Vec<f64> = x.iter().map(|x| 20.0 * libm::sin(TAU * x / 6.0)).collect();
        let found = pitch_characteristics(&Curve::new(&x, &y).unwrap(), 6.0);
        for one in found {
            assert!(one.reached.unwrap().value_um.abs() < 1e-9, "{one:?}");
        }
    }

    /// A sine over ten pitches of 6 mm: one pitch moves 2·sin(π/10) of its amplitude at most.
    #[test]
    fn a_long_wave_by_hand() {
        let x: Vec<f64> = (0..=9600).map(|k| f64::from(k) / 16.0).collect();
        let y: Vec<f64> = x.iter().map(|x| 5.0 * libm::sin(TAU * x / 60.0)).collect();
        let found = pitch_characteristics(&Curve::new(&x, &y).unwrap(), 6.0);
        let values = found.map(|one| one.reached.unwrap().value_um);
        let pitch_um = 10.0 * libm::sin(TAU / 20.0);
        assert!((values[0].abs() - pitch_um).abs() < 1e-3, "{values:?} {pitch_um}");
        assert!((values[1] - 10.0).abs() < 1e-3, "{values:?}");
    }

    #[test]
    fn one_sample_a_turn_is_taken_as_it_is() {
        let x: Vec<f64> = (0..100).map(|k| f64::from(k) * 6.0).collect();
        let mut y = vec![0.0; 100];
        y[50] = -7.0;
        let found = pitch_characteristics(&Curve::new(&x, &y).unwrap(), 6.0);
        let pitch = found[0].reached.unwrap();
        assert!((pitch.value_um.abs() - 7.0).abs() < 1e-12);
    }
}
