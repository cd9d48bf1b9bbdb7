//! Which frequencies a set of places resolves.

use super::fourier;
use super::summary::{count, median, spread};
use crate::policy::extent::{
    ALIKE_WINDOW, HIGHEST_AGAINST_RATE, ROWS_A_TURN, SAME_PLACE, SAME_WINDOW, WINDOW_FROM,
};

/// Most frequencies at which the window is worked out.
const MOST_POINTS: f64 = 65_536.0;

/// Usual number of samples a unit of a coordinate: one over the median distance of neighbours, in the order of their
/// places where they were visited in none.
#[must_use]
pub(crate) fn usual_rate(coordinate: &[f64]) -> f64 {
    let mut moves = if are_in_no_order(coordinate) {
        let mut places = coordinate.to_vec();
        places.sort_unstable_by(f64::total_cmp);
        moves(&places, SAME_PLACE * spread(&places) / count(places.len()))
    } else {
        moves(coordinate, 0.0)
    };
    1.0 / median(&mut moves).max(f64::MIN_POSITIVE)
}

/// Distances of neighbours beyond the least.
fn moves(places: &[f64], least: f64) -> Vec<f64> {
    let moves = places.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    moves.filter(|step| least < *step).collect()
}

/// True where the way to the next sample is another one every few samples.
fn are_in_no_order(coordinate: &[f64]) -> bool {
    coordinate.len() < ROWS_A_TURN * turns_of_the_way(coordinate)
}

/// How often the way through places turns round.
#[must_use]
pub(crate) fn turns_of_the_way(places: &[f64]) -> usize {
    let turns = |three: &&[f64]| (three[1] - three[0]) * (three[2] - three[1]) < 0.0;
    places.windows(3).filter(turns).count()
}

/// Highest frequency that the places resolve, cycles a unit of the coordinate.
///
/// Half the rate for even sampling. Uneven places tell a frequency from its aliases: two
/// frequencies look alike when the spectral window `|Σ exp(2πi·f·u)|/n` comes back near 1 at
/// their sum (Eyer and Bartholdi 1999, *Variable stars: which Nyquist frequency?*, A&AS 135:1),
/// so the limit is half of the first such frequency, at most four times the rate.
#[must_use]
pub(crate) fn highest_frequency(coordinate: &[f64]) -> f64 {
    let rate = usual_rate(coordinate);
    let end = 2.0 * HIGHEST_AGAINST_RATE * rate;
    let (returns, looked_at) = first_return(coordinate, (rate, end), ALIKE_WINDOW);
    returns.unwrap_or(looked_at).max(rate) * 0.5
}

/// True when the places tell a wave of so many cycles a unit from every slower one, however far it
/// lies above those that are searched, and whatever its size.
#[must_use]
pub(crate) fn resolves(coordinate: &[f64], frequency: f64) -> bool {
    is_told_below(coordinate, frequency, ALIKE_WINDOW)
}

/// The same for a wave that is large enough.
#[must_use]
pub(crate) fn may_resolve(coordinate: &[f64], frequency: f64) -> bool {
    is_told_below(coordinate, frequency, SAME_WINDOW)
}

/// Waves along all places that samples draw of one of any frequency, in the order in which they were taken.
#[must_use]
pub(crate) fn waves_drawn(coordinate: &[f64], frequency: f64) -> f64 {
    let is_above = |place: &f64| 0.0 < libm::cos(std::f64::consts::TAU * frequency * place);
    let crosses = |pair: &&[f64]| is_above(&pair[0]) != is_above(&pair[1]);
    let crossings = coordinate.windows(2).filter(crosses).count();
    let way: f64 = coordinate.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
    0.5 * count(crossings) * spread(coordinate) / way.max(f64::MIN_POSITIVE)
}

/// True when the spectral window does not come back to `alike` where a slower wave would be an alias.
fn is_told_below(coordinate: &[f64], frequency: f64, alike: f64) -> bool {
    let rate = usual_rate(coordinate);
    if frequency < 0.5 * rate {
        return true;
    }
    let (returns, looked_at) = first_return(coordinate, (rate, 2.0 * frequency), alike);
    // As far as was asked for, but for rounding.
    returns.is_none() && 1.999 * frequency <= looked_at
}

/// The rate by whose multiples frequencies of a large wave are told from their aliases, where smaller ones are not:
/// the spectral window of nearly even places is highest there. What lies between stretches tells nothing.
#[must_use]
pub(crate) fn nearly_even_rate(stretches: &[&[f64]]) -> Option<f64> {
    let rate = usual_rate(&stretches.concat());
    let near = |frequency: f64| (WINDOW_FROM..2.0 - WINDOW_FROM).contains(&(frequency / rate));
    let (window, _) = window(stretches, 2.0 * rate)?;
    let returns = window.into_iter().filter(|(frequency, _)| near(*frequency));
    let (frequency, size) = returns.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (ALIKE_WINDOW..SAME_WINDOW).contains(&size).then_some(frequency)
}

