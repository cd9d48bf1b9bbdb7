//! Prints the table of coverage in docs/metrology.md: drawn records with known truth.
//!
//! `cargo run --release -p helixlock-metrology --example coverage`

use std::io::Write;

use helixlock_metrology::straightness::coverage::{Bar, coverage};

const RECORDS: usize = 1000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut out = std::io::stdout().lock();
    writeln!(out, "| bar | Fourier | least squares |\n|---|---|---|")?;
    for bar in Bar::ALL {
        let found = coverage(bar, RECORDS, 1)?;
        let (fourier, squares) = (100.0 * found.fourier, 100.0 * found.least_squares);
        writeln!(out, "| {} | {fourier:.1} % | {squares:.1} % |", bar.in_words())?;
    }
    Ok(())
}
