//! The list of blocks, in signal order.

use rust_hdl::prelude::{Block, Logic};

use crate::board_shell::BoardShell;
use crate::settings::{Range, Settings};

/// What there is to know of a block without opening its file.
#[derive(Clone, Copy, Debug)]
pub struct BlockCard {
    /// Its name: that of its file, its Verilog module and its test.
    pub name: &'static str,
    /// One line: what it does, and the figure of document 1 it comes from.
    pub summary: &'static str,
    /// Makes one on its own, its inputs connected, ready to be elaborated or simulated.
    pub build: fn() -> Box<dyn Block>,
}

/// Makes a [`BlockCard`] for a block whose inputs are listed.
macro_rules! card {
    ($name:ident :: $block:ident ( $($input:ident),+ ) $summary:literal) => {
        BlockCard {
            name: stringify!($name),
            summary: $summary,
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
    BlockCard {
        name: "board_shell",
        summary: "The device with its wheels set, and the pins a builder wires",
        build: || match BoardShell::connected(&EXAMPLE) {
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

/// The 6 mm screw of document 1, 160 steps per second at 12 MHz.
const EXAMPLE: Settings = Settings {
    a: 110,
    b: 150,
    range: Range::X2,
    initial_phase: 150,
    compensation_f: 0,
    insert: false,
    step_period: 75_000,
};