/// First frequency up to `end` at which the spectral window of places that come at a usual rate
/// comes back to `alike`, and how far was looked: at nothing where there are hardly any places.
fn first_return(coordinate: &[f64], (rate, end): (f64, f64), alike: f64) -> (Option<f64>, f64) {
    let Some((window, looked_at)) = window(&[coordinate], end) else { return (None, 0.0) };
    let from = WINDOW_FROM * rate;
    let returns = window.into_iter().find(|(frequency, size)| from < *frequency && alike < *size);
    (returns.map(|(frequency, _)| frequency), looked_at)
}

/// Spectral window of places, stretch by stretch, by frequencies up to `end`, and how far that is; `None` where there
/// are hardly any places.
fn window(stretches: &[&[f64]], end: f64) -> Option<(Vec<(f64, f64)>, f64)> {
    let places = stretches.concat();
    let range = spread(&places);
    if range <= 0.0 || places.len() < 3 {
        return None;
    }
    let step = 0.25 / range;
    let points = (end / step).clamp(4.0, MOST_POINTS);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to small positive numbers"
    )]
    let number = points as usize;
    let mut sizes = vec![0.0; number];
    for stretch in stretches {
        let own = fourier::sizes(stretch, &vec![1.0; stretch.len()], step, number);
        sizes.iter_mut().zip(own).for_each(|(all, own)| *all += own);
    }
    let of = |(index, size): (usize, f64)| (step * count(index), size / count(places.len()));
    Some((sizes.into_iter().enumerate().map(of).collect(), step * points))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_samples_draw_a_slow_wave_of_a_quick_one() {
        let there: Vec<f64> = (0..=100_u32).map(f64::from).collect();
        let back: Vec<f64> = there.iter().rev().copied().collect();
        let both = [there, back].concat();
        for (frequency, waves) in [(1.02, 2.0), (0.25, 25.0), (0.02, 2.0)] {
            assert!((waves_drawn(&both, frequency) - waves).abs() < 0.6, "{frequency}");
        }
    }

    #[test]
    fn even_sampling_resolves_half_its_rate() {
        let places: Vec<f64> = (0..500).map(|i| 0.1 * f64::from(i)).collect();
        let highest = highest_frequency(&places);
        assert!((highest - 5.0).abs() < 0.05, "{highest}");
    }

    /// Fifty places, visited in another order by steps of nineteen, the first of them by an encoder that trembles.
    #[test]
    fn places_in_no_order_resolve_what_they_do_in_theirs() {
        let mut places: Vec<f64> = (0..50).map(|i| f64::from(19 * i % 50)).collect();
        places.extend([0.002, 0.004, 0.001]);
        assert!((usual_rate(&places) - 1.0).abs() < 1e-9, "{}", usual_rate(&places));
    }

    #[test]
    fn uneven_sampling_resolves_more() {
        // Quadratic residues are spread evenly without being evenly spaced.
        let mut places: Vec<f64> = (0..500).map(|i| f64::from(i * i % 9973) / 200.0).collect();
        places.sort_by(f64::total_cmp);
        let highest = highest_frequency(&places);
        assert!(30.0 < highest, "{highest}");
    }

    #[test]
    fn uneven_places_resolve_more_than_is_searched() {
        // Quadratic residues once more, as places off an even row.
        let places: Vec<f64> =
            (0..97_u32).map(|i| f64::from(i) + 0.8 / 97.0 * f64::from(i * i % 97)).collect();
        let highest = highest_frequency(&places);
        assert!((highest - 4.0 * usual_rate(&places)).abs() < 1e-9, "{highest}");
        assert!(resolves(&places, 1.5 * highest));
    }

    /// A logger whose clock is off by up to a sixth of its interval either way.
    #[test]
    fn nearly_even_places_have_a_rate_and_even_ones_none() {
        let off = |i: u32| 0.3 * (f64::from(i * i % 97) / 96.0 - 0.5);
        let places: Vec<f64> = (0..97_u32).map(|i| 2.7 * (f64::from(i) + off(i))).collect();
        let rate = nearly_even_rate(&[&places]).expect("a rate");
        assert!((2.7 * rate - 1.0).abs() < 0.002, "{rate}");
        let even: Vec<f64> = (0..97).map(f64::from).collect();
        assert_eq!(nearly_even_rate(&[&even[..50], &even[60..]]), None);
    }

    /// Targets of ISO 230-2, a fifth of their distance off an even row.
    #[test]
    fn targets_off_an_even_row_may_resolve_a_wave_between_them() {
        let off = |i: u32| 0.4 * (f64::from(i * i % 37) / 36.0 - 0.5);
        let places: Vec<f64> = (0..37_u32).map(|i| f64::from(i) + off(i)).collect();
        assert!(!resolves(&places, 1.3) && may_resolve(&places, 1.3));
        let even: Vec<f64> = (0..37).map(f64::from).collect();
        assert!(!may_resolve(&even, 1.3));
    }

    #[test]
    fn what_has_an_alias_is_not_resolved() {
        let even: Vec<f64> = (0..500).map(|i| 0.1 * f64::from(i)).collect();
        assert!(resolves(&even, 4.9) && !resolves(&even, 5.1) && !resolves(&even, 40.0));
    }
}
