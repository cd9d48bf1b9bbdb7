//! A board without a board: the gates of a bitstream, read back from it, with a grinder at its pins.
//!
//! `helixlock gen --synth` makes the bitstream; icebox turns the placed and routed cells back into
//! Verilog, Verilator compiles that. The program so made holds the pins for as many clocks as it is
//! told, and comes back early when an output changes.

use std::fmt::Write as _;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use helixlock_gen::Board as Card;
use helixlock_plant::Model;
use helixlock_sim::{Grinder, Process, clock_of, time_of};
use tempfile::TempDir;

use super::verilog::{
    Ports, harness, placed_ports, shell_ports, with_fault, with_weak_tables, wrapper,
};
use crate::support::command::{helixlock, put, scratch};

/// Clocks that a pulse of a line or a fringe is high: more than the glitch filter asks for.
const PULSE_CLOCKS: u64 = 10;

/// A compiled bitstream, or compiled Verilog in its place.
pub(crate) struct Board {
    folder: TempDir,
    /// Pins but the clock, a bit each: `calibrate[0]` is `calibrate_0`.
    inputs: Vec<String>,
    outputs: Vec<String>,
    /// Places where a fault can be injected, numbered from 1.
    pub(crate) faults: u16,
}

impl Board {
    /// The bitstream of a machine file on a board of an iCE40, with these words for `gen`.
    pub(crate) fn of_bitstream(machine: &str, board: &str, words: &[&str]) -> Self {
        let folder = project(machine, board, &[words, &["--synth"]].concat());
        let mut constraints = String::new();
        for pin in Card::find(board).expect("it is known").pins {
            let name = bit_name(&pin.port);
            writeln!(constraints, "set_io {name} {}", pin.pin).expect("a string takes everything");
        }
        put(&folder.path().join("pins.pcf"), &constraints);
        let words = ["-s", "-n", "placed", "-p", "pins.pcf", "build/board_shell.asc"];
        let read_back = run(folder.path(), "icebox_vlog", &words);
        let pins = placed_ports(&read_back);
        let (weak, faults) = with_weak_tables(&with_fault(&read_back));
        put(&folder.path().join("placed.v"), &weak);
        Self::compiled(folder, pins, faults, &["placed.v"])
    }

    /// The emitted Verilog, which runs faster than its gates.
    pub(crate) fn of_verilog(machine: &str, board: &str, words: &[&str]) -> Self {
        Self::of_blocks(project(machine, board, words))
    }

    /// The same with a text of a block exchanged.
    pub(crate) fn of_mutant(machine: &str, board: &str, words: &[&str], mutant: &Mutant) -> Self {
        let folder = project(machine, board, words);
        let block = folder.path().join(format!("rtl/{}.v", mutant.block));
        let sound = std::fs::read_to_string(&block).expect("the block is there");
        assert!(sound.contains(mutant.was), "{}: {}", mutant.block, mutant.was);
        put(&block, &sound.replacen(mutant.was, mutant.now, 1));
        Self::of_blocks(folder)
    }

    fn of_blocks(folder: TempDir) -> Self {
        let mut files: Vec<_> = std::fs::read_dir(folder.path().join("rtl"))
            .expect("blocks")
            .map(|entry| entry.expect("a file").path().display().to_string())
            .collect();
        files.sort();
        let shell = std::fs::read_to_string(folder.path().join("rtl/board_shell.v"));
        let pins = shell_ports(&shell.expect("the shell is there"));
        put(&folder.path().join("placed.v"), &wrapper(&pins));
        files.push("placed.v".into());
        let files: Vec<_> = files.iter().map(String::as_str).collect();
        Self::compiled(folder, pins, 0, &files)
    }

