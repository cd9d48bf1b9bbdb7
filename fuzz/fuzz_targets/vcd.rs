//! A dump gives its edges or an error with a line.
#![no_main]

use std::path::Path;

use helixlock_traces::capture::capture_edges;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match capture_edges(bytes, Path::new("wave.vcd")) {
        Err(error) => assert!(error.to_string().starts_with("wave.vcd")),
        Ok(capture) => {
            for signal in &capture.signals {
                for edges in [&signal.rising_ticks, &signal.falling_ticks] {
                    assert!(edges.is_sorted_by(|one, next| one < next));
                }
            }
        }
    }
});
