//! What happened that the data sheets do not allow, and what gates swallowed.

use std::collections::BTreeMap;

use crate::circuit::Circuit;

/// A kind of finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Check {
    /// A clock was high for too short a time.
    ClockHigh,
    /// A clock was low for too short a time.
    ClockLow,
    /// A preset or clear was too short.
    PresetClear,
    /// J or K changed while the clock was high; the width is how long it had been.
    Data,
    /// A pulse was shorter than a gate's delay and did not get through.
    Swallowed,
}

/// All of one kind at one part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The part's name.
    pub element: String,
    /// What was found.
    pub check: Check,
    /// How often.
    pub count: u64,
    /// Shortest width, ps; the longest of what was swallowed.
    pub width_ps: u64,
    /// When first, ps.
    pub first_ps: u64,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Findings(BTreeMap<(u32, Check), (u64, u64, u64)>);

impl Findings {
    pub(super) fn note(&mut self, element: u32, check: Check, width_ps: u64, now_ps: u64) {
        let (count, width, _) = self.0.entry((element, check)).or_insert((0, width_ps, now_ps));
        *count += 1;
        *width = match check {
            Check::Swallowed => width_ps.max(*width),
            _ => width_ps.min(*width),
        };
    }

    pub(super) fn list(&self, circuit: &Circuit) -> Vec<Finding> {
        let named = self.0.iter().map(|((element, check), (count, width_ps, first_ps))| Finding {
            element: circuit.elements[*element as usize].name.clone(),
            check: *check,
            count: *count,
            width_ps: *width_ps,
            first_ps: *first_ps,
        });
        named.collect()
    }
}
