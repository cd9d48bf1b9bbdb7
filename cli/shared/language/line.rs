//! A line of a report: its cells in Chinese, its columns where they were.
//!
//! A Chinese character is as wide as two letters. A cell begins where its English began; one whose
//! Chinese begins with `>` ends where its English ended, as headers above numbers do. In a frame
//! the first cell of a row is a name, and stays, but for those that the table has as `|block`.

use unicode_width::UnicodeWidthStr;

use super::phrases::chinese;

/// Marks between the cells of a table in a frame.
const FRAME: [char; 3] = ['│', '┆', '|'];
/// Place of the first cell behind the mark that begins the line.
const FIRST: usize = 1;
/// Fewest blanks between two cells without a frame.
const GAP: &str = "  ";
/// Begins the Chinese of a cell that ends where its English ended.
const FLUSH_RIGHT: char = '>';

/// The line in Chinese, as far as the table of phrases knows it.
pub(super) fn translated(line: &str) -> String {
    if line.starts_with(FRAME) { framed(line) } else { in_columns(line) }
}

/// Cells between the marks of a frame keep their width.
fn framed(line: &str) -> String {
    let mut shown = String::new();
    for (place, part) in line.split_inclusive(FRAME).enumerate() {
        let mark = part.strip_suffix(FRAME).map_or("", |cell| &part[cell.len()..]);
        let cell = &part[..part.len() - mark.len()];
        let text = if place == FIRST { first(cell.trim()) } else { said(cell.trim()) };
        let blanks = cell.width().saturating_sub(text.width());
        let before = cell.width() - cell.trim_start().width();
        let is_right = 1 < before && cell.ends_with(' ') && !cell.ends_with(GAP);
        let before = if is_right { blanks.saturating_sub(1) } else { before.min(blanks) };
        shown.push_str(&" ".repeat(before));
        shown.push_str(&text);
        shown.push_str(&" ".repeat(blanks - before));
        shown.push_str(mark);
    }
    shown
}

/// Cells with blanks between them keep the places where they begin, or are pushed on.
fn in_columns(line: &str) -> String {
    let (mut shown, mut column) = (String::new(), 0);
    for cell in line.split(GAP).map(|cell| (cell, cell.width())) {
        let (blanks, text) = (cell.0.len() - cell.0.trim_start().len(), cell.0.trim_start());
        if !text.is_empty() {
            put(&mut shown, column + blanks, text);
        }
        column += cell.1 + GAP.len();
    }
    shown
}

/// Puts a cell that begins at a column of the English line.
fn put(shown: &mut String, column: usize, english: &str) {
    let chinese = chinese(english);
    let text = chinese.trim_start_matches(FLUSH_RIGHT);
    let is_right = text.len() < chinese.len();
    let begin =
        if is_right { (column + english.width()).saturating_sub(text.width()) } else { column };
    let gap = if shown.is_empty() { 0 } else { GAP.len() };
    let blanks = begin.saturating_sub(shown.width()).max(gap);
    shown.push_str(&" ".repeat(blanks));
    shown.push_str(text);
}

fn first(cell: &str) -> String {
    let chinese = chinese(&format!("|{cell}"));
    chinese.trim_start_matches('|').to_owned()
}

/// A cell in Chinese that needs no place.
pub(super) fn said(cell: &str) -> String {
    chinese(cell).trim_start_matches(FLUSH_RIGHT).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_stay_where_they_were() {
        let lines = [
            "  time                     smooth curve                 12.1401 µm rms",
            "  machine screw angle      straight relation             0.0271 µm rms",
        ];
        let shown = lines.map(translated);
        let at = |line: &str| line[..line.find("µm").unwrap()].width();
        assert_eq!(at(&shown[0]), at(&shown[1]));
        assert!(shown[0].starts_with("  时间                     平滑曲线  "), "{}", shown[0]);
    }

    #[test]
    fn headers_end_above_their_numbers() {
        let head = translated("peak to peak, um          without correction   with");
        let row = translated("lead error in all                       0.00   0.33");
        assert_eq!([head.width(), row.width()], [51, 51]);
    }

    #[test]
    fn frames_stay_closed() {
        for line in [
            "│ effect         ┆ entry            ┆ what happens  │",
            "| flips | unseen | slowest, s |",
            "|     8 |      8 |       0.00 |",
        ] {
            let shown = translated(line);
            assert_eq!(shown.width(), line.width(), "{shown}");
        }
    }
}
