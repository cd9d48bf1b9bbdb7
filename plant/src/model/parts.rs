//! The sections of a machine file.

use super::keys::{self, Key};
use super::section::Section;
use crate::dividers::{Range, centre_phase};
use crate::lead::{Lead, LeadUnit};
use crate::machine::{
    Air, Dividers, Drive, Environment, Fpga, Gear, Grating, Laser, Machine, Part, Spindle,
    Workpiece,
};
use crate::record::LOGGED_COLUMNS;
use num_rational::Ratio;

/// What the effects of a file refer to, known even where the machine is not.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// True where δ is an angle.
    pub(super) rotary: bool,
    /// Shafts that effects name.
    pub(super) gears: Vec<Gear>,
}

pub(super) fn chain(root: &Section<'_>) -> Chain {
    let output = root.part(&keys::OUTPUT);
    let rotary = output.and_then(|section| section.flag(keys::ROTARY.name)).unwrap_or_default();
    Chain { rotary, gears: gears(root) }
}

/// The machine; `None` when anything that it needs is missing or wrong.
pub(super) fn machine(root: &Section<'_>, chain: &Chain) -> Option<Machine> {
    root.only(&keys::root_names());
    let title = root.text_of(&keys::TITLE).unwrap_or_default();
    let spindle = spindle(root);
    let lead_screw = root.part(&keys::LEAD_SCREW).and_then(|part| part.lead_of(&keys::SCREW_LEAD));
    let workpiece = workpiece(root, chain, lead_screw);
    let grating = root.part(&keys::GRATING).map(|part| grating(&part));
    let laser = root.part(&keys::LASER).map(|part| laser(&part));
    let dividers = root.part(&keys::DIVIDERS).map(|part| dividers(&part));
    let drive = root.part(&keys::DRIVE).map(|part| drive(&part, chain));
    let filter = root.part(&keys::FILTER).and_then(|part| part.number_of(&keys::CUTOFF, None));
    let (loop_closed, fpga) = (loop_closed(root), fpga(root));
    let environment = environment(root);
    device_is_whole(root, chain);
    let mut parts = Vec::new();
    let mut found = |part: Part, there: bool| parts.extend(there.then_some(part));
    found(Part::Table, !chain.rotary);
    found(Part::Workpiece, root.has(keys::WORKPIECE.name));
    found(Part::LeadScrew, lead_screw.is_some());
    found(Part::Grating, grating.is_some());
    found(Part::Laser, laser.is_some());
    found(Part::Dividers, dividers.is_some());
    found(Part::Drive, drive.is_some());
    Some(Machine {
        title: title.into(),
        rotary: chain.rotary,
        parts,
        workpiece: workpiece?,
        spindle: spindle?,
        lead_screw,
        gears: chain.gears.clone(),
        grating: grating.unwrap_or(Some(Grating::SG7430))?,
        laser: laser.unwrap_or(Some(Laser::SG7430))?,
        dividers: dividers.unwrap_or(Some(Dividers::SG7430))?,
        drive: drive.unwrap_or(Some(Drive::SG7430))?,
        filter_cutoff_hz: filter,
        loop_closed,
        fpga: fpga?,
        environment,
    })
}

/// The dividers compare a grating with a laser.
fn device_is_whole(root: &Section<'_>, chain: &Chain) {
    let needs = |part: &keys::Table| {
        if !root.has(part.name) {
            let example = part.keys[0].line();
            root.refuse::<()>(
                root.missing(part.name, &format!("[{}]` with `{example}", part.name)),
            );
        }
    };
    if root.has(keys::DIVIDERS.name) && !chain.rotary {
        needs(&keys::GRATING);
        needs(&keys::LASER);
    }
}

fn spindle(root: &Section<'_>) -> Option<Spindle> {
    if !root.has(keys::SPINDLE.name) {
        return root.refuse(root.missing(keys::SPINDLE.name, "[spindle]"));
    }
    let section = root.part(&keys::SPINDLE)?;
    Some(Spindle { speed_rpm: section.number_of(&keys::SPEED, None)? })
}

/// The screw that is made; where none is, what one turn of the axis' own screw moves.
fn workpiece(root: &Section<'_>, chain: &Chain, lead_screw: Option<Lead>) -> Option<Workpiece> {
    let standard = Workpiece {
        lead: Lead { ratio: Ratio::from_integer(6), unit: LeadUnit::Mm },
        length_mm: 1000.0,
        expansion_ppm_per_k: 11.5,
    };
    if root.has(keys::WORKPIECE.name) {
        let section = root.part(&keys::WORKPIECE)?;
        let lead = section.lead_of(&keys::LEAD);
        let length_mm = section.number_of(&keys::LENGTH, None);
        let expansion_ppm_per_k = section.number_of(&keys::EXPANSION, None)?;
        return Some(Workpiece { lead: lead?, length_mm: length_mm?, expansion_ppm_per_k });
    }
    match lead_screw {
        Some(lead) => Some(Workpiece { lead, ..standard }),
        None if chain.rotary || root.has(keys::LEAD_SCREW.name) => Some(standard),
        None => root.refuse(root.missing(
            keys::WORKPIECE.name,
            "[workpiece]` with the lead of a screw that is made, or `[lead_screw]` with that of the axis, or `output.rotary = true",
        )),
    }
}

