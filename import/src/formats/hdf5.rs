//! HDF5, and MATLAB files of version 7.3, which are HDF5: data sets of numbers, in whatever group.
//! Of a compound set, such as a table of h5py, each member that is a number is an array.

use std::panic::AssertUnwindSafe;

use hdf5_reader::error::Error;
use hdf5_reader::group::Group;
use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Dataset, H5Type, Hdf5File, OpenOptions, dtype_element_size};

use super::arrays::{self, Array};
use crate::build::rounded;
use crate::data;
use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;

/// Deepest groups; instruments have two or three.
const DEPTH: usize = 16;

/// Most data sets.
const SETS: usize = 10_000;

/// Most numbers in one element of a compound set.
const MEMBERS: usize = 1_000;

/// Where MATLAB keeps what its cells refer to.
const REFERENCES: &str = "#refs#";

/// Reads the data sets as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let refused = |found: String| {
        let expected = "data sets of numbers that another reader of HDF5 opens";
        ImportError::found(Place::file(decisions.file()), found, expected)
    };
    // A broken file is an error for its user, whatever it is for the library.
    let read = std::panic::catch_unwind(AssertUnwindSafe(|| all(bytes)));
    let Walk { mut arrays, packed, passed_over, .. } = match read {
        Ok(Ok(walk)) => walk,
        Ok(Err(error)) => return Err(refused(format!("HDF5 that cannot be read ({error})"))),
        Err(_) => return Err(refused("HDF5 that contradicts itself".to_owned())),
    };
    unpack(&mut arrays, &packed, decisions);
    decisions.pass_over(&passed_over);
    arrays::grid("data sets", &arrays, decisions)
}

/// How the numbers of an array are packed: CF conventions, section 8.1, as netCDF has it.
struct Packing {
    scale: f64,
    offset: f64,
    /// What stands for no value, packed.
    fill: Option<f64>,
}

/// Unpacks those arrays that the recipe names, or all that are packed.
fn unpack(arrays: &mut [Array], packed: &[(String, Packing)], decisions: &mut Decisions<'_>) {
    if packed.is_empty() {
        return;
    }
    let chosen = decisions.list("arrays", "unpacked", || {
        let names = packed.iter().map(|(name, _)| name.clone()).collect();
        let terms = packed.iter().map(|(_, Packing { scale, offset, .. })| {
            format!("scale_factor {scale}, add_offset {offset}")
        });
        (names, terms.collect::<Vec<_>>().join("; "))
    });
    for (name, packing) in packed.iter().filter(|(name, _)| chosen.contains(name)) {
        for array in arrays.iter_mut().filter(|array| array.name == *name) {
            array.values.iter_mut().for_each(|value| *value = packing.unpacked(*value));
        }
    }
}

impl Packing {
    /// Of a set; `None` where the numbers are what they are.
    fn of(set: &Dataset) -> Option<Self> {
        let number = |name: &str| set.attribute(name).ok()?.read_as_f64().ok();
        let (scale, offset) = (number("scale_factor"), number("add_offset"));
        let (scale, offset) = (scale.unwrap_or(1.0), offset.unwrap_or(0.0));
        let same = (scale - 1.0).abs() <= 0.0 && offset.abs() <= 0.0;
        (!same).then(|| Self { scale, offset, fill: number("_FillValue") })
    }

    fn unpacked(&self, value: f64) -> f64 {
        if self.fill.is_some_and(|fill| (value - fill).abs() <= 0.0) {
            return f64::NAN;
        }
        rounded(value * self.scale + self.offset)
    }
}

fn all(bytes: &[u8]) -> Result<Walk, Error> {
    let options = OpenOptions::default()
        .with_max_read_bytes(limits::UNPACKED)
        .with_max_chunk_bytes(limits::UNPACKED);
    let file = Hdf5File::from_bytes_with_options(bytes, options)?;
    let mut walk = Walk::default();
    walk.group(&file.root_group()?, "", 0)?;
    Ok(walk)
}

#[derive(Default)]
struct Walk {
    arrays: Vec<Array>,
    packed: Vec<(String, Packing)>,
    /// Names of sets of several elements that are no numbers, or of a size that none here has.
    passed_over: Vec<(String, String)>,
    numbers: usize,
    sets: usize,
}

impl Walk {
    fn group(&mut self, group: &Group, path: &str, depth: usize) -> Result<(), Error> {
        let (groups, sets) = group.members()?;
        for set in &sets {
            self.set(set, path)?;
        }
        for below in groups.iter().filter(|below| depth < DEPTH && last(below.name()) != REFERENCES)
        {
            self.group(below, &format!("{path}{}/", last(below.name())), depth + 1)?;
        }
        Ok(())
    }

