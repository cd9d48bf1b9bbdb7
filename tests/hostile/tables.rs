//! Hostile tables of text.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Wanted::{Anything, Refused};
use super::{Case, Wanted, good_table, text};

/// Commands that read a table, each as it would be used.
const READERS: &[&[&str]] = &[
    &["compare", "machine.toml", "data.csv"],
    &["diagnose", "machine.toml", "data.csv"],
    &["screw", "data.csv", "--lead", "6 mm"],
    &["straightness", "data.csv", "--spacing", "10 mm,15 mm"],
    &["scale", "iso230", "data.csv"],
    &["scale", "build", "data.csv", "-o", "image.bin"],
    &["transmission", "data.csv", "--input-lines", "100", "--output-lines", "100", "--ratio", "2"],
    &["import", "data.csv"],
];

fn each(name: &str, bytes: &[u8], wanted: Wanted) -> Vec<Case> {
    let case = |words: &&[&str]| {
        let name = format!("{name}: {}", words[..2].join(" "));
        Case::new(name, vec![("data.csv", bytes.to_vec())], words, wanted)
    };
    READERS.iter().map(case).collect()
}

fn one(name: String, bytes: Vec<u8>, reader: usize, wanted: Wanted) -> Case {
    Case::new(name, vec![("data.csv", bytes)], READERS[reader % READERS.len()], wanted)
}

fn table(rows: impl Iterator<Item = String>) -> Vec<u8> {
    format!("position_mm,error_um\n{}", text(rows)).into_bytes()
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for columns in [5_000, 200_000] {
        let names: Vec<_> = (0..columns).map(|index| format!("c{index}")).collect();
        let row = vec!["1"; columns].join(",");
        let text = format!("{}\n{row}\n{row}\n", names.join(","));
        cases.extend(each(&format!("{columns} columns"), text.as_bytes(), Refused));
    }
    let named = format!("position_mm,\"{}\"\n0,1\n1,2\n", "\u{1b}[2J\u{9b}31m".repeat(5));
    cases.extend(each("escapes in a name", named.as_bytes(), Refused));
    let turned = "position_mm,\u{202e}mu_rorre\n0,1\n1,x\n".as_bytes();
    cases.extend(each("a name that turns the line", turned, Refused));
    let long = format!("position_mm,{}\n0,1\n1,x\n", "n".repeat(5_000_000));
    cases.extend(each("a name of 5 MB", long.as_bytes(), Refused));
    let rows = text((0..400).map(|i| format!("{i},{},{i}\n", i % 7)));
    let beside = format!("position_mm,lead_error_um,{}\n{rows}", "n".repeat(5_000_000));
    cases.extend(each("a name of 5 MB beside good ones", beside.as_bytes(), Refused));
    let cell = format!("position_mm,error_um\n0,{}\n1,2\n", "9".repeat(3_000_000));
    cases.extend(each("a number of 3 million digits", cell.as_bytes(), Refused));
    let small = table((0..100).map(|i| format!("{i},{}e-320\n", i % 7)));
    cases.extend(each("numbers below the normal ones", &small, Anything));
    let large = table((0..100).map(|i| format!("{i},{}e29\n", i % 7)));
    cases.extend(each("the largest numbers", &large, Anything));
    let beyond = table((0..100).map(|i| format!("{i},{}e31\n", i % 7)));
    cases.extend(each("numbers beyond the largest", &beyond, Refused));
    let far = table((0..100).map(|i| format!("{},{}\n", 1e29 + f64::from(i), i % 7)));
    cases.extend(each("positions that cannot be told apart", &far, Anything));
    let same = table((0..2000).map(|i| format!("5,{}\n", i % 7)));
    cases.extend(each("one position", &same, Anything));
    cases.extend(each("one row", b"position_mm,error_um\n1,2\n", Anything));
    let empty = table((0..500).map(|i| format!("{i},\n")));
    cases.extend(each("a column of gaps", &empty, Refused));
    let blank = [b"\n".repeat(3_000_000), good_table()].concat();
    cases.extend(each("three million blank lines", &blank, Anything));
    let open = [good_table(), b"1,\"".to_vec(), b"x\n".repeat(500_000)].concat();
    cases.extend(each("a quote open to the end", &open, Refused));
    cases.extend(each("carriage returns", &b"a,b\r1,2\r".repeat(20_000), Refused));
    cases.extend(broken());
    cases
}

/// The good table with bytes changed, by chance.
fn broken() -> Vec<Case> {
    let mut chance = ChaCha8Rng::seed_from_u64(15);
    let mut changed = |seed: usize| {
        let mut bytes = good_table();
        for _ in 0..=seed % 5 {
            let at = chance.random_range(0..bytes.len());
            bytes[at] = chance.random();
        }
        one(format!("bytes changed, {seed}"), bytes, seed, Anything)
    };
    (0..64).map(&mut changed).collect()
}
