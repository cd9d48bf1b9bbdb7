//! Malformed data files, each with the message its user gets.
//!
//! `tests/cases/bad-data/*.txt` holds inputs and messages side by side; a change of either shows
//! there. `UPDATE_EXPECT=1` rewrites them, for a person to read.

mod csv_cases;
mod parquet_cases;
mod vcd_cases;

use std::fmt::Write;
use std::path::Path;

use expect_test::expect_file;
use helixlock_traces::capture::capture_edges;
use helixlock_traces::csv::read_csv;
use helixlock_traces::parquet::read_parquet;
use helixlock_traces::{TraceError, read_table};

/// A name that says what is wrong, and the bytes.
type Case = (&'static str, Vec<u8>);

/// Input and message of every case; a case that is accepted fails.
fn table(cases: &[Case], refuse: impl Fn(&[u8]) -> Option<String>) -> String {
    let mut text = String::new();
    for (index, (name, bytes)) in cases.iter().enumerate() {
        assert!(cases[..index].iter().all(|(earlier, _)| earlier != name), "{name} comes twice");
        let message = refuse(bytes).unwrap_or_else(|| panic!("{name}: accepted"));
        let shown =
            if bytes.len() < 600 { bytes.escape_ascii().to_string() } else { String::new() };
        writeln!(text, "# {name}").expect("memory takes it");
        for line in shown.replace("\\n", "\\n\n").lines() {
            writeln!(text, "  {line}").expect("memory takes it");
        }
        writeln!(text, "=> {}\n", message.replace("\n\n", "\n   ")).expect("memory takes it");
    }
    text
}

/// The message, held to the form all messages have: the place, what was found, what was expected.
fn message(error: &TraceError, path: &str) -> String {
    let message = error.to_string();
    assert!(message.starts_with(path), "{message}");
    assert!(["expected", "cannot", "twice"].iter().any(|word| message.contains(word)), "{message}");
    let line = message.lines().next().unwrap_or_default();
    assert!(!line.ends_with('.') && line.len() < 400, "{message}");
    message
}

#[test]
fn comma_separated_text() {
    let cases = csv_cases::cases();
    let refuse =
        |bytes: &[u8]| Some(message(&read_csv(bytes, Path::new("data.csv")).err()?, "data.csv"));
    expect_file!["cases/bad-data/csv.txt"].assert_eq(&table(&cases, refuse));
}

#[test]
fn value_change_dumps() {
    let cases = vcd_cases::cases();
    let refuse = |bytes: &[u8]| {
        Some(message(&capture_edges(bytes, Path::new("wave.vcd")).err()?, "wave.vcd"))
    };
    expect_file!["cases/bad-data/vcd.txt"].assert_eq(&table(&cases, refuse));
}

#[test]
fn parquet() {
    let cases = parquet_cases::cases();
    let refuse = |bytes: &[u8]| {
        let error = read_parquet(bytes.to_vec(), Path::new("data.parquet")).err()?;
        Some(message(&error, "data.parquet"))
    };
    expect_file!["cases/bad-data/parquet.txt"].assert_eq(&table(&cases, refuse));
}

/// A column of words is left out and remembered, plain or in a dictionary, as in a text file.
#[test]
fn words_in_parquet_are_those_of_a_text_file() {
    let text = read_csv(b"time_s,note\n1,a\n2,b\n", Path::new("data.csv")).expect("a table");
    for file in ["text.parquet", "dictionary_text.parquet"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/parquet").join(file);
        let table = read_table(&path).expect("a table");
        assert_eq!(table.columns, text.columns, "{file}");
        let [words, expected] = [&table, &text].map(|table| &table.text[0]);
        assert_eq!((&words.name, &words.first), (&expected.name, &expected.first), "{file}");
    }
}

#[test]
fn files_of_other_kinds() {
    let kinds: [(&str, &[u8]); 13] = [
        ("a spreadsheet", b"PK\x03\x04\x14\0\x06\0"),
        ("an old spreadsheet", b"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"),
        ("a compressed file", b"\x1F\x8B\x08\0"),
        ("an HDF5 file", b"\x89HDF\r\n\x1A\n"),
        ("an Arrow file", b"ARROW1\0\0"),
        ("UTF-16, little end first", b"\xFF\xFEt\0"),
        ("UTF-16, big end first", b"\xFE\xFF\0t"),
        ("an encrypted Parquet file", b"PARE"),
        ("a dump for a table", b"$date\n  today\n$end\n"),
        ("a dump without a date", b"$timescale 1ns $end\n"),
        ("JSON", b"{\"time_s\": [1, 2]}\n"),
        ("a page", b"<!DOCTYPE html>\n"),
        ("zeros", b"time_s\n1\n\0\0\0\0"),
    ];
    let cases: Vec<Case> = kinds.iter().map(|(name, bytes)| (*name, bytes.to_vec())).collect();
    let folder = tempfile::tempdir().expect("a folder can be made");
    let file = folder.path().join("data.csv");
    let refuse = |bytes: &[u8]| {
        let mut kept = tempfile::NamedTempFile::new_in(&folder).expect("a file can be made");
        std::io::Write::write_all(&mut kept, bytes).expect("it can be written");
        kept.persist(&file).expect("it can be renamed");
        let error = read_table(&file).err()?;
        let path = file.to_str().expect("a plain name");
        Some(message(&error, path).replace(path, "data.csv"))
    };
    expect_file!["cases/bad-data/kinds.txt"].assert_eq(&table(&cases, refuse));
}
