//! Lines of text with an indent, none longer than people read.

/// Longest line.
const WIDTH: usize = 100;

/// Text under construction.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    text: String,
    depth: usize,
}

impl Lines {
    pub(crate) fn indent(&mut self) {
        self.depth += 1;
    }

    pub(crate) fn dedent(&mut self) {
        self.depth -= 1;
    }

    /// An empty line, unless the last one was empty or opened something.
    pub(crate) fn gap(&mut self) {
        if !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    /// One statement, broken at operators where it is too long.
    pub(crate) fn push(&mut self, line: &str) {
        let mut rest = line;
        let mut margin = 4 * self.depth;
        while margin + rest.chars().count() > WIDTH {
            let Some(at) = break_at(rest, WIDTH - margin) else { break };
            self.put(margin, rest[..at].trim_end());
            rest = rest[at..].trim_start();
            margin = 4 * (self.depth + 1);
        }
        self.put(margin, rest);
    }

    /// A list, an item a line, with commas between.
    pub(crate) fn push_list(&mut self, items: &[String]) {
        for (index, item) in items.iter().enumerate() {
            let comma = if index + 1 < items.len() { "," } else { "" };
            self.push(&format!("{item}{comma}"));
        }
    }

    /// A comment about something with a name, wrapped at words.
    ///
    /// Tools take a comment for an order when it begins with certain words, `synopsys
    /// translate_off` for one. So the first line begins with the name, all others with a bar,
    /// wherever the text is broken and whatever its author put there.
    pub(crate) fn comment(&mut self, name: &str, text: &str) {
        let mut line = format!("// {name}:");
        for (index, paragraph) in text.lines().enumerate() {
            if index > 0 {
                self.put(4 * self.depth, &line);
                line = String::from("// |");
            }
            for word in paragraph.split(|c: char| c.is_whitespace() || c.is_control()) {
                if 4 * self.depth + line.chars().count() + 1 + word.chars().count() > WIDTH {
                    self.put(4 * self.depth, &line);
                    line = String::from("// |");
                }
                if !word.is_empty() {
                    line.push(' ');
                    line.push_str(word);
                }
            }
        }
        self.put(4 * self.depth, &line);
    }

    /// A comment of our own, as it is.
    pub(crate) fn remark(&mut self, text: &str) {
        self.put(4 * self.depth, &format!("// {text}"));
    }

    pub(crate) fn finish(self) -> String {
        self.text
    }

    fn put(&mut self, margin: usize, line: &str) {
        if !line.is_empty() {
            self.text.push_str(&" ".repeat(margin));
        }
        self.text.push_str(line);
        self.text.push('\n');
    }
}

/// Where to break: at the last operator of the outermost parentheses before `limit`.
fn break_at(line: &str, limit: usize) -> Option<usize> {
    let mut depth = 0_usize;
    let mut best: Option<(usize, usize)> = None;
    for (at, c) in line.char_indices() {
        match c {
            '(' | '{' => depth += 1,
            ')' | '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let here = [" & ", " | ", " ^ ", " ? ", " : ", " + "]
            .iter()
            .any(|operator| line[at..].starts_with(operator));
        let usable = here && at + 2 < limit;
        if usable && best.is_none_or(|(least, _)| depth <= least) {
            best = Some((depth, at + 1));
        }
    }
    best.map(|(_, at)| at)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However a text is wrapped, no comment begins with a word of it.
    #[test]
    fn no_comment_can_become_an_order() {
        for blanks in 0..120 {
            let mut lines = Lines::default();
            let text = format!(
                "{}verilator lint_off\nsynopsys translate_off\r synthesis translate_off\u{b}pragma",
                "x ".repeat(blanks)
            );
            lines.comment("top", &text);
            let text = lines.finish();
            assert!(
                text.lines().all(|line| line.starts_with("// top:") || line.starts_with("// | "))
            );
            assert!(!text.contains(['\r', '\u{b}']));
        }
    }
}
