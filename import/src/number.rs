//! Numbers as instruments write them.

use helixlock_traces::in_range;

/// How a cell reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reading {
    Number(f64),
    /// Nothing, or a word for it.
    Missing,
    /// Neither.
    Words,
}

/// Words for a missing value, in lower case; empty cells are missing anyway.
pub(crate) const MISSING: [&str; 14] =
    ["nan", "-nan", "na", "n/a", "n.a.", "#n/a", "null", "none", "-", "--", "---", "…", "无", "—"];

/// Overload and its sign, and not a number (SCPI-1999, volume 1, 7.2.1); some logs have 1e38 for the former.
const OVERLOADS: [f64; 3] = [9.9e37, 9.91e37, 1e38];
/// How near to one of them a number is that was kept with single precision.
const SINGLE: f64 = 1e-6;

/// Reads a cell with the decimal sign of the file.
pub(crate) fn read(cell: &str, decimal: char, missing: &[String]) -> Reading {
    let cell = cell.trim();
    if cell.is_empty() || missing.iter().any(|word| word.eq_ignore_ascii_case(cell)) {
        return Reading::Missing;
    }
    match number(cell, decimal) {
        Some(value) => Reading::Number(value),
        None if is_overload(cell, decimal) => Reading::Missing,
        None => Reading::Words,
    }
}

/// A finite number in range; `+`, a real minus sign, groups of three and a blank before the exponent are
/// taken, units and words are not.
pub(crate) fn number(cell: &str, decimal: char) -> Option<f64> {
    of_any_size(cell, decimal).filter(|value| in_range(*value))
}

/// True for what an instrument writes in place of a reading that it has not; no quantity is as large.
pub(crate) fn is_overload(cell: &str, decimal: char) -> bool {
    let is_near = |value: f64| {
        let mut known = OVERLOADS.iter();
        known.any(|overload| (value.abs() - overload).abs() < SINGLE * overload)
    };
    of_any_size(cell, decimal).is_some_and(is_near)
}

fn of_any_size(cell: &str, decimal: char) -> Option<f64> {
    let plain = |cell: &str| {
        let digits = cell.bytes().any(|byte| byte.is_ascii_digit());
        let allowed = |byte: u8| byte.is_ascii_digit() || b"+-.eE".contains(&byte);
        cell.parse::<f64>().ok().filter(|_| digits && cell.bytes().all(allowed))
    };
    if decimal == '.' {
        // Almost every cell of almost every file.
        if let Some(value) = plain(cell) {
            return Some(value);
        }
    }
    plain(&standard(cell, decimal)?)
}

/// The cell with `.` for the decimal sign and without groups.
fn standard(cell: &str, decimal: char) -> Option<String> {
    let cell = cell.trim().replace(['\u{2212}', '\u{2013}'], "-");
    let (whole, fraction) = match cell.find(decimal) {
        Some(at) => cell.split_at(at),
        None => match cell.find(['e', 'E']) {
            Some(at) => cell.split_at(at),
            None => (cell.as_str(), ""),
        },
    };
    let fraction = fraction.replacen(decimal, ".", 1);
    let whole = without_groups(whole, decimal)?;
    Some(whole + &fraction.replace(['D', 'd'], "e"))
}

/// `1 234`, `1'234` and, beside a decimal comma, `1.234` hold groups of three.
fn without_groups(whole: &str, decimal: char) -> Option<String> {
    let other = if decimal == ',' { '.' } else { ',' };
    let marks = ['\'', '\u{2019}', '\u{a0}', '\u{202f}', ' ', other];
    let Some(mark) = whole.chars().find(|c| marks.contains(c)) else {
        return Some(whole.to_owned());
    };
    let mut groups = whole.split(mark);
    let first = groups.next().unwrap_or_default().trim_start_matches(['+', '-']);
    let whole_group = |group: &str| group.len() == 3 && group.bytes().all(|b| b.is_ascii_digit());
    // Nobody groups the digits of a fraction: `0,125` is one.
    let leads = (1..=3).contains(&first.len()) && !first.starts_with('0');
    let fits = leads && groups.all(whole_group);
    fits.then(|| whole.replace(mark, ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_groups_and_exponents_are_read() {
        for (cell, decimal, value) in [
            ("1.5", '.', 1.5),
            ("-1,5", ',', -1.5),
            ("+0,5E-3", ',', 0.0005),
            ("1.234,5", ',', 1234.5),
            ("1'234.5", '.', 1234.5),
            ("1,234", '.', 1234.0),
            ("1\u{a0}234,5", ',', 1234.5),
            ("\u{2212}2", '.', -2.0),
            ("1.5D+02", '.', 150.0),
            (".5", '.', 0.5),
        ] {
            assert_eq!(number(cell, decimal), Some(value), "{cell}");
        }
    }

    #[test]
    fn words_units_and_infinities_are_none() {
        for cell in [
            "", "abc", "1.5 mm", "inf", "NaN", "1e999", "1e170", "1.2.3", "1,23,4", "--1", "e5",
            "0x1", "0,125", "-0,125", "00,125",
        ] {
            assert_eq!(number(cell, '.'), None, "{cell}");
        }
        assert_eq!(read("nan", '.', &["nan".into()]), Reading::Missing);
        assert_eq!(read("nan", '.', &[]), Reading::Words);
    }
}
