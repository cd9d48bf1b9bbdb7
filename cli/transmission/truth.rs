//! A known transmission error from a file, to hold the methods against.

use std::path::Path;

use anyhow::{anyhow, bail};

use super::evaluation::ARCSEC;
use crate::shared::series::Series;

/// The true error, linear between its rows.
pub(crate) struct Truth {
    turns: Vec<f64>,
    error_rad: Vec<f64>,
}

impl Truth {
    pub(crate) fn at(&self, turns: f64) -> f64 {
        let after = self.turns.partition_point(|x| *x < turns).clamp(1, self.turns.len() - 1);
        let (x0, x1) = (self.turns[after - 1], self.turns[after]);
        let part = ((turns - x0) / (x1 - x0)).clamp(0.0, 1.0);
        self.error_rad[after - 1] + (self.error_rad[after] - self.error_rad[after - 1]) * part
    }
}

/// Reads `output_turns` and `delta_arcsec`.
pub(crate) fn read_truth(path: &Path) -> anyhow::Result<Truth> {
    let series = Series::read_all(path)?;
    let (turns, error) = (series.column("output_turns")?, series.column("delta_arcsec")?);
    if turns.len() < 2 {
        bail!("{}: {} rows, expected two or more", path.display(), turns.len());
    }
    let falls = |pair: &[f64]| pair[1].partial_cmp(&pair[0]) != Some(std::cmp::Ordering::Greater);
    if let Some(row) = turns.windows(2).position(falls) {
        let (found, before) = (turns[row + 1], turns[row]);
        let refused = anyhow!("{found} turns after {before}, expected increasing turns");
        return Err(refused.context(series.place(row + 1)));
    }
    Ok(Truth { turns, error_rad: error.iter().map(|arcsec| arcsec / ARCSEC).collect() })
}
