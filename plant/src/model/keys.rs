//! Every section and key of a machine file, once: the reader and the reference both look here.

use std::ops::RangeInclusive;

use crate::units::{ARCSEC, DEG_C, HPA, HZ, MM, PCT, PPM_PER_K, RPM, UM, UM_PER_M, Unit};

/// What a key holds.
#[derive(Clone, Debug)]
pub(crate) enum Kind {
    /// A text in quotes.
    Text,
    /// True or false.
    Flag,
    /// A lead, kept as an exact ratio.
    Lead,
    /// A whole number.
    Whole(RangeInclusive<i64>),
    /// A number without unit.
    Number(RangeInclusive<f64>),
    /// A text in quotes: a number with its unit.
    Quantity(Unit, RangeInclusive<f64>),
}

/// What holds when a key is not there.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Absent {
    /// The section cannot do without.
    Refused,
    /// This number, in the key's unit.
    Number(f64),
    /// What these words say.
    Means(&'static str),
}

/// A key.
#[derive(Clone, Debug)]
pub(crate) struct Key {
    pub(crate) name: &'static str,
    pub(crate) kind: Kind,
    pub(crate) absent: Absent,
    /// A value as the file writes it.
    pub(crate) example: &'static str,
    pub(crate) meaning: &'static str,
}

impl Key {
    /// A key that its section cannot do without.
    const fn new(
        name: &'static str,
        kind: Kind,
        example: &'static str,
        meaning: &'static str,
    ) -> Self {
        Self { name, kind, absent: Absent::Refused, example, meaning }
    }

    const fn or(mut self, number: f64) -> Self {
        self.absent = Absent::Number(number);
        self
    }

    const fn or_else(mut self, words: &'static str) -> Self {
        self.absent = Absent::Means(words);
        self
    }

    /// The line that sets it to its example.
    pub(crate) fn line(&self) -> String {
        format!("{} = {}", self.name, self.example)
    }
}

/// A section with its keys.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) name: &'static str,
    /// True for `[[name]]`, of which there may be many.
    pub(crate) many: bool,
    /// What it describes, and what a machine without it lacks.
    pub(crate) about: &'static str,
    pub(crate) keys: &'static [Key],
}

pub(crate) const TITLE: Key =
    Key::new("title", Kind::Text, "\"Grinder in hall 3\"", "what you call the machine")
        .or_else("none");

pub(crate) const ROTARY: Key =
    Key::new("rotary", Kind::Flag, "true", "errors are seconds of arc, and nothing travels")
        .or_else("false");
pub(crate) const OUTPUT: Table = Table {
    name: "output",
    many: false,
    about: "What comes out of the machine: travel, or an angle (worm drive, rotary table, robot \
            joint, gears on a tester).",
    keys: &[ROTARY],
};

pub(crate) const SPEED: Key =
    // Between a telescope and a dentist's drill.
    Key::new("speed", Kind::Quantity(RPM, 1e-7..=1e5), "\"6 rpm\"", "speed of the work");
pub(crate) const SPINDLE: Table = Table {
    name: "spindle",
    many: false,
    about: "What orders are counted in: one turn of the spindle, of the motor that turns the screw, \
            or of a rotary chain's output. Every machine has one.",
    keys: &[SPEED],
};

pub(crate) const LEAD: Key = Key::new(
    "lead",
    Kind::Lead,
    "\"6 mm\"",
    "travel in one turn of the spindle: `mm`, `in`, `tpi`, `pi mm`",
);
pub(crate) const LENGTH: Key =
    Key::new("length", Kind::Quantity(MM, 0.1..=1e5), "\"1000 mm\"", "length of the thread")
        .or(1000.0);
pub(crate) const EXPANSION: Key = Key::new(
    "expansion",
    Kind::Quantity(PPM_PER_K, -50.0..=500.0),
    "\"11.5 ppm/K\"",
    "thermal expansion; 11.5 is steel",
)
.or(11.5);
pub(crate) const WORKPIECE: Table = Table {
    name: "workpiece",
    many: false,
    about: "The screw that is made. An axis that makes none leaves it out: then a turn of the \
            spindle is a turn of the `lead_screw`.",
    keys: &[LEAD, LENGTH, EXPANSION],
};

pub(crate) const SCREW_LEAD: Key =
    Key::new("lead", Kind::Lead, "\"12 mm\"", "lead of the machine's own screw");
pub(crate) const LEAD_SCREW: Table = Table {
    name: "lead_screw",
    many: false,
    about: "The screw that moves the table. Without it no error is put down to its turns.",
    keys: &[SCREW_LEAD],
};

pub(crate) const GEAR_NAME: Key =
    Key::new("name", Kind::Text, "\"change gear 1\"", "what peaks at its orders are called");
pub(crate) const GEAR_ORDER: Key =
    Key::new("order", Kind::Number(1e-6..=1e9), "2.5", "turns of its shaft in one of the spindle");
pub(crate) const GEAR_TEETH: Key =
    Key::new("teeth", Kind::Whole(1..=1_000_000), "48", "teeth of the wheel on it, for the mesh")
        .or_else("the mesh has no name");
pub(crate) const GEAR: Table = Table {
    name: "gear",
    many: true,
    about: "A shaft of the drive, by its order. A line at an order that no shaft has gets no name.",
    keys: &[GEAR_NAME, GEAR_ORDER, GEAR_TEETH],
};

pub(crate) const LINES: Key =
    Key::new("lines", Kind::Whole(1..=10_000_000), "13906", "lines in one turn");
pub(crate) const DIAMETER: Key =
    Key::new("diameter", Kind::Quantity(MM, 1.0..=1e4), "\"200 mm\"", "of the track").or(200.0);
