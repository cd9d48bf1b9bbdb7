//! `board watch` at a pseudo-terminal: it reads what the gates did, to the clock.

use std::process::Output;
use std::time::Duration;

use helixlock_plant::Model;
use serde_json::Value;
use serial2::SerialPort;

use super::line::Line;
use super::rig::{Board, Change, Gates, grind};
use super::{PERIOD, at_port, hung_up};

/// Widths and periods of T1 from the log of the pins, from rising edge to rising edge.
fn measured(log: &[Change]) -> Vec<(u64, u64)> {
    let edges: Vec<_> = log.iter().filter(|change| change.pin == "t1").collect();
    let rises: Vec<_> = edges.iter().filter(|edge| edge.high).map(|edge| edge.clock).collect();
    let between = rises.windows(2).map(|pair| {
        let fall = edges.iter().find(|edge| !edge.high && pair[0] < edge.clock);
        (fall.expect("it falls").clock - pair[0], pair[1] - pair[0])
    });
    between.collect()
}

fn rows(output: &Output) -> Vec<Value> {
    let lines = String::from_utf8_lossy(&output.stdout).into_owned();
    lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// The board grinds, and its frames go over the line while it does.
pub(super) fn a_pass_is_watched_to_the_clock(board: &Board, model: &Model, name: &str) {
    let (mut here, there) = SerialPort::pair().expect("a pseudo-terminal");
    here.set_write_timeout(Duration::from_secs(20)).expect("it can be set");
    let words = ["watch", "PORT", "--json", "--count", "12", "--machine", name];
    let child = at_port(&there, &words);

    let mut gates = board.start(0);
    let mut line = Line::default();
    grind(&mut gates, model, 15 * PERIOD, |gates: &Gates<'_>| {
        let bytes = line.bytes(&gates.log, gates.clock());
        here.write_all(&bytes).expect("the other side reads");
    });
    let output = hung_up(child, here);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let rows = rows(&output);
    let clocks = |row: &Value, key: &str| row[key].as_u64().expect("clocks");
    let widths: Vec<_> = rows
        .iter()
        .map(|row| (clocks(row, "width_clocks"), clocks(row, "period_clocks")))
        .collect();
    // T1 begins a clock after each opening, so its edges delimit the same comparisons.
    assert_eq!(widths, measured(&gates.log)[..12]);

    // Each frame has the steps of the motor up to its end; one may be under way.
    let ends = gates.log.iter().filter(|change| change.pin == "t1" && change.high).skip(1);
    let mut taken = vec![];
    for (row, end) in rows.iter().zip(ends) {
        let said = row["steps"].as_i64().expect("steps");
        taken.push(net_steps(&gates.log, end.clock));
        assert!((said - taken[taken.len() - 1]).abs() <= 1, "{said} steps, not {taken:?}");
    }
    assert!(taken.iter().any(|steps| *steps != 0), "the loop corrects");
}

/// Steps at the pins up to a clock, forward positive.
fn net_steps(log: &[Change], clock: u64) -> i64 {
    let (mut forward, mut steps) = (false, 0);
    for change in log.iter().take_while(|change| change.clock <= clock) {
        match change.pin.as_str() {
            "direction" => forward = change.high,
            "step" if change.high && forward => steps += 1,
            "step" if change.high => steps -= 1,
            _ => {}
        }
    }
    steps
}
