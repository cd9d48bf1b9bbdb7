//! Columns of words.

use std::cell::Cell;

use ::parquet::column::reader::ColumnReader;
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::schema::types::ColumnDescriptor;
use bytes::Bytes;

use super::checks::check_dictionary;
use super::{Values, append};
use crate::table::shortened;

/// Most bytes of the words of a column: a dictionary repeats its words for a bit a row.
const MOST_BYTES: usize = 256 << 20;

/// A column of words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words {
    /// Name as in the file.
    pub name: String,
    /// One a row, empty where there is none.
    pub words: Vec<String>,
}

/// All words of a column; `None` for more of them than memory should hold.
pub(super) fn read_words(
    file: &SerializedFileReader<Bytes>,
    (index, descriptor): (usize, &ColumnDescriptor),
    rows: usize,
) -> Result<Option<Vec<String>>, ParquetError> {
    let bytes = Cell::new(0_usize);
    let word = |held: &[u8]| {
        bytes.set(bytes.get().saturating_add(held.len()));
        let few = bytes.get() <= MOST_BYTES;
        if few { String::from_utf8_lossy(held).into_owned() } else { String::new() }
    };
    let mut values = Values { cells: Vec::new(), missing: String::new(), most: rows };
    for group in 0..file.num_row_groups() {
        check_dictionary(file, group, index)?;
        let reader = file.get_row_group(group)?.get_column_reader(index)?;
        let ColumnReader::ByteArrayColumnReader(column) = reader else {
            return Err(ParquetError::General("a column changed its type".into()));
        };
        append(column, descriptor.max_def_level(), &mut values, |held| word(held.data()))?;
    }
    Ok((bytes.get() <= MOST_BYTES).then_some(values.cells))
}

/// First word of a column of them; empty when there is none.
pub(super) fn first_word(
    file: &SerializedFileReader<Bytes>,
    index: usize,
) -> Result<String, ParquetError> {
    for group in 0..file.num_row_groups() {
        check_dictionary(file, group, index)?;
        let reader = file.get_row_group(group)?.get_column_reader(index)?;
        let ColumnReader::ByteArrayColumnReader(mut column) = reader else { continue };
        let (mut levels, mut words) = (Vec::new(), Vec::new());
        while words.is_empty() {
            levels.clear();
            let (rows, ..) = column.read_records(1, Some(&mut levels), None, &mut words)?;
            if rows == 0 {
                break;
            }
        }
        if let Some(word) = words.first() {
            return Ok(shortened(&String::from_utf8_lossy(word.data())));
        }
    }
    Ok(String::new())
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use ::parquet::data_type::{ByteArray, ByteArrayType, Int64Type};
    use ::parquet::file::writer::SerializedFileWriter;
    use ::parquet::schema::parser::parse_message_type;

    use super::super::{read_foreign_parquet, read_parquet};

    #[test]
    fn words_and_decimals_are_read_with_their_gaps() {
        let schema = "message m { optional binary direction (STRING); \
                      optional int64 error_um (DECIMAL(12, 3)); }";
        let schema = Arc::new(parse_message_type(schema).unwrap());
        let mut bytes = Vec::new();
        let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        let words = ["forward", "reverse"].map(ByteArray::from);
        column.typed::<ByteArrayType>().write_batch(&words, Some(&[1, 0, 1]), None).unwrap();
        column.close().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(&[-12_345, 5], Some(&[1, 1, 0]), None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.close().unwrap();
        let path = Path::new("data.parquet");
        let own = read_parquet(bytes.clone(), path).unwrap();
        let foreign = read_foreign_parquet(bytes, path).unwrap();
        assert_eq!(foreign.words[0].words, ["forward", "", "reverse"]);
        for table in [own, foreign.table] {
            let values = &table.columns[0].values;
            assert_eq!(values[..2], [-12.345, 0.005]);
            assert!(values[2].is_nan());
        }
    }
}
