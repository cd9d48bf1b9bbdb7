//! `helixlock gen` puts the device on every board, and its test bench is worth something.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

const MACHINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/sg7430-6mm/machine.toml");

fn generate(machine: &Path, output: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["gen", "--json"])
        .arg(machine)
        .arg("-o")
        .arg(output)
        .args(words)
        .output()
        .expect("helixlock starts")
}

fn failure(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The headline's machine file with some text exchanged.
fn machine_with(folder: &TempDir, from: &str, to: &str) -> std::path::PathBuf {
    let path = folder.path().join("machine.toml");
    let text = fs::read_to_string(MACHINE).expect("the example is there");
    assert!(text.contains(from), "{from}");
    write(&path, &text.replace(from, to));
    path
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
fn write(path: &Path, text: &str) {
    fs::write(path, text).expect("the scratch folder is writable");
}

/// Builds the bitstream and returns what was said of it.
fn synthesised(board: &str) -> Value {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let output = generate(Path::new(MACHINE), folder.path(), &["--board", board, "--synth"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bitstream = fs::read(folder.path().join("build/board_shell.bin")).expect("the bitstream");
    assert_eq!(bitstream.get(..4), Some(&[0xff, 0, 0, 0xff][..]), "preamble of an iCE40 image");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn fits_the_smallest_board_with_room() {
    let said = synthesised("icestick");
    let synthesis = &said["synthesis"];
    assert_eq!(synthesis["cells_available"], 1280);
    let cells = synthesis["cells"].as_u64().unwrap();
    assert!((100..640).contains(&cells), "at most half of an HX1K, not {cells}");
    assert!(24.0 < synthesis["max_clock_mhz"].as_f64().unwrap(), "twice the board's clock");
    assert_eq!(said["settings"]["divide_a"], 110);
    assert_eq!(said["settings"]["divide_b"], 150);
}

#[test]
fn builds_for_every_other_board() {
    for (board, clock_hz) in [
        ("icebreaker", 12_000_000),
        ("hx8k", 12_000_000),
        ("upduino", 12_000_000),
        ("tinyfpga-bx", 16_000_000),
    ] {
        let said = synthesised(board);
        assert_eq!(said["clock_hz"], clock_hz, "{board}");
        assert_eq!(said["synthesis"]["meets_clock"], true, "{board}");
    }
}

#[test]
fn the_same_machine_gives_the_same_bytes() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let [one, other] = ["one", "other"].map(|name| {
        let output = folder.path().join(name);
        assert!(generate(Path::new(MACHINE), &output, &["--synth"]).status.success());
        ["build/board_shell.bin", "rtl/device.v", "test/vectors.txt", "Makefile"]
            .map(|file| fs::read(output.join(file)).unwrap())
    });
    assert!(one == other);
}

#[test]
fn the_test_bench_passes_and_finds_a_fault() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    // A fast step clock keeps the test short.
    let machine = machine_with(&folder, "frequency = \"", "frequency = \"20");
    let output = folder.path().join("out");
    let generated = generate(&machine, &output, &[]);
    assert!(generated.status.success(), "{}", String::from_utf8_lossy(&generated.stderr));
    let simulate = || Command::new("make").arg("sim").current_dir(&output).output().unwrap();
    let passed = simulate();
    assert!(passed.status.success(), "{}", String::from_utf8_lossy(&passed.stderr));
    assert!(String::from_utf8_lossy(&passed.stdout).contains("PASS"));

    let counter = output.join("rtl/reset_counter.v");
    let sound = fs::read_to_string(&counter).unwrap();
    let faulty = sound.replace("magnitude_q + 12'h1", "magnitude_q + 12'h2");
    assert_ne!(sound, faulty);
    write(&counter, &faulty);
    let failed = simulate();
    assert!(!failed.status.success());
    assert!(String::from_utf8_lossy(&failed.stdout).contains("FAIL clock "));
}

#[test]
fn a_clock_that_is_not_the_boards_is_refused() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let machine = machine_with(&folder, "clock = \"12 MHz\"", "clock = \"25 MHz\"");
    let said = failure(&generate(&machine, &folder.path().join("out"), &[]));
    assert!(
        said.contains("fpga.clock is 25 MHz, but the board `icestick` runs at 12 MHz"),
        "{said}"
    );
    assert!(!folder.path().join("out").exists(), "nothing is left behind");
}

#[test]
fn an_unknown_board_is_answered_with_the_known_ones() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let output = generate(Path::new(MACHINE), folder.path(), &["--board", "arty"]);
    assert_eq!(
        failure(&output),
        "helixlock: board `arty` is not known; expected one of icestick, icebreaker, hx8k, \
         upduino, tinyfpga-bx\n"
    );
}

#[test]
fn a_missing_tool_is_named_with_its_package() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let output = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["gen", MACHINE, "--synth", "-o"])
        .arg(folder.path().join("out"))
        .env("PATH", folder.path())
        .output()
        .unwrap();
    assert_eq!(
        failure(&output),
        "helixlock: `yosys` is not installed\nhint: on Debian it is in the package `yosys`\n"
    );
    assert!(!folder.path().join("out").exists(), "nothing is left behind");
}

#[test]
fn the_help_names_the_boards_of_the_folder() {
    let help = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["gen", "--help"])
        .output()
        .expect("helixlock starts");
    let help = String::from_utf8(help.stdout).expect("help is text");
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/constraints");
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let text = fs::read_to_string(entry.expect("it can be listed").path()).expect("text");
        let name = text.lines().find_map(|line| line.strip_prefix("# board:")).expect("a name");
        assert!(help.contains(name.trim()), "{name}: {help}");
    }
}
