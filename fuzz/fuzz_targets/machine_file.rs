//! A text is a machine or an error that names the file.
#![no_main]

use std::path::Path;

use helixlock_plant::Model;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Err(error) = Model::parse(text, Path::new("machine.toml")) {
        assert!(error.to_string().contains("machine.toml"), "{error}");
    }
});