    fn compiled(folder: TempDir, pins: Ports, faults: u16, files: &[&str]) -> Self {
        put(&folder.path().join("main.cpp"), &harness(&pins));
        let (inputs, outputs) = pins;
        // Compiling takes longer than running.
        let effort = ["-MAKEFLAGS", "OPT_FAST=-O1 OPT_SLOW=-O0"];
        let words = ["--cc", "--exe", "--build", "-O3", "-Wno-fatal", "-Wno-lint"];
        let more = ["--top-module", "placed", "-o", "board", "main.cpp"];
        run(folder.path(), "verilator", &[&words[..], &effort, &more, files].concat());
        Self { folder, inputs, outputs, faults }
    }

    /// Power on, all inputs as their pull-ups hold them; `fault` 0 is none.
    pub(crate) fn start(&self, fault: u16) -> Gates<'_> {
        let child = Command::new(self.folder.path().join("obj_dir/board"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the gates start");
        let levels = (1 << self.inputs.len()) - 1;
        let mut gates = Gates {
            board: self,
            child,
            fault,
            clock: 0,
            levels,
            answers: 0,
            first: vec![],
            log: vec![],
        };
        gates.ask(0);
        let inputs = self.inputs.iter().map(|pin| (pin.clone(), true));
        let outputs = self.outputs.iter().map(|pin| (pin.clone(), gates.high(pin)));
        gates.first = inputs.chain(outputs).collect();
        gates
    }

    /// True when the board reads this pin.
    pub(crate) fn reads(&self, pin: &str) -> bool {
        self.inputs.iter().any(|input| input == pin)
    }
}

/// A text of a block's Verilog, and what stands in its place.
pub(crate) struct Mutant {
    pub(crate) block: &'static str,
    pub(crate) was: &'static str,
    pub(crate) now: &'static str,
}

/// What `gen` writes for a board.
fn project(machine: &str, board: &str, words: &[&str]) -> TempDir {
    let folder = scratch();
    let output = folder.path().to_str().expect("a path of text");
    let fixed = ["gen", machine, "--board", board, "-o", output];
    let built = helixlock(&[&fixed[..], words].concat());
    assert_eq!(built.status, 0, "{}", built.stderr);
    folder
}

fn bit_name(port: &str) -> String {
    port.replace('[', "_").replace(']', "")
}

fn run(folder: &Path, tool: &str, words: &[&str]) -> String {
    let output = Command::new(tool).args(words).current_dir(folder).output();
    let output = output.unwrap_or_else(|error| panic!("{tool}: {error}"));
    assert!(output.status.success(), "{tool}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// A pin at a new level, from that clock on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Change {
    pub(crate) clock: u64,
    pub(crate) pin: String,
    pub(crate) high: bool,
}

/// Pins and their levels.
pub(crate) type Levels = Vec<(String, bool)>;

/// A running board.
pub(crate) struct Gates<'a> {
    board: &'a Board,
    child: Child,
    fault: u16,
    clock: u64,
    levels: u32,
    answers: u32,
    /// All pins before the first clock.
    pub(crate) first: Levels,
    /// What changed at its pins so far.
    pub(crate) log: Vec<Change>,
}

impl Gates<'_> {
    /// Rising edges since power-up.
    pub(crate) fn clock(&self) -> u64 {
        self.clock
    }

    /// Level of an output.
    pub(crate) fn high(&self, output: &str) -> bool {
        let place = self.board.outputs.iter().position(|name| name == output);
        self.answers >> place.expect("an output") & 1 == 1
    }

    /// Puts an input on a level, and on the log.
    pub(crate) fn set(&mut self, input: &str, high: bool) {
        let place = self.board.inputs.iter().position(|name| name == input);
        let bit = 1 << place.expect("an input");
        self.levels = if high { self.levels | bit } else { self.levels & !bit };
        self.lose(input, high);
    }

    /// Puts a level on the log that does not come as far as the pin: the wire is broken behind it.
    pub(crate) fn lose(&mut self, input: &str, high: bool) {
        self.log.push(Change { clock: self.clock, pin: input.to_owned(), high });
    }

