//! Hostile machine files and the files they name.

use super::Wanted::{Anything, Refused};
use super::{Case, Wanted, good_machine, text as pieces};

const READERS: [&[&str]; 3] = [
    &["sim", "odd.toml", "--length", "1 mm", "-o", "out"],
    &["compare", "odd.toml", "good.csv"],
    &["gen", "odd.toml", "--board", "icestick", "-o", "out"],
];

fn each(name: &str, text: &str, wanted: Wanted) -> Vec<Case> {
    let case = |words: &&[&str]| {
        let files = vec![("odd.toml", text.as_bytes().to_vec())];
        Case::new(format!("{name}: {}", words[0]), files, words, wanted)
    };
    READERS.iter().map(case).collect()
}

/// The good machine with an effect of the user's own.
fn formula(formula: &str) -> String {
    format!(
        "{}\n[[effect]]\nkind = \"custom\"\nname = \"odd\"\nentry = \"motion\"\nformula = \"{formula}\"\n",
        good_machine()
    )
}

/// The good machine with a measured curve.
fn curve(file: &str) -> String {
    format!("{}\n[[effect]]\nkind = \"measured-curve\"\nfile = \"{file}\"\n", good_machine())
}

pub(super) fn cases() -> Vec<Case> {
    [texts(), long_lists(), formulas(), curves_and_titles()].into_iter().flatten().collect()
}

fn texts() -> Vec<Case> {
    let machine = good_machine();
    let mut cases = Vec::new();
    for (name, text) in [
        ("arrays in arrays", format!("x = {}{}\n", "[".repeat(100_000), "]".repeat(100_000))),
        ("tables in tables", format!("x = {}1{}\n", "{a=".repeat(50_000), "}".repeat(50_000))),
        ("a table of a long path", format!("[{}a]\nb = 1\n", "a.".repeat(100_000))),
        ("a key of a long path", format!("{}a = 1\n", "a.".repeat(100_000))),
        ("a key of 5 MB", format!("{machine}\n{} = 1\n", "k".repeat(5_000_000))),
        (
            "a value of 5 MB",
            machine.replacen("\"6 mm\"", &format!("\"{}\"", "6".repeat(5_000_000)), 1),
        ),
        ("a key with escapes", format!("{machine}\n\"\\u001b[2J\" = 1\n")),
        (
            "a value with escapes",
            machine.replacen("lead = \"6 mm", "lead = \"\\u001b]0;x\\u0007 mm", 1),
        ),
        (
            "a number of a million digits",
            format!("{machine}\n[filter]\ncutoff = {}\n", "1".repeat(1_000_000)),
        ),
        ("not UTF-8 by far", "\u{fffd}".repeat(1_000_000)),
        ("nothing", String::new()),
        (
            "a file that never ends a string",
            format!("{machine}\nx = \"\"\"{}", "y\n".repeat(500_000)),
        ),
    ] {
        cases.extend(each(name, &text, Refused));
    }
    cases
}

fn long_lists() -> Vec<Case> {
    let machine = good_machine();
    let mut cases = Vec::new();
    let gear = |i| format!("[[gear]]\nname = \"g{i}\"\norder = {}\nteeth = 20\n", i + 1);
    let gears = pieces((0..100_000).map(gear));
    cases.extend(each("100,000 gears", &format!("{machine}\n{gears}"), Refused));
    let effects = "[[effect]]\nkind = \"backlash\"\nwidth = \"1 um\"\n".repeat(20_000);
    cases.extend(each("20,000 effects", &format!("{machine}\n{effects}"), Refused));
    cases
}

fn formulas() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, text) in [
        ("100,000 additions", vec!["1"; 100_000].join("+")),
        ("100,000 parentheses", format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000))),
        ("100,000 minus signs", format!("{}1", "-".repeat(100_000))),
        ("50,000 functions", format!("{}(1)", "sin".repeat(50_000))),
        ("20,000 columns", (0..20_000).map(|i| format!("c{i}")).collect::<Vec<_>>().join("+")),
        ("a tower of powers", format!("{}2", "2^".repeat(50_000))),
        ("a name of a million letters", "x".repeat(1_000_000)),
    ] {
        cases.extend(each(name, &formula(&text), Refused));
    }
    for text in [
        "10^300*sin(time_s)",
        "10^9*sin(10^9*time_s)",
        "tan(time_s*10^6)*10^5",
        "1/0",
        "ln(0-1)",
        "exp(exp(time_s))",
        "10^6*sign(sin(10^5*time_s))",
    ] {
        cases.extend(each(text, &formula(text), Anything));
    }
    cases
}

fn curves_and_titles() -> Vec<Case> {
    let machine = good_machine();
    let mut cases = Vec::new();
    let folders = "../../../../../../../..";
    for file in [
        "/dev/zero",
        "/dev/stdin",
        "/etc/passwd",
        "/proc/self/mem",
        ".",
        "",
        &format!("{folders}/etc/passwd"),
        "odd.toml",
    ] {
        cases.extend(each(&format!("a curve in `{file}`"), &curve(file), Refused));
    }
    let title =
        machine.replacen("title = \"", "title = \"\\u001b[2J synopsys translate_off \\u202e", 1);
    cases.extend(each("a title with commands", &title, Anything));
    cases
}
