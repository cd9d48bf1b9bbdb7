//! Parquet: the same columns as the text form, in binary.
//!
//! Null and NaN are missing values. Booleans count as 0 and 1, decimals as the nearest number. A column
//! of words is left out and remembered; times and nested columns are refused by name.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{Compression, ConvertedType, Repetition, Type as PhysicalType};
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{DataType, DoubleType};
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::{ColumnDescriptor, Type};
use bytes::Bytes;

use crate::error::{At, TraceError};
use crate::table::{Column, Table, TextColumn};

mod checks;
mod checksum;
mod decimals;
mod instants;
mod words;

use checks::{
    check_compression, check_dictionary, check_places, check_rows, check_type, declared_rows,
    is_text,
};
use instants::{read_instants, ticks_in_a_second};
use words::{first_word, read_words};

pub use words::Words;

/// Rows decoded at a time, and rows written to a group.
const BATCH_ROWS: usize = 1 << 16;
const GROUP_ROWS: usize = 1 << 20;

/// Reads every column of a Parquet file; `path` is for messages only.
///
/// Columns that pandas adds for its index (`__index_level_0__`) are left out.
///
/// # Errors
///
/// A file that contradicts itself, a column that holds no numbers, an infinite value, no rows.
pub fn read_parquet(bytes: Vec<u8>, path: &Path) -> Result<Table, TraceError> {
    Ok(guarded(bytes, path, Others::Refused)?.table)
}

/// What another program wrote.
#[derive(Clone, Debug, Default)]
pub struct Foreign {
    /// Columns of numbers and of instants; what is left out is remembered there.
    pub table: Table,
    /// Columns of words.
    pub words: Vec<Words>,
}

/// Reads the numbers, instants and words of a Parquet file that another program wrote.
///
/// Instants are seconds since the first of their column, which is then called `NAME (s)`; whatever else is
/// there is left out and remembered.
///
/// # Errors
///
/// As [`read_parquet`], without those of single columns.
pub fn read_foreign_parquet(bytes: Vec<u8>, path: &Path) -> Result<Foreign, TraceError> {
    guarded(bytes, path, Others::LeftOut)
}

/// What becomes of columns that are neither numbers nor words.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Others {
    Refused,
    LeftOut,
}

fn guarded(bytes: Vec<u8>, path: &Path, others: Others) -> Result<Foreign, TraceError> {
    // Fuzzing found broken pages on which the library panics; for its user that is an error too.
    std::panic::catch_unwind(|| read_columns(bytes, path, others)).unwrap_or_else(|_| {
        let message = "its pages contradict its footer".into();
        Err(TraceError::Parquet { path: path.to_owned(), message })
    })
}

fn read_columns(bytes: Vec<u8>, path: &Path, others: Others) -> Result<Foreign, TraceError> {
    let broken = |error| broken(path, &error);
    let size = bytes.len();
    let reader = SerializedFileReader::new(Bytes::from(bytes)).map_err(broken)?;
    check_places(&reader, size).map_err(broken)?;
    let rows = declared_rows(&reader).map_err(broken)?;
    let schema = reader.metadata().file_metadata().schema_descr();
    let mut table = Table { path: path.to_owned(), ..Table::default() };
    let (mut words, mut refused) = (Vec::new(), None);
    for (index, descriptor) in schema.columns().iter().enumerate() {
        let name = descriptor.path().string();
        if name.starts_with("__index_level_") {
            continue;
        }
        check_compression(&reader, index, &name, path)?;
        match read_one(&reader, (index, descriptor), rows, path, others)? {
            Held::Numbers(column) => table.columns.push(column),
            Held::Words(column) => words.push(column),
            Held::LeftOut(first, why) => {
                table.text.push(TextColumn { name, first, at: At::file(path), hint: "" });
                refused = refused.or(why);
            }
        }
    }
    if table.columns.is_empty() && words.is_empty() {
        let first = table.text.first().map(TextColumn::refused);
        if let Some(error) = refused.or(first) {
            return Err(error);
        }
    }
    if !checksum::holds(reader.metadata().file_metadata().created_by(), &table.columns) {
        let message =
            "found other numbers than were written, by their checksum: the file is damaged";
        return Err(broken(ParquetError::General(message.into())));
    }
    check_rows(&table, &words)?;
    Ok(Foreign { table, words })
}

/// What a column holds.
enum Held {
    Numbers(Column),
    Words(Words),
    /// Its first word, and why it is left out where that is no word.
    LeftOut(String, Option<TraceError>),
}

