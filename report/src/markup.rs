//! Text inside HTML and SVG.

/// The text with everything replaced that would be read as markup.
///
/// Control characters, which XML cannot hold, become blanks.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push('\n'),
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}

/// SVG with every text in it said anew; `say` gets a text without blanks around it.
#[must_use]
pub fn translated(svg: &str, say: impl Fn(&str) -> String) -> String {
    let mut translated = String::with_capacity(svg.len());
    for part in svg.split_inclusive('>') {
        let (text, tag) = part.split_at(part.find('<').unwrap_or(part.len()));
        let words = text.trim();
        match text.split_once(words).filter(|_| !words.is_empty()) {
            Some((before, after)) => {
                translated.extend([before, &escaped(&say(&unescaped(words))), after]);
            }
            None => translated.push_str(text),
        }
        translated.push_str(tag);
    }
    translated
}

fn unescaped(text: &str) -> String {
    let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    marks.iter().fold(text.to_owned(), |text, (written, mark)| text.replace(written, mark))
}

/// The text without control characters, for a library that escapes the rest itself.
pub(crate) fn printable(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::{escaped, translated};

    #[test]
    fn markup_and_control_characters_do_not_pass() {
        assert_eq!(escaped("a<b> & \"c\"\u{1}\u{9}µ"), "a&lt;b&gt; &amp; &quot;c&quot;  µ");
    }

    #[test]
    fn texts_are_said_anew_and_markup_stays() {
        let svg = "<g title=\"a\"><text>\na &lt; b\n</text>\n<a/></g>\n";
        assert_eq!(
            translated(svg, |text| text.replace("a <", "甲 & <")),
            "<g title=\"a\"><text>\n甲 &amp; &lt; b\n</text>\n<a/></g>\n"
        );
        assert_eq!(translated(svg, str::to_owned), svg);
    }
}
