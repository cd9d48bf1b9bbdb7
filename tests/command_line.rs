//! The command as its users meet it: exit status, what it says, what it leaves behind.
//!
//! `tests/cases/command-line.txt` holds wrong words and the answers side by side;
//! `UPDATE_EXPECT=1` rewrites it, for a person to read.

use std::fmt::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use expect_test::expect_file;
use helixlock_evidence::same_output::STORIES;
use proptest::prelude::*;

/// Runs `helixlock` with these words in a folder.
fn helixlock(folder: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(words)
        .current_dir(folder)
        .env("COLUMNS", "100")
        .output()
        .expect("the command starts")
}

/// The subcommands that `helixlock --help` lists.
fn subcommands() -> Vec<String> {
    let help = helixlock(Path::new("."), &["--help"]);
    let text = String::from_utf8(help.stdout).expect("help is text");
    let lines = text.lines().skip_while(|line| *line != "Commands:").skip(1);
    let names = lines
        .take_while(|line| !line.is_empty())
        .filter(|line| !line.starts_with("   ")) // the rest of a summary
        .filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(Into::into).collect()
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder with a good table, a good machine and files that are wrong in one way each.
fn workplace() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let machine = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/sg7430-6mm/machine.toml");
    let machine = std::fs::read(machine).expect("the example is there");
    let rows: Vec<_> = (0..400).map(|i| format!("{i},{}\n", f64::from(i % 7) / 8.0)).collect();
    let data = format!("position_mm,lead_error_um\n{}", rows.concat());
    let files: [(&str, &[u8]); 9] = [
        ("machine.toml", &machine),
        ("data.csv", data.as_bytes()),
        ("cut.csv", b"position_mm,lead_error_um\n0,0.1\n1"),
        ("comma.csv", b"position_mm;lead_error_um\n0,5;0,1\n"),
        ("nan.csv", b"position_mm,lead_error_um\n0,0.1\n1,NaN\n"),
        ("huge.csv", b"position_mm,lead_error_um\n0,1e308\n1,-1e308\n"),
        ("other.csv", b"height_mm\n1\n2\n"),
        ("sheet.csv", b"PK\x03\x04\x14\0"),
        ("wave.vcd", b"$timescale 1ns $end\n$enddefinitions $end\n#5\n#4\n"),
    ];
    for (name, bytes) in files {
        std::fs::copy(kept(bytes).path(), folder.path().join(name)).expect("it can be copied");
    }
    folder
}

fn kept(bytes: &[u8]) -> tempfile::NamedTempFile {
    let mut file = tempfile::NamedTempFile::new().expect("a file can be made");
    std::io::Write::write_all(&mut file, bytes).expect("it can be written");
    file
}

