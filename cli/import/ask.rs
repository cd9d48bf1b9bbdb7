//! A question on a terminal.

use std::io::{BufRead, Write};

use anyhow::bail;
use helixlock_import::{Answer, Question};

/// Shows the answers there are and reads the number of one.
pub(crate) fn ask<'a>(
    question: &'a Question,
    input: &mut impl BufRead,
    out: &mut impl Write,
) -> anyhow::Result<&'a Answer> {
    writeln!(out, "{}: {}", question.place, question.text)?;
    for (index, answer) in question.answers.iter().enumerate() {
        writeln!(out, "  {}  {}", index + 1, answer.label)?;
    }
    loop {
        write!(out, "which one [1 to {}]? ", question.answers.len())?;
        out.flush()?;
        let mut line = String::new();
        if input.read_line(&mut line)? == 0 {
            bail!("{}: found the end of input, expected an answer", question.place);
        }
        let chosen = line.trim().parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        if let Some(answer) = chosen.and_then(|index| question.answers.get(index)) {
            return Ok(answer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_an_answer_is_asked_for_until_there_is_one() {
        let answer = |label: &str| Answer { label: label.into(), recipe: String::new() };
        let question = Question {
            place: helixlock_import::Place::file("a.csv"),
            text: "which unit".into(),
            answers: vec![answer("um"), answer("mm")],
        };
        let mut shown = Vec::new();
        let chosen = ask(&question, &mut "x\n3\n2\n".as_bytes(), &mut shown).unwrap();
        assert_eq!(chosen.label, "mm");
        assert_eq!(String::from_utf8(shown).unwrap().matches("which one").count(), 3);
        assert!(ask(&question, &mut "".as_bytes(), &mut Vec::new()).is_err());
    }
}
