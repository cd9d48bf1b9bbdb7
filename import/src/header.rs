//! Names and units of columns, from the rows above the data.

use crate::data::{self, Word};
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::place::Place;
use crate::runs::{self, Run};

/// Words that stand before a unit.
const UNIT: [&str; 4] = ["unit", "units", "einheit", "单位"];

/// What the header says of a column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Header {
    /// As in the file; what a recipe calls it.
    pub(crate) name: String,
    /// Without its unit.
    pub(crate) bare: String,
    /// As the file spells it.
    pub(crate) unit: Option<String>,
    /// The run it names, if it does.
    pub(crate) run: Option<Run>,
    /// Where its name stands, or its first value.
    pub(crate) place: Place,
}

/// Headers of so many columns, each with a name of its own, from the rows above the first one of data.
pub(crate) fn headers(
    grid: &Grid,
    rows: &[usize],
    data: Option<usize>,
    width: usize,
) -> Result<Vec<Header>, ImportError> {
    let (units, names): (Vec<usize>, Vec<usize>) =
        rows.iter().partition(|row| rows.len() > 1 && is_units(grid, **row));
    let mut headers: Vec<Header> = Vec::new();
    let top = names.last().copied().or(data).unwrap_or(0);
    for column in 0..width {
        let (name, below) = name_of(grid, &names, column);
        let units = units.iter().map(|row| stripped(grid.cell(*row, column)));
        let mut header = read_name(&name);
        header.unit = units.chain(below).rfind(is_told).map(ToOwned::to_owned).or(header.unit);
        if header.name.is_empty() {
            header.name = format!("column {}", column + 1);
        }
        let same = |name: &str| headers.iter().any(|known| known.name == name);
        if same(&header.name) {
            if data::target(&header.name).is_some_and(|target| target.column == header.name) {
                let place = grid.place(names.first().copied().unwrap_or(0), Some(column));
                let found = format!("the column {} again", quoted(&header.name));
                return Err(ImportError::found(place, found, "every name once"));
            }
            header.name = format!("{} ({})", header.name, column + 1);
        }
        header.place = grid.place(top, Some(column));
        headers.push(header);
    }
    Ok(headers)
}

/// The name of a column through all rows of names, and the unit that stands below it among other names.
fn name_of<'a>(grid: &'a Grid, rows: &[usize], column: usize) -> (String, Option<&'a str>) {
    let (mut name, mut unit) = (String::new(), None);
    for row in rows {
        let cell = spanned(grid, *row, column, rows.len() > 1 && Some(row) != rows.last());
        if is_unit_of(&name, cell) {
            unit = Some(stripped(cell));
        } else if !cell.is_empty() && !name.ends_with(cell) {
            name = format!("{name} {cell}");
        }
    }
    (name.trim().to_owned(), unit)
}

/// True for `ms` below `Time`: a unit of what the name says.
pub(crate) fn is_unit_of(name: &str, cell: &str) -> bool {
    let word = meaning(&read_name(name.trim()).bare);
    let kind = word.and_then(|word| data::target(word.meaning)).map_or("", |target| target.kind);
    !kind.is_empty() && data::unit(stripped(cell), kind).is_some()
}

/// True for a cell of a row of units that tells one.
fn is_told(cell: &&str) -> bool {
    let marked = 1 < cell.len() || cell.chars().any(char::is_alphanumeric);
    !is_word_for_unit(cell) && (marked || ["%", "\""].contains(cell))
}

/// A cell of a header; one that spans several columns counts for all of them.
fn spanned(grid: &Grid, row: usize, column: usize, spans: bool) -> &str {
    let cell = grid.cell(row, column);
    if !cell.is_empty() || !spans {
        return cell;
    }
    let left = (0..column).rev().map(|left| grid.cell(row, left));
    let nearest = left.into_iter().find(|cell| !cell.is_empty()).unwrap_or_default();
    if runs::run_of(nearest).is_some() { nearest } else { "" }
}

/// True for a row of units, which may have their word before them.
pub(crate) fn is_units(grid: &Grid, row: usize) -> bool {
    let mut cells = grid.cells_of(row).filter(|cell| !cell.is_empty() && !is_word_for_unit(cell));
    cells.next().is_some_and(is_unit) && cells.all(is_unit)
}

fn is_unit(cell: &str) -> bool {
    cell == "-" || data::unit(stripped(cell), "").is_some()
}

fn is_word_for_unit(cell: &str) -> bool {
    UNIT.iter().any(|word| word.eq_ignore_ascii_case(cell))
}

fn stripped(cell: &str) -> &str {
    cell.trim().trim_start_matches(['[', '(']).trim_end_matches([']', ')']).trim()
}

