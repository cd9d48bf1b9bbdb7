//! What each figure and its synchronous block are given, and which of their pins answer to each
//! other.

use helixlock_original::Circuit;
use helixlock_original::figures::calibrator::{self, Step};
use helixlock_original::figures::compensator::{self, Correction};
use helixlock_original::figures::{
    Clear, decade, discriminator, divider, laser_direction, phase_meter, phase_selector,
    range_stage, reset_counter, ring,
};

/// A figure and a block.
#[derive(Debug)]
pub(super) struct Drive {
    pub(super) figure: &'static str,
    pub(super) block: &'static str,
    pub(super) build: fn() -> Circuit,
    /// Standing inputs of the block.
    pub(super) set: &'static [(&'static str, u64)],
    /// Levels of the figure's pins from the start on, where they are not those of power-up.
    pub(super) before: &'static [(&'static str, bool)],
    /// What may come, each with its weight.
    pub(super) moves: &'static [(u32, Move)],
    /// Wires of the figure that are inputs of the block.
    pub(super) copied: &'static [(&'static str, &'static str)],
    pub(super) outputs: &'static [Output],
    /// Moves before the first comparison: a flip-flop of gates wakes up as it likes.
    pub(super) warm_up: u32,
}

/// Something that comes: to a pin of the figure and an input of the block.
#[derive(Debug)]
pub(super) enum Move {
    /// To the other level, and back.
    Pulse { pin: &'static str, input: &'static str },
    /// A pulse whose effect gets to the block by the copied wires.
    Inside { pin: &'static str },
    /// To the other level.
    Level { pin: &'static str, input: &'static str },
}

impl Move {
    pub(super) fn pin(&self) -> &'static str {
        let (Self::Pulse { pin, .. } | Self::Inside { pin } | Self::Level { pin, .. }) = self;
        pin
    }

    pub(super) fn input(&self) -> Option<&'static str> {
        match self {
            Self::Pulse { input, .. } | Self::Level { input, .. } => Some(*input),
            Self::Inside { .. } => None,
        }
    }
}

/// What has to be alike.
#[derive(Debug)]
pub(super) enum Output {
    /// The number of pulses; those of the block are clocks.
    Pulses { pin: &'static str, signal: &'static str },
    /// A level at rest.
    Level { pin: &'static str, signal: &'static str },
    /// A number whose bits are pins with a number behind their name, low bit first.
    Bits { pin: &'static str, count: usize, signal: &'static str },
    /// Pulses `up` less pulses `down`; the block has clocks of `further` less what it is `behind`.
    Way { up: &'static str, down: &'static str, further: &'static str, behind: &'static str },
}

impl Output {
    pub(super) fn signal(&self) -> &'static str {
        let (Self::Pulses { signal, .. }
        | Self::Level { signal, .. }
        | Self::Bits { signal, .. }
        | Self::Way { further: signal, .. }) = self;
        signal
    }

    pub(super) fn pins(&self) -> Vec<String> {
        match self {
            Self::Pulses { pin, .. } | Self::Level { pin, .. } => vec![(*pin).to_owned()],
            Self::Bits { pin, count, .. } => (0..*count).map(|bit| format!("{pin}{bit}")).collect(),
            Self::Way { up, down, .. } => [*up, *down].map(str::to_owned).into(),
        }
    }
}

const fn pulse(pin: &'static str, input: &'static str) -> Move {
    Move::Pulse { pin, input }
}

const LINES: &[(u32, Move)] = &[(1, pulse("line", "line"))];
const LASER_AND_RESET: &[(u32, Move)] =
    &[(5000, pulse("laser", "laser")), (1, pulse("reset", "clear"))];

const fn calibration(build: fn() -> Circuit, set: &'static [(&'static str, u64)]) -> Drive {
    Drive {
        figure: "11, 12",
        block: "calibrator",
        build,
        set,
        moves: LINES,
        outputs: &[
            Output::Level { pin: "t1", signal: "t1" },
            Output::Level { pin: "t2", signal: "t2" },
        ],
        // Until D has clamped E for the first time.
        warm_up: 8,
        ..NOTHING
    }
}

const fn compensation(build: fn() -> Circuit, set: &'static [(&'static str, u64)]) -> Drive {
    Drive {
        figure: "9",
        block: "cumulative_compensator",
        build,
        set,
        moves: LASER_AND_RESET,
        outputs: &[Output::Pulses { pin: "pulse", signal: "pulse" }],
        ..NOTHING
    }
}

const NOTHING: Drive = Drive {
    figure: "",
    block: "",
    build: decade::circuit,
    set: &[],
    before: &[],
    moves: &[],
    copied: &[],
    outputs: &[],
    warm_up: 0,
};

