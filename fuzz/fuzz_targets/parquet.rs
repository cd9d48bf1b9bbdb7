//! A file is a table or an error.
#![no_main]

use std::path::Path;

use helixlock_traces::parquet::read_parquet;
use libfuzzer_sys::fuzz_target;

fuzz_target!(
    // The reader turns panics of its library into errors; those of this target still count.
    init: std::panic::set_hook(Box::new(|_| ())),
    |bytes: &[u8]| {
        if let Err(error) = read_parquet(bytes.to_vec(), Path::new("data.parquet")) {
            assert!(error.to_string().starts_with("data.parquet"));
        }
    }
);