    fn set(&mut self, set: &Dataset, path: &str) -> Result<(), Error> {
        self.sets += 1;
        let shape: Vec<usize> = set
            .shape()
            .iter()
            .map(|length| usize::try_from(*length).unwrap_or(usize::MAX))
            .collect();
        let from_matlab = set.attribute("MATLAB_class").is_ok();
        let Some((rows, columns)) = arrays::upright(&shape).filter(|_| self.sets <= SETS) else {
            return Ok(());
        };
        let name = format!("{path}{}", last(set.name()));
        let mut members = Vec::new();
        Member { name: name.clone(), offset: 0, kind: set.dtype() }.numbers(&mut members);
        if members.is_empty() && 1 < rows {
            self.passed_over.push((name, arrays::NO_NUMBERS.to_owned()));
        }
        let cells = rows.saturating_mul(columns).saturating_mul(members.len());
        self.numbers = self.numbers.saturating_add(cells);
        if limits::CELLS < self.numbers {
            return Err(Error::InvalidData(format!("more than {} numbers", limits::CELLS)));
        }
        if cells == 0 {
            return Ok(());
        }
        if let [Member { name, .. }] = members.as_slice() {
            self.packed.extend(Packing::of(set).map(|packing| (name.clone(), packing)));
        }
        let unit = unit_of(set);
        let (bytes, element) = (set.read_raw_bytes()?, set.raw_element_size()?.max(1));
        for member in members {
            let values: Option<Vec<f64>> =
                bytes.chunks_exact(element).map(|element| member.value(element)).collect();
            let Some(values) = values.filter(|values| values.len() == rows * columns) else {
                self.passed_over.push((member.name, arrays::NO_NUMBERS.to_owned()));
                continue;
            };
            // HDF5 holds row by row; MATLAB writes its columns as rows.
            let (rows, values) = match (columns, from_matlab) {
                (1, _) => (rows, values),
                (_, true) => (columns, values),
                (_, false) => (rows, transposed(&values, columns)),
            };
            self.arrays.push(Array { name: member.name, unit: unit.clone(), rows, values });
        }
        Ok(())
    }
}

/// The unit that an attribute of a set tells, as CF conventions have it (section 3.1) or without the plural.
fn unit_of(set: &Dataset) -> Option<String> {
    let text = |name| set.attribute(name).ok()?.read_string().ok();
    let told = text("units").or_else(|| text("unit"))?;
    data::unit(told.trim(), "").map(|_| told.trim().to_owned())
}

/// A part of each element of a set: a number, or what holds numbers.
struct Member<'a> {
    name: String,
    offset: usize,
    kind: &'a Datatype,
}

impl Member<'_> {
    /// The numbers in it, one behind the other; texts, references and enumerations are passed over.
    fn numbers(self, found: &mut Vec<Self>) {
        match self.kind {
            Datatype::Compound { fields, .. } => {
                for field in fields {
                    let name = format!("{}/{}", self.name, field.name);
                    let offset = self.offset.saturating_add(field.byte_offset as usize);
                    Member { name, offset, kind: &field.datatype }.numbers(found);
                }
            }
            Datatype::Array { base, dims } => {
                let size = dtype_element_size(base).unwrap_or(usize::MAX);
                let number: u64 = dims.iter().fold(1, |all, one| all.saturating_mul(*one));
                for index in (0..usize::try_from(number).unwrap_or(MEMBERS)).take(MEMBERS) {
                    let name = format!("{} {}", self.name, index + 1);
                    let offset = self.offset.saturating_add(index.saturating_mul(size));
                    Member { name, offset, kind: base }.numbers(found);
                }
            }
            Datatype::FixedPoint { .. } | Datatype::FloatingPoint { .. }
                if found.len() < MEMBERS =>
            {
                found.push(self);
            }
            _ => {}
        }
    }

    /// The number in an element; `None` for one of a size that no machine computes with.
    #[expect(clippy::cast_precision_loss, reason = "counters of 64 bits are read as floats do")]
    fn value(&self, element: &[u8]) -> Option<f64> {
        fn read<T: H5Type + Into<f64>>(bytes: &[u8], kind: &Datatype) -> Option<f64> {
            T::from_bytes(bytes, kind).ok().map(Into::into)
        }
        let kind = self.kind;
        let bytes = element.get(self.offset..)?.get(..dtype_element_size(kind).ok()?)?;
        match kind {
            Datatype::FloatingPoint { size: 4, .. } => read::<f32>(bytes, kind),
            Datatype::FloatingPoint { .. } => read::<f64>(bytes, kind),
            Datatype::FixedPoint { size: 1, signed: true, .. } => read::<i8>(bytes, kind),
            Datatype::FixedPoint { size: 1, .. } => read::<u8>(bytes, kind),
            Datatype::FixedPoint { size: 2, signed: true, .. } => read::<i16>(bytes, kind),
            Datatype::FixedPoint { size: 2, .. } => read::<u16>(bytes, kind),
            Datatype::FixedPoint { size: 4, signed: true, .. } => read::<i32>(bytes, kind),
            Datatype::FixedPoint { size: 4, .. } => read::<u32>(bytes, kind),
            Datatype::FixedPoint { signed: true, .. } => {
                i64::from_bytes(bytes, kind).ok().map(|value| value as f64)
            }
            _ => u64::from_bytes(bytes, kind).ok().map(|value| value as f64),
        }
    }
}

/// The name without the groups that it is in.
fn last(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

fn transposed(values: &[f64], columns: usize) -> Vec<f64> {
    (0..columns).flat_map(|column| values.iter().skip(column).step_by(columns).copied()).collect()
}
