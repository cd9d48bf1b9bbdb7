//! Prints the tables of coverage in docs/metrology.md: what is drawn has a known truth.
//!
//! `cargo run --release -p helixlock-metrology --example coverage`; with a word, only the tables
//! that have it in their name: `straightness`, `screw`, `axis`.

use std::io::Write;

use helixlock_metrology::{iso230, screw, straightness};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked = std::env::args().nth(1).unwrap_or_default();
    let mut out = std::io::stdout().lock();
    if "straightness".contains(&asked) {
        of_straightness(&mut out)?;
    }
    if "screw".contains(&asked) {
        of_screws(&mut out)?;
    }
    if "axis".contains(&asked) {
        of_axes(&mut out)?;
    }
    Ok(())
}

type Printed = Result<(), Box<dyn std::error::Error>>;

fn of_straightness(out: &mut impl Write) -> Printed {
    writeln!(out, "| bar | Fourier | least squares |")?;
    writeln!(out, "|---|---|---|")?;
    for bar in straightness::coverage::Bar::ALL {
        let found = straightness::coverage::coverage(bar, 2000, 1)?;
        let held = [found.fourier, found.least_squares]
            .map(|share| format!("{:.1} %", 100.0 * share))
            .join(" | ");
        writeln!(out, "| {} | {held} |", bar.in_words())?;
    }
    Ok(writeln!(out)?)
}

fn of_screws(out: &mut impl Write) -> Printed {
    let header = "| screw | noise | widened by | left of it | ±1.96 u holds |";
    writeln!(out, "{header}\n|---|---|---|---|---|")?;
    for kind in screw::coverage::Screw::ALL {
        for noise_um in [0.05, 0.25, 0.6] {
            let found = screw::coverage::coverage(kind, noise_um, 500, 1);
            let (widened, left) = (found.widening_um, found.left_um);
            let (kind, held) = (kind.in_words(), 100.0 * found.held);
            let sizes = format!("{widened:.2} µm | {left:+.2} µm");
            writeln!(out, "| {kind} | {noise_um} µm | {sizes} | {held:.1} % |")?;
        }
    }
    Ok(writeln!(out)?)
}

fn of_axes(out: &mut impl Write) -> Printed {
    let shown = ["A", "E", "M", "B", "B̄", "R", "P", "Ps"];
    writeln!(out, "| axis | drift | {} |", shown.join(" | "))?;
    writeln!(out, "|---|---|{}", "---|".repeat(shown.len()))?;
    for axis in iso230::coverage::Axis::ALL {
        for variation_um in [0.1, 0.5] {
            let found = iso230::coverage::coverage(axis, variation_um, 1000, 1)?;
            let held = |symbol: &&str| {
                let share = found.iter().find(|(name, _)| name == symbol).map_or(0.0, |one| one.1);
                format!("{:.1} %", 100.0 * share)
            };
            let held: Vec<String> = shown.iter().map(held).collect();
            let kind = axis.in_words();
            writeln!(out, "| {kind} | {variation_um} µm | {} |", held.join(" | "))?;
        }
    }
    Ok(writeln!(out)?)
}
