//! Lines of a text and places in it.

use crate::place::Place;

/// Line and column of a byte of a text.
pub(crate) fn place(file: &str, text: &str, byte: usize) -> Place {
    let before = text.get(..byte).unwrap_or(text);
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let mut place = Place::line(file, 1 + before.matches('\n').count());
    place.at.column = Some(1 + before[start..].chars().count());
    place
}

/// Lines without their ends; CR, LF and CRLF end a line.
pub(crate) fn lines(text: &str) -> Vec<&str> {
    if text.contains('\n') || !text.contains('\r') {
        return text.lines().collect();
    }
    text.strip_suffix('\r').unwrap_or(text).split('\r').collect()
}
