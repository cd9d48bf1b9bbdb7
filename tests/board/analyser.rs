//! `sigrok-cli` reads the logic analyser of a board at a pseudo-terminal: what it shows is what the
//! pins were, sample for sample.

use std::os::fd::{AsFd, AsRawFd};
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use serial2::SerialPort;
use tempfile::TempDir;

use super::line::{BIT_CLOCKS, Line, Speaker};
use super::machine;
use super::rig::{Board, Change, Gates, Levels, Mutant};
use crate::support::command::scratch;

/// A board whose serial port has a way in.
const BOARD: &str = "icebreaker";

/// What `gen` is told.
const WORDS: [&str; 4] = ["--pins", "analyser", "--debounce", "0"];

/// Pins in the order of the channels, by `docs/board.md`.
const CHANNELS: [&str; 8] =
    ["grating", "laser", "t1", "step", "direction", "measuring", "fault", "alarm"];

/// Samples asked for, and how many of them come before the trigger or are it.
const SAMPLES: usize = 400;
const AHEAD: usize = 100;

/// MHz of the board; ticks of 10 ns from sample to sample, for 500 kHz.
const MHZ: u64 = 12;
const PERIOD: u64 = 200;

/// Clocks from the start bit of a byte until it has been received: two for the level, half a bit and
/// nine bits to the middle of the stop bit.
const RECEIVED: u64 = 2 + BIT_CLOCKS / 2 + 9 * BIT_CLOCKS;

/// Stands before the C library in a program that talks to gates at a pseudo-terminal. That has no
/// modem lines, and libserialport 0.1.1 opens nothing without. And gates run slower than a board,
/// the more so beside other work, where libsigrok gives an answer 20 ms and a byte 30 ms: its time
/// passes 30 times as slowly.
const STAND_IN: &str = r#"
#include <dlfcn.h>
#include <poll.h>
#include <stdarg.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static const long SLOWER = 30;

template <typename Real> static Real real(const char *name) {
  return (Real)dlsym(RTLD_NEXT, name);
}

static long long nanoseconds(clockid_t which) {
  timespec now;
  syscall(SYS_clock_gettime, which, &now);
  return (now.tv_sec * 1000000000LL + now.tv_nsec) / SLOWER;
}

extern "C" int clock_gettime(clockid_t which, timespec *now) noexcept {
  long long passed = nanoseconds(which);
  *now = {passed / 1000000000, passed % 1000000000};
  return 0;
}

extern "C" int gettimeofday(timeval *now, void *) noexcept {
  long long passed = nanoseconds(CLOCK_REALTIME) / 1000;
  *now = {passed / 1000000, passed % 1000000};
  return 0;
}

extern "C" int nanosleep(const timespec *time, timespec *rest) {
  long long wait = (time->tv_sec * 1000000000LL + time->tv_nsec) * SLOWER;
  timespec longer = {wait / 1000000000, wait % 1000000000};
  return real<int (*)(const timespec *, timespec *)>("nanosleep")(&longer, rest);
}

extern "C" int poll(pollfd *files, nfds_t count, int wait) {
  int longer = wait > 0 ? wait * (int)SLOWER : wait;
  return real<int (*)(pollfd *, nfds_t, int)>("poll")(files, count, longer);
}

extern "C" int select(int count, fd_set *in, fd_set *out, fd_set *others, timeval *time) {
  auto select = real<int (*)(int, fd_set *, fd_set *, fd_set *, timeval *)>("select");
  if (!time) return select(count, in, out, others, time);
  long long wait = (time->tv_sec * 1000000LL + time->tv_usec) * SLOWER;
  timeval longer = {wait / 1000000, wait % 1000000};
  return select(count, in, out, others, &longer);
}

extern "C" int ioctl(int file, unsigned long request, ...) noexcept {
  va_list rest;
  va_start(rest, request);
  void *argument = va_arg(rest, void *);
  va_end(rest);
  int answer = real<int (*)(int, unsigned long, ...)>("ioctl")(file, request, argument);
  if (answer == 0) return 0;
  if (request == TIOCMGET) *(int *)argument = 0;
  bool modem = request == TIOCMGET || request == TIOCMSET || request == TIOCMBIS || request == TIOCMBIC;
  return modem ? 0 : answer;
}
"#;

