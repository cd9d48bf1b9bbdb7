//! `board compare` finds the clock at which a board leaves its logic.

use std::fs::File;
use std::io::BufWriter;

use helixlock_plant::Model;
use helixlock_traces::{Dump, Tick, Variable, VcdWriter};
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

use super::rig::{Board, Change, Gates, Levels, Mutant, grind};
use super::{FRONT, PERIOD, machine};
use crate::support::command::{Run, helixlock, scratch};
use crate::support::seeds::all_boards_are_asked;

const CLOCK_HZ: u64 = 12_000_000;

/// Writes what was seen at the pins.
pub(super) fn write_log(path: &std::path::Path, first: &Levels, log: &[Change], end: u64) {
    let file = BufWriter::new(create(path));
    let variables: Vec<_> =
        first.iter().map(|(pin, _)| Variable::bits(format!("board.{pin}"), 1)).collect();
    let mut dump = VcdWriter::new(file, Tick::PICOSECOND, &variables).expect("it takes bytes");
    let tick = |clock| Tick::PICOSECOND.of_clock(clock, CLOCK_HZ);
    for (place, (_, high)) in first.iter().enumerate() {
        dump.bits(place, u64::from(*high)).expect("it takes bytes");
    }
    for change in log {
        let place = first.iter().position(|(pin, _)| *pin == change.pin).expect("a pin");
        dump.at(tick(change.clock)).expect("it takes bytes");
        dump.bits(place, u64::from(change.high)).expect("it takes bytes");
    }
    dump.finish(tick(end)).expect("it takes bytes");
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
fn create(path: &std::path::Path) -> File {
    File::create(path).expect("the scratch folder is writable")
}

/// What `board compare` says of a log, in these words.
fn told(machine: &str, gates: &Gates<'_>, words: &[&str]) -> Run {
    let folder = scratch();
    let log = folder.path().join("pins.vcd");
    write_log(&log, &gates.first, &gates.log, END);
    let log = log.to_str().expect("a path of text");
    helixlock(&[&["board", "compare", machine, log], &FRONT[..], words].concat())
}

/// The same as JSON.
fn compared(machine: &str, gates: &Gates<'_>) -> (Run, Value) {
    let run = told(machine, gates, &["--json"]);
    let said = serde_json::from_str(&run.stdout);
    let said = said.unwrap_or_else(|_| panic!("{}{}", run.stdout, run.stderr));
    (run, said)
}

/// The same levels at the inputs once more; those at `lost` do not come as far as the board.
fn replay(gates: &mut Gates<'_>, inputs: &[Change], end: u64, lost: &[usize]) {
    for (place, change) in inputs.iter().enumerate() {
        while gates.clock() < change.clock {
            gates.run_until(change.clock);
        }
        if lost.contains(&place) {
            gates.lose(&change.pin, change.high);
        } else {
            gates.set(&change.pin, change.high);
        }
    }
    while gates.clock() < end {
        gates.run_until(end);
    }
}

/// The first clock at which outputs of two runs differ, which they may do from power-up on.
fn first_difference(board: &Board, one: &Gates<'_>, other: &Gates<'_>) -> Option<u64> {
    if one.first != other.first {
        return Some(0);
    }
    let outputs = |log: &[Change]| -> Vec<Change> {
        log.iter().filter(|change| !board.reads(&change.pin)).cloned().collect()
    };
    let (one, other) = (outputs(&one.log), outputs(&other.log));
    let same = one.iter().zip(&other).take_while(|(one, other)| one == other).count();
    [one.get(same), other.get(same)].into_iter().flatten().map(|change| change.clock).min()
}

/// Clocks of the pass.
const END: u64 = 6 * PERIOD;

/// How many faults have to be found, and which lines are lost: a few, or with `HELIXLOCK_BOARD=all`
/// a hundred.
fn faults() -> (usize, &'static [usize]) {
    let all = all_boards_are_asked();
    if all { (100, &[30, 71, 102]) } else { (3, &[71]) }
}

/// A pass in closed loop on the gates agrees with the model. The same pass with a bit of a table
/// turned over, or with a line lost on its way to the pin, is told at the first clock at which the
/// gates do anything else, which is found here from the gates alone.
#[expect(clippy::print_stdout, reason = "with --nocapture: how many tables no pin shows")]
pub(super) fn faults_are_found_at_their_clocks(board: &Board, model: &Model, name: &str) {
    let mut sound = board.start(0);
    grind(&mut sound, model, END, |_| {});
    let (run, said) = compared(name, &sound);
    assert_eq!((run.status, &said["same"]), (0, &Value::Bool(true)), "{}", run.stdout);
    // The first begins with the pass, and the last is under way.
    assert_eq!(said["comparisons"], 4, "{}", run.stdout);

    let inputs: Vec<_> = sound.log.iter().filter(|c| board.reads(&c.pin)).cloned().collect();
    let is_found = |gates: &Gates<'_>, what: &str| -> bool {
        let Some(clock) = first_difference(board, &sound, gates) else { return false };
        let (run, said) = compared(name, gates);
        assert_eq!((run.status, &said["difference"]["clock"]), (1, &clock.into()), "{what}");
        true
    };
    let mut tables: Vec<_> = (1..=board.faults).collect();
    tables.shuffle(&mut ChaCha8Rng::seed_from_u64(7430));
    let (faults, lost) = faults();
    let (mut found, mut silent) = (0, 0);
    for table in tables {
        let mut gates = board.start(table);
        replay(&mut gates, &inputs, END, &[]);
        if is_found(&gates, &format!("table {table}")) {
            found += 1;
        } else {
            silent += 1;
        }
        if found == faults {
            break;
        }
    }
    println!("{found} faults found, {silent} that show at no pin in this pass");
    assert_eq!(found, faults);

    let lines = inputs.iter().enumerate().filter(|(_, c)| c.pin == "grating" && c.high);
    let lines: Vec<_> = lines.map(|(place, _)| place).collect();
    for line in lost {
        let mut gates = board.start(0);
        let rise = lines[*line];
        let fall = (rise..inputs.len())
            .find(|place| inputs[*place].pin == "grating" && !inputs[*place].high);
        replay(&mut gates, &inputs, END, &[rise, fall.expect("a pulse ends")]);
        assert!(is_found(&gates, &format!("line {line}")), "a lost line shows");
    }
}

