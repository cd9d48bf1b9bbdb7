//! Hostile binary files: Parquet, EEPROM images, archives, `NumPy`, ledgers and journals.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Wanted::{Anything, Refused};
use super::{Case, text};
use crate::support::command::repository;

pub(super) fn cases() -> Vec<Case> {
    [parquet(), images(), arrays(), ledgers(), leftovers()].into_iter().flatten().collect()
}

fn parquet() -> Vec<Case> {
    let folder = repository().join("tests/cases/parquet");
    let entries = std::fs::read_dir(folder).expect("the files are there");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("an entry").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|tail| tail == "parquet"));
    paths.sort();
    let mut chance = ChaCha8Rng::seed_from_u64(16);
    let mut cases = Vec::new();
    for round in 0..60_usize {
        let path = &paths[round % paths.len()];
        let mut bytes = std::fs::read(path).expect("it is there");
        for _ in 0..=round % 4 {
            let at = chance.random_range(4..bytes.len());
            // Sizes and counts are small integers of Thrift: a high bit makes them enormous.
            bytes[at] = [0xff, 0x80, 0x7f, chance.random()][round / 4 % 4];
        }
        if round % 7 == 0 {
            bytes.truncate(chance.random_range(4..bytes.len()));
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        cases.push(Case::new(
            format!("{name}, changed {round}"),
            vec![("data.parquet", bytes)],
            &["compare", "machine.toml", "data.parquet"],
            Anything,
        ));
    }
    cases
}

fn images() -> Vec<Case> {
    let mut chance = ChaCha8Rng::seed_from_u64(17);
    let mut cases = Vec::new();
    for round in 0..24_usize {
        let length = [0, 1, 15, 16, 2048, 4096, 65_536, 900_000][round % 8];
        let mut bytes: Vec<u8> = (0..length).map(|_| chance.random()).collect();
        if round % 3 == 0 {
            let hex = |chunk: &[u8]| text(chunk.iter().map(|b| format!("{b:02X}")));
            let lines = bytes.chunks(16).map(|chunk| format!(":10{}\n", hex(chunk)));
            bytes = format!(":{}", text(lines)).into_bytes();
        }
        let files = vec![("image.bin", bytes)];
        let words = ["scale", "apply", "image.bin", "good.csv"];
        cases.push(Case::new(format!("an image by chance, {round}"), files, &words, Refused));
    }
    cases
}

/// Arrays of `NumPy` whose shape is not that of their data, and archives.
fn arrays() -> Vec<Case> {
    let array = |descr: &str, shape: &str| {
        let header = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}\n");
        let length = u16::try_from(header.len()).expect("short");
        [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..], header.as_bytes(), &[0; 64]].concat()
    };
    let shapes = [
        "(18446744073709551615,)",
        "(4294967296, 4294967296)",
        "(1000000000, 0)",
        "(0,)",
        "(-1,)",
        "(9223372036854775807, 2)",
        "((8,),)",
        "(",
        "(8, 1, 1)",
        "(100000000000,)",
    ];
    let mut cases: Vec<Case> = shapes
        .iter()
        .map(|shape| {
            let files = vec![("data.npy", array("'<f8'", shape))];
            Case::new(format!("an array of {shape}"), files, &["import", "data.npy"], Refused)
        })
        .collect();
    for (name, start) in [("xlsx", &b"PK\x03\x04"[..]), ("ods", b"PK\x05\x06"), ("gz", b"\x1f\x8b")]
    {
        let bytes = [start, &[0xff; 4096]].concat();
        let files = vec![("data.xlsx", bytes)];
        cases.push(Case::new(format!("a broken {name}"), files, &["import", "data.xlsx"], Refused));
    }
    cases
}

fn ledgers() -> Vec<Case> {
    let deep = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    let texts = [
        ("deep", deep),
        ("nothing", String::new()),
        ("a number", "7".into()),
        ("rounds that are no list", "{\"rounds\": 7}".into()),
        ("rounds that are no rounds", "{\"rounds\": [1, [2], null]}".into()),
        ("rounds of strings", "{\"rounds\": [\"a\", \"b\"]}".into()),
        ("a machine that is none", "{\"rounds\": [{\"machine\": 1}, {\"machine\": 2}]}".into()),
        ("rounds without anything", "{\"rounds\": [{}, {}, {}]}".into()),
    ];
    let case = |(name, ledger): (&str, String)| {
        let files = vec![("ledger.json", ledger.into_bytes())];
        Case::new(format!("a ledger, {name}"), files, &["learn", "--undo", "-o", "."], Refused)
    };
    texts.into_iter().map(case).collect()
}

/// What another command is said to have left.
fn leftovers() -> Vec<Case> {
    let journals = [
        "[[\".helixlock-1\", \"../../escaped\"]]",
        "[[\"../good.csv\", \"stolen\"]]",
        "[[\"good.csv\", \"stolen\"]]",
        "[[\".helixlock-1\", \"/etc/escaped\"]]",
        "{",
        "7",
    ];
    let mut cases: Vec<Case> = journals
        .iter()
        .map(|text| {
            let files = vec![(".helixlock-commit", text.as_bytes().to_vec())];
            let words = ["screw", "good.csv", "--lead", "6 mm", "-o", "."];
            Case::new(format!("a journal of names: {text}"), files, &words, Refused)
        })
        .collect();
    for (name, text) in [
        ("of another sweep", "# helixlock sweep 0123456789abcdef\n1,2\n"),
        ("of no sweep", "# made by hand\n"),
        ("of zeros", "\0\0\0\0\0\0\n"),
    ] {
        let files = vec![("out.csv.journal", text.as_bytes().to_vec())];
        let words = [
            "sweep",
            "machine.toml",
            "--length",
            "0.2",
            "--set",
            "drive.frequency=80,160 Hz",
            "-o",
            "out.csv",
        ];
        cases.push(Case::new(format!("a journal {name}"), files, &words, Refused));
    }
    cases
}
