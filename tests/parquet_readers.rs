//! Parquet means the same to us and to pyarrow, pandas and polars.

use std::path::{Path, PathBuf};

use helixlock_traces::{Table, read_table};

fn read(name: &str) -> Table {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/parquet");
    let path: PathBuf = folder.join(name);
    read_table(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// The table that `tests/cases/parquet/make.py` writes; `None` is a null.
#[rustfmt::skip]
const EXPECTED: &[(&str, [Option<f64>; 7])] = &[
    ("position_mm", [Some(0.0), Some(0.5), Some(1.0), None, Some(2.0), Some(2.5), Some(3.0)]),
    ("error_um", [Some(-0.25), Some(0.125), None, Some(0.5), Some(1.5), Some(-2.0), Some(0.0)]),
    ("steps", [Some(0.0), Some(1.0), Some(-1.0), Some(40.0), Some(4095.0), None, Some(-4095.0)]),
    ("count", [Some(0.0), Some(1.0), Some(1_099_511_627_776.0), Some(3.0), Some(4.0), Some(5.0), Some(9_223_372_036_854_775_807.0)]),
    ("big", [Some(0.0), Some(1.0), Some(2.0), Some(3.0), Some(4.0), Some(5.0), Some(18_446_744_073_709_551_615.0)]),
    ("word", [Some(0.0), Some(1.0), Some(2.0), Some(3.0), Some(4.0), Some(5.0), Some(4_294_967_295.0)]),
    ("direction", [Some(1.0), Some(-1.0), Some(1.0), Some(-1.0), Some(1.0), Some(-1.0), Some(1.0)]),
    ("dwell", [Some(1.0), Some(0.0), None, Some(1.0), Some(0.0), Some(1.0), Some(0.0)]),
    ("pass", [Some(1.0), Some(1.0), Some(1.0), Some(1.0), Some(2.0), Some(2.0), Some(2.0)]),
];

#[test]
fn every_writer_encoding_and_compression_reads_alike() {
    for name in [
        "pyarrow_none",
        "pyarrow_snappy",
        "pyarrow_gzip",
        "pyarrow_zstd",
        "pyarrow_lz4",
        "pyarrow_v1_plain",
        "pyarrow_v2_delta",
        "polars",
    ] {
        let table = read(&format!("{name}.parquet"));
        assert_eq!(table.names().count(), EXPECTED.len(), "{name}");
        for (column, expected) in EXPECTED {
            let values = table.require(column).unwrap_or_else(|error| panic!("{error}"));
            let found: Vec<_> =
                values.iter().map(|value| Some(*value).filter(|v| !v.is_nan())).collect();
            assert_eq!(found, expected, "{name}, {column}");
        }
    }
}

/// pandas turns columns with nulls into floats, and keeps its index as a column of its own.
#[test]
fn the_index_of_pandas_is_left_out() {
    let table = read("pandas_index.parquet");
    assert_eq!(table.names().count(), EXPECTED.len());
    assert_eq!(table.column("steps").map(|steps| steps[4]), Some(4095.0));
}

/// pyarrow keeps 6.000 as two bytes, 6000 thousandths.
#[test]
fn decimals_are_numbers() {
    assert_eq!(read("decimal.parquet").column("lead_mm"), Some(&[6.0, 6.0][..]));
}
