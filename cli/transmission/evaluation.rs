//! What `helixlock transmission` finds.

use std::path::PathBuf;

use helixlock_metrology::transmission::{Method, OrderSpectrum, Peak, Pulses, Reading, Setup};

/// Radians to arc seconds.
pub(crate) const ARCSEC: f64 = 180.0 * 3600.0 / std::f64::consts::PI;

/// One method's result.
pub(crate) struct MethodResult {
    /// The method.
    pub(crate) method: Method,
    /// What it found, or why it cannot work here.
    pub(crate) found: Result<Found, String>,
}

/// What a method found.
pub(crate) struct Found {
    /// The error along the run.
    pub(crate) reading: Reading,
    /// Its spectrum, when there are samples enough.
    pub(crate) spectrum: Option<OrderSpectrum>,
    /// Its tallest lines.
    pub(crate) peaks: Vec<Peak>,
    /// Largest and rms difference from the truth, rad.
    pub(crate) against_truth: Option<(f64, f64)>,
}

/// Everything a run of the command found.
pub(crate) struct Evaluation {
    /// The file.
    pub(crate) path: PathBuf,
    /// The pulses.
    pub(crate) pulses: Pulses,
    /// The setting.
    pub(crate) setup: Setup,
    /// Each method asked for.
    pub(crate) results: Vec<MethodResult>,
    /// Largest peak-to-peak error allowed, arcsec.
    pub(crate) limit_arcsec: Option<f64>,
}

impl Evaluation {
    /// The best method that worked: subdivided counting before the others.
    pub(crate) fn best(&self) -> Option<&Found> {
        self.results.iter().rev().find_map(|result| result.found.as_ref().ok())
    }

    /// What a reader of the result must know.
    pub(crate) fn notes(&self) -> Vec<String> {
        let spectrum = self.best().and_then(|found| found.spectrum.as_ref());
        let short = spectrum.filter(|spectrum| spectrum.lines.is_empty());
        let note = |spectrum: &OrderSpectrum| {
            let turns = spectrum.turns;
            format!(
                "{turns:.3} turns of the output are less than one: orders are not told apart, and named shafts are fitted with a constant alone; what no shaft was named for is in them"
            )
        };
        short.map(note).into_iter().collect()
    }

    /// True when there is no limit or the best method keeps it.
    pub(crate) fn holds(&self) -> bool {
        let limit_rad = self.limit_arcsec.map(|limit| limit / ARCSEC);
        limit_rad
            .is_none_or(|limit| self.best().is_some_and(|f| f.reading.peak_to_peak_rad() <= limit))
    }
}
