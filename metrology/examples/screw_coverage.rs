//! Prints the table of noisy bands in docs/metrology.md: drawn screws with known truth.
//!
//! `cargo run --release -p helixlock-metrology --example screw_coverage`

use std::io::Write;

use helixlock_metrology::screw::coverage::{Screw, coverage};

const RECORDS: u32 = 500;

fn main() -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "| screw | noise | widened by | left of it | ±1.96 u holds |\n|---|---|---|---|---|"
    )?;
    for screw in Screw::ALL {
        for noise_um in [0.05, 0.25, 0.6] {
            let found = coverage(screw, noise_um, RECORDS, 1);
            let (widened, left) = (found.widening_um, found.left_um);
            let held = 100.0 * found.held;
            writeln!(
                out,
                "| {} | {noise_um} µm | {widened:.2} µm | {left:+.2} µm | {held:.1} % |",
                screw.in_words()
            )?;
        }
    }
    Ok(())
}
