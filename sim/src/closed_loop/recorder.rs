//! The recorder: from the meter's pulse width to micrometres (figs. 3, 6, 10 of document 1).
//!
//! A comparison runs from one divided grating pulse to the next. The mean of T1 over it is the
//! phase; half a turn is the meter's zero; a whole turn is `range · B · λ/2` of table travel. A
//! pulse wider than half means that the laser lags, which is a positive error.
//!
//! Beyond half the range the phase comes in again at the other end. The pen of the real recorder
//! jumps there; [`unwrap_um`] draws on past the edge, as a person reading the paper would, and the
//! number of jumps stays known.

/// What the meter did in one comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comparison {
    /// Clock at which it began.
    pub begin: u64,
    /// Clock at which it ended, and the next began.
    pub end: u64,
    /// Clocks for which T1 was high.
    pub high: u64,
}

impl Comparison {
    /// Recorder reading, µm, for the travel `full_scale_um` of one turn of phase.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a comparison is far below 2⁵³ clocks")]
    pub fn error_um(&self, full_scale_um: f64) -> f64 {
        reading_um(self.high as f64 / (self.end - self.begin) as f64, full_scale_um)
    }
}

/// Recorder reading, µm, of a meter that is high for a share of the comparison.
pub(crate) fn reading_um(high: f64, full_scale_um: f64) -> f64 {
    (high - 0.5) * full_scale_um
}

/// Gathers comparisons from the changes of T1 and the divided grating pulses.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recorder {
    begin: Option<u64>,
    high: u64,
    high_since: Option<u64>,
}

impl Recorder {
    /// T1 has changed to `level` at `clock`.
    pub fn meter(&mut self, clock: u64, level: bool) {
        match (level, self.high_since) {
            (true, None) => self.high_since = Some(clock),
            (false, Some(since)) => {
                self.high += clock - since;
                self.high_since = None;
            }
            _ => {}
        }
    }

    /// A divided grating pulse has come at `clock`: gives the comparison it ends, if one had begun.
    pub fn compare(&mut self, clock: u64) -> Option<Comparison> {
        if let Some(since) = self.high_since.as_mut() {
            self.high += clock - std::mem::replace(since, clock);
        }
        let high = std::mem::take(&mut self.high);
        let begin = self.begin.replace(clock)?;
        Some(Comparison { begin, end: clock, high })
    }
}

/// Removes the jumps of a whole range from readings, in place, and gives their number.
///
/// Two neighbours further apart than half the range are taken to have jumped; an error that moves
/// that far in one comparison cannot be told from one that did not.
pub fn unwrap_um(readings_um: &mut [f64], full_scale_um: f64) -> usize {
    let mut jumps = 0;
    let mut offset_um = 0.0;
    let mut before_um: Option<f64> = None;
    for reading_um in readings_um {
        let shown_um = *reading_um;
        if let Some(last_um) = before_um.replace(shown_um) {
            let turns = libm::round((shown_um - last_um) / full_scale_um);
            if turns != 0.0 {
                jumps += 1;
                offset_um -= turns * full_scale_um;
            }
        }
        *reading_um += offset_um;
    }
    jumps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wider_than_half_is_positive() {
        let comparison = Comparison { begin: 100, end: 1_100, high: 625 };
        // 45° of a full turn of 40.18 µm are 5.02 µm: the inch example of the report.
        assert!((comparison.error_um(40.18) - 5.022_5).abs() < 1e-12);
    }

    #[test]
    fn a_pulse_belongs_to_the_comparison_it_lies_in() {
        let mut recorder = Recorder::default();
        assert_eq!(recorder.compare(0), None);
        recorder.meter(1, true);
        recorder.meter(501, false);
        assert_eq!(recorder.compare(1_000), Some(Comparison { begin: 0, end: 1_000, high: 500 }));
        recorder.meter(1_001, true);
        // No laser pulse: high right through, as when the laser lags by a whole turn.
        assert_eq!(recorder.compare(2_000).map(|c| c.high), Some(999));
        recorder.meter(2_300, false);
        assert_eq!(recorder.compare(3_000).map(|c| c.high), Some(300));
    }

    #[test]
    fn jumps_of_the_range_are_drawn_on() {
        let mut readings_um = [40.0, 46.0, -43.0, -37.0, -43.0, 46.0];
        assert_eq!(unwrap_um(&mut readings_um, 95.0), 2);
        let drawn_on_um = [40.0, 46.0, 52.0, 58.0, 52.0, 46.0];
        assert!(readings_um.iter().zip(drawn_on_um).all(|(is, due)| (is - due).abs() < 1e-12));
    }
}
