//! The machine: what its file says but for the effects, with defaults filled in.

use std::fmt;

use crate::dividers::{Range, fringes_per_mm, settable_cycle};
use crate::lead::Lead;

/// A grinder (or a rotary chain) with its correction device, as its machine file describes it.
///
/// Quantities are in the unit of their names; leads and dividers are exact.
#[derive(Clone, Debug)]
pub struct Machine {
    /// What the user calls it.
    pub title: String,
    /// True for worm drives and rotary tables: errors are seconds of arc, and there is no thread.
    pub rotary: bool,
    /// What the machine has of what a machine may lack; the fields of a part that it lacks hold
    /// values that nothing reads.
    pub parts: Vec<Part>,
    /// What is ground.
    pub workpiece: Workpiece,
    /// What turns it.
    pub spindle: Spindle,
    /// Lead of the machine's own screw.
    pub lead_screw: Option<Lead>,
    /// Shafts between spindle and screw, to name peaks.
    pub gears: Vec<Gear>,
    /// Angle reference.
    pub grating: Grating,
    /// Length reference.
    pub laser: Laser,
    /// Thumb wheels and switches.
    pub dividers: Dividers,
    /// Step drive of the corrector.
    pub drive: Drive,
    /// Cut-off of the recorder's low-pass filter, Hz; `None` is no smoothing.
    pub filter_cutoff_hz: Option<f64>,
    /// True when the device corrects, false when it only measures.
    pub loop_closed: bool,
    /// The chip.
    pub fpga: Fpga,
    /// What the sensors around the machine say, for runs without a log of their own.
    pub environment: Environment,
}

/// A part that a machine may do without, and an effect may need.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Anything that travels: all but a rotary chain.
    Table,
    /// A screw that is made.
    Workpiece,
    /// The machine's own screw.
    LeadScrew,
    /// A circular grating.
    Grating,
    /// An interferometer.
    Laser,
    /// The device that compares grating and laser.
    Dividers,
    /// The motor that corrects.
    Drive,
}

impl Part {
    /// Its section of the machine file, or what it is.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Table => "travel",
            Self::Workpiece => "`[workpiece]`",
            Self::LeadScrew => "`[lead_screw]`",
            Self::Grating => "`[grating]`",
            Self::Laser => "`[laser]`",
            Self::Dividers => "`[dividers]`",
            Self::Drive => "`[drive]`",
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Table => f.write_str("travel, but `output.rotary` is `true`"),
            _ => write!(f, "{} in the machine file", self.word()),
        }
    }
}

/// The screw that is ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Workpiece {
    /// Its lead.
    pub lead: Lead,
    /// Length of the thread, mm; 1000 by default.
    pub length_mm: f64,
    /// Thermal expansion, ppm/K; 11.5 (steel) by default.
    pub expansion_ppm_per_k: f64,
}

/// The work spindle.
#[derive(Clone, Debug, PartialEq)]
pub struct Spindle {
    /// Turns a minute.
    pub speed_rpm: f64,
}

/// A shaft of the gear train.
#[derive(Clone, Debug, PartialEq)]
pub struct Gear {
    /// What the user calls it.
    pub name: String,
    /// Turns of the shaft per spindle turn.
    pub order: f64,
    /// Teeth of the wheel on it.
    pub teeth: Option<u32>,
}

impl Gear {
    /// Order at which its teeth mesh, per spindle turn.
    #[must_use]
    pub fn mesh_order(&self) -> Option<f64> {
        self.teeth.map(|teeth| self.order * f64::from(teeth))
    }
}

/// The circular grating on the work spindle.
#[derive(Clone, Debug, PartialEq)]
pub struct Grating {
    /// Lines of the track in use.
    pub lines: u32,
    /// Diameter of the track, mm; 200 by default.
    pub diameter_mm: f64,
}

impl Grating {
    /// That of document 1.
    pub(crate) const SG7430: Self = Self { lines: 13_906, diameter_mm: 200.0 };
}

/// The interferometer.
#[derive(Clone, Debug, PartialEq)]
pub struct Laser {
    /// Wavelength in the reference air, µm.
    pub wavelength_um: f64,
    /// Air in which the wavelength holds.
    pub reference: Air,
}

impl Laser {
    /// That of document 1, in the usual reference air.
    pub(crate) const SG7430: Self = Self {
        wavelength_um: 0.632_819_83,
        reference: Air { temperature_c: 20.0, pressure_hpa: 1013.25, humidity_pct: 50.0 },
    };
}

/// State of the air along the beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Temperature, °C.
    pub temperature_c: f64,
    /// Pressure, hPa.
    pub pressure_hpa: f64,
    /// Relative humidity, %.
    pub humidity_pct: f64,
}

