//! The file of a sheet: what is printed on it, what is known of the measurement, tolerances.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use helixlock_metrology::uncertainty::{Acts, Source, misalignment};
use helixlock_plant::units::{DEG_C, MM, PPM_PER_K, UM, UM_PER_M, Unit};
use toml_edit::{Document, Item, TableLike};

use super::named::Named;
use super::reader::{KELVIN, Reader};
use crate::shared::input::Input;

/// What a sheet is about; each needs other things to be told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Subject {
    /// Positions, compared with a device over this length, mm.
    Positions(f64),
    /// Heights, read by three probes.
    Heights,
}

/// The file of a sheet.
#[derive(Default)]
pub(crate) struct SheetFile {
    path: PathBuf,
    /// True when there is one.
    pub(crate) told: bool,
    /// What is printed, or to be filled in.
    pub(crate) head: Vec<(&'static str, Option<String>)>,
    /// What may be wrong with the measurement.
    pub(crate) sources: Vec<Source>,
    /// What was not told, but has to be for an uncertainty.
    pub(crate) missing: Vec<&'static str>,
    /// Most that a figure may be, µm, with the place in the file.
    tolerances: Vec<(String, f64, String)>,
}

/// Keys of `[sheet]`, and what they are called when printed.
const HEAD: [(&str, &str); 8] = [
    ("laboratory", "Laboratory"),
    ("certificate", "Certificate no."),
    ("object", "Object"),
    ("instrument", "Instrument"),
    ("traceability", "Traceability"),
    ("place", "Place"),
    ("date", "Date"),
    ("operator", "Operator"),
];

const DEVICE: [&str; 8] = [
    "calibration",
    "at_each_place",
    "at_each_reading",
    "misalignment",
    "temperature",
    "temperature_uncertainty",
    "expansion",
    "expansion_uncertainty",
];
const OBJECT: [&str; 4] =
    ["temperature", "temperature_uncertainty", "expansion", "expansion_uncertainty"];

/// Lengths are referred to this temperature, °C (ISO 1).
const REFERENCE_C: f64 = 20.0;
/// What the zeros of the probes do is known to whoever separates the heights: not here.
pub(crate) const ZEROS: &str = "zeros of the probes";
/// What noise does to a screw is known to whoever takes it off: not here.
pub(crate) const FROM_READING_TO_READING: &str = "device, from reading to reading";

impl SheetFile {
    /// The same where readings contradict the noise that is told of them.
    pub(crate) fn without_noise_known(mut self) -> Self {
        self.missing.push("noise that is new at every reading");
        self
    }

    /// A sheet of which nothing is known.
    pub(crate) fn empty() -> Self {
        let head = HEAD.map(|(_, name)| (name, None)).into();
        Self { head, missing: vec!["the measurement (`--sheet`)"], ..Self::default() }
    }

    /// Reads it.
    pub(crate) fn read(path: &Path, subject: Subject) -> anyhow::Result<Self> {
        let input = Input::read(path)?;
        let text = std::str::from_utf8(input.bytes())
            .map_err(|_| anyhow!("{}: no UTF-8, expected TOML", path.display()))?;
        let reader = Reader { path, text };
        let document = Document::parse(text).map_err(|error| {
            let message = error.message().trim().replace('\n', ", ");
            anyhow!("{}: {message}", reader.at(error.span()))
        })?;
        let root = document.as_table();
        reader.only(
            root,
            "the file",
            &["sheet", "device", "object", "environment", "tolerance"],
        )?;
        let mut file = Self { path: path.to_owned(), told: true, ..Self::default() };
        let head = reader.table(root, "sheet", &HEAD.map(|(key, _)| key))?;
        for (key, name) in HEAD {
            file.head.push((name, reader.text(head, key)?));
        }
        match subject {
            Subject::Positions(length_mm) => file.positions(&reader, root, length_mm)?,
            Subject::Heights => file.heights(&reader, root)?,
        }
        file.tolerances = tolerances(&reader, root)?;
        Ok(file)
    }

    /// Lengths by a device, of an object, in an environment.
    fn positions(
        &mut self,
        reader: &Reader<'_>,
        root: &dyn TableLike,
        length_mm: f64,
    ) -> anyhow::Result<()> {
        let device = reader.table(root, "device", &DEVICE)?;
        let object = reader.table(root, "object", &OBJECT)?;
        let environment = reader.table(root, "environment", &["variation"])?;
        self.calibrated(reader, device, "calibration of the device")?;
        self.misaligned(reader, device, length_mm)?;
        self.body(reader, device, "the device", None)?;
        self.body(
            reader,
            object,
            "the object",
            Some(["`object.temperature_uncertainty`", "`object.expansion_uncertainty`"]),
        )?;
        for (key, name, acts) in [
            ("at_each_place", "device, from place to place", Acts::AtEachPlace(1.0)),
            ("at_each_reading", FROM_READING_TO_READING, Acts::AtEachReading(1.0)),
        ] {
            self.sources.extend(reader.source(device, (key, name), &UM, acts)?);
        }
        self.surrounded(reader, environment)
    }

    /// What the certificate of the device leaves.
    fn calibrated(
        &mut self,
        reader: &Reader<'_>,
        device: Option<&dyn TableLike>,
        quantity: &str,
    ) -> anyhow::Result<()> {
        let words = ("calibration", quantity);
        let found = reader.source(device, words, &UM_PER_M, Acts::OnLengths(1.0))?;
        self.needs(found, "`device.calibration`");
        Ok(())
    }