    /// Runs to a clock, or to the first that changes an output: gives the outputs that rose.
    pub(crate) fn run_until(&mut self, clock: u64) -> Vec<String> {
        let before = self.answers;
        self.ask(u32::try_from(clock.saturating_sub(self.clock)).expect("not that long"));
        let outputs = self.board.outputs.iter().enumerate();
        let other = outputs.filter(|(bit, _)| (before ^ self.answers) >> bit & 1 == 1);
        let changes = other.map(|(bit, name)| Change {
            clock: self.clock,
            pin: name.clone(),
            high: self.answers >> bit & 1 == 1,
        });
        let changes: Vec<_> = changes.collect();
        self.log.extend(changes.iter().cloned());
        changes.into_iter().filter(|change| change.high).map(|change| change.pin).collect()
    }

    fn ask(&mut self, clocks: u32) {
        let asked = [self.levels, clocks, self.fault.into()].map(u32::to_le_bytes).concat();
        let to = self.child.stdin.as_mut().expect("it is piped");
        to.write_all(&asked).and_then(|()| to.flush()).expect("the gates run");
        let mut answer = [0; 8];
        let from = self.child.stdout.as_mut().expect("it is piped");
        from.read_exact(&mut answer).expect("the gates answer");
        let [run, answers] = [0, 4].map(|at| {
            u32::from_le_bytes([answer[at], answer[at + 1], answer[at + 2], answer[at + 3]])
        });
        self.clock += u64::from(run);
        self.answers = answers;
    }
}

impl Drop for Gates<'_> {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        // It ends at the end of its input.
        let _ = self.child.wait();
    }
}

/// Pulses of one reference at a pin.
struct Train {
    pin: &'static str,
    rise: u64,
    fall: Option<u64>,
}

impl Train {
    fn next(&self) -> u64 {
        self.fall.unwrap_or(self.rise)
    }

    /// Takes the change that is due; true when a pulse has begun.
    fn drive(&mut self, gates: &mut Gates<'_>, clock: u64) -> bool {
        if self.next() > clock {
            return false;
        }
        let falls = self.fall.take().is_some();
        gates.set(self.pin, !falls);
        if !falls {
            self.fall = Some(clock + PULSE_CLOCKS);
        }
        !falls
    }
}

/// Grinds to a clock with `start` and `correct` on: the plant makes lines and fringes, and its table
/// moves at every step. `heard` sees the board after each change.
pub(crate) fn grind(
    gates: &mut Gates<'_>,
    model: &Model,
    end: u64,
    mut heard: impl FnMut(&Gates<'_>),
) {
    let clock_hz = 12e6;
    let begin = gates.clock();
    let at = |time_s| begin + clock_of(time_s, clock_hz);
    let mut grinder = Grinder::new(model, model.workpiece.length_mm).expect("a sound machine");
    gates.run_until(begin + 40);
    for pin in ["grating", "laser", "start", "correct"] {
        gates.set(pin, false);
    }
    let train = |pin, time_s| Train { pin, rise: at(time_s).max(begin + 100), fall: None };
    let mut lines = train("grating", grinder.next_line_s());
    let mut fringes = train("laser", grinder.next_fringe_s());
    while gates.clock() < end {
        let rose = gates.run_until(lines.next().min(fringes.next()).min(end));
        let clock = gates.clock();
        heard(gates);
        if rose.iter().any(|pin| pin == "step") {
            grinder.step(time_of(clock - begin, clock_hz), gates.high("direction"));
            fringes.rise = at(grinder.next_fringe_s()).max(clock + 1);
        }
        if lines.drive(gates, clock) {
            grinder.pass_line();
            lines.rise = at(grinder.next_line_s()).max(clock + 2 * PULSE_CLOCKS);
        }
        if fringes.drive(gates, clock) {
            grinder.pass_fringe();
            fringes.rise = at(grinder.next_fringe_s()).max(clock + 2 * PULSE_CLOCKS);
        }
    }
}
