//! `helixlock gen` puts the device on every board, and its test bench is worth something.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use helixlock_gen::{Board, Family};
use serde_json::Value;
use tempfile::TempDir;

use crate::support::seeds::all_boards_are_asked;

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
fn synthesised(board: &str, folder: &Path) -> Value {
    let output = generate(Path::new(MACHINE), folder, &["--board", board, "--synth"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let family = Board::find(board).expect("a board there is").family;
    let name = format!("build/board_shell.{}", family.bitstream());
    let bitstream = fs::read(folder.join(name)).expect("the bitstream");
    assert!(is_bitstream(family, &bitstream), "{board}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// True when the mark is there with which the family's bitstreams begin.
fn is_bitstream(family: Family, bytes: &[u8]) -> bool {
    let mark: &[u8] = match family {
        Family::Ice40 => &[0xff, 0, 0, 0xff],
        Family::Ecp5 => &[0xff, 0xff, 0xbd, 0xb3],
        Family::Gowin => b"\n1010010111000011\n",
    };
    bytes[..512].windows(mark.len()).any(|found| found == mark)
}

/// Holds the README's table to what was built, by the yosys it names.
fn is_in_the_readme(board: &Board, said: &Value) {
    let version = Command::new("yosys").arg("-V").output().expect("yosys starts");
    if !String::from_utf8_lossy(&version.stdout).starts_with("Yosys 0.23 ") {
        return;
    }
    let built = &said["synthesis"];
    let number = |key: &str| built[key].as_f64().expect("a number");
    let row = format!(
        "| `{}` | {} | {} of {} | {} | {:.0} MHz | {} MHz |",
        board.name,
        board.chip(),
        built["cells"],
        built["cells_available"],
        built["flip_flops"],
        number("max_clock_mhz"),
        board.clock_mhz,
    );
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = fs::read_to_string(root.join("README.md")).expect("text");
    assert!(readme.contains(&row), "README.md has no row\n{row}");
}

#[test]
fn fits_the_smallest_board_with_room() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let said = synthesised("icestick", folder.path());
    let synthesis = &said["synthesis"];
    assert_eq!(synthesis["cells_available"], 1280);
    let cells = synthesis["cells"].as_u64().unwrap();
    assert!((100..1024).contains(&cells), "at most four fifths of an HX1K, not {cells}");
    assert!(24.0 < synthesis["max_clock_mhz"].as_f64().unwrap(), "twice the board's clock");
    is_in_the_readme(&Board::find("icestick").expect("a board there is"), &said);
    assert_eq!(said["settings"]["divide_a"], 110);
    assert_eq!(said["settings"]["divide_b"], 150);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_bitstream_has_the_same_bytes_twice() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let [one, other] = ["one", "other"].map(|name| folder.path().join(name));
    for folder in [&one, &other] {
        synthesised("icestick", folder);
    }
    for file in
        ["build/board_shell.bin", "rtl/device.v", "test/board_shell_vectors.txt", "Makefile"]
    {
        let [one, other] = [&one, &other].map(|folder| fs::read(folder.join(file)).unwrap());
        assert!(one == other, "{file}");
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn builds_for_every_other_board() {
    for board in Board::all().expect("boards").iter().filter(|board| board.name != "icestick") {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let said = synthesised(&board.name, folder.path());
        assert_eq!(said["clock_hz"], 1_000_000 * u64::from(board.clock_mhz), "{}", board.name);
        assert_eq!(said["synthesis"]["meets_clock"], true, "{}", board.name);
        is_in_the_readme(board, &said);
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_test_bench_passes_and_finds_a_fault() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    // A fast step clock and short debouncing keep the test short.
    let machine = machine_with(&folder, "frequency = \"", "frequency = \"20");
    let output = folder.path().join("out");
    let generated = generate(&machine, &output, &["--debounce", "1"]);
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
         upduino, tinyfpga-bx, ulx3s, colorlight-i5, orangecrab, tang-nano-9k, tang-nano-20k\n"
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
    for board in Board::all().expect("boards") {
        assert!(help.contains(&board.name), "{}: {help}", board.name);
    }
}

/// A core for others: its modules under a prefix, its ports said what for, its licence and how to
/// use it; linters and synthesis take it.
#[test]
fn a_prefix_goes_before_every_module() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let output = folder.path().join("out");
    assert!(generate(Path::new(MACHINE), &output, &["--prefix", "hl_"]).status.success());
    for entry in fs::read_dir(output.join("rtl")).expect("the Verilog is there") {
        let path = entry.expect("it can be listed").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let text = fs::read_to_string(&path).expect("text");
        assert!(name.starts_with("hl_") && text.contains(&format!("module {name} (")), "{name}");
        assert!(text.starts_with("// SPDX-License-Identifier: MIT OR Apache-2.0\n"), "{name}");
    }
    let device = fs::read_to_string(output.join("rtl/hl_device.v")).expect("text");
    assert!(device.contains("    // laser: interference fringes, likewise\n"), "{device}");
    let template = fs::read_to_string(output.join("templates/hl_device.v")).expect("text");
    assert!(template.contains("hl_device hl_device_0 (\n    .clock(),"), "{template}");
    let lint = Command::new("make").arg("lint").current_dir(&output).output().expect("make");
    assert!(lint.status.success(), "{}", String::from_utf8_lossy(&lint.stderr));
    let said = failure(&generate(Path::new(MACHINE), &output, &["--prefix", "7-"]));
    assert!(said.contains("`7-level_synchroniser` is no identifier"), "{said}");
}

/// The range of the machine file is in the design; pins are those that are asked for.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn pins_are_those_asked_for() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let pins = |words: &[&str]| {
        let output = generate(Path::new(MACHINE), folder.path(), words);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let shell = fs::read_to_string(folder.path().join("rtl/board_shell.v")).expect("text");
        let ports = said["pins"].as_array().expect("pins").iter();
        let ports = ports.map(|pin| pin["port"].as_str().expect("a port").to_owned());
        (ports.collect::<Vec<_>>(), shell)
    };
    let (plain, shell) = pins(&[]);
    assert!(shell.contains("localparam range_set = 1'b1;"), "{shell}");
    for pin in ["range_x2", "enable", "emergency_stop"] {
        assert!(!plain.iter().any(|port| port == pin), "{pin}");
    }
    let (all, shell) = pins(&["--pins", "range,enable,emergency-stop"]);
    assert!(shell.contains("localparam range_set = 1'b0;"), "{shell}");
    for pin in ["range_x2", "enable", "emergency_stop"] {
        assert!(all.iter().any(|port| port == pin), "{pin}");
    }
    assert_eq!(all.len(), plain.len() + 3);
    let encoders = ["grating-b", "laser-b", "grating-index", "laser-index"];
    let (encoded, shell) = pins(&["--board", "hx8k", "--pins", &encoders.join(",")]);
    for pin in encoders {
        let pin = pin.replace('-', "_");
        assert!(encoded.contains(&pin) && !plain.contains(&pin), "{pin}");
        assert!(shell.contains(&format!("localparam {pin}_wired = 1'b1;")), "{shell}");
    }
}

/// Settings over the serial port, where they are asked for and there is room; otherwise no trace.
#[test]
fn a_settings_port_is_there_when_asked_for() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let shell_of = |name: &str, words: &[&str]| {
        let output = folder.path().join(name);
        let run = generate(Path::new(MACHINE), &output, words);
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let port = output.join("rtl/settings_port.v").exists();
        (port, fs::read_to_string(output.join("rtl/board_shell.v")).expect("text"))
    };
    let (port, shell) = shell_of("without", &["--board", "hx8k"]);
    assert!(!port && !shell.contains("settings_port") && !shell.contains("rx"), "{shell}");
    assert!(shell.contains(".divide_a(divide_a),"), "{shell}");
    let (port, shell) = shell_of("with", &["--board", "hx8k", "--pins", "rx"]);
    assert!(port && shell.contains("input  wire         rx,"), "{shell}");

    let said = |words: &[&str]| failure(&generate(Path::new(MACHINE), folder.path(), words));
    assert_eq!(
        said(&["--pins", "rx"]),
        "helixlock: board `icestick` has no room for `rx`, expected one of icebreaker, hx8k, \
         upduino, tinyfpga-bx, ulx3s, colorlight-i5, tang-nano-9k, tang-nano-20k\n"
    );
    let both = said(&["--board", "hx8k", "--pins", "rx,range"]);
    assert!(both.contains("found the pins `rx` and `range`, expected one of them"), "{both}");
}

/// A logic analyser with its memory stands where the telemetry did; without it there is no trace.
#[test]
fn an_analyser_is_there_when_asked_for() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let has = |name: &str, words: &[&str]| {
        let output = folder.path().join(name);
        let run = generate(Path::new(MACHINE), &output, words);
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let blocks = ["logic_analyser", "sample_memory", "telemetry", "settings_port"];
        let there = blocks.map(|block| output.join(format!("rtl/{block}.v")).exists());
        (there, fs::read_to_string(output.join("rtl/board_shell.v")).expect("text"))
    };
    let (there, shell) = has("without", &["--board", "hx8k"]);
    assert_eq!(there, [false, false, true, false]);
    assert!(!shell.contains("analyser") && !shell.contains("memory"), "{shell}");
    let (there, shell) = has("with", &["--board", "hx8k", "--pins", "analyser"]);
    assert_eq!(there, [true, true, false, false]);
    assert!(shell.contains("input  wire         rx,") && shell.contains(".megahertz(7'hc),"));
    if all_boards_are_asked() {
        let with = folder.path().join("with");
        let said = Command::new("make").args(["sim-board_shell", "-C"]).arg(with).output();
        let said = said.expect("make starts");
        let text = String::from_utf8_lossy(&said.stdout).into_owned();
        assert!(said.status.success() && text.contains("PASS "), "{text}");
    }

    let said = |words: &[&str]| failure(&generate(Path::new(MACHINE), folder.path(), words));
    let none = said(&["--pins", "analyser"]);
    assert!(none.starts_with("helixlock: board `icestick` has no room for `analyser`"), "{none}");
    let both = said(&["--board", "hx8k", "--pins", "rx,analyser"]);
    assert!(both.contains("found the pins `rx` and `analyser`, expected one of them"), "{both}");
}

/// What is not there takes no block's place, and a memory stands beside a block that has one.
#[test]
fn what_is_not_there_is_not_exchanged() {
    let mut design = crate::golden_verilog::whole_design();
    let block = crate::golden_verilog::design_of("logic_analyser");
    let said = |result: Result<(), helixlock_gen::GenError>| result.unwrap_err().to_string();
    let new = ("analyser", &block);
    let mut exchanged = |old, inputs: &[_]| helixlock_gen::exchange(&mut design, old, new, inputs);
    assert_eq!(said(exchanged("nobody", &[])), "block `nobody` is not one of the design");
    let nowhere = [("ready", helixlock_gen::Source::Signals(&["nowhere"]))];
    assert_eq!(said(exchanged("telemetry", &nowhere)), "signal `nowhere` is not one of the design");
    assert_eq!(
        said(exchanged("step_driver", &[])),
        "block `step_driver`: `direction_pin` is read, and nothing stands in its place"
    );
    assert_eq!(
        said(helixlock_gen::attach_memory(&mut design, "telemetry")),
        "signal `telemetry_memory_write` is not one of the design"
    );
    assert_eq!(design, crate::golden_verilog::whole_design());
}

/// A block is taken out when nothing is left that reads it.
#[test]
fn what_is_read_is_not_taken_out() {
    let mut design = crate::golden_verilog::whole_design();
    let said = |result: Result<(), helixlock_gen::GenError>| result.unwrap_err().to_string();
    assert_eq!(
        said(helixlock_gen::bypass(&mut design, "nobody", &[])),
        "block `nobody` is not one of the design"
    );
    assert_eq!(
        said(helixlock_gen::bypass(&mut design, "receiver", &[])),
        "block `receiver`: `data` is read, and nothing stands in its place"
    );
    assert_eq!(design, crate::golden_verilog::whole_design());
}

/// Words in a title that tools take for orders stay words.
#[test]
fn a_title_is_no_pragma() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let title = "x\\nsynopsys translate_off\\nverilator lint_off";
    let machine = machine_with(&folder, "title = \"", &format!("title = \"{title} "));
    let output = folder.path().join("out");
    assert!(generate(&machine, &output, &[]).status.success());
    let shell = fs::read_to_string(output.join("rtl/board_shell.v")).expect("text");
    for line in shell.lines().filter_map(|line| line.trim().strip_prefix("//")) {
        let word = line.split_whitespace().next().unwrap_or_default();
        assert!(!["synopsys", "verilator", "synthesis", "pragma"].contains(&word), "{line}");
    }
    assert!(shell.contains("// | synopsys translate_off"), "{shell}");
}