    /// How the surroundings vary.
    fn surrounded(
        &mut self,
        reader: &Reader<'_>,
        environment: Option<&dyn TableLike>,
    ) -> anyhow::Result<()> {
        let words = ("variation", "variation of the environment");
        let found = reader.source(environment, words, &UM, Acts::AsTimeGoes(1.0))?;
        self.needs(found, "`environment.variation`");
        Ok(())
    }

    /// How far the measuring line may be off the axis.
    fn misaligned(
        &mut self,
        reader: &Reader<'_>,
        device: Option<&dyn TableLike>,
        length_mm: f64,
    ) -> anyhow::Result<()> {
        match device.and_then(|table| table.get("misalignment")) {
            None => self.missing.push("`device.misalignment`"),
            Some(item) => {
                let offset_mm = reader.quantity(item, "misalignment", &MM)?;
                if offset_mm < 0.0 || length_mm <= offset_mm {
                    bail!(
                        "{}: `misalignment` is {offset_mm} mm, expected 0 mm to less than the {length_mm} mm measured",
                        reader.at(item.span())
                    );
                }
                self.sources.push(misalignment(offset_mm, length_mm));
            }
        }
        Ok(())
    }

    /// Temperature and expansion of a body whose length counts at 20 °C.
    fn body(
        &mut self,
        reader: &Reader<'_>,
        table: Option<&dyn TableLike>,
        name: &str,
        needed: Option<[&'static str; 2]>,
    ) -> anyhow::Result<()> {
        let told = |key: &str| table.and_then(|table| table.get(key));
        let plain = |key: &str, unit: &Unit| {
            told(key).map(|item| reader.quantity(item, key, unit)).transpose()
        };
        let (temperature_c, expansion) =
            (plain("temperature", &DEG_C)?, plain("expansion", &PPM_PER_K)?);
        let mut of = |key: &str,
                      unit,
                      what: String,
                      estimate: Option<f64>,
                      per_unit: Option<f64>,
                      absent: Option<&'static str>| {
            let found = reader.source(
                table,
                (key, &what),
                unit,
                Acts::OnLengths(per_unit.unwrap_or(0.0)),
            )?;
            match (found, estimate.zip(per_unit)) {
                (Some(found), Some((estimate, _))) => {
                    self.sources.push(Source { estimate, ..found });
                }
                (Some(_), None) => bail!(
                    "{}: `{key}` without `temperature` and `expansion`, expected both beside it",
                    reader.at(told(key).and_then(Item::span))
                ),
                (None, _) => self.missing.extend(absent),
            }
            Ok(())
        };
        let beyond = temperature_c.map(|temperature_c| temperature_c - REFERENCE_C);
        let [temperature, coefficient] = needed.map_or([None; 2], |both| both.map(Some));
        of(
            "temperature_uncertainty",
            &KELVIN,
            format!("temperature of {name} above {REFERENCE_C} °C"),
            beyond,
            expansion,
            temperature,
        )?;
        of(
            "expansion_uncertainty",
            &PPM_PER_K,
            format!("expansion of {name}"),
            expansion,
            beyond,
            coefficient,
        )
    }

    /// Heights by probes.
    fn heights(&mut self, reader: &Reader<'_>, root: &dyn TableLike) -> anyhow::Result<()> {
        let device = reader.table(root, "device", &["calibration", "zeros"])?;
        let environment = reader.table(root, "environment", &["variation"])?;
        reader.table(root, "object", &[])?;
        self.calibrated(reader, device, "calibration of the probes")?;
        self.needs(
            reader.source(device, ("zeros", ZEROS), &UM, Acts::AtEachPlace(1.0))?,
            "`device.zeros`",
        );
        self.surrounded(reader, environment)
    }

    fn needs(&mut self, source: Option<Source>, name: &'static str) {
        match source {
            Some(source) => self.sources.push(source),
            None => self.missing.push(name),
        }
    }

    /// Refuses a tolerance of a figure that there is not.
    pub(super) fn only_figures(&self, named: &[Named]) -> anyhow::Result<()> {
        for (key, _, place) in &self.tolerances {
            if !named.iter().any(|figure| figure.key == *key) {
                let expected: Vec<String> =
                    named.iter().map(|one| format!("`{}`", one.key)).collect();
                bail!("{place}: no figure `{key}` here, expected one of {}", expected.join(", "));
            }
        }
        Ok(())
    }

    /// What a figure may be at most, µm.
    pub(super) fn tolerance_um(&self, key: &str) -> Option<f64> {
        self.tolerances.iter().find(|(name, ..)| name == key).map(|(_, most_um, _)| *most_um)
    }

    /// Sets a tolerance that was told on the command line, unless the file has one.
    pub(crate) fn with_tolerance(
        mut self,
        key: &str,
        most_um: Option<f64>,
    ) -> anyhow::Result<Self> {
        let Some(most_um) = most_um else { return Ok(self) };
        if let Some((.., place)) = self.tolerances.iter().find(|(name, ..)| name == key) {
            bail!(
                "{place}: a tolerance of `{key}`, expected one here or on the command line, not both"
            );
        }
        self.tolerances.push((key.to_owned(), most_um, self.path.display().to_string()));
        Ok(self)
    }
}

/// Most that a figure may be, µm, with the place in the file.
fn tolerances(
    reader: &Reader<'_>,
    root: &dyn TableLike,
) -> anyhow::Result<Vec<(String, f64, String)>> {
    let mut tolerances = Vec::new();
    for (key, item) in reader.section(root, "tolerance")?.into_iter().flat_map(TableLike::iter) {
        let most_um = reader.quantity(item, key, &UM)?;
        let place = reader.at(item.span()).to_string();
        if most_um <= 0.0 {
            bail!("{place}: `{key}` is {most_um} um, expected more than 0");
        }
        tolerances.push((key.to_owned(), most_um, place));
    }
    Ok(tolerances)
}
