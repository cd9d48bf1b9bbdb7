//! A polynomial that stands in for a smooth sum of effects over a stretch of time.
//!
//! Interpolation of degree 11 in the Chebyshev points of an interval of length `h` is off by at
//! most `2·A·(r·h/4)¹²/12!` when the twelfth derivative stays below `A·r¹²`
//! ([`Smoothness`](crate::Smoothness)); the interval is chosen so that this is the tolerance.

use std::f64::consts::PI;

use crate::Smoothness;

/// Number of interpolation points.
const POINTS: usize = 12;
/// 12!
const FACTORIAL: f64 = 479_001_600.0;

/// Value of a sum of effects between two moments, as a polynomial.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    centre_s: f64,
    per_s: f64,
    /// Last moment at which it holds, s.
    pub(crate) end_s: f64,
    /// Coefficients of the powers of `(time − centre)·per_s`, which lies between −1 and 1: of an even
    /// power and the odd one above it. Next to each other they are summed up side by side, which is
    /// what the next pulse waits for.
    powers: [[f64; 2]; POINTS / 2],
    /// The same of its derivative.
    slopes: [[f64; 2]; POINTS / 2],
}

impl Piece {
    /// The longest interval over which the error stays below `tolerance_um`, s.
    pub(crate) fn longest_s(smoothness: Smoothness, tolerance_um: f64) -> f64 {
        match smoothness {
            Smoothness::Polynomial => f64::INFINITY,
            Smoothness::Rough => 0.0,
            Smoothness::Band { amplitude_um, rate_per_s } => {
                let ratio = tolerance_um * FACTORIAL / (2.0 * amplitude_um.max(f64::MIN_POSITIVE));
                4.0 / rate_per_s.max(f64::MIN_POSITIVE) * libm::pow(ratio, 1.0 / 12.0)
            }
        }
    }

    /// Interpolates `value` from `start_s` to `end_s`.
    pub(crate) fn new(start_s: f64, end_s: f64, value: impl Fn(f64) -> f64) -> Self {
        let half_s = (end_s - start_s) / 2.0;
        let centre_s = start_s + half_s;
        #[expect(clippy::cast_precision_loss, reason = "at most 12")]
        let angle = |point: usize| PI * (point as f64 + 0.5) / POINTS as f64;
        let values: [f64; POINTS] =
            std::array::from_fn(|point| value(centre_s + half_s * libm::cos(angle(point))));
        #[expect(clippy::cast_precision_loss, reason = "at most 12")]
        let chebyshev: [f64; POINTS] = std::array::from_fn(|degree| {
            let wave = |point| libm::cos(degree as f64 * angle(point));
            let sum: f64 = (0..POINTS).map(|point| values[point] * wave(point)).sum();
            sum * if degree == 0 { 1.0 } else { 2.0 } / POINTS as f64
        });
        let powers = to_powers(&chebyshev);
        #[expect(clippy::cast_precision_loss, reason = "at most 12")]
        let slope = |power: usize| powers.get(power + 1).map_or(0.0, |c| (power + 1) as f64 * c);
        Self {
            centre_s,
            per_s: 1.0 / half_s,
            end_s,
            powers: std::array::from_fn(|pair| [powers[2 * pair], powers[2 * pair + 1]]),
            slopes: std::array::from_fn(|pair| [slope(2 * pair), slope(2 * pair + 1)]),
        }
    }

    /// First moment at which it holds, s.
    pub(crate) fn start_s(&self) -> f64 {
        self.centre_s - (self.end_s - self.centre_s)
    }

    /// Value and its change per second.
    pub(crate) fn at(&self, time_s: f64) -> (f64, f64) {
        let place = (time_s - self.centre_s) * self.per_s;
        let square = place * place;
        let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
        for (powers, slopes) in self.powers.iter().zip(&self.slopes).rev() {
            for parity in 0..2 {
                value[parity] = value[parity] * square + powers[parity];
                slope[parity] = slope[parity] * square + slopes[parity];
            }
        }
        let whole = |[even, odd]: [f64; 2]| even + place * odd;
        (whole(value), whole(slope) * self.per_s)
    }
}

/// From coefficients of Chebyshev polynomials to those of powers, by their recurrence.
fn to_powers(chebyshev: &[f64; POINTS]) -> [f64; POINTS] {
    let mut powers = [0.0; POINTS];
    let (mut before, mut now) = ([0.0; POINTS], [0.0; POINTS]);
    now[0] = 1.0;
    for (degree, coefficient) in chebyshev.iter().enumerate() {
        powers.iter_mut().zip(&now).for_each(|(sum, term)| *sum += coefficient * term);
        let factor = if degree == 0 { 1.0 } else { 2.0 };
        let mut next = before.map(|term| -term);
        for power in 1..POINTS {
            next[power] += factor * now[power - 1];
        }
        (before, now) = (now, next);
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_stays_below_its_bound() {
        let smoothness = Smoothness::Band { amplitude_um: 1.5, rate_per_s: 7.0 };
        let tolerance_um = 1e-8;
        let long_s = Piece::longest_s(smoothness, tolerance_um);
        let wave = |time_s: f64| 1.5 * libm::sin(7.0 * time_s + 0.3);
        let piece = Piece::new(2.0, 2.0 + long_s, wave);
        let worst = (0..=1000)
            .map(|place| 2.0 + long_s * f64::from(place) / 1000.0)
            .map(|time_s| (piece.at(time_s).0 - wave(time_s)).abs())
            .fold(0.0, f64::max);
        assert!(worst < tolerance_um, "{worst}");
        // The bound is not idle: twice the interval is far beyond it.
        let wide = Piece::new(2.0, 2.0 + 2.0 * long_s, wave);
        assert!(tolerance_um < (wide.at(2.0).0 - wave(2.0)).abs());
    }

    #[test]
    fn polynomials_are_kept_with_their_slopes() {
        let piece = Piece::new(0.0, 100.0, |t| 3.0 - 2.0 * t + 0.5 * t * t * t);
        let (value, slope) = piece.at(70.0);
        assert!((value - (3.0 - 140.0 + 171_500.0)).abs() < 1e-8);
        assert!((slope - (-2.0 + 1.5 * 4900.0)).abs() < 1e-8);
    }
}
