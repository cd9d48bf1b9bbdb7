//! An effect judged against a model.

use super::component::Component;
use super::fit::Fit;

/// One effect judged against a model, the noise fitted with it.
#[derive(Debug, Clone)]
pub(crate) struct Judged {
    /// The effect with its columns in use.
    pub(crate) component: Component,
    /// The joint fit with the model.
    pub(crate) fit: Fit,
    /// Twice the log likelihood ratio against the model without it.
    pub(crate) gain: f64,
    /// The same less what its freedom costs; differences of it rank effects.
    pub(crate) evidence: f64,
    /// Independent places that were looked at.
    pub(crate) looks: f64,
    /// Effects that were tried with it.
    pub(crate) tried: f64,
    /// Chance in noise, the places looked at and the effects tried counted.
    pub(crate) p_value: f64,
    /// Root mean square left, µm (arcsec).
    pub(crate) rms_um: f64,
    /// Root mean square on held-out data.
    pub(crate) holdout_rms_um: f64,
}

impl Judged {
    /// What its freedom and its looks cost as evidence.
    #[must_use]
    pub(crate) fn price(&self) -> f64 {
        self.gain - self.evidence
    }

    /// Coefficients of the effect's columns in use, the last ones of the joint fit, and where they
    /// begin.
    #[must_use]
    pub(crate) fn coefficients(&self) -> (&[f64], usize) {
        let all = &self.fit.linear.coefficients;
        let from = all.len() - self.component.width();
        (&all[from..], from)
    }
}
