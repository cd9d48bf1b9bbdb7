//! Which numbers a file may hold, and their text that reads back to the same bits.

use std::io::{self, Write};

/// No length, angle or time of any unit is larger; fourth powers of such numbers stay finite.
pub const LARGEST: f64 = 1e30;

/// True for what a table may hold.
#[must_use]
pub fn in_range(value: f64) -> bool {
    value.abs() <= LARGEST
}

/// Writes the shortest text that reads back to `value`, with an exponent where digits would be many.
pub(crate) fn write_number(out: &mut impl Write, value: f64) -> io::Result<()> {
    let size = value.abs();
    if value == 0.0 || (1e-5..1e16).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}
