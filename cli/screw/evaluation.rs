//! What `helixlock screw` finds.

use std::path::PathBuf;

use helixlock_metrology::screw::{
    Characteristic, Curve, Doubt, Estimate, FAITHFUL_PER_TURN, Gap, Grading, MeanLine, Status,
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
    /// Ends of the useful travel that were asked for, without run-outs, mm.
    pub(crate) asked_mm: [Option<f64>; 2],
    /// Ends of the data, mm.
    pub(crate) data_mm: [f64; 2],
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
    /// Why nothing is said without that noise.
    pub(crate) doubt: Option<Doubt>,
    /// Places of readings far off their neighbours, mm.
    pub(crate) wild_mm: Vec<f64>,
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
        notes.extend(self.beyond_the_data());
        for one in &self.characteristics {
            if let Err(why) = &one.reached {
                notes.push(format!("{} has no value: {why}", one.symbol));
            }
        }
        notes.extend(self.reading_noise_um.into_iter().flat_map(|um| self.of_noise(um)));
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

    /// What the readings say of their noise.
    fn of_noise(&self, noise_um: f64) -> Vec<String> {
        let all = match self.doubt {
            None => format!(
                "values are as measured, wider than the screw by noise of {noise_um} µm a reading; probabilities are of the values without it"
            ),
            Some(Doubt::Steadier { found_um }) => format!(
                "neighbouring readings show noise of {found_um:.3} µm, less than the {noise_um} µm told: they share it, or it is smaller, and nothing is said without noise"
            ),
            Some(Doubt::Coarse { step_um }) => format!(
                "readings are whole steps of {step_um} µm, and noise of {noise_um} µm is too small to be new at each: nothing is said without noise"
            ),
        };
        let wild = self.wild_mm.first().map(|first_mm| match self.wild_mm.len() {
            1 => format!("the reading at {first_mm:.3} mm is far off its neighbours: it is in the values as measured, and not in those without noise"),
            readings => format!("{readings} readings, the first at {first_mm:.3} mm, are far off their neighbours: they are in the values as measured, and not in those without noise"),
        });
        std::iter::once(all).chain(wild).collect()
    }

    /// Ends that were asked for and lie beyond the data by more than a step.
    fn beyond_the_data(&self) -> Vec<String> {
        let ([from, to], [first, last]) = (self.asked_mm, self.data_mm);
        let step = self.curve.median_step_mm();
        let before = from.filter(|from| *from < first - step).map(|from| {
            format!("the data begin at {first:.3} mm, not at {from:.3} mm as asked: evaluated and graded from there")
        });
        let behind = to.filter(|to| last + step < *to).map(|to| {
            format!("the data end at {last:.3} mm, not at {to:.3} mm as asked: evaluated and graded to there")
        });
        before.into_iter().chain(behind).collect()
    }
}
