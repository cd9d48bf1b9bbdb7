//! `make sim` of a generated project notices what is wrong with the Verilog: here eight mistakes that
//! long settings hide from a bench of the whole board.

use std::path::Path;
use std::process::{Command, Output};

use crate::support::command::put;

const MACHINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/sg7430-6mm/machine.toml");

/// A mistake: what it is, the bench that has to see it, the module, the text, the wrong text.
const MISTAKES: [[&str; 5]; 8] = [
    [
        "compensation never due",
        "device",
        "compensation_divider",
        "assign due = coincidence;",
        "assign due = 1'b0;",
    ],
    [
        "block and insert swapped",
        "device",
        "cumulative_compensator",
        "= laser ^ insert;",
        "= laser ^ ~insert;",
    ],
    [
        "another compensation",
        "board_shell",
        "board_shell",
        "[15:0] compensation = ",
        "[15:0] compensation = 16'h1 ^ ",
    ],
    [
        "the other compensation",
        "board_shell",
        "board_shell",
        "compensation_insert = ",
        "compensation_insert = ~",
    ],
    [
        "wrap at 4096",
        "device",
        "reset_counter",
        "assign refusing = request & at_limit & away;",
        "assign refusing = 1'b0;",
    ],
    ["fault never cleared", "device", "reset_counter", "if (clear | at_zero)", "if (clear)"],
    ["set wins at a coincidence", "device", "phase_meter", "(grating & ~laser)", "(grating)"],
    [
        "a waiting manual step is kept",
        "device",
        "step_selector",
        "if (clear | playback | ~manual_enable)",
        "if (clear)",
    ],
];

fn simulate(project: &Path, bench: &str) -> Output {
    let target = format!("sim-{bench}");
    Command::new("make").arg(target).current_dir(project).output().expect("make starts")
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn eight_mistakes_are_noticed() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let project = folder.path().join("out");
    let made = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(["gen", MACHINE, "-o"])
        .arg(&project)
        .output()
        .expect("helixlock starts");
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let sound = simulate(&project, "device");
    assert!(sound.status.success(), "{}", String::from_utf8_lossy(&sound.stdout));
    for [mistake, bench, module, was, now] in MISTAKES {
        let file = project.join(format!("rtl/{module}.v"));
        let right = std::fs::read_to_string(&file).expect("the module is there");
        assert_eq!(right.matches(was).count(), 1, "{module} has `{was}` once");
        put(&file, &right.replace(was, now));
        let noticed = simulate(&project, bench);
        put(&file, &right);
        let said = String::from_utf8_lossy(&noticed.stdout);
        assert!(!noticed.status.success() && said.contains("FAIL"), "{mistake}: {said}");
    }
}
