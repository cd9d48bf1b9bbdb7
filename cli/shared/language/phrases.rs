//! What reports say in English and Chinese: `words.tsv`, a line a phrase, and beside it what the
//! workbench's table says of the libraries.
//!
//! A phrase may have holes. `{shape}` holds a phrase in its turn; `{NAME}` is passed on as it
//! stands; and so is `{N}`, whose single letter stands for a number or a word without blanks.
//! Of several phrases that fit, the one with the most letters of its own is taken. A hole before
//! other words of its phrase holds nothing with `; ` in it, which separates phrases.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use helixlock_workbench::words;
use regex::{Captures, Regex};

/// What separates phrases that stand side by side, and the same in Chinese.
const MARKS: [(&str, &str); 3] = [("; ", "；"), (", ", "，"), (": ", "：")];

static PHRASES: LazyLock<Phrases> = LazyLock::new(|| Phrases::new(table()));

/// A text in Chinese, as far as the table knows it.
pub(super) fn chinese(text: &str) -> String {
    if !text.contains(|letter: char| letter.is_ascii_alphabetic()) {
        return text.to_owned();
    }
    PHRASES.whole(text).or_else(|| sentence(text)).unwrap_or_else(|| in_pieces(text))
}

/// All of the table: English, Chinese.
fn table() -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = include_str!("words.tsv").lines().skip(1).filter_map(|line| line.split_once('\t'));
    let said = words::all().filter(|words| words.key.starts_with("said."));
    own.chain(said.map(|words| (words.english, words.chinese)))
}

/// The same with a capital and a full stop.
fn sentence(text: &str) -> Option<String> {
    let (head, tail) = text.split_at_checked(1)?;
    let (body, stop) = tail.strip_suffix('.').map_or((tail, ""), |body| (body, "。"));
    let found = PHRASES.whole(&[head, body].concat());
    let found = found.or_else(|| PHRASES.whole(&[&head.to_lowercase(), body].concat()));
    Some(found? + stop)
}

/// The parts of a text that marks separate: before one that the table knows, or each for itself.
fn in_pieces(text: &str) -> String {
    for (mark, chinese_mark) in MARKS {
        for (place, _) in text.match_indices(mark) {
            if let Some(rest) = PHRASES.whole(&text[place + mark.len()..]) {
                return [&chinese(&text[..place]), chinese_mark, &rest].concat();
            }
        }
    }
    for (mark, chinese_mark) in MARKS {
        let pieces: Vec<_> = text.split(mark).collect();
        if 1 < pieces.len() {
            let translated: Vec<_> = pieces.iter().map(|piece| chinese(piece)).collect();
            if translated != pieces {
                return translated.join(chinese_mark);
            }
        }
    }
    text.to_owned()
}

struct Phrases {
    /// Those without holes.
    plain: BTreeMap<&'static str, &'static str>,
    patterns: Vec<Pattern>,
}

struct Pattern {
    shape: Regex,
    chinese: &'static str,
}

impl Phrases {
    fn new(table: impl Iterator<Item = (&'static str, &'static str)>) -> Self {
        let (plain, mut with_holes): (Vec<_>, Vec<_>) =
            table.partition(|(english, _)| !english.contains('{'));
        with_holes.sort_by_key(|(english, _)| Reverse(own_letters(english)));
        let pattern = |(english, chinese)| Pattern { shape: shape(english), chinese };
        Self {
            plain: plain.into_iter().collect(),
            patterns: with_holes.into_iter().map(pattern).collect(),
        }
    }

    fn whole(&self, text: &str) -> Option<String> {
        if let Some(chinese) = self.plain.get(text) {
            return Some((*chinese).to_owned());
        }
        self.patterns
            .iter()
            .find_map(|pattern| Some(pattern.filled(&pattern.shape.captures(text)?)))
    }
}

impl Pattern {
    fn filled(&self, found: &Captures<'_>) -> String {
        let mut filled = String::new();
        for part in parts(self.chinese) {
            match part {
                Part::Text(text) => filled.push_str(text),
                Part::Hole(name) if is_kept(name) => filled.push_str(&found[name]),
                Part::Hole(name) => filled.push_str(chinese(&found[name]).trim_start_matches('>')),
            }
        }
        filled.replace("？。", "？") // a question has its own stop
    }
}

enum Part<'a> {
    Text(&'a str),
    Hole(&'a str),
}

/// Texts and holes in turn.
fn parts(phrase: &str) -> impl Iterator<Item = Part<'_>> {
    phrase
        .split('{')
        .enumerate()
        .flat_map(|(index, part)| match part.split_once('}') {
            Some((name, text)) if 0 < index => [Some(Part::Hole(name)), Some(Part::Text(text))],
            _ => [Some(Part::Text(part)), None],
        })
        .flatten()
}

fn own_letters(phrase: &str) -> usize {
    let letters = |part| if let Part::Text(text) = part { text.len() } else { 0 };
    parts(phrase).map(letters).sum()
}

fn is_kept(hole: &str) -> bool {
    hole.starts_with(char::is_uppercase)
}

