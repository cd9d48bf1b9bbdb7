//! Numbers as text that reads back to the same bits.

use std::io::{self, Write};

/// Writes the shortest text that reads back to `value`, with an exponent where digits would be many.
pub(crate) fn write_number(out: &mut impl Write, value: f64) -> io::Result<()> {
    let size = value.abs();
    if value == 0.0 || (1e-5..1e16).contains(&size) {
        write!(out, "{value}")
    } else {
        write!(out, "{value:e}")
    }
}
