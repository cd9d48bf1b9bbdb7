//! Slips of the pen in what a recipe calls a column.

use super::{NONE, by_column};
use crate::data;
use crate::error::ImportError;
use crate::header;
use crate::recipe::Recipe;

/// Refuses a name for a column that is none of ours and hardly meant as a new one: what a slip of the pen says
/// would be lost without a word.
pub(crate) fn check_names(given: &Recipe) -> Result<(), ImportError> {
    for rule in &given.columns {
        let Some(to) = rule.to.as_deref().filter(|to| is_slip(to, &rule.from)) else {
            continue;
        };
        let found = format!("`to = {}`", toml_edit::Value::from(to));
        let mut ours: Vec<&str> = data::targets().iter().map(|target| target.column).collect();
        ours.dedup();
        let expected = format!("one of `{}`, or a name of your own", ours.join("`, `"));
        let error = ImportError::found(rule.place.clone(), found, expected);
        return Err(error.hinted("`to = \"none\"` leaves a column out"));
    }
    Ok(())
}

/// True for a name that no column has and nobody would give one: a word for leaving it out, one of ours
/// without its unit, or one that is misspelt.
fn is_slip(to: &str, from: &str) -> bool {
    const WORDS: [&str; 9] =
        ["", "ignore", "ignored", "skip", "drop", "omit", "exclude", "no", "null"];
    let known = |column: &str| by_column(column).is_some() || column == NONE;
    let without_unit = |column: &str| column.rsplit_once('_').is_some_and(|(bare, _)| bare == to);
    let mut ours = data::targets().iter().map(|target| target.column);
    let is_own = to == header::plain_name(&header::read_name(from));
    !known(to)
        && !is_own
        && (WORDS.contains(&to.to_lowercase().as_str())
            || ours.any(|column| without_unit(column) || nearly(to, column)))
}

/// True where one letter before the unit is another, missing, or too many.
fn nearly(one: &str, other: &str) -> bool {
    const SHORTEST: usize = 5;
    let unit = |name: &str| name.rsplit_once('_').map(|(_, unit)| unit.to_owned());
    if other.len() < SHORTEST || unit(one) != unit(other) {
        return false;
    }
    let same = one.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
    let [one, other]: [Vec<char>; 2] = [one, other].map(|word| word.chars().skip(same).collect());
    let rest = |word: &[char]| word.get(1..).unwrap_or_default().to_vec();
    rest(&one) == rest(&other) || rest(&one) == other || one == rest(&other)
}