fn read_one(
    file: &SerializedFileReader<Bytes>,
    (index, descriptor): (usize, &ColumnDescriptor),
    rows: usize,
    path: &Path,
    others: Others,
) -> Result<Held, TraceError> {
    let broken = |error| broken(path, &error);
    let name = descriptor.path().string();
    let foreign = others == Others::LeftOut;
    if is_text(descriptor) {
        let all = if foreign { read_words(file, (index, descriptor), rows) } else { Ok(None) };
        return Ok(match all.map_err(broken)? {
            Some(words) => Held::Words(Words { name, words }),
            None => Held::LeftOut(first_word(file, index).map_err(broken)?, None),
        });
    }
    if let Some(in_a_second) = ticks_in_a_second(descriptor).filter(|_| foreign) {
        let values = read_instants(file, (index, descriptor), rows, in_a_second);
        let values = values.map_err(broken)?;
        return Ok(Held::Numbers(Column { name: format!("{name} (s)"), values }));
    }
    match check_type(descriptor, &name, path) {
        Err(error) if foreign => return Ok(Held::LeftOut(String::new(), Some(error))),
        checked => checked?,
    }
    let values = read_column(file, index, descriptor, rows).map_err(broken)?;
    Ok(Held::Numbers(Column { name, values }))
}

fn broken(path: &Path, error: &ParquetError) -> TraceError {
    TraceError::Parquet { path: path.to_owned(), message: error.to_string() }
}

/// Writes a table as Parquet, one optional double column each; NaN becomes null.
///
/// # Errors
///
/// Those of `out`, and what Parquet cannot hold.
pub fn write_parquet(table: &Table, out: &mut (impl Write + Send)) -> io::Result<()> {
    let fields = table.names().map(optional_double).collect::<Result<Vec<_>, _>>();
    let schema = fields
        .and_then(|fields| Type::group_type_builder("table").with_fields(fields).build())
        .map_err(io::Error::other)?;
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_created_by(checksum::created_by(&table.columns))
        .build();
    let mut writer = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))
        .map_err(io::Error::other)?;
    for start in (0..table.rows()).step_by(GROUP_ROWS) {
        let end = table.rows().min(start + GROUP_ROWS);
        write_group(table, start..end, &mut writer).map_err(io::Error::other)?;
    }
    writer.close().map_err(io::Error::other)?;
    Ok(())
}

fn optional_double(name: &str) -> Result<Arc<Type>, ParquetError> {
    Type::primitive_type_builder(name, PhysicalType::DOUBLE)
        .with_repetition(Repetition::OPTIONAL)
        .build()
        .map(Arc::new)
}

fn write_group<W: Write + Send>(
    table: &Table,
    rows: std::ops::Range<usize>,
    writer: &mut SerializedFileWriter<W>,
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for column in &table.columns {
        let values = &column.values[rows.clone()];
        let present: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
        let levels: Vec<i16> = values.iter().map(|value| i16::from(!value.is_nan())).collect();
        if let Some(mut column) = group.next_column()? {
            column.typed::<DoubleType>().write_batch(&present, Some(&levels), None)?;
            column.close()?;
        }
    }
    group.close()?;
    Ok(())
}

fn read_column(
    file: &SerializedFileReader<Bytes>,
    index: usize,
    descriptor: &ColumnDescriptor,
    rows: usize,
) -> Result<Vec<f64>, ParquetError> {
    let unsigned = matches!(
        descriptor.converted_type(),
        ConvertedType::UINT_8
            | ConvertedType::UINT_16
            | ConvertedType::UINT_32
            | ConvertedType::UINT_64
    );
    let scale = decimals::scale(descriptor);
    let complete = descriptor.max_def_level();
    let mut values = Values::numbers(rows);
    for group in 0..file.num_row_groups() {
        check_dictionary(file, group, index)?;
        match file.get_row_group(group)?.get_column_reader(index)? {
            ColumnReader::BoolColumnReader(column) => {
                append(column, complete, &mut values, |value| f64::from(u8::from(value)))?;
            }
            ColumnReader::Int32ColumnReader(column) if unsigned => {
                append(column, complete, &mut values, |value| f64::from(value.cast_unsigned()))?;
            }
            ColumnReader::Int32ColumnReader(column) => {
                append(column, complete, &mut values, |value| f64::from(value) / scale)?;
            }
            ColumnReader::Int64ColumnReader(column) if unsigned => {
                append(column, complete, &mut values, |value| nearest_u64(value.cast_unsigned()))?;
            }
            ColumnReader::Int64ColumnReader(column) => {
                append(column, complete, &mut values, |value| nearest_i64(value) / scale)?;
            }
            ColumnReader::FloatColumnReader(column) => {
                append(column, complete, &mut values, f64::from)?;
            }
            ColumnReader::DoubleColumnReader(column) => {
                append(column, complete, &mut values, |value| value)?;
            }
            ColumnReader::FixedLenByteArrayColumnReader(column) => {
                append(column, complete, &mut values, |value| {
                    decimals::whole(value.data()) / scale
                })?;
            }
            ColumnReader::ByteArrayColumnReader(column) => {
                append(column, complete, &mut values, |value| {
                    decimals::whole(value.data()) / scale
                })?;
            }
            ColumnReader::Int96ColumnReader(_) => {
                return Err(ParquetError::General("a column changed its type".into()));
            }
        }
    }
    Ok(values.cells)
}

