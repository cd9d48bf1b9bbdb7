//! Readings of three probes from a file: runs told apart, samples put on their even steps.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{anyhow, bail};
use helixlock_metrology::straightness::{Readings, Repeat};

use crate::shared::series::Series;

const PROBES: [&str; 3] = ["probe1_um", "probe2_um", "probe3_um"];

/// Reads the runs of a file; without a column `repeat` there is one.
///
/// Every run must hold the same positions, in any order, at even steps.
pub(crate) fn read_readings(path: &Path) -> anyhow::Result<Readings> {
    let series = Series::read_all(path)?;
    let position_mm = series.column("position_mm")?;
    let probes = [series.column(PROBES[0])?, series.column(PROBES[1])?, series.column(PROBES[2])?];
    let repeat = series.optional("repeat")?;
    let mut runs: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for row in 0..position_mm.len() {
        let run = repeat.as_ref().map_or(0.0, |repeat| repeat[row]);
        if !position_mm[row].is_finite() || !run.is_finite() {
            let refused = anyhow!("no number, expected `position_mm` and `repeat` in every row");
            return Err(refused.context(series.place(row)));
        }
        runs.entry(ordered(run)).or_default().push(row);
    }
    let mut grid: Option<Vec<f64>> = None;
    let mut repeats = Vec::new();
    for rows in runs.into_values() {
        let rows = sorted(rows, &position_mm);
        let positions: Vec<f64> = rows.iter().map(|row| position_mm[*row]).collect();
        let first = grid.get_or_insert_with(|| positions.clone());
        if let Some(off) = off_grid(first, &positions) {
            let row = rows.get(off).or(rows.last()).copied().unwrap_or(0);
            let refused = anyhow!(
                "this run leaves the positions of the first one, expected the same {} positions in every run",
                first.len()
            );
            return Err(refused.context(series.place(row)));
        }
        let probes_um = [0, 1, 2].map(|probe| rows.iter().map(|row| probes[probe][*row]).collect());
        repeats.push(Repeat { probes_um });
    }
    let grid = grid.unwrap_or_default();
    let (start_mm, step_mm) = even_steps(&grid, path)?;
    Ok(Readings { start_mm, step_mm, repeats })
}

/// A key that keeps the order of the numbers of runs.
fn ordered(run: f64) -> u64 {
    let bits = run.to_bits();
    if run < 0.0 { !bits } else { bits ^ (1 << 63) }
}

fn sorted(mut rows: Vec<usize>, position_mm: &[f64]) -> Vec<usize> {
    rows.sort_by(|a, b| position_mm[*a].total_cmp(&position_mm[*b]));
    rows
}

/// The first place where two runs differ by more than a micrometre of position.
fn off_grid(first: &[f64], other: &[f64]) -> Option<usize> {
    let differs = first.iter().zip(other).position(|(a, b)| 1e-3 < (a - b).abs());
    differs.or_else(|| (first.len() != other.len()).then_some(first.len().min(other.len())))
}

/// First position and step of an even grid.
fn even_steps(grid: &[f64], path: &Path) -> anyhow::Result<(f64, f64)> {
    let place = path.display();
    let (&[first, .., last], count) = (grid, grid.len()) else {
        bail!("{place}: {} positions, expected four or more", grid.len());
    };
    #[expect(clippy::cast_precision_loss, reason = "positions of a file are few")]
    let step_mm = (last - first) / (count - 1) as f64;
    let uneven = grid.windows(2).find(|pair| 1e-3 * step_mm < (pair[1] - pair[0] - step_mm).abs());
    match uneven {
        None if 0.0 < step_mm => Ok((first, step_mm)),
        None => bail!("{place}: all positions are alike, expected a stroke"),
        Some(pair) => bail!(
            "{place}: positions {} mm and {} mm are not {step_mm} mm apart, expected even steps",
            pair[0],
            pair[1]
        ),
    }
}