fn shape(english: &str) -> Regex {
    let ends = english.trim_end_matches('.');
    let shape: String = parts(english)
        .map(|part| match part {
            Part::Text(text) => regex::escape(text),
            Part::Hole(name) if name.len() == 1 => format!(r"(?<{name}>\S+)"),
            Part::Hole(name) if is_kept(name) || ends.ends_with(&format!("{{{name}}}")) => {
                format!("(?<{name}>.+?)")
            }
            Part::Hole(name) => format!("(?<{name}>(?:[^;]|;[^ ])+?)"),
        })
        .collect();
    Regex::new(&format!("^{shape}$")).expect("a test makes a pattern of every phrase")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_phrase_has_the_same_holes_in_both_languages_and_stands_once() {
        let mut known = BTreeSet::new();
        for (english, chinese) in table() {
            assert!(known.insert(english), "twice: {english}");
            assert!(chinese.contains(|c| '\u{2e80}' < c), "{english}: {chinese}");
            let holes = |phrase| -> Vec<String> {
                let names = parts(phrase).filter_map(|part| match part {
                    Part::Hole(name) => Some(name.to_owned()),
                    Part::Text(_) => None,
                });
                let mut names: Vec<_> = names.collect();
                names.sort();
                names
            };
            assert_eq!(holes(english), holes(chinese), "{english}");
        }
    }

    /// A phrase that another one takes the place of would never be said.
    #[test]
    fn every_phrase_is_found_by_its_own_text() {
        for (english, text) in table() {
            let sample = |phrase: &str| -> String {
                let filled = parts(phrase).map(|part| match part {
                    Part::Text(text) => text.to_owned(),
                    Part::Hole(name) if name.len() == 1 => "7".to_owned(),
                    Part::Hole(_) => "Xyz".to_owned(),
                });
                filled.collect()
            };
            assert_eq!(chinese(&sample(english)), sample(text), "{english}");
        }
    }

    /// Words of two small letters and more, but in backticks.
    fn english(text: &str) -> Vec<String> {
        let quoted = Regex::new("`[^`]*`").unwrap().replace_all(text, "").into_owned();
        let word = Regex::new("[A-Za-z]*[a-z]{2,}[A-Za-z]*").unwrap();
        word.find_iter(&quoted).map(|word| word.as_str().to_owned()).collect()
    }

    #[test]
    fn every_note_of_every_board_is_known() {
        let names = ["Makefile", "openFPGALoader", "Debian", "Pmod", "us", "gn", "gp"];
        let mut unknown = Vec::new();
        for board in helixlock_gen::Board::all().unwrap() {
            let pins = board.pins.iter().map(|pin| &pin.note);
            for text in pins.chain(&board.notes).chain([&board.clock_source]) {
                let mut left = english(&chinese(text));
                left.retain(|word| !names.contains(&word.as_str()));
                unknown.extend(left.iter().map(|word| format!("{}: {text}: {word}", board.name)));
            }
        }
        assert!(unknown.is_empty(), "{unknown:#?}");
    }

    #[test]
    fn what_every_effect_does_is_known() {
        for card in helixlock_plant::CATALOGUE {
            assert_eq!(english(&chinese(card.summary)), Vec::<String>::new(), "{}", card.kind);
        }
    }

    #[test]
    fn what_import_says_of_a_place_in_a_table_is_known() {
        let told = include_str!("../../../import/tests/expected/broken.txt");
        let lines = told.lines().filter(|line| line.starts_with("german.csv:"));
        let found: Vec<_> = lines.filter(|line| line[11..].starts_with(char::is_numeric)).collect();
        assert!(15 < found.len(), "{found:?}");
        for line in found {
            let own = ["german", "csv", "UTF"];
            let mut left = english(&chinese(line));
            left.retain(|word| !own.contains(&word.as_str()));
            assert!(left.is_empty(), "{line}: {left:?}");
        }
    }

    /// A machine's owner calls its gears what they like.
    #[test]
    fn the_name_of_a_gear_stays_as_it_was_written() {
        assert_eq!(chinese("mesh of change gear 1"), "change gear 1 的啮合");
        assert_eq!(chinese("change gear 1"), "change gear 1");
        assert_eq!(
            chinese("or each way its own line along direction: evidence 7 behind"),
            "或沿方向的两个方向各有一条直线：证据落后 7"
        );
        assert_eq!(
            chinese("proposal: sawtooth along angle of `time`"),
            "建议公式：沿`time` 的转角的锯齿"
        );
    }

    #[test]
    fn holes_hold_phrases_names_and_numbers() {
        let left = "left: smooth curve along time at 3.5000, 0.5000 µm rms, p = 0.010";
        assert_eq!(
            chinese(left),
            "剩余：沿时间（在 3.5000 处）的平滑曲线，0.5000 µm 均方根，p = 0.010"
        );
        assert_eq!(chinese("unheard of, smooth curve"), "unheard of，平滑曲线");
        assert_eq!(chinese("Smooth curve."), "平滑曲线。");
        assert_eq!(chinese("report.html, trace.csv"), "report.html, trace.csv");
    }
}
