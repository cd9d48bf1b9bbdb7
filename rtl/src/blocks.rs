//! The list of blocks, in signal order.

use rust_hdl::prelude::{Block, Logic};

use crate::board_shell::BoardShell;
use crate::settings::{Conditioning, Encoder, Range, Settings};

/// What there is to know of a block without opening its file.
#[derive(Clone, Copy, Debug)]
pub struct BlockCard {
    /// Its name: that of its file, its Verilog module and its test.
    pub name: &'static str,
    /// One line: what it does, and the figure of document 1 it comes from.
    pub summary: &'static str,
    /// Its page: the text of its file.
    pub page: &'static str,
    /// Makes one on its own, its inputs connected, ready to be elaborated or simulated.
    pub build: fn() -> Box<dyn Block>,
}

impl BlockCard {
    /// The ports of its page's table, each with what is said of it there.
    #[must_use]
    pub fn ports(&self) -> Vec<(String, String)> {
        let rows = self.page.lines().map_while(|line| line.strip_prefix("//!"));
        let cells = rows.filter_map(|row| row.trim().strip_prefix("| `")?.strip_suffix('|'));
        cells.flat_map(ports_of_row).collect()
    }
}

/// The ports of a row: `` a` … `c` | out | meaning `` are three.
fn ports_of_row(row: &str) -> Vec<(String, String)> {
    let mut cells = row.split(" | ").map(str::trim);
    let (Some(names), Some("in" | "out"), Some(note)) = (cells.next(), cells.next(), cells.next())
    else {
        return vec![];
    };
    let plain = |name: &str| name.trim_matches(['`', ' ']).split('[').next().map(str::to_owned);
    let names: Vec<String> = match names.split_once('…') {
        Some((first, last)) => lettered(first, last),
        None => names.split(',').filter_map(plain).collect(),
    };
    names.into_iter().map(|name| (name, note.replace('`', ""))).collect()
}

/// From `` phase_a` `` to `` `phase_c` ``: the names between them, which differ in their last letter.
fn lettered(first: &str, last: &str) -> Vec<String> {
    let [first, last] = [first, last].map(|name| name.trim_matches(['`', ' ']));
    let [low, high] = [first, last].map(|name| name.chars().next_back().unwrap_or(' '));
    let stem = first.trim_end_matches(low);
    (low..=high).map(|letter| format!("{stem}{letter}")).collect()
}

/// Makes a [`BlockCard`] for a block whose inputs are listed.
macro_rules! card {
    ($name:ident :: $block:ident ( $($input:ident),+ ) $summary:literal) => {
        BlockCard {
            name: stringify!($name),
            summary: $summary,
            page: include_str!(concat!(stringify!($name), ".rs")),
            build: || {
                let mut block = crate::$name::$block::default();
                $(block.$input.connect();)+
                block.connect_all();
                Box::new(block)
            },
        }
    };
}