/// A name taken apart: `Fehler [µm]`, `error (um)`, `Weg / mm`, `Weg, mm`, `error_um`, `误差（μm）`.
pub(crate) fn read_name(name: &str) -> Header {
    let plain = name.replace('（', "(").replace('）', ")").replace('【', "[").replace('】', "]");
    let cut = |open: char, close: char| {
        let start = plain.rfind(open)?;
        let end = plain[start..].find(close)? + start;
        let unit = plain[start + open.len_utf8()..end].trim();
        data::unit(unit, "")?;
        Some((format!("{}{}", &plain[..start], &plain[end + close.len_utf8()..]), unit.to_owned()))
    };
    let split = |mark: &str| {
        let (bare, unit) = plain.rsplit_once(mark)?;
        // `phase_a` is in no ampere: what is not ours stands in brackets.
        let ours = data::unit(unit, "").filter(|unit| data::is_ours(unit.kind));
        ours.filter(|_| !bare.trim().is_empty())?;
        Some((bare.to_owned(), unit.trim().to_owned()))
    };
    let found = cut('[', ']')
        .or_else(|| cut('(', ')'))
        .or_else(|| cut('<', '>'))
        .or_else(|| split("/"))
        .or_else(|| split(","))
        .or_else(|| split(" in "))
        .or_else(|| split("_"))
        .or_else(|| split(" ").filter(|(_, unit)| 1 < unit.chars().count()));
    let (bare, unit) = match found {
        Some((bare, unit)) => (bare, Some(unit)),
        None => (plain.clone(), None),
    };
    let bare = bare.trim().trim_end_matches([':', '：', ',']).trim().to_owned();
    let place = Place::default();
    Header { name: name.to_owned(), run: runs::run_of(&bare), bare, unit, place }
}

/// What a name means: the longest known word in it; `Error Position` is an error, whatever is longer, and
/// `Target Velocity` is no position.
pub(crate) fn meaning(bare: &str) -> Option<Word> {
    let plain = spaced(bare);
    let whole = data::words().iter().find(|word| word.spelling == plain);
    whole
        .or_else(|| {
            let within = data::words().iter().filter(|word| contains(&plain, word.spelling));
            let is_error = |word: &Word| word.meaning.ends_with("error");
            let is_another = |word: &Word| {
                let meaning = word.meaning;
                [data::OTHER, "speed"].contains(&meaning) || meaning.ends_with("temperature")
            };
            let length = |word: &Word| word.spelling.chars().count();
            within.max_by_key(|word| (is_error(word), is_another(word), length(word)))
        })
        .filter(|word| word.meaning != data::OTHER)
        .copied()
}

/// Lower case, with blanks for everything that parts words.
pub(crate) fn spaced(text: &str) -> String {
    let mut parted = String::with_capacity(text.len());
    let mut before = ' ';
    for c in text.chars() {
        if before.is_lowercase() && c.is_uppercase() {
            parted.push(' '); // `ActPos`
        }
        parted.push(c);
        before = c;
    }
    let plain: String = parted
        .to_lowercase()
        .chars()
        .map(|c| if c.is_alphanumeric() || c == '#' || c == '/' { c } else { ' ' })
        .collect();
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// True for a word that stands in a text by itself; Chinese and German compounds need no blanks.
fn contains(text: &str, word: &str) -> bool {
    if !word.is_ascii() {
        return text.contains(word);
    }
    if word.len() < 3 {
        return false;
    }
    text.match_indices(word).any(|(at, _)| {
        let before = text[..at].chars().next_back();
        let after = text[at + word.len()..].chars().next();
        let parts = |c: Option<char>| c.is_none_or(|c| !c.is_alphabetic() || !c.is_ascii());
        parts(before) && parts(after)
    })
}

/// A name of ours for a column that nobody knows: letters and digits, the unit at its end.
pub(crate) fn plain_name(header: &Header) -> String {
    let text = match &header.unit {
        Some(unit) => format!("{} {}", header.bare, unit_word(unit)),
        None => header.bare.clone(),
    };
    let text = if text.trim().is_empty() { header.name.clone() } else { text };
    let plain = spaced(&text.replace(['/', '#'], " ")).replace(' ', "_");
    if plain.is_empty() { "column".into() } else { plain }
}

fn unit_word(unit: &str) -> String {
    unit.replace(['µ', 'μ'], "u").replace("°", "deg ").replace('%', "pct").replace('"', "arcsec")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_units_are_taken_apart() {
        for (name, bare, unit) in [
            ("Fehler [µm]", "Fehler", Some("µm")),
            ("位置（mm）", "位置", Some("mm")),
            ("Weg / mm", "Weg", Some("mm")),
            ("Position, inch", "Position", Some("inch")),
            ("error_um", "error", Some("um")),
            ("pos (1)", "pos (1)", None),
            ("Time in s", "Time", Some("s")),
            ("x(i,1) [mm]", "x(i,1)", Some("mm")),
            ("Measured Current [Amps]", "Measured Current", Some("Amps")),
            ("phase_a", "phase_a", None),
        ] {
            let found = read_name(name);
            assert_eq!((found.bare.as_str(), found.unit.as_deref()), (bare, unit), "{name}");
        }
    }

    #[test]
    fn meanings_are_known_in_three_languages() {
        for (bare, expected) in [
            ("Sollposition", "target"),
            ("实际位置", "actual"),
            ("Lufttemperatur 1", "air temperature"),
            ("Axis-PosSet", "target"),
            ("Positioning Error", "error"),
            ("Error Position", "error"),
            ("定位误差", "error"),
            ("偏差", "error"),
            ("target pos", "target"),
            ("时间", "time"),
            ("Goal Position", "target"),
            ("Present Position", "actual"),
            ("bed temperature target", "bed temperature"),
        ] {
            assert_eq!(meaning(bare).map(|word| word.meaning), Some(expected), "{bare}");
        }
        for bare in ["voltage", "status", "Rotation-VelLastSector", "target velocity", "Temp Act"]
            .into_iter()
            .chain(["bed_target", "heater_bed.target", "extruder_target", "Nozzle Target"])
        {
            assert!(meaning(bare).is_none(), "{bare}");
        }
    }
}
