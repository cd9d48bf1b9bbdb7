//! The sections of a machine file.

use super::section::Section;
use crate::dividers::{Range, centre_phase};
use crate::error::MachineError;
use crate::lead::{Lead, LeadUnit};
use crate::machine::{
    Air, Dividers, Drive, Environment, Fpga, Gear, Grating, Laser, Machine, Spindle, Workpiece,
};
use crate::record::LOGGED_COLUMNS;
use crate::units::{ARCSEC, DEG_C, HPA, HZ, MM, PCT, PPM_PER_K, RPM, UM, UM_PER_M};
use num_rational::Ratio;

type Result<T> = std::result::Result<T, MachineError>;

/// Speeds between a telescope and a dentist's drill, rpm.
const SPEEDS_RPM: std::ops::RangeInclusive<f64> = 1e-7..=1e5;

pub(super) fn machine(root: &Section<'_>) -> Result<Machine> {
    root.only(&[
        "title",
        "workpiece",
        "output",
        "spindle",
        "lead_screw",
        "gear",
        "grating",
        "laser",
        "dividers",
        "drive",
        "filter",
        "loop",
        "fpga",
        "environment",
        "effect",
    ])?;
    let rotary = rotary(root)?;
    Ok(Machine {
        title: root.text("title")?.unwrap_or_default().into(),
        rotary,
        workpiece: workpiece(root, rotary)?,
        spindle: spindle(root)?,
        lead_screw: lead_screw(root)?,
        gears: gears(root)?,
        grating: grating(root, rotary)?,
        laser: laser(root, rotary)?,
        dividers: dividers(root, rotary)?,
        drive: drive(root, rotary)?,
        filter_cutoff_hz: filter(root)?,
        loop_closed: loop_closed(root)?,
        fpga: fpga(root)?,
        environment: environment(root)?,
    })
}

fn rotary(root: &Section<'_>) -> Result<bool> {
    let Some(section) = root.section("output")? else { return Ok(false) };
    section.only(&["rotary"])?;
    section.flag("rotary").map(Option::unwrap_or_default)
}

/// A part that a rotary chain can do without.
fn part<'a>(
    root: &Section<'a>,
    rotary: bool,
    key: &str,
    example: &str,
) -> Result<Option<Section<'a>>> {
    let section = root.section(key)?;
    if section.is_none() && !rotary { Err(root.missing(key, example)) } else { Ok(section) }
}

fn workpiece(root: &Section<'_>, rotary: bool) -> Result<Workpiece> {
    let standard = Workpiece {
        lead: Lead { ratio: Ratio::from_integer(6), unit: LeadUnit::Mm },
        length_mm: 1000.0,
        expansion_ppm_per_k: 11.5,
    };
    let Some(section) = part(root, rotary, "workpiece", "[workpiece]")? else {
        return Ok(standard);
    };
    section.only(&["lead", "length", "expansion"])?;
    Ok(Workpiece {
        lead: lead(&section, "lead")?.ok_or_else(|| section.missing("lead", "lead = \"6 mm\""))?,
        length_mm: section.quantity("length", &MM, 0.1..=1e5)?.unwrap_or(standard.length_mm),
        expansion_ppm_per_k: section
            .quantity("expansion", &PPM_PER_K, -50.0..=500.0)?
            .unwrap_or(standard.expansion_ppm_per_k),
    })
}

fn lead(section: &Section<'_>, key: &str) -> Result<Option<Lead>> {
    let Some(text) = section.text(key)? else { return Ok(None) };
    let expected = "a lead from 0.001 mm to 1000 mm such as \"6 mm\", \"1/6 in\" or \"0.5 pi mm\"";
    text.parse().map(Some).map_err(|_| section.wrong(key, expected))
}

