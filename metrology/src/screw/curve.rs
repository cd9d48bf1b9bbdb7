//! Travel deviation against travel, as measured.

use crate::Error;

/// Travel deviation against travel: the travel never decreases, everything is finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    travel_mm: Vec<f64>,
    deviation_um: Vec<f64>,
}

/// A stretch of travel without samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Last sample before it, mm.
    pub from_mm: f64,
    /// First sample after it, mm.
    pub to_mm: f64,
}

/// A stretch is a gap when it is this many times the median sampling step.
const GAP_STEPS: f64 = 5.0;

impl Curve {
    /// A curve from samples in the order they were taken; a curve measured towards smaller
    /// travel is turned round.
    ///
    /// NaN is a missing cell, of a place as of a deviation, and its sample is left out.
    ///
    /// # Errors
    ///
    /// When the columns differ in length, travel is infinite or changes its direction, a
    /// deviation is infinite, or fewer than two different places are left.
    pub fn new(travel_mm: &[f64], deviation_um: &[f64]) -> Result<Self, Error> {
        if travel_mm.len() != deviation_um.len() {
            return Err(Error::ColumnLengths {
                expected: travel_mm.len(),
                found: deviation_um.len(),
            });
        }
        let places: Vec<(usize, f64)> =
            travel_mm.iter().copied().enumerate().filter(|(_, x)| !x.is_nan()).collect();
        let forward = places.first().map(|(_, first)| first) <= places.last().map(|(_, last)| last);
        check_order(&places, forward)?;
        if let Some(row) = deviation_um.iter().position(|value| value.is_infinite()) {
            return Err(Error::NotFinite { row, column: "deviation" });
        }
        let samples = travel_mm.iter().zip(deviation_um);
        let kept = samples.filter(|(place, value)| !place.is_nan() && !value.is_nan());
        let (mut travel_mm, mut deviation_um): (Vec<f64>, Vec<f64>) = kept.unzip();
        if !forward {
            travel_mm.reverse();
            deviation_um.reverse();
        }
        Self { travel_mm, deviation_um }.long_enough()
    }

    /// Travel of each sample, mm, never decreasing.
    #[must_use]
    pub fn travel_mm(&self) -> &[f64] {
        &self.travel_mm
    }

    /// Deviation of each sample, µm, positive when the thread is longer than nominal.
    #[must_use]
    pub fn deviation_um(&self) -> &[f64] {
        &self.deviation_um
    }

    /// Travel between the first sample and the last, mm.
    #[must_use]
    pub fn length_mm(&self) -> f64 {
        self.last_mm() - self.first_mm()
    }

    /// Travel of the first sample, mm.
    #[must_use]
    pub fn first_mm(&self) -> f64 {
        self.travel_mm[0]
    }

    /// Travel of the last sample, mm.
    #[must_use]
    pub fn last_mm(&self) -> f64 {
        self.travel_mm[self.travel_mm.len() - 1]
    }

    /// The samples from `from_mm` to `to_mm`, both included: the useful travel without run-outs.
    ///
    /// # Errors
    ///
    /// When fewer than two different places lie between them.
    pub fn between(&self, from_mm: f64, to_mm: f64) -> Result<Self, Error> {
        let first = self.travel_mm.partition_point(|&x| x < from_mm - super::WINDOW_SLACK_MM);
        let end = self.travel_mm.partition_point(|&x| x <= to_mm + super::WINDOW_SLACK_MM);
        let chosen = first..end.max(first);
        let travel_mm = self.travel_mm[chosen.clone()].to_vec();
        Self { travel_mm, deviation_um: self.deviation_um[chosen].to_vec() }.long_enough()
    }

    /// The same travel with other deviations, each made of the one there is, µm.
    #[must_use]
    pub(super) fn changed(&self, change: impl FnMut(&f64) -> f64) -> Self {
        let deviation_um = self.deviation_um.iter().map(change).collect();
        Self { travel_mm: self.travel_mm.clone(), deviation_um }
    }

    /// The curve without some of its rows; `None` where what is left has no length.
    pub(super) fn without(&self, rows: &[usize]) -> Option<Self> {
        let kept = |values: &[f64]| -> Vec<f64> {
            let rest = values.iter().enumerate().filter(|(row, _)| !rows.contains(row));
            rest.map(|(_, value)| *value).collect()
        };
        let rest =
            Self { travel_mm: kept(&self.travel_mm), deviation_um: kept(&self.deviation_um) };
        rest.long_enough().ok()
    }

