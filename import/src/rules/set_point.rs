//! Set points of temperatures: `he_target` beside `he_t` is no position.

use super::Candidate;
use crate::data;
use crate::header::{self, Header};

/// Ends of a name that say that it is a temperature.
const ENDS: [&str; 4] = ["t", "temp", "temperature", "temperatur"];

/// Takes the word for a position from a target that a temperature of the same name stands beside.
pub(super) fn of_temperatures(candidates: &mut [Candidate<'_>]) {
    let headers: Vec<&Header> = candidates.iter().map(|candidate| candidate.header).collect();
    for candidate in candidates.iter_mut().filter(|candidate| candidate.meaning() == "target") {
        let header = candidate.header;
        let stem = header::spaced(&header.bare).rsplit_once(' ').map(|(stem, _)| stem.to_owned());
        let Some(stem) = stem.filter(|_| header.unit.is_none()) else { continue };
        if headers.iter().any(|other| is_temperature(other, &stem)) {
            candidate.word = None;
        }
    }
}

/// True for `he_t`, `he temperature` and `he [°C]`, where the stem is `he`.
fn is_temperature(header: &Header, stem: &str) -> bool {
    let name = header::spaced(&header.bare);
    let unit = header.unit.as_deref();
    match name.strip_prefix(stem).map(str::trim) {
        Some("") => unit.is_some_and(|unit| data::unit(unit, "temperature").is_some()),
        Some(end) => ENDS.contains(&end),
        None => false,
    }
}
