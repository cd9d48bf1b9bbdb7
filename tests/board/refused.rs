//! `board set` with a board that answers as it is told to: what it refuses, and what it says then.

use std::process::Output;
use std::time::Duration;

use serial2::SerialPort;

use super::{at_port, hung_up};
use crate::settings_port::{Digits, IDENTIFY, NOT_AT_REST, NOT_SHOWN, READ, WRITE, frame};
use crate::support::command::helixlock;

const MACHINE: &str = "examples/sg7430-half-pi-module/machine.toml";

/// That machine's settings: A = 352, B = 158, m = 158, F = 1 789 000, 200 000 clocks, ×2.
const DIALLED: Digits = [2, 5, 3, 8, 5, 1, 8, 5, 1, 9, 8, 7, 1, 0, 4, 13, 0, 3, 0, 1];

/// A board of 12 MHz.
const IDENTITY: Digits = [0, 3, 4, 7, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 14, 14, 2, 0, 0, 0];

/// A frame of the telemetry.
fn comparison() -> Vec<u8> {
    let mut content = vec![1, 7, 0, 0x10, 0x27, 0, 0, 0x20, 0x4e, 0, 0, 0x2a, 0x30];
    content.extend(crate::telemetry::check(&content).to_le_bytes());
    let mut wire = cobs::encode_vec(&content);
    wire.push(0);
    wire
}

/// `board set` with these words, at a board that gives these answers one after the other.
fn set(words: &[&str], answers: &[Vec<u8>]) -> Output {
    let (mut here, there) = SerialPort::pair().expect("a pseudo-terminal");
    here.set_read_timeout(Duration::from_secs(20)).expect("it can be set");
    let child = at_port(&there, &[&["set", MACHINE, "--port", "PORT"], words].concat());
    for answer in answers {
        let mut byte = [1];
        while byte[0] != 0 {
            here.read_exact(&mut byte).expect("a request comes");
        }
        here.write_all(answer).expect("the other side reads");
    }
    let output = hung_up(child, here);
    drop(there);
    output
}

/// What is said of an error, without the name of the port.
fn error(answers: &[Vec<u8>]) -> String {
    let output = set(&[], answers);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{said}");
    let (_, said) = said.split_once(": ").expect("the program's name");
    said.split_once(": ").expect("the port's name").1.to_owned()
}

fn sound() -> [Vec<u8>; 3] {
    [frame(IDENTIFY, &IDENTITY), frame(WRITE, &DIALLED), frame(READ, &DIALLED)]
}

#[test]
fn a_board_is_set_beside_its_telemetry() {
    let [identity, written, read] = sound();
    let noisy = [&comparison()[..], &comparison()[..], &read[..]].concat();
    let output = set(&[], &[identity, written, noisy]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        "settings port 7430, version 1\n\
         A 352, B 158, range x2, initial phase 158, compensation +0.559 µm/m, step every 200000 \
         clocks (60.000 Hz)\n\
         written and read back; they last until the board is switched off\n"
    );
}

#[test]
fn it_is_told_as_json_and_in_chinese() {
    let output = set(&["--json"], &sound());
    let said: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!((&said["identifier"], &said["clock_hz"]), (&7430.into(), &12_000_000.into()));
    assert_eq!(said["settings"]["divide_a"], 352);
    let output = set(&["--language", "zh"], &sound());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let english = |line: &str| line.split(|c: char| !c.is_ascii_alphabetic()).any(|w| w.len() > 2);
    assert!(!said.lines().any(english), "{said}");
}

#[test]
fn refusals_say_why() {
    let [identity, written, _] = sound();
    let said = error(&[identity.clone(), frame(NOT_AT_REST, &DIALLED)]);
    assert!(said.starts_with("the board is not at rest, and keeps its settings\nhint: "), "{said}");
    let said = error(&[identity.clone(), frame(NOT_SHOWN, &DIALLED)]);
    assert_eq!(said, "the board has no wheels for these settings, and keeps its own\n");

    let with = |digits: &Digits, place: usize, digit| {
        let mut other = *digits;
        other[place] = digit;
        other
    };
    let said = error(&[frame(IDENTIFY, &with(&IDENTITY, 4, 2))]);
    let expected = "found a settings port 7430 of version 2, expected 7430 of version 1\n";
    assert!(said.starts_with(expected), "{said}");
    let said = error(&[frame(IDENTIFY, &with(&IDENTITY, 0, 9))]);
    assert!(said.starts_with("found a settings port 7439 of version 1, expected"), "{said}");
    let said = error(&[frame(IDENTIFY, &with(&IDENTITY, 16, 4))]);
    assert!(said.starts_with("found a board at 20.192 MHz, expected 12 MHz\nhint: "), "{said}");
    let said = error(&[identity, written, frame(READ, &with(&DIALLED, 2, 4))]);
    assert_eq!(said, "`divide_a` is 0x452 on the board, expected 0x352\n");
}

/// Nothing comes, or something else for as long as one listens: an end, and a reason.
#[test]
fn a_port_without_a_board_is_not_waited_for() {
    let expected = "no answer, expected a board whose bitstream was made with `--pins rx`\nhint: ";
    assert!(error(&[]).starts_with(expected));
    let chatter: Vec<u8> = (0..60).flat_map(|_| comparison()).collect();
    assert!(error(&[chatter]).starts_with(expected));
}

/// A second program at the same port, a folder, and no port at all.
#[test]
fn a_port_that_cannot_be_had_is_named() {
    let (here, there) = SerialPort::pair().expect("a pseudo-terminal");
    let first = at_port(&there, &["watch", "PORT", "--count", "1"]);
    // It has the port once it is known to listen; a lock tells nobody that it was taken.
    std::thread::sleep(Duration::from_secs(2));
    let second = at_port(&there, &["set", MACHINE, "--port", "PORT"]);
    let output = second.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.ends_with(": another program has this port\n"), "{said}");
    assert_eq!(output.status.code(), Some(2));
    drop((there, here));
    first.wait_with_output().expect("the line has hung up");

    for (port, expected) in
        [("/dev", "found a folder"), ("/dev/nothing", "/dev/nothing: no serial port: No such file")]
    {
        let run = helixlock(&["board", "set", MACHINE, "--port", port]);
        assert!(run.status == 2 && run.stderr.contains(expected), "{}", run.stderr);
        let hint = "\n\nhint: `helixlock board list` shows the ports\n";
        assert!(run.stderr.ends_with(hint), "{}", run.stderr);
    }
}