/// [`STAND_IN`], to be loaded into a program.
fn stand_in(folder: &TempDir) -> PathBuf {
    let [source, library] = ["stand_in.cpp", "stand_in.so"].map(|name| folder.path().join(name));
    crate::support::command::put(&source, STAND_IN);
    let mut compile = Command::new("g++");
    compile.args(["-shared", "-fPIC", "-D_GNU_SOURCE", "-o"]).arg(&library).arg(&source);
    assert!(compile.status().expect("g++, a Debian package, starts").success());
    library
}

/// `sigrok-cli` at the other end of a pseudo-terminal, its samples as bytes on standard output.
fn sigrok(folder: &TempDir, port: &SerialPort) -> Child {
    let own = format!("/proc/self/fd/{}", port.as_fd().as_raw_fd());
    let name = std::fs::read_link(own).expect("a pseudo-terminal has a name");
    let link = folder.path().join("port");
    if !link.exists() {
        std::os::unix::fs::symlink(name, &link).expect("a link");
    }
    // libserialport looks the name up below /sys/class/tty too: this one is there.
    let driver = format!("ols:conn=/dev/../../..{}", link.display());
    let samples = SAMPLES.to_string();
    Command::new("sigrok-cli")
        .args(["--driver", &driver, "--config", "samplerate=500k:captureratio=25"])
        .args(["--triggers", "2=1,1=0", "--samples", &samples, "--output-format", "binary"])
        .env("LD_PRELOAD", stand_in(folder))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("sigrok-cli, a Debian package, starts")
}

/// Lines and fringes at times of no regularity.
struct Wheel {
    state: u32,
    grating: bool,
    laser: bool,
}

impl Wheel {
    const fn new() -> Self {
        Self { state: 7, grating: false, laser: false }
    }

    fn draw(&mut self) -> u32 {
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.state >> 16
    }

    /// Runs for that many clocks, and turns.
    fn run(&mut self, gates: &mut Gates<'_>, speaker: &mut Speaker, clocks: u64) {
        speaker.run(gates, clocks);
        if self.draw().is_multiple_of(2) {
            self.grating = !self.grating;
            gates.set("grating", self.grating);
        } else {
            self.laser = !self.laser;
            gates.set("laser", self.laser);
        }
    }
}

/// The gates talk with sigrok-cli until it ends, or for as long as a test may take.
fn converse(gates: &mut Gates<'_>, mut port: SerialPort, child: Child) -> Output {
    port.set_read_timeout(Duration::from_millis(1)).expect("it can be set");
    let (mut line, mut speaker, mut wheel) = (Line::default(), Speaker::default(), Wheel::new());
    let mut child = child;
    let mut bytes = [0; 64];
    let begin = std::time::Instant::now();
    while child.try_wait().expect("it can be asked").is_none() {
        if let Ok(got) = port.read(&mut bytes) {
            speaker.say(&bytes[..got]);
        }
        // Longer than the glitch filter, and several comparisons in what is captured.
        for _ in 0..200 {
            let clocks = 12 + u64::from(wheel.draw() % 24);
            wheel.run(gates, &mut speaker, clocks);
        }
        port.write_all(&line.bytes(&gates.log, gates.clock())).expect("the other side reads");
        if begin.elapsed() > Duration::from_secs(120) {
            child.kill().expect("it can be ended");
        }
    }
    child.wait_with_output().expect("it has ended")
}

/// Levels of a pin by the clock.
struct Trace<'a> {
    first: bool,
    changes: Vec<&'a Change>,
}

impl<'a> Trace<'a> {
    fn new(pin: &str, first: &Levels, log: &'a [Change]) -> Self {
        let first = first.iter().find(|(name, _)| name == pin).expect("a pin").1;
        Self { first, changes: log.iter().filter(|change| change.pin == pin).collect() }
    }

    /// The level after that many edges.
    fn at(&self, clock: u64) -> bool {
        let behind = self.changes.partition_point(|change| change.clock <= clock);
        behind.checked_sub(1).map_or(self.first, |last| self.changes[last].high)
    }
}