/// A number no counter holds, and a board without room for a pin.
#[test]
fn options_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let said = |words: &[&str]| failure(&generate(Path::new(MACHINE), folder.path(), words));
    assert!(said(&["--glitch-clocks", "16"]).contains("glitch filter is `16`, expected 0 to 15"));
    assert!(said(&["--debounce", "16"]).contains("debouncing is `16`, expected 0 to 15"));
    assert!(said(&["--watchdog", "4096"]).contains("watchdog is `4096`, expected 0 to 4095"));
    let unpinned = said(&["--board", "hx8k", "--pins", "enable"]);
    assert!(unpinned.contains("hx8k.pcf: found no pin for [enable]"), "{unpinned}");
}

/// A broken wire is a level: every input of every board has its pull-up.
#[test]
fn every_input_is_pulled_up() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shell = fs::read_to_string(root.join("tests/golden/board_shell.v")).expect("text");
    let ports = shell.lines().filter_map(|line| line.trim().strip_prefix("input  wire"));
    let last = |line: &str| line.trim_end_matches(',').rsplit(' ').next().unwrap_or("").to_owned();
    let inputs: Vec<String> = ports.map(last).filter(|port| port != "clock").collect();
    assert!(inputs.iter().any(|port| port == "laser"), "{inputs:?}");
    for board in Board::all().expect("boards") {
        for pin in &board.pins {
            let port = pin.port.split('[').next();
            let is_input = inputs.iter().any(|input| port == Some(input));
            assert_eq!(pin.pull_up, is_input, "{}: {}", board.name, pin.port);
        }
    }
}
