//! Decisions: given by a recipe, or found out and written down with their reason.

use crate::place::Place;
use crate::question::{Answer, Question};
use crate::recipe::{ColumnRule, Recipe, Value};

/// What is given, what was found out, and what is open.
#[derive(Debug)]
pub(crate) struct Decisions<'a> {
    file: &'a str,
    given: &'a Recipe,
    pub(crate) made: Recipe,
    pub(crate) questions: Vec<Question>,
    pub(crate) notes: Vec<String>,
    /// Names of the columns that the file has, where it has such.
    pub(crate) headers: Vec<String>,
    /// How the file begins.
    pub(crate) beginning: Vec<String>,
    /// Columns that are there and hold no numbers, each with what it holds.
    pub(crate) left_out: Vec<String>,
}

impl<'a> Decisions<'a> {
    pub(crate) fn new(file: &'a str, given: &'a Recipe) -> Self {
        let made = Recipe { columns: Vec::new(), ..given.clone() };
        let (questions, notes, headers, beginning, left_out) = Default::default();
        Self { file, given, made, questions, notes, headers, beginning, left_out }
    }

    /// The file's name, for messages.
    pub(crate) fn file(&self) -> &'a str {
        self.file
    }

    /// What a recipe says, or what was found out before.
    pub(crate) fn given(&self, section: &str, name: &str) -> Option<&Value> {
        self.made.get(section, name)
    }

    /// True where a recipe says it, and it was not found out.
    pub(crate) fn is_told(&self, section: &str, name: &str) -> bool {
        self.given.get(section, name).is_some()
    }

    /// The rule of the recipe for a column.
    pub(crate) fn given_column(&self, from: &str) -> Option<&'a ColumnRule> {
        self.given.column(from)
    }

    /// A word: the recipe's, or what `find` finds with its reason.
    pub(crate) fn text(
        &mut self,
        section: &str,
        name: &str,
        find: impl FnOnce() -> (String, String),
    ) -> String {
        if let Some(Value::Text(text)) = self.given(section, name) {
            return text.clone();
        }
        let (text, reason) = find();
        self.made.set(section, name, Value::Text(text.clone()), reason);
        text
    }

    /// A count.
    pub(crate) fn whole(
        &mut self,
        section: &str,
        name: &str,
        find: impl FnOnce() -> (usize, String),
    ) -> usize {
        if let Some(Value::Whole(whole)) = self.given(section, name) {
            return usize::try_from(*whole).unwrap_or(0);
        }
        let (whole, reason) = find();
        let value = Value::Whole(i64::try_from(whole).unwrap_or(i64::MAX));
        self.made.set(section, name, value, reason);
        whole
    }

    /// A quantity that only a person knows; asked for until a recipe has it.
    pub(crate) fn number(&mut self, section: &str, name: &str, text: &str, likely: &[&str]) -> f64 {
        if let Some(Value::Number(number)) = self.given(section, name) {
            return *number;
        }
        let answer = |word: &&str| Answer {
            label: (*word).to_owned(),
            recipe: format!("[{section}]\n{name} = {word}"),
        };
        self.question(text, likely.iter().map(answer).collect());
        likely.first().and_then(|word| word.parse().ok()).unwrap_or(1.0)
    }

    /// Words.
    pub(crate) fn list(
        &mut self,
        section: &str,
        name: &str,
        find: impl FnOnce() -> (Vec<String>, String),
    ) -> Vec<String> {
        if let Some(Value::List(words)) = self.given(section, name) {
            return words.clone();
        }
        let (words, reason) = find();
        self.made.set(section, name, Value::List(words.clone()), reason);
        words
    }

    /// A setting that is open, with the words that would settle it; the first is taken meanwhile.
    pub(crate) fn ask(&mut self, section: &str, name: &str, text: &str, words: &[(&str, &str)]) {
        let answers = words.iter().map(|(word, label)| Answer {
            label: (*label).to_owned(),
            recipe: format!("[{section}]\n{name} = {}", toml_edit::Value::from(*word)),
        });
        self.question(text, answers.collect());
    }

    /// Something open of the whole file, with the lines that would settle it.
    pub(crate) fn question(&mut self, text: &str, answers: Vec<Answer>) {
        self.question_at(&Place::file(self.file), text, answers);
    }

    /// Something open, and where it stands.
    pub(crate) fn question_at(&mut self, place: &Place, text: &str, answers: Vec<Answer>) {
        self.questions.push(Question { place: place.clone(), text: text.to_owned(), answers });
    }

    /// Says which columns a format holds that are no numbers, each with what it holds, and so are left out.
    pub(crate) fn pass_over(&mut self, columns: &[(String, String)]) {
        let Some((first, _)) = columns.first() else { return };
        let number = columns.len();
        self.note(format!("{number} columns that hold no numbers are left out, first `{first}`"));
        self.left_out.extend(columns.iter().map(|(name, what)| format!("`{name}` holds {what}")));
    }

    pub(crate) fn note(&mut self, note: impl Into<String>) {
        let note = note.into();
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }
}
