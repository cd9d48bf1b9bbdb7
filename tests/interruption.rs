//! A command that is killed leaves whole files or none: what it writes gets its name at the end.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::command::{put, repository, scratch, word};

/// Times at which a run is killed, spread over its duration.
const KILLS: u32 = 24;

fn command(out: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    command.current_dir(repository()).stdout(Stdio::null()).stderr(Stdio::null());
    command.args(["sim", "examples/sg7430-6mm/machine.toml", "-o", out, "--length", "2"]);
    command
}

/// Files with their own names; those under temporary ones begin with a dot.
fn named(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let names = names.map(|name| name.into_string().expect("text"));
    names.filter(|name| !name.starts_with('.')).collect()
}

#[test]
fn no_kill_leaves_half_a_file() {
    let folder = scratch();
    let (whole, whole_word) = word(&folder, "whole");
    let started = Instant::now();
    assert!(command(&whole_word).status().expect("the command starts").success());
    let duration = started.elapsed();
    assert!(named(&whole).contains(&"trace.csv".to_owned()), "{:?}", named(&whole));
    for kill in 1..=KILLS {
        let (out, out_word) = word(&folder, &format!("killed-{kill}"));
        fs::create_dir(&out).expect("a folder can be made");
        put(&out.join("trace.csv"), "of an earlier run\n");
        let mut child = command(&out_word).spawn().expect("the command starts");
        std::thread::sleep(duration * kill / KILLS + Duration::from_millis(1));
        child.kill().expect("it was ours");
        child.wait().expect("it ends");
        for name in named(&out) {
            let found = fs::read(out.join(&name)).expect("readable");
            let right = fs::read(whole.join(&name)).expect("a run writes it");
            let old = name == "trace.csv" && found == b"of an earlier run\n";
            assert!(old || found == right, "kill {kill}: half of `{name}`");
        }
    }
}