pub(crate) const GRATING: Table = Table {
    name: "grating",
    many: false,
    about: "The circular grating or encoder on the spindle.",
    keys: &[LINES, DIAMETER],
};

pub(crate) const WAVELENGTH: Key = Key::new(
    "wavelength",
    Kind::Quantity(UM, 0.2..=20.0),
    "\"0.63281983 um\"",
    "in the reference air",
);
pub(crate) const REFERENCE_TEMPERATURE: Key = Key::new(
    "reference_temperature",
    Kind::Quantity(DEG_C, -40.0..=100.0),
    "\"20 degC\"",
    "air in which the wavelength holds",
)
.or(20.0);
pub(crate) const REFERENCE_PRESSURE: Key = Key::new(
    "reference_pressure",
    Kind::Quantity(HPA, 500.0..=1200.0),
    "\"1013.25 hPa\"",
    "the same",
)
.or(1013.25);
pub(crate) const REFERENCE_HUMIDITY: Key =
    Key::new("reference_humidity", Kind::Quantity(PCT, 0.0..=100.0), "\"50 %\"", "the same")
        .or(50.0);
pub(crate) const LASER: Table = Table {
    name: "laser",
    many: false,
    about: "The interferometer that sees the travel, the machine's own or a calibrator's.",
    keys: &[WAVELENGTH, REFERENCE_TEMPERATURE, REFERENCE_PRESSURE, REFERENCE_HUMIDITY],
};

pub(crate) const A: Key =
    Key::new("a", Kind::Whole(1..=999), "110", "thumb wheels of the grating's divider");
pub(crate) const B: Key =
    Key::new("b", Kind::Whole(1..=999), "150", "thumb wheels of the laser's divider");
pub(crate) const RANGE: Key =
    Key::new("range", Kind::Whole(1..=2), "2", "switch of the measuring range: ×1 or ×2").or(1.0);
pub(crate) const INITIAL_PHASE: Key = Key::new(
    "initial_phase",
    Kind::Whole(0..=999),
    "150",
    "laser pulses by which the channels start apart",
)
.or_else("what is nearest to half a turn of phase");
pub(crate) const COMPENSATION: Key = Key::new(
    "compensation",
    Kind::Quantity(UM_PER_M, -1000.0..=1000.0),
    "\"6.4 um/m\"",
    "above 0 blocks laser pulses, below inserts them; 0, or at least 0.1001 in size",
)
.or(0.0);
pub(crate) const DIVIDERS: Table = Table {
    name: "dividers",
    many: false,
    about: "Thumb wheels of the correction device, which compares grating and laser; `helixlock \
            dividers` works them out. Without it the machine has no such device.",
    keys: &[A, B, RANGE, INITIAL_PHASE, COMPENSATION],
};

pub(crate) const STEP: Key = Key::new(
    "step",
    Kind::Quantity(UM, 1e-6..=1e3),
    "\"0.0125 um\"",
    "travel of one step; an angle on a rotary chain",
);
pub(crate) const FREQUENCY: Key =
    Key::new("frequency", Kind::Quantity(HZ, 1e-3..=1e7), "\"160 Hz\"", "steps a second");
pub(crate) const DRIVE: Table = Table {
    name: "drive",
    many: false,
    about: "The stepping motor that corrects, and is counted in the column `steps`.",
    keys: &[STEP, FREQUENCY],
};

pub(crate) const CUTOFF: Key =
    Key::new("cutoff", Kind::Quantity(HZ, 1e-6..=1e6), "\"1 Hz\"", "of the recorder's low pass");
pub(crate) const FILTER: Table = Table {
    name: "filter",
    many: false,
    about: "Smoothing of the recorded error. Without it there is none.",
    keys: &[CUTOFF],
};

pub(crate) const CLOSED: Key =
    Key::new("closed", Kind::Flag, "true", "the device corrects; false: it only measures")
        .or_else("false");
pub(crate) const LOOP: Table = Table {
    name: "loop",
    many: false,
    about: "Whether the error is corrected while it is recorded; needs a `drive`.",
    keys: &[CLOSED],
};

pub(crate) const CLOCK: Key =
    Key::new("clock", Kind::Quantity(HZ, 1e3..=1e9), "\"12 MHz\"", "clock of the logic").or(12e6);
pub(crate) const BOARD: Key =
    Key::new("board", Kind::Text, "\"icestick\"", "name of a file in `constraints`")
        .or_else("no board");
pub(crate) const FPGA: Table = Table {
    name: "fpga",
    many: false,
    about: "The chip that carries the logic, for `sim` and `gen`.",
    keys: &[CLOCK, BOARD],
};

/// Constant readings; its keys are those of the logged columns.
pub(crate) const ENVIRONMENT: &str = "environment";
/// What makes the machine differ from how it was meant; its keys are those of the catalogue.
pub(crate) const EFFECT: &str = "effect";

/// Every section whose keys stand here, in the order of the reference.
pub(crate) const TABLES: &[Table] = &[
    OUTPUT, SPINDLE, WORKPIECE, LEAD_SCREW, GEAR, GRATING, LASER, DIVIDERS, DRIVE, FILTER, LOOP,
    FPGA,
];

/// Names that may stand outside of every section.
pub(crate) fn root_names() -> Vec<&'static str> {
    let tables = TABLES.iter().map(|table| table.name);
    [TITLE.name].into_iter().chain(tables).chain([ENVIRONMENT, EFFECT]).collect()
}

/// The unit a key's value is given in on this chain.
pub(crate) fn unit_on(key: &Key, rotary: bool) -> Option<Unit> {
    match &key.kind {
        Kind::Quantity(unit, _) if rotary && key.name == STEP.name => {
            Some(if *unit == UM { ARCSEC } else { *unit })
        }
        Kind::Quantity(unit, _) => Some(*unit),
        _ => None,
    }
}
