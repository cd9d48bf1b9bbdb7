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

/// The text without control characters, for a library that escapes the rest itself.
pub(crate) fn printable(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::escaped;

    #[test]
    fn markup_and_control_characters_do_not_pass() {
        assert_eq!(escaped("a<b> & \"c\"\u{1}\u{9}µ"), "a&lt;b&gt; &amp; &quot;c&quot;  µ");
    }
}