#[expect(
    clippy::cast_precision_loss,
    reason = "counts beyond 2^53 are taken as the nearest number"
)]
fn nearest_i64(value: i64) -> f64 {
    value as f64
}

#[expect(
    clippy::cast_precision_loss,
    reason = "counts beyond 2^53 are taken as the nearest number"
)]
fn nearest_u64(value: u64) -> f64 {
    value as f64
}

/// A column as it grows.
struct Values<V> {
    cells: Vec<V>,
    /// What stands for a null.
    missing: V,
    /// Rows that the file declares.
    most: usize,
}

impl Values<f64> {
    fn numbers(most: usize) -> Self {
        Self { cells: Vec::new(), missing: f64::NAN, most }
    }
}

/// Appends all values of a column chunk; a level below `complete` is a null.
fn append<T: DataType, V: Clone>(
    mut column: ColumnReaderImpl<T>,
    complete: i16,
    values: &mut Values<V>,
    cell: impl Fn(T::T) -> V,
) -> Result<(), ParquetError> {
    let (mut levels, mut present) = (Vec::new(), Vec::new());
    loop {
        levels.clear();
        present.clear();
        let (rows, ..) = column.read_records(BATCH_ROWS, Some(&mut levels), None, &mut present)?;
        if rows == 0 {
            return Ok(());
        }
        let mut present = present.drain(..).map(&cell);
        let mut next = || present.next().unwrap_or_else(|| values.missing.clone());
        if complete == 0 {
            values.cells.extend(present);
        } else {
            values.cells.extend(levels.iter().map(|level| match *level {
                level if level == complete => next(),
                _ => values.missing.clone(),
            }));
        }
        if values.most < values.cells.len() {
            return Err(ParquetError::General("a column has more rows than declared".into()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_columns_read_back_with_their_gaps() {
        let values = vec![1.5, f64::NAN, -0.0, 1e-300];
        let table = Table::new(vec![Column { name: "error_um".into(), values }]);
        let mut bytes = Vec::new();
        write_parquet(&table, &mut bytes).unwrap();
        let again = read_parquet(bytes, Path::new("data.parquet")).unwrap();
        let bits: Vec<_> = again.columns[0].values.iter().map(|value| value.to_bits()).collect();
        assert_eq!(again.columns[0].name, "error_um");
        assert_eq!(bits, table.columns[0].values.iter().map(|v| v.to_bits()).collect::<Vec<_>>());
    }

    /// Bits of its pages turned one by one: what is read at all is what was written.
    #[test]
    fn a_damaged_file_is_refused() {
        let values: Vec<f64> = (0..40).map(|row| 0.1 * f64::from(row)).collect();
        let table = Table::new(vec![Column { name: "error_um".into(), values: values.clone() }]);
        let mut bytes = Vec::new();
        write_parquet(&table, &mut bytes).unwrap();
        let pages = bytes.len() / 2;
        let mut refused = 0;
        for (at, bit) in (0..pages).flat_map(|at| (0..8).map(move |bit| (at, bit))) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 1 << bit;
            match read_parquet(damaged, Path::new("data.parquet")) {
                Ok(table) => assert_eq!(table.columns[0].values, values, "byte {at}, bit {bit}"),
                Err(_) => refused += 1,
            }
        }
        assert!(4 * pages < refused, "{refused} of {}", 8 * pages);
    }
}
