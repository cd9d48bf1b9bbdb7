//! The board shell: without conditioning it is the device and nothing else; with it, a workshop may
//! happen at its pins.

use helixlock_netlist::{Library, Netlist, elaborate, mask};
use helixlock_rtl::board_shell::BoardShell;
use helixlock_rtl::settings::{Conditioning, Range, Settings};
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

fn shell(conditioning: &Conditioning) -> Netlist {
    let shell = BoardShell::connected(&SETTINGS, conditioning).expect("it can be dialled");
    let design = elaborate("board_shell", &shell, &Library::new()).expect("it elaborates");
    Netlist::new(&design).expect("it flattens")
}

/// What the shell was before it could do more: the device, in reset for 15 clocks.
#[test]
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
                let quiet = matches!(name.as_str(), "range_x2" | "enable" | "emergency_stop");
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
