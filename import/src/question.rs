//! What a file leaves open, and the lines of a recipe that settle it.

use std::fmt;

use crate::place::Place;

/// One way to settle a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// For people.
    pub label: String,
    /// The lines of a recipe that say so.
    pub recipe: String,
}

/// Something that can be read in more than one way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// The file it is about, and where in it.
    pub place: Place,
    /// What is open, and why.
    pub text: String,
    /// The ways to settle it, the likelier first; never empty.
    pub answers: Vec<Answer>,
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.place, self.text)?;
        write!(f, "\nhint: answer in a recipe (`--recipe`), with one of")?;
        for answer in &self.answers {
            write!(f, "\n  {}:", answer.label)?;
            for line in answer.recipe.lines() {
                write!(f, "\n      {line}")?;
            }
        }
        Ok(())
    }
}