    /// The same travel, measured with a device whose lengths are too long by so many µm/m.
    #[must_use]
    pub fn stretched(&self, um_per_m: f64) -> Self {
        let samples = self.travel_mm.iter().zip(&self.deviation_um);
        let deviation_um = samples.map(|(mm, um)| um + um_per_m * mm / 1000.0).collect();
        Self { travel_mm: self.travel_mm.clone(), deviation_um }
    }

    /// Median distance of neighbouring samples, mm; samples at one place do not count.
    #[must_use]
    pub fn median_step_mm(&self) -> f64 {
        let steps = self.travel_mm.windows(2).map(|pair| pair[1] - pair[0]);
        let mut steps: Vec<f64> = steps.filter(|&step| 0.0 < step).collect();
        let middle = steps.len() / 2;
        *steps.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Stretches without samples, five median steps or longer.
    #[must_use]
    pub fn gaps(&self) -> Vec<Gap> {
        let longest_mm = GAP_STEPS * self.median_step_mm();
        let gap = |pair: &[f64]| Gap { from_mm: pair[0], to_mm: pair[1] };
        self.travel_mm.windows(2).filter(|p| longest_mm <= p[1] - p[0]).map(gap).collect()
    }

    /// Deviation at `at_mm`, µm, on the straight line between its neighbours; `None` outside.
    #[must_use]
    pub fn at(&self, at_mm: f64) -> Option<f64> {
        let after = self.travel_mm.partition_point(|&x| x < at_mm);
        let (x1, y1) = (*self.travel_mm.get(after)?, self.deviation_um[after]);
        if x1 <= at_mm {
            return Some(y1);
        }
        let before = after.checked_sub(1)?;
        let (x0, y0) = (self.travel_mm[before], self.deviation_um[before]);
        Some(y0 + (y1 - y0) * (at_mm - x0) / (x1 - x0))
    }

    /// Refuses what has no length.
    fn long_enough(self) -> Result<Self, Error> {
        match (self.travel_mm.first(), self.travel_mm.last()) {
            (Some(first), Some(last)) if first < last => Ok(self),
            _ => Err(Error::TooFewSamples { found: self.travel_mm.len(), expected: 2 }),
        }
    }
}

/// Refuses travel that is infinite or turns round; places have the numbers of their rows.
fn check_order(places: &[(usize, f64)], forward: bool) -> Result<(), Error> {
    if let Some((row, _)) = places.iter().find(|(_, x)| x.is_infinite()) {
        return Err(Error::NotFinite { row: *row, column: "travel" });
    }
    let turns = |pair: &&[(usize, f64)]| {
        if forward { pair[1].1 < pair[0].1 } else { pair[0].1 < pair[1].1 }
    };
    match places.windows(2).find(turns) {
        None => Ok(()),
        Some(pair) => {
            let ((_, previous_mm), (row, found_mm)) = (pair[0], pair[1]);
            Err(Error::TravelTurns { row, found_mm, previous_mm })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backward_measurement_is_turned_round_and_missing_cells_are_left_out() {
        let travel_mm = [3.0, 2.0, f64::NAN, 1.0, f64::NAN];
        let curve = Curve::new(&travel_mm, &[30.0, f64::NAN, 15.0, 10.0, 3.0]).unwrap();
        assert_eq!(curve.travel_mm(), [1.0, 3.0]);
        assert_eq!(curve.deviation_um(), [10.0, 30.0]);
        assert_eq!(curve.at(2.0), Some(20.0));
        assert_eq!(curve.at(3.1), None);
    }

    #[test]
    fn travel_that_turns_is_refused_with_its_row() {
        let error = Curve::new(&[0.0, 2.0, 1.0, 3.0], &[0.0; 4]).unwrap_err();
        assert!(matches!(error, Error::TravelTurns { row: 2, .. }), "{error}");
        let error = Curve::new(&[0.0, f64::NAN, 2.0, 1.0], &[0.0; 4]).unwrap_err();
        assert!(matches!(error, Error::TravelTurns { row: 3, .. }), "{error}");
    }

    #[test]
    fn a_gap_is_found() {
        let travel_mm: Vec<f64> =
            (0..50).filter(|k| !(20..30).contains(k)).map(f64::from).collect();
        let curve = Curve::new(&travel_mm, &vec![0.0; travel_mm.len()]).unwrap();
        assert_eq!(curve.gaps(), [Gap { from_mm: 19.0, to_mm: 30.0 }]);
    }
}