fn spindle(root: &Section<'_>) -> Result<Spindle> {
    let section = root.required_section("spindle", "[spindle]")?;
    section.only(&["speed"])?;
    let speed_rpm = section
        .quantity("speed", &RPM, SPEEDS_RPM)?
        .ok_or_else(|| section.missing("speed", "speed = \"6 rpm\""))?;
    Ok(Spindle { speed_rpm })
}

fn lead_screw(root: &Section<'_>) -> Result<Option<Lead>> {
    let Some(section) = root.section("lead_screw")? else { return Ok(None) };
    section.only(&["lead"])?;
    let found = lead(&section, "lead")?;
    found.map(Some).ok_or_else(|| section.missing("lead", "lead = \"12 mm\""))
}

fn gears(root: &Section<'_>) -> Result<Vec<Gear>> {
    let mut gears: Vec<Gear> = Vec::new();
    for section in root.sections("gear")? {
        let gear = gear(&section)?;
        if gears.iter().any(|other| other.name == gear.name) {
            return Err(section.conflict("name", "another gear has that name"));
        }
        gears.push(gear);
    }
    Ok(gears)
}

fn gear(section: &Section<'_>) -> Result<Gear> {
    section.only(&["name", "order", "teeth"])?;
    let name = section.text("name")?;
    let order = section.number("order", 1e-6..=1e9)?;
    let teeth = section.whole("teeth", 1..=1_000_000)?;
    Ok(Gear {
        name: name.ok_or_else(|| section.missing("name", "name = \"change gear 1\""))?.into(),
        order: order.ok_or_else(|| section.missing("order", "order = 2.5"))?,
        teeth: teeth.and_then(|teeth| u32::try_from(teeth).ok()),
    })
}

fn grating(root: &Section<'_>, rotary: bool) -> Result<Grating> {
    let Some(section) = part(root, rotary, "grating", "[grating]")? else {
        return Ok(Grating { lines: 13_906, diameter_mm: 200.0 });
    };
    section.only(&["lines", "diameter"])?;
    let lines = section
        .whole("lines", 1..=10_000_000)?
        .and_then(|lines| u32::try_from(lines).ok())
        .ok_or_else(|| section.missing("lines", "lines = 13906"))?;
    let diameter_mm = section.quantity("diameter", &MM, 1.0..=1e4)?.unwrap_or(200.0);
    Ok(Grating { lines, diameter_mm })
}

fn laser(root: &Section<'_>, rotary: bool) -> Result<Laser> {
    let mut air = Air { temperature_c: 20.0, pressure_hpa: 1013.25, humidity_pct: 50.0 };
    let Some(section) = part(root, rotary, "laser", "[laser]")? else {
        return Ok(Laser { wavelength_um: 0.632_819_83, reference: air });
    };
    section.only(&[
        "wavelength",
        "reference_temperature",
        "reference_pressure",
        "reference_humidity",
    ])?;
    let wavelength = section.quantity("wavelength", &UM, 0.2..=20.0)?;
    let wavelength_um = wavelength
        .ok_or_else(|| section.missing("wavelength", "wavelength = \"0.63281983 um\""))?;
    if let Some(found) = section.quantity("reference_temperature", &DEG_C, -40.0..=100.0)? {
        air.temperature_c = found;
    }
    if let Some(found) = section.quantity("reference_pressure", &HPA, 500.0..=1200.0)? {
        air.pressure_hpa = found;
    }
    if let Some(found) = section.quantity("reference_humidity", &PCT, 0.0..=100.0)? {
        air.humidity_pct = found;
    }
    Ok(Laser { wavelength_um, reference: air })
}

