//! What is refused before and after a Parquet file is read.

use std::path::Path;

use ::parquet::basic::{Compression, ConvertedType, LogicalType, Type as PhysicalType};
use ::parquet::column::page::Page;
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::RowGroupMetaData;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::schema::types::ColumnDescriptor;
use bytes::Bytes;

use super::decimals::is_decimal;
use super::words::Words;
use crate::error::{At, TraceError};
use crate::number::LARGEST;
use crate::table::{Column, LONGEST_NAME, MOST_CELLS, MOST_COLUMNS, Table};

/// Most bytes that the pages of a file may unpack to.
const MOST_UNPACKED: i64 = 1 << 30;

/// Lets plain numbers and truth values through.
pub(super) fn check_type(
    column: &ColumnDescriptor,
    name: &str,
    path: &Path,
) -> Result<(), TraceError> {
    use ConvertedType::{INT_8, INT_16, INT_32, INT_64, NONE, UINT_8, UINT_16, UINT_32, UINT_64};
    let found = match (column.physical_type(), column.converted_type()) {
        _ if column.max_rep_level() > 0 => "lists".to_owned(),
        _ if is_decimal(column) => return Ok(()),
        (PhysicalType::BYTE_ARRAY | PhysicalType::FIXED_LEN_BYTE_ARRAY, NONE) => "bytes".to_owned(),
        (PhysicalType::INT96, _) => "times".to_owned(),
        (_, NONE | INT_8 | INT_16 | INT_32 | INT_64 | UINT_8 | UINT_16 | UINT_32 | UINT_64)
            if is_plain(column.logical_type_ref()) =>
        {
            return Ok(());
        }
        (_, converted) => format!("type {converted}").to_lowercase(),
    };
    Err(TraceError::ColumnType { path: path.to_owned(), name: name.to_owned(), found })
}

/// True for a column of words that is not part of another one.
pub(super) fn is_text(column: &ColumnDescriptor) -> bool {
    let words = column.converted_type() == ConvertedType::UTF8;
    words && column.path().parts().len() == 1 && column.max_rep_level() == 0
}

/// Rows that the footer declares; a few bytes can stand for any number of equal ones.
pub(super) fn declared_rows(file: &SerializedFileReader<Bytes>) -> Result<usize, ParquetError> {
    let schema = file.metadata().file_metadata().schema_descr();
    let columns = schema.num_columns();
    if schema.columns().iter().any(|column| LONGEST_NAME < column.path().string().len()) {
        let message =
            format!("found more bytes in the name of a column, expected at most {LONGEST_NAME}");
        return Err(ParquetError::General(message));
    }
    if MOST_COLUMNS < columns {
        let message = format!("found {columns} columns, expected at most {MOST_COLUMNS}");
        return Err(ParquetError::General(message));
    }
    let most = MOST_CELLS / columns.max(1);
    let groups = file.metadata().row_groups().iter().map(RowGroupMetaData::num_rows);
    let rows = groups.map(|rows| usize::try_from(rows).ok()).sum::<Option<usize>>();
    rows.filter(|rows| *rows <= most).ok_or_else(|| {
        ParquetError::General(format!(
            "found another number of rows, expected 0 to {most} of {columns} columns"
        ))
    })
}

/// Refuses columns that lie outside the file, on which the library would panic, and more pages than
/// memory takes.
pub(super) fn check_places(
    file: &SerializedFileReader<Bytes>,
    size: usize,
) -> Result<(), ParquetError> {
    let mut unpacked = 0_i64;
    for column in file.metadata().row_groups().iter().flat_map(RowGroupMetaData::columns) {
        unpacked = unpacked.saturating_add(column.uncompressed_size().max(0));
        let start = column.dictionary_page_offset().unwrap_or(column.data_page_offset());
        let end = start.checked_add(column.compressed_size());
        let inside = |place: i64| usize::try_from(place).is_ok_and(|place| place <= size);
        if column.compressed_size() < 0 || !inside(start) || !end.is_some_and(inside) {
            return Err(ParquetError::General("a column lies outside the file".into()));
        }
    }
    if MOST_UNPACKED < unpacked {
        let message =
            format!("its pages unpack to {unpacked} bytes, expected at most {MOST_UNPACKED}");
        return Err(ParquetError::General(message));
    }
    Ok(())
}

/// Refuses a dictionary of more entries than it has bytes, for which the library would ask for
/// any amount of memory.
pub(super) fn check_dictionary(
    file: &SerializedFileReader<Bytes>,
    group: usize,
    index: usize,
) -> Result<(), ParquetError> {
    let first = file.get_row_group(group)?.get_column_page_reader(index)?.get_next_page()?;
    match first {
        Some(Page::DictionaryPage { buf, num_values, .. }) if buf.len() < num_values as usize => {
            Err(ParquetError::General("a dictionary is cut off".into()))
        }
        _ => Ok(()),
    }
}

/// Refuses what would need yet another library to unpack.
pub(super) fn check_compression(
    file: &SerializedFileReader<Bytes>,
    index: usize,
    name: &str,
    path: &Path,
) -> Result<(), TraceError> {
    for column in file.metadata().row_groups().iter().filter_map(|group| group.columns().get(index))
    {
        let found = match column.compression() {
            Compression::BROTLI(_) => "brotli",
            Compression::LZO => "lzo",
            _ => continue,
        };
        return Err(TraceError::Compression { path: path.into(), name: name.into(), found });
    }
    Ok(())
}

fn is_plain(logical: Option<&LogicalType>) -> bool {
    matches!(logical, None | Some(LogicalType::Integer(_)))
}

/// Refuses columns of unequal length, values out of range, and a table without rows.
pub(super) fn check_rows(table: &Table, words: &[Words]) -> Result<(), TraceError> {
    let numbers = table.columns.iter().map(|column| (&column.name, column.values.len()));
    let words = words.iter().map(|column| (&column.name, column.words.len()));
    let lengths: Vec<(&String, usize)> = numbers.chain(words).collect();
    let rows = lengths.first().map_or(0, |(_, length)| *length);
    if let Some((name, length)) = lengths.iter().find(|(_, length)| *length != rows) {
        let message = format!("column `{name}` has {length} rows of {rows}");
        return Err(TraceError::Parquet { path: table.path.clone(), message });
    }
    for Column { name, values } in &table.columns {
        if let Some(row) = values.iter().position(|value| LARGEST < value.abs()) {
            return Err(TraceError::TooLarge {
                path: table.path.clone(),
                row: row + 1,
                name: name.clone(),
                found: values[row],
            });
        }
    }
    if rows == 0 {
        return Err(TraceError::Empty { at: At::file(&table.path), found: "no rows" });
    }
    Ok(())
}
