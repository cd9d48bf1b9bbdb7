//! Runs the command as a user does.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// What a run of the command gave.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) status: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// The root of the repository.
pub(crate) fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A folder of its own for a test; it goes with the value.
pub(crate) fn scratch() -> TempDir {
    tempfile::tempdir().expect("a temporary folder can be made")
}

/// Runs `helixlock` with these words, at the root of the repository.
pub(crate) fn helixlock(words: &[&str]) -> Run {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    let output = command.current_dir(repository()).args(words).output();
    let Output { status, stdout, stderr } = output.expect("the command starts");
    Run {
        status: status.code().expect("no signal ended it"),
        stdout: String::from_utf8(stdout).expect("text"),
        stderr: String::from_utf8(stderr).expect("text"),
    }
}

/// Path of a file in a folder, as a word.
pub(crate) fn word(folder: &TempDir, name: &str) -> (PathBuf, String) {
    let path = folder.path().join(name);
    let word = path.to_str().expect("a path of text").to_owned();
    (path, word)
}

/// Writes a file for a test.
#[expect(clippy::disallowed_methods, reason = "a test makes its own input, in its own folder")]
pub(crate) fn put(path: &Path, text: &str) {
    std::fs::write(path, text).expect("the folder of the test takes files");
}

/// Every so many of an example's samples, in a file of a folder, as a word: what is asked for the sake of
/// its report alone is asked of few.
pub(crate) fn few_samples(folder: &Path, example: &str, one_in: usize) -> String {
    let own = repository().join("examples").join(example).join("data.csv");
    let own = std::fs::read_to_string(own).expect("the example is there");
    let (header, samples) = own.split_once('\n').expect("a header");
    let few: Vec<&str> = samples.lines().step_by(one_in).collect();
    let path = folder.join(format!("{example}.csv"));
    put(&path, &format!("{header}\n{}\n", few.join("\n")));
    path.to_str().expect("a path of text").to_owned()
}
