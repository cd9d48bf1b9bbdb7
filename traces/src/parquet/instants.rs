//! Columns of instants, as seconds since their first.

use std::cell::Cell;

use ::parquet::basic::{ConvertedType, LogicalType, TimeUnit, Type as PhysicalType};
use ::parquet::column::reader::ColumnReader;
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::schema::types::ColumnDescriptor;
use bytes::Bytes;

use super::checks::check_dictionary;
use super::{Values, append, nearest_i64};

/// How many units of an instant are a second; `None` for a column of something else.
pub(super) fn ticks_in_a_second(column: &ColumnDescriptor) -> Option<f64> {
    let is_int64 = column.physical_type() == PhysicalType::INT64 && column.max_rep_level() == 0;
    let in_a_second = match (column.logical_type_ref(), column.converted_type()) {
        (Some(LogicalType::Timestamp(instant)), _) => match instant.unit {
            TimeUnit::MILLIS => 1e3,
            TimeUnit::MICROS => 1e6,
            TimeUnit::NANOS => 1e9,
        },
        (_, ConvertedType::TIMESTAMP_MILLIS) => 1e3,
        (_, ConvertedType::TIMESTAMP_MICROS) => 1e6,
        _ => return None,
    };
    is_int64.then_some(in_a_second)
}

/// Seconds since the first instant, which is taken off while both are whole: a float has no nanoseconds of
/// this century.
pub(super) fn read_instants(
    file: &SerializedFileReader<Bytes>,
    (index, descriptor): (usize, &ColumnDescriptor),
    rows: usize,
    in_a_second: f64,
) -> Result<Vec<f64>, ParquetError> {
    let first = Cell::new(None);
    let since = |tick: i64| {
        let begin = first.get().unwrap_or(tick);
        first.set(Some(begin));
        nearest_i64(tick.saturating_sub(begin)) / in_a_second
    };
    let mut values = Values::numbers(rows);
    for group in 0..file.num_row_groups() {
        check_dictionary(file, group, index)?;
        let reader = file.get_row_group(group)?.get_column_reader(index)?;
        let ColumnReader::Int64ColumnReader(column) = reader else {
            return Err(ParquetError::General("a column changed its type".into()));
        };
        append(column, descriptor.max_def_level(), &mut values, since)?;
    }
    Ok(values.cells)
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use ::parquet::data_type::{DoubleType, Int32Type, Int64Type};
    use ::parquet::file::writer::SerializedFileWriter;
    use ::parquet::schema::parser::parse_message_type;

    use super::super::{read_foreign_parquet, read_parquet};

    /// 100 ns apart, 54 years after 1970: a float has steps of 256 ns there.
    #[test]
    fn instants_are_read_to_the_nanosecond_beside_what_is_left_out() {
        let schema = "message m { required int64 t (TIMESTAMP(NANOS,true)); required int32 day (DATE); \
                      required double error_um; }";
        let schema = Arc::new(parse_message_type(schema).unwrap());
        let mut bytes = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let ticks: Vec<i64> = (0..40).map(|row| 1_717_000_000_000_000_007 + 100 * row).collect();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(&ticks, None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int32Type>().write_batch(&[20_000; 40], None, None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&[0.5; 40], None, None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.close().unwrap();
        let path = Path::new("data.parquet");
        assert!(read_parquet(bytes.clone(), path).is_err());
        let table = read_foreign_parquet(bytes, path).unwrap().table;
        assert_eq!(table.names().collect::<Vec<_>>(), ["t (s)", "error_um"]);
        assert_eq!(table.text[0].name, "day");
        assert!((table.columns[0].values[39] - 39.0 * 100e-9).abs() < 1e-15);
    }
}
