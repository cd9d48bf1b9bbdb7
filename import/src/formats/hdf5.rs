//! HDF5, and MATLAB files of version 7.3, which are HDF5: data sets of numbers, in whatever group.

use std::panic::AssertUnwindSafe;

use hdf5_reader::error::Error;
use hdf5_reader::group::Group;
use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Dataset, H5Type, Hdf5File, OpenOptions};

use super::arrays::{self, Array};
use crate::build::rounded;
use crate::decide::Decisions;
use crate::error::{ImportError, Place};
use crate::grid::Grid;
use crate::limits;

/// Deepest groups; instruments have two or three.
const DEPTH: usize = 16;

/// Most data sets.
const SETS: usize = 10_000;

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
    let (mut arrays, packed) = match read {
        Ok(Ok(walk)) => (walk.arrays, walk.packed),
        Ok(Err(error)) => return Err(refused(format!("HDF5 that cannot be read ({error})"))),
        Err(_) => return Err(refused("HDF5 that contradicts itself".to_owned())),
    };
    unpack(&mut arrays, &packed, decisions);
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
    let mut walk = Walk { arrays: Vec::new(), packed: Vec::new(), numbers: 0, sets: 0 };
    walk.group(&file.root_group()?, "", 0)?;
    Ok(walk)
}

struct Walk {
    arrays: Vec<Array>,
    packed: Vec<(String, Packing)>,
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
        self.numbers = self.numbers.saturating_add(rows.saturating_mul(columns));
        if limits::CELLS < self.numbers {
            return Err(Error::InvalidData(format!("more than {} numbers", limits::CELLS)));
        }
        let Some(values) = values(set)? else { return Ok(()) };
        if values.len() != rows * columns || values.is_empty() {
            return Ok(());
        }
        // HDF5 holds row by row; MATLAB writes its columns as rows.
        let (rows, values) = match (columns, from_matlab) {
            (1, _) => (rows, values),
            (_, true) => (columns, values),
            (_, false) => (rows, transposed(&values, columns)),
        };
        let name = format!("{path}{}", last(set.name()));
        self.packed.extend(Packing::of(set).map(|packing| (name.clone(), packing)));
        self.arrays.push(Array { name, rows, values });
        Ok(())
    }
}

/// The name without the groups that it is in.
fn last(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

fn transposed(values: &[f64], columns: usize) -> Vec<f64> {
    (0..columns).flat_map(|column| values.iter().skip(column).step_by(columns).copied()).collect()
}

/// The numbers of a set, row by row; `None` when it holds none.
#[expect(clippy::cast_precision_loss, reason = "counters of 64 bits are read as floats do")]
fn values(set: &Dataset) -> Result<Option<Vec<f64>>, Error> {
    fn floats<T: H5Type + Copy + Into<f64>>(set: &Dataset) -> Result<Vec<f64>, Error> {
        Ok(set.read_array::<T>()?.iter().map(|value| (*value).into()).collect())
    }
    let values = match *set.dtype() {
        Datatype::FloatingPoint { size: 4, .. } => floats::<f32>(set)?,
        Datatype::FloatingPoint { size: 8, .. } => floats::<f64>(set)?,
        Datatype::FixedPoint { size: 1, signed: true, .. } => floats::<i8>(set)?,
        Datatype::FixedPoint { size: 1, signed: false, .. } => floats::<u8>(set)?,
        Datatype::FixedPoint { size: 2, signed: true, .. } => floats::<i16>(set)?,
        Datatype::FixedPoint { size: 2, signed: false, .. } => floats::<u16>(set)?,
        Datatype::FixedPoint { size: 4, signed: true, .. } => floats::<i32>(set)?,
        Datatype::FixedPoint { size: 4, signed: false, .. } => floats::<u32>(set)?,
        Datatype::FixedPoint { size: 8, signed: true, .. } => {
            set.read_array::<i64>()?.iter().map(|value| *value as f64).collect()
        }
        Datatype::FixedPoint { size: 8, signed: false, .. } => {
            set.read_array::<u64>()?.iter().map(|value| *value as f64).collect()
        }
        _ => return Ok(None),
    };
    Ok(Some(values))
}