/// A block that is not the one the model has: a motor that runs the wrong way, told in µm.
#[test]
fn a_mutated_block_is_told_in_micrometres() {
    let folder = scratch();
    let (path, name) = machine(&folder);
    let mutant = Mutant {
        block: "direction_discriminator",
        was: "assign q = jk_q;",
        now: "assign q = ~jk_q;",
    };
    let board = Board::of_mutant(&name, "icestick", &FRONT, &mutant);
    let mut gates = board.start(0);
    grind(&mut gates, &Model::read(&path).expect("a sound machine"), END, |_| {});
    let (run, said) = compared(&name, &gates);
    let difference = &said["difference"];
    assert_eq!(run.status, 1, "{said:#}");
    let motor = &difference["motor"];
    let [found, expected] =
        ["found_steps", "expected_steps"].map(|key| motor[key].as_i64().expect("steps"));
    let error_um = motor["error_um"].as_f64().expect("µm");
    assert!(found * expected < 0, "{said:#}");
    let steps = i32::try_from(found - expected).expect("few");
    assert!((error_um - 0.0125 * f64::from(steps)).abs() < 1e-12, "{said:#}");
    let text = told(&name, &gates, &[]).stdout;
    assert!(text.starts_with("first difference after clock "), "{text}");
    assert!(text.contains(&format!("{error_um:+.4} µm\n")), "{text}");
}
