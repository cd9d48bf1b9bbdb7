//! The help and the errors of all commands in Chinese: nothing English is left in them.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;

use clap::builder::StyledStr;
use clap::error::ErrorKind::{self, *};
use clap::{Arg, Command, CommandFactory};
use regex::Regex;

use crate::Words;
use crate::shared::language::Language;
use crate::shared::language::help::{BREAK, TEXTS, in_chinese};

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
            left.extend(wrong.into_iter().map(|word| [command.get_name(), ": ", &word].concat()));
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
