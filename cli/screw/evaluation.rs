//! What `helixlock screw` finds.

use std::path::PathBuf;

use helixlock_metrology::screw::{
    Characteristic, Curve, Estimate, FAITHFUL_PER_TURN, Gap, Grading, MeanLine, Status,
};

use crate::shared::sheet::Sheet;

/// A screw evaluated by either standard.
pub(crate) struct Evaluation {
    /// The file.
    pub(crate) path: PathBuf,
    /// Name of the standard.
    pub(crate) standard: String,
    /// Rows of the file with an empty cell, which do not count.
    pub(crate) left_out: usize,
    /// The useful travel.
    pub(crate) curve: Curve,
    /// Lead, mm.
    pub(crate) lead_mm: f64,
    /// Mean line; the helix of JB/T 2886 is judged without it.
    pub(crate) mean_line: MeanLine,
    /// Samples a turn.
    pub(crate) samples_per_turn: f64,
    /// Sampling intervals in 300 mm.
    pub(crate) intervals_in_300_mm: Option<usize>,
    /// The characteristics.
    pub(crate) characteristics: Vec<Characteristic>,
    /// Stretches without samples.
    pub(crate) gaps: Vec<Gap>,
    /// The grades.
    pub(crate) grading: Grading,
    /// Standard uncertainty, µm.
    pub(crate) uncertainty_um: Option<f64>,
    /// Standard deviation of a single reading, µm.
    pub(crate) reading_noise_um: Option<f64>,
    /// What is known of the characteristics, in their order.
    pub(crate) estimates: Vec<Option<Estimate>>,
    /// The figures on a sheet, when one was told.
    pub(crate) sheet: Option<Sheet>,
}

impl Evaluation {
    /// True when the grade holds.
    pub(crate) fn meets(&self, grade: &str) -> bool {
        self.grading.verdicts.iter().any(|verdict| verdict.grade == grade && verdict.holds)
    }

    /// True when the grade asked for is met, and every tolerance of the sheet is kept.
    pub(crate) fn holds(&self, asked: Option<(&str, bool)>) -> bool {
        asked.is_none_or(|(_, meets)| meets) && self.sheet.as_ref().is_none_or(Sheet::holds)
    }

    /// Every characteristic with what is known of it without the noise of the readings.
    pub(crate) fn without_noise(
        &self,
    ) -> impl Iterator<Item = (&Characteristic, Option<Estimate>)> {
        let noisy = self.reading_noise_um.is_some();
        let estimate = move |index: usize| self.estimates[index].filter(|_| noisy);
        let each = self.characteristics.iter().enumerate();
        each.map(move |(index, one)| (one, estimate(index)))
    }

    /// What a reader of the result must know.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        match self.left_out {
            0 => {}
            1 => notes.push("a row without a position or a deviation is left out".to_owned()),
            rows => {
                notes.push(format!("{rows} rows without a position or a deviation are left out"));
            }
        }
        for one in &self.characteristics {
            if let Err(why) = &one.reached {
                notes.push(format!("{} has no value: {why}", one.symbol));
            }
        }
        if let Some(noise_um) = self.reading_noise_um {
            notes.push(format!("values are as measured, wider than the screw by noise of {noise_um} µm a reading; probabilities are of the values without it"));
        }
        if self.samples_per_turn < FAITHFUL_PER_TURN {
            let found = self.samples_per_turn;
            notes.push(format!("{found:.1} samples a turn: what varies within a turn is a lower bound, expected {FAITHFUL_PER_TURN} or more"));
        }
        notes.extend(self.sheet.as_ref().and_then(Sheet::why_without));
        for gap in &self.gaps {
            let (from, to) = (gap.from_mm, gap.to_mm);
            notes.push(format!(
                "no samples from {from:.3} mm to {to:.3} mm: a variation across it is a lower bound"
            ));
        }
        if self.grading.status != Status::Verified {
            let status = self.grading.status.name();
            notes.push(format!("the limits of this grade are {status}: see the source of each"));
        }
        if let Some(status) = self.grading.refused_by.filter(|s| *s != Status::Verified) {
            let status = status.name();
            notes.push(format!("a better grade is refused by limits, some of them {status}"));
        }
        notes
    }
}
