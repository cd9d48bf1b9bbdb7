//! `board set` at a pseudo-terminal: one bitstream, its gates behind the other end, runs the three
//! machines of document 1 one after the other.

use std::process::{Child, Output};
use std::time::Duration;

use helixlock_plant::Model;
use helixlock_sim::clock_of;
use serial2::SerialPort;

use super::at_port;
use super::compare::write_log;
use super::line::{Line, Speaker};
use super::rig::{Board, Gates, grind};
use crate::support::command::{helixlock, repository, scratch, word};
use crate::support::seeds::{all_boards_are_asked, cases};

/// The bitstream's own, and two others.
const MACHINES: [&str; 3] = [
    "examples/sg7430-sixth-inch/machine.toml",
    "examples/sg7430-half-pi-module/machine.toml",
    "examples/sg7430-6mm/machine.toml",
];

/// What `gen` and `compare` are told.
const WORDS: [&str; 6] = ["--board", "icebreaker", "--pins", "rx", "--debounce", "0"];

/// A machine, forty times as fast as it is, and how many comparisons its pass is to have: two, or
/// with `HELIXLOCK_BOARD=all` twenty as fast as it is.
fn fast(machine: &str) -> (Model, f64) {
    let all = all_boards_are_asked();
    let mut model = Model::read(&repository().join(machine)).expect("a sound machine");
    if !all {
        model.machine.spindle.speed_rpm *= 40.0;
    }
    (model, if all { 20.0 } else { 2.0 })
}

/// The gates talk with a command until it ends.
fn converse(gates: &mut Gates<'_>, line: &mut Line, mut port: SerialPort, child: Child) -> Output {
    port.set_read_timeout(Duration::from_millis(2)).expect("it can be set");
    let mut speaker = Speaker::default();
    let mut child = child;
    let mut bytes = [0; 64];
    while child.try_wait().expect("it can be asked").is_none() {
        if let Ok(got) = port.read(&mut bytes) {
            speaker.say(&bytes[..got]);
        }
        // As long as a few bytes take.
        for _ in 0..40 {
            speaker.run(gates, 104);
        }
        let heard = line.bytes(&gates.log, gates.clock());
        port.write_all(&heard).expect("the other side reads");
    }
    child.wait_with_output().expect("it has ended")
}

fn set(gates: &mut Gates<'_>, line: &mut Line, machine: &str) -> Output {
    let (here, there) = SerialPort::pair().expect("a pseudo-terminal");
    let words = ["set", machine, "--port", "PORT", "--board", "icebreaker"];
    let child = at_port(&there, &words);
    converse(gates, line, here, child)
}

/// Clocks from rise to rise of T1, from that clock on.
fn periods(gates: &Gates<'_>, since: u64) -> Vec<u64> {
    let rises = gates.log.iter().filter(|change| change.pin == "t1" && change.high);
    let clocks: Vec<u64> = rises.map(|change| change.clock).filter(|at| since < *at).collect();
    clocks.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn one_bitstream_runs_several_machines() {
    let board = Board::of_bitstream(MACHINES[2], "icebreaker", &WORDS[2..]);
    let mut gates = board.start(0);
    let mut line = Line::default();
    gates.run_until(1000);
    for machine in cases(2, &MACHINES) {
        let output = set(&mut gates, &mut line, machine);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));

        // Lines of a comparison at the spindle's speed; half of one goes by for the initial phase.
        let (model, comparisons) = fast(machine);
        let lines = f64::from(model.dividers.a) * 2.0 / f64::from(model.grating.lines);
        let period = 12e6 * 60.0 * lines / model.spindle.speed_rpm;
        let begin = gates.clock();
        let end = begin + clock_of((comparisons + 2.0) * period / 12e6, 12e6);
        grind(&mut gates, &model, end, |_| {});
        // In the pass the wheels are at rest.
        let output = set(&mut gates, &mut line, MACHINES[0]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && said.contains("is not at rest"), "{said}");
        for pin in ["start", "correct"] {
            gates.set(pin, true);
        }
        let rest = gates.clock() + 100;
        while gates.clock() < rest {
            gates.run_until(rest);
        }

        // The loop moves a comparison's end by less than a hundredth.
        let found = periods(&gates, begin);
        assert!(found.len() > 1, "{machine}: {found:?}");
        for clocks in found {
            let ratio = f64::from(u32::try_from(clocks).expect("seconds")) / period;
            assert!((ratio - 1.0).abs() < 0.01, "{machine}: {clocks}, not {period}");
        }
    }
    let folder = scratch();
    let (path, log) = word(&folder, "pins.vcd");
    write_log(&path, &gates.first, &gates.log, gates.clock());
    let run = helixlock(&[&["board", "compare", MACHINES[2], &log], &WORDS[..]].concat());
    assert_eq!(run.status, 0, "{}{}", run.stdout, run.stderr);
}