/// Every block of the device on its board, each after those it is made of, the board shell last.
pub const BLOCKS: &[BlockCard] = &[
    card!(level_synchroniser::LevelSynchroniser(clock, pin)
        "Two flip-flops between a panel switch and the logic"),
    card!(input_synchroniser::InputSynchroniser(clock, pin)
        "Two flip-flops and a rising edge: one pulse for each line or fringe"),
    card!(decade_counter::DecadeCounter(clock, clear, count)
        "One decimal digit with carry (fig. 7)"),
    card!(programmable_divider::ProgrammableDivider(clock, clear, pulse, preset)
        "Three decades and their coincidence: one pulse in 1 to 999 (fig. 7)"),
    card!(compensation_divider::CompensationDivider(clock, clear, pulse, preset)
        "Seven decades of which four are set: one pulse in F (fig. 9)"),
    card!(cumulative_compensator::CumulativeCompensator(clock, clear, laser, preset, insert)
        "Blocks or inserts one laser pulse in F (fig. 9)"),
    card!(initial_phase_selector::InitialPhaseSelector(clock, clear, laser, grating, preset)
        "Lets the grating through once m laser pulses have passed (fig. 8)"),
    card!(range_stage::RangeStage(clock, clear, divided, range_x2)
        "Divides by a further two in the x2 range"),
    card!(standard_wave::StandardWave(clock, clear, divided, start, half, range_x2)
        "Square wave of half a comparison period, from the grating (fig. 16)"),
    card!(phase_meter::PhaseMeter(clock, hold, grating, laser)
        "Set by the grating, cleared by the laser: its mean is the phase (figs. 3, 6)"),
    card!(calibrator::Calibrator(clock, clear, line, meter, calibrate)
        "Puts a known phase on the meter outputs (figs. 11, 12)"),
    card!(direction_discriminator::DirectionDiscriminator(clock, clear, hold, meter, standard)
        "Wider than the standard: forward; narrower: reverse (figs. 15, 16)"),
    card!(step_clock::StepClock(clock, clear, period)
        "Free-running oscillator whose frequency is the correction speed (fig. 14)"),
    card!(step_selector::StepSelector(clock, clear, tick, correcting, automatic_forward,
            manual_enable, manual_step, manual_forward, playback)
        "Chooses who moves the motor: the discriminator, the panel or the playback (fig. 14)"),
    card!(reset_counter::ResetCounter(clock, clear, request, forward, playback)
        "Counts the steps and plays them back to zero (fig. 17)"),
    card!(ring_distributor::RingDistributor(clock, clear, step, forward)
        "Three phases, six steps, and a way out of the two illegal states (fig. 14)"),
    card!(device::Device(clock, master_reset, grating, laser, start, correct, playback, calibrate,
            manual_step, manual_forward, divide_a, divide_b, range_x2, initial_phase,
            compensation, compensation_insert, step_period)
        "The whole measuring and correcting logic (figs. 6, 14)"),
    card!(step_driver::StepDriver(clock, clear, step, forward)
        "Pulse and direction for a bought stepper driver"),
    card!(input_conditioner::InputConditioner(clock, pin, active_low, tick, ticks)
        "Lets a level through once it has stood still: against glitches and bouncing"),
    card!(quadrature_decoder::QuadratureDecoder(clock, clear, a, b)
        "Lines of an encoder that may go back: those passed for the first time (fig. 6)"),
    card!(index_gate::IndexGate(clock, wired, start, started, index)
        "Lets a pass begin at the encoder's index"),
    card!(supervisor::Supervisor(clock, clear, tick, limit, wrap_watched, measuring, line, fringe,
            opening, shutting, enable, stop)
        "Watchdogs of lines, fringes and meter, enable and emergency stop"),
    card!(frame_check::FrameCheck(clock, clear, take, level)
        "CRC of a frame, bit by bit"),
    card!(telemetry::Telemetry(clock, clear, measuring, opening, meter, forward, count,
            count_forward, fault, alarm, ready)
        "A frame for every comparison: width, period, steps"),
    card!(uart_transmitter::UartTransmitter(clock, clear, bit_clocks, send, data)
        "Bytes out on one wire"),
    card!(uart_receiver::UartReceiver(clock, clear, bit_clocks, line)
        "Bytes in from one wire"),
    card!(settings_port::SettingsPort(clock, clear, at_rest, received, received_byte,
            telemetry_send, telemetry_byte, ready, tick_period, built_divide_a, built_divide_b, built_range_x2,
            built_initial_phase, built_compensation, built_compensation_insert, built_step_period)
        "Wheels turned over a serial port while the device is at rest"),
    card!(logic_analyser::LogicAnalyser(clock, clear, probes, received, received_byte, ready, rate,
            megahertz, ticks, ticks_rest, memory_data)
        "What eight signals did, told to programs that speak SUMP"),
    BlockCard {
        name: "board_shell",
        summary: "The device with its wheels set, and the pins a builder wires",
        page: include_str!("board_shell.rs"),
        build: || match BoardShell::connected(&EXAMPLE, &HASTY) {
            Ok(shell) => Box::new(shell),
            Err(error) => unreachable!("the example can be dialled: {error}"),
        },
    },
];

/// The blocks of documents 3 and 4, which stand on their own.
pub const APART: &[BlockCard] = &[
    card!(scale_lookup::ScaleLookup(clock, clear, origin, place_pulse, forward, machining, places,
            two_ways, scale, tick, data)
        "Finds the correction of a place in the EEPROM and steps the corrector to it (document 3)"),
    card!(digital_comparison::DigitalComparison(clock, clear, opening, shutting)
        "Clocks between two pulses and from period to period (document 4)"),
    card!(subdivided_comparison::SubdividedComparison(clock, clear, fast, slow)
        "Where between two input pulses an output pulse falls, as a fraction (document 4)"),
];

/// Wheels so low that a test sees what each of them does within some thousand clocks.
const EXAMPLE: Settings = Settings {
    a: 4,
    b: 3,
    range: Range::X2,
    initial_phase: 2,
    compensation_f: 1000,
    insert: true,
    step_period: 200,
};

/// Conditioning so fast that a test sees all of it within some thousand clocks.
const HASTY: Conditioning = Conditioning {
    glitch_clocks: 2,
    debounce_ticks: 3,
    tick_period: 5,
    watchdog_ticks: 40,
    bit_clocks: 2,
    active_low: false,
    range_pin: true,
    enable_pin: true,
    grating: Encoder { quadrature: true, index: true },
    laser: Encoder { quadrature: true, index: true },
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Every port of every block is said what for, and nothing else is.
    #[test]
    fn pages_describe_the_ports_there_are() {
        for card in BLOCKS.iter().chain(APART) {
            let source = card.page.split("impl Logic").next().unwrap_or_default();
            let fields = source.lines().filter_map(|line| line.trim().strip_prefix("pub "));
            let signals = fields.filter(|field| field.contains(": Signal<"));
            let ports: Vec<&str> = signals.filter_map(|field| field.split(':').next()).collect();
            let notes = card.ports();
            let described: Vec<&str> = notes.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(described, ports, "{}", card.name);
        }
    }

    #[test]
    fn a_row_may_stand_for_several_ports() {
        let row = "phase_a` … `phase_c` | out | drives of the `three` windings ";
        let names: Vec<String> = ports_of_row(row).into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["phase_a", "phase_b", "phase_c"]);
        assert_eq!(ports_of_row("calibrate[1:0]` | in | switch ")[0].0, "calibrate");
        assert_eq!(ports_of_row("t1`, `t2` | out | RC ")[1], ("t2".into(), "RC".into()));
    }
}
