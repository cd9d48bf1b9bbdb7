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
    decisions.pass_over(&words);
    let views: Vec<(String, &[f64])> =
        columns.iter().map(|(name, values)| (name.clone(), &**values)).collect();
    Grid::of_columns(file, "arrow", &views)
}

/// Columns of numbers, and names of the others with what they hold.
type Columns = (Vec<(String, Vec<f64>)>, Vec<(String, String)>);

fn columns(bytes: &[u8]) -> Result<Columns, ArrowError> {
    let broken = || ArrowError::IpcError("a part reaches beyond its whole".to_owned());
    checks::parts_fit(bytes).ok_or_else(broken)?;
    let reader = FileReader::try_new(Cursor::new(bytes), None)?;
    let schema = reader.schema();
    let mut columns: Vec<Option<Vec<f64>>> = vec![Some(Vec::new()); schema.fields().len()];
    let mut firsts = vec![None; columns.len()];
    for batch in reader {
        let batch = batch?;
        for ((column, first), array) in columns.iter_mut().zip(&mut firsts).zip(batch.columns()) {
            match (numbers(array).or_else(|| instants(array, first)), &mut *column) {
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
        if let Some(values) = column {
            numbers.push((name(field), values));
        } else {
            let what = format!("the type {} of Arrow", field.data_type());
            words.push((field.name().clone(), what));
        }
    }
    Ok((numbers, words))
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
        _ => return None,
    })
}

/// Instants of an array, in seconds since the first of the column.
///
/// That is taken off while they are whole numbers: a nanosecond of this century is none of a float.
fn instants(array: &dyn Array, first: &mut Option<i64>) -> Option<Vec<f64>> {
    let DataType::Timestamp(unit, _) = array.data_type() else { return None };
    let (ticks, in_a_second) = match unit {
        TimeUnit::Second => (ticks::<TimestampSecondType>(array), 1.0),
        TimeUnit::Millisecond => (ticks::<TimestampMillisecondType>(array), 1e3),
        TimeUnit::Microsecond => (ticks::<TimestampMicrosecondType>(array), 1e6),
        TimeUnit::Nanosecond => (ticks::<TimestampNanosecondType>(array), 1e9),
    };
    let mut since = |tick: i64| {
        let first = *first.get_or_insert(tick);
        wide(tick.saturating_sub(first)) / in_a_second
    };
    Some(ticks.into_iter().map(|tick| tick.map_or(f64::NAN, &mut since)).collect())
}

fn ticks<T: ArrowPrimitiveType<Native = i64>>(array: &dyn Array) -> Vec<Option<i64>> {
    array.as_primitive::<T>().iter().collect()
}

/// The name of a column, with the unit of instants.
fn name(field: &Field) -> String {
    let is_instant = matches!(field.data_type(), DataType::Timestamp(..));
    if is_instant { format!("{} (s)", field.name()) } else { field.name().clone() }
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::{RecordBatch, TimestampNanosecondArray};
    use arrow_ipc::writer::FileWriter;

    use super::*;

    /// 100 ns apart, 54 years after 1970: a float has steps of 256 ns there.
    #[test]
    fn nanoseconds_stay_apart() {
        let ticks: Vec<i64> = (0..40).map(|row| 1_717_000_000_000_000_007 + 100 * row).collect();
        let array: Arc<dyn Array> = Arc::new(TimestampNanosecondArray::from(ticks));
        let batch = RecordBatch::try_from_iter([("time", array)]).expect("one column");
        let mut bytes = Vec::new();
        let mut writer = FileWriter::try_new(&mut bytes, &batch.schema()).expect("memory");
        writer.write(&batch).expect("memory");
        writer.finish().expect("memory");
        drop(writer);
        let (columns, _) = columns(&bytes).expect("what was written");
        assert_eq!(columns[0].0, "time (s)");
        assert!((columns[0].1[39] - 39.0 * 100e-9).abs() < 1e-15, "{:?}", columns[0].1);
    }
}
