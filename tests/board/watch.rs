//! `board watch` at a pseudo-terminal: it reads what the gates did, to the clock.

use std::io::{self, BufRead, BufReader};
use std::process::Child;
use std::thread::{JoinHandle, spawn};
use std::time::Duration;

use helixlock_plant::Model;
use serde_json::Value;
use serial2::SerialPort;

use super::line::Line;
use super::rig::{Board, Change, Gates, grind};
use super::{FRONT, at_port, hung_up};
use crate::support::command::{put, repository, scratch, word};

/// A comparison as the pins show it, from one rising edge of T1 to the next.
#[derive(Debug, PartialEq)]
struct Comparison {
    /// Clocks that T1 is high, and from its rise to the next.
    clocks: (u64, u64),
    /// Steps of the motor up to the end, forward positive.
    steps: i64,
}

/// The comparisons that are over.
fn comparisons(log: &[Change]) -> Vec<Comparison> {
    let (mut forward, mut steps) = (false, 0);
    let (mut rise, mut width) = (None, 0_u64);
    let mut over = vec![];
    for change in log {
        match (change.pin.as_str(), change.high) {
            ("direction", high) => forward = high,
            ("step", true) => steps += if forward { 1 } else { -1 },
            ("t1", true) => {
                let begin = rise.replace(change.clock);
                over.extend(
                    begin.map(|begin| Comparison { clocks: (width, change.clock - begin), steps }),
                );
            }
            ("t1", false) => width = rise.map_or(0, |rise| change.clock - rise),
            _ => {}
        }
    }
    over
}

/// The JSON of a command while it is printed, since a pipe holds less than a long pass says.
fn rows(child: &mut Child) -> JoinHandle<Vec<Value>> {
    let lines = BufReader::new(child.stdout.take().expect("it is piped")).lines();
    let row = |line: io::Result<String>| serde_json::from_str(&line.expect("text")).expect("JSON");
    spawn(move || lines.map(row).collect())
}

/// The board grinds for so many clocks, and its frames go over the line while it does: as many as
/// are asked for, each with its clocks and steps as the pins have them.
pub(super) fn a_pass_is_watched_to_the_clock(
    board: &Board,
    (model, name): (&Model, &str),
    frames: usize,
    clocks: u64,
) {
    let (mut here, there) = SerialPort::pair().expect("a pseudo-terminal");
    here.set_write_timeout(Duration::from_secs(20)).expect("it can be set");
    let count = frames.to_string();
    let words = ["watch", "PORT", "--json", "--count", &count, "--machine", name];
    let mut child = at_port(&there, &words);
    let rows = rows(&mut child);

    let mut gates = board.start(0);
    let mut line = Line::default();
    grind(&mut gates, model, clocks, |gates: &Gates<'_>| {
        let bytes = line.bytes(&gates.log, gates.clock());
        here.write_all(&bytes).expect("the other side reads");
    });
    let output = hung_up(child, here);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let rows = rows.join().expect("it reads to the end");
    assert_eq!(rows.len(), frames);

    let at_pins = comparisons(&gates.log);
    assert!(at_pins.iter().any(|comparison| comparison.steps != 0), "the loop corrects");
    for (row, comparison) in rows.iter().zip(&at_pins) {
        let said = |key: &str| row[key].as_u64().expect("clocks");
        let clocks = (said("width_clocks"), said("period_clocks"));
        // T1 begins a clock after each opening, so its edges delimit the same comparisons.
        assert_eq!(clocks, comparison.clocks, "{row}");
        // One step may be under way.
        let steps = row["steps"].as_i64().expect("steps");
        assert!((steps - comparison.steps).abs() <= 1, "{row}, not {comparison:?}");
    }
    assert!(frames <= at_pins.len());
}

/// Clocks of a comparison of the report's machine at eighty times its speed.
const FAST_PERIOD: u64 = 220 * 12_000_000 / 13_906 / 8;

/// A metre of the report's screw, ground eighty times as fast, so that frames follow each other
/// nearly as closely as the line can take them: none is lost, and no byte of any.
#[test]
#[ignore = "minutes; the same with twelve frames of a bitstream is in every check"]
fn a_metre_loses_no_frame() {
    let folder = scratch();
    let (path, name) = word(&folder, "machine.toml");
    let report = repository().join("examples/sg7430-6mm/machine.toml");
    let mut text = std::fs::read_to_string(report).expect("the example is there");
    for (was, now) in [
        ("speed = \"6 rpm\"", "speed = \"480 rpm\""),
        ("frequency = \"100 Hz\"", "frequency = \"8000 Hz\""),
    ] {
        assert!(text.contains(was), "{was}");
        text = text.replace(was, now);
    }
    put(&path, &text);
    let model = Model::read(&path).expect("a sound machine");
    let board = Board::of_verilog(&name, "icestick", &FRONT);
    a_pass_is_watched_to_the_clock(&board, (&model, &name), 10_533, 10_536 * FAST_PERIOD);
}
