//! The largest spread of a curve inside any window of travel.
//!
//! Method: two monotone queues (Lemire 2006, "Streaming maximum-minimum filter using no more
//! than three comparisons per element"): one holds candidates for the highest value, one for the
//! lowest. Each sample enters and leaves each queue once, so the search is O(n), whatever the
//! window and however uneven the sampling.
//!
//! A window is closed: two samples exactly `window_mm` apart are in one window. Nothing is
//! interpolated at its ends, so every reported value was measured; with a sampling step `d` the
//! widest window may therefore be short of `window_mm` by less than `d`.

use std::collections::VecDeque;

/// Windows are longer than asked for by this much, one nanometre of travel, so that rounding of
/// positions such as 0.1 + 0.2 does not push a sample out of a window it belongs to.
pub const WINDOW_SLACK_MM: f64 = 1e-6;

/// The widest spread found, with the samples that make it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widest {
    /// Highest minus lowest value, in the unit of the values.
    pub spread: f64,
    /// Index of the highest sample.
    pub highest: usize,
    /// Index of the lowest sample.
    pub lowest: usize,
    /// Most samples any window held.
    pub most_samples: usize,
}

/// The largest `highest − lowest` inside any window of `window_mm`, every sample being a start.
///
/// `travel_mm` must not decrease and be as long as `values`; both must be finite. Of equal
/// spreads the first is returned. `None` when there is no sample.
///
/// # Examples
///
/// ```
/// use helixlock_metrology::screw::widest_in_windows;
///
/// let widest = widest_in_windows(&[0.0, 100.0, 200.0, 400.0], &[0.0, 1.0, -2.0, 9.0], 150.0);
/// assert_eq!(widest.map(|found| found.spread), Some(3.0));
/// ```
#[must_use]
pub fn widest_in_windows(travel_mm: &[f64], values: &[f64], window_mm: f64) -> Option<Widest> {
    let reach_mm = window_mm + WINDOW_SLACK_MM;
    if travel_mm.last().zip(travel_mm.first()).is_some_and(|(last, first)| last - first <= reach_mm)
    {
        return widest_of_all(values);
    }
    let (mut high, mut low) = (VecDeque::new(), VecDeque::new());
    let mut start = 0;
    let mut widest: Option<Widest> = None;
    for (index, (&end_mm, &value)) in travel_mm.iter().zip(values).enumerate() {
        while reach_mm < end_mm - travel_mm[start] {
            start += 1;
        }
        let highest = admit(&mut high, start, Sample { value, index }, |a, b| a <= b);
        let lowest = admit(&mut low, start, Sample { value, index }, |a, b| b <= a);
        let most_samples = widest.map_or(0, |found| found.most_samples).max(index + 1 - start);
        let spread = highest.value - lowest.value;
        if let Some(found) = &mut widest
            && spread <= found.spread
        {
            found.most_samples = most_samples;
        } else {
            let (highest, lowest) = (highest.index, lowest.index);
            widest = Some(Widest { spread, highest, lowest, most_samples });
        }
    }
    widest
}

/// All samples as one window.
fn widest_of_all(values: &[f64]) -> Option<Widest> {
    let (mut highest, mut lowest) = (0, 0);
    for (index, &value) in values.iter().enumerate() {
        if values[highest] < value {
            highest = index;
        }
        if value < values[lowest] {
            lowest = index;
        }
    }
    let spread = values.get(highest)? - values[lowest];
    Some(Widest { spread, highest, lowest, most_samples: values.len() })
}

/// A value with its place; kept together so that the queues never look back into the curve.
#[derive(Clone, Copy)]
struct Sample {
    value: f64,
    index: usize,
}

/// Takes `new` into a queue, drops what it makes useless and what the window has left behind,
/// and returns the queue's best.
fn admit(
    queue: &mut VecDeque<Sample>,
    start: usize,
    new: Sample,
    useless: impl Fn(f64, f64) -> bool,
) -> Sample {
    while queue.back().is_some_and(|last| useless(last.value, new.value)) {
        queue.pop_back();
    }
    queue.push_back(new);
    while queue.front().is_some_and(|first| first.index < start) {
        queue.pop_front();
    }
    queue.front().copied().unwrap_or(new)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Every pair of samples no further apart than the window: O(n²), nothing to get wrong.
    fn naive(travel_mm: &[f64], values: &[f64], window_mm: f64) -> f64 {
        let mut spread: f64 = 0.0;
        for (i, &start_mm) in travel_mm.iter().enumerate() {
            for (j, &end_mm) in travel_mm.iter().enumerate().skip(i) {
                if end_mm - start_mm <= window_mm + WINDOW_SLACK_MM {
                    spread = spread.max((values[i] - values[j]).abs());
                }
            }
        }
        spread
    }

    proptest! {
        #[test]
        fn equals_the_naive_search_on_uneven_samples(
            samples in prop::collection::vec((0.0..3.0f64, -9.0..9.0f64), 1..80),
            window_mm in 0.0..40.0f64,
        ) {
            let mut at_mm = 0.0;
            let travel_mm: Vec<f64> = samples.iter().map(|(step, _)| { at_mm += step; at_mm }).collect();
            let values: Vec<f64> = samples.iter().map(|(_, value)| *value).collect();
            let found = widest_in_windows(&travel_mm, &values, window_mm).unwrap();
            prop_assert_eq!(found.spread, naive(&travel_mm, &values, window_mm));
            prop_assert_eq!(found.spread, values[found.highest] - values[found.lowest]);
        }
    }

    /// The worked count of document 5: 2 mm lead, 16 samples a turn, so 300 mm are 2400
    /// intervals; the closed window holds both its ends.
    #[test]
    fn a_300_mm_window_of_document_5_has_2400_intervals() {
        let travel_mm: Vec<f64> = (0..=8000).map(|k| f64::from(k) / 8.0).collect();
        let values = vec![0.0; travel_mm.len()];
        let found = widest_in_windows(&travel_mm, &values, 300.0).unwrap();
        assert_eq!(found.most_samples, 2401);
    }

    #[test]
    fn rounded_positions_stay_in_their_window() {
        let travel_mm: Vec<f64> = (0..=3000).map(|k| f64::from(k) * 0.1).collect();
        let mut values = vec![0.0; travel_mm.len()];
        values[3000] = 5.0;
        values[0] = -1.0;
        assert_eq!(widest_in_windows(&travel_mm, &values, 300.0).unwrap().spread, 6.0);
    }
}
