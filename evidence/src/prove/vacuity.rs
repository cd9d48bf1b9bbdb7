//! No assertion is idle: each is reached, under the assumptions of its file.
//!
//! A proof says nothing where its assumptions contradict each other, or where the condition in front
//! of an assertion never comes true. Each `assert (…)` in turn is replaced by `assert (0)`, the
//! others, which are proven, being assumptions: yosys has to find the way to it.

use std::path::Path;

use super::covers::reachable;
use super::sources::Sources;

/// Assertions of a block that nothing reaches, as they are written; none is as it should be.
///
/// # Errors
///
/// When yosys cannot be started, or a file cannot be read or written.
pub fn idle(sources: &Sources, block: &str, folder: &Path) -> anyhow::Result<Vec<String>> {
    let text = sources.properties_of(block)?;
    let mut idle = Vec::new();
    for (index, (place, _)) in text.match_indices(ASSERT).enumerate() {
        let name = format!("{block}_assert_{index}");
        if reachable(sources, block, &name, &impossible(&text, place), folder)?.is_none() {
            idle.push(statement(&text, place).to_owned());
        }
    }
    Ok(idle)
}

const ASSERT: &str = "assert (";

/// The properties with the assertion at `place` made impossible, and the others assumed.
fn impossible(text: &str, place: usize) -> String {
    let statement = statement(text, place);
    let (before, after) = (&text[..place], &text[place + statement.len()..]);
    let assumed = |text: &str| {
        let lines = text.lines().filter(|line| !line.contains(" cover ("));
        lines.map(|line| line.replace(ASSERT, "assume (")).collect::<Vec<_>>().join("\n")
    };
    // The line goes on where it was cut.
    format!("{}assert (0);{}\n", assumed(before), assumed(after))
}

/// The statement that begins at `place`, to its semicolon.
fn statement(text: &str, place: usize) -> &str {
    let rest = &text[place..];
    &rest[..rest.find(';').map_or(rest.len(), |end| end + 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_assertion_is_made_impossible() {
        let text = "always @* if (a) begin\n  assert (b);\n  assert (c == (d));\nend\n\
                    always @* cover (e);\nendmodule\n";
        let place = text.rfind(ASSERT).unwrap();
        assert_eq!(
            impossible(text, place),
            "always @* if (a) begin\n  assume (b);\n  assert (0);\nend\nendmodule\n"
        );
    }
}
