//! Arrow files, which are Feather of version 2 too: columns of numbers and of instants, with names.

mod checks;

use std::io::Cursor;
use std::panic::AssertUnwindSafe;

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, TimestampMicrosecondType,
    TimestampMillisecondType, TimestampNanosecondType, TimestampSecondType, UInt8Type, UInt16Type,
    UInt32Type, UInt64Type,
};
use arrow_array::{Array, ArrowPrimitiveType};
use arrow_ipc::reader::FileReader;
use arrow_schema::{ArrowError, DataType, Field, TimeUnit};

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;

/// Reads the columns of numbers as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let refused = |found: String| {
        ImportError::found(Place::file(file), found, "columns of numbers that Arrow reads")
    };
    // A broken file is an error for its user, whatever it is for the library.
    let read = std::panic::catch_unwind(AssertUnwindSafe(|| columns(bytes)));
    let (columns, words) = match read {
        Ok(Ok(columns)) => columns,
        Ok(Err(error)) => return Err(refused(format!("Arrow that cannot be read ({error})"))),
        Err(_) => return Err(refused("Arrow that contradicts itself".to_owned())),
    };
    if columns.iter().all(|(_, values)| values.is_empty()) {
        return Err(refused("no row of numbers".to_owned()));
    }
    if let Some(first) = words.first() {
        let number = words.len();
        decisions
            .note(format!("{number} columns that hold no numbers are left out, first `{first}`"));
    }
    let views: Vec<(String, &[f64])> =
        columns.iter().map(|(name, values)| (name.clone(), &**values)).collect();
    Grid::of_columns(file, "arrow", &views)
}

/// Columns of numbers, and names of the others.
type Columns = (Vec<(String, Vec<f64>)>, Vec<String>);

fn columns(bytes: &[u8]) -> Result<Columns, ArrowError> {
    let broken = || ArrowError::IpcError("a part reaches beyond its whole".to_owned());
    checks::parts_fit(bytes).ok_or_else(broken)?;
    let reader = FileReader::try_new(Cursor::new(bytes), None)?;
    let schema = reader.schema();
    let mut columns: Vec<Option<Vec<f64>>> = vec![Some(Vec::new()); schema.fields().len()];
    for batch in reader {
        let batch = batch?;
        for (column, array) in columns.iter_mut().zip(batch.columns()) {
            match (numbers(array), &mut *column) {
                (Some(more), Some(values)) => values.extend(more),
                _ => *column = None,
            }
        }
        let cells: usize = columns.iter().flatten().map(Vec::len).sum();
        if limits::CELLS < cells {
            let error = format!("more than {} numbers", limits::CELLS);
            return Err(ArrowError::MemoryError(error));
        }
    }
    let (mut numbers, mut words) = (Vec::new(), Vec::new());
    for (field, column) in schema.fields().iter().zip(columns) {
        match column {
            Some(values) => numbers.push(named(field, values)),
            None => words.push(field.name().clone()),
        }
    }
    Ok((numbers, words))
}

/// A column with its name; instants count from the first one, in seconds.
fn named(field: &Field, values: Vec<f64>) -> (String, Vec<f64>) {
    let DataType::Timestamp(unit, _) = field.data_type() else {
        return (field.name().clone(), values);
    };
    let second = match unit {
        TimeUnit::Second => 1.0,
        TimeUnit::Millisecond => 1e3,
        TimeUnit::Microsecond => 1e6,
        TimeUnit::Nanosecond => 1e9,
    };
    let first = values.iter().copied().find(|value| !value.is_nan()).unwrap_or_default();
    let since = values.iter().map(|value| (value - first) / second).collect();
    (format!("{} (s)", field.name()), since)
}

/// The numbers of an array, NaN where there is none; `None` when it holds no numbers.
fn numbers(array: &dyn Array) -> Option<Vec<f64>> {
    Some(match array.data_type() {
        DataType::Float64 => floats::<Float64Type>(array, |value| value),
        DataType::Float32 => floats::<Float32Type>(array, f64::from),
        DataType::Int8 => floats::<Int8Type>(array, f64::from),
        DataType::Int16 => floats::<Int16Type>(array, f64::from),
        DataType::Int32 => floats::<Int32Type>(array, f64::from),
        DataType::Int64 => floats::<Int64Type>(array, wide),
        DataType::UInt8 => floats::<UInt8Type>(array, f64::from),
        DataType::UInt16 => floats::<UInt16Type>(array, f64::from),
        DataType::UInt32 => floats::<UInt32Type>(array, f64::from),
        DataType::UInt64 => floats::<UInt64Type>(array, unsigned),
        DataType::Timestamp(TimeUnit::Second, _) => floats::<TimestampSecondType>(array, wide),
        DataType::Timestamp(TimeUnit::Millisecond, _) => {
            floats::<TimestampMillisecondType>(array, wide)
        }
        DataType::Timestamp(TimeUnit::Microsecond, _) => {
            floats::<TimestampMicrosecondType>(array, wide)
        }
        DataType::Timestamp(TimeUnit::Nanosecond, _) => {
            floats::<TimestampNanosecondType>(array, wide)
        }
        _ => return None,
    })
}

#[expect(clippy::cast_precision_loss, reason = "counters of 64 bits are read as floats do")]
fn wide(value: i64) -> f64 {
    value as f64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn unsigned(value: u64) -> f64 {
    value as f64
}

fn floats<T: ArrowPrimitiveType>(array: &dyn Array, number: fn(T::Native) -> f64) -> Vec<f64> {
    array.as_primitive::<T>().iter().map(|value| value.map_or(f64::NAN, number)).collect()
}