/// Start bits of the bytes that went to the board, with the bytes.
fn spoken(gates: &Gates<'_>) -> Vec<(u64, u8)> {
    let rx = Trace::new("rx", &gates.first, &gates.log);
    let mut bytes: Vec<(u64, u8)> = vec![];
    for change in rx.changes.iter().filter(|change| !change.high) {
        if bytes.last().is_none_or(|(start, _)| start + 9 * BIT_CLOCKS < change.clock) {
            let bit = |bit: u64| rx.at(change.clock + (bit + 1) * BIT_CLOCKS + BIT_CLOCKS / 2);
            let byte = (0..8).fold(0, |byte, place| byte | u8::from(bit(place)) << place);
            bytes.push((change.clock, byte));
        }
    }
    bytes
}

/// The clock in which the board has heard its first command to run.
fn runs_after(gates: &Gates<'_>) -> u64 {
    let mut arguments = 0;
    for (start, byte) in spoken(gates) {
        match (arguments, byte) {
            (1.., _) => arguments -= 1,
            (_, 0x80..) => arguments = 4,
            (_, 1) => return start + RECEIVED,
            _ => {}
        }
    }
    panic!("sigrok-cli has not let it run");
}

/// What the pins were at the ticks of the capture, a byte a sample, by their log alone.
fn expected(gates: &Gates<'_>) -> Vec<u8> {
    let traces = CHANNELS.map(|pin| Trace::new(pin, &gates.first, &gates.log));
    let first = runs_after(gates) + 1;
    let sample = |number: usize| {
        // The clock in which its tick falls, and two for the synchroniser.
        let tick = u64::try_from(number).expect("not that many") * PERIOD;
        let clock = first + ((tick + 1) * MHZ).div_ceil(100) - 1 - 2;
        let levels = traces.iter().enumerate();
        levels.fold(0_u8, |byte, (bit, trace)| byte | u8::from(trace.at(clock)) << bit)
    };
    let fits = |number: &usize| sample(*number) & 0b110 == 0b100;
    let trigger = (AHEAD..1_000_000).find(fits).expect("the trigger comes");
    let begin = trigger + 1 - AHEAD;
    (begin..begin + SAMPLES).map(sample).collect()
}

/// Powers a board on and has sigrok-cli read it: what it read, what that was to be, what it said.
fn read(board: &Board) -> (Vec<u8>, Vec<u8>, String) {
    let folder = scratch();
    let (here, there) = SerialPort::pair().expect("a pseudo-terminal");
    let mut gates = board.start(0);
    for pin in ["start", "correct"] {
        gates.set(pin, false);
    }
    let child = sigrok(&folder, &there);
    let output = converse(&mut gates, here, child);
    // Each sample has as many bytes as libsigrok takes for a device of four groups of channels.
    let wide = (output.stdout.len() / SAMPLES).max(1);
    let samples = output.stdout.chunks(wide).map(|sample| sample[0]).collect();
    (samples, expected(&gates), String::from_utf8_lossy(&output.stderr).into_owned())
}

fn has_captured(board: &Board) {
    let (found, expected, said) = read(board);
    assert_eq!(found.len(), SAMPLES, "{said}");
    let first = found.iter().zip(&expected).position(|(found, expected)| found != expected);
    assert_eq!(first, None, "{found:02x?}\nexpected\n{expected:02x?}\n{said}");
    // All of it moved but the lamps of what is wrong, and the trigger is where it was asked for.
    let moved = found.iter().fold(0, |bits, sample| bits | (sample ^ found[0]));
    assert_eq!(moved & 0b111, 0b111, "{moved:08b}");
    assert_eq!(found[AHEAD - 1] & 0b110, 0b100);
}

fn short_pass(folder: &TempDir) -> String {
    machine(folder).1
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn sigrok_reads_what_the_pins_were() {
    let folder = scratch();
    let name = short_pass(&folder);
    has_captured(&Board::of_verilog(&name, BOARD, &WORDS));
}

/// A tick too many from sample to sample.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn sigrok_does_not_read_that_of_a_broken_analyser() {
    let folder = scratch();
    let name = short_pass(&folder);
    let mutant = Mutant {
        block: "logic_analyser",
        was: "assign left_again = left_less + divider_wide + 25'h1;",
        now: "assign left_again = left_less + divider_wide + 25'h2;",
    };
    let (found, expected, said) = read(&Board::of_mutant(&name, BOARD, &WORDS, &mutant));
    assert_eq!(found.len(), SAMPLES, "{said}");
    assert_ne!(found, expected);
}
