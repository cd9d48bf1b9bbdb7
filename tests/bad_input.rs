//! Whatever is wrong with a machine file is said with its place, and nothing is written.
//!
//! Every `cases/bad-input/<name>.toml` stands beside `<name>.stderr`, what `helixlock sim` says of
//! it. `UPDATE_EXPECT=1 cargo test bad_input` writes messages that have changed.

use std::path::{Path, PathBuf};
use std::process::Command;

use expect_test::expect_file;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/bad-input")
}

/// Machine files of the folder, in order of name.
fn cases() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).expect("the folder of cases");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut cases: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|tail| tail == "toml")).collect();
    cases.sort();
    cases
}

#[test]
fn machine_files_are_refused_with_place_and_reason() {
    let cases = cases();
    assert!(100 < cases.len(), "{} cases", cases.len());
    let results = tempfile::tempdir().expect("a temporary folder");
    for case in cases {
        let name = case.file_name().expect("a file");
        let output = Command::new(env!("CARGO_BIN_EXE_helixlock"))
            .current_dir(folder())
            .arg("sim")
            .arg(name)
            .arg("--output")
            .arg(results.path().join("out"))
            .output()
            .expect("the command starts");
        assert_eq!(output.status.code(), Some(2), "{}", case.display());
        assert!(output.stdout.is_empty(), "{}", case.display());
        let said = String::from_utf8(output.stderr).expect("text");
        expect_file![case.with_extension("stderr")].assert_eq(&said);
        assert!(!results.path().join("out").exists(), "{}", case.display());
    }
}

#[test]
fn every_message_belongs_to_a_case() {
    for entry in std::fs::read_dir(folder()).expect("the folder of cases") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|tail| tail == "stderr") {
            assert!(path.with_extension("toml").exists(), "{} has no machine file", path.display());
        }
    }
}

/// Machine files, data files and command lines that are wrong, each with the message it gets.
#[test]
fn there_are_hundreds_of_cases() {
    let shown = |name: &str, mark: &str| {
        let path = folder().with_file_name(name);
        let text = std::fs::read_to_string(&path).expect("the table is there");
        text.lines().filter(|line| line.starts_with(mark)).count()
    };
    let data = ["csv", "kinds", "parquet", "vcd"];
    let data: usize = data.iter().map(|kind| shown(&format!("bad-data/{kind}.txt"), "=> ")).sum();
    let (machines, words) = (cases().len(), shown("command-line.txt", "$ "));
    assert!(100 < machines && 170 < data && 60 < words, "{machines}, {data}, {words}");
}