fn dividers(root: &Section<'_>, rotary: bool) -> Result<Dividers> {
    let Some(section) = part(root, rotary, "dividers", "[dividers]")? else {
        let (range, compensation_um_per_m) = (Range::X2, 0.0);
        return Ok(Dividers { a: 110, b: 150, range, initial_phase: 150, compensation_um_per_m });
    };
    section.only(&["a", "b", "range", "initial_phase", "compensation"])?;
    let preset = |key, low| -> Result<Option<u16>> {
        let found = section.whole(key, low..=999)?;
        Ok(found.and_then(|preset| u16::try_from(preset).ok()))
    };
    let a = preset("a", 1)?.ok_or_else(|| section.missing("a", "a = 110"))?;
    let b = preset("b", 1)?.ok_or_else(|| section.missing("b", "b = 150"))?;
    let range = if section.whole("range", 1..=2)? == Some(2) { Range::X2 } else { Range::X1 };
    let initial_phase = preset("initial_phase", 0)?.unwrap_or_else(|| centre_phase(b, range));
    if range.factor() * b < initial_phase {
        return Err(section.conflict(
            "initial_phase",
            &format!("a whole turn of phase is {} laser pulses", range.factor() * b),
        ));
    }
    Ok(Dividers { a, b, range, initial_phase, compensation_um_per_m: compensation(&section)? })
}

/// Seven decades of which four can be set: cycles of 1 000 to 9 999 000 pulses.
fn compensation(section: &Section<'_>) -> Result<f64> {
    let Some(rate) = section.quantity("compensation", &UM_PER_M, -1000.0..=1000.0)? else {
        return Ok(0.0);
    };
    if rate != 0.0 && crate::dividers::settable_cycle(rate).is_none() {
        let expected = "0 or between 0.1001 and 1000 um/m in size, which is what the four thumb \
                        wheels can show";
        return Err(section.wrong("compensation", expected));
    }
    Ok(rate)
}

fn drive(root: &Section<'_>, rotary: bool) -> Result<Drive> {
    let Some(section) = part(root, rotary, "drive", "[drive]")? else {
        return Ok(Drive { step_um: 0.0125, frequency_hz: 160.0 });
    };
    section.only(&["step", "frequency"])?;
    let unit = if rotary { &ARCSEC } else { &UM };
    let step_um = section.quantity("step", unit, 1e-6..=1e3)?;
    let frequency_hz = section.quantity("frequency", &HZ, 1e-3..=1e7)?;
    Ok(Drive {
        step_um: step_um.ok_or_else(|| section.missing("step", "step = \"0.0125 um\""))?,
        frequency_hz: frequency_hz
            .ok_or_else(|| section.missing("frequency", "frequency = \"160 Hz\""))?,
    })
}

fn filter(root: &Section<'_>) -> Result<Option<f64>> {
    let Some(section) = root.section("filter")? else { return Ok(None) };
    section.only(&["cutoff"])?;
    section
        .quantity("cutoff", &HZ, 1e-6..=1e6)?
        .map(Some)
        .ok_or_else(|| section.missing("cutoff", "cutoff = \"1 Hz\""))
}

fn loop_closed(root: &Section<'_>) -> Result<bool> {
    let Some(section) = root.section("loop")? else { return Ok(false) };
    section.only(&["closed"])?;
    section.flag("closed").map(Option::unwrap_or_default)
}

fn fpga(root: &Section<'_>) -> Result<Fpga> {
    let Some(section) = root.section("fpga")? else {
        return Ok(Fpga { clock_hz: 12e6, board: None });
    };
    section.only(&["clock", "board"])?;
    Ok(Fpga {
        clock_hz: section.quantity("clock", &HZ, 1e3..=1e9)?.unwrap_or(12e6),
        board: section.text("board")?.map(Into::into),
    })
}

fn environment(root: &Section<'_>) -> Result<Environment> {
    let Some(section) = root.section("environment")? else { return Ok(Environment::default()) };
    let known = || LOGGED_COLUMNS.iter().filter_map(|of| Some((of.name, of.setting.as_ref()?)));
    section.only(&known().map(|(_, setting)| setting.key).collect::<Vec<_>>())?;
    let mut readings = Vec::new();
    for (column, setting) in known() {
        if let Some(value) = section.quantity(setting.key, &setting.unit, setting.range.clone())? {
            readings.push((column.into(), value));
        }
    }
    Ok(Environment { readings })
}
