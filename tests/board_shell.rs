//! The board shell: without conditioning it is the device and nothing else; with it, a workshop may
//! happen at its pins.

use helixlock_netlist::{Library, Netlist, elaborate, mask};
use helixlock_rtl::board_shell::BoardShell;
use helixlock_rtl::settings::{Conditioning, Encoder, Range, Settings};
use helixlock_sim::{Engine, Interpreter, set_wheels, stepped_device};

use crate::lockstep::stimulus::{dense, realistic};

const SETTINGS: Settings = Settings {
    a: 4,
    b: 3,
    range: Range::X2,
    initial_phase: 2,
    compensation_f: 1000,
    insert: true,
    step_period: 200,
};

/// Pins that say nothing without conditioning.
const QUIET: [&str; 8] = [
    "range_x2",
    "enable",
    "emergency_stop",
    "grating_b",
    "laser_b",
    "grating_index",
    "laser_index",
    "rx",
];

fn shell(conditioning: &Conditioning) -> Netlist {
    let shell = BoardShell::connected(&SETTINGS, conditioning).expect("it can be dialled");
    let design = elaborate("board_shell", &shell, &Library::new()).expect("it elaborates");
    Netlist::new(&design).expect("it flattens")
}

/// What the shell was before it could do more: the device, in reset for 15 clocks.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn without_conditioning_it_is_the_device() {
    let netlist = shell(&Conditioning::OFF);
    for mut stimulus in [dense(&netlist, 11), realistic(&netlist, 12)] {
        let mut shell = Interpreter::new(&netlist);
        let mut device = stepped_device();
        let circuit = device.netlist().clone();
        set_wheels(&mut device, &SETTINGS).expect("they can be dialled");
        let mut inputs = vec![0; netlist.inputs.len()];
        for clock in 0..60_000 {
            stimulus.next(&mut inputs);
            let reset = circuit.find("master_reset").expect("a port");
            device.set_input(reset, u64::from(clock < 15));
            for (&id, &level) in netlist.inputs.iter().zip(&inputs) {
                let name = &netlist.signal(id).path;
                let quiet = QUIET.contains(&name.as_str());
                shell.set_input(id, if quiet { 0 } else { level });
                if let Some(port) = circuit.find(name).filter(|_| !quiet) {
                    device.set_input(port, level);
                }
            }
            shell.step();
            device.step();
            for name in ["t1", "t2", "phase_a", "phase_b", "phase_c", "zero", "fault", "measuring"]
            {
                let [ours, theirs] = [
                    shell.value(netlist.find(name).expect("a pin")),
                    device.value(circuit.find(name).expect("a port")),
                ];
                assert_eq!(ours, theirs, "{name} after clock {clock}");
            }
        }
    }
}

/// Pins of a shell by name, its switches on or off whatever level that is.
struct Board<'a> {
    netlist: &'a Netlist,
    engine: Interpreter<'a>,
    low: bool,
}

impl<'a> Board<'a> {
    fn new(netlist: &'a Netlist, low: bool) -> Self {
        let mut board = Self { netlist, engine: Interpreter::new(netlist), low };
        for switch in ["start", "correct", "playback", "calibrate", "manual_step", "manual_forward"]
        {
            board.switch(switch, 0);
        }
        board.clocks(40);
        board
    }

    fn set(&mut self, pin: &str, level: u64) {
        self.engine.set_input(self.netlist.find(pin).expect("a pin"), level);
    }

    fn switch(&mut self, pin: &str, on: u64) {
        let all = mask(self.netlist.signal(self.netlist.find(pin).expect("a pin")).width);
        self.set(pin, if self.low { all ^ on } else { on });
    }

    fn get(&mut self, path: &str) -> u64 {
        self.engine.value(self.netlist.find(path).expect("a signal"))
    }

    fn clocks(&mut self, clocks: u32) {
        (0..clocks).for_each(|_| self.engine.step());
    }
}

const BUSY: Conditioning = Conditioning {
    glitch_clocks: 4,
    debounce_ticks: 10,
    tick_period: 20,
    watchdog_ticks: 50,
    bit_clocks: 4,
    active_low: true,
    range_pin: false,
    enable_pin: false,
    ..Conditioning::OFF
};

/// Press and release bounce: without conditioning two steps come of it, with it one.
#[test]
fn a_bouncing_button_makes_one_step() {
    for (conditioning, expected) in [(BUSY, 1), (Conditioning::OFF, 2)] {
        let netlist = shell(&conditioning);
        let mut board = Board::new(&netlist, conditioning.active_low);
        let mut steps = 0;
        for clock in 0..3000_u32 {
            let bounces = (400..420).contains(&clock) || (1400..1420).contains(&clock);
            let pressed = if bounces { clock % 7 < 4 } else { (420..1400).contains(&clock) };
            board.switch("manual_step", pressed.into());
            board.clocks(1);
            steps += board.get("device.step");
        }
        assert_eq!(steps, expected);
    }
}

/// A notch of one clock in every eleventh line is no line.
#[test]
fn a_glitch_is_no_line() {
    for (conditioning, expected) in [(BUSY, 25), (Conditioning::OFF, 27)] {
        let netlist = shell(&conditioning);
        let mut board = Board::new(&netlist, conditioning.active_low);
        board.switch("start", 1);
        board.clocks(400);
        // Two fringes select the phase.
        for clock in 0..80 {
            board.set("laser", u64::from(clock % 40 < 20));
            board.clocks(1);
        }
        let mut comparisons = 0;
        // 200 lines are 25 comparisons of two times four.
        for line in 0..200 {
            for clock in 0..40 {
                let notch = line % 11 == 10 && clock == 10;
                board.set("grating", u64::from(clock < 20 && !notch));
                board.clocks(1);
                comparisons += board.get("device.grating_divided");
            }
        }
        assert_eq!(comparisons, expected);
    }
}

