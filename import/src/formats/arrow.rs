//! Arrow files, which are Feather of version 2 too: columns of numbers, instants and words, with names.

mod cells;
mod checks;

use std::io::Cursor;
use std::panic::AssertUnwindSafe;

use arrow_ipc::reader::FileReader;
use arrow_schema::{ArrowError, DataType, Field};

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::{Cells, Grid};
use crate::limits;
use crate::place::Place;
use cells::Column;

/// Reads the columns as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let refused = |found: String| {
        ImportError::found(Place::file(file), found, "columns of numbers that Arrow reads")
    };
    // A broken file is an error for its user, whatever it is for the library.
    let read = std::panic::catch_unwind(AssertUnwindSafe(|| columns(bytes)));
    let (columns, others) = match read {
        Ok(Ok(columns)) => columns,
        Ok(Err(error)) => return Err(refused(format!("Arrow that cannot be read ({error})"))),
        Err(_) => return Err(refused("Arrow that contradicts itself".to_owned())),
    };
    let cells: Vec<(&str, Cells<'_>)> =
        columns.iter().filter_map(|(name, column)| Some((&**name, column.cells()?))).collect();
    if cells.iter().all(|(_, cells)| cells.len() == 0) {
        return Err(refused("no row of numbers".to_owned()));
    }
    decisions.pass_over(&others);
    Grid::of_columns(file, "arrow", &cells)
}

/// Columns with their names, and names of the others with what they hold.
type Columns = (Vec<(String, Column)>, Vec<(String, String)>);

fn columns(bytes: &[u8]) -> Result<Columns, ArrowError> {
    let broken = || ArrowError::IpcError("a part reaches beyond its whole".to_owned());
    checks::parts_fit(bytes).ok_or_else(broken)?;
    let reader = FileReader::try_new(Cursor::new(bytes), None)?;
    let schema = reader.schema();
    let mut columns: Vec<Column> = schema.fields().iter().map(|_| Column::default()).collect();
    for batch in reader {
        for (column, array) in columns.iter_mut().zip(batch?.columns()) {
            column.append(array);
        }
        let (cells, bytes) = columns
            .iter()
            .map(Column::size)
            .fold((0, 0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        if limits::CELLS < cells || limits::UNPACKED < bytes {
            let error = format!("more than {} cells or {} bytes", limits::CELLS, limits::UNPACKED);
            return Err(ArrowError::MemoryError(error));
        }
    }
    let (mut read, mut others) = (Vec::new(), Vec::new());
    for (field, column) in schema.fields().iter().zip(columns) {
        if column.cells().is_some() {
            read.push((name(field), column));
        } else {
            let what = format!("the type {} of Arrow", field.data_type());
            others.push((field.name().clone(), what));
        }
    }
    Ok((read, others))
}

/// The name of a column, with the unit of instants.
fn name(field: &Field) -> String {
    let is_instant = matches!(field.data_type(), DataType::Timestamp(..));
    if is_instant { format!("{} (s)", field.name()) } else { field.name().clone() }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::types::Int8Type;
    use arrow_array::{
        Array, Decimal128Array, DictionaryArray, RecordBatch, StringViewArray,
        TimestampNanosecondArray,
    };
    use arrow_ipc::writer::FileWriter;

    use super::*;

    fn read(name: &str, array: Arc<dyn Array>) -> (String, Column) {
        let batch = RecordBatch::try_from_iter([(name, array)]).expect("one column");
        let mut bytes = Vec::new();
        let mut writer = FileWriter::try_new(&mut bytes, &batch.schema()).expect("memory");
        writer.write(&batch).expect("memory");
        writer.finish().expect("memory");
        drop(writer);
        columns(&bytes).expect("what was written").0.remove(0)
    }

    fn numbers(column: &Column) -> &[f64] {
        let Some(Cells::Numbers(values)) = column.cells() else { panic!("{column:?}") };
        values
    }

    fn words(column: &Column) -> &[String] {
        let Some(Cells::Words(words)) = column.cells() else { panic!("{column:?}") };
        words
    }

    /// 100 ns apart, 54 years after 1970: a float has steps of 256 ns there.
    #[test]
    fn nanoseconds_stay_apart() {
        let ticks: Vec<i64> = (0..40).map(|row| 1_717_000_000_000_000_007 + 100 * row).collect();
        let (name, column) = read("time", Arc::new(TimestampNanosecondArray::from(ticks)));
        assert_eq!(name, "time (s)");
        assert!((numbers(&column)[39] - 39.0 * 100e-9).abs() < 1e-15, "{column:?}");
    }

    #[test]
    fn decimals_are_numbers() {
        let array = Decimal128Array::from(vec![Some(-12_345), None, Some(5)]);
        let array = array.with_precision_and_scale(9, 3).expect("a scale");
        let (_, column) = read("error_um", Arc::new(array));
        let values = numbers(&column);
        assert_eq!(values[0].to_bits(), (-12.345_f64).to_bits());
        assert!(values[1].is_nan());
        assert_eq!(values[2].to_bits(), 0.005_f64.to_bits());
    }

    #[test]
    fn words_are_read_one_by_one_and_by_a_dictionary() {
        let held = [Some("forward"), None, Some("reverse"), Some("forward")];
        let coded: DictionaryArray<Int8Type> = held.into_iter().collect();
        let arrays: [Arc<dyn Array>; 2] =
            [Arc::new(StringViewArray::from_iter(held)), Arc::new(coded)];
        for array in arrays {
            let (_, column) = read("direction", array);
            assert_eq!(words(&column), ["forward", "", "reverse", "forward"]);
        }
    }
}
