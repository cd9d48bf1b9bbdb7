//! Whether a file that we wrote still holds what was written: Parquet's own pages are not checked.
//!
//! It stands in the name of the writer, which whoever writes the table anew replaces.

use flate2::Crc;

use crate::table::Column;

const WRITER: &str = concat!("helixlock ", env!("CARGO_PKG_VERSION"), " crc32 ");

/// The writer's name, with the checksum of what it wrote.
pub(super) fn created_by(columns: &[Column]) -> String {
    format!("{WRITER}{:08x}", of(columns))
}

/// True unless the writer says that other numbers were written.
pub(super) fn holds(created_by: Option<&str>, columns: &[Column]) -> bool {
    let told = created_by.and_then(|by| by.strip_prefix(WRITER));
    let told = told.and_then(|sum| u32::from_str_radix(sum, 16).ok());
    told.is_none_or(|told| told == of(columns))
}

/// Of names and numbers; every missing number is the same.
fn of(columns: &[Column]) -> u32 {
    let mut crc = Crc::new();
    for Column { name, values } in columns {
        crc.update(name.as_bytes());
        for value in values {
            let value = if value.is_nan() { f64::NAN } else { *value };
            crc.update(&value.to_le_bytes());
        }
    }
    crc.sum()
}
