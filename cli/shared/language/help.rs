//! The help of every command in Chinese: texts from `help.tsv`, paragraph by paragraph, and what
//! clap writes around them.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use clap::builder::{PossibleValue, Resettable, StyledStr};
use clap::{Arg, Command};

/// What separates the paragraphs of a text.
const BREAK: &str = "\n\n";

/// English, Chinese.
static TEXTS: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    include_str!("help.tsv").lines().skip(1).filter_map(|line| line.split_once('\t')).collect()
});

/// A command, with all below it, that helps in Chinese and reads the same words.
pub(super) fn in_chinese(mut command: Command) -> Command {
    command.build(); // adds `help`, whose text is clap's own
    translated(command)
}

fn translated(mut command: Command) -> Command {
    let usage = usage(&mut command);
    let template = template(&command);
    let text = |text: &StyledStr| StyledStr::from(said(&text.to_string()));
    let (about, long_about) = (command.get_about().map(text), command.get_long_about().map(text));
    command
        .about(Resettable::from(about))
        .long_about(Resettable::from(long_about))
        .override_usage(usage)
        .help_template(template)
        .mut_args(argument)
        .mut_subcommands(translated)
}

/// The line of usage; names of values stay, as texts name them.
fn usage(command: &mut Command) -> String {
    let usage = command.render_usage().to_string();
    let usage = usage.trim_start_matches("Usage:").trim_start();
    let marks = [("[OPTIONS]", "[选项]"), ("<COMMAND>", "<命令>"), ("[COMMAND]", "[命令]")];
    marks.iter().fold(usage.to_owned(), |usage, (english, chinese)| usage.replace(english, chinese))
}

/// Parts of the help, those that there are, in clap's order.
fn template(command: &Command) -> String {
    let mut template = String::from("{about-with-newline}\n用法：{usage}");
    let mut part = |is_there: bool, text: &str| {
        if is_there {
            template.push_str(text);
        }
    };
    part(command.has_subcommands(), "\n\n命令：\n{subcommands}");
    let has = |is_positional| {
        let shown = command.get_arguments().filter(|argument| !argument.is_hide_set());
        shown.map(Arg::is_positional).any(|found| found == is_positional)
    };
    part(has(true), "\n\n参数：\n{positionals}");
    part(has(false), "\n\n选项：\n{options}");
    template
}

/// Its text, with its default, other names and the values it takes, which clap would say in English.
fn argument(argument: Arg) -> Arg {
    let text = |text: Option<&StyledStr>| text.map(|text| said(&text.to_string()));
    let (short, long) = (text(argument.get_help()), text(argument.get_long_help()));
    let (default, names, list) = (default(&argument), names(&argument), list(&argument));
    let aliases = aliases(&argument);
    let is_long = long.is_some() || list.is_some();
    let whole = [long.or_else(|| short.clone()), list.or_else(|| names.clone())];
    let whole = [whole, [default.clone(), aliases.clone()]].concat();
    let long = is_long.then(|| StyledStr::from(joined(whole, BREAK)));
    argument
        .hide_default_value(true)
        .hide_possible_values(true)
        .visible_alias(Resettable::Reset) // the words are known since `build`
        .help(joined(vec![short, default, aliases, names], " "))
        .long_help(Resettable::from(long))
}

/// Those parts that there are.
fn joined(parts: Vec<Option<String>>, mark: &str) -> String {
    parts.into_iter().flatten().collect::<Vec<_>>().join(mark)
}

/// Its other names.
fn aliases(argument: &Arg) -> Option<String> {
    let names = argument.get_visible_aliases().filter(|names| !names.is_empty())?;
    Some(format!("[别名：--{}]", names.join(", --")))
}

/// The values an option takes, in short.
fn names(argument: &Arg) -> Option<String> {
    let values = argument.get_possible_values();
    let names: Vec<_> = values.iter().map(PossibleValue::get_name).collect();
    (!names.is_empty()).then(|| format!("[可选值：{}]", names.join(", ")))
}