/// Thumb wheels and switches of the device.
#[derive(Clone, Debug, PartialEq)]
pub struct Dividers {
    /// Grating divider, 1 to 999.
    pub a: u16,
    /// Laser divider, 1 to 999.
    pub b: u16,
    /// Measuring range; ×1 by default.
    pub range: Range,
    /// Laser pulses by which the channels start apart, 0 to 999; by default those nearest 180°.
    pub initial_phase: u16,
    /// Compensation asked for, µm/m: positive blocks pulses, negative inserts them.
    pub compensation_um_per_m: f64,
}

impl Dividers {
    /// Those of a 6 mm lead in document 1.
    pub(crate) const SG7430: Self =
        Self { a: 110, b: 150, range: Range::X2, initial_phase: 150, compensation_um_per_m: 0.0 };

    /// Laser pulses between two compensations, as the four thumb wheels can show it.
    ///
    /// `None` when there is no compensation.
    #[must_use]
    pub fn compensation_cycle(&self) -> Option<u32> {
        settable_cycle(self.compensation_um_per_m)
    }
}

/// Step drive of the corrector.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Table travel of one step, µm.
    pub step_um: f64,
    /// Steps a second.
    pub frequency_hz: f64,
}

impl Drive {
    /// That of document 1.
    pub(crate) const SG7430: Self = Self { step_um: 0.0125, frequency_hz: 160.0 };
}

/// The chip that carries the logic.
#[derive(Clone, Debug, PartialEq)]
pub struct Fpga {
    /// Clock, Hz; 12 MHz by default.
    pub clock_hz: f64,
    /// Board, when the file names one.
    pub board: Option<String>,
}

/// Constant readings of the sensors around the machine, by column name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Environment {
    /// `(column, value)` in the unit of the column's name.
    pub readings: Vec<(String, f64)>,
}

impl Environment {
    /// A reading, when there is one.
    #[must_use]
    pub fn get(&self, column: &str) -> Option<f64> {
        self.readings.iter().find(|(name, _)| name == column).map(|(_, value)| *value)
    }
}

impl Machine {
    /// True when the machine has the part.
    #[must_use]
    pub fn has(&self, part: Part) -> bool {
        self.parts.contains(&part)
    }

    /// The first of these parts that the machine does not have.
    #[must_use]
    pub fn lacks(&self, parts: &[Part]) -> Option<Part> {
        parts.iter().copied().find(|part| !self.has(*part))
    }

    /// Fringes per mm of table travel in the reference air: `N = 2/λ`.
    #[must_use]
    pub fn fringes_per_mm(&self) -> f64 {
        fringes_per_mm(self.laser.wavelength_um)
    }

    /// Table travel of one fringe, µm: `λ/2`.
    #[must_use]
    pub fn fringe_um(&self) -> f64 {
        self.laser.wavelength_um / 2.0
    }

    /// Table error that turns the phase meter by 360°, µm: `range·B·λ/2`.
    ///
    /// Source: document 1, "phase meter", equation for ΔS.
    #[must_use]
    pub fn full_scale_um(&self) -> f64 {
        f64::from(self.dividers.range.factor()) * f64::from(self.dividers.b) * self.fringe_um()
    }

    /// Comparisons a second at the nominal speed: `M/A·n/60`, halved at ×2.
    #[must_use]
    pub fn comparison_hz(&self) -> f64 {
        let lines_per_s = f64::from(self.grating.lines) * self.spindle.speed_rpm / 60.0;
        lines_per_s / f64::from(self.dividers.a) / f64::from(self.dividers.range.factor())
    }

    /// Turns of the spindle from one comparison to the next.
    #[must_use]
    pub fn turns_a_comparison(&self) -> f64 {
        self.spindle.speed_rpm / 60.0 / self.comparison_hz()
    }

    /// Nominal table speed, mm/s.
    #[must_use]
    pub fn travel_mm_per_s(&self) -> f64 {
        self.workpiece.lead.mm() * self.spindle.speed_rpm / 60.0
    }

    /// What one radian of the spindle is worth in the unit of δ: µm of travel, or seconds of arc.
    #[must_use]
    pub fn delta_per_rad(&self) -> f64 {
        if self.rotary {
            648_000.0 / std::f64::consts::PI
        } else {
            1000.0 * self.workpiece.lead.mm() / std::f64::consts::TAU
        }
    }

    /// Turns of the machine's screw per mm of table travel.
    #[must_use]
    pub fn screw_turns_per_mm(&self) -> Option<f64> {
        self.lead_screw.map(|lead| 1.0 / lead.mm())
    }

    /// Orders of all shafts and meshes, per spindle turn, with names.
    #[must_use]
    pub fn gear_orders(&self) -> Vec<(String, f64)> {
        let mut orders = Vec::new();
        for gear in &self.gears {
            orders.push((gear.name.clone(), gear.order));
            orders.extend(gear.mesh_order().map(|order| (format!("{} mesh", gear.name), order)));
        }
        orders
    }
}
