//! Flips as rows of numbers, and back.

use std::io::Write;

use anyhow::Context;
use helixlock_sim::faults::{Outcome, Verdict, flip_flops};
use helixlock_traces::Table;

use crate::shared::cases::cells;

/// Cells of a row: the flip-flop by its place, the verdict by its place among four, a time that
/// there is none of as not a number, and what all flips of a campaign have in common.
pub(super) const COLUMNS: [&str; 13] = [
    "flip_flop",
    "time_s",
    "verdict",
    "healed_clocks",
    "worst_um",
    "left_um",
    "recovery_s",
    "home_error_steps",
    "ring_slip_steps",
    "ring_illegal_clocks",
    "fault_shown",
    "window_s",
    "band_um",
];

/// Verdicts as they are called.
pub(super) const VERDICTS: [(Verdict, &str); 4] = [
    (Verdict::Unseen, "unseen"),
    (Verdict::Recovers, "recovers"),
    (Verdict::HomeLost, "home lost"),
    (Verdict::Stays, "stays"),
];

/// A verdict as one word.
pub(super) fn word(verdict: Verdict) -> String {
    let name = VERDICTS.iter().find(|(known, _)| *known == verdict);
    name.map_or_else(String::new, |(_, name)| name.replace(' ', "-"))
}

/// A campaign.
pub(crate) struct Faults {
    /// Names of the flip-flops of the device.
    pub(crate) flip_flops: Vec<String>,
    /// Instants, s since power-up.
    pub(crate) instants_s: Vec<f64>,
    /// How long each flip was followed in closed loop, s.
    pub(crate) window_s: f64,
    /// Within this the table is on its course, µm.
    pub(crate) band_um: f64,
    /// By instant, then by flip-flop.
    pub(crate) outcomes: Vec<Outcome>,
}

impl Faults {
    /// The flip-flop that was flipped.
    pub(super) fn name(&self, flip: &Outcome) -> &str {
        &self.flip_flops[flip.flip_flop]
    }
}

/// The row of a flip.
#[expect(clippy::cast_precision_loss, reason = "places, steps and clocks of a window")]
pub(super) fn cells_of(flip: &Outcome, [window_s, band_um]: [f64; 2]) -> Vec<f64> {
    let verdict = VERDICTS.iter().position(|(verdict, _)| *verdict == flip.verdict);
    vec![
        flip.flip_flop as f64,
        flip.time_s,
        verdict.map_or(f64::NAN, |place| place as f64),
        flip.healed_clocks.map_or(f64::NAN, |clocks| clocks as f64),
        flip.worst_um,
        flip.left_um,
        flip.recovery_s.unwrap_or(f64::NAN),
        flip.home_error as f64,
        flip.ring_slip as f64,
        flip.ring_illegal_clocks as f64,
        f64::from(u8::from(flip.fault_shown)),
        window_s,
        band_um,
    ]
}

/// The campaign of a table.
pub(super) fn faults_of(table: &Table) -> anyhow::Result<Faults> {
    let (flip_flops, mut instants_s, mut outcomes) = (flip_flops(), Vec::new(), Vec::new());
    let mut course = [f64::NAN; 2];
    for (row, cells) in cells(table).enumerate() {
        let flip = outcome(&cells).filter(|flip| flip.flip_flop < flip_flops.len());
        let flip = flip.with_context(|| {
            format!("{}: row {row} is no flip of this device", table.path.display())
        })?;
        if instants_s.last() != Some(&flip.time_s) {
            instants_s.push(flip.time_s);
        }
        course = [cells[11], cells[12]];
        outcomes.push(flip);
    }
    let [window_s, band_um] = course;
    Ok(Faults { flip_flops, instants_s, window_s, band_um, outcomes })
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers that were written as such; a cast saturates"
)]
fn outcome(cells: &[f64]) -> Option<Outcome> {
    let optional = |cell: f64| Some(cell).filter(|cell| !cell.is_nan());
    let &[
        flip_flop,
        time_s,
        verdict,
        healed,
        worst_um,
        left_um,
        recovery,
        home,
        slip,
        illegal,
        fault,
        ..,
    ] = cells
    else {
        return None;
    };
    let (verdict, _) = VERDICTS.get(optional(verdict)? as usize)?;
    Some(Outcome {
        flip_flop: optional(flip_flop)? as usize,
        time_s,
        healed_clocks: optional(healed).map(|clocks| clocks as u64),
        worst_um,
        left_um,
        recovery_s: optional(recovery),
        home_error: home as i64,
        ring_slip: slip as i64,
        ring_illegal_clocks: illegal as u64,
        fault_shown: 0.5 < fault,
        verdict: *verdict,
    })
}

/// One row a flip, with names.
pub(super) fn write_csv(faults: &Faults, file: &mut dyn Write) -> anyhow::Result<()> {
    let common = COLUMNS.len() - 2;
    writeln!(file, "{}", COLUMNS[..common].join(","))?;
    for flip in &faults.outcomes {
        let optional = |number: Option<String>| number.unwrap_or_default();
        writeln!(
            file,
            "{},{},{},{},{},{},{},{},{},{},{}",
            faults.name(flip),
            flip.time_s,
            word(flip.verdict),
            optional(flip.healed_clocks.map(|clocks| clocks.to_string())),
            flip.worst_um,
            flip.left_um,
            optional(flip.recovery_s.map(|seconds| seconds.to_string())),
            flip.home_error,
            flip.ring_slip,
            flip.ring_illegal_clocks,
            u8::from(flip.fault_shown),
        )?;
    }
    Ok(())
}