/// Pins nobody drives are pulled up: everything is off, and the emergency stop stops.
#[test]
fn broken_wires_are_off() {
    let netlist = shell(&BUSY);
    let mut board = Board::new(&netlist, true);
    for input in netlist.inputs.clone() {
        board.engine.set_input(input, mask(netlist.signal(input).width));
    }
    board.clocks(2000);
    assert_eq!(board.get("alarm"), 1);
    assert_eq!(board.get("measuring"), 0);
    assert_eq!((board.get("phase_a"), board.get("phase_b"), board.get("phase_c")), (0, 0, 0));
    board.set("emergency_stop", 0);
    board.clocks(2000);
    assert_eq!((board.get("alarm"), board.get("phase_a")), (0, 1));
}

/// The wheel of the range is in the design; with the pin asked for, the switch is.
#[test]
fn the_range_is_a_setting_unless_a_pin() {
    for (range_pin, switched, expected) in
        [(false, 0, 1), (false, 1, 1), (true, 0, 0), (true, 1, 1)]
    {
        let netlist = shell(&Conditioning { range_pin, ..Conditioning::OFF });
        let mut board = Board::new(&netlist, false);
        board.set("range_x2", switched);
        board.clocks(10);
        assert_eq!(board.get("device.range_x2"), expected);
    }
}

/// A machine with encoders of two signals and an index at the pins of a shell.
struct Machine<'a> {
    board: Board<'a>,
    /// Quarters of a line and of a fringe.
    quarters: [i64; 2],
    comparisons: u64,
}

impl<'a> Machine<'a> {
    fn new(netlist: &'a Netlist) -> Self {
        let mut board = Board::new(netlist, false);
        board.switch("start", 1);
        board.clocks(20);
        let mut machine = Self { board, quarters: [0; 2], comparisons: 0 };
        // The initial phase, in fringes.
        machine.go(1, 20);
        machine
    }

    /// An encoder goes so many quarters, some clocks each.
    fn go(&mut self, channel: usize, quarters: i64) {
        let [a, b] = [["grating", "grating_b"], ["laser", "laser_b"]][channel];
        for _ in 0..quarters.abs() {
            self.quarters[channel] += quarters.signum();
            let quarter = self.quarters[channel].rem_euclid(4);
            self.board.set(a, matches!(quarter, 1 | 2).into());
            self.board.set(b, matches!(quarter, 2 | 3).into());
            for _ in 0..3 {
                self.board.clocks(1);
                self.comparisons += self.board.get("device.grating_divided");
            }
        }
    }

    /// Both go, four lines where three fringes are.
    fn travel(&mut self, comparisons: i64) {
        for _ in 0..8 * comparisons.abs() {
            self.go(0, 4 * comparisons.signum());
            self.go(1, 3 * comparisons.signum());
        }
    }
}

const QUADRATURE: Conditioning = Conditioning {
    grating: Encoder { quadrature: true, index: false },
    laser: Encoder { quadrature: true, index: false },
    ..Conditioning::OFF
};

/// Straight on, and with dither and ways back between: as many comparisons, and the same phase.
#[test]
fn ways_back_add_no_comparison_and_lose_none() {
    let netlist = shell(&QUADRATURE);
    let mut straight = Machine::new(&netlist);
    straight.travel(30);
    assert_eq!(straight.comparisons, 30);

    let mut astray = Machine::new(&netlist);
    astray.travel(12);
    for _ in 0..200 {
        for (channel, quarters) in [(0, -4), (0, 4), (1, -4), (1, 4), (0, -1), (0, 1)] {
            astray.go(channel, quarters);
        }
    }
    assert_eq!(astray.comparisons, 12, "dither");
    astray.travel(-7);
    assert_eq!(astray.comparisons, 12, "back");
    astray.travel(25);
    assert_eq!(astray.comparisons, 30);
    assert_eq!(astray.board.get("t1"), straight.board.get("t1"));
    let dividers = ["device.divider_a.units.digit", "device.divider_b.units.digit"];
    for path in dividers {
        assert_eq!(astray.board.get(path), straight.board.get(path), "{path}");
    }
}

/// With one signal the same dither is counted: what the second is for.
#[test]
fn without_a_second_signal_dither_counts() {
    let netlist = shell(&Conditioning::OFF);
    let mut machine = Machine::new(&netlist);
    machine.travel(12);
    (0..16).for_each(|_| {
        machine.go(0, -4);
        machine.go(0, 4);
    });
    assert!(machine.comparisons > 12);
}

/// The pass waits for both indices.
#[test]
fn a_pass_begins_at_the_indices() {
    let indexed = Encoder { quadrature: false, index: true };
    let netlist = shell(&Conditioning { grating: indexed, laser: indexed, ..Conditioning::OFF });
    let mut machine = Machine::new(&netlist);
    for (index, begins) in [("grating_index", 0), ("laser_index", 1)] {
        machine.travel(3);
        assert_eq!(machine.board.get("measuring"), 0);
        machine.board.set(index, 1);
        machine.travel(3);
        assert_eq!(machine.board.get("measuring"), begins, "{index}");
    }
}

/// Lost count stops the board, and the panel forgets it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn too_far_back_is_a_stop() {
    let netlist = shell(&QUADRATURE);
    let mut machine = Machine::new(&netlist);
    machine.go(0, -4 * 65_535);
    assert_eq!(machine.board.get("alarm"), 0);
    machine.go(0, -4);
    assert_eq!(machine.board.get("alarm"), 1);
    machine.board.switch("start", 0);
    machine.board.clocks(20);
    assert_eq!(machine.board.get("alarm"), 0);
}
