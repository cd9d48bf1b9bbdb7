//! How bounds on effects add up.

use crate::Smoothness;

/// Bound on a weighted sum; rough as soon as one part is.
///
/// The rate of the sum is the fastest one, and every amplitude counts at that rate, which keeps
/// the bound on the twelfth derivative true.
pub(crate) fn combined(parts: impl Iterator<Item = (f64, Smoothness)>) -> Smoothness {
    let mut sum = Smoothness::Polynomial;
    for (weight, part) in parts {
        sum = match (sum, part) {
            (Smoothness::Rough, _) | (_, Smoothness::Rough) => return Smoothness::Rough,
            (sum, Smoothness::Polynomial) => sum,
            (Smoothness::Polynomial, Smoothness::Band { amplitude_um, rate_per_s }) => {
                Smoothness::Band { amplitude_um: weight.abs() * amplitude_um, rate_per_s }
            }
            (
                Smoothness::Band { amplitude_um: total_um, rate_per_s: fastest_per_s },
                Smoothness::Band { amplitude_um, rate_per_s },
            ) => Smoothness::Band {
                amplitude_um: total_um + weight.abs() * amplitude_um,
                rate_per_s: fastest_per_s.max(rate_per_s),
            },
        };
    }
    sum
}
