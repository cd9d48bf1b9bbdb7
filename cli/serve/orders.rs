//! The commands that a page may begin, as they run and as a user would type them.

use anyhow::{Context, bail};
use helixlock_plant::CATALOGUE;

use super::waves::SIMULATION;

/// Folder for what a command writes before it is taken.
pub(crate) const SCRATCH: &str = "SCRATCH";

/// In that folder, a machine file that is not saved, and what its simulation writes.
pub(crate) const DRAFT: &str = "draft.toml";
pub(crate) const DRAFTED: &str = "drafted";

/// The machine file that `learn` writes; who reads it has to allow that.
const LEARNED: &str = "machine.toml";

/// What a command works on.
#[derive(Debug)]
pub(crate) struct Subject<'a> {
    pub(crate) machine: &'a str,
    pub(crate) data: &'a str,
    /// Effect to be fitted.
    pub(crate) effect: &'a str,
    /// Effects at the head of the machine file that are not fitted again.
    pub(crate) keep: usize,
    /// Begin and end of a waveform, s; empty for the usual one.
    pub(crate) window: [&'a str; 2],
    /// Language of the pages that it writes.
    pub(crate) language: &'a str,
}

/// Words of a command.
///
/// # Errors
///
/// A command that is none of the workbench's, or an effect that is not in the catalogue.
pub(crate) fn words(command: &str, subject: &Subject<'_>) -> anyhow::Result<Vec<String>> {
    let &Subject { machine, data, effect, keep, .. } = subject;
    let words: Vec<String> = match command {
        "compare" | "diagnose" => [command, machine, data, "--json"].map(str::to_owned).into(),
        "learn" => {
            let own = if machine == LEARNED { &["--force"][..] } else { &[] };
            let words =
                ["learn", machine, data, "-o", SCRATCH].into_iter().chain(own.iter().copied());
            words.chain(["--json"]).map(str::to_owned).collect()
        }
        "sim" => simulated(subject)?,
        "draft" => {
            let (draft, drafted) = (format!("{SCRATCH}/{DRAFT}"), format!("{SCRATCH}/{DRAFTED}"));
            ["sim", &draft, "-o", &drafted, "--json"].map(str::to_owned).into()
        }
        "add" => {
            let known = CATALOGUE.iter().any(|card| card.kind == effect);
            known.then_some(()).with_context(|| format!("`{effect}` is no effect we know"))?;
            let output = format!("{SCRATCH}/machine.toml");
            let keep = keep.to_string();
            let kept = if keep == "0" { vec![] } else { vec!["--keep", &keep] };
            let head = ["add", machine, effect, "--fit", data, "--refit"];
            let words = head.into_iter().chain(kept).chain(["-o", &output, "--force", "--json"]);
            words.map(str::to_owned).collect()
        }
        other => bail!("`{other}` is not begun from here"),
    };
    Ok(words)
}

/// A simulation, its waveform between two instants where those are given.
fn simulated(subject: &Subject<'_>) -> anyhow::Result<Vec<String>> {
    let mut words = vec!["sim", subject.machine];
    for (name, second) in ["--from", "--to"].into_iter().zip(subject.window) {
        if !second.is_empty() {
            second.parse::<f64>().with_context(|| format!("`{second}` is no second"))?;
            words.extend([name, second]);
        }
    }
    if subject.language == "zh" {
        words.extend(["--language", "zh"]);
    }
    words.extend(["-o", SIMULATION, "--json"]);
    Ok(words.into_iter().map(str::to_owned).collect())
}

/// What a user would type to have the same in the folder itself.
pub(crate) fn line(words: &[String], machine: &str) -> String {
    let writes = words.iter().any(|word| word == "-o");
    let shown = words.iter().filter(|word| !(writes && *word == "--json"));
    let typed = shown.map(|word| match word.strip_prefix(SCRATCH) {
        Some("") => ".",
        Some(rest) if rest.strip_prefix('/') == Some(DRAFTED) => SIMULATION,
        Some(_) => machine,
        None => word,
    });
    std::iter::once("helixlock").chain(typed).map(quoted).collect::<Vec<_>>().join(" ")
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "-_./=,+:@%".contains(letter);
    if word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn subject(machine: &str) -> Subject<'_> {
        let (effect, window) = ("abbe", ["", ""]);
        Subject { machine, data: "data.csv", effect, keep: 0, window, language: "en" }
    }

    fn typed(command: &str, machine: &str, keep: usize) -> String {
        let subject = Subject { keep, ..subject(machine) };
        line(&words(command, &subject).unwrap(), machine)
    }

    #[test]
    fn a_line_does_in_the_folder_what_the_job_does_beside_it() {
        assert_eq!(typed("compare", "m.toml", 0), "helixlock compare m.toml data.csv --json");
        assert_eq!(typed("learn", "m.toml", 0), "helixlock learn m.toml data.csv -o .");
        assert_eq!(
            typed("learn", "machine.toml", 0),
            "helixlock learn machine.toml data.csv -o . --force"
        );
        assert_eq!(
            typed("add", "m.toml", 2),
            "helixlock add m.toml abbe --fit data.csv --refit --keep 2 -o m.toml --force"
        );
        assert_eq!(typed("sim", "my m.toml", 0), "helixlock sim 'my m.toml' -o simulation");
        assert_eq!(typed("draft", "m.toml", 0), "helixlock sim m.toml -o simulation");
    }

    #[test]
    fn a_page_is_written_in_the_language_of_the_screen() {
        let chinese = words("sim", &Subject { language: "zh", ..subject("m.toml") }).unwrap();
        assert_eq!(line(&chinese, "m.toml"), "helixlock sim m.toml --language zh -o simulation");
    }

    #[test]
    fn nothing_else_is_begun() {
        let subject = Subject { effect: "--custom", window: ["x", ""], ..subject("m") };
        assert!(words("sim", &subject).is_err());
        assert!(words("serve", &subject).is_err() && words("add", &subject).is_err());
    }
}