/// Names of what lies in a folder.
fn listing(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder is there");
    let mut names: Vec<_> = entries
        .map(|entry| entry.expect("it can be listed").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// Words that are wrong, each with exit status 2 and a message.
const WRONG: &[&[&str]] = &[
    &["grind"],
    &["--frobnicate"],
    &["sim"],
    &["sim", "nosuch.toml", "-o", "out"],
    &["sim", ".", "-o", "out"],
    &["sim", "data.csv", "-o", "out"],
    &["sim", "machine.toml", "-o", "data.csv"],
    &["sim", "machine.toml", "-o", "out", "--from", "later"],
    &["screw"],
    &["screw", "nosuch.csv", "--lead", "5 mm"],
    &["screw", ".", "--lead", "5 mm"],
    &["screw", "data.csv"],
    &["screw", "data.csv", "--lead", "-5 mm"],
    &["screw", "data.csv", "--lead", "five mm"],
    &["screw", "data.csv", "--lead", "5 kg"],
    &["screw", "data.csv", "--lead", "5 mm", "--standard", "iso9001"],
    &["screw", "data.csv", "--lead", "5 mm", "--grade", "2.5"],
    &["screw", "cut.csv", "--lead", "5 mm"],
    &["screw", "comma.csv", "--lead", "5 mm"],
    &["screw", "nan.csv", "--lead", "5 mm"],
    &["screw", "huge.csv", "--lead", "5 mm"],
    &["screw", "other.csv", "--lead", "5 mm"],
    &["screw", "sheet.csv", "--lead", "5 mm"],
    &["screw", "wave.vcd", "--lead", "5 mm"],
    &["screw", "machine.toml", "--lead", "5 mm"],
    &["straightness", "data.csv"],
    &["straightness", "nosuch.csv", "--spacing", "10 mm,15 mm"],
    &["straightness", "other.csv", "--spacing", "10 mm,15 mm"],
    &["straightness", "cut.csv", "--spacing", "10 mm,15 mm"],
    &["straightness", "data.csv", "--spacing", "10 mm"],
    &["scale", "build", "data.csv"],
    &["scale", "build", "nosuch.csv", "-o", "table.bin"],
    &["scale", "build", "cut.csv", "-o", "table.bin"],
    &["scale", "build", "other.csv", "-o", "table.bin"],
    &["scale", "apply", "nosuch.bin", "data.csv"],
    &["scale", "apply", "machine.toml", "data.csv"],
    &["dividers"],
    &["dividers", "--lead", "six mm"],
    &["dividers", "--lead", "6 kg"],
    &["dividers", "--lead", "0 mm"],
    &["dividers", "--lead", "-6 mm"],
    &["dividers", "--lead", "1/0 in"],
    &["dividers", "--lead", "6 mm", "--lines", "0"],
    &["dividers", "--lead", "6 mm", "--wavelength", "0.63 s"],
    &["dividers", "--find-lines", "--lead", "6 mm", "--min-lines", "20000", "--max-lines", "5000"],
    &["effects", "friction"],
    &["effects", "abbe", "cosine"],
    &["compare", "machine.toml"],
    &["compare", "machine.toml", "nosuch.csv"],
    &["compare", "nosuch.toml", "data.csv"],
    &["compare", "data.csv", "machine.toml"],
    &["compare", "machine.toml", "cut.csv"],
    &["compare", "machine.toml", "other.csv"],
    &["diagnose", "machine.toml", "nan.csv"],
    &["diagnose", "machine.toml", "comma.csv"],
    &["diagnose", "machine.toml", "other.csv"],
    &["add", "machine.toml", "friction", "-o", "new.toml"],
    &["add", "machine.toml", "abbe", "--fit", "nosuch.csv", "-o", "new.toml"],
    &["learn", "machine.toml", "sheet.csv", "-o", "out"],
    &["learn", "machine.toml", "other.csv", "-o", "out"],
    &["gen", "machine.toml", "--board", "breadboard", "-o", "out"],
    &["gen", "nosuch.toml", "--board", "icestick", "-o", "out"],
    &["gen", "machine.toml", "--board", "icestick", "-o", "data.csv"],
    &["transmission", "nosuch.vcd", "--input-lines", "100", "--output-lines", "100"],
    &["transmission", "wave.vcd", "--input-lines", "100", "--output-lines", "100"],
    &["transmission", "cut.csv", "--input-lines", "100", "--output-lines", "100"],
    &["transmission", "data.csv", "--input-lines", "0", "--output-lines", "100"],
    &[
        "transmission",
        "data.csv",
        "--input-lines",
        "100",
        "--output-lines",
        "100",
        "--method",
        "guess",
    ],
    &[
        "transmission",
        "data.csv",
        "--input-lines",
        "100",
        "--output-lines",
        "100",
        "--ratio",
        "5/0",
    ],
];

#[test]
fn wrong_words_are_answered_with_status_2_and_a_message() {
    let folder = workplace();
    let before = listing(folder.path());
    let mut text = String::new();
    for words in WRONG {
        let output = helixlock(folder.path(), words);
        let said = error(&output);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        assert!(output.stdout.is_empty(), "{words:?} prints results");
        assert!(!said.trim().is_empty() && !said.contains("panicked"), "{words:?}: {said}");
        assert_eq!(listing(folder.path()), before, "{words:?} leaves files");
        writeln!(text, "$ helixlock {}\n{said}", words.join(" ")).expect("memory takes it");
    }
    expect_file!["cases/command-line.txt"].assert_eq(&text);
}

#[test]
fn every_subcommand_helps_and_refuses_what_it_does_not_know() {
    let names = subcommands();
    assert!(names.len() > 3, "{names:?}");
    for name in &names {
        let help = helixlock(Path::new("."), &[name, "--help"]);
        assert_eq!(help.status.code(), Some(0), "{name}");
        assert!(String::from_utf8_lossy(&help.stdout).contains("Usage:"), "{name}");
        let unknown = helixlock(Path::new("."), &[name, "--frobnicate"]);
        assert_eq!(unknown.status.code(), Some(2), "{name}");
        assert!(error(&unknown).contains("--frobnicate"), "{name}: {}", error(&unknown));
    }
}

#[test]
fn the_manual_names_no_page_that_it_lacks() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let run = helixlock(folder.path(), &["man", "-o", "man"]);
    assert_eq!(run.status.code(), Some(0), "{}", error(&run));
    let pages = folder.path().join("man");
    for (page, other) in
        [("helixlock", "helixlock-sim"), ("helixlock-board", "helixlock-board-set")]
    {
        let text = std::fs::read_to_string(pages.join(format!("{page}.1"))).expect("a page");
        let text = text.replace('\\', "");
        assert!(text.contains(&format!("{other}(1)")), "{text}");
        assert!(!text.contains("-help(1)"), "{page}");
    }
}

/// `helixlock … | head -1` is no error.
#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let folder = workplace();
    let mut child = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["screw", "data.csv", "--lead", "5 mm", "--json"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the command ends");
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", error(&output));
    assert_eq!(error(&output), "");
}

#[test]
fn the_same_words_print_the_same_bytes() {
    let folder = workplace();
    let words = ["screw", "data.csv", "--lead", "5 mm", "--json"];
    let [one, two] = [0, 1].map(|_| helixlock(folder.path(), &words));
    assert_eq!(one.stdout, two.stdout);
    serde_json::from_slice::<serde_json::Value>(&one.stdout).expect("it is JSON");
}

/// Cells as people and machines write them, good and bad.
fn cell() -> impl Strategy<Value = String> {
    prop_oneof![
        8 => (-1e3..1e3_f64).prop_map(|number| number.to_string()),
        1 => any::<f64>().prop_map(|number| number.to_string()),
        1 => "[ -~]{0,6}",
        1 => Just(String::new()),
    ]
}

fn table() -> impl Strategy<Value = String> {
    let header = prop_oneof![
        4 => Just("position_mm,lead_error_um".to_owned()),
        1 => Just("time_s,error_um".to_owned()),
        1 => "[a-z_,]{0,20}",
    ];
    let rows = proptest::collection::vec((cell(), cell()), 0..30);
    (header, rows).prop_map(|(header, rows)| {
        let rows = rows.iter().map(|(one, other)| format!("{one},{other}\n"));
        format!("{header}\n{}", rows.collect::<String>())
    })
}

/// `cargo xtask same-output` would not see what a command without a story does.
#[test]
fn every_command_has_a_story_to_compare() {
    for command in subcommands() {
        let begin = format!("{command} ");
        let told = STORIES.lines().any(|line| line == command || line.starts_with(&begin));
        assert!(told, "`{command}` has no line in evidence/src/same_output/stories.txt");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(48) })]

    /// Whatever the table holds, there is an answer or a message, and never a panic.
    #[test]
    fn any_table_gets_an_answer(text in table()) {
        let file = kept(text.as_bytes());
        let path = file.path().to_str().expect("a plain name");
        for words in [&["screw", path, "--lead", "5 mm", "--json"][..], &["straightness", path, "--json"]] {
            let output = helixlock(Path::new("."), words);
            let said = error(&output);
            prop_assert!(!said.contains("panicked"), "{}", said);
            match output.status.code() {
                Some(0 | 1) => {
                    let json = serde_json::from_slice::<serde_json::Value>(&output.stdout);
                    prop_assert!(json.is_ok(), "{words:?} prints no JSON");
                }
                code => {
                    prop_assert_eq!(code, Some(2), "{}", said);
                    prop_assert!(output.stdout.is_empty() && !said.is_empty(), "{}", words[0]);
                }
            }
        }
    }
}
