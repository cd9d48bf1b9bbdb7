//! Hostile words of the command line.

use super::Wanted::{Anything, Refused};
use super::{Case, Wanted};

pub(super) fn cases() -> Vec<Case> {
    [transmissions(), lengths(), axes(), files()].into_iter().flatten().collect()
}

fn case(name: String, words: &[&str], wanted: Wanted) -> Case {
    Case::new(name, Vec::new(), words, wanted)
}

fn transmissions() -> Vec<Case> {
    let gearing = |ratio| {
        let lines = ["--input-lines", "100", "--output-lines", "100", "--ratio", ratio];
        [&["transmission", "pulses.csv"], &lines[..]].concat()
    };
    let shafts: Vec<String> = (0..20_000).map(|i| format!("--shaft=s{i}={}", i + 1)).collect();
    let many: Vec<&str> = shafts.iter().map(String::as_str).collect();
    let long = format!("--shaft={}=0", "s".repeat(100_000));
    let mut cases = vec![
        case("20,000 shafts".into(), &[gearing("2"), many].concat(), Refused),
        case("a shaft of a long name".into(), &[gearing("2"), vec![&long]].concat(), Refused),
    ];
    let most = "18446744073709551615/18446744073709551615";
    for ratio in ["0", "1/0", most, "1/18446744073709551615", "0.00000000000000000001", "1e5", "-1"]
    {
        cases.push(case(format!("a ratio of {ratio}"), &gearing(ratio), Refused));
    }
    cases
}

fn lengths() -> Vec<Case> {
    let mut cases = Vec::new();
    let leads =
        ["1e300 mm", "1e-300 mm", "0 mm", "1/0 in", "99999999999999999999/3 mm", "\u{1b}[2J mm"];
    for lead in leads {
        let screw = ["screw", "good.csv", "--lead", lead];
        cases.push(case(format!("a screw of {lead:?}"), &screw, Refused));
        cases.push(case(format!("dividers for {lead:?}"), &["dividers", "--lead", lead], Refused));
    }
    for spacing in
        ["1e300 mm,1 mm", "0 mm,0 mm", "-1 mm,2 mm", "1e-300 mm,1e-300 mm", "nan mm,1 mm"]
    {
        let words = ["straightness", "good.csv", "--spacing", spacing];
        cases.push(case(format!("a spacing of {spacing}"), &words, Refused));
    }
    for length in ["0", "-1", "nan", "1e-300", "0.000001 mm"] {
        let words = ["certify", "machine.toml", "--length", length];
        cases.push(case(format!("a length of {length}"), &words, Refused));
    }
    cases
}

fn axes() -> Vec<Case> {
    let refused = [
        "a",
        "=",
        "a=",
        "=1",
        "a=..",
        "a=1..2:",
        "a=1..2:0",
        "a=1..2:99999999999",
        "a=nan",
        "a=1e400",
        "spindle.speed=1,,2 rpm",
    ];
    // What names no key is a case that cannot be run, which is told with status 1.
    let told = ["a=1..", "effect.99999999999999999999.a=1"];
    let axis = |values: &&str, wanted| {
        let words = ["sweep", "machine.toml", "--length", "0.2", "-o", "out.csv", "--set", values];
        case(format!("an axis `{values}`"), &words, wanted)
    };
    let refused = refused.iter().map(|values| axis(values, Refused));
    refused.chain(told.iter().map(|values| axis(values, Anything))).collect()
}

fn files() -> Vec<Case> {
    let mut cases = Vec::new();
    for path in ["/dev/full", "/proc/nothing", "", "good.csv"] {
        let words = ["sim", "machine.toml", "--length", "0.2", "-o", path];
        cases.push(case(format!("an output `{path:?}`"), &words, Refused));
    }
    for data in ["/dev/zero", "/dev/null", "/proc/self/mem", "."] {
        for words in [
            &["compare", "machine.toml", data][..],
            &["sim", data, "-o", "out"],
            &["scale", "apply", data, "good.csv"],
            &["import", data],
        ] {
            cases.push(case(format!("{data} for {}", words[0]), words, Refused));
        }
    }
    cases
}
