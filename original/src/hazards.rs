//! Where the original's gates can go wrong, and by how much they miss it.
//!
//! Each hazard is a question to the simulation with one number turned until the answer changes; the
//! number is found to 0.1 ns.

mod waves;
mod ways;

use crate::circuit::Circuit;
use crate::delays::{Corner, Delays};
use crate::error::Error;
use crate::figures::discriminator::ClockInputs;

pub use self::waves::{Wave, Waves};

/// One of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hazard {
    /// Figure of the print.
    pub figure: &'static str,
    /// What happens.
    pub what: &'static str,
    /// The number that is turned.
    pub turned: &'static str,
    /// Where it begins, ps; `None` when it does not within what was tried.
    pub begins_ps: Option<u64>,
    /// The least or the most that the number is in a device, ps.
    pub given_ps: u64,
    /// It begins above the number, and not below.
    pub above: bool,
    /// What keeps it away.
    pub kept_away_by: &'static str,
    /// What happens there, at the number where it begins.
    pub waves: Waves,
}

impl Hazard {
    /// It cannot happen in a device of parts that keep their data sheets.
    #[must_use]
    pub fn is_kept_away(&self) -> bool {
        self.begins_ps.is_none_or(|begins_ps| {
            if self.above { self.given_ps < begins_ps } else { begins_ps <= self.given_ps }
        })
    }
}

/// All hazards that are looked for.
///
/// # Errors
///
/// [`Error`] when a figure cannot be run, which is a mistake in it.
pub fn hazards() -> Result<Vec<Hazard>, Error> {
    Ok(vec![
        ways::slow_nand3(ClockInputs::Coupled)?,
        ways::slow_nand3(ClockInputs::OfClockLength)?,
        ways::slow_nand3(ClockInputs::Missing)?,
        ways::short_clear()?,
        ways::cut_line()?,
        ways::late_direction()?,
        ways::lost_pulse()?,
        ways::added_pulse_too_close()?,
        ways::added_pulse_lost()?,
    ])
}

/// The least number, to 100 ps, from which on `goes_wrong`; it does not before.
fn begins(
    mut right_ps: u64,
    mut wrong_ps: u64,
    goes_wrong: &mut dyn FnMut(u64) -> Result<bool, Error>,
) -> Result<Option<u64>, Error> {
    if !goes_wrong(wrong_ps)? {
        return Ok(None);
    }
    while 100 < right_ps.abs_diff(wrong_ps) {
        let middle_ps = right_ps.midpoint(wrong_ps);
        if goes_wrong(middle_ps)? {
            wrong_ps = middle_ps;
        } else {
            right_ps = middle_ps;
        }
    }
    Ok(Some(wrong_ps))
}

fn typical(circuit: &Circuit) -> Delays {
    Delays::corner(circuit, Corner::Typical)
}