fn gears(root: &Section<'_>) -> Vec<Gear> {
    let mut gears: Vec<Gear> = Vec::new();
    for section in root.sections(keys::GEAR.name) {
        let Some(gear) = gear(&section) else { continue };
        if gears.iter().any(|other| other.name == gear.name) {
            let conflict = "another gear has that name";
            section.refuse::<()>(section.conflict(keys::GEAR_NAME.name, conflict));
        }
        gears.push(gear);
    }
    gears
}

fn gear(section: &Section<'_>) -> Option<Gear> {
    section.only(&keys::GEAR.keys.iter().map(|key| key.name).collect::<Vec<_>>());
    let name = section.text_of(&keys::GEAR_NAME);
    let order = section.number_of(&keys::GEAR_ORDER, None);
    let teeth = section.whole_of(&keys::GEAR_TEETH);
    Some(Gear { name: name?.into(), order: order?, teeth })
}

fn grating(section: &Section<'_>) -> Option<Grating> {
    let lines = section.whole_of(&keys::LINES);
    let diameter_mm = section.number_of(&keys::DIAMETER, None)?;
    Some(Grating { lines: lines?, diameter_mm })
}

fn laser(section: &Section<'_>) -> Option<Laser> {
    let number = |key: &Key| section.number_of(key, None);
    let wavelength_um = number(&keys::WAVELENGTH);
    let temperature_c = number(&keys::REFERENCE_TEMPERATURE);
    let pressure_hpa = number(&keys::REFERENCE_PRESSURE);
    let humidity_pct = number(&keys::REFERENCE_HUMIDITY)?;
    let reference =
        Air { temperature_c: temperature_c?, pressure_hpa: pressure_hpa?, humidity_pct };
    Some(Laser { wavelength_um: wavelength_um?, reference })
}

fn dividers(section: &Section<'_>) -> Option<Dividers> {
    let a = section.whole_of(&keys::A);
    let b: Option<u16> = section.whole_of(&keys::B);
    let range: Option<u8> = section.whole_of(&keys::RANGE);
    let phase: Option<u16> = section.whole_of(&keys::INITIAL_PHASE);
    let compensation_um_per_m = compensation(section)?;
    let (a, b) = (a?, b?);
    let range = if range == Some(2) { Range::X2 } else { Range::X1 };
    let initial_phase = phase.unwrap_or_else(|| centre_phase(b, range));
    if range.factor() * b < initial_phase {
        let conflict = format!("a whole turn of phase is {} laser pulses", range.factor() * b);
        return section.refuse(section.conflict(keys::INITIAL_PHASE.name, &conflict));
    }
    Some(Dividers { a, b, range, initial_phase, compensation_um_per_m })
}

/// Seven decades of which four can be set: cycles of 1 000 to 9 999 000 pulses.
fn compensation(section: &Section<'_>) -> Option<f64> {
    let rate = section.number_of(&keys::COMPENSATION, None)?;
    if rate != 0.0 && crate::dividers::settable_cycle(rate).is_none() {
        let expected = "0 or between 0.1001 and 1000 um/m in size, which is what the four thumb \
                        wheels can show";
        return section.refuse(section.wrong(keys::COMPENSATION.name, expected));
    }
    Some(rate)
}

fn drive(section: &Section<'_>, chain: &Chain) -> Option<Drive> {
    let unit = keys::unit_on(&keys::STEP, chain.rotary);
    let step_um = section.number_of(&keys::STEP, unit.as_ref());
    let frequency_hz = section.number_of(&keys::FREQUENCY, None)?;
    Some(Drive { step_um: step_um?, frequency_hz })
}

fn loop_closed(root: &Section<'_>) -> bool {
    let Some(section) = root.part(&keys::LOOP) else { return false };
    let closed = section.flag(keys::CLOSED.name).unwrap_or_default();
    if closed && !root.has(keys::DRIVE.name) {
        let conflict = "there is no `[drive]` that could correct";
        section.refuse::<()>(section.conflict(keys::CLOSED.name, conflict));
    }
    closed
}

fn fpga(root: &Section<'_>) -> Option<Fpga> {
    if !root.has(keys::FPGA.name) {
        return Some(Fpga { clock_hz: 12e6, board: None });
    }
    let section = root.part(&keys::FPGA)?;
    let board = section.text_of(&keys::BOARD).map(Into::into);
    Some(Fpga { clock_hz: section.number_of(&keys::CLOCK, None)?, board })
}

fn environment(root: &Section<'_>) -> Environment {
    let Some(section) = root.section(keys::ENVIRONMENT) else { return Environment::default() };
    let known = || LOGGED_COLUMNS.iter().filter_map(|of| Some((of.name, of.setting.as_ref()?)));
    section.only(&known().map(|(_, setting)| setting.key).collect::<Vec<_>>());
    let readings = known().filter_map(|(column, setting)| {
        let value = section.quantity(setting.key, &setting.unit, setting.range.clone())?;
        Some((column.into(), value))
    });
    Environment { readings: readings.collect() }
}
