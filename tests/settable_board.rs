//! One netlist, set over its serial port, runs the three machines of document 1 as the netlists made
//! for each of them do, clock by clock, with the machine's table moved by its steps.

use helixlock_gen::{bypass, leave_out};
use helixlock_netlist::{Netlist, SignalId, elaborate};
use helixlock_plant::Model;
use helixlock_rtl::board_shell::BoardShell;
use helixlock_rtl::settings::{Conditioning, Settings};
use helixlock_rtl::settings_port::PASSED;
use helixlock_sim::{
    Circuit, Engine, Grinder, InterpretedPieces, Leap, Process, Stop, clock_of, library,
    settings_for, time_of,
};

use crate::settings_port::{Digits, WRITE, frame};
use crate::support::command::repository;
use crate::support::seeds::all_boards_are_asked;

const MACHINES: [&str; 3] = ["sg7430-6mm", "sg7430-sixth-inch", "sg7430-half-pi-module"];

const CLOCK_HZ: f64 = 12e6;

/// Clocks of a bit, and of a pulse of a line or fringe.
const BIT_CLOCKS: u64 = 104;
const PULSE_CLOCKS: u64 = 20;

/// What `gen` does by itself.
const CONDITIONING: Conditioning = Conditioning {
    glitch_clocks: 4,
    debounce_ticks: 10,
    tick_period: 12_000,
    watchdog_ticks: 1000,
    bit_clocks: 104,
    active_low: true,
    ..Conditioning::OFF
};

fn machine(name: &str) -> (Model, Settings) {
    let model = Model::read(&repository().join("examples").join(name).join("machine.toml"));
    let model = model.expect("the example is sound");
    let settings = settings_for(&model).expect("it can be dialled").settings;
    (model, settings)
}

/// The netlist of these settings; without a settings port as `gen` leaves it out.
fn circuit(settings: &Settings, settable: bool) -> Circuit {
    let shell = BoardShell::connected(settings, &CONDITIONING).expect("it can be dialled");
    let mut design = elaborate("board_shell", &shell, &library()).expect("it elaborates");
    if !settable {
        bypass(&mut design, "settings_port", &PASSED).expect("it passes");
        bypass(&mut design, "receiver", &[]).expect("nothing reads it");
        leave_out(&mut design, "rx", 0).expect("a pin");
    }
    Circuit::new(Netlist::new(&design).expect("it flattens"))
}

/// The digits of settings, by the page of the settings port.
fn digits(settings: &Settings) -> Digits {
    let wheels = settings.wheels().expect("they can be dialled");
    let numbers = [
        (wheels.divide_a, 3),
        (wheels.divide_b, 3),
        (wheels.initial_phase, 3),
        (wheels.compensation, 4),
        (wheels.step_period, 6),
        (wheels.range_x2 + 2 * wheels.compensation_insert, 1),
    ];
    let all = numbers.into_iter().flat_map(|(number, places)| {
        (0..places).map(move |place| u8::try_from(number >> (4 * place) & 15).expect("four bits"))
    });
    all.collect::<Vec<_>>().try_into().expect("twenty digits")
}

/// A netlist that runs, its outputs written down when they change.
struct Board<'a> {
    engine: Leap<'a, InterpretedPieces<'a>>,
    outputs: Vec<(SignalId, String)>,
    /// Its first clock, by the clocks of the test.
    since: u64,
    log: Vec<(u64, String, u64)>,
}

impl<'a> Board<'a> {
    /// All inputs as their pull-ups hold them.
    fn new(circuit: &'a Circuit, since: u64) -> Self {
        let netlist = circuit.netlist();
        let mut engine = Leap::new(circuit, InterpretedPieces::new(circuit));
        let outputs = netlist.outputs.iter();
        let outputs = outputs.map(|id| (*id, netlist.signal(*id).path.clone())).collect();
        engine.watch(&netlist.outputs);
        for input in &netlist.inputs {
            engine.set_input(*input, (1 << netlist.signal(*input).width) - 1);
        }
        let mut board = Self { engine, outputs, since, log: vec![] };
        for pin in ["emergency_stop", "range_x2", "enable"] {
            board.set(pin, false);
        }
        board
    }

    fn set(&mut self, pin: &str, high: bool) {
        if let Some(id) = self.engine.netlist().find(pin) {
            self.engine.set_input(id, high.into());
        }
    }

    fn get(&mut self, path: &str) -> u64 {
        let id = self.engine.netlist().find(path).expect("a signal");
        self.engine.value(id)
    }

    /// Runs to a clock of the test, or to a change of an output if `until_change`.
    fn run(&mut self, clock: u64, until_change: bool) {
        loop {
            let before = self.levels();
            let stop = self.engine.run_until(clock - self.since);
            let now = self.engine.clock() + self.since;
            for (place, level) in self.levels().into_iter().enumerate() {
                if level != before[place] {
                    self.log.push((now, self.outputs[place].1.clone(), level));
                }
            }
            if matches!(stop, Stop::Reached) || until_change {
                return;
            }
        }
    }

    fn levels(&mut self) -> Vec<u64> {
        self.outputs.iter().map(|(id, _)| self.engine.value(*id)).collect()
    }

