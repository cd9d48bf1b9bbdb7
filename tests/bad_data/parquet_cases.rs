//! Malformed Parquet: columns that hold no numbers, by pyarrow, and good files spoilt.

use std::path::Path;

use super::Case;

fn file(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/parquet");
    std::fs::read(folder.join(name)).expect(name)
}

/// Files whose columns are refused.
const COLUMNS: &[(&str, &str)] = &[
    ("time stamps", "bad_timestamp.parquet"),
    ("old time stamps", "bad_int96.parquet"),
    ("dates", "bad_date.parquet"),
    ("times of day", "bad_time_of_day.parquet"),
    ("lists", "bad_list.parquet"),
    ("a text inside a structure", "bad_struct.parquet"),
    ("bytes", "bad_bytes.parquet"),
    ("half precision", "bad_half.parquet"),
    ("an infinite value", "bad_infinite.parquet"),
    ("no rows", "bad_no_rows.parquet"),
    ("no columns", "bad_no_columns.parquet"),
    ("a compression we do not read", "pyarrow_brotli.parquet"),
];

/// Where a good file is spoilt.
type Spoil = fn(&mut Vec<u8>);

const SPOILT: &[(&str, Spoil)] = &[
    ("nothing but the first word", |bytes| bytes.truncate(4)),
    ("cut off after eight bytes", |bytes| bytes.truncate(8)),
    ("cut off in the first page", |bytes| bytes.truncate(60)),
    ("cut off in the middle", |bytes| bytes.truncate(bytes.len() / 2)),
    ("cut off by one byte", |bytes| bytes.truncate(bytes.len() - 1)),
    ("cut off by the last word", |bytes| bytes.truncate(bytes.len() - 4)),
    ("the last word is another", |bytes| *bytes.last_mut().expect("not empty") = b'2'),
    ("a footer longer than the file", |bytes| overwrite(bytes, 8, &u32::MAX.to_le_bytes())),
    ("a footer of no length", |bytes| overwrite(bytes, 8, &0_u32.to_le_bytes())),
    ("a footer that begins with zeros", |bytes| {
        let before_end = footer(bytes);
        overwrite(bytes, before_end, &[0; 40]);
    }),
    ("a footer that begins with ones", |bytes| {
        let before_end = footer(bytes);
        overwrite(bytes, before_end, &[0xff; 40]);
    }),
    ("pages of zeros", |bytes| bytes[4..1500].fill(0)),
    ("pages of ones", |bytes| bytes[4..1500].fill(0xff)),
];

/// Bytes from the beginning of the footer to the end of the file.
fn footer(bytes: &[u8]) -> usize {
    let length = bytes[bytes.len() - 8..].first_chunk().expect("eight bytes");
    u32::from_le_bytes(*length) as usize + 8
}

/// Writes over what lies `before_end` bytes before the end.
fn overwrite(bytes: &mut [u8], before_end: usize, by: &[u8]) {
    let at = bytes.len() - before_end;
    bytes[at..at + by.len()].copy_from_slice(by);
}

/// All of them.
pub(super) fn cases() -> Vec<Case> {
    let columns = COLUMNS.iter().map(|(name, path)| (*name, file(path)));
    let spoilt = SPOILT.iter().map(|(name, spoil)| {
        let mut bytes = file("pyarrow_none.parquet");
        spoil(&mut bytes);
        (*name, bytes)
    });
    columns.chain(spoilt).collect()
}
