//! Hostile value change dumps.

use super::Wanted::{Anything, Refused};
use super::{Case, Wanted, text as pieces};

const READERS: [&[&str]; 2] = [
    &["compare", "machine.toml", "wave.vcd"],
    &["transmission", "wave.vcd", "--input-lines", "100", "--output-lines", "100", "--ratio", "2"],
];

fn each(name: &str, text: &str, wanted: Wanted) -> Vec<Case> {
    let case = |words: &&[&str]| {
        let files = vec![("wave.vcd", text.as_bytes().to_vec())];
        Case::new(format!("{name}: {}", words[0]), files, words, wanted)
    };
    READERS.iter().map(case).collect()
}

/// Two trains under these declarations.
fn dump(before: &str, body: &str) -> String {
    format!(
        "$timescale 1ns $end\n{before}$var wire 1 ! laser $end\n$var wire 1 \" grating $end\n\
         $enddefinitions $end\n{body}"
    )
}

pub(super) fn cases() -> Vec<Case> {
    let turn = |i| format!("#{}\n{}!\n#{}\n{}\"\n", 1000 * i, i % 2, 1000 * i + 500, i % 2);
    let body = pieces((0..2000_u64).map(turn));
    let mut cases = Vec::new();
    for depth in [1_000, 100_000] {
        let scopes = "$scope module a $end\n".repeat(depth);
        cases.extend(each(&format!("{depth} scopes deep"), &dump(&scopes, &body), Refused));
    }
    let wide = format!("$scope module {} $end\n", "w".repeat(3_000_000));
    let many = format!("{wide}{}", "$var wire 1 # s $end\n".repeat(2000));
    cases.extend(each("a long scope over many signals", &dump(&many, &body), Refused));
    let signals = pieces((0..300_000).map(|i| format!("$var wire 1 a{i} s{i} $end\n")));
    cases.extend(each("300,000 signals", &dump(&signals, &body), Refused));
    cases.extend(each("a tick of nothing", &dump("$timescale 0ns $end\n", &body), Anything));
    cases.extend(each("a tick of ages", &dump("$timescale 4294967295 s $end\n", &body), Anything));
    for time in ["18446744073709551615", "18446744073709551616", "99999999999999999999999999"] {
        let body = format!("{body}#{time}\n1!\n0\"\n");
        cases.extend(each(&format!("the time {time}"), &dump("", &body), Anything));
    }
    let back = format!("{body}#5\n1!\n");
    cases.extend(each("a time that goes back", &dump("", &back), Refused));
    let vector = format!("b{} !\n", "1".repeat(4_000_000));
    cases.extend(each("four million bits", &dump("", &vector), Anything));
    let range = "$var wire 1 % x [2147483647:-2147483648] $end\n";
    cases.extend(each("a range of all numbers", &dump(range, &body), Anything));
    let width = "$var wire 4294967295 % x $end\n";
    cases.extend(each("four thousand million bits", &dump(width, &body), Anything));
    let blank = format!("{}{}", "\n".repeat(2_000_000), dump("", &body));
    cases.extend(each("two million blank lines", &blank, Anything));
    let name = "$var wire 1 % \u{1b}]0;x\u{7} $end\n$var wire 1 & \u{202e}tset $end\n";
    cases.extend(each("names with escapes", &dump(name, &body), Anything));
    cases.extend(each(
        "declarations without end",
        &"$var wire 1 ! a $end\n".repeat(200_000),
        Refused,
    ));
    cases.extend(each(
        "a comment without end",
        &dump(&"$comment ".repeat(300_000), &body),
        Anything,
    ));
    let dense = pieces((0..3_000_000).map(|i| format!("#{i}\n{}!\n", i % 2)));
    cases.extend(each("six million lines of one train", &dump("", &dense), Anything));
    cases
}
