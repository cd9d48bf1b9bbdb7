//! What each screen lets its user do.

use std::fmt::Write as _;
use std::process::Command;

use serde_json::json;
use tempfile::TempDir;

use super::{Server, example, json, many, shortened, story, with_data};
use crate::support::command::{helixlock, put, word};

/// The ledger keeps the reason, the machine file stays as it was, and `learn` in the same folder
/// does not lose it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_refusal_keeps_its_reason() {
    let bench = with_data("6");
    let reason = "the nut was measured: \"no play\" <b>, 已测量";
    let before = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    story("refuses", &Server::over(bench.path()), &["backlash", reason]);
    let ledger = std::fs::read_to_string(bench.path().join("ledger.json")).unwrap();
    let rounds = json(&ledger)["rounds"].clone();
    assert_eq!(rounds[0]["refused"], json!([{ "effect": "backlash", "reason": reason }]));
    assert_eq!(rounds[0]["machine"], before.as_str());
    assert_eq!(rounds[1]["added"], "backlash", "its user has thought better of it");
    let [machine, data, folder] = ["machine.toml", "data.csv", ""].map(|name| word(&bench, name).1);
    assert_eq!(helixlock(&["learn", "--undo", "-o", &folder]).status, 0);
    let undone = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    assert_eq!(undone, before);
    let undone = std::fs::read_to_string(bench.path().join("ledger.json")).unwrap();
    assert_eq!(json(&undone)["rounds"][0]["refused"], rounds[0]["refused"]);
    assert_eq!(helixlock(&["learn", &machine, &data, "-o", &folder, "--force"]).status, 0);
    let kept = std::fs::read_to_string(bench.path().join("ledger-1.json")).unwrap();
    assert_eq!(kept, undone, "a ledger with a refusal is kept beside the new one");
}

/// What the line at the foot of the page says does to the folder what the page does.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_command_that_is_shown_does_the_same() {
    for command in ["add&effect=backlash", "learn"] {
        let [taken, typed] = [with_data("6"), with_data("6")];
        let server = Server::over(taken.path());
        let job = server.finished(&format!("&command={command}"));
        server.answered("POST", &(server.change("take") + &format!("&job={}", job["job"])), "{}");
        let line = job["line"].as_str().expect("a line");
        let words: Vec<&str> = line.split(' ').skip(1).collect();
        let run = Command::new(env!("CARGO_BIN_EXE_helixlock"))
            .args(words)
            .current_dir(typed.path())
            .output()
            .expect("the command starts");
        assert!(run.status.success(), "{line}: {}", String::from_utf8_lossy(&run.stderr));
        let machine = |bench: &TempDir| std::fs::read_to_string(bench.path().join("machine.toml"));
        assert_eq!(machine(&typed).unwrap(), machine(&taken).unwrap(), "{line}");
    }
}

/// 8 mm of lead at 6 rpm.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_click_on_the_residual_shows_the_flip_flops_there() {
    let bench = example("hidden-gear");
    story("flips", &Server::over(bench.path()), &["0.8"]);
}

/// The error is higher behind one place and lower behind another.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_jump_of_the_residual_leads_to_the_flip_flops_there() {
    let bench = shortened(example("hidden-gear"));
    let path = bench.path().join("data.csv");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut jumping = String::new();
    for line in text.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        let numbers = (cells[0].parse::<f64>(), cells[2].parse::<f64>());
        if let (Ok(place_mm), Ok(error_um)) = numbers {
            let up = if 20.0 < place_mm { 20.0 } else { 0.0 };
            let down = if 40.0 < place_mm { 12.0 } else { 0.0 };
            let error_um = error_um + up - down;
            writeln!(jumping, "{},{},{error_um},{}", cells[0], cells[1], cells[3]).unwrap();
        } else {
            writeln!(jumping, "{line}").unwrap();
        }
    }
    put(&path, &jumping);
    story("jumps", &Server::over(bench.path()), &["0.8", "20", "40"]);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn an_axis_that_is_pressed_has_the_residual_along_it() {
    story("follows", &Server::over(with_data("6").path()), &[]);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn cursors_are_linked_and_passes_can_be_left_out() {
    story("passes", &Server::over(with_data("6").path()), &[]);
}

/// 750 samples over 1000 mm, the lead 8 mm: six a turn, and so three waves; the worm turns 7.2 times.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_spectrum_ends_where_the_samples_do() {
    story("resolves", &Server::over(many(750).path()), &["3", "worm"]);
}
