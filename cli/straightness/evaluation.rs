//! What `helixlock straightness` finds.

use std::path::PathBuf;

use clap::ValueEnum;
use helixlock_metrology::Error;
use helixlock_metrology::straightness::{
    Combined, CompensationModel, CompensationOutcome, CorrectionPoint, Plan, Separated,
    StraightnessLines, straightness,
};

use crate::shared::sheet::Sheet;

/// Methods on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum By {
    /// Fourier series: the bar's form repeats with the stroke
    Fourier,
    /// Least squares: the bar is smooth, nothing repeats
    LeastSquares,
}

/// One method's result with its straightness.
pub(crate) struct Outcome {
    /// Bar and carriage.
    pub(crate) separated: Separated,
    /// Straightness of the bar.
    pub(crate) workpiece: StraightnessLines,
    /// Straightness of the carriage motion.
    pub(crate) carriage: StraightnessLines,
}

impl Outcome {
    /// With the straightness of what was separated.
    pub(crate) fn new(separated: Separated) -> Result<Self, Error> {
        let lines = |heights: &[f64]| {
            let found = straightness(&separated.position_mm, heights);
            found.ok_or(Error::TooFewSamples { found: heights.len(), expected: 2 })
        };
        let (workpiece, carriage) =
            (lines(&separated.workpiece_um)?, lines(&separated.carriage_um)?);
        Ok(Self { separated, workpiece, carriage })
    }
}

/// Everything a run of the command found.
pub(crate) struct Evaluation {
    /// The file.
    pub(crate) path: PathBuf,
    /// Runs in it.
    pub(crate) repeats: usize,
    /// True when the bar's parabola is measured.
    pub(crate) zeros_matched: bool,
    /// The straightness on a sheet, when one was told.
    pub(crate) sheet: Option<Sheet>,
    /// The combined readings.
    pub(crate) combined: Combined,
    /// What the spacings do.
    pub(crate) plan: Plan,
    /// By Fourier series.
    pub(crate) fourier: Outcome,
    /// By least squares.
    pub(crate) least_squares: Outcome,
    /// How far the two are apart over the bar, µm rms.
    pub(crate) rms_difference_um: f64,
    /// Which one counts.
    pub(crate) method: By,
    /// The correction table.
    pub(crate) correction: Vec<CorrectionPoint>,
    /// The simulated compensation with its parameters.
    pub(crate) compensation: Option<(CompensationModel, CompensationOutcome)>,
}

impl Evaluation {
    /// The result that counts.
    pub(crate) fn chosen(&self) -> &Outcome {
        match self.method {
            By::Fourier => &self.fourier,
            By::LeastSquares => &self.least_squares,
        }
    }

    /// True when a limit, if there is one, and the tolerances of the sheet are kept.
    pub(crate) fn holds(&self, limit_um: Option<f64>) -> bool {
        limit_um.is_none_or(|limit_um| self.keeps(limit_um))
            && self.sheet.as_ref().is_none_or(Sheet::holds)
    }

    /// True when the straightness of the bar is within a limit.
    pub(crate) fn keeps(&self, limit_um: f64) -> bool {
        self.chosen().workpiece.minimum_zone.error_um <= limit_um
    }
}
