//! Every text of the pages, English and Chinese: `pages/words.tsv`, a line a text.
//!
//! Texts of the libraries, such as the names of effects, stand there too, so that the reports of
//! the commands can say them in Chinese.

/// Key, English, Chinese.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Words {
    /// What the pages call it.
    pub key: &'static str,
    /// English.
    pub english: &'static str,
    /// Chinese.
    pub chinese: &'static str,
}

/// The whole table.
pub fn all() -> impl Iterator<Item = Words> {
    include_str!("../pages/words.tsv").lines().skip(1).map(|line| {
        let mut cells = line.split('\t');
        let mut next = || cells.next().unwrap_or_default();
        Words { key: next(), english: next(), chinese: next() }
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::pages::FILES;

    fn is_chinese(letter: char) -> bool {
        ('\u{3400}'..='\u{9fff}').contains(&letter)
    }

    #[test]
    fn every_text_has_both_languages() {
        let mut known = BTreeSet::new();
        for Words { key, english, chinese } in all() {
            assert!(known.insert(key), "{key} stands twice");
            assert!(!english.is_empty() && !english.chars().any(is_chinese), "{key}: {english}");
            let word = |text: &str| text.chars().any(char::is_alphabetic);
            assert!(!word(english) || chinese.chars().any(is_chinese), "{key}: {chinese}");
            let holes = |text: &str| -> BTreeSet<String> {
                let parts = text.split('{').skip(1).filter_map(|part| part.split_once('}'));
                parts.map(|(name, _)| name.to_owned()).collect()
            };
            assert_eq!(holes(english), holes(chinese), "{key}");
        }
    }

    /// Keys as scripts (`t("key"`) and the page (`data-word="key"`) use them.
    fn used() -> BTreeSet<&'static str> {
        let marks = ["t(\"", "data-word=\"", "data-label=\"", "data-hint=\""];
        let texts = FILES.iter().filter(|(name, _)| !name.starts_with("uplot"));
        let found = |text: &'static str, mark: &'static str| {
            text.split(mark).skip(1).filter_map(|rest| rest.split('"').next())
        };
        texts
            .flat_map(|(_, page)| marks.iter().flat_map(move |mark| found(page.text, mark)))
            .collect()
    }

    /// `split(".")` is no text.
    fn is_key(text: &str) -> bool {
        text.split_once('.').is_some_and(|(group, name)| !group.is_empty() && !name.is_empty())
    }

    #[test]
    fn every_key_that_is_used_is_there_and_none_is_idle() {
        let known: BTreeSet<&str> = all().map(|words| words.key).collect();
        let used: BTreeSet<&str> = used().into_iter().filter(|key| is_key(key)).collect();
        let missing: Vec<_> = used.difference(&known).collect();
        assert!(missing.is_empty(), "no text for {missing:?}");
        // Those of libraries are put together from what the libraries say.
        let of_libraries = [
            "effect.",
            "entry.",
            "verdict.",
            "axis.",
            "axis_label.",
            "doubt.",
            "sensor.",
            "template.",
            "said.",
            "unit.",
        ];
        let idle = known.difference(&used);
        let idle: Vec<_> =
            idle.filter(|key| !of_libraries.iter().any(|part| key.starts_with(part))).collect();
        assert!(idle.is_empty(), "nothing says {idle:?}");
    }

    #[test]
    fn the_page_itself_holds_no_text_of_its_own() {
        let (_, page) = FILES.iter().find(|(name, _)| *name == "index.html").unwrap();
        let body = page.text.split("<body>").nth(1).unwrap();
        let texts = body.split('>').skip(1).filter_map(|part| part.split('<').next());
        for text in
            texts.map(str::trim).filter(|text| !["", "helixlock", "English", "中文"].contains(text))
        {
            assert!(!text.chars().any(char::is_alphabetic), "{text}");
        }
    }
}