    /// Sends a request over the serial port.
    fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            let bits = (0..8).map(|bit| byte >> bit & 1 == 1);
            for high in std::iter::once(false).chain(bits).chain([true]) {
                self.set("rx", high);
                let end = self.engine.clock() + self.since + BIT_CLOCKS;
                self.run(end, false);
            }
        }
    }
}

/// Two boards at one machine: the first moves its table.
struct Pair<'a> {
    boards: [Board<'a>; 2],
    grinder: Grinder,
    begin: u64,
}

/// Pulses of one reference.
struct Train {
    pin: &'static str,
    rise: u64,
    fall: Option<u64>,
}

impl Pair<'_> {
    fn set(&mut self, pin: &str, high: bool) {
        self.boards.iter_mut().for_each(|board| board.set(pin, high));
    }

    /// A pulse begins or ends if that is due; true when one has begun.
    fn drive(&mut self, train: &mut Train, clock: u64) -> bool {
        if train.fall.unwrap_or(train.rise) > clock {
            return false;
        }
        let falls = train.fall.take().is_some();
        self.set(train.pin, !falls);
        if !falls {
            train.fall = Some(clock + PULSE_CLOCKS);
        }
        !falls
    }

    /// Corrects for that many clocks.
    fn grind(&mut self, clocks: u64) {
        let begin = self.begin;
        let at = |time_s| begin + clock_of(time_s, CLOCK_HZ);
        let first = [self.grinder.next_line_s(), self.grinder.next_fringe_s()];
        let [line, fringe] = first.map(|time_s| at(time_s).max(begin + 100));
        let mut lines = Train { pin: "grating", rise: line, fall: None };
        let mut fringes = Train { pin: "laser", rise: fringe, fall: None };
        for pin in ["grating", "laser", "start", "correct"] {
            self.set(pin, false);
        }
        let (end, mut stepping) = (begin + clocks, false);
        loop {
            let next = [&lines, &fringes].map(|train| train.fall.unwrap_or(train.rise));
            let next = next[0].min(next[1]).min(end);
            self.boards[0].run(next, true);
            let clock = self.boards[0].engine.clock();
            self.boards[1].run(clock, false);
            let step = self.boards[0].get("step") == 1;
            if step && !stepping {
                let forward = self.boards[0].get("direction") == 1;
                self.grinder.step(time_of(clock - begin, CLOCK_HZ), forward);
                fringes.rise = at(self.grinder.next_fringe_s()).max(clock + 1);
            }
            stepping = step;
            if clock >= end {
                return;
            }
            if self.drive(&mut lines, clock) {
                self.grinder.pass_line();
                lines.rise = at(self.grinder.next_line_s()).max(clock + 2 * PULSE_CLOCKS);
            }
            if self.drive(&mut fringes, clock) {
                self.grinder.pass_fringe();
                fringes.rise = at(self.grinder.next_fringe_s()).max(clock + 2 * PULSE_CLOCKS);
            }
        }
    }
}

/// How many times as fast as it is a machine turns, and how many comparisons its pass has: with
/// `HELIXLOCK_BOARD=all` a hundred at its own speed.
fn extent() -> (f64, f64) {
    let all = all_boards_are_asked();
    if all { (1.0, 100.0) } else { (10.0, 4.0) }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn one_netlist_runs_three_machines() {
    let (_, built) = machine(MACHINES[0]);
    let settable = circuit(&built, true);
    for name in MACHINES {
        let (mut model, settings) = machine(name);
        let (faster, comparisons) = extent();
        model.machine.spindle.speed_rpm *= faster;
        let made = circuit(&settings, false);
        let mut board = Board::new(&settable, 0);
        board.run(1000, false);
        board.send(&frame(WRITE, &digits(&settings)));
        // The step clock begins with the new period at its next tick, as the other one does when it
        // is switched on.
        let tick = u64::from(built.step_period);
        board.run(tick, false);
        for (path, level) in settings.wheels().expect("they can be dialled").named() {
            assert_eq!(board.get(&format!("device.{path}")), level, "{name}: {path}");
        }
        let other = Board::new(&made, tick);
        let mut boards = [board, other];
        let begin = tick + 100_000;
        for board in &mut boards {
            board.run(begin, false);
            board.log.clear();
        }
        let grinder = Grinder::new(&model, model.workpiece.length_mm).expect("a sound machine");
        let mut pair = Pair { boards, grinder, begin };
        // Half a comparison goes by for the initial phase.
        let lines = f64::from(settings.a * settings.range.factor());
        let turns = (comparisons + 1.0) * lines / f64::from(model.grating.lines);
        pair.grind(clock_of(60.0 * turns / model.spindle.speed_rpm, CLOCK_HZ));
        let [one, other] = &pair.boards;
        let same = one.log.iter().zip(&other.log).take_while(|(one, other)| one == other).count();
        assert_eq!(one.log.get(same), other.log.get(same), "{name}");
        let count = |pin: &str| one.log.iter().filter(|(_, path, _)| path == pin).count();
        let counts = ["t1", "step", "tx"].map(count);
        assert!(counts[0] >= 7 && counts[1] >= 4 && counts[2] >= 100, "{name}: {counts:?}");
    }
}
