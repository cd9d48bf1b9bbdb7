//! The help of every command in Chinese: texts from `help.tsv`, paragraph by paragraph, and what
//! clap writes around them.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use clap::builder::{PossibleValue, Resettable, StyledStr};
use clap::{Arg, Command};

/// What separates the paragraphs of a text.
pub(crate) const BREAK: &str = "\n\n";

/// English, Chinese.
pub(crate) static TEXTS: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    include_str!("help.tsv").lines().skip(1).filter_map(|line| line.split_once('\t')).collect()
});

/// A command, with all below it, that helps in Chinese and reads the same words.
pub(crate) fn in_chinese(mut command: Command) -> Command {
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
