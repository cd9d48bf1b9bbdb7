//! The functions of `import helixlock` are written from the words of the commands.

use std::any::TypeId;
use std::fmt::Write;
use std::path::PathBuf;

use clap::{Arg, ArgAction};
use expect_test::expect_file;
use helixlock::{Function, functions};

/// Longest line of the Python source.
const LONGEST: usize = 100;

const HEAD: &str = r#""""The commands as functions, written from their words: do not edit."""

from collections.abc import Sequence
from typing import Literal

from ._answers import (
    Added,
    Answer,
    Applied,
    Comparison,
    Diagnosis,
    Discovery,
    Image,
    Learned,
    Quantity,
    ScrewGrade,
    Separation,
    Simulation,
    StrPath,
    Sweep,
    TransmissionError,
    ask,
)
"#;

/// Words of a simulation that only say what its waveform shows, which is a file.
const WAVEFORM: &[&str] = &["scopes", "from", "to", "wave"];

/// `UPDATE_EXPECT=1` writes the file anew.
#[test]
fn the_python_functions_have_the_words_of_the_commands() {
    let mut text = HEAD.to_owned();
    text.push_str("\n__all__ = [\n");
    for function in functions() {
        let _ = writeln!(text, "    \"{}\",", function.name);
    }
    text.push_str("]\n");
    for function in functions() {
        write_function(&mut text, function);
    }
    expect_file!["../python/helixlock/_functions.py"].assert_eq(&text);
}

/// The class of a function's result.
fn result(function: &str) -> &'static str {
    match function {
        "simulate" => "Simulation",
        "compare" => "Comparison",
        "diagnose" => "Diagnosis",
        "discover" => "Discovery",
        "learn" => "Learned",
        "add" => "Added",
        "sweep" => "Sweep",
        "screw" => "ScrewGrade",
        "straightness" => "Separation",
        "transmission" => "TransmissionError",
        "scale_build" => "Image",
        "scale_apply" => "Applied",
        _ => "Answer",
    }
}

/// Writing to a string cannot fail.
fn write_function(text: &mut String, function: &Function) {
    let command = function.command();
    let of_waveform =
        |word: &&Arg| function.name == "simulate" && WAVEFORM.contains(&word.get_id().as_str());
    let shown = || command.get_arguments().filter(|word| !word.is_hide_set() && !of_waveform(word));
    let (operands, options): (Vec<_>, Vec<_>) = shown().partition(|word| word.is_positional());
    let kind = result(function.name);
    let _ = write!(text, "\n\ndef {}(\n", function.name);
    for word in &operands {
        // A plan of spacings needs no data, and a formula no name of an effect.
        let left_out = [("straightness", "data"), ("add", "effect")];
        let may_be_none = left_out.contains(&(function.name, word.get_id().as_str()));
        let none = if may_be_none { " | None" } else { "" };
        let _ = writeln!(text, "    {}: {}{none},", name(word), plain_type(word));
    }
    if !options.is_empty() {
        text.push_str("    *,\n");
    }
    for word in &options {
        let _ = writeln!(text, "    {}: {},", name(word), option_type(word));
    }
    let about = command.get_about().expect("a command says what it does");
    let _ = writeln!(text, ") -> {kind}:\n    \"\"\"{about}.\n");
    for word in operands.iter().chain(&options) {
        let _ = writeln!(text, "    {}:\n{}", name(word), wrapped(&help(word)));
    }
    let words = function.words;
    let _ = writeln!(text, "\n    The keys are those of `helixlock {words} --json`.\n    \"\"\"");
    let operands: Vec<String> = operands.iter().map(|word| name(word)).collect();
    let _ = writeln!(text, "    return ask(\n        {kind},\n        \"{}\",", function.name);
    let _ = writeln!(text, "        [{}],\n        {{", operands.join(", "));
    for word in options {
        let long = word.get_long().expect("an option has a long name");
        let _ = writeln!(text, "            \"{long}\": {},", name(word));
    }
    text.push_str("        },\n    )\n");
}

/// Its name in Python.
fn name(word: &Arg) -> String {
    let name = word.get_long().unwrap_or_else(|| word.get_id().as_str());
    let name = name.replace('-', "_");
    // Words of Python itself.
    if ["from", "pass", "with"].contains(&name.as_str()) { name + "_" } else { name }
}

fn option_type(word: &Arg) -> String {
    if word.is_required_set() {
        return plain_type(word);
    }
    match word.get_action() {
        ArgAction::SetTrue => "bool = False".into(),
        ArgAction::Append => {
            let one = plain_type(word);
            format!("{one} | Sequence[{one}] | None = None")
        }
        _ => format!("{} | None = None", plain_type(word)),
    }
}

/// Type of a single value.
fn plain_type(word: &Arg) -> String {
    let choices = word.get_possible_values();
    if !choices.is_empty() {
        let names: Vec<_> =
            choices.iter().map(|choice| format!("\"{}\"", choice.get_name())).collect();
        return format!("Literal[{}]", names.join(", "));
    }
    let of = word.get_value_parser().type_id();
    if of == TypeId::of::<PathBuf>() {
        "StrPath".into()
    } else if of == TypeId::of::<f64>() || of == TypeId::of::<(u64, u64)>() {
        "Quantity".into()
    } else if [TypeId::of::<u64>(), TypeId::of::<u32>(), TypeId::of::<usize>()]
        .iter()
        .any(|whole| of == *whole)
    {
        "int".into()
    } else {
        "str".into()
    }
}

fn help(word: &Arg) -> String {
    let help = word.get_help().expect("a word says what it is").to_string();
    let defaults: Vec<_> =
        word.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    let flag = matches!(word.get_action(), ArgAction::SetTrue);
    if defaults.is_empty() || flag {
        help
    } else {
        format!("{help} [default: {}]", defaults.join(", "))
    }
}

/// A description, indented, in lines that are not too long.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is a line");
        if LONGEST < 8 + line.chars().count() + 1 + word.chars().count() {
            lines.push(word.to_owned());
        } else {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.iter().map(|line| format!("        {line}")).collect::<Vec<_>>().join("\n")
}
