//! From a diagnosis to a better machine file, and the book that is kept of it.

use helixlock_plant::{MachineError, MachineFile, Term};

use super::diagnosis::{Diagnosis, FittedEffect, Round};
use crate::model::Problem;
use crate::spectrum::amplitude_spectrum;

/// Order spectra of one sensor's residual.
#[derive(Debug, Clone)]
pub struct Spectra {
    /// Before anything was added.
    pub before: Vec<[f64; 2]>,
    /// After the last round.
    pub after: Vec<[f64; 2]>,
}

/// Spectra before and after, one entry a sensor.
#[must_use]
pub fn spectra(problem: &Problem, diagnosis: &Diagnosis) -> Vec<Spectra> {
    let spectrum = |left, sensor| amplitude_spectrum(problem, left, sensor);
    let sensor = |sensor| Spectra {
        before: spectrum(&diagnosis.before, sensor),
        after: spectrum(&diagnosis.left, sensor),
    };
    (0..problem.sensors.len()).map(sensor).collect()
}

/// A machine file with the effects of a round written into it, comments and order kept.
///
/// A wrong setting is put right instead of being modelled.
///
/// # Errors
///
/// [`MachineError`] when the machine cannot carry an effect.
pub fn written(file: &MachineFile, effects: &[FittedEffect]) -> Result<MachineFile, MachineError> {
    let mut file = file.clone();
    for effect in effects {
        file = match corrected_setting(&effect.term) {
            Some((key, value)) => file.with_setting(key, &value)?,
            None => file.with_effect(&effect.term)?,
        };
    }
    Ok(file)
}

/// Key and TOML value of the setting that an effect says is wrong.
#[must_use]
pub(crate) fn corrected_setting(term: &Term) -> Option<(&'static str, String)> {
    let with_values = term.parameters.iter().zip(&term.values);
    with_values.filter(|(_, value)| **value != 0.0).find_map(|(what, value)| {
        let (_, key) = term.nature().settings.iter().find(|(name, _)| *name == what.name)?;
        let value = match what.unit.suffix().as_str() {
            "" => format!("{value:.0}"),
            unit => format!("\"{value} {unit}\""),
        };
        Some((*key, value))
    })
}

/// One entry of the ledger: what was known after a round, enough to go back to it.
#[derive(Debug, Clone)]
pub struct LedgerEntry {
    /// The round.
    pub round: Round,
    /// The machine file after it, as text.
    pub machine: String,
    /// Root mean square before the round, µm (arcsec).
    pub rms_before_um: f64,
    /// Held-out root mean square before the round.
    pub holdout_rms_before_um: f64,
}

/// Everything a search did to a machine file.
#[derive(Debug, Clone)]
pub struct Ledger {
    /// Fingerprint of the data, so that a ledger is not taken for that of another file.
    pub data_hash: String,
    /// True when the rounds stand: what they added goes into the machine file.
    pub accepted: bool,
    /// Rounds, the first with the machine file as it was.
    pub entries: Vec<LedgerEntry>,
}

/// The book of a diagnosis.
///
/// # Errors
///
/// [`MachineError`] when the machine cannot carry an effect.
pub fn ledger(
    file: &MachineFile,
    diagnosis: &Diagnosis,
    data_hash: String,
) -> Result<Ledger, MachineError> {
    let mut entries: Vec<LedgerEntry> = Vec::new();
    for round in &diagnosis.rounds {
        let before = entries.last().map_or((round.rms_um, round.holdout_rms_um), |last| {
            (last.round.rms_um, last.round.holdout_rms_um)
        });
        entries.push(LedgerEntry {
            round: round.clone(),
            machine: written(file, &round.effects)?.text(),
            rms_before_um: before.0,
            holdout_rms_before_um: before.1,
        });
    }
    Ok(Ledger { data_hash, accepted: true, entries })
}

/// 64-bit FNV-1a of some bytes, in hexadecimal.
#[must_use]
pub fn fingerprint(bytes: &[u8]) -> String {
    format!("fnv1a64:{:016x}", fnv1a64(bytes))
}

/// 64-bit FNV-1a of some bytes: tells files apart, proves nothing.
#[must_use]
pub fn fnv1a64(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fingerprints_are_the_published_ones() {
        // Test vectors of the FNV authors' draft, 64-bit FNV-1a.
        assert_eq!(fingerprint(b""), "fnv1a64:cbf29ce484222325");
        assert_eq!(fingerprint(b"a"), "fnv1a64:af63dc4c8601ec8c");
        assert_eq!(fingerprint(b"foobar"), "fnv1a64:85944171f73967e8");
    }
}