/// The same with what they mean, where that is said.
fn list(argument: &Arg) -> Option<String> {
    let values = argument.get_possible_values();
    let lines: Vec<_> = values.iter().map(value).collect();
    let is_told = values.iter().any(|value| value.get_help().is_some());
    is_told.then(|| format!("可选值：\n{}", lines.join("\n")))
}

/// What an option is taken to be where it is not given.
fn default(argument: &Arg) -> Option<String> {
    let values = argument.get_default_values();
    let is_said = argument.get_action().takes_values() && !values.is_empty();
    let values = values.iter().map(|value| value.to_string_lossy());
    is_said.then(|| format!("[默认：{}]", values.collect::<Vec<_>>().join(" ")))
}

/// A line for a value that an option takes.
fn value(value: &PossibleValue) -> String {
    let text = value.get_help().map(|text| format!("：{}", said(&text.to_string())));
    format!("- {}{}", value.get_name(), text.unwrap_or_default())
}

/// A text in Chinese, as far as the table knows its paragraphs.
fn said(text: &str) -> String {
    let said = |part| TEXTS.get(part).copied().unwrap_or(part);
    text.split(BREAK).map(said).collect::<Vec<_>>().join(BREAK)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::ffi::OsString;
    use std::os::unix::ffi::OsStringExt;

    use clap::CommandFactory;
    use clap::error::ErrorKind::{self, *};
    use regex::Regex;

    use super::*;
    use crate::Words;
    use crate::shared::language::Language;

    /// Names of formats, makers and programs, units, and symbols of standards.
    const NAMES: &str = "Verilog Parquet Intel Heidenhain Siemens GTKWave mm ppm ns arcsec rpm um
        in tpi pi Vu nm ms KiB";

    /// Words of two letters and more that begin with a small one or are no abbreviation, but those
    /// in backticks, of paths and options, and the names of commands and values.
    fn english(text: &str, names: &BTreeSet<String>) -> Vec<String> {
        let own = r#"`[^`]*`|"[^"]*"|(?m:^|[\s'])--?[a-z][a-z-]*|<[^>]*>|\[默认：[^\]]*\]|\[(?:可选值|别名)：[^\]]*\]"#;
        let text = Regex::new(own).unwrap().replace_all(text, " ").into_owned();
        let word = Regex::new("[A-Za-z][A-Za-z0-9.-]*[a-z][A-Za-z0-9.-]*").unwrap();
        let found = word.find_iter(&text).map(|word| word.as_str().to_owned());
        found.filter(|word| !names.contains(word)).collect()
    }

    /// The command and all below it.
    fn all(command: &Command) -> Vec<Command> {
        let below = command.get_subcommands().flat_map(all);
        [command.clone()].into_iter().chain(below).collect()
    }

    /// What stays as it is: names of commands and of values.
    fn names(commands: &[Command]) -> BTreeSet<String> {
        let values = commands.iter().flat_map(Command::get_arguments);
        let values = values.flat_map(Arg::get_possible_values);
        let values = values.map(|value| value.get_name().to_owned());
        let commands = commands.iter().map(|command| command.get_name().to_owned());
        values.chain(commands).chain(NAMES.split_whitespace().map(str::to_owned)).collect()
    }

    #[test]
    fn the_help_of_every_command_is_chinese() {
        let commands = all(&in_chinese(Words::command()));
        let names = names(&commands);
        let mut left = BTreeSet::new();
        for mut command in commands {
            for help in [command.render_help(), command.render_long_help()] {
                let wrong = english(&help.to_string(), &names);
                left.extend(
                    wrong.into_iter().map(|word| [command.get_name(), ": ", &word].concat()),
                );
            }
        }
        assert!(left.is_empty(), "{left:#?}");
    }

    #[test]
    fn every_text_of_the_table_is_said() {
        let mut command = Words::command();
        command.build();
        let text = |text: Option<&StyledStr>| text.map(ToString::to_string);
        let mut said = BTreeSet::new();
        for command in all(&command) {
            said.extend([text(command.get_about()), text(command.get_long_about())]);
            for argument in command.get_arguments() {
                said.extend([text(argument.get_help()), text(argument.get_long_help())]);
                let values = argument.get_possible_values();
                said.extend(values.iter().map(|value| text(value.get_help())));
            }
        }
        let said: BTreeSet<_> = said.iter().flatten().flat_map(|text| text.split(BREAK)).collect();
        let stale: Vec<_> = TEXTS.keys().filter(|text| !said.contains(*text)).collect();
        assert!(stale.is_empty(), "{stale:#?}");
        assert!(TEXTS.values().all(|text| text.contains(|c| '\u{2e80}' < c)));
    }

    /// What is wrong with these words, and what is said of it.
    fn refused(words: &[OsString]) -> (ErrorKind, String) {
        let command = in_chinese(Words::command());
        let words = ["helixlock".into()].into_iter().chain(words.iter().cloned());
        let error = command.try_get_matches_from(words).expect_err("words that are wrong");
        (error.kind(), Language::Zh.error(&error))
    }

    #[test]
    fn every_error_about_words_is_chinese() {
        let stories = [
            (UnknownArgument, "compare --jsom a b"),
            (UnknownArgument, "sim a --op"),
            (UnknownArgument, "effects abbe -x"),
            (UnknownArgument, "effects abbe more"),
            (InvalidSubcommand, "compar a b"),
            (InvalidSubcommand, "xyzzy"),
            (InvalidSubcommand, "board wach"),
            (MissingSubcommand, "--language zh"),
            (DisplayHelpOnMissingArgumentOrSubcommand, ""),
            (DisplayHelpOnMissingArgumentOrSubcommand, "board"),
            (DisplayHelp, "sim --help"),
            (DisplayHelp, "help sim"),
            (MissingRequiredArgument, "compare"),
            (InvalidValue, "effects --language de"),
            (InvalidValue, "sim a -o b --wave fts"),
            (InvalidValue, "compare a b -o"),
            (ValueValidation, "challenge --seed x"),
            (ValueValidation, "challenge --seed 99999999999999999999999"),
            (ValueValidation, "challenge --seed="),
            (ValueValidation, "serve --port 70000"),
            (ValueValidation, "dividers --lead x"),
            (ValueValidation, "dividers --lead 6"),
            (ArgumentConflict, "compare a b --json --json"),
            (ArgumentConflict, "learn a b --undo --accept"),
            (TooManyValues, "compare a b --json=5"),
            (DisplayVersion, "--version"),
        ];
        let names = names(&all(&in_chinese(Words::command())));
        // What the user wrote; names of this command are all that is in brackets and the version.
        let quoted = Regex::new(r"'[^']*'|\[[^\]]*\]|helixlock").unwrap();
        let mut left = Vec::new();
        for (kind, line) in stories {
            let words: Vec<OsString> = line.split_whitespace().map(Into::into).collect();
            let (found, said) = refused(&words);
            let own = quoted.replace_all(&said, "");
            let wrong = english(&own, &names);
            if found != kind || !wrong.is_empty() {
                left.push(format!("{line}: {found:?}\n{said}\n{wrong:?}"));
            }
        }
        let (kind, said) = refused(&["effects".into(), OsString::from_vec(vec![0xff])]);
        assert_eq!((kind, said.lines().next()), (InvalidUtf8, Some("错误：参数中有无效的 UTF-8")));
        assert!(left.is_empty(), "{}", left.join("\n\n"));
    }

    #[test]
    fn words_are_read_as_in_english() {
        let line = "helixlock --language=zh learn machine.toml data.csv -o out --custom mine.toml";
        let read = in_chinese(Words::command()).try_get_matches_from(line.split(' ')).unwrap();
        assert!(read.subcommand_matches("learn").unwrap().contains_id("custom"));
    }

    #[test]
    fn the_language_is_found_before_words_are_read() {
        let asked = |line: &str| Language::asked(line.split(' ').map(OsString::from));
        for line in ["sim --language zh", "--language=zh sim", "--frob --language zh"] {
            assert_eq!(asked(line), Language::Zh, "{line}");
        }
        for line in ["sim", "--language", "--language de", "sim -- --language zh"] {
            assert_eq!(asked(line), Language::En, "{line}");
        }
    }
}