/// Every figure that has a block.
pub(super) const DRIVES: &[Drive] = &[
    Drive {
        figure: "3, 6",
        block: "phase_meter",
        build: phase_meter::circuit,
        moves: &[
            (10, pulse("grating", "grating")),
            (10, pulse("laser", "laser")),
            (1, pulse("hold_bar", "hold")),
        ],
        outputs: &[Output::Level { pin: "t1", signal: "meter" }],
        warm_up: 60,
        ..NOTHING
    },
    Drive {
        figure: "6",
        block: "quadrature_decoder",
        build: laser_direction::circuit,
        moves: &[
            (1, Move::Level { pin: laser_direction::PHOTOCELLS[0], input: "a" }),
            (1, Move::Level { pin: laser_direction::PHOTOCELLS[1], input: "b" }),
        ],
        outputs: &[Output::Way { up: "up", down: "down", further: "pulse", behind: "behind" }],
        ..NOTHING
    },
    Drive {
        figure: "7",
        block: "decade_counter",
        build: decade::circuit,
        moves: &[(40, pulse("pulse", "count")), (1, pulse("clear_bar", "clear"))],
        outputs: &[Output::Bits { pin: "q", count: 4, signal: "digit" }],
        ..NOTHING
    },
    Drive {
        figure: "7",
        block: "programmable_divider",
        build: || divider::circuit(127, Clear::Delayed),
        set: &[("preset", 0x127)],
        moves: &[(500, pulse("pulse", "pulse")), (1, pulse("reset", "clear"))],
        outputs: &[Output::Pulses { pin: "divided", signal: "divided" }],
        ..NOTHING
    },
    Drive {
        figure: "8",
        block: "initial_phase_selector",
        build: || phase_selector::circuit(126),
        set: &[("preset", 0x126)],
        before: &[("reset", false)],
        moves: &[
            (400, pulse("laser", "laser")),
            (400, pulse("grating", "grating")),
            (1, pulse("reset", "clear")),
        ],
        outputs: &[
            Output::Pulses { pin: "line", signal: "line" },
            Output::Level { pin: "open", signal: "open" },
        ],
        ..NOTHING
    },
    compensation(|| compensator::circuit(1, Correction::Block), &[("preset", 1)]),
    compensation(|| compensator::circuit(1, Correction::Insert), &[("preset", 1), ("insert", 1)]),
    calibration(|| calibrator::circuit(Step::Degrees180), &[("calibrate", 1)]),
    calibration(|| calibrator::circuit(Step::Degrees90), &[("calibrate", 2)]),
    calibration(|| calibrator::circuit(Step::Degrees45), &[("calibrate", 3)]),
    Drive {
        figure: "14",
        block: "ring_distributor",
        build: ring::circuit,
        set: &[("forward", 1)],
        moves: &[(5, pulse("step", "step")), (1, Move::Level { pin: "forward", input: "forward" })],
        outputs: &[
            Output::Level { pin: "phase_a", signal: "phase_a" },
            Output::Level { pin: "phase_b", signal: "phase_b" },
            Output::Level { pin: "phase_c", signal: "phase_c" },
        ],
        ..NOTHING
    },
    Drive {
        figure: "15",
        block: "range_stage",
        build: range_stage::circuit,
        set: &[("range_x2", 1)],
        moves: &[(20, pulse("divided", "divided")), (1, pulse("reset_bar", "clear"))],
        outputs: &[Output::Pulses { pin: "start", signal: "pulse" }],
        ..NOTHING
    },
    Drive {
        figure: "15, 16",
        block: "direction_discriminator",
        build: discriminator::circuit,
        moves: &[
            (1, Move::Inside { pin: "start" }),
            (1, Move::Inside { pin: "middle" }),
            (1, Move::Inside { pin: "laser" }),
        ],
        copied: &[("meter", "meter"), ("standard", "standard")],
        outputs: &[
            Output::Level { pin: "q", signal: "q" },
            Output::Level { pin: "q_bar", signal: "q_bar" },
        ],
        warm_up: 60,
        ..NOTHING
    },
    Drive {
        figure: "17",
        block: "reset_counter",
        build: reset_counter::circuit,
        set: &[("forward", 1)],
        moves: &[
            (100, pulse("request", "request")),
            (4, Move::Level { pin: "forward", input: "forward" }),
            (2, Move::Level { pin: "playback", input: "playback" }),
            (1, pulse("reset_bar", "clear")),
        ],
        outputs: &[
            Output::Bits { pin: "count", count: 12, signal: "count" },
            Output::Level { pin: "count_forward", signal: "count_forward" },
            Output::Level { pin: "zero", signal: "zero" },
            Output::Pulses { pin: "taken", signal: "step" },
        ],
        ..NOTHING
    },
];
