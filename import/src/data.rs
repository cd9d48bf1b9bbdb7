//! Words and units as data: what headers say in English, German and Chinese.

use std::sync::LazyLock;

use crate::number::number;

/// The meaning of a word for a quantity that no column of ours holds.
pub(crate) const OTHER: &str = "other";

/// A unit: `value · scale + offset` is the value in the base unit of its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    pub(crate) kind: &'static str,
    pub(crate) scale: f64,
    pub(crate) offset: f64,
}

/// What a word of a header means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    pub(crate) meaning: &'static str,
    pub(crate) reversed: bool,
    pub(crate) spelling: &'static str,
}

/// What a meaning becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) meaning: &'static str,
    pub(crate) column: &'static str,
    pub(crate) kind: &'static str,
    pub(crate) unit: &'static str,
}

static UNITS: LazyLock<Vec<(&'static str, Unit)>> = LazyLock::new(|| {
    let number = |cell: &str| cell.parse().expect("a test reads every line");
    let mut units = Vec::new();
    for [kind, scale, offset, spellings] in rows(include_str!("../data/units.csv")) {
        let unit = Unit { kind, scale: number(scale), offset: number(offset) };
        units.extend(spellings.split('|').map(|spelling| (spelling, unit)));
    }
    units
});

static WORDS: LazyLock<Vec<Word>> = LazyLock::new(|| {
    let mut words = Vec::new();
    for [meaning, sign, list] in rows(include_str!("../data/words.csv")) {
        let reversed = sign == "-1";
        words.extend(list.split('|').map(|word| Word { meaning, reversed, spelling: word }));
    }
    words
});

static TARGETS: LazyLock<Vec<Target>> = LazyLock::new(|| {
    rows(include_str!("../data/columns.csv"))
        .map(|[meaning, column, kind, unit]| Target { meaning, column, kind, unit })
        .collect()
});

/// The unit that a recipe names, which may have a factor: `0.1 mm`, `1/4096 rev` for the counts of an encoder.
pub(crate) fn unit_with_factor(spelling: &str, kind: &str) -> Option<Unit> {
    if let Some(unit) = unit(spelling, kind) {
        return Some(unit);
    }
    let (factor, rest) = spelling.trim().split_once(' ')?;
    let (above, below) = factor.split_once('/').unwrap_or((factor, "1"));
    let factor = number(above, '.')? / number(below, '.')?;
    let unit = unit(rest, kind).filter(|_| factor.is_finite() && 0.0 < factor)?;
    Some(Unit { scale: factor * unit.scale, ..unit })
}

/// True for a kind of unit that a column of ours may have; a current has none.
pub(crate) fn is_ours(kind: &str) -> bool {
    targets().iter().any(|target| target.kind == kind)
}

/// The unit of a spelling, among those of a kind; of any kind when `kind` is empty.
pub(crate) fn unit(spelling: &str, kind: &str) -> Option<Unit> {
    let lower = spelling.trim().to_lowercase();
    let fits = |unit: &Unit| kind.is_empty() || unit.kind == kind;
    UNITS.iter().find(|(known, unit)| *known == lower && fits(unit)).map(|(_, unit)| *unit)
}

/// True for a spelling of an angle that is two units: a grad is a degree in German, and elsewhere a gon.
pub(crate) fn is_doubtful(spelling: &str) -> bool {
    spelling.trim().eq_ignore_ascii_case("grad")
}

/// Every word there is.
pub(crate) fn words() -> &'static [Word] {
    &WORDS
}

/// What a meaning becomes, or a column of ours by its own name.
pub(crate) fn target(meaning_or_column: &str) -> Option<Target> {
    TARGETS
        .iter()
        .find(|target| target.meaning == meaning_or_column || target.column == meaning_or_column)
        .copied()
}

/// Columns of ours.
pub(crate) fn targets() -> &'static [Target] {
    &TARGETS
}

/// Rows of an embedded table, comments and header left out.
fn rows<const CELLS: usize>(text: &'static str) -> impl Iterator<Item = [&'static str; CELLS]> {
    text.lines().filter(|line| !line.starts_with('#')).skip(1).map(|line| {
        let mut cells = line.splitn(CELLS, ',');
        std::array::from_fn(|_| cells.next().unwrap_or_default().trim())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_of_the_tables_is_whole() {
        assert!(UNITS.len() > 200 && WORDS.len() > 200 && TARGETS.len() > 15);
        for target in targets() {
            assert!(target.kind.is_empty() || unit(target.unit, target.kind).is_some());
        }
        for word in words() {
            let ours = ["date", "clock", "number", OTHER].contains(&word.meaning);
            assert!(ours || target(word.meaning).is_some(), "{word:?}");
            assert_eq!(word.spelling, word.spelling.to_lowercase());
        }
    }

    /// 451 °F are 232.78 °C, 760 mmHg are 1013.25 hPa, a degree is 3600 arcsec.
    #[test]
    fn units_follow_their_definitions() {
        let base = |value: f64, spelling, kind| {
            let unit = unit(spelling, kind).expect(spelling);
            value * unit.scale + unit.offset
        };
        assert!((base(451.0, "°F", "temperature") - 232.777_777_8).abs() < 1e-6);
        assert!((base(760.0, "mmHg", "pressure") - 1013.25).abs() < 1e-3);
        assert!((base(1.0, "°", "angle") - 3600.0).abs() < 1e-12);
        assert!((base(1.0, "\"", "angle") - 1.0).abs() < 1e-12);
        assert!((base(1.0, "inch", "length") - 25_400.0).abs() < 1e-9);
    }

    #[test]
    fn a_unit_of_a_recipe_may_have_a_factor() {
        let scale = |spelling, kind| unit_with_factor(spelling, kind).map(|unit| unit.scale);
        assert_eq!(scale("0.5 mm", "length"), Some(500.0));
        assert_eq!(scale("1/4096 rev", "angle"), Some(1_296_000.0 / 4096.0));
        assert_eq!(scale("mm", "length"), Some(1000.0));
        for wrong in ["0 mm", "-1 mm", "1/0 mm", "x mm", "2", "1/4096rev"] {
            assert_eq!(scale(wrong, "length"), None, "{wrong}");
        }
    }
}
