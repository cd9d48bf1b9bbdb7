//! What fuzzing has collected is read again, every time: an answer or an error, never a panic.

use std::path::{Path, PathBuf};

use helixlock_plant::Model;
use helixlock_traces::capture::capture_edges;
use helixlock_traces::csv::read_csv;
use helixlock_traces::parquet::read_parquet;

/// The files of a target's corpus, and what they hold.
fn corpus(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let entries = std::fs::read_dir(&folder).expect("the corpus is there");
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("it can be listed").path()).collect();
    paths.sort();
    paths.into_iter().map(|path| (path.clone(), std::fs::read(&path).expect("it reads"))).collect()
}

/// Reads them all: some have to be taken, and an error names its file.
fn answers_all(target: &str, take: impl Fn(&Path, Vec<u8>) -> Result<(), String>) {
    let answers: Vec<_> =
        corpus(target).into_iter().map(|(path, bytes)| take(&path, bytes)).collect();
    assert!(answers.iter().any(Result::is_ok), "{target}: some are taken");
    for message in answers.into_iter().filter_map(Result::err) {
        assert!(message.contains(target), "{message}");
    }
}

#[test]
fn tables() {
    answers_all("csv", |path, bytes| {
        read_csv(&bytes, path).map(drop).map_err(|error| error.to_string())
    });
}

#[test]
fn parquet() {
    answers_all("parquet", |path, bytes| {
        read_parquet(bytes, path).map(drop).map_err(|error| error.to_string())
    });
}

#[test]
fn dumps() {
    answers_all("vcd", |path, bytes| {
        capture_edges(bytes.as_slice(), path).map(drop).map_err(|error| error.to_string())
    });
}

#[test]
fn machine_files() {
    answers_all("machine_file", |path, bytes| {
        let text = String::from_utf8_lossy(&bytes);
        Model::parse(&text, path).map(drop).map_err(|error| error.to_string())
    });
}
