//! Lines of text with an indent, none longer than people read.

/// Longest line.
const WIDTH: usize = 100;

/// A comment that begins with one of these is a command to some tool.
const OBEYED: [&str; 12] = [
    "synopsys",
    "synthesis",
    "verilator",
    "pragma",
    "translate",
    "lint",
    "yosys",
    "verilog_lint",
    "coverage",
    "spyglass",
    "ambit",
    "cadence",
];

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

    /// A comment, wrapped at words; no line of it begins as a tool's command does.
    pub(crate) fn comment(&mut self, text: &str) {
        for paragraph in text.lines() {
            let mut line = String::from("//");
            for word in paragraph.split_whitespace() {
                if 4 * self.depth + line.chars().count() + 1 + word.chars().count() > WIDTH {
                    self.put(4 * self.depth, &line);
                    line = String::from("//");
                }
                if line == "//" && OBEYED.iter().any(|tool| starts_with(word, tool)) {
                    line.push_str(" -");
                }
                line.push(' ');
                line.push_str(word);
            }
            self.put(4 * self.depth, &line);
        }
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

fn starts_with(word: &str, tool: &str) -> bool {
    word.get(..tool.len()).is_some_and(|start| start.eq_ignore_ascii_case(tool))
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

    /// `// synopsys translate_off` makes a synthesis skip what follows, wherever the words come from.
    #[test]
    fn no_comment_is_a_command() {
        let title = format!("{} Synopsys translate_off\nverilator lint_off", "x".repeat(85));
        let mut lines = Lines::default();
        lines.comment(&title);
        let text = lines.finish();
        assert!(
            text.contains("\n// - Synopsys translate_off\n// - verilator lint_off\n"),
            "{text}"
        );
    }
}
