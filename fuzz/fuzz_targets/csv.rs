//! A text is a table or an error; a table reads back from what is written of it.
#![no_main]

use std::path::Path;

use helixlock_traces::csv::{read_csv, write_csv};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let path = Path::new("data.csv");
    match read_csv(bytes, path) {
        Err(error) => assert!(error.to_string().starts_with("data.csv")),
        Ok(table) => {
            let mut text = Vec::new();
            write_csv(&table, &mut text).expect("memory takes it");
            let again = read_csv(&text, path).expect("what we write, we read");
            assert_eq!(again.rows(), table.rows());
            for row in 0..table.rows() {
                assert!(table.at(row).line.is_some());
            }
        }
    }
});
