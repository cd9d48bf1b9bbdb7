//! What a difference in a signal is worth at the table, in µm.
//!
//! For the machine of document 1: a 6 mm screw at 6 rpm, a grating of 13906 lines, 0.63281983 µm,
//! 12 MHz, 160 steps of 0.0125 µm a second, A = 110 at x2.

use std::fmt;

/// Travel of one fringe, λ/2, µm.
const FRINGE_UM: f64 = 0.632_819_83 / 2.0;

/// Travel of one grating line, S/M, µm.
const LINE_UM: f64 = 6000.0 / 13_906.0;

/// Travel in one clock, µm: 0.6 mm/s at 12 MHz.
const CLOCK_UM: f64 = 600.0 / 12e6;

/// Travel of one step, µm.
const STEP_UM: f64 = 0.0125;

/// Steps from one decision to the next: 160 Hz over 6.32 Hz.
const STEPS_A_DECISION: f64 = 160.0 / (13_906.0 * 6.0 / 60.0 / 220.0);

/// What one wrong pulse, clock or step of a signal does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worth {
    /// A grating line too many or too few, for good.
    Line,
    /// A fringe too many or too few, for good.
    Fringe,
    /// An edge of the meter or the standard a clock early or late, in this comparison.
    Clock,
    /// The motor runs the other way until the next decision.
    Decision,
    /// A step too many, too few or the wrong way.
    Step,
    /// A switch of the panel, or the reset: what it switches is worth what is said there.
    Switch,
    /// A block of documents 3 and 4: it moves no table of a grinder.
    Apart,
    /// A signal that this list does not know.
    Unknown,
}

/// Blocks, their places in the device, and outputs of the device, with what they carry.
const WORTHS: &[(&[&str], Worth)] = &[
    (
        &[
            "grating_input",
            "divider_a",
            "grating_range",
            "selector",
            "grating_divided",
            "measuring",
        ],
        Worth::Line,
    ),
    (
        &["programmable_divider", "range_stage", "decade_counter", "initial_phase_selector"],
        Worth::Line,
    ),
    (&["input_synchroniser", "input_conditioner", "lines", "fringes"], Worth::Line),
    (&["quadrature_decoder", "grating_decoder", "grating_b_input"], Worth::Line),
    (&["laser_decoder", "laser_b_input"], Worth::Fringe),
    (&["index_gate", "grating_gate", "laser_gate"], Worth::Switch),
    (&["grating_index_input", "laser_index_input"], Worth::Switch),
    (&["laser_input", "compensator", "divider_b", "laser_range", "laser_divided"], Worth::Fringe),
    (&["compensation_divider", "cumulative_compensator"], Worth::Fringe),
    (&["phase_meter", "standard_wave", "calibrator", "t1", "t2", "standard"], Worth::Clock),
    (&["discriminator", "direction_discriminator", "q", "q_bar", "cp1", "cp2"], Worth::Decision),
    (&["step_clock", "step_selector", "reset_counter", "ring", "ring_distributor"], Worth::Step),
    (&["step", "forward", "reverse", "phase_a", "phase_b", "phase_c", "step_driver"], Worth::Step),
    (&["count", "count_forward", "zero", "fault", "driver", "step_pin"], Worth::Step),
    (&["direction_pin", "direction"], Worth::Step),
    (&["start_input", "correct_input", "playback_input", "level_synchroniser"], Worth::Switch),
    (&["manual_step_input", "manual_forward_input", "power_up_q"], Worth::Switch),
    (&["calibrate_low_input", "calibrate_high_input", "range_input"], Worth::Switch),
    (&["enable_input", "stop_input", "supervisor", "alarm", "milliseconds"], Worth::Switch),
    (&["telemetry", "transmitter", "uart_transmitter", "frame_check", "tx"], Worth::Apart),
    (&["logic_analyser"], Worth::Apart),
    (&["receiver", "uart_receiver", "settings_port"], Worth::Switch),
    (&["scale_lookup", "digital_comparison", "subdivided_comparison"], Worth::Apart),
];

/// What a signal is worth, by the first part of its path that is known.
#[must_use]
pub fn worth(path: &str) -> Worth {
    let known = |part: &str| {
        let row = WORTHS.iter().find(|(names, _)| names.contains(&part));
        row.map(|(_, worth)| *worth)
    };
    path.split('.').find_map(known).unwrap_or(Worth::Unknown)
}

impl fmt::Display for Worth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line => write!(f, "a line more or less is {LINE_UM:.4} µm, for good"),
            Self::Fringe => write!(f, "a fringe more or less is {FRINGE_UM:.4} µm, for good"),
            Self::Clock => write!(f, "a clock is {CLOCK_UM:.5} µm in this comparison"),
            Self::Decision => write!(
                f,
                "until the next decision the motor goes {:.3} µm the other way",
                STEPS_A_DECISION * STEP_UM
            ),
            Self::Step => write!(f, "a step is {STEP_UM} µm"),
            Self::Switch => write!(f, "a switch, worth what it switches"),
            Self::Apart => write!(f, "moves no table of a grinder"),
            Self::Unknown => write!(f, "worth unknown"),
        }
    }
}

#[cfg(test)]
mod tests {
    use helixlock_netlist::{Library, Netlist, elaborate};

    use super::super::synthesis::blocks;
    use super::*;

    /// Registers and outputs of every block have a line in the list.
    #[test]
    fn every_signal_that_lockstep_compares_is_worth_something() {
        for card in blocks() {
            let design = elaborate(card.name, &*(card.build)(), &Library::new()).unwrap();
            let netlist = Netlist::new(&design).unwrap();
            let registers = netlist.registers.iter().map(|register| register.output);
            for id in registers.chain(netlist.outputs.iter().copied()) {
                let inner = &netlist.signal(id).path;
                let whole = format!("{}.{inner}", card.name);
                let path =
                    if matches!(card.name, "device" | "board_shell") { inner } else { &whole };
                assert_ne!(worth(path), Worth::Unknown, "{whole}");
            }
        }
    }
}
