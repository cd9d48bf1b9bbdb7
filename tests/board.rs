//! The commands that talk to a board, with the gates of a bitstream in its place.

mod analyser;
mod compare;
mod line;
mod recorded;
mod refused;
mod rig;
mod set;
mod verilog;
mod watch;

use std::os::fd::{AsFd, AsRawFd};
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use helixlock_plant::Model;
use serial2::SerialPort;
use tempfile::TempDir;

use self::rig::Board;
use crate::support::command::{put, repository, scratch, word};

/// A short pass: a comparison is 20 lines or 40 fringes, 24 000 clocks, longer than its frame.
const MACHINE: &str = "title = 'a short pass'\n\
    workpiece = { lead = '6 mm', length = '3 mm' }\n\
    spindle.speed = '60 rpm'\n\
    lead_screw.lead = '6 mm'\n\
    grating.lines = 10000\n\
    laser.wavelength = '0.6 um'\n\
    dividers = { a = 20, b = 40, range = 1, initial_phase = 20 }\n\
    drive = { step = '0.0125 um', frequency = '4000 Hz' }\n\
    fpga = { clock = '12 MHz', board = 'icestick' }\n\
    [[effect]]\nkind = 'screw-periodic'\namplitude = '1.5 um'\nphase = '0 deg'\n";

/// Clocks of a comparison of that machine, nominally.
const PERIOD: u64 = 24_000;

/// What `gen` and `compare` are told of the panel: no wait for its contacts.
const FRONT: [&str; 2] = ["--debounce", "0"];

fn machine(folder: &TempDir) -> (PathBuf, String) {
    let (path, name) = word(folder, "machine.toml");
    put(&path, MACHINE);
    (path, name)
}

/// `helixlock board` with these words at the end of a pseudo-terminal, which is called PORT in them.
fn at_port(port: &SerialPort, words: &[&str]) -> Child {
    let link = format!("/proc/self/fd/{}", port.as_fd().as_raw_fd());
    let name = std::fs::read_link(link).expect("a pseudo-terminal has a name");
    let name = name.to_str().expect("a path of text");
    let words = words.iter().map(|word| if *word == "PORT" { name } else { word });
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .arg("board")
        .args(words)
        .current_dir(repository())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("helixlock starts")
}

/// What a command at the other end of a line said; the line is hung up when it does not end by
/// itself, so that a frame too few is a failure and not a wait.
fn hung_up(mut child: Child, line: SerialPort) -> Output {
    for _ in 0..200 {
        if child.try_wait().expect("it can be asked").is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    drop(line);
    child.wait_with_output().expect("it ends")
}

/// One bitstream: its gates grind while they are watched, and then with faults.
#[test]
fn a_bitstream_is_watched_and_held_to_its_logic() {
    let folder = scratch();
    let (path, name) = machine(&folder);
    let model = Model::read(&path).expect("a sound machine");
    let board = Board::of_bitstream(&name, "icestick", &FRONT);
    watch::a_pass_is_watched_to_the_clock(&board, (&model, &name), 12, 15 * PERIOD);
    compare::faults_are_found_at_their_clocks(&board, &model, &name);
}
