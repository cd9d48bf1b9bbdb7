//! What a choice of probe spacings costs, before anything is measured.

use super::spacing::{Harmonic, Spacing};
use crate::number::number;

/// Consequences of one choice of spacings.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The spacings.
    pub spacing: Spacing,
    /// Samples of the stroke.
    pub samples: usize,
    /// Weight of every harmonic below half the samples.
    pub harmonics: Vec<Harmonic>,
    /// Harmonics that cannot be recovered.
    pub lost: Vec<usize>,
    /// Root mean square of `1/A_k`: noise of `h` for noise of `z`, per harmonic. Infinite when a
    /// harmonic is lost.
    pub noise_gain: f64,
    /// Standard deviation of `z` for a unit standard deviation of every probe.
    pub combination_noise: f64,
    /// Noise of `h` for noise of one probe, per harmonic: the product of the two.
    pub probe_noise_gain: f64,
    /// Height of the false parabola at half the stroke, for a unit error of the probes' zeros:
    /// `(D/2)²/(L1·(L1 + L2))`.
    pub zero_offset_gain: f64,
    /// The document's rules that the spacings break although no harmonic vanishes.
    pub warnings: Vec<String>,
}

/// Works out a choice of spacings for a stroke of `samples` steps.
///
/// # Examples
///
/// Planning numbers for 32 samples: noise × 0.60 for spacings 5 and 6; a zero offset grows
/// 32-fold for 10 mm and 10 mm on a stroke of 160 mm.
///
/// ```
/// use helixlock_metrology::straightness::{Spacing, plan};
///
/// assert_eq!(format!("{:.2}", plan(Spacing { first: 5, second: 6 }, 32).noise_gain), "0.60");
/// assert_eq!(plan(Spacing { first: 2, second: 2 }, 32).zero_offset_gain, 32.0);
/// ```
#[must_use]
pub fn plan(spacing: Spacing, samples: usize) -> Plan {
    let harmonics = spacing.harmonics(samples);
    let lost = spacing.lost(samples);
    let squares: f64 = harmonics.iter().map(|h| 1.0 / (h.gain * h.gain)).sum();
    let noise_gain =
        if lost.is_empty() { (squares / number(harmonics.len())).sqrt() } else { f64::INFINITY };
    let half = number(samples) / 2.0;
    Plan {
        noise_gain,
        combination_noise: spacing.combination_noise(),
        probe_noise_gain: noise_gain * spacing.combination_noise(),
        zero_offset_gain: half * half / number(spacing.first * spacing.total()),
        warnings: warnings(spacing, samples),
        spacing,
        samples,
        harmonics,
        lost,
    }
}

/// The `count` choices with the least noise of `h` for noise of the probes, among those whose
/// probes span at most `longest` samples and lose nothing.
///
/// Of equally quiet ones, the shorter comes first. Spans beyond 200 samples are not tried, beyond 60
/// for strokes of more than a thousand samples.
#[must_use]
pub fn propose(samples: usize, longest: usize, count: usize) -> Vec<Plan> {
    let longest = longest.min(if samples <= 1000 { 200 } else { 60 });
    let pairs = (1..longest).flat_map(|first| (1..=longest - first).map(move |s| (first, s)));
    let plans = pairs.map(|(first, second)| plan(Spacing { first, second }, samples));
    let mut plans: Vec<Plan> = plans.filter(|plan| plan.noise_gain.is_finite()).collect();
    plans.sort_by(|a, b| {
        let shorter = a.spacing.total().cmp(&b.spacing.total());
        a.probe_noise_gain.total_cmp(&b.probe_noise_gain).then(shorter)
    });
    plans.truncate(count);
    plans
}

/// Rules i and ii of document 2, section 2.3.
fn warnings(spacing: Spacing, samples: usize) -> Vec<String> {
    let mut warnings = Vec::new();
    for (name, shift) in
        [("the first spacing", spacing.first), ("the probes' span", spacing.total())]
    {
        if 2 * shift == samples {
            warnings.push(format!("{name} is half the stroke ({shift} of {samples} samples)"));
        }
    }
    let common = gcd(gcd(spacing.first, spacing.second), samples);
    // Half the samples is above the harmonics that are worked out.
    if 2 < common {
        warnings.push(format!(
            "the spacings and the {samples} samples share the divisor {common}: every {}th harmonic is lost",
            samples / common
        ));
    }
    warnings
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The planning numbers for N = 32: × 0.60, × 0.84, × 2.5, lost, lost.
    #[test]
    fn planning_numbers() {
        let gain = |first, second| plan(Spacing { first, second }, 32).noise_gain;
        assert_eq!(
            format!("{:.2} {:.2} {:.1}", gain(5, 6), gain(3, 4), gain(2, 2)),
            "0.60 0.84 2.5"
        );
        assert!(gain(4, 4).is_infinite() && gain(8, 8).is_infinite());
    }

    #[test]
    fn proposals_lose_nothing_and_are_ordered() {
        let proposals = propose(32, 11, 5);
        assert_eq!(proposals.len(), 5);
        assert!(proposals.iter().all(|plan| plan.lost.is_empty()));
        assert!(proposals.is_sorted_by(|a, b| a.probe_noise_gain <= b.probe_noise_gain));
        let usual = plan(Spacing { first: 5, second: 6 }, 32);
        assert!(proposals[0].probe_noise_gain <= usual.probe_noise_gain);
    }
}
